//! A test of a node from one cycle of a recording: what the node took as a data file, and the test that reads it.

use camino::Utf8PathBuf;
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::{Changes, own_member};
use crate::graph::{Context, Cycler, Field, Node};
use crate::outcome::Refusal;
use crate::render::render_template;
use crate::resolve::robot::Robot;
use crate::workspace::Workspace;

/// Which call of which node.
#[derive(Clone, Copy, Debug)]
pub struct Capture<'a> {
    pub cycler: &'a Cycler,
    pub node: &'a Node,
    /// What the robot's program says of the cycle.
    pub snapshot: &'a Value,
}

/// What the template is told.
#[derive(Serialize)]
struct Test<'a> {
    name: &'a str,
    function: String,
    node: &'a str,
    module: &'a str,
    type_name: &'a str,
    instance: &'a str,
    cycle: u64,
    probes: bool,
    before: Vec<String>,
    fields: Vec<Line>,
    after: Vec<String>,
    uses_outputs: bool,
}

#[derive(Serialize)]
struct Line {
    name: String,
    value: String,
}

/// Whether a node can be captured at all, as far as that is known without a recording.
///
/// # Errors
/// With what stands against it.
pub fn check_capturable(node: &Node, restores: bool) -> Result<(), Refusal> {
    let refuse = |what: &str, help: &str| {
        let message = format!("`{}` cannot be captured: {what}", node.path);
        Err(Refusal::bad(message).help(help.to_owned()))
    };
    if node.setup {
        let what = "it is a setup node, which a replay does not call";
        return refuse(what, "capture a node that reads what it writes");
    }
    if restores {
        let what = "its state is made whole by `restore`, of what `new` is told";
        return refuse(
            what,
            "write its test by hand, or keep all of its state in the recording",
        );
    }
    let cycle = || {
        node.fields
            .iter()
            .filter(|field| field.context == Context::Cycle)
    };
    for (kind, what, help) in [
        (
            "HardwareInterface",
            "it uses the hardware, which a test would have to stand for",
            "write its test by hand with a hardware of its own",
        ),
        (
            "Procedure",
            "it answers calls, which the recording has in another form",
            "write its test by hand",
        ),
        (
            "HistoricInput",
            "it reads the past, which lies in other frames",
            "write its test by hand with `framework::testing::history`",
        ),
    ] {
        if let Some(field) = cycle().find(|field| field.kind == kind) {
            return refuse(&format!("with `{}` {what}", field.name), help);
        }
    }
    Ok(())
}

/// The test and its data, in the node's crate.
///
/// # Errors
/// If the snapshot does not have what the node reads.
pub fn capture(
    workspace: &Workspace,
    robot: &Robot,
    capture: Capture<'_>,
) -> Result<Changes, Refusal> {
    let Capture { node, snapshot, .. } = capture;
    let library = node.path.split("::").next().unwrap_or_default();
    let member = own_member(workspace, &robot.generated, library)?;
    let instance = snapshot["instance"].as_str().unwrap_or_default();
    let cycle = snapshot["cycle"].as_u64().unwrap_or_default();
    let last = node.path.rsplit("::").next().unwrap_or_default();
    let name = format!("{last}_{}_{cycle}", schema::snake_case(instance));
    let mut writing = Writing {
        capture,
        instance,
        values: Map::new(),
        latest: Map::new(),
        before: Vec::new(),
        probes: false,
    };
    let mut fields = Vec::new();
    for field in &node.fields {
        if field.context == Context::Cycle {
            let value = writing.field(field)?;
            let name = field.name.clone();
            fields.push(Line { name, value });
        }
    }
    let (after, uses_outputs) = comparisons(node);
    let test = Test {
        name: &name,
        function: format!(
            "{last}_computes_cycle_{cycle}_of_{}_again",
            schema::snake_case(instance)
        ),
        node: &node.path,
        module: &node.path,
        type_name: &node.type_name,
        instance,
        cycle,
        probes: writing.probes,
        before: writing.before,
        fields,
        after,
        uses_outputs,
    };
    let data = json!({
        "version": 1,
        "node": node.path,
        "instance": instance,
        "cycle": cycle,
        "start_ns": snapshot["start_ns"],
        "since_last_ns": snapshot["since_last_ns"],
        "state": snapshot["state"],
        "fields": writing.values,
        "latest": writing.latest,
        "outputs": snapshot["outputs"],
    });
    let data = serde_json::to_string_pretty(&data).expect("JSON has only string keys");
    let folder: Utf8PathBuf = member.folder.join("tests");
    let text = render_template("captured", templates::node::CAPTURED_RS, &test);
    Ok(Changes::from([
        (folder.join(format!("{name}.rs")), Some(text)),
        (
            folder.join(format!("captured/{name}.json")),
            Some(format!("{data}\n")),
        ),
    ]))
}

