//! The kinds of context fields: their names, where each has a meaning, and how each is written.

use crate::context::ContextKind;
use crate::nearest::nearest;

/// What a field is to its node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    AdditionalOutput,
    CaptureTime,
    CycleTime,
    CyclerState,
    HardwareInterface,
    HistoricInput,
    Input,
    LatestInput,
    MainOutput,
    Parameter,
    PerceptionInput,
    PreviousInput,
    Procedure,
    RequiredInput,
}

/// Names of the kinds that have a meaning in a context, sorted.
pub fn kinds(context: ContextKind) -> impl Iterator<Item = &'static str> {
    Kind::of(context)
}

impl Kind {
    /// Sorted by name.
    pub(crate) const ALL: [Self; 14] = [
        Self::AdditionalOutput,
        Self::CaptureTime,
        Self::CycleTime,
        Self::CyclerState,
        Self::HardwareInterface,
        Self::HistoricInput,
        Self::Input,
        Self::LatestInput,
        Self::MainOutput,
        Self::Parameter,
        Self::PerceptionInput,
        Self::PreviousInput,
        Self::Procedure,
        Self::RequiredInput,
    ];

    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The kind that was probably meant, of those that have a meaning in a context.
    pub(crate) fn nearest(written: &str, context: ContextKind) -> Option<&'static str> {
        nearest(written, Self::of(context))
    }

    /// Names of the kinds that have a meaning in a context, sorted.
    pub(crate) fn of(context: ContextKind) -> impl Iterator<Item = &'static str> {
        let kinds = Self::ALL.into_iter();
        let allowed = kinds.filter(move |kind| kind.contexts().contains(&context));
        allowed.map(Self::name)
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::AdditionalOutput => "AdditionalOutput",
            Self::CaptureTime => "CaptureTime",
            Self::CycleTime => "CycleTime",
            Self::CyclerState => "CyclerState",
            Self::HardwareInterface => "HardwareInterface",
            Self::HistoricInput => "HistoricInput",
            Self::Input => "Input",
            Self::LatestInput => "LatestInput",
            Self::MainOutput => "MainOutput",
            Self::Parameter => "Parameter",
            Self::PerceptionInput => "PerceptionInput",
            Self::PreviousInput => "PreviousInput",
            Self::Procedure => "Procedure",
            Self::RequiredInput => "RequiredInput",
        }
    }

    /// Where the kind has a meaning.
    pub(crate) fn contexts(self) -> &'static [ContextKind] {
        use ContextKind::{Creation, Cycle, MainOutputs};
        match self {
            Self::CaptureTime => &[MainOutputs],
            Self::CyclerState | Self::HardwareInterface | Self::Parameter => &[Creation, Cycle],
            Self::MainOutput => &[Cycle, MainOutputs],
            _ => &[Cycle],
        }
    }

    /// How the kind is written.
    pub(crate) fn form(self) -> &'static str {
        match self {
            Self::AdditionalOutput => "`AdditionalOutput<Type, \"path\">`",
            Self::CaptureTime => "`CaptureTime`",
            Self::CycleTime => "`CycleTime`",
            Self::CyclerState => "`CyclerState<Type, \"path\">` or `CyclerState<&Type, \"path\">`",
            Self::HardwareInterface => "`HardwareInterface`",
            Self::HistoricInput => "`HistoricInput<Type, \"path\">`",
            Self::Input => "`Input<Type, \"path\">` or `Input<Type, \"Instance\", \"path\">`",
            Self::LatestInput => "`LatestInput<Type, \"Instance\", \"path\">`",
            Self::MainOutput => "`MainOutput<Type>`",
            Self::Parameter => "`Parameter<Type, \"path\">`",
            Self::PerceptionInput => "`PerceptionInput<Type, \"Instance\", \"path\">`",
            Self::PreviousInput => "`PreviousInput<Type, \"path\">`",
            Self::Procedure => "`Procedure<Request, Response, \"name\">`",
            Self::RequiredInput => {
                "`RequiredInput<Option<Type>, \"path?\">` or `RequiredInput<Type, \"Instance\", \"path\">`"
            }
        }
    }
}
