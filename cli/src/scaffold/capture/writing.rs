//! The lines of a captured test, and the values that they read.

use serde_json::{Map, Value, json};

use super::Capture;
use crate::graph::Field;
use crate::outcome::Refusal;

/// Names that the test has for itself.
const OWN_NAMES: &[&str] = &[
    "captured", "context", "created", "hardware", "node", "outputs",
];

/// A test that is being written.
pub(super) struct Writing<'a> {
    capture: Capture<'a>,
    instance: &'a str,
    /// By field of the cycle context.
    pub(super) values: Map<String, Value>,
    /// By field of the creation context.
    pub(super) creation: Map<String, Value>,
    pub(super) latest: Map<String, Value>,
    /// By field: what the procedure is asked, and what was answered.
    pub(super) calls: Map<String, Value>,
    /// Statements before the context.
    pub(super) before: Vec<String>,
    /// Statements behind the call.
    pub(super) after: Vec<String>,
    pub(super) probes: bool,
}

impl<'a> Writing<'a> {
    pub(super) fn new(capture: Capture<'a>, instance: &'a str) -> Self {
        Self {
            capture,
            instance,
            values: Map::new(),
            creation: Map::new(),
            latest: Map::new(),
            calls: Map::new(),
            before: Vec::new(),
            after: Vec::new(),
            probes: false,
        }
    }

    /// The right side of a field in the creation context, for `restore`.
    pub(super) fn creation_field(&mut self, field: &Field) -> Result<String, Refusal> {
        let snapshot = self.capture.snapshot;
        let name = field.name.as_str();
        let path = field.path.as_deref().unwrap_or_default();
        let (value, right) = match field.kind {
            "Parameter" => (
                at(&snapshot["parameters"], &self.of_instance(path)),
                self.borrowed("creation_value", field),
            ),
            "CyclerState" => (
                at(&snapshot["cycler_state_at_begin"], path),
                self.state("creation_value", field),
            ),
            "HardwareInterface" => return Ok("&hardware".to_owned()),
            _ => return Err(unknown(field)),
        };
        self.creation
            .insert(name.to_owned(), value.ok_or_else(|| absent(field))?);
        Ok(right)
    }

    /// The right side of a field in the cycle context; its value goes into the data.
    pub(super) fn field(&mut self, field: &Field) -> Result<String, Refusal> {
        let snapshot = self.capture.snapshot;
        let path = field.path.as_deref().unwrap_or_default();
        let variable = variable(&field.name);
        Ok(match field.kind {
            "CycleTime" => "captured.time()".to_owned(),
            "HardwareInterface" => "&hardware".to_owned(),
            "Parameter" => {
                let path = self.of_instance(path);
                self.keep(field, at(&snapshot["parameters"], &path))?;
                self.borrowed("value", field)
            }
            "CyclerState" => {
                self.keep(field, at(&snapshot["cycler_state"], path))?;
                self.state("value", field)
            }
            "PreviousInput" => {
                self.keep(field, at(&snapshot["previous"], path))?;
                self.borrowed("value", field)
            }
            "Input" | "RequiredInput" => {
                let of = match &field.instance {
                    None => Some(&snapshot["own"]),
                    Some(instance) => self.newest(instance).map(|other| &other["outputs"]),
                };
                self.keep(field, of.and_then(|of| at(of, path)))?;
                self.borrowed("value", field)
            }
            "LatestInput" => self.latest_input(field, path)?,
            "PerceptionInput" => {
                self.perception(field, path)?;
                self.series("series", field)
            }
            "HistoricInput" => {
                self.history(field, path)?;
                self.series("history", field)
            }
            "Procedure" => self.procedure(field, path),
            "AdditionalOutput" => {
                self.probes = true;
                self.before
                    .push(format!("let mut {variable} = AdditionalProbe::default();"));
                format!("{variable}.output()")
            }
            "MainOutput" => {
                self.before
                    .push(format!("let mut {variable} = Default::default();"));
                self.after.push(format!(
                    "captured.assert_output({:?}, &{variable});",
                    field.name
                ));
                format!("&mut {variable}")
            }
            _ => return Err(unknown(field)),
        })
    }

    fn of_instance(&self, path: &str) -> String {
        path.replace("$cycler_instance", &schema::snake_case(self.instance))
    }

    fn keep(&mut self, field: &Field, value: Option<Value>) -> Result<(), Refusal> {
        let value = value.ok_or_else(|| absent(field))?;
        self.values.insert(field.name.clone(), value);
        Ok(())
    }

    /// A value that the node only looks at.
    fn borrowed(&mut self, read: &str, field: &Field) -> String {
        let name = &field.name;
        if !is_optional(field) {
            return format!("&captured.{read}({name:?})");
        }
        let variable = variable(name);
        self.before.push(format!(
            "let {variable}: Option<_> = captured.{read}({name:?});"
        ));
        format!("{variable}.as_ref()")
    }

