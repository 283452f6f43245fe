//! What a type must be able to do that nodes exchange, keep or are set by.

use std::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::reflect::Reflect;

/// Main outputs, additional outputs and cycler states.
///
/// Nothing to implement: it is what these derives together make.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be an output or a cycler state",
    label = "outputs and cycler states are copied, shown, recorded and sent between threads",
    note = "it needs `#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]` and no `Rc`, `Cell` or reference inside"
)]
pub trait Data:
    Clone + Debug + Default + DeserializeOwned + Reflect + Send + Serialize + Sync + 'static
{
}

/// Parameters, and requests and responses of procedures: [`Data`] without a default.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be a parameter, request or response",
    label = "these are copied, shown, recorded and sent between threads",
    note = "it needs `#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]` and no `Rc`, `Cell` or reference inside"
)]
pub trait ParameterData:
    Clone + Debug + DeserializeOwned + Reflect + Send + Serialize + Sync + 'static
{
}

/// The state struct of a node: recorded, and restored for a replay.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be a node",
    label = "the state of a node is recorded, restored and moved to the thread of its cycler",
    note = "it needs `#[derive(Deserialize, Serialize)]`; mark fields that have no serde form with `#[serde(skip)]` and give the node a `restore`"
)]
pub trait NodeState: DeserializeOwned + Send + Serialize + 'static {}

impl<T> Data for T where
    T: Clone + Debug + Default + DeserializeOwned + Reflect + Send + Serialize + Sync + 'static
{
}

impl<T> ParameterData for T where
    T: Clone + Debug + DeserializeOwned + Reflect + Send + Serialize + Sync + 'static
{
}

impl<T> NodeState for T where T: DeserializeOwned + Send + Serialize + 'static {}

/// What `#[context]` writes beside a struct, so that a missing derive is told at the type's place.
#[doc(hidden)]
pub mod require {
    use super::{Data, ParameterData};
    use crate::clear::Clear;

    pub const fn data<T: Data>() {}
    pub const fn parameter_data<T: ParameterData>() {}
    pub const fn data_in_place<T: Data + Clear>() {}
}
