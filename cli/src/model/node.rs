//! One node of a cycler: how it is created, and its step in a cycle.

use serde::Serialize;

use super::accessor::Accessor;
use super::cycler::AdditionalOutput;
use super::frame::{Hardware, InstanceParameters, part_of, renews};
use super::names::snake_case;
use super::{frame, sentences};
use crate::resolve::robot::{
    Access, CreationBinding, CycleBinding, Cycler, InstanceId, Interface, Node, OnFailure,
    OutputBinding, Robot, Segment,
};

/// Names that a step uses itself; no field of a context is bound to one of them.
const VARIABLES: [&str; 4] = ["context", "frame", "node", "outputs"];

/// A node in the files of its cycler.
#[derive(Clone, Debug, Serialize)]
pub struct NodeModel {
    /// What it is called in this cycler: `ball_detection`.
    pub name: String,
    /// Absolute path of its module: `vision::ball_detection`.
    pub path: String,
    pub type_name: String,
    pub setup: bool,
    pub on_failure: OnFailure,
    pub creation: Creation,
    pub restores: bool,
    pub step: Step,
}

/// How a node is created.
#[derive(Clone, Debug, Serialize)]
pub struct Creation {
    /// Fields of its creation context.
    pub context: Vec<ContextField>,
    /// What `new` asks of the hardware.
    pub hardware: Hardware,
    /// What `restore` asks of the hardware.
    pub restore_hardware: Hardware,
}

/// What a cycle does with a node.
#[derive(Clone, Debug, Serialize)]
pub struct Step {
    /// Its data flow in one line.
    pub flow: String,
    pub hardware: Hardware,
    /// The node is called only if all of these are present.
    pub required: Vec<Required>,
    /// Fields of its cycle context.
    pub context: Vec<ContextField>,
    pub outputs: Vec<StepOutput>,
    /// The field of `MainOutputs` with the capture time.
    pub capture_time: Option<String>,
    pub failure: Failure,
    /// After a panic it is created anew before the call.
    pub renews: bool,
    /// Clients may replace its outputs right after it.
    pub injects: bool,
}

/// What becomes of the outputs if the node fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Failure {
    /// The failure ends the cycle.
    Ends,
    /// Defaults.
    Skips,
    /// The last good ones for a while, then defaults.
    Holds,
}

/// A variable that must be bound before the node is called.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Required {
    pub variable: String,
    pub source: RequiredSource,
}

/// Where a required input comes from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum RequiredSource {
    /// Something on the path may be absent.
    Option(Accessor),
    /// Absent before the first cycle of this field of `frame.latest`; then the path below.
    Written { latest: String, path: Accessor },
}

/// A field of a context literal.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ContextField {
    pub name: String,
    pub value: Value,
}

/// What a field of a context is filled with.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum Value {
    /// A reference, or an option of one.
    Read(Accessor),
    /// `&mut` of a place.
    Write(Vec<String>),
    /// A required input, which is a variable by now.
    Variable(String),
    /// `frame.latest.control.latest(…)`.
    Latest {
        latest: String,
        path: Accessor,
    },
    /// The output by time, and its value of this cycle.
    Historic {
        variable: String,
        output: String,
        path: Accessor,
        current: Accessor,
    },
    /// One perception instance.
    Perception {
        variable: String,
        lane: String,
        path: Accessor,
    },
    /// All instances of a perception cycler in one order.
    Interleaved {
        variable: String,
        order: String,
        lanes: Vec<String>,
        path: Accessor,
    },
    CycleTime,
    AdditionalOutput {
        flag: String,
        place: Vec<String>,
    },
    Procedure(String),
    HardwareInterface,
}

/// A main output of a node.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct StepOutput {
    pub name: String,
    /// It lives in `frame.shared`, else in `frame.own`.
    pub shared: bool,
    pub in_place: bool,
}

impl StepOutput {
    /// The field of the frame it lives in.
    pub fn home(&self) -> &'static str {
        home(self.shared)
    }
}

/// The field of the frame where outputs live that others read, or that nobody else reads.
pub fn home(shared: bool) -> &'static str {
    if shared { "shared" } else { "own" }
}

/// What is known about the cycler of a node.
pub struct Surroundings<'a> {
    pub robot: &'a Robot,
    pub cycler: &'a Cycler,
    pub instance_parameters: &'a [InstanceParameters],
    pub additional_outputs: &'a [AdditionalOutput],
    pub frame_is_generic: bool,
    pub creation_is_generic: bool,
}

