//! JSON schemas, and what a validator says of random values.

use std::io::Write;
use std::process::{Command, Stdio};

use framework::Reflect;
use framework::reflect::Shape;
use framework::testing::skip;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::odd::{Tree, odd};
use super::{Ball, Everything, Motion, everything};

#[derive(Deserialize, Reflect, Serialize)]
struct Limited {
    /// How far it goes.
    #[reflect(unit = "m", range = 0.0..=1.5)]
    reach: f32,
    #[reflect(range = ..100)]
    count: u8,
    #[reflect(range = -1..=1)]
    corners: Vec<Option<i32>>,
}

#[test]
fn a_schema_tells_docs_units_ranges_and_names() {
    let schema = Limited::shape().json_schema();
    assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    assert!(
        schema["title"]
            .as_str()
            .is_some_and(|title| title.ends_with("::Limited"))
    );
    assert_eq!(schema["required"], json!(["reach", "count", "corners"]));
    let properties = &schema["properties"];
    assert_eq!(
        properties["reach"],
        json!({"type": "number", "title": "f32", "description": "How far it goes.", "x-unit": "m", "minimum": 0.0, "maximum": 1.5})
    );
    assert_eq!(
        properties["count"],
        json!({"type": "integer", "title": "u8", "minimum": 0, "exclusiveMaximum": 100.0})
    );
    let item = &properties["corners"]["items"]["anyOf"][0];
    assert_eq!(
        (&item["minimum"], &item["maximum"]),
        (&json!(-1.0), &json!(1.0))
    );
    assert_eq!(
        Ball::shape().json_schema()["description"],
        "A struct with documentation."
    );
    assert_eq!(
        Motion::shape().json_schema()["anyOf"][1]["description"],
        "On the way."
    );
}

#[test]
fn only_a_type_inside_of_itself_has_a_reference() {
    let text = |shape: Shape| shape.json_schema().to_string();
    assert!(!text(Everything::shape()).contains("$ref"));
    let tree = Tree::shape().json_schema();
    let definitions = tree["definitions"].as_object().expect("there are some");
    assert_eq!(definitions.len(), 1);
    assert_eq!(
        tree["properties"]["branches"]["description"],
        "Smaller trees."
    );
    let reference = &tree["properties"]["branches"]["items"]["$ref"];
    let name = reference.as_str().expect("it is one").rsplit('/').next();
    assert!(
        definitions.contains_key(name.expect("it has a name")),
        "{tree}"
    );
}

fn samples<T: Reflect + std::fmt::Debug>(values: impl Strategy<Value = T>) -> Value {
    let mut runner = TestRunner::deterministic();
    let samples = (0..60).map(|_| {
        let value = values.new_tree(&mut runner).expect("it makes values");
        serde_json::to_value(value.current().as_serialize()).expect("it has a serde form")
    });
    json!({"schema": T::shape().json_schema(), "values": samples.collect::<Vec<_>>()})
}

/// Asks Python's `jsonschema`; `None` where it is not installed.
fn verdicts(cases: &Value) -> Option<Vec<Vec<String>>> {
    const SCRIPT: &str = "
import json, sys
from jsonschema import Draft7Validator as Validator
answers = []
for case in json.load(sys.stdin):
    Validator.check_schema(case['schema'])
    validator = Validator(case['schema'])
    answers.append([' | '.join(e.message[:300] for e in validator.iter_errors(v)) for v in case['values']])
json.dump(answers, sys.stdout)
";
    let is_there = Command::new("python3")
        .args(["-c", "import jsonschema"])
        .stderr(Stdio::null())
        .status();
    if !is_there.is_ok_and(|status| status.success()) {
        return None;
    }
    let mut python = Command::new("python3")
        .args(["-c", SCRIPT])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("it was there");
    let mut input = python.stdin.take().expect("it is piped");
    input
        .write_all(cases.to_string().as_bytes())
        .expect("it reads");
    drop(input);
    let output = python.wait_with_output().expect("it ends");
    assert!(output.status.success(), "a schema is no schema");
    Some(serde_json::from_slice(&output.stdout).expect("it answers in JSON"))
}

#[test]
fn random_values_are_valid_and_others_are_not() {
    let mut cases = vec![samples(everything()), samples(odd())];
    // For every field of a struct one value that cannot be it.
    let wrong = Everything::shape().json_schema();
    let good = cases[0]["values"][0].clone();
    let names: Vec<String> = good
        .as_object()
        .expect("it is a struct")
        .keys()
        .cloned()
        .collect();
    let broken = names.iter().map(|name| {
        let mut value = good.clone();
        value[name] = json!([{"nobody": "expects this"}]);
        value
    });
    let mut missing = good.clone();
    missing.as_object_mut().expect("it is one").remove("small");
    let mut more = good.clone();
    more["another"] = json!(1);
    let broken: Vec<Value> = broken.chain([missing, more]).collect();
    cases.push(json!({"schema": wrong, "values": broken}));
    let limits = [
        json!({"reach": 1.5, "count": 99, "corners": [1, null]}),
        json!({"reach": 1.6, "count": 99, "corners": []}),
        json!({"reach": 1.5, "count": 100, "corners": []}),
        json!({"reach": 1.5, "count": 99, "corners": [2]}),
    ];
    cases.push(json!({"schema": Limited::shape().json_schema(), "values": limits}));
    let Some(verdicts) = verdicts(&cases.into()) else {
        skip(
            "random_values_are_valid_and_others_are_not",
            "Python's jsonschema",
        );
        return;
    };
    for (verdict, kind) in verdicts.iter().zip(["everything", "odd"]) {
        assert_eq!(verdict.len(), 60);
        let complaints: Vec<_> = verdict.iter().filter(|it| !it.is_empty()).collect();
        assert!(complaints.is_empty(), "{kind}: {complaints:#?}");
    }
    for (verdict, name) in verdicts[2]
        .iter()
        .zip(names.iter().map(String::as_str).chain(["missing", "more"]))
    {
        assert!(!verdict.is_empty(), "{name} is accepted as anything");
    }
    let accepted: Vec<_> = verdicts[3].iter().map(String::is_empty).collect();
    assert_eq!(accepted, [true, false, false, false]);
}
