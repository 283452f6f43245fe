//! Values of clients in place of main outputs.
//!
//! A client writes a table of [`Injection`]s through [`Inject`]; the instance takes it in `begin` and each node function
//! replaces its outputs right after the node. Without clients that is one load per cycle.

use std::collections::BTreeSet;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::buffer::Writer;
use crate::error::{Error, Result};
use crate::parameters::Given;
use crate::time::Timestamp;

/// The value of one output, if a client replaces it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Injection<T>(Option<T>);

/// The injections of one instance, as its cycle takes them.
#[derive(Clone, Debug, Default)]
pub struct Injected<I> {
    /// Whether any output is replaced.
    pub active: bool,
    /// One [`Injection`] per main output.
    pub values: I,
}

/// A generated struct of [`Injection`]s, by the names of the outputs.
pub trait InjectionTable {
    /// The injection of this output.
    fn get_mut(&mut self, output: &str) -> Option<&mut dyn InjectionCell>;
}

/// One injection, whatever the type of its output.
pub trait InjectionCell {
    /// From now on the output has this value; on an error it keeps what it had.
    fn set(&mut self, value: &Given<'_>) -> Result<()>;
    /// From now on the output is the node's again.
    fn release(&mut self);
}

/// How clients replace outputs of one instance; what they write counts from its next `begin` on.
pub trait Inject: Send {
    /// Replaces an output until it is released.
    fn inject(&mut self, output: &str, value: &Given<'_>) -> Result<()>;
    /// Gives an output back to its node.
    fn release(&mut self, output: &str) -> Result<()>;
    /// Gives all outputs back.
    fn release_all(&mut self);
}

/// The writing end of the injections of one instance.
pub struct Injector<I> {
    writer: Writer<Injected<I>>,
    version: u64,
    /// Names of the outputs that are replaced now.
    replaced: BTreeSet<String>,
}

impl<T> Default for Injection<T> {
    fn default() -> Self {
        Self(None)
    }
}

impl<T> Injection<T> {
    /// The client's, if there is one.
    pub(crate) fn value(&self) -> Option<&T> {
        self.0.as_ref()
    }
}

impl<T: Clone> Injection<T> {
    /// Puts the client's value, if there is one, in place of `output`, and tells whether it did; heap capacity of `output` is
    /// kept.
    #[inline]
    pub fn replace(&self, output: &mut T) -> bool {
        if let Self(Some(value)) = self {
            output.clone_from(value);
        }
        self.0.is_some()
    }
}

impl<T: DeserializeOwned> InjectionCell for Injection<T> {
    fn set(&mut self, value: &Given<'_>) -> Result<()> {
        self.0 = Some(value.read()?);
        Ok(())
    }

    fn release(&mut self) {
        self.0 = None;
    }
}

impl<I> Injected<I> {
    /// The table, if any output is replaced.
    #[inline]
    pub fn get(&self) -> Option<&I> {
        self.active.then_some(&self.values)
    }
}

impl<I: InjectionTable + Clone> Injector<I> {
    /// Writes what the instance's reader takes.
    pub fn new(writer: Writer<Injected<I>>) -> Self {
        Self {
            writer,
            version: 0,
            replaced: BTreeSet::new(),
        }
    }

    /// Writes a new version of the table; none if `change` fails.
    fn change(
        &mut self,
        output: &str,
        change: impl FnOnce(&mut dyn InjectionCell) -> Result<()>,
    ) -> Result<()> {
        let (next, current) = self.writer.slots();
        next.values.clone_from(&current.values);
        let cell = next
            .values
            .get_mut(output)
            .ok_or_else(|| Error::new(format!("`{output}` is no main output of this instance")))?;
        change(cell)
    }

    fn publish(&mut self) {
        self.writer.slots().0.active = !self.replaced.is_empty();
        self.version += 1;
        self.writer.complete(self.version, Timestamp::ZERO);
    }
}

impl<I: InjectionTable + Clone + Send + Sync> Inject for Injector<I> {
    fn inject(&mut self, output: &str, value: &Given<'_>) -> Result<()> {
        self.change(output, |cell| cell.set(value))
            .map_err(|error| error.context(format!("cannot inject `{output}`")))?;
        self.replaced.insert(output.to_owned());
        self.publish();
        Ok(())
    }

    fn release(&mut self, output: &str) -> Result<()> {
        self.change(output, released)?;
        self.replaced.remove(output);
        self.publish();
        Ok(())
    }

    fn release_all(&mut self) {
        for output in std::mem::take(&mut self.replaced) {
            // What was injected once is in the table; an unknown name could not have come here.
            if self.change(&output, released).is_ok() {
                self.publish();
            }
        }
    }
}

fn released(cell: &mut dyn InjectionCell) -> Result<()> {
    cell.release();
    Ok(())
}
