//! What a node reads: fields of its contexts, whatever their kind.

use serde::Serialize;

use super::{Access, CreationBinding, CycleBinding, DataType, InstanceId, Node};

/// What a field of a cycle context reads from the main outputs of a cycler.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct OutputRead<'a> {
    /// Empty: the own cycler.
    pub instances: &'a [InstanceId],
    pub access: &'a Access,
    /// Position of the writing node in the nodes of the cycler that is read.
    pub producer: usize,
    /// Whether the types were compared.
    pub checked: bool,
}

impl Node {
    /// Parameters that it reads, when it is created and in cycles.
    pub(crate) fn parameters(&self) -> impl Iterator<Item = (&Access, &DataType)> {
        let created = self
            .creation
            .iter()
            .filter_map(|field| match &field.binding {
                CreationBinding::Parameter { access, data } => Some((access, data)),
                _ => None,
            });
        let cycled = self.cycle.iter().filter_map(|field| match &field.binding {
            CycleBinding::Parameter { access, data } => Some((access, data)),
            _ => None,
        });
        created.chain(cycled)
    }
}

impl CycleBinding {
    /// What it reads, if it reads a main output.
    pub fn read(&self) -> Option<OutputRead<'_>> {
        match self {
            Self::OwnOutput {
                access,
                producer,
                checked,
                ..
            }
            | Self::RequiredOwnOutput {
                access,
                producer,
                checked,
                ..
            }
            | Self::Previous {
                access,
                producer,
                checked,
                ..
            }
            | Self::Historic {
                access,
                producer,
                checked,
                ..
            } => Some(OutputRead {
                instances: &[],
                access,
                producer: *producer,
                checked: *checked,
            }),
            Self::OutputOf {
                instance,
                access,
                producer,
                checked,
                ..
            }
            | Self::RequiredOutputOf {
                instance,
                access,
                producer,
                checked,
                ..
            }
            | Self::Latest {
                instance,
                access,
                producer,
                checked,
                ..
            } => Some(OutputRead {
                instances: std::slice::from_ref(instance),
                access,
                producer: *producer,
                checked: *checked,
            }),
            Self::Perception {
                instances,
                access,
                producer,
                checked,
                ..
            } => Some(OutputRead {
                instances,
                access,
                producer: *producer,
                checked: *checked,
            }),
            Self::Parameter { .. }
            | Self::CyclerState { .. }
            | Self::CycleTime
            | Self::AdditionalOutput { .. }
            | Self::Procedure { .. }
            | Self::HardwareInterface
            | Self::MainOutput { .. } => None,
        }
    }
}