impl Surroundings<'_> {
    /// Decides everything about a node that is called `name` in this cycler.
    pub fn describe(&self, name: String, node: &Node) -> NodeModel {
        let creation = node
            .creation
            .iter()
            .map(|field| ContextField {
                name: field.name.clone(),
                value: self.creation_value(&field.binding),
            })
            .collect();
        NodeModel {
            name,
            path: node.path.clone(),
            type_name: node.type_name.clone(),
            setup: node.setup,
            on_failure: node.on_failure,
            creation: Creation {
                context: creation,
                hardware: asked(self.creation_is_generic, &node.new_bounds, &node.markers),
                restore_hardware: asked(
                    self.creation_is_generic,
                    &node.restore_bounds,
                    &node.markers,
                ),
            },
            restores: node.restores,
            step: self.step(node),
        }
    }

    fn step(&self, node: &Node) -> Step {
        let mut required = Vec::new();
        let context = node
            .cycle
            .iter()
            .map(|field| {
                let variable = variable(node, &field.name);
                let value = match self.required(&variable, &field.binding) {
                    Some(needed) => {
                        let value = Value::Variable(needed.variable.clone());
                        required.push(needed);
                        value
                    }
                    None => self.cycle_value(&field.name, variable, &field.binding),
                };
                ContextField {
                    name: field.name.clone(),
                    value,
                }
            })
            .collect();
        let capture_time = node
            .outputs
            .iter()
            .find(|field| matches!(field.binding, OutputBinding::CaptureTime))
            .map(|field| field.name.clone());
        let mut bounds = node.cycle_bounds.clone();
        if renews(node) {
            bounds.extend_from_slice(&node.new_bounds);
        }
        Step {
            flow: sentences::flow(self.robot, node),
            hardware: asked(self.frame_is_generic, &bounds, &node.markers),
            required,
            context,
            outputs: self.outputs(node),
            capture_time,
            failure: match node.on_failure {
                _ if node.setup => Failure::Ends,
                OnFailure::Stop | OnFailure::Restart => Failure::Ends,
                OnFailure::Skip => Failure::Skips,
                OnFailure::Hold => Failure::Holds,
            },
            renews: renews(node),
            injects: !node.setup,
        }
    }

    /// In the order of the node's declarations: those in place, then those by value.
    fn outputs(&self, node: &Node) -> Vec<StepOutput> {
        let in_place = node.cycle.iter().filter_map(|field| match field.binding {
            CycleBinding::MainOutput { .. } => Some((&field.name, true)),
            _ => None,
        });
        let by_value = node.outputs.iter().filter_map(|field| match field.binding {
            OutputBinding::MainOutput { .. } => Some((&field.name, false)),
            OutputBinding::CaptureTime => None,
        });
        in_place
            .chain(by_value)
            .map(|(name, in_place)| StepOutput {
                name: name.clone(),
                shared: self.is_shared(name),
                in_place,
            })
            .collect()
    }

    fn creation_value(&self, binding: &CreationBinding) -> Value {
        match binding {
            CreationBinding::Parameter { access, .. } => self.parameter("creation", access),
            CreationBinding::CyclerState { access, shared, .. } => {
                state("creation", access, *shared)
            }
            CreationBinding::HardwareInterface => Value::HardwareInterface,
        }
    }

    fn required(&self, variable: &str, binding: &CycleBinding) -> Option<Required> {
        let source = match binding {
            CycleBinding::RequiredOwnOutput { access, .. } => {
                RequiredSource::Option(self.own_output("frame", access))
            }
            CycleBinding::RequiredOutputOf {
                instance, access, ..
            } => {
                let accessor = self.output_of(*instance, access);
                if accessor.may_be_absent() {
                    RequiredSource::Option(accessor)
                } else {
                    let path = Accessor::below(&["outputs"], &access.segments);
                    RequiredSource::Written {
                        latest: self.instance(*instance),
                        path,
                    }
                }
            }
            _ => return None,
        };
        Some(Required {
            variable: variable.to_owned(),
            source,
        })
    }

    fn cycle_value(&self, field: &str, variable: String, binding: &CycleBinding) -> Value {
        let in_outputs = |access: &Access| Accessor::below(&["outputs"], &access.segments);
        match binding {
            CycleBinding::OwnOutput { access, .. }
            | CycleBinding::RequiredOwnOutput { access, .. } => {
                Value::Read(self.own_output("frame", access))
            }
            CycleBinding::OutputOf {
                instance, access, ..
            }
            | CycleBinding::RequiredOutputOf {
                instance, access, ..
            } => Value::Read(self.output_of(*instance, access)),
            CycleBinding::Latest {
                instance, access, ..
            } => Value::Latest {
                latest: self.instance(*instance),
                path: in_outputs(access),
            },
            CycleBinding::Previous { access, .. } => {
                let home = home(self.is_shared(&access.segments[0].name));
                Value::Read(Accessor::below(
                    &["frame", "previous", home],
                    &access.segments,
                ))
            }
            CycleBinding::Historic { access, .. } => Value::Historic {
                variable,
                output: access.segments[0].name.clone(),
                path: Accessor::in_variable(&access.segments),
                current: self.own_output("frame", access),
            },
            CycleBinding::Perception {
                instances,
                interleaved,
                access,
                ..
            } => self.perception(variable, instances, *interleaved, in_outputs(access)),
            CycleBinding::Parameter { access, .. } => self.parameter("frame", access),
            CycleBinding::CyclerState { access, shared, .. } => state("frame", access, *shared),
            CycleBinding::CycleTime => Value::CycleTime,
            CycleBinding::AdditionalOutput { access, .. } => self.additional(access),
            CycleBinding::Procedure { name, .. } => Value::Procedure(name.clone()),
            CycleBinding::HardwareInterface => Value::HardwareInterface,
            CycleBinding::MainOutput { .. } => {
                let home = home(self.is_shared(field));
                Value::Write(vec!["frame".to_owned(), home.to_owned(), field.to_owned()])
            }
        }
    }

    fn perception(
        &self,
        variable: String,
        instances: &[InstanceId],
        interleaved: bool,
        path: Accessor,
    ) -> Value {
        let lanes: Vec<String> = instances.iter().map(|id| self.instance(*id)).collect();
        match lanes.as_slice() {
            [lane] => Value::Perception {
                variable,
                lane: lane.clone(),
                path,
            },
            _ => {
                debug_assert!(interleaved, "only a cycler's name means several instances");
                let cycler = &self.robot.cyclers[instances[0].cycler];
                Value::Interleaved {
                    variable,
                    order: snake_case(&cycler.name),
                    lanes,
                    path,
                }
            }
        }
    }

    fn additional(&self, access: &Access) -> Value {
        let known = self
            .additional_outputs
            .iter()
            .find(|known| known.written == access.written);
        let known = known.expect("every declared additional output is known");
        let base = ["frame", "additional_outputs"].map(str::to_owned);
        Value::AdditionalOutput {
            flag: known.flag.clone(),
            place: base
                .into_iter()
                .chain(known.place.iter().cloned())
                .collect(),
        }
    }

    fn parameter(&self, base: &str, access: &Access) -> Value {
        Value::Read(match part_of(self.instance_parameters, access) {
            Some((part, below)) => Accessor::below(&[base, &part.field], below),
            None => Accessor::below(&[base, "parameters"], &access.segments),
        })
    }

    fn own_output(&self, base: &str, access: &Access) -> Accessor {
        let home = home(self.is_shared(&access.segments[0].name));
        Accessor::below(&[base, home], &access.segments)
    }

    fn output_of(&self, instance: InstanceId, access: &Access) -> Accessor {
        Accessor::below(
            &["frame", "latest", &self.instance(instance)],
            &access.segments,
        )
    }

    fn is_shared(&self, output: &str) -> bool {
        self.cycler
            .outputs
            .iter()
            .any(|known| known.name == output && known.shared)
    }

    fn instance(&self, id: InstanceId) -> String {
        snake_case(&self.robot.cyclers[id.cycler].instances[id.instance].name)
    }
}

/// The variable that a field of the cycle context is bound to before the context is made; no other field has its name.
fn variable(node: &Node, field: &str) -> String {
    let mut variable = field.to_owned();
    if VARIABLES.contains(&field) {
        let is_field = |name: &str| node.cycle.iter().any(|other| other.name == name);
        while variable == field || is_field(&variable) {
            variable.push_str("_input");
        }
    }
    variable
}

fn state(base: &str, access: &Access, shared: bool) -> Value {
    let base = [base, "cycler_state"];
    if shared {
        Value::Read(Accessor::below(&base, &access.segments))
    } else {
        let names = access
            .segments
            .iter()
            .map(|Segment { name, .. }| name.clone());
        Value::Write(base.map(str::to_owned).into_iter().chain(names).collect())
    }
}

/// What is asked of the hardware, sorted and each once.
pub fn asked(generic: bool, bounds: &[Interface], markers: &[String]) -> Hardware {
    if !generic {
        return frame::Hardware::Absent;
    }
    let mut traits: Vec<String> = bounds
        .iter()
        .map(|interface| interface.path.clone())
        .chain(markers.iter().cloned())
        .collect();
    frame::sort_bounds(&mut traits);
    Hardware::Asked(traits)
}
