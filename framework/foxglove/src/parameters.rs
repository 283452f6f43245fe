//! Parameters in Foxglove's words: one for each leaf of the robot's tree, named by its path.

use foxglove::websocket::{Parameter, ParameterValue};
use protocol::{Ask, Change, Good};
use serde_json::{Map, Number, Value};

use crate::Result;
use client::Robot;

/// These, or all where none is named. What has no name of its own there is left out.
pub(crate) fn read(robot: &mut Robot, names: &[String]) -> Result<Vec<Parameter>> {
    let path = String::new();
    let Good::Parameters(reading) = robot.ask(Ask::Parameters { path })? else {
        return Err("the robot does not tell its parameters".to_owned());
    };
    let leaves = reading.leaves.iter().map(|leaf| leaf.path.as_str());
    let wanted = leaves.filter(|leaf| names.is_empty() || names.iter().any(|name| name == leaf));
    let parameter = |name: &str| Parameter {
        name: name.to_owned(),
        r#type: None,
        value: at(&reading.value, name).and_then(to_foxglove),
    };
    Ok(wanted.map(parameter).collect())
}

/// All of them at once or none; gives them as they are then.
pub(crate) fn write(robot: &mut Robot, parameters: Vec<Parameter>) -> Result<Vec<Parameter>> {
    let names: Vec<_> = parameters.iter().map(|it| it.name.clone()).collect();
    let changes = parameters.into_iter().map(|parameter| Change {
        path: parameter.name,
        value: parameter.value.map_or(Value::Null, to_json),
    });
    let changes = changes.collect();
    robot.ask(Ask::Write { changes })?;
    read(robot, &names)
}

fn at<'value>(value: &'value Value, path: &str) -> Option<&'value Value> {
    path.split('.').try_fold(value, |value, name| match value {
        Value::Array(items) => items.get(name.parse::<usize>().ok()?),
        other => other.get(name),
    })
}

/// Nothing for what is not there.
fn to_foxglove(value: &Value) -> Option<ParameterValue> {
    Some(match value {
        Value::Null => return None,
        Value::Bool(value) => ParameterValue::Bool(*value),
        Value::Number(number) => match number.as_i64() {
            Some(number) => ParameterValue::Integer(number),
            None => ParameterValue::Float64(number.as_f64()?),
        },
        Value::String(text) => ParameterValue::String(text.clone()),
        Value::Array(items) => {
            ParameterValue::Array(items.iter().map(to_foxglove).collect::<Option<_>>()?)
        }
        Value::Object(entries) => {
            let entry = |(key, value): (&String, &Value)| Some((key.clone(), to_foxglove(value)?));
            ParameterValue::Dict(entries.iter().filter_map(entry).collect())
        }
    })
}

fn to_json(value: ParameterValue) -> Value {
    match value {
        ParameterValue::Integer(number) => number.into(),
        // What JSON cannot say, the robot refuses.
        ParameterValue::Float64(number) => {
            Number::from_f64(number).map_or(Value::Null, Value::Number)
        }
        ParameterValue::Bool(value) => value.into(),
        ParameterValue::String(text) => text.into(),
        ParameterValue::Array(items) => items.into_iter().map(to_json).collect(),
        ParameterValue::Dict(entries) => {
            let entries = entries
                .into_iter()
                .map(|(key, value)| (key, to_json(value)));
            Value::Object(entries.collect::<Map<_, _>>())
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{at, to_foxglove, to_json};

    #[test]
    fn values_come_back_as_they_were() {
        let value = json!({ "a": 1, "b": [0.5, true, "x"], "c": { "d": -7 } });
        let there = to_foxglove(&value).expect("nothing is absent");
        assert_eq!(to_json(there), value);
        assert_eq!(to_foxglove(&json!(null)), None);
        assert_eq!(at(&value, "b.2"), Some(&json!("x")));
        assert_eq!(at(&value, "c.d"), Some(&json!(-7)));
        assert_eq!(at(&value, "c.e"), None);
    }
}
