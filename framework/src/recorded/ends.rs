//! Nodes, parameters, injections and calls: what a cycle has at its ends beside values of other instances.

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Loading, Outputs, Saving, Stored};
use crate::buffer::{Reader, Writer};
use crate::error::Result;
use crate::guarded::{Condition, Guarded, OnFailure, State};
use crate::injection::Injected;
use crate::procedure::Answerer;
use crate::time::Timestamp;

impl<N: Serialize> Guarded<N> {
    /// Saves the node's state and what its failures left behind.
    #[inline]
    pub fn record(&self, out: &mut Saving<'_, '_>) {
        out.put_here(self.node());
        // As `Condition`, of which nothing is cloned.
        match self.failed() {
            // Nearly always: the same in less code.
            (broken, None, None) => out.add([broken.into(), 0, 0]),
            condition => out.put(&condition),
        }
    }
}

impl<N: Serialize + DeserializeOwned> Guarded<N> {
    /// A node of this name that is what was saved; nothing is counted of it.
    ///
    /// # Errors
    /// If the bytes are none of its state.
    pub fn recorded(
        name: &'static str,
        on_failure: OnFailure,
        from: &mut Loading<'_>,
    ) -> Result<Self> {
        let loaded =
            |from: &mut Loading<'_>| -> Result<(N, Condition)> { Ok((from.take()?, from.take()?)) };
        let (node, condition) =
            loaded(from).map_err(|error| error.context(format!("the state of `{name}`")))?;
        let mut node = Self::new(name, on_failure, node);
        node.set_condition(condition);
        node.hush();
        Ok(node)
    }
}

impl<P> Reader<P> {
    /// Saves which version of the parameters it shows.
    pub fn save_version(&self, out: &mut Saving<'_, '_>) {
        out.put(&self.view().cycle());
    }
}

impl<P: DeserializeOwned> Reader<P> {
    /// Makes it show the parameters that were saved, by way of a buffer that nobody else writes.
    ///
    /// # Errors
    /// If they are not there, or of another type.
    pub fn load_version(
        &mut self,
        from: &mut Loading<'_>,
        buffer: &mut Writer<P>,
        stored: &Stored<'_>,
    ) -> Result<()> {
        *buffer.slots().0 = stored.parameters(from)?;
        buffer.complete(buffer.newest().cycle + 1, Timestamp::ZERO);
        self.take();
        Ok(())
    }
}

impl<I: Outputs> Reader<Injected<I>> {
    /// Saves what clients replace, as serde writes an `Option` of it.
    pub fn save_injected(&self, out: &mut Saving<'_, '_>) {
        let values = self.view().value().get();
        out.add([values.is_some().into()]);
        if let Some(values) = values {
            values.save(out);
        }
    }
}

impl<I: Default + DeserializeOwned> Reader<Injected<I>> {
    /// Makes it show what clients replaced, by way of a buffer that nobody else writes.
    ///
    /// # Errors
    /// If the bytes are none of it.
    pub fn load_injected(
        &mut self,
        from: &mut Loading<'_>,
        buffer: &mut Writer<Injected<I>>,
    ) -> Result<()> {
        let values: Option<I> = from.take()?;
        *buffer.slots().0 = Injected {
            active: values.is_some(),
            values: values.unwrap_or_default(),
        };
        buffer.complete(buffer.newest().cycle + 1, Timestamp::ZERO);
        self.take();
        Ok(())
    }
}

impl<Request: Serialize, Response> Answerer<Request, Response> {
    /// Saves the call of this cycle.
    pub fn save(&self, out: &mut Saving<'_, '_>) {
        out.put(&self.request());
    }
}

impl<Request: DeserializeOwned, Response> Answerer<Request, Response> {
    /// Makes the call of this cycle what was saved; nobody waits for its answer.
    ///
    /// # Errors
    /// If the bytes are none of a request.
    pub fn load(&mut self, from: &mut Loading<'_>) -> Result<()> {
        self.ask(from.take()?);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use hulkgen_recording::Writing;

    use super::*;
    use crate::cycler::Cycle;
    use crate::error::Error;
    use crate::time::CycleTime;

    const CYCLE: Cycle = Cycle {
        number: 1,
        time: CycleTime {
            start: Timestamp::from_nanos(12_000_000),
            since_last: std::time::Duration::ZERO,
        },
        timed: false,
        in_setup: false,
        partial: false,
    };

    fn recorded(node: &Guarded<f32>) -> Vec<u8> {
        let mut room = [0; 200];
        let mut writing = Writing::new(&mut room);
        let mut saving = Saving::new(&mut writing);
        node.record(&mut saving);
        saving.end().expect("there is room");
        let length = writing.length();
        room[..length].to_vec()
    }

    /// The node and its condition are recorded, given back, and recorded again.
    fn assert_recorded(node: &Guarded<f32>, is_fine: bool) {
        let bytes = recorded(node);
        let expected = postcard::to_stdvec(&(node.node(), node.condition())).expect("bytes");
        assert_eq!(bytes, expected);
        assert_eq!(bytes.ends_with(&[0, 0]), is_fine, "{bytes:?}");
        let again = Guarded::recorded("node", OnFailure::Hold, &mut Loading::new(&bytes));
        assert_eq!(recorded(&again.expect("it was recorded")), bytes);
    }

    #[test]
    fn what_failures_left_behind_is_recorded() {
        let mut node = Guarded::new("node", OnFailure::Hold, 0.5_f32);
        assert_recorded(&node, true);
        let called = node.call_or_hold(&CYCLE, |_| Ok::<_, Error>(()));
        assert!(called.is_ok());
        assert_recorded(&node, false);
        node.replaced(&[true]);
        assert_recorded(&node, true);
        let called = node.call_or_hold(&CYCLE, |_| -> Result<()> { panic!("a test's") });
        assert!(called.is_ok());
        assert_recorded(&node, true);
        let renewed = node.renew_if_broken(|| Err(Error::new("no")));
        assert!(renewed.is_ok());
        assert_recorded(&node, false);
        node.renew(1.5);
        assert_recorded(&node, true);
    }
}
