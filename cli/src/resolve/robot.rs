//! The robot with every name bound to what it means: what stage ③ makes and all later stages read.
//!
//! Invariant: no file is needed any more to understand it, and nothing in it is undecided.

mod read;
mod users;

use std::collections::BTreeMap;
use std::time::Duration;

use camino::Utf8PathBuf;
use serde::Serialize;

pub use crate::scan::traits::{Answer, Interface, Method};
pub use read::OutputRead;
pub use users::{Reader, StateUse, Writer};

/// A robot: its cyclers, what they exchange, and the targets it runs on.
#[derive(Clone, Debug, Serialize)]
pub struct Robot {
    pub name: String,
    /// Folder of the generated crate, relative to the workspace root.
    pub generated: Utf8PathBuf,
    /// Folder of the parameter files, relative to the workspace root.
    pub parameters: Utf8PathBuf,
    pub identities: Vec<String>,
    /// Bytes that a recording keeps before its oldest part goes.
    pub recording_budget: u64,
    /// In manifest order, also those that a partial robot does without.
    pub cyclers: Vec<Cycler>,
    /// What makes it a partial robot; `None`: it is whole.
    pub partial: Option<Partial>,
    pub targets: Vec<Target>,
    /// What bridges to other machines map, in manifest order.
    pub bridges: Vec<Bridge>,
    /// Every declared parameter path, instances expanded, sorted by path.
    pub parameter_tree: Tree<Reader>,
    /// What is known about declared parameters besides their types, by path.
    pub parameter_hints: BTreeMap<String, Hints>,
    /// Crates that generated code names, sorted by name: node crates, crates of exchanged types.
    pub crates: Vec<Dependency>,
    /// Keys of the workspace's `[workspace.package]`, sorted: packages may inherit them.
    pub inherited: Vec<String>,
    /// Edges whose types could not be resolved fully and are left to rustc.
    pub left_to_rustc: usize,
    /// What else only rustc can judge: what is conditional, and what macros and other crates define.
    #[serde(skip)]
    pub besides_edges: usize,
}

/// A robot of some cyclers, to be driven by a test, a simulator or a tool: it has no targets.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Partial {
    /// Names of its cyclers, in manifest order.
    pub only: Vec<String>,
    /// Its folder, where that is not the one that follows from the names.
    pub output: Option<Utf8PathBuf>,
}

/// A crate that the generated crate depends on.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Dependency {
    /// As written in `use`: the library's name.
    pub name: String,
    /// The left side of its line in `[dependencies]`: `name`, unless the package says it with `-`.
    pub key: String,
    /// The right side of its line in `[dependencies]`, for example `{ workspace = true }`.
    pub requirement: String,
    /// Only behind the feature of these targets.
    pub targets: Vec<String>,
}

/// A binary with its hardware.
#[derive(Clone, Debug, Serialize)]
pub struct Target {
    pub name: String,
    /// Absolute path of the hardware type, for example `simulated_nao::Hardware`.
    pub hardware: String,
    pub triple: Option<String>,
    pub cpu: Option<String>,
    pub profile: Option<String>,
    pub location: Option<String>,
}

/// Something that a bridge gives a key.
#[derive(Clone, Debug, Serialize)]
pub struct Bridge {
    /// As clients write it.
    pub path: String,
    pub kind: BridgeKind,
    /// Its type, where it is a value and can be told.
    pub data: Option<String>,
    pub key: String,
    /// Of values and remote instances; procedures have none.
    pub direction: Option<schema::Direction>,
    pub encoding: schema::BridgeEncoding,
    /// Values in a second, at most.
    pub rate: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BridgeKind {
    MainOutput,
    AdditionalOutput,
    Parameter,
    Procedure,
    /// An instance that another machine runs.
    Remote,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum CyclerKind {
    Perception,
    RealTime,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum OnFailure {
    #[default]
    Stop,
    Restart,
    Skip,
    Hold,
}

impl Robot {
    /// Its cyclers that run, by their position.
    pub fn running(&self) -> impl Iterator<Item = (usize, &Cycler)> {
        let cyclers = self.cyclers.iter().enumerate();
        cyclers.filter(|(_, cycler)| !cycler.left_out)
    }

    /// The command that writes its generated crate.
    pub fn command(&self) -> String {
        let options = self
            .partial
            .as_ref()
            .map_or_else(Vec::new, Partial::options);
        let words = ["hulkgen", "generate"].map(str::to_owned);
        words
            .into_iter()
            .chain(options)
            .collect::<Vec<_>>()
            .join(" ")
    }
}

impl BridgeKind {
    /// Whether cycles write it.
    pub fn is_output(self) -> bool {
        matches!(self, Self::MainOutput | Self::AdditionalOutput)
    }

    /// For messages.
    pub fn words(self) -> &'static str {
        match self {
            Self::MainOutput => "main output",
            Self::AdditionalOutput => "additional output",
            Self::Parameter => "parameter",
            Self::Procedure => "procedure",
            Self::Remote => "remote instance",
        }
    }
}

impl Partial {
    /// The options of `hulkgen generate` that write it.
    pub fn options(&self) -> Vec<String> {
        let mut options = vec!["--only".to_owned(), self.only.join(",")];
        if let Some(output) = &self.output {
            options.extend(["--output".to_owned(), output.to_string()]);
        }
        options
    }
}

impl OnFailure {
    /// As the manifest writes it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stop => "stop",
            Self::Restart => "restart",
            Self::Skip => "skip",
            Self::Hold => "hold",
        }
    }
}

