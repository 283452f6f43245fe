//! Subscriptions: who gets what, how often, and in which form.

use framework::reflect::ResolvedPath;
use protocol::{Encoding, Failure, Good, Subscribed};

use super::{Answered, below_parameters, gone};
use crate::hub::{ClientId, Fail, Hub, Subscription};
use crate::parameters;
use crate::sources::{Rate, Source, resolve};

impl Hub {
    pub(super) fn subscribe(
        &mut self,
        id: ClientId,
        path: &str,
        rate: Option<f64>,
        encoding: Encoding,
    ) -> Answered {
        self.check_path(path)?;
        if rate.is_some_and(|rate| !(rate.is_finite() && rate > 0.0)) {
            let message = "a rate is a number of updates per second greater than 0";
            return Err(Failure::new(message.to_owned()));
        }
        let most = self.limits.subscriptions;
        let client = self.clients.get_mut(&id).ok_or_else(gone)?;
        if client.subscriptions.len() >= most {
            return Err(Failure::new(format!(
                "this client has {most} subscriptions, which is the most: unsubscribe some"
            )));
        }
        let number = client.next_subscription;
        let subscription;
        let mut layout = None;
        let mut first = None;
        if let Some(path) = below_parameters(path) {
            if encoding != Encoding::Json {
                let message = "parameters are told as JSON alone";
                return Err(Failure::new(message.to_owned()));
            }
            parameters::read(&self.link.parameters, path)?;
            let time = self.link.clock.now().as_nanos();
            let mut rate = Rate::new(rate);
            rate.is_due(time);
            first = Some(parameters::update(&self.link.parameters, path, time));
            subscription = Subscription::Parameters {
                path: path.to_owned(),
                rate,
                is_behind: false,
            };
        } else {
            let (source, below) = self.find(path)?;
            let part = resolve(&self.sources[source].shape, below)
                .map_err(|message| Failure::new(format!("`{path}`: {message}")))?;
            if let Encoding::Jpeg { quality } = encoding {
                check_jpeg(path, &part, quality)?;
                self.check_room_for_jpeg(id, source, &part, encoding)?;
            }
            let source_of = &mut self.sources[source];
            if encoding == Encoding::Binary {
                layout = serde_json::to_value(part.shape().layout()).ok();
            }
            source_of.subscribe(part, encoding, id, number, Rate::new(rate));
            subscription = Subscription::Output(source);
        }
        let client = self.clients.get_mut(&id).ok_or_else(gone)?;
        client.next_subscription = client.next_subscription.wrapping_add(1);
        client.subscriptions.insert(number, subscription);
        if let Some(content) = first {
            client.update(number, content, &self.limits);
        }
        Ok(Some(Good::Subscribed(Subscribed {
            subscription: number,
            encoding,
            layout,
        })))
    }

    /// Compressing is the one thing that a client can ask which takes the server milliseconds.
    fn check_room_for_jpeg(
        &self,
        client: ClientId,
        source: usize,
        part: &ResolvedPath,
        encoding: Encoding,
    ) -> Result<(), Failure> {
        let most = self.limits.jpegs_of_client;
        let of_client = self.sources.iter().map(|source| source.jpegs_of(client));
        if of_client.sum::<usize>() >= most {
            return Err(Failure::new(format!(
                "this client takes {most} compressed images already, which is the most for one"
            )));
        }
        let most = self.limits.jpegs;
        let is_new = !self.sources[source].has(part, encoding);
        if is_new && self.sources.iter().map(Source::jpegs).sum::<usize>() >= most {
            return Err(Failure::new(format!(
                "{most} images are compressed already, which is the most: take one of the qualities that others have"
            )));
        }
        Ok(())
    }

    pub(super) fn bundle(&mut self, id: ClientId) -> Answered {
        let client = self.clients.get_mut(&id).ok_or_else(gone)?;
        client.outbox.bundle();
        Ok(Some(Good::Done {}))
    }

    pub(super) fn unsubscribe(&mut self, id: ClientId, number: u32) -> Answered {
        let client = self.clients.get_mut(&id).ok_or_else(gone)?;
        let Some(subscription) = client.subscriptions.remove(&number) else {
            return Err(Failure::new(format!("there is no subscription {number}")));
        };
        client.outbox.forget(number);
        self.end(id, number, &subscription);
        Ok(Some(Good::Done {}))
    }
}

/// Whether it can be compressed, and so well.
fn check_jpeg(path: &str, part: &ResolvedPath, quality: u8) -> Result<(), Failure> {
    if part.shape().image().is_none() {
        return Err(Failure::new(format!(
            "`{path}` is no image: types that are say so with `#[reflect(image = …)]`"
        )));
    }
    if !(1..=100).contains(&quality) {
        let message = "the quality of a JPEG is a number from 1 to 100";
        return Err(Failure::new(message.to_owned()));
    }
    Ok(())
}
