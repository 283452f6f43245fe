//! What bridges map: every path of a `[[bridge]]` is something that the robot has, in a form that can be carried.

use camino::Utf8Path;
use grammar::CycleField;
use schema::{BridgeEncoding, Direction};

use super::parameter_files::shown::{Part, part, without_cdr};
use super::robot::{Access, Bridge, BridgeKind, Segment};
use super::scene::{Scene, SceneCycler};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, suggestion};
use crate::manifest::{self, Manifest};
use crate::scan::NodeSource;
use crate::scan::types::Resolved;
use crate::workspace::MANIFEST;

/// The word before the paths of parameters.
const PARAMETERS: &str = "parameters";
/// What an instance has for clients.
const GROUPS: [&str; 3] = ["main_outputs", "additional_outputs", "procedures"];
/// The procedure that every robot answers itself.
const REARM: &str = "framework.procedures.rearm";

/// What is wrong with a bridge, and what to do.
struct Refused {
    message: String,
    help: String,
}

/// What a path leads to.
struct Found {
    kind: BridgeKind,
    /// Unknown to hulkgen: `None`.
    data: Option<Resolved>,
    /// What a procedure is asked and answers, where hulkgen knows it.
    messages: Vec<Resolved>,
    /// The text of the type, also where its parts are not known.
    text: Option<String>,
}

/// Something with a name below which values lie.
struct Named {
    segments: Vec<String>,
    data: Resolved,
}

/// Every bridge of the manifest; an `invalid-bridge` for each that maps nothing.
pub(super) fn bridges(
    manifest: &Manifest,
    scene: &Scene<'_>,
    diagnostics: &mut Diagnostics,
) -> Vec<Bridge> {
    let bridges = manifest.bridges.iter().filter_map(|bridge| {
        let found = find(scene, &bridge.declared.path);
        let checked = found.and_then(|found| check(scene, bridge, &found).map(|()| found));
        match checked {
            Ok(found) => Some(resolved(bridge, found)),
            Err(Refused { message, help }) => {
                let place = bridge.path_range.clone();
                let error = Diagnostic::new(Code::InvalidBridge, message)
                    .at(Utf8Path::new(MANIFEST), place, "")
                    .help(help);
                diagnostics.add(error);
                None
            }
        }
    });
    bridges.collect()
}

fn resolved(bridge: &manifest::Bridge, found: Found) -> Bridge {
    let declared = &bridge.declared;
    Bridge {
        path: declared.path.clone(),
        kind: found.kind,
        data: found.text,
        key: declared.key.to_string(),
        direction: match found.kind {
            BridgeKind::Procedure => None,
            BridgeKind::Remote => Some(Direction::In),
            _ => Some(declared.direction.unwrap_or_default()),
        },
        encoding: declared.encoding,
        rate: declared.rate,
    }
}

/// Whether what is there can be carried in the way that is asked for.
fn check(scene: &Scene<'_>, bridge: &manifest::Bridge, found: &Found) -> Result<(), Refused> {
    let declared = &bridge.declared;
    let path = &declared.path;
    let refuse = |message: String, help: &str| {
        Err(Refused {
            message,
            help: help.to_owned(),
        })
    };
    let is_output = found.kind.is_output();
    match declared.direction {
        Some(Direction::In | Direction::Both) if is_output => {
            return refuse(
                format!("`{path}` is an output, which nodes alone write"),
                "remove `direction`; what comes from outside is a parameter, a procedure or hardware",
            );
        }
        Some(Direction::Out | Direction::Both) if found.kind == BridgeKind::Remote => {
            return refuse(
                format!("another machine runs `{path}`, and nothing of it goes out from here"),
                "remove `direction`, or write `direction = \"in\"`",
            );
        }
        Some(_) if found.kind == BridgeKind::Procedure => {
            return refuse(
                format!("`{path}` is a procedure, which has no direction"),
                "remove `direction`: whoever queries the key calls it and gets the answer",
            );
        }
        _ => {}
    }
    if let Some(rate) = declared.rate {
        if !is_output {
            return refuse(
                format!("`{path}` is no output, so `rate` means nothing"),
                "remove `rate`",
            );
        }
        if !(rate.is_finite() && rate > 0.0) {
            return refuse(
                format!("`{path}` cannot be sent {rate} times in a second"),
                "write a `rate` above 0, or none for every cycle",
            );
        }
    }
    if declared.encoding == BridgeEncoding::Cdr {
        if found.kind == BridgeKind::Remote {
            return refuse(
                format!("cycles of `{path}` are told as JSON, and have no form in CDR"),
                "write `encoding = \"json\"`, or none",
            );
        }
        let mut carried = found.data.iter().chain(&found.messages);
        let without = carried.find_map(|data| without_cdr(data, scene.sources));
        if let Some(part) = without {
            let help = match found.kind {
                BridgeKind::Procedure => "write `encoding = \"json\"`",
                _ => {
                    "write `encoding = \"json\"`, or name a part of it that consists of numbers, texts, lists and structs"
                }
            };
            return refuse(
                format!("`{path}` has no form in CDR because of `{part}`"),
                help,
            );
        }
    }
    Ok(())
}