    /// A value that the node may change.
    fn state(&mut self, read: &str, field: &Field) -> String {
        let is_read_alone = |data: &str| data.starts_with('&');
        if field.data.as_deref().is_some_and(is_read_alone) {
            return self.borrowed(read, field);
        }
        let variable = variable(&field.name);
        self.before.push(format!(
            "let mut {variable} = captured.{read}({:?});",
            field.name
        ));
        format!("&mut {variable}")
    }

    /// The newest cycle of another instance that was seen.
    fn newest(&self, instance: &str) -> Option<&'a Value> {
        let others = self.capture.snapshot["others"].as_array()?;
        let mut others = others.iter();
        others.find(|other| other["instance"] == instance && other["kind"] == "latest")
    }

    fn latest_input(&mut self, field: &Field, path: &str) -> Result<String, Refusal> {
        let (name, variable) = (&field.name, variable(&field.name));
        let instance = field.instance.as_deref().unwrap_or_default();
        let Some(seen) = self.newest(instance) else {
            return Ok("None".to_owned());
        };
        self.keep(field, at(&seen["outputs"], path))?;
        let about =
            ["timestamp_ns", "cycle", "is_new"].map(|key| (key.to_owned(), seen[key].clone()));
        let about: Map<_, _> = about.into_iter().collect();
        self.latest.insert(name.clone(), about.into());
        let (data, look) = match is_optional(field) {
            true => (": Option<_>", format!("{variable}.as_ref()")),
            false => ("", format!("&{variable}")),
        };
        self.before
            .push(format!("let {variable}{data} = captured.value({name:?});"));
        Ok(format!("captured.latest({name:?}, {look})"))
    }

    /// Values by time, which the test reads with this method.
    fn series(&mut self, read: &str, field: &Field) -> String {
        let (name, variable) = (&field.name, variable(&field.name));
        let seen = match is_optional(field) {
            true => "seen_optional",
            false => "seen",
        };
        self.before
            .push(format!("let {variable} = captured.{read}({name:?});"));
        self.before
            .push(format!("let {variable} = {variable}.{seen}();"));
        format!("{variable}.input()")
    }

    fn perception(&mut self, field: &Field, path: &str) -> Result<(), Refusal> {
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
        self.keep(field, Some(both))
    }

    /// The values of finished cycles, and this cycle's.
    fn history(&mut self, field: &Field, path: &str) -> Result<(), Refusal> {
        let snapshot = self.capture.snapshot;
        let output = path.split('.').next().unwrap_or_default();
        let output = output.trim_end_matches('?');
        let below = path[output.len()..].trim_start_matches(['?', '.']);
        let past = snapshot["histories"][output].as_array().map(|past| {
            let past = past.iter().map(|entry| {
                let value = match below.is_empty() {
                    true => Some(entry["value"].clone()),
                    false => at(&entry["value"], below),
                };
                json!({ "timestamp_ns": entry["timestamp_ns"], "value": value })
            });
            past.collect::<Vec<_>>()
        });
        let now = at(&snapshot["own"], path);
        let both = past
            .zip(now)
            .map(|(past, value)| json!({ "past": past, "value": value }));
        self.keep(field, both)
    }

    fn procedure(&mut self, field: &Field, path: &str) -> String {
        let (name, variable) = (&field.name, variable(&field.name));
        let snapshot = self.capture.snapshot;
        let request = snapshot["calls"].get(path);
        let call = json!({
            "is_asked": request.is_some(),
            "request": request,
            "answer": snapshot["answers"].get(path),
        });
        self.calls.insert(name.clone(), call);
        self.before
            .push(format!("let mut {variable} = captured.call({name:?});"));
        self.after
            .push(format!("captured.assert_answer({name:?}, {variable});"));
        format!("{variable}.call()")
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

/// What the test calls a field's value.
fn variable(field: &str) -> String {
    match OWN_NAMES.contains(&field) {
        true => format!("{field}_of_context"),
        false => field.to_owned(),
    }
}

/// Whether the node sees an `Option` of what its path leads to.
fn is_optional(field: &Field) -> bool {
    let path = field.path.as_deref().unwrap_or_default();
    path.contains('?') && field.kind != "RequiredInput"
}

fn absent(field: &Field) -> Refusal {
    let message = format!(
        "the cycle does not have what `{}` reads: whoever writes it had not run yet",
        field.name
    );
    Refusal::bad(message).help("name a later cycle")
}

fn unknown(field: &Field) -> Refusal {
    let (name, kind) = (&field.name, field.kind);
    let message = format!("`{name}` is of the kind `{kind}`, which cannot be captured");
    Refusal::bad(message).help("write its test by hand")
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
