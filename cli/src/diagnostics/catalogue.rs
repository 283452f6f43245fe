//! Every diagnostic once: code, severity, title, explanation.

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The robot cannot be generated or cannot run.
    Error,
    /// It can, but it is probably not what the author wants.
    Warning,
}

impl Severity {
    /// As in `check --format json`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
        }
    }
}

/// Writes the enum and its table from one list, so that a code cannot miss its page.
macro_rules! catalogue {
    ($($variant:ident, $name:literal, $severity:ident, $title:literal, $explanation:literal;)*) => {
        /// What a diagnostic is about; its name is what a person searches for.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Code {
            $(#[doc = $title] $variant,)*
        }

        impl Code {
            /// Every code, sorted by name.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// Kebab-case name, for example `unknown-output`.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// Whether it is an error or a warning.
            pub fn severity(self) -> Severity {
                match self { $(Self::$variant => Severity::$severity,)* }
            }

            /// One sentence that says what is wrong.
            pub fn title(self) -> &'static str {
                match self { $(Self::$variant => $title,)* }
            }

            /// A paragraph: why it is wrong and how it is mended.
            pub fn explanation(self) -> &'static str {
                match self { $(Self::$variant => $explanation,)* }
            }

            /// The code of this name.
            pub fn from_name(name: &str) -> Option<Self> {
                match name { $($name => Some(Self::$variant),)* _ => None }
            }
        }
    };
}