fn find(scene: &Scene<'_>, path: &str) -> Result<Found, Refused> {
    if path == REARM {
        return Ok(Found {
            kind: BridgeKind::Procedure,
            data: None,
            messages: Vec::new(),
            text: None,
        });
    }
    let mut names = path.split('.');
    let first = names.next().unwrap_or_default();
    if first == PARAMETERS {
        let names: Vec<&str> = names.collect();
        return below(
            scene,
            path,
            &names,
            &parameters(scene),
            BridgeKind::Parameter,
        );
    }
    let Some(id) = scene.instance(first) else {
        let known = scene.instance_names().chain([PARAMETERS]);
        return Err(Refused {
            message: format!("there is no instance `{first}`"),
            help: suggestion(first, known, "a path begins with one of"),
        });
    };
    let cycler = &scene.cyclers[id.cycler];
    let group = names.next();
    if cycler.declared.declared.remote {
        return remote(path, first, group);
    }
    let group = group.unwrap_or_default();
    let names: Vec<&str> = names.collect();
    match group {
        "main_outputs" => below(
            scene,
            path,
            &names,
            &outputs(cycler),
            BridgeKind::MainOutput,
        ),
        "additional_outputs" => {
            let declared = additional(scene, cycler, first);
            below(scene, path, &names, &declared, BridgeKind::AdditionalOutput)
        }
        "procedures" => procedure(scene, cycler, &names.join(".")),
        _ => Err(Refused {
            message: format!("`{path}` names no output and no procedure of `{first}`"),
            help: suggestion(group, GROUPS, "behind the instance stands one of"),
        }),
    }
}

/// An instance that another machine runs: it is fed as a whole, and has nothing for clients.
fn remote(path: &str, instance: &str, group: Option<&str>) -> Result<Found, Refused> {
    match group {
        None => Ok(Found {
            kind: BridgeKind::Remote,
            data: None,
            messages: Vec::new(),
            text: None,
        }),
        Some(_) => Err(Refused {
            message: format!("`{path}` is not here: another machine runs `{instance}`"),
            help: format!("name the instance alone, `{instance}`: whoever has the key feeds it"),
        }),
    }
}

