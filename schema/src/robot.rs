//! The manifest as a whole, the robot, and its targets.

use camino::Utf8PathBuf;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::bridge::Bridge;
use crate::cycler::Cycler;
use crate::deploy::Deploy;
use crate::length::Size;
use crate::spelling::{HardwarePath, IdentityName, RobotName, TargetName};

/// `hulk.toml`: a robot, its cyclers with their nodes, and the targets it runs on.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// The robot.
    pub robot: Robot,
    /// Nodes that a driver runs again and again.
    #[serde(default)]
    pub cycler: Vec<Cycler>,
    /// Binaries with their hardware; the first is the default.
    #[serde(default)]
    pub target: Vec<Target>,
    /// What a bridge maps to keys of Zenoh; only a bridge that somebody starts reads it.
    #[serde(default)]
    pub bridge: Vec<Bridge>,
}

/// The robot: its name and its folders.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Robot {
    /// Name of the robot in snake_case; the generated package is called `<name>_runtime`.
    pub name: RobotName,
    /// Folder of the generated crate, relative to the workspace root.
    #[serde(default = "generated", with = "folder")]
    #[schemars(with = "String")]
    pub generated: Utf8PathBuf,
    /// Folder of the parameter files, relative to the workspace root.
    #[serde(default = "parameters", with = "folder")]
    #[schemars(with = "String")]
    pub parameters: Utf8PathBuf,
    /// Parts of the robot that report an id each, for example `body` and `head`: parameter layers, in this order.
    #[serde(default)]
    pub identities: Vec<IdentityName>,
    /// How much a robot keeps of its recordings before the oldest are overwritten, for example "2GiB".
    #[serde(default = "recording_budget")]
    pub recording_budget: Size,
}

/// A binary with its hardware: `generated/src/bin/<name>.rs` behind the feature `target-<name>`.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Target {
    /// Name of the target; lower case, hyphens allowed.
    pub name: TargetName,
    /// Path of the type that serves the hardware traits, for example `simulated_nao::Hardware`.
    pub hardware: HardwarePath,
    /// Target triple, perhaps with a version of glibc: `x86_64-unknown-linux-gnu.2.28`. Left out: the host.
    #[serde(default)]
    pub triple: Option<String>,
    /// CPU to compile for, as in `-C target-cpu`.
    #[serde(default)]
    pub cpu: Option<String>,
    /// Cargo profile. Left out: `release`; without `triple` that of hulkgen itself, which is `release` where it was installed.
    #[serde(default)]
    pub profile: Option<String>,
    /// Default location of its parameters: a folder below the robot's `parameters`.
    #[serde(default)]
    pub location: Option<String>,
    /// How its program gets onto robots. Left out: by other means than `hulkgen deploy`.
    #[serde(default)]
    pub deploy: Option<Deploy>,
}

fn generated() -> Utf8PathBuf {
    "generated".into()
}

fn parameters() -> Utf8PathBuf {
    "parameters".into()
}

fn recording_budget() -> Size {
    Size::from_gibibytes(2)
}

/// Folders as text: camino's own serde feature would give serde another feature set than the robot's.
mod folder {
    use camino::{Utf8Path, Utf8PathBuf};
    use serde::{Deserialize as _, Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(
        folder: &Utf8Path,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(folder.as_str())
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Utf8PathBuf, D::Error> {
        String::deserialize(deserializer).map(Utf8PathBuf::from)
    }
}