catalogue! {
    ActuatorTakesDefault, "actuator-takes-default", Warning,
        "An actuator may receive a command that nobody computed.",
        "A node that writes to the hardware takes a main output as plain `Input`. When the node that writes this output is skipped or fails, the output is its default, and the default is sent to the actuators as if it were a command. Let the output be an `Option` and take it as `RequiredInput<Option<T>, \"path?\">`: then the actuator's node is skipped, too.";
    CaptureTime, "capture-time", Error,
        "The capture time of a cycle is given at the wrong place or twice.",
        "`CaptureTime` says when the data of a cycle was taken and becomes the cycle's timestamp. It is known once the setup nodes have waited for the data, so only a setup node may give it, and at most one of a cycler.";
    DependencyCycle, "dependency-cycle", Error,
        "Nodes of a cycler wait for each other.",
        "Nodes run in an order in which everything is written before it is read. Nodes whose inputs form a ring have no such order. Read one of the outputs with `PreviousInput`: it gives the value of the last finished cycle and orders nothing.";
    DuplicateName, "duplicate-name", Error,
        "Two things have one name.",
        "Cyclers, instances and targets are found by name, a node stands at most once in a cycler, and instances are unique in the whole robot. Names that differ only in how words are joined (`BallFilter`, `Ballfilter`) may also meet in one file or field of the generated crate. Rename or remove one of the two.";
    DuplicateOutput, "duplicate-output", Error,
        "Two nodes of one cycler write one output.",
        "A main output is declared once and unique in its cycler, and so is an additional output, which also may not lie below another. Otherwise readers could not know whose value they see. Rename one of the two, or let one node read what the other wrote.";
    DuplicateProcedure, "duplicate-procedure", Error,
        "Two nodes of one cycler answer one procedure.",
        "A call has one answer, so a procedure's name is unique in its cycler. Rename one of the two.";
    HardwareReadOutsideSetup, "hardware-read-outside-setup", Warning,
        "A node that is no setup node reads from the hardware.",
        "A hardware trait is reading if one of its methods returns anything but `()` or `Result<()>`. What setup nodes read is recorded and stands in for the hardware in a replay; what another node reads in its cycle is not, so that node cannot be replayed. Read in a setup node and hand the value on as a main output.";
    InvalidContext, "invalid-context", Error,
        "One of the three structs of a node is not as it has to be.",
        "A node file has three public structs with named fields and the attribute `#[context]`: `CreationContext`, `CycleContext` and `MainOutputs`, each also where it is empty. They have no parameters of their own: `#[context]` adds the lifetime and the hardware interface.";
    InvalidField, "invalid-field", Error,
        "A field of a context has a type that is no kind, or a kind with wrong arguments.",
        "Every field of `CreationContext`, `CycleContext` and `MainOutputs` is written as a kind: `Input<T, \"path\">`, `Parameter<T, \"path\">`, `MainOutput<T>` and so on. Types come first, then the instance's name where there is one, then the path, both as string literals.";
    InvalidName, "invalid-name", Error,
        "A name is not spelled as it has to be.",
        "Names become identifiers of the generated crate. Cyclers and instance suffixes are UpperCamelCase, robots and identities are snake_case, targets may have hyphens, nodes are written `crate::module::path`. Rust's keywords are no names, also not in snake_case.";
    InvalidPath, "invalid-path", Error,
        "A data path cannot be read.",
        "A path is a list of field names joined by `.`, each followed by `?` if that field is an `Option` to look into. `$cycler_instance` may stand once in the path of a `Parameter` or an `AdditionalOutput`. Paths of cycler states and additional outputs have no `?`. A parameter's path does not begin with `hardware`, which belongs to the targets, and Rust's keywords stand in no path.";
    InvalidSignature, "invalid-signature", Error,
        "`new`, `cycle` or `restore` is not written as a node's functions are.",
        "A node has `pub fn new(context: CreationContext) -> Result<Self>`, `pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs>` and, where its state has fields that are not stored, `pub fn restore(&mut self, context: CreationContext) -> Result<()>`. What it asks of the hardware is written as `CycleContext<impl Trait>`. Exactly one type of the file has them.";
    InvalidValue, "invalid-value", Error,
        "A value of the manifest or of parameters.toml is not what its key takes.",
        "The manifest's keys and their values are described by `hulkgen schema` and in the documentation. Durations are strings such as \"33ms\" or \"1.5s\", sizes such as \"2GiB\". The `generated` folder lies below the workspace root and shares nothing with the parameters and with other packages, because whatever hulkgen does not write is removed from it.";
    MeasurementTakesDefault, "measurement-takes-default", Warning,
        "A perception input may receive a default in place of a measurement.",
        "The node that writes this output has `on_failure = \"skip\"`. When it fails, the cycle is completed all the same and its output is delivered with its default value, which the reader cannot tell from a measurement. Let the output be an `Option`, or let the node hold or stop.";
    MisplacedKind, "misplaced-kind", Error,
        "A kind stands where it has no meaning.",
        "Not every kind has a meaning everywhere: `HistoricInput` and `PerceptionInput` need a real-time cycler, a `PerceptionInput` reads perception instances, setup nodes run before the inputs of a cycle are taken and may have only `Parameter`, `CyclerState`, `HardwareInterface`, `AdditionalOutput`, outputs, and `Input` from setup nodes.";
    MissingContext, "missing-context", Error,
        "A node file lacks one of its three structs.",
        "Every node file has `CreationContext`, `CycleContext` and `MainOutputs`, each with the attribute `#[context]`, also where a struct is empty.";
    MissingDerive, "missing-derive", Error,
        "A node's state cannot be stored.",
        "A node's struct is recorded and restored, so it derives (or implements) `Serialize` and `Deserialize`. Fields that cannot be stored get `#[serde(skip)]`, and the node a `restore` that rebuilds them.";
    MissingKey, "missing-key", Error,
        "The manifest lacks a key.",
        "Some keys of the manifest have no default: a robot, a cycler and a target have a name, a cycler has a kind, a target has a hardware type.";
    MissingNode, "missing-node", Error,
        "A node file has no node.",
        "The node of a file is the type whose `impl` has `new(context: CreationContext)` and `cycle(&mut self, context: CycleContext)`. Exactly one type of the file has both.";
    MissingParameter, "missing-parameter", Error,
        "No parameter file gives a value that a node reads.",
        "Every path that a `Parameter` declares needs a value in `default.toml`, in the target's location, or in a layer of one of the robot's identities. Fields of type `Option` and fields with `#[serde(default)]` may be left out.";
    MissingParameterFile, "missing-parameter-file", Error,
        "A parameter file does not exist.",
        "Parameters come from `default.toml` in the folder that the manifest names, and from `<location>/default.toml` for the location that a target or `parameters.toml` names. Create the file, or name another folder or location.";
    MistypedParameter, "mistyped-parameter", Error,
        "A parameter file has a value of the wrong type.",
        "A value has the type of the field that reads it: numbers for numbers, tables for structs, the name of a variant for an enum without data. Only what can be seen without rustc is checked here; the rest is validated when the robot starts.";
    NotPublic, "not-public", Error,
        "Generated code cannot name something because it is private.",
        "The generated crate is a crate of its own: it can name a node's module, its struct and the types of its outputs, states and parameters only if they are public, with every module on the way. Write `pub`, or re-export the item with `pub use`.";
    OptionMismatch, "option-mismatch", Error,
        "`?` in a path and `Option` in a type disagree.",
        "Without `?` the written type is the type at the end of the path, also if that is an `Option`. With `?` it is written `Option<T>` where the path ends in a `T`, or in an `Option<T>` whose last segment has the `?`. One `?` removes one `Option` and stands only behind an `Option`; however many there are, the node sees one.";
    OverlappingStates, "overlapping-states", Error,
        "A context borrows one cycler state twice.",
        "Within one context the paths of cycler states may not overlap: neither the same path nor a path below another, unless all of them only read (`&T`). The node could otherwise change a value through one field while it holds the other.";
    ParameterConflict, "parameter-conflict", Error,
        "Two nodes declare one parameter differently.",
        "There is one parameter tree for the whole robot. Two declarations of one path have the same type, and where one path lies below another, the lower is a field of the upper's type. `?` does not change the type at a path.";
    SetupOrder, "setup-order", Error,
        "A setup node reads what is only written after it.",
        "Setup nodes run before all other nodes of their cycler, so a setup node can read only outputs of setup nodes. Make the writer a setup node, or the reader a node.";
    StateConflict, "state-conflict", Error,
        "Two nodes declare one cycler state differently.",
        "Two declarations of one cycler state have the same type, and where one path lies below another, the lower is a field of the upper's type.";
    StateNotRestorable, "state-not-restorable", Warning,
        "A node's state cannot be restored for a replay.",
        "A field with `#[serde(skip)]` is not recorded, so a replayed node would start with its default. A node with such fields has `restore(&mut self, context: CreationContext) -> Result<()>`, which rebuilds them from parameters. It cannot read from the hardware, for there is none in a replay. Without it, replay of this node is off.";
    StateOfOneNode, "state-of-one-node", Warning,
        "A cycler state is used by one node alone.",
        "Cycler states are shared by the nodes of an instance. What only one node uses is a field of its own struct, or the path is misspelled.";
    Syntax, "syntax", Error,
        "A file cannot be parsed.",
        "The manifest, a Cargo.toml, a parameter file or a Rust file is not valid in its language. Files of the generated crate are never read.";
    TypeMismatch, "type-mismatch", Error,
        "A reader's type is not the writer's.",
        "A field that reads an output is written with the type that the output has. Names are compared after all `use` lines, re-exports and aliases of the workspace were followed; this error is given only when both types could be followed to their end.";
    UnknownHardware, "unknown-hardware", Error,
        "A target's hardware type cannot be found.",
        "The hardware of a target is written `crate::Type`, where the crate is a member of the workspace or stands in the root's `[workspace.dependencies]`, and the type is public.";
    UnknownInstance, "unknown-instance", Error,
        "An input names an instance that the robot does not have.",
        "Instances are called cycler name + suffix, as in `VisionTop`. A `PerceptionInput` may also name a cycler, which interleaves its instances.";
    UnknownKey, "unknown-key", Error,
        "The manifest or parameters.toml has a key that means nothing.",
        "Only the keys of the documentation are read. A misspelled key would silently leave its default in place, so it is an error.";
    UnknownNode, "unknown-node", Error,
        "A node of the manifest cannot be found.",
        "A node is written `crate::module::path`. The crate is a member of the workspace, by its library's name; every module on the way is declared with `mod`, beginning in the crate's `lib.rs`.";
    UnknownOutput, "unknown-output", Error,
        "An input reads what no node of that cycler writes.",
        "Outputs are the fields of `MainOutputs` and the `MainOutput` fields of `CycleContext` of the nodes that the manifest lists for a cycler. Additional outputs are for clients and cannot be read by nodes. Add the node that writes the output to the cycler, or name the instance that has it.";
    UnknownParameter, "unknown-parameter", Error,
        "A parameter file has a key that no node declares.",
        "A value that nobody reads is most likely misspelled or left over. Rename or remove it. `[hardware.<target>]` belongs to the target's hardware and is not checked here.";
    UnorderedStateWriters, "unordered-state-writers", Warning,
        "Two writers of a cycler state are ordered by the manifest alone.",
        "Nodes that write one cycler state run in manifest order unless an input orders them. If the order matters, let one read an output of the other; if not, this is harmless.";
    UnreadOutputs, "unread-outputs", Warning,
        "Nobody reads what a node writes.",
        "No node reads a main output of this node, and it neither writes to the hardware, nor shares a cycler state, nor answers a procedure. It may still be there for people who watch; else remove it from the manifest.";
    UnusedKey, "unused-key", Warning,
        "A key of the manifest has no effect here.",
        "`pending_timeout` and `queue` describe how others wait for a perception cycler, `watchdog` and `history` belong to real-time cyclers. In a cycler of the other kind they change nothing.";
    UnwrittenState, "unwritten-state", Error,
        "A cycler state is read but nobody writes it.",
        "Every node that uses this cycler state has it as `&T`, so it keeps its default for ever. Write it with `CyclerState<T, \"path\">` in a node of the same cycler.";
}
