//! The fields of a node's contexts, as the graph lists them.

use super::{Context, Field};
use crate::resolve::robot::{
    self, Access, CreationBinding, CycleBinding, DataType, InstanceId, Node, OutputBinding, Robot,
};

/// What stands behind a field's kind.
#[derive(Default)]
struct Arguments {
    data: Option<String>,
    path: Option<String>,
}

pub(crate) fn describe_fields(robot: &Robot, node: &Node) -> Vec<Field> {
    let mut fields = Vec::new();
    for field in &node.creation {
        let (kind, arguments) = creation_kind(&field.binding);
        fields.push(describe_field(
            Context::Creation,
            field,
            kind,
            None,
            arguments,
        ));
    }
    for field in &node.cycle {
        let (kind, arguments) = cycle_kind(&field.binding);
        let instance = written_instance(robot, &field.binding);
        fields.push(describe_field(
            Context::Cycle,
            field,
            kind,
            instance,
            arguments,
        ));
    }
    for field in &node.outputs {
        let (kind, arguments) = match &field.binding {
            OutputBinding::MainOutput { data } => ("MainOutput", of_data(data)),
            OutputBinding::CaptureTime => ("CaptureTime", Arguments::default()),
        };
        fields.push(describe_field(
            Context::Outputs,
            field,
            kind,
            None,
            arguments,
        ));
    }
    fields
}

fn describe_field<B>(
    context: Context,
    field: &robot::Field<B>,
    kind: &'static str,
    instance: Option<String>,
    arguments: Arguments,
) -> Field {
    Field {
        context,
        name: field.name.clone(),
        kind,
        data: arguments.data,
        instance,
        path: arguments.path,
        line: field.line,
    }
}

fn creation_kind(binding: &CreationBinding) -> (&'static str, Arguments) {
    match binding {
        CreationBinding::Parameter { access, data } => ("Parameter", of_path(access, data)),
        CreationBinding::CyclerState {
            access,
            data,
            shared,
        } => ("CyclerState", of_state(access, data, *shared)),
        CreationBinding::HardwareInterface => ("HardwareInterface", Arguments::default()),
    }
}

/// The kind of a field of the cycle context, as its author writes it.
pub(crate) fn kind(binding: &CycleBinding) -> &'static str {
    cycle_kind(binding).0
}

fn cycle_kind(binding: &CycleBinding) -> (&'static str, Arguments) {
    match binding {
        CycleBinding::OwnOutput { access, data, .. }
        | CycleBinding::OutputOf { access, data, .. } => ("Input", of_path(access, data)),
        CycleBinding::RequiredOwnOutput { access, data, .. }
        | CycleBinding::RequiredOutputOf { access, data, .. } => {
            ("RequiredInput", of_path(access, data))
        }
        CycleBinding::Latest { access, data, .. } => ("LatestInput", of_path(access, data)),
        CycleBinding::Previous { access, data, .. } => ("PreviousInput", of_path(access, data)),
        CycleBinding::Historic { access, data, .. } => ("HistoricInput", of_path(access, data)),
        CycleBinding::Perception { access, data, .. } => ("PerceptionInput", of_path(access, data)),
        CycleBinding::Parameter { access, data } => ("Parameter", of_path(access, data)),
        CycleBinding::CyclerState {
            access,
            data,
            shared,
        } => ("CyclerState", of_state(access, data, *shared)),
        CycleBinding::CycleTime => ("CycleTime", Arguments::default()),
        CycleBinding::AdditionalOutput { access, data } => {
            ("AdditionalOutput", of_path(access, data))
        }
        CycleBinding::Procedure {
            name,
            request,
            response,
        } => {
            let data = Some(format!("({}, {})", request.text, response.text));
            (
                "Procedure",
                Arguments {
                    data,
                    path: Some(name.clone()),
                },
            )
        }
        CycleBinding::HardwareInterface => ("HardwareInterface", Arguments::default()),
        CycleBinding::MainOutput { data } => ("MainOutput", of_data(data)),
    }
}

/// The second argument of kinds that read another instance.
fn written_instance(robot: &Robot, binding: &CycleBinding) -> Option<String> {
    let name = |id: &InstanceId| robot.cyclers[id.cycler].instances[id.instance].name.clone();
    match binding {
        CycleBinding::OutputOf { instance, .. }
        | CycleBinding::RequiredOutputOf { instance, .. }
        | CycleBinding::Latest { instance, .. } => Some(name(instance)),
        CycleBinding::Perception {
            instances,
            interleaved,
            ..
        } => {
            let first = instances.first()?;
            if *interleaved {
                Some(robot.cyclers[first.cycler].name.clone())
            } else {
                Some(name(first))
            }
        }
        _ => None,
    }
}

fn of_data(data: &DataType) -> Arguments {
    Arguments {
        data: Some(data.text.clone()),
        path: None,
    }
}

fn of_path(access: &Access, data: &DataType) -> Arguments {
    Arguments {
        data: Some(data.text.clone()),
        path: Some(access.written.clone()),
    }
}

fn of_state(access: &Access, data: &DataType, shared: bool) -> Arguments {
    let data = if shared {
        format!("&{}", data.text)
    } else {
        data.text.clone()
    };
    Arguments {
        data: Some(data),
        path: Some(access.written.clone()),
    }
}

/// The field's type as its author writes it: `Input<types::Ball, "Control", "ball?">`.
pub(crate) fn written(field: &Field) -> String {
    let data = field.data.iter().map(|data| match field.kind {
        // Request and response are arguments of their own.
        "Procedure" => {
            let inside = data
                .strip_prefix('(')
                .and_then(|data| data.strip_suffix(')'));
            inside.unwrap_or(data).to_owned()
        }
        _ => data.clone(),
    });
    let names = [&field.instance, &field.path].into_iter().flatten();
    let arguments: Vec<String> = data
        .chain(names.map(|name| format!("\"{name}\"")))
        .collect();
    match arguments.as_slice() {
        [] => field.kind.to_owned(),
        arguments => format!("{}<{}>", field.kind, arguments.join(", ")),
    }
}