/// Nodes that a driver runs again and again.
#[derive(Clone, Debug, Serialize)]
pub struct Cycler {
    /// UpperCamelCase, as in the manifest.
    pub name: String,
    /// It does not run here: its nodes are known by name alone, they read nothing and ask for nothing. Its outputs are
    /// those that others read, and come from outside.
    pub left_out: bool,
    /// Another machine runs it and feeds what the robot reads of it.
    pub remote: bool,
    pub kind: CyclerKind,
    /// In manifest order; at least one.
    pub instances: Vec<Instance>,
    /// Setup nodes first, then nodes, both in manifest order.
    pub nodes: Vec<Node>,
    /// Every main output of its nodes, sorted by name.
    pub outputs: Vec<Output>,
    pub additional_outputs: Tree<Writer>,
    pub states: Tree<StateUse>,
    pub on_failure: OnFailure,
    pub pending_timeout: Duration,
    pub queue: usize,
    pub watchdog: Duration,
    pub history: Duration,
    pub lockstep_duration: Option<Duration>,
}

/// One running copy of a cycler.
#[derive(Clone, Debug, Serialize)]
pub struct Instance {
    /// Cycler name and suffix: `VisionTop`.
    pub name: String,
    pub deadline: Option<Duration>,
    pub scheduling: Scheduling,
    pub record: Record,
}

/// Which cycles are recorded.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Record {
    #[default]
    On,
    Off,
    /// Every so many cycles one.
    Every(u32),
    /// Those in which an output is true.
    While(Condition),
}

/// A `bool` among the outputs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Condition {
    /// `None`: the recorded instance's own output.
    pub instance: Option<InstanceId>,
    /// Position of the node that writes it in its cycler.
    pub producer: usize,
    pub access: Access,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Scheduling {
    /// `fifo`, `round-robin` or nothing for the system's.
    pub policy: Option<String>,
    pub priority: Option<u8>,
    pub cores: Vec<usize>,
}

#[derive(Clone, Debug, Serialize)]
pub struct Node {
    /// As in the manifest: `vision::ball_detection`; also its module's absolute path.
    pub path: String,
    /// Name of the state struct.
    pub type_name: String,
    pub setup: bool,
    pub on_failure: OnFailure,
    /// Relative to the workspace root.
    pub file: Utf8PathBuf,
    /// First sentence of the file's documentation, if any.
    pub summary: Option<String>,
    pub creation: Vec<Field<CreationBinding>>,
    pub cycle: Vec<Field<CycleBinding>>,
    pub outputs: Vec<Field<OutputBinding>>,
    /// Whether the node has `restore`.
    pub restores: bool,
    pub new_bounds: Vec<Interface>,
    pub cycle_bounds: Vec<Interface>,
    pub restore_bounds: Vec<Interface>,
    /// `Send`, `Sync` and `'static`, as far as any of them asks for it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub markers: Vec<String>,
}

/// A field of one of the three contexts.
#[derive(Clone, Debug, Serialize)]
pub struct Field<B> {
    pub name: String,
    pub binding: B,
    /// Line of the field in the node's file, from 1.
    pub line: usize,
    /// Byte range of the field's type in the node's file.
    pub range: std::ops::Range<usize>,
}

/// A type as the generated crate names it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct DataType {
    /// Absolute, prelude types by bare name: `Vec<types::ball::Ball>`.
    pub text: String,
    /// Whether every name in it was resolved to a definition.
    pub resolved: bool,
}

