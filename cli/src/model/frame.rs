//! What the nodes of one cycler may touch: the fields of its `Frame` and `Creation`.

use std::collections::BTreeMap;

use serde::Serialize;

use super::accessor::Accessor;
use super::names::{Names, joined, snake_case};
use super::parameters::Parameters;
use super::structs::FieldType;
use crate::resolve::robot::{
    Access, CreationBinding, CycleBinding, Cycler, DataType, Field, Node, OnFailure, OutputBinding,
    Segment,
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
/// `$cycler_instance` behind one prefix, or one value there that is a field of what another node reads whole.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct InstanceParameters {
    /// Its field in `Frame`: `instance_parameters`.
    pub field: String,
    /// The field that selects it: `select`.
    pub select: String,
    /// Where it is, with `$cycler_instance`.
    pub path: Vec<Segment>,
    /// Its type; where an option on the way may be absent, that of the content.
    pub content: FieldType,
}

impl InstanceParameters {
    /// Whether an option on the way is looked into, so that it may be absent.
    pub fn may_be_absent(&self) -> bool {
        self.path.iter().any(|segment| segment.optional)
    }

    /// What is left of a path that leads through it.
    pub fn below<'a>(&self, access: &'a Access) -> Option<&'a [Segment]> {
        let below = access.segments.strip_prefix(self.path.as_slice())?;
        (below.is_empty() || !self.may_be_absent()).then_some(below)
    }

    /// How it is reached for one instance.
    pub fn of_instance(&self, base: &[&str], instance: &str) -> Accessor {
        let own = |segment: &Segment| Segment {
            name: match segment.instance {
                true => snake_case(instance),
                false => segment.name.clone(),
            },
            ..segment.clone()
        };
        Accessor::below(base, &self.path.iter().map(own).collect::<Vec<_>>())
    }
}

/// Whether something has a type parameter for the hardware, and what it asks of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum Hardware {
    /// No type parameter.
    Absent,
    /// Absolute paths of traits, sorted, then `Send`, `Sync` and `'static`; perhaps none.
    Asked(Vec<String>),
}

/// Sorts bounds, each once: traits of the robot first.
pub fn sort_bounds(bounds: &mut Vec<String>) {
    bounds.sort_by_cached_key(|bound| (is_marker(bound), bound.starts_with('\''), bound.clone()));
    bounds.dedup();
}

/// Whether a bound asks for what every hardware is, and not for a trait of the robot.
pub fn is_marker(bound: &str) -> bool {
    matches!(bound, "'static" | "Send" | "Sync")
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

/// Names without that of the instance, by which parts are sorted and called, and the path.
type PartKey = (Vec<String>, Vec<Segment>);

/// Parts of the parameter tree that the nodes of a cycler read by `$cycler_instance`.
pub fn instance_parameters(cycler: &Cycler, parameters: &Parameters) -> Vec<InstanceParameters> {
    let mut found: BTreeMap<PartKey, FieldType> = BTreeMap::new();
    for (access, data) in cycler.nodes.iter().flat_map(Node::parameters) {
        if let Some((key, content)) = selected(cycler, parameters, access, data) {
            found.entry(key).or_insert(content);
        }
    }
    // What lies below another part is reached through that one.
    let paths: Vec<Vec<Segment>> = found.keys().map(|(_, path)| path.clone()).collect();
    let leads = |above: &[Segment], path: &[Segment]| {
        above.len() < path.len()
            && path.starts_with(above)
            && above.iter().all(|segment| !segment.optional)
    };
    found.retain(|(_, path), _| !paths.iter().any(|above| leads(above, path)));
    let only = found.len() == 1;
    let (mut fields, mut selects) = (Names::default(), Names::default());
    found
        .into_iter()
        .map(|((names, path), content)| {
            let whose = joined(names.iter().map(String::as_str));
            let (field, select) = if only || whose.is_empty() {
                ("instance_parameters".to_owned(), "select".to_owned())
            } else {
                (format!("instance_{whose}"), format!("select_{whose}"))
            };
            InstanceParameters {
                field: fields.give(&field),
                select: selects.give(&select),
                path,
                content,
            }
        })
        .collect()
}

/// What has to be selected for a path with `$cycler_instance`, by its names without that of the
/// instance. It ends at the instance where the tree knows what all instances have there; below a
/// value that is read whole only the end of the path has a type that is written.
fn selected(
    cycler: &Cycler,
    parameters: &Parameters,
    access: &Access,
    data: &DataType,
) -> Option<(PartKey, FieldType)> {
    let segments = &access.segments;
    let place = segments.iter().position(|segment| segment.instance)?;
    let names = |segments: &[Segment]| -> Vec<String> {
        segments.iter().map(|one| one.name.clone()).collect()
    };
    let mut path = names(&segments[..place]);
    let (prefix, instance) = (path.clone(), snake_case(&cycler.instances[0].name));
    let looks = segments[..=place].iter().any(|segment| segment.optional);
    if !looks && let Some(content) = parameters.content(prefix.iter().chain([&instance])) {
        return Some(((prefix, segments[..=place].to_vec()), content));
    }
    path.extend(names(&segments[place + 1..]));
    let text = data.text.as_str();
    let inner = text
        .strip_prefix("Option<")
        .and_then(|text| text.strip_suffix('>'));
    let text = inner.filter(|_| access.is_optional()).unwrap_or(text);
    Some(((path, segments.clone()), FieldType::Data(text.to_owned())))
}

/// The part that a path leads through, and what is left of the path.
pub fn part_of<'a>(
    parts: &'a [InstanceParameters],
    access: &'a Access,
) -> Option<(&'a InstanceParameters, &'a [Segment])> {
    parts
        .iter()
        .find_map(|part| Some((part, part.below(access)?)))
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
    part_of(parts, access).map_or(FrameField::Parameters, |(part, _)| {
        FrameField::Instance(part.clone())
    })
}

fn sorted(fields: impl IntoIterator<Item = FrameField>) -> Vec<FrameField> {
    let mut fields: Vec<FrameField> = fields.into_iter().collect();
    fields.sort_by(|left, right| left.name().cmp(right.name()));
    fields.dedup();
    fields
}
