//! What the nodes of one cycler may touch: the fields of its `Frame` and `Creation`.

use std::collections::BTreeSet;

use serde::Serialize;

use super::names::{Names, joined, snake_case};
use super::parameters::Parameters;
use super::structs::FieldType;
use crate::resolve::robot::{
    Access, CreationBinding, CycleBinding, Cycler, Field, Node, OnFailure, OutputBinding,
};

/// A field of `Frame` or `Creation`, which have only those that some node needs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum FrameField {
    AdditionalOutputs,
    CaptureTime,
    Cycle,
    CyclerState,
    HardwareInterface,
    Historic,
    Injections,
    Instance(InstanceParameters),
    Latest,
    Own,
    Parameters,
    Perception,
    Previous,
    Procedures,
    Shared,
    Subscribed,
}

/// A part of the parameter tree that is different for each instance: what stands in place of
/// `$cycler_instance` behind one prefix.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct InstanceParameters {
    /// Its field in `Frame`: `instance_parameters`.
    pub field: String,
    /// The field that selects it: `select`.
    pub select: String,
    /// What stands in front of `$cycler_instance`.
    pub prefix: Vec<String>,
    pub content: FieldType,
}

/// Whether something has a type parameter for the hardware, and what it asks of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum Hardware {
    /// No type parameter.
    Absent,
    /// Absolute paths of traits, sorted; perhaps none.
    Asked(Vec<String>),
}

impl FrameField {
    /// The field's name; fields are sorted by it.
    pub fn name(&self) -> &str {
        match self {
            Self::AdditionalOutputs => "additional_outputs",
            Self::CaptureTime => "capture_time",
            Self::Cycle => "cycle",
            Self::CyclerState => "cycler_state",
            Self::HardwareInterface => "hardware_interface",
            Self::Historic => "historic",
            Self::Injections => "injections",
            Self::Instance(part) => &part.field,
            Self::Latest => "latest",
            Self::Own => "own",
            Self::Parameters => "parameters",
            Self::Perception => "perception",
            Self::Previous => "previous",
            Self::Procedures => "procedures",
            Self::Shared => "shared",
            Self::Subscribed => "subscribed",
        }
    }

    /// Whether it is a reference or holds some.
    pub fn borrows(&self) -> bool {
        !matches!(self, Self::Cycle | Self::Subscribed)
    }
}

/// Parts of the parameter tree that the nodes of a cycler read by `$cycler_instance`.
pub fn instance_parameters(cycler: &Cycler, parameters: &Parameters) -> Vec<InstanceParameters> {
    let prefixes: BTreeSet<Vec<String>> = cycler
        .nodes
        .iter()
        .flat_map(|node| {
            let created = node
                .creation
                .iter()
                .filter_map(|field| created_from(&field.binding));
            let cycled = node
                .cycle
                .iter()
                .filter_map(|field| read_from(&field.binding));
            created.chain(cycled)
        })
        .filter_map(instance_prefix)
        .collect();
    let only = prefixes.len() == 1;
    let (mut fields, mut selects) = (Names::default(), Names::default());
    let instance = snake_case(&cycler.instances[0].name);
    prefixes
        .into_iter()
        .map(|prefix| {
            let path = prefix.iter().chain([&instance]);
            let content = parameters
                .content(path)
                .expect("declared paths are in the tree");
            let whose = joined(prefix.iter().map(String::as_str));
            let (field, select) = if only || whose.is_empty() {
                ("instance_parameters".to_owned(), "select".to_owned())
            } else {
                (format!("instance_{whose}"), format!("select_{whose}"))
            };
            InstanceParameters {
                field: fields.give(&field),
                select: selects.give(&select),
                prefix,
                content,
            }
        })
        .collect()
}

/// What stands in front of `$cycler_instance`, if that is part of the path.
pub fn instance_prefix(access: &Access) -> Option<Vec<String>> {
    let position = access
        .segments
        .iter()
        .position(|segment| segment.instance)?;
    Some(
        access.segments[..position]
            .iter()
            .map(|segment| segment.name.clone())
            .collect(),
    )
}

fn created_from(binding: &CreationBinding) -> Option<&Access> {
    match binding {
        CreationBinding::Parameter { access, .. } => Some(access),
        _ => None,
    }
}

