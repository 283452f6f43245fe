//! The reading side of a buffer: the newest complete cycle.

use super::slots::{Held, Newest, Slots};
use super::sync::Arc;
use super::view::View;

/// Reads the newest complete cycle. It holds its slot from one [`take`](Self::take) to the next, so
/// what it shows needs no guard and does not change in between.
pub struct Reader<T> {
    slots: Arc<Slots<T>>,
    held: Held,
    newest: Newest,
    is_new: bool,
}

impl<T> Reader<T> {
    pub(super) fn new(slots: Arc<Slots<T>>) -> Self {
        let (held, newest) = slots.hold_newest(slots.newest());
        Self {
            slots,
            held,
            newest,
            is_new: false,
        }
    }

    /// Lets go of the cycle it holds for the newest, if that is another one.
    #[inline]
    pub fn take(&mut self) {
        let newest = self.slots.newest();
        self.is_new = newest != self.newest;
        if self.is_new {
            // First the old one: a reader that held two would need one more slot.
            self.let_go();
            (self.held, self.newest) = self.slots.hold_newest(newest);
        }
    }

    /// What it holds: the newest cycle at the last [`take`](Self::take), before that the initial
    /// value.
    #[inline]
    pub fn view(&self) -> View<'_, T> {
        View::new(self.slots.read(&self.held), self.is_new)
    }

    #[inline]
    fn let_go(&mut self) {
        let held = std::mem::replace(&mut self.held, Held::NOWHERE);
        self.slots.release(held);
    }
}

impl<T> Drop for Reader<T> {
    fn drop(&mut self) {
        self.let_go();
    }
}
