//! Which cycles are recorded: the output that `record = { while = … }` names.

use std::ops::Range;

use camino::Utf8Path;

use super::parameter_files::shown::{Part, part};
use super::robot::{Access, Condition, InstanceId, Record, Segment};
use super::scene::Scene;
use crate::diagnostics::{Code, Diagnostic, Diagnostics, suggestion};
use crate::scan::compare::{Comparison, compare};
use crate::scan::components::{Component, component};
use crate::scan::types::Resolved;
use crate::workspace::MANIFEST;

/// What an instance of this cycler records; `None` and an error where the output is none or no `bool`.
pub(super) fn record(
    scene: &Scene<'_>,
    cycler: usize,
    declared: &schema::Record,
    place: Range<usize>,
    diagnostics: &mut Diagnostics,
) -> Option<Record> {
    let path = match declared {
        schema::Record::Switch(schema::Switch::On) => return Some(Record::On),
        schema::Record::Switch(schema::Switch::Off) => return Some(Record::Off),
        schema::Record::Some(schema::RecordSome::Every(cycles)) => {
            return Some(Record::Every(*cycles));
        }
        schema::Record::Some(schema::RecordSome::While(path)) => path,
    };
    condition(scene, cycler, path)
        .map(Record::While)
        .map_err(|error| {
            let file = Utf8Path::new(MANIFEST);
            diagnostics.add(
                Diagnostic::new(error.code, error.message)
                    .at(file, place, "")
                    .help(error.help),
            );
        })
        .ok()
}

struct Refused {
    code: Code,
    message: String,
    help: String,
}

fn condition(scene: &Scene<'_>, own: usize, written: &str) -> Result<Condition, Refused> {
    let (instance, path) = instance_of(scene, written)?;
    let cycler = instance.map_or(own, |instance| instance.cycler);
    if cycler != own && scene.cyclers[cycler].declared.declared.remote {
        return Err(Refused {
            code: Code::UnknownInstance,
            message: format!("`{written}` is not known here: another machine runs its cycler"),
            help: "name an output of a cycler that runs here, perhaps one that reads it".to_owned(),
        });
    }
    let access = access(path);
    let name = &access.segments[0].name;
    let scene_cycler = &scene.cyclers[cycler];
    let Some(producer) = scene_cycler.outputs.get(name) else {
        let outputs = scene_cycler.outputs.keys().map(String::as_str);
        return Err(Refused {
            code: Code::UnknownOutput,
            message: format!(
                "no node of cycler `{}` writes `{name}`",
                scene_cycler.declared.name()
            ),
            help: suggestion(name, outputs, "its outputs are"),
        });
    };
    let library = &scene.sources.library;
    let wanted = library.resolve(&producer.source.module, &syn::parse_quote!(bool));
    let end = end_of(scene, &producer.data, &access.segments[1..])?;
    if end.is_some_and(|end| compare(&end, &wanted) == Comparison::Different) {
        return Err(Refused {
            code: Code::TypeMismatch,
            message: format!(
                "`{written}` is no `bool`, so nothing can be recorded while it is true"
            ),
            help: format!(
                "name an output of type `bool`, or a field of one; `{name}` is `{}`",
                producer.data.text
            ),
        });
    }
    Ok(Condition {
        instance,
        producer: producer.node,
        access,
    })
}

/// What lies at the end of a path, by the names that serde gives: the robot looks by them, too. `None`: only it knows.
fn end_of(
    scene: &Scene<'_>,
    output: &Resolved,
    below: &[Segment],
) -> Result<Option<Resolved>, Refused> {
    let mut data = output.clone();
    for Segment { name, .. } in below {
        data = match part(&data, name, scene.sources) {
            Part::Of(inner) => inner,
            Part::Unknown => match component(&data, name) {
                Component::Field(inner) => inner,
                Component::Absent(_) | Component::Unknown => return Ok(None),
            },
            Part::None(names) => {
                return Err(Refused {
                    code: Code::TypeMismatch,
                    message: format!("`{}` has no part `{name}`", data.text),
                    help: suggestion(name, names.iter().map(String::as_str), "its parts are"),
                });
            }
        };
    }
    Ok(Some(data))
}

/// The instance in front of the path, if there is one.
fn instance_of<'p>(
    scene: &Scene<'_>,
    written: &'p str,
) -> Result<(Option<InstanceId>, &'p str), Refused> {
    match instance_in_front(written) {
        (Some(first), rest) => {
            let Some(id) = scene.instance(first) else {
                return Err(Refused {
                    code: Code::UnknownInstance,
                    message: format!("there is no instance `{first}`"),
                    help: suggestion(first, scene.instance_names(), "the instances are"),
                });
            };
            Ok((Some(id), rest))
        }
        (None, path) => Ok((None, path)),
    }
}

/// `Control.is_wanted` as instance and path: names of instances begin with a capital, those of outputs do not.
pub(crate) fn instance_in_front(written: &str) -> (Option<&str>, &str) {
    match written.split_once('.') {
        Some((first, rest)) if first.starts_with(char::is_uppercase) => (Some(first), rest),
        _ => (None, written),
    }
}

fn access(path: &str) -> Access {
    let segments = path.split('.').map(|name| Segment {
        name: name.to_owned(),
        optional: false,
        instance: false,
    });
    Access {
        segments: segments.collect(),
        written: path.to_owned(),
    }
}
