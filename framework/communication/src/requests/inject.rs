//! Values in place of outputs: the last one counts, and who leaves gives the output back to whoever replaced it before.
//!
//! Invariant: of values that do not count no more is kept than `Limits::passed_over_bytes`.

use framework::{Given, OutputKind};
use protocol::{Failure, Good};
use serde_json::Value as Json;

use super::Answered;
use crate::hub::{ClientId, Fail, Hub};

/// What a client put in place of an output.
pub(crate) struct Injection {
    client: ClientId,
    /// Later ones have greater numbers.
    number: u64,
    /// As JSON.
    value: String,
}

impl Hub {
    pub(super) fn inject(&mut self, client: ClientId, path: &str, value: Json) -> Answered {
        let (instance, output) = self.main_output(path)?;
        self.replace(instance, output, &value)
            .map_err(|error| Failure::new(error.to_string()))?;
        let numbers = self.injected.values().flatten();
        let last = numbers.map(|injection| injection.number).max();
        let injections = self.injected.entry((instance, output)).or_default();
        injections.retain(|injection| injection.client != client);
        injections.push(Injection {
            client,
            number: last.map_or(0, |last| last + 1),
            value: value.to_string(),
        });
        self.forget_oldest();
        Ok(Some(Good::Done {}))
    }

    /// Of values that do not count, until they are no longer too much.
    fn forget_oldest(&mut self) {
        let before = |all: &[Injection]| -> usize {
            let before = all.iter().rev().skip(1);
            before.map(|injection| injection.value.len()).sum()
        };
        let mut held: usize = self.injected.values().map(|all| before(all)).sum();
        while held > self.limits.passed_over_bytes {
            let several = self.injected.values_mut().filter(|all| all.len() > 1);
            let Some(oldest) = several.min_by_key(|all| all.first().map(|it| it.number)) else {
                return;
            };
            held -= oldest.remove(0).value.len();
        }
    }

    pub(super) fn release(&mut self, path: &str) -> Answered {
        let (instance, output) = self.main_output(path)?;
        if self.injected.remove(&(instance, output)).is_none() {
            return Err(Failure::new(format!("nobody has replaced `{path}`")));
        }
        self.release_output(instance, output)
            .map_err(|error| Failure::new(error.to_string()))?;
        Ok(Some(Good::Done {}))
    }

    /// A client has gone.
    pub(crate) fn stop_injecting(&mut self, client: ClientId) {
        let is_own = |injection: &Injection| injection.client == client;
        for ((instance, output), mut injections) in std::mem::take(&mut self.injected) {
            let is_last = injections.last().is_some_and(is_own);
            injections.retain(|injection| !is_own(injection));
            if is_last {
                let before = injections.last();
                let value = before.and_then(|before| serde_json::from_str(&before.value).ok());
                let is_replaced =
                    value.is_some_and(|value| self.replace(instance, output, &value).is_ok());
                if !is_replaced {
                    // It was injected by this name, so it can be released by it.
                    let _ = self.release_output(instance, output);
                    continue;
                }
            }
            self.injected.insert((instance, output), injections);
        }
    }

    fn replace(
        &mut self,
        instance: usize,
        output: &'static str,
        value: &Json,
    ) -> framework::Result<()> {
        if let Some(link) = self.link.instances.get_mut(instance) {
            link.access.injector.inject(output, &Given::from(value))?;
        }
        self.mark(instance, output, true);
        Ok(())
    }

    /// The output is its node's again.
    fn release_output(&mut self, instance: usize, output: &'static str) -> framework::Result<()> {
        self.mark(instance, output, false);
        match self.link.instances.get_mut(instance) {
            Some(link) => link.access.injector.release(output),
            None => Ok(()),
        }
    }

    /// Remembers whether a client has replaced an output.
    fn mark(&mut self, instance: usize, output: &str, is_injected: bool) {
        let mut sources = self.sources.iter_mut();
        let found = sources.find(|it| (it.instance, it.name()) == (instance, output));
        if let Some(source) = found {
            source.is_injected = is_injected;
        }
    }

    /// A whole main output, as instance and name.
    fn main_output(&self, path: &str) -> Result<(usize, &'static str), Failure> {
        self.check_path(path)?;
        let (source, below) = self.find(path)?;
        let source = &self.sources[source];
        if !below.is_empty() || source.kind() != OutputKind::Main {
            return Err(Failure::new(format!(
                "`{path}` is no whole main output, and only such can be replaced"
            )));
        }
        Ok((source.instance, source.name()))
    }
}
