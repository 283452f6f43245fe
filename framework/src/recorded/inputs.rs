//! Values of other instances: the newest one, and all in order of time.

use hulkgen_mcap::Layout;
use serde::{Deserialize, Serialize};

use super::trace::layout_of;
use super::{Loading, SaveError, Saving};
use crate::buffer::{Reader, Writer};
use crate::error::{Error, Result};
use crate::temporal::{Consumer, Lane};
use crate::time::Timestamp;

/// Gives the value that the instance wrote in the cycle of this number.
pub type Found<'a, T> = &'a mut dyn FnMut(u64) -> Result<T>;

/// An input from another instance.
pub trait Foreign<T> {
    /// Every cycle of the instance that the taking cycle sees, by its number and timestamp, oldest first.
    fn values(
        &self,
        visit: &mut dyn FnMut(u64, Timestamp, &T) -> Result<(), SaveError>,
    ) -> Result<(), SaveError>;

    /// Saves which cycles these are and how they are seen.
    fn save(&self, out: &mut Saving<'_, '_>);

    /// How [`Foreign::save`] writes it.
    fn layout() -> Layout
    where
        Self: Sized;

    /// Makes the input what was saved, by way of a buffer that nobody else writes.
    ///
    /// # Errors
    /// If the bytes are none of such an input, or a value is not found; what the input shows is then not defined.
    fn load(
        &mut self,
        from: &mut Loading<'_>,
        buffer: &mut Writer<T>,
        value: Found<'_, T>,
    ) -> Result<()>;
}

/// One cycle of another instance, as a frame names it.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
struct Named {
    cycle: u64,
    timestamp: Timestamp,
    /// Its place in the order of time; of the newest cycle its timestamp.
    order: Timestamp,
}

impl<T: Default> Foreign<T> for Reader<T> {
    fn values(
        &self,
        visit: &mut dyn FnMut(u64, Timestamp, &T) -> Result<(), SaveError>,
    ) -> Result<(), SaveError> {
        let view = self.view();
        match view.written() {
            Some(value) => visit(view.cycle(), view.timestamp(), value),
            None => Ok(()),
        }
    }

    fn save(&self, out: &mut Saving<'_, '_>) {
        let view = self.view();
        out.put(&Named {
            cycle: view.cycle(),
            timestamp: view.timestamp(),
            order: view.timestamp(),
        });
        out.put(&view.is_new());
    }

    fn layout() -> Layout {
        layout_of::<(Named, bool)>()
    }

    fn load(
        &mut self,
        from: &mut Loading<'_>,
        buffer: &mut Writer<T>,
        value: Found<'_, T>,
    ) -> Result<()> {
        let named: Named = from.take()?;
        let is_new: bool = from.take()?;
        *buffer.slots().0 = match named.cycle {
            // Nothing was written yet, while the slot may hold what a later cycle of the recording saw.
            0 => T::default(),
            cycle => value(cycle)?,
        };
        buffer.complete(named.cycle, named.timestamp);
        self.take();
        if !is_new {
            // Nothing came since.
            self.take();
        }
        Ok(())
    }
}

impl<T> Foreign<T> for Consumer<T> {
    fn values(
        &self,
        visit: &mut dyn FnMut(u64, Timestamp, &T) -> Result<(), SaveError>,
    ) -> Result<(), SaveError> {
        (0..self.visible()).try_for_each(|index| match self.entry(index) {
            Some((entry, _)) => visit(entry.cycle, entry.timestamp, &entry.value),
            None => Ok(()),
        })
    }

    fn save(&self, out: &mut Saving<'_, '_>) {
        out.put(&(self.persistent() as u32));
        out.put(&(self.visible() as u32));
        for (entry, order) in (0..self.visible()).filter_map(|index| self.entry(index)) {
            out.put(&Named {
                cycle: entry.cycle,
                timestamp: entry.timestamp,
                order,
            });
        }
    }

    fn layout() -> Layout {
        layout_of::<(u32, Vec<Named>)>()
    }

    fn load(
        &mut self,
        from: &mut Loading<'_>,
        buffer: &mut Writer<T>,
        value: Found<'_, T>,
    ) -> Result<()> {
        let persistent: u32 = from.take()?;
        let seen: u32 = from.take()?;
        self.forget();
        for _ in 0..seen {
            let Named {
                cycle,
                timestamp,
                order,
            } = from.take()?;
            *buffer.slots().0 = value(cycle)?;
            buffer.complete(cycle, timestamp);
            if !self.take_at(order) {
                return Err(Error::new(format!(
                    "a cycle sees {seen} cycles of an instance, more than its queue has room for: the recording is of \
                     another manifest"
                )));
            }
        }
        self.show(persistent as usize);
        Ok(())
    }
}