/// A path below a value: fields, each perhaps an `Option` that is looked into.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Access {
    /// First is the output, state or parameter root; never empty.
    pub segments: Vec<Segment>,
    /// The written path, with `?` and `$cycler_instance`.
    pub written: String,
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Segment {
    pub name: String,
    /// `?` stands behind it.
    pub optional: bool,
    /// It was `$cycler_instance`; `name` is then `cycler_instance`.
    pub instance: bool,
}

#[derive(Clone, Debug, Serialize)]
pub enum CreationBinding {
    Parameter {
        access: Access,
        data: DataType,
    },
    CyclerState {
        access: Access,
        data: DataType,
        shared: bool,
    },
    HardwareInterface,
}

/// What a field of the cycle context is filled with. `data` is the type as written.
#[derive(Clone, Debug, Serialize)]
pub enum CycleBinding {
    /// This cycle's output of the own cycler.
    OwnOutput {
        access: Access,
        data: DataType,
        producer: usize,
        checked: bool,
    },
    /// As `OwnOutput`; the node is skipped while something on the path is absent.
    RequiredOwnOutput {
        access: Access,
        data: DataType,
        producer: usize,
        checked: bool,
    },
    /// Latest finished database of another instance (or of the own cycler's other instance).
    OutputOf {
        instance: InstanceId,
        access: Access,
        data: DataType,
        producer: usize,
        checked: bool,
    },
    RequiredOutputOf {
        instance: InstanceId,
        access: Access,
        data: DataType,
        producer: usize,
        checked: bool,
    },
    Latest {
        instance: InstanceId,
        access: Access,
        data: DataType,
        producer: usize,
        checked: bool,
    },
    Previous {
        access: Access,
        data: DataType,
        producer: usize,
        checked: bool,
    },
    Historic {
        access: Access,
        data: DataType,
        producer: usize,
        checked: bool,
    },
    /// One instance, or all instances of a cycler interleaved (`interleaved`).
    Perception {
        instances: Vec<InstanceId>,
        interleaved: bool,
        access: Access,
        data: DataType,
        producer: usize,
        checked: bool,
    },
    Parameter {
        access: Access,
        data: DataType,
    },
    CyclerState {
        access: Access,
        data: DataType,
        shared: bool,
    },
    CycleTime,
    AdditionalOutput {
        access: Access,
        data: DataType,
    },
    Procedure {
        name: String,
        request: DataType,
        response: DataType,
    },
    HardwareInterface,
    /// A main output written in place.
    MainOutput {
        data: DataType,
    },
}

/// What a field of `MainOutputs` is.
#[derive(Clone, Debug, Serialize)]
pub enum OutputBinding {
    MainOutput { data: DataType },
    CaptureTime,
}

/// An instance by position: cycler in the robot, instance in the cycler.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct InstanceId {
    pub cycler: usize,
    pub instance: usize,
}

/// A main output of a cycler.
#[derive(Clone, Debug, Serialize)]
pub struct Output {
    pub name: String,
    pub data: DataType,
    /// Position in `Cycler::nodes` of the node that writes it.
    pub producer: usize,
    pub in_place: bool,
    /// Another instance reads it (latest or perception), so it lives in the slots.
    pub shared: bool,
    /// Some node reads it as historic.
    pub historic: bool,
    /// Some node reads it as previous, or its producer holds.
    pub previous: bool,
}

/// Declared paths of one tree (parameters, states, additional outputs), sorted by name.
#[derive(Clone, Debug, Serialize)]
pub struct Tree<U> {
    pub branches: Vec<Branch<U>>,
    /// Values of nodes that a partial robot does without may stand beside the branches.
    pub open: bool,
}

#[derive(Clone, Debug, Serialize)]
pub struct Branch<U> {
    pub name: String,
    pub content: Content<U>,
}

#[derive(Clone, Debug, Serialize)]
pub enum Content<U> {
    /// A declared value, and who uses it (also those who use a field below it).
    Leaf {
        data: DataType,
        users: Vec<U>,
    },
    Inner(Tree<U>),
    /// In the parameter tree: the shared shape of one cycler's instances (`$cycler_instance`).
    Instance {
        cycler: usize,
        tree: Tree<U>,
    },
}

/// What is known about a parameter besides its type.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Hints {
    /// `unit = "m/s"` of a field that reads it.
    pub unit: Option<String>,
    /// `range = 0.0..=1.0` of a field that reads it.
    pub range: Option<String>,
    /// Nodes read it only when they are created.
    pub creation_only: bool,
}