/// The value of this name, or the part of one.
fn below(
    scene: &Scene<'_>,
    path: &str,
    names: &[&str],
    known: &[Named],
    kind: BridgeKind,
) -> Result<Found, Refused> {
    let starts = |one: &&Named| {
        let mut both = one.segments.iter().zip(names);
        both.all(|(declared, name)| declared == name)
    };
    let found = |data: Option<Resolved>| Found {
        kind,
        text: data.as_ref().map(|data| data.text.clone()),
        data,
        messages: Vec::new(),
    };
    let Some(named) = known.iter().find(starts).filter(|_| !names.is_empty()) else {
        let paths: Vec<String> = known.iter().map(|one| one.segments.join(".")).collect();
        let names = names.join(".");
        return Err(Refused {
            message: match names.as_str() {
                "" => format!("`{path}` names no {}", kind.words()),
                names => format!("the robot has no {} `{names}`", kind.words()),
            },
            help: suggestion(&names, paths.iter().map(String::as_str), "there are"),
        });
    };
    if named.segments.len() > names.len() {
        return match kind {
            BridgeKind::Parameter => Ok(found(None)),
            _ => Err(Refused {
                message: format!("`{path}` holds several values"),
                help: format!("name one, for example `{}`", named.segments.join(".")),
            }),
        };
    }
    let mut data = named.data.clone();
    for name in &names[named.segments.len()..] {
        match part(&data, name, scene.sources) {
            Part::Of(inner) => data = inner,
            Part::Unknown => return Ok(found(None)),
            Part::None(fields) => {
                return Err(Refused {
                    message: format!("`{}` has no part `{name}`", data.text),
                    help: suggestion(name, fields.iter().map(String::as_str), "its parts are"),
                });
            }
        }
    }
    Ok(found(Some(data)))
}

fn procedure(scene: &Scene<'_>, cycler: &SceneCycler<'_>, name: &str) -> Result<Found, Refused> {
    let mut known = Vec::new();
    for (source, field) in fields(cycler) {
        let CycleField::Procedure(procedure) = field else {
            continue;
        };
        if procedure.name.text == name {
            let types = [&procedure.request, &procedure.response];
            let library = &scene.sources.library;
            let messages = types.map(|data| library.resolve(&source.module, data));
            return Ok(Found {
                kind: BridgeKind::Procedure,
                data: None,
                messages: messages.into(),
                text: None,
            });
        }
        known.push(procedure.name.text.as_str());
    }
    let of = cycler.declared.name();
    Err(Refused {
        message: format!("no node of cycler `{of}` answers a procedure `{name}`"),
        help: suggestion(name, known, "its procedures are"),
    })
}

fn outputs(cycler: &SceneCycler<'_>) -> Vec<Named> {
    let outputs = cycler.outputs.iter().map(|(name, producer)| Named {
        segments: vec![name.clone()],
        data: producer.data.clone(),
    });
    outputs.collect()
}

fn additional(scene: &Scene<'_>, cycler: &SceneCycler<'_>, instance: &str) -> Vec<Named> {
    let outputs = fields(cycler).filter_map(|(source, field)| match field {
        CycleField::AdditionalOutput(output) => Some(Named {
            segments: expand(&Access::of(&output.path).segments, instance),
            data: scene.sources.library.resolve(&source.module, &output.data),
        }),
        _ => None,
    });
    outputs.collect()
}

/// Every declared parameter, once for each instance where its path names one.
fn parameters(scene: &Scene<'_>) -> Vec<Named> {
    let mut parameters = Vec::new();
    for cycler in &scene.cyclers {
        for node in &cycler.nodes {
            for parameter in super::parameters::of_node(node) {
                let segments = Access::of(&parameter.path).segments;
                let library = &scene.sources.library;
                for instance in &cycler.declared.instances {
                    parameters.push(Named {
                        segments: expand(&segments, instance.name.as_str()),
                        data: library.resolve(&node.source.module, &parameter.data),
                    });
                }
            }
        }
    }
    // Of two that lie in each other the shorter knows more.
    parameters.sort_by_key(|one| (one.segments.len(), one.segments.clone()));
    parameters.dedup_by(|one, other| one.segments == other.segments);
    parameters
}

fn fields<'s>(
    cycler: &'s SceneCycler<'_>,
) -> impl Iterator<Item = (&'s NodeSource, &'s CycleField)> {
    cycler.nodes.iter().flat_map(|node| {
        let fields = node.source.cycle.fields.iter();
        fields.map(|field| (node.source, &field.kind))
    })
}

fn expand(segments: &[Segment], instance: &str) -> Vec<String> {
    let names = segments.iter().map(|segment| {
        if segment.instance {
            schema::snake_case(instance)
        } else {
            segment.name.clone()
        }
    });
    names.collect()
}
