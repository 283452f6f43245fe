//! Parameters in the words of the protocol.

use std::sync::Arc;

use framework::parameters::{self, Live, Refusals};
use protocol::{
    Failure, Leaf, Message, ParametersChanged, Provenance, Reading, Refusal, Stored, Unstored,
    UnstoredChange,
};

use crate::hub::{Fail, Hub, Subscription};
use crate::outbox::Content;

impl Hub {
    /// The parameters are not what they were: tells everybody.
    pub(crate) fn parameters_changed(&mut self) {
        self.told_parameters = self.link.parameters.version();
        let version = self.told_parameters.0;
        let changed = Message::ParametersChanged(ParametersChanged { version });
        for client in self.clients.values_mut() {
            client.outbox.say(&changed);
            client.news.notify_one();
            for subscription in client.subscriptions.values_mut() {
                if let Subscription::Parameters { is_behind, .. } = subscription {
                    *is_behind = true;
                }
            }
        }
        self.tell_parameters();
    }

    /// Tells the newest values to whoever has older ones and wants them by now; whether some want them later.
    pub(crate) fn tell_parameters(&mut self) -> bool {
        let time = self.link.clock.now().as_nanos();
        let mut some_later = false;
        for client in self.clients.values_mut() {
            for (number, subscription) in &mut client.subscriptions {
                let Subscription::Parameters {
                    path,
                    rate,
                    is_behind: is_behind @ true,
                } = subscription
                else {
                    continue;
                };
                *is_behind = !rate.is_due(time);
                some_later |= *is_behind;
                if !*is_behind {
                    let content = update(&self.link.parameters, path, time);
                    client.outbox.update(*number, content, &self.limits);
                    client.news.notify_one();
                }
            }
        }
        some_later
    }
}

/// The value of a subscription, in which everything lies that a path names.
pub(crate) fn update(live: &Live, path: &str, time: u64) -> Content {
    let (version, value) = match live.read(path) {
        Ok(reading) => (reading.version.0, reading.value),
        // Its enum or option has changed: the part is not there now.
        Err(_) => (live.version().0, serde_json::Value::Null),
    };
    Content::Text(Arc::new(format!(
        r#""cycle":{version},"time":{time},"value":{value}}}}}"#
    )))
}

/// What lies at a path, and where it comes from.
pub(crate) fn read(live: &Live, path: &str) -> Result<Reading, Failure> {
    let reading = live
        .read(path)
        .map_err(|refusal| refusals(refusal.into()))?;
    let leaves = reading.leaves.into_iter().map(|leaf| Leaf {
        path: leaf.path,
        provenance: provenance(leaf.provenance),
    });
    Ok(Reading {
        value: reading.value,
        version: reading.version.0,
        leaves: leaves.collect(),
    })
}

/// What no file has, and which files could.
pub(crate) fn unstored(live: &Live) -> Unstored {
    let changes = live.changed_not_stored().into_iter();
    Unstored {
        version: live.version().0,
        changes: changes
            .map(|change| UnstoredChange {
                path: change.path,
                value: change.value,
                stored: change.stored,
                version: change.version.0,
            })
            .collect(),
        layers: live.layers(),
        creation_only: live.creation_only(),
    }
}

pub(crate) fn store(live: &Live, layer: &str, paths: &[String]) -> Result<Stored, Failure> {
    let stored = live.store(layer, paths).map_err(refusals)?;
    Ok(Stored {
        file: stored.file.display().to_string(),
        paths: stored.paths,
        warnings: stored.warnings,
    })
}

/// Everything that is wrong with a change.
pub(crate) fn refusals(refusals: Refusals) -> Failure {
    let all = refusals.0.into_iter().map(|refusal| Refusal {
        path: refusal.path,
        message: refusal.message,
    });
    Failure::of(all.collect())
}

fn provenance(provenance: parameters::Provenance) -> Provenance {
    match provenance {
        parameters::Provenance::File { file, line } => Provenance::File {
            file,
            line: line as u64,
        },
        parameters::Provenance::Environment { variable } => Provenance::Environment { variable },
        parameters::Provenance::Setting { setting } => Provenance::Setting { setting },
        parameters::Provenance::Live { version } => Provenance::Live { version: version.0 },
        parameters::Provenance::Nowhere => Provenance::Nowhere,
    }
}
