//! Every diagnostic once: code, severity, title, and its page in `docs/diagnostics/`.

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
    ($($variant:ident, $name:literal, $severity:ident, $title:literal;)*) => {
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

            /// Its page, Markdown: what it means, an example, the smallest repair, why.
            pub fn page(self) -> &'static str {
                match self {
                    $(Self::$variant => {
                        include_str!(concat!("../../diagnostics/", $name, ".md"))
                    })*
                }
            }

            /// The page's paragraph on what it means and how it is mended.
            pub fn explanation(self) -> &'static str {
                let text = self.page().splitn(3, "\n\n").nth(2).unwrap_or_default();
                text.split("\n\n## ").next().unwrap_or_default()
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
        "An actuator may receive a command that nobody computed.";
    CaptureTime, "capture-time", Error,
        "The capture time of a cycle is given at the wrong place or twice.";
    DependencyCycle, "dependency-cycle", Error,
        "Nodes of a cycler wait for each other.";
    DuplicateName, "duplicate-name", Error,
        "Two things have one name.";
    DuplicateOutput, "duplicate-output", Error,
        "Two nodes of one cycler write one output.";
    DuplicateParameter, "duplicate-parameter", Error,
        "Parameter files give one value by two names.";
    DuplicateProcedure, "duplicate-procedure", Error,
        "Two nodes of one cycler answer one procedure.";
    HardwareReadOutsideSetup, "hardware-read-outside-setup", Warning,
        "A node that is no setup node reads from the hardware.";
    InvalidBridge, "invalid-bridge", Error,
        "A bridge maps what the robot does not have, or not in this way.";
    InvalidContext, "invalid-context", Error,
        "One of the three structs of a node is not as it has to be.";
    InvalidField, "invalid-field", Error,
        "A field of a context has a type that is no kind, or a kind with wrong arguments.";
    InvalidName, "invalid-name", Error,
        "A name is not spelled as it has to be.";
    InvalidPath, "invalid-path", Error,
        "A data path cannot be read.";
    InvalidSignature, "invalid-signature", Error,
        "`new`, `cycle` or `restore` is not written as a node's functions are.";
    InvalidValue, "invalid-value", Error,
        "A value of the manifest or of parameters.toml is not what its key takes.";
    LeftToRustc, "left-to-rustc", Error,
        "The generated crate does not compile.";
    MeasurementTakesDefault, "measurement-takes-default", Warning,
        "A perception input may receive a default in place of a measurement.";
    MisplacedKind, "misplaced-kind", Error,
        "A kind stands where it has no meaning.";
    MissingContext, "missing-context", Error,
        "A node file lacks one of its three structs.";
    MissingDerive, "missing-derive", Error,
        "A node's state cannot be stored.";
    MissingFile, "missing-file", Warning,
        "A file that the manifest names is not there.";
    MissingKey, "missing-key", Error,
        "The manifest lacks a key.";
    MissingNode, "missing-node", Error,
        "A node file has no node.";
    MissingParameter, "missing-parameter", Error,
        "No parameter file gives a value that a node reads.";
    MissingParameterFile, "missing-parameter-file", Error,
        "A parameter file does not exist.";
    MistypedParameter, "mistyped-parameter", Error,
        "A parameter file has a value of the wrong type, or outside of its field's range.";
    Nondeterminism, "nondeterminism", Warning,
        "A node gets another answer in every run.";
    NotPublic, "not-public", Error,
        "Generated code cannot name something because it is private.";
    NotReplayable, "not-replayable", Warning,
        "Nothing can stand in for a hardware trait in a replay.";
    OptionMismatch, "option-mismatch", Error,
        "`?` in a path and `Option` in a type disagree.";
    OverlappingStates, "overlapping-states", Error,
        "A context borrows one cycler state twice.";
    ParameterConflict, "parameter-conflict", Error,
        "Two nodes declare one parameter differently.";
    Rustc, "rustc", Error,
        "rustc found an error in a file of the robot.";
    RustcWarning, "rustc-warning", Warning,
        "rustc found something suspicious in a file of the robot.";
    SetupOrder, "setup-order", Error,
        "A setup node reads what is only written after it.";
    StateConflict, "state-conflict", Error,
        "Two nodes declare one cycler state differently.";
    StateNotRestorable, "state-not-restorable", Warning,
        "A node's state cannot be restored for a replay.";
    StateOfOneNode, "state-of-one-node", Warning,
        "A cycler state is used by one node alone.";
    Syntax, "syntax", Error,
        "A file cannot be parsed.";
    TypeMismatch, "type-mismatch", Error,
        "A reader's type is not the writer's.";
    UnknownHardware, "unknown-hardware", Error,
        "A target's hardware type cannot be found.";
    UnknownInstance, "unknown-instance", Error,
        "An input names an instance that the robot does not have.";
    UnknownKey, "unknown-key", Error,
        "The manifest or parameters.toml has a key that means nothing.";
    UnknownNode, "unknown-node", Error,
        "A node of the manifest cannot be found.";
    UnknownOutput, "unknown-output", Error,
        "An input reads what no node of that cycler writes.";
    UnknownParameter, "unknown-parameter", Error,
        "A parameter file has a key that no node declares.";
    UnknownProfile, "unknown-profile", Warning,
        "A target's profile is none that cargo knows.";
    UnorderedStateWriters, "unordered-state-writers", Warning,
        "Two writers of a cycler state are ordered by the manifest alone.";
    UnpacedCycler, "unpaced-cycler", Warning,
        "Nothing in a cycler waits, so that it never rests.";
    UnreadOutputs, "unread-outputs", Warning,
        "Nobody reads what a node writes.";
    UnsendableState, "unsendable-state", Error,
        "A node's state cannot be moved to another thread.";
    UnservedTrait, "unserved-trait", Error,
        "A target's hardware does not serve a trait that a node asks for.";
    UnusedFile, "unused-file", Warning,
        "A file among the parameters is read for no robot.";
    UnusedKey, "unused-key", Warning,
        "A key of the manifest has no effect here.";
    UnwrittenState, "unwritten-state", Error,
        "A cycler state is read but nobody writes it.";
}
