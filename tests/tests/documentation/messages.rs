//! The page about every message of the protocol, written from the schemas that clients use.

use std::fmt::Write;
use std::fs;

use serde_json::{Map, Value, json};
use support::root;

const HEAD: &str = "\
# Messages of the protocol

Every message and every type, from the schemas that clients use ([what a client sends](../protocol/request.schema.json), [what a robot sends](../protocol/message.schema.json)).
[protocol.md](../protocol.md) says how they play together, and what is refused. Written by the test `pages_of_the_reference_are_current`.

```text
client: { \"id\": 1, \"ask\": { \"read\": { \"path\": \"Control.main_outputs.level\" } } }
robot:  { \"answer\": { \"id\": 1, \"ok\": { \"value\": { \"cycle\": 812, \"time\": 9744000000, \"value\": 0.5 } } } }
```
";

/// The whole page.
pub(super) fn page() -> String {
    let [request, message] = ["request", "message"].map(load);
    let mut text = HEAD.to_owned();
    text.push_str("\n## What a client asks\n");
    for (name, about, fields) in variants(&request["$defs"]["Ask"]) {
        write!(text, "\n### Ask: {name}\n\n{about}\n\n").expect("it is a text");
        let ask = json!({ "id": 1, "ask": { name: smallest(fields) } });
        let line = ask.to_string();
        let parsed: Result<protocol::Request, _> = serde_json::from_value(ask);
        assert!(parsed.is_ok(), "{line}: {parsed:?}");
        write!(text, "```json\n{line}\n```\n{}", table(fields)).expect("it is a text");
    }
    text.push_str("\n## What a robot says\n\n| Message | | |\n|---|---|---|\n");
    for (name, about, data) in variants(&message) {
        writeln!(text, "| `{name}` | {} | {about} |", spell(data)).expect("it is a text");
    }
    text.push_str("\n## Types\n");
    let mut types = definitions(&message);
    types.extend(definitions(&request));
    for (name, data) in types.iter().filter(|(name, _)| *name != "Ask") {
        write!(text, "\n### {name}\n\n{}\n", about(data)).expect("it is a text");
        text.push_str(&table(data));
        text.push_str(&choices(data));
    }
    text
}

fn load(name: &str) -> Value {
    let path = root().join(format!("docs/protocol/{name}.schema.json"));
    let text = fs::read_to_string(path).expect("the schemas are checked in");
    serde_json::from_str(&text).expect("a schema is JSON")
}

fn definitions(schema: &Value) -> Map<String, Value> {
    let all = schema["$defs"].as_object();
    all.expect("a schema has definitions").clone()
}

/// What stands in a table of Markdown.
fn about(value: &Value) -> String {
    let text = value["description"].as_str().unwrap_or_default();
    // Names of Rust are links in its own documentation alone.
    let text = text.replace("[`", "`").replace("`]", "`");
    text.replace('\n', " ").replace('|', "\\|")
}

/// Of something that is written as `{ NAME: … }`, every name with what it is about and what stands behind it.
fn variants(of: &Value) -> Vec<(&str, String, &Value)> {
    let variants = of["oneOf"].as_array().expect("it is one of several");
    let named = variants.iter().map(|variant| {
        let mut fields = variant["properties"].as_object().into_iter().flatten();
        let (name, data) = fields.next().expect("a message has a name");
        (name.as_str(), about(variant), data)
    });
    named.collect()
}

/// The request with nothing but what it needs.
fn smallest(fields: &Value) -> Value {
    let required = fields["required"].as_array().into_iter().flatten();
    let names = required.filter_map(Value::as_str);
    let samples = names.map(|name| (name.to_owned(), sample(name)));
    Value::Object(samples.collect())
}

fn sample(field: &str) -> Value {
    match field {
        "changes" => json!([{ "path": "lamp.level", "value": 0.5 }]),
        "instance" => json!("VisionTop"),
        "layer" => json!("default"),
        "level" => json!("debug"),
        "outputs" => json!({ "balls": [] }),
        "path" => json!("Control.main_outputs.level"),
        "seconds" => json!(2.5),
        "subscription" => json!(1),
        "time" => json!(9_731_000_000_u64),
        "token" => json!("secret"),
        "value" => json!(0.5),
        field => panic!("say here what a client may write for `{field}`"),
    }
}

/// The fields of an object; nothing where it has none.
fn table(of: &Value) -> String {
    let Some(fields) = of["properties"].as_object().filter(|all| !all.is_empty()) else {
        return String::new();
    };
    let required = of["required"].as_array().cloned().unwrap_or_default();
    let mut text = "\n| Field | Type | | Meaning |\n|---|---|---|---|\n".to_owned();
    for (name, value) in fields {
        let is_required = required.iter().any(|one| one == name);
        let is_required = if is_required { "" } else { "may be left out" };
        let (spelt, meaning) = (spell(value), about(value));
        writeln!(text, "| `{name}` | {spelt} | {is_required} | {meaning} |").expect("it is a text");
    }
    text
}

/// What something may be that is one of several; nothing where it is not.
fn choices(of: &Value) -> String {
    let Some(variants) = of["oneOf"].as_array() else {
        return String::new();
    };
    let mut text = "\n| One of | Meaning |\n|---|---|\n".to_owned();
    for variant in variants {
        let (form, meaning) = (form(variant), about(variant));
        writeln!(text, "| {form} | {meaning} |").expect("it is a text");
    }
    text
}

/// How one of several is written.
fn form(variant: &Value) -> String {
    if let Some(word) = variant["const"].as_str() {
        return format!("`\"{word}\"`");
    }
    let fields = variant["properties"].as_object().into_iter().flatten();
    let fields = fields.map(|(name, value)| format!("`{name}`: {}", spell(value)));
    fields.collect::<Vec<_>>().join(", ")
}

/// A type as people say it.
fn spell(of: &Value) -> String {
    if let Some(name) = of["$ref"].as_str() {
        let name = name.trim_start_matches("#/$defs/");
        return format!("[{name}](#{})", name.to_lowercase());
    }
    if let Some(word) = of["const"].as_str() {
        return format!("`\"{word}\"`");
    }
    let others = ["anyOf", "oneOf"].map(|key| of[key].as_array().into_iter().flatten());
    let others: Vec<String> = others.into_iter().flatten().map(spell).collect();
    if !others.is_empty() {
        return others.join(" or ");
    }
    let types = match &of["type"] {
        Value::Array(types) => types.iter().filter_map(Value::as_str).collect(),
        one => Vec::from_iter(one.as_str()),
    };
    let words = types.into_iter().map(|one| match one {
        "array" => format!("list of {}", spell(&of["items"])),
        "object" if of["properties"].is_object() => format!("{{ {} }}", form(of)),
        one => one.to_owned(),
    });
    let words: Vec<String> = words.collect();
    if words.is_empty() {
        "any value".to_owned()
    } else {
        words.join(" or ")
    }
}
