//! Back to default without giving heap memory away: what happens to an output before a node writes it in place.

mod hashed;
mod standard;

/// A value that takes another without giving its own heap memory away.
///
/// Derived with `#[derive(Clear)]`: structs field by field, enums as a whole. By hand, `impl Clear for T {}` is enough for
/// a type that owns no heap memory.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement `Clear`",
    label = "cannot be written in place",
    note = "add `#[derive(Clear)]` (`use framework::Clear`) to a type that stands in `MainOutput` of a `CycleContext`"
)]
pub trait Clear: Sized {
    /// Becomes its default: numbers zero, lists and texts empty with their capacity kept.
    fn clear(&mut self)
    where
        Self: Default,
    {
        self.assign(Self::default());
    }

    /// Becomes `value`, and keeps heap capacity where it can.
    fn assign(&mut self, value: Self) {
        *self = value;
    }
}
