//! The grammar of a node file: what stands in `CreationContext`, `CycleContext` and `MainOutputs`, and how `new`, `cycle`
//! and `restore` are written.
//!
//! The macro `#[context]` and the scanner of `hulkgen` read node files with this crate, so that an editor and the command
//! line never disagree. Nothing here panics on what an author writes: whatever cannot be read is a [`Mistake`] with the
//! place, what was expected, and the deed that mends it.

mod condition;
mod context;
mod field;
mod hints;
mod kind;
mod mistake;
mod nearest;
mod path;
pub mod signature;

pub use condition::{is_conditional, is_written_for_tests, only_for_tests};
pub use context::{
    AnyContext, Context, ContextKind, is_context_attribute, parse_context, structural_mistakes,
};
pub use field::{
    AnyField, CreationField, CycleField, Field, FromInstance, FromOutput, OutputField, Pathed,
    ProcedureName, ReadField, StatePath, option_argument, read_field,
};
pub use hints::{Hints, Range, documentation, is_hint_attribute};
pub use kind::kinds;
pub use mistake::{Mistake, Rule};
pub use nearest::nearest;
pub use path::{DataPath, Name, Segment, SegmentName};
pub use signature::{Meaning, Meanings, Signature, Signatures, find_node, find_node_with};
