//! The parameters of a robot: layers of TOML, merged field by field, each value with the place it comes from.
//!
//! Later layers win: `default.toml`, `<location>/default.toml`, `<identity>.<id>.toml` for each identity,
//! `<location>/<identity>.<id>.toml`, the environment (`HULK_PARAMETERS__a__b`), `--set a.b=value`. Tables merge; arrays and
//! all other values are replaced whole, and `key = { unset = true }` takes away what earlier layers say. Only `default.toml` has
//! to be there. [`Live`] is the last layer: what is changed while the robot runs.

mod combinations;
mod deserialize;
mod error;
mod exact;
mod given;
mod layers;
mod live;
mod nearest;
mod tree;

pub use error::{Fault, Origin, ParameterError};
pub use given::Given;
pub use layers::{Above, Layers, Parameters};
pub use live::{
    Leaf, Live, LiveParameters, Provenance, Reading, Refusal, Refusals, Stored, Unstored, Version,
};
pub use nearest::nearest;

use serde::de::DeserializeOwned;

use tree::Tree;

/// A type from the text of one TOML file; `name` is the file's in errors.
pub fn from_text<T: DeserializeOwned>(name: &str, text: &str) -> Result<T, ParameterError> {
    deserialize::deserialize(&tree::parse(name, text)?)
}

/// Where a text of TOML has the value at this path; `None`: nowhere.
pub(crate) fn place(name: &str, text: &str, path: &str) -> Option<Origin> {
    let tree = tree::parse(name, text).ok()?;
    Some(tree.get(path)?.origin.clone())
}

/// A type from a table; errors name the key.
pub fn from_table<T: DeserializeOwned>(table: &toml::Table) -> Result<T, ParameterError> {
    let origin = Origin::Unknown;
    deserialize::deserialize(&Tree::from_value(
        &toml::Value::Table(table.clone()),
        &origin,
    ))
}
