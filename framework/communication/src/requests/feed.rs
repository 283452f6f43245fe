//! Cycles of instances that other machines run.

use std::time::{Duration, Instant};

use framework::remote::Feed;
use framework::{Result as Fed, Timestamp};
use protocol::{Failure, Good};
use serde_json::Value as Json;

use super::Answered;
use crate::hub::{ClientId, Fail, Hub};

/// Who feeds an instance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Feeder {
    client: ClientId,
    /// When it said something of the instance that was taken.
    heard: Instant,
}

impl Feeder {
    fn is_silent(&self, timeout: Duration) -> bool {
        self.heard.elapsed() > timeout
    }
}

impl Hub {
    pub(super) fn announce(&mut self, client: ClientId, instance: &str, time: u64) -> Answered {
        let time = Timestamp::from_nanos(time);
        self.feed(client, instance, |remote| remote.announce(time))
    }

    pub(super) fn complete(
        &mut self,
        client: ClientId,
        instance: &str,
        time: u64,
        outputs: &Json,
    ) -> Answered {
        let time = Timestamp::from_nanos(time);
        self.feed(client, instance, |remote| remote.complete(time, outputs))
    }

    pub(super) fn abandon(&mut self, client: ClientId, instance: &str, time: u64) -> Answered {
        let time = Timestamp::from_nanos(time);
        self.feed(client, instance, |remote| remote.abandon(time))
    }

    /// A client has gone: what it announced comes no more.
    pub(crate) fn stop_feeding(&mut self, client: ClientId) {
        for (index, remote) in self.link.remotes.iter_mut().enumerate() {
            if self
                .feeders
                .get(&index)
                .is_some_and(|it| it.client == client)
            {
                remote.let_go();
                self.feeders.remove(&index);
            }
        }
    }

    /// Whether a client feeds the instance at this place.
    pub(crate) fn is_fed(&self, index: usize) -> bool {
        self.feeders.contains_key(&index)
    }

    /// Who is refused does not become the feeder, or a client that is wrong would keep out the one that is right.
    fn feed(
        &mut self,
        client: ClientId,
        instance: &str,
        deed: impl FnOnce(&mut dyn Feed) -> Fed<()>,
    ) -> Answered {
        self.check_path(instance)?;
        let mut remotes = self.link.remotes.iter_mut().enumerate();
        let Some((index, remote)) = remotes.find(|(_, remote)| remote.instance() == instance)
        else {
            return Err(self.no_remote(instance));
        };
        if let Some(other) = self.feeders.get(&index).filter(|it| it.client != client) {
            let timeout = remote.pending_timeout();
            if !other.is_silent(timeout) {
                return Err(Failure::new(format!(
                    "another client feeds `{instance}`: end it, or let it be silent for {timeout:?}"
                )));
            }
            // What the other announced is let go by the next cycle, if that is none of those that are refused.
        }
        deed(remote.as_mut()).map_err(|error| Failure::new(error.to_string()))?;
        let heard = Instant::now();
        self.feeders.insert(index, Feeder { client, heard });
        Ok(Some(Good::Done {}))
    }

    fn no_remote(&self, instance: &str) -> Failure {
        let remotes = self.link.remotes.iter();
        let known: Vec<_> = remotes.map(|remote| remote.instance()).collect();
        Failure::new(match known.as_slice() {
            [] => format!("no `{instance}` to feed: other machines run no instance of this robot"),
            known => format!(
                "no `{instance}` to feed: other machines run {}",
                known.join(", ")
            ),
        })
    }
}