fn read_from(binding: &CycleBinding) -> Option<&Access> {
    match binding {
        CycleBinding::Parameter { access, .. } => Some(access),
        _ => None,
    }
}

/// Fields of `Creation`, sorted: what `new` of any node needs.
pub fn creation_fields(cycler: &Cycler, parts: &[InstanceParameters]) -> Vec<FrameField> {
    let bindings = cycler.nodes.iter().flat_map(|node| &node.creation);
    sorted(bindings.map(|field| creation_field(&field.binding, parts)))
}

/// The field of `Creation` that this binding needs.
pub fn creation_field(binding: &CreationBinding, parts: &[InstanceParameters]) -> FrameField {
    match binding {
        CreationBinding::Parameter { access, .. } => parameter_field(access, parts),
        CreationBinding::CyclerState { .. } => FrameField::CyclerState,
        CreationBinding::HardwareInterface => FrameField::HardwareInterface,
    }
}

/// Fields of `Frame`, sorted: what `cycle` of any node needs, and what is needed to create a node
/// anew in the middle of a cycle.
pub fn frame_fields(cycler: &Cycler, parts: &[InstanceParameters]) -> Vec<FrameField> {
    let mut fields = vec![FrameField::Cycle];
    if renews_from_frame(cycler) {
        fields.extend(creation_fields(cycler, parts));
    }
    for output in &cycler.outputs {
        fields.push(FrameField::Injections);
        fields.push(if output.shared {
            FrameField::Shared
        } else {
            FrameField::Own
        });
        if output.previous {
            fields.push(FrameField::Previous);
        }
    }
    for node in &cycler.nodes {
        for field in &node.cycle {
            fields.extend(cycle_fields(&field.binding, parts));
        }
        let captures =
            |field: &Field<OutputBinding>| matches!(field.binding, OutputBinding::CaptureTime);
        if node.outputs.iter().any(captures) {
            fields.push(FrameField::CaptureTime);
        }
    }
    sorted(fields)
}

/// Whether a node of this policy is created anew before its next call after a panic.
pub fn renews(node: &Node) -> bool {
    matches!(node.on_failure, OnFailure::Skip | OnFailure::Hold)
}

/// Whether something of `Frame` is needed to create a node anew.
pub fn renews_from_frame(cycler: &Cycler) -> bool {
    cycler
        .nodes
        .iter()
        .any(|node| renews(node) && !node.creation.is_empty())
}

fn cycle_fields(binding: &CycleBinding, parts: &[InstanceParameters]) -> Vec<FrameField> {
    match binding {
        CycleBinding::OutputOf { .. }
        | CycleBinding::RequiredOutputOf { .. }
        | CycleBinding::Latest { .. } => vec![FrameField::Latest],
        CycleBinding::Historic { .. } => vec![FrameField::Historic],
        CycleBinding::Perception { .. } => vec![FrameField::Perception],
        CycleBinding::Parameter { access, .. } => vec![parameter_field(access, parts)],
        CycleBinding::CyclerState { .. } => vec![FrameField::CyclerState],
        CycleBinding::AdditionalOutput { .. } => {
            vec![FrameField::AdditionalOutputs, FrameField::Subscribed]
        }
        CycleBinding::Procedure { .. } => vec![FrameField::Procedures],
        CycleBinding::HardwareInterface => vec![FrameField::HardwareInterface],
        CycleBinding::OwnOutput { .. }
        | CycleBinding::RequiredOwnOutput { .. }
        | CycleBinding::Previous { .. }
        | CycleBinding::CycleTime
        | CycleBinding::MainOutput { .. } => Vec::new(),
    }
}

fn parameter_field(access: &Access, parts: &[InstanceParameters]) -> FrameField {
    let part =
        instance_prefix(access).and_then(|prefix| parts.iter().find(|part| part.prefix == prefix));
    part.map_or(FrameField::Parameters, |part| {
        FrameField::Instance(part.clone())
    })
}

fn sorted(fields: impl IntoIterator<Item = FrameField>) -> Vec<FrameField> {
    let mut fields: Vec<FrameField> = fields.into_iter().collect();
    fields.sort_by(|left, right| left.name().cmp(right.name()));
    fields.dedup();
    fields
}