/// Statements that compare all outputs, and whether returned ones are among them.
fn comparisons(node: &Node) -> (Vec<String>, bool) {
    let outputs = node
        .fields
        .iter()
        .filter(|field| field.kind == "MainOutput");
    let lines = outputs.clone().map(|field| {
        let name = &field.name;
        match field.context {
            Context::Outputs => format!("captured.assert_output({name:?}, &outputs.{name}.value);"),
            _ => format!("captured.assert_output({name:?}, &{name});"),
        }
    });
    let returned = outputs
        .clone()
        .any(|field| field.context == Context::Outputs);
    (lines.collect(), returned)
}

/// A test that is being written.
struct Writing<'a> {
    capture: Capture<'a>,
    instance: &'a str,
    /// By field.
    values: Map<String, Value>,
    latest: Map<String, Value>,
    before: Vec<String>,
    probes: bool,
}

impl Writing<'_> {
    /// The right side of a field in the context; its value goes into the data.
    fn field(&mut self, field: &Field) -> Result<String, Refusal> {
        let snapshot = self.capture.snapshot;
        let name = field.name.as_str();
        let path = field.path.as_deref().unwrap_or_default();
        let optional = path.contains('?') && field.kind != "RequiredInput";
        let value = if optional {
            format!("captured.value::<Option<_>>({name:?}).as_ref()")
        } else {
            format!("&captured.value({name:?})")
        };
        Ok(match field.kind {
            "CycleTime" => "captured.time()".to_owned(),
            "Parameter" => {
                let path = path.replace("$cycler_instance", &schema::snake_case(self.instance));
                self.keep(field, at(&snapshot["parameters"], &path))?;
                value
            }
            "CyclerState" => {
                self.keep(field, at(&snapshot["cycler_state"], path))?;
                if field
                    .data
                    .as_deref()
                    .is_some_and(|data| data.starts_with('&'))
                {
                    return Ok(value);
                }
                self.before
                    .push(format!("let mut {name} = captured.value({name:?});"));
                format!("&mut {name}")
            }
            "PreviousInput" => {
                self.keep(field, at(&snapshot["previous"], path))?;
                value
            }
            "Input" | "RequiredInput" => {
                let of = match &field.instance {
                    None => Some(&snapshot["own"]),
                    Some(instance) => self.newest(instance).map(|other| &other["outputs"]),
                };
                self.keep(field, of.and_then(|of| at(of, path)))?;
                value
            }
            "LatestInput" => self.latest_input(field, path, optional)?,
            "PerceptionInput" => self.series(field, path, optional)?,
            "AdditionalOutput" => {
                self.probes = true;
                self.before
                    .push(format!("let mut {name} = AdditionalProbe::default();"));
                format!("{name}.output()")
            }
            "MainOutput" => {
                self.before
                    .push(format!("let mut {name} = Default::default();"));
                format!("&mut {name}")
            }
            other => {
                let message =
                    format!("`{name}` is of the kind `{other}`, which cannot be captured");
                return Err(Refusal::bad(message).help("write its test by hand"));
            }
        })
    }

    fn keep(&mut self, field: &Field, value: Option<Value>) -> Result<(), Refusal> {
        let value = value.ok_or_else(|| {
            let message = format!(
                "the cycle does not have what `{}` reads: whoever writes it had not run yet",
                field.name
            );
            Refusal::bad(message).help("name a later cycle")
        })?;
        self.values.insert(field.name.clone(), value);
        Ok(())
    }

    /// The newest cycle of another instance that was seen.
    fn newest(&self, instance: &str) -> Option<&Value> {
        let others = self.capture.snapshot["others"].as_array()?;
        let mut others = others.iter();
        others.find(|other| other["instance"] == instance && other["kind"] == "latest")
    }

    fn latest_input(
        &mut self,
        field: &Field,
        path: &str,
        optional: bool,
    ) -> Result<String, Refusal> {
        let name = field.name.as_str();
        let instance = field.instance.as_deref().unwrap_or_default();
        let Some(seen) = self.newest(instance).cloned() else {
            return Ok("None".to_owned());
        };
        self.keep(field, at(&seen["outputs"], path))?;
        let about =
            ["timestamp_ns", "cycle", "is_new"].map(|key| (key.to_owned(), seen[key].clone()));
        let about: Map<_, _> = about.into_iter().collect();
        self.latest.insert(name.to_owned(), about.into());
        Ok(if optional {
            self.before
                .push(format!("let {name}: Option<_> = captured.value({name:?});"));
            format!("captured.latest({name:?}, {name}.as_ref())")
        } else {
            self.before
                .push(format!("let {name} = captured.value({name:?});"));
            format!("captured.latest({name:?}, &{name})")
        })
    }

    fn series(&mut self, field: &Field, path: &str, optional: bool) -> Result<String, Refusal> {
        let name = field.name.as_str();
        let snapshot = self.capture.snapshot;
        let written = field.instance.as_deref().unwrap_or_default();
        let instances = self.instances(written);
        let others = snapshot["others"].as_array();
        let place = |other: &Value| instances.iter().position(|one| other["instance"] == **one);
        let part = |kind: &str| -> Vec<Value> {
            let others = others.into_iter().flatten();
            let mut seen: Vec<_> = others
                .filter(|other| other["kind"] == kind && place(other).is_some())
                .collect();
            let number = |other: &Value, key: &str| other[key].as_u64();
            seen.sort_by_key(|other| {
                (
                    number(other, "order_ns"),
                    number(other, "timestamp_ns"),
                    place(other),
                    number(other, "cycle"),
                )
            });
            let seen = seen.into_iter().map(|other| {
                let value = at(&other["outputs"], path);
                json!({ "timestamp_ns": other["timestamp_ns"], "value": value })
            });
            seen.collect()
        };
        let both = json!({ "persistent": part("persistent"), "transient": part("transient") });
        self.keep(field, Some(both))?;
        let seen = if optional { "seen_optional" } else { "seen" };
        self.before
            .push(format!("let {name} = captured.series({name:?});"));
        self.before.push(format!("let {name} = {name}.{seen}();"));
        Ok(format!("{name}.input()"))
    }

    /// Of a cycler all, of an instance itself.
    fn instances(&self, written: &str) -> Vec<String> {
        let others = self.capture.snapshot["cyclers"][written].as_array();
        match others {
            Some(names) => names
                .iter()
                .filter_map(|name| name.as_str().map(str::to_owned))
                .collect(),
            None => vec![written.to_owned()],
        }
    }
}

/// The value at a path whose `?` look into what may be absent; `None`: there is no such place.
fn at(value: &Value, path: &str) -> Option<Value> {
    path.split('.').try_fold(value.clone(), |value, part| {
        let name = part.trim_end_matches('?');
        match value {
            Value::Null => Some(Value::Null),
            value => value.get(name).cloned(),
        }
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::at;

    #[test]
    fn paths_lead_into_what_may_be_absent() {
        let value = json!({"a": {"b": null, "c": {"d": 1}}});
        assert_eq!(at(&value, "a.c?.d"), Some(json!(1)));
        assert_eq!(at(&value, "a.b?.d"), Some(json!(null)));
        assert_eq!(at(&value, "a.x"), None);
    }
}
