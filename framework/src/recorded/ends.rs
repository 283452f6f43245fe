//! Nodes, parameters, injections and calls: what a cycle has at its ends beside values of other instances.

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Loading, SaveError, Saving, Stored};
use crate::buffer::{Reader, Writer};
use crate::error::Result;
use crate::guarded::{Condition, Guarded, OnFailure, State};
use crate::injection::Injected;
use crate::procedure::Answerer;
use crate::time::Timestamp;

impl<N: Serialize> Guarded<N> {
    /// Saves the node's state and what its failures left behind.
    ///
    /// # Errors
    /// If there is no room, or the state cannot be serialised.
    pub fn record(&self, out: &mut Saving<'_, '_>) -> Result<(), SaveError> {
        out.put(self.node())?;
        let (broken, not_renewed, good_at) = self.failed();
        // As `Condition`, of which nothing is cloned.
        out.put(&(broken, not_renewed, good_at))
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
    ///
    /// # Errors
    /// If there is no room.
    pub fn save_version(&self, out: &mut Saving<'_, '_>) -> Result<(), SaveError> {
        out.put(&self.view().cycle())
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

impl<I: Serialize> Reader<Injected<I>> {
    /// Saves what clients replace.
    ///
    /// # Errors
    /// If there is no room, or a value cannot be serialised.
    pub fn save_injected(&self, out: &mut Saving<'_, '_>) -> Result<(), SaveError> {
        out.put(&self.view().value().get())
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
    ///
    /// # Errors
    /// If there is no room, or the request cannot be serialised.
    pub fn save(&self, out: &mut Saving<'_, '_>) -> Result<(), SaveError> {
        out.put(&self.request())
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
