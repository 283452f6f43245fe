//! `schema`: editors are told what the manifest's own reader accepts.

use serde_json::Value;
use support::{FIXTURES, root};

use crate::{answer, json};

/// As much of JSON Schema as the schema uses; `pattern` is left to the reader of the manifest.
struct Schema {
    whole: Value,
}

impl Schema {
    fn printed() -> Self {
        Self {
            whole: json(&answer("schema")),
        }
    }

    /// What is wrong with a manifest, by place.
    fn mistakes(&self, text: &str) -> Vec<String> {
        let manifest: toml::Table = toml::from_str(text).expect("it is TOML");
        let manifest = serde_json::to_value(manifest).expect("TOML has no other keys than strings");
        let mut mistakes = Vec::new();
        self.check(&self.whole, &manifest, "", &mut mistakes);
        mistakes
    }

    fn fits(&self, schema: &Value, value: &Value) -> bool {
        let mut mistakes = Vec::new();
        self.check(schema, value, "", &mut mistakes);
        mistakes.is_empty()
    }

    fn check(&self, schema: &Value, value: &Value, place: &str, mistakes: &mut Vec<String>) {
        let Value::Object(rules) = schema else {
            panic!("no schema: {schema}")
        };
        for (rule, told) in rules {
            let holds = match (rule.as_str(), told) {
                ("$schema" | "title" | "description" | "default" | "format" | "pattern", _) => true,
                // Looked at through `$ref` and with `properties`.
                ("$defs" | "additionalProperties", _) => true,
                ("$ref", Value::String(path)) => {
                    let path = path.trim_start_matches('#');
                    let target = self.whole.pointer(path);
                    let target = target.unwrap_or_else(|| panic!("`{path}` leads nowhere"));
                    self.check(target, value, place, mistakes);
                    true
                }
                ("type", Value::String(name)) => is(value, name),
                ("type", Value::Array(names)) => names
                    .iter()
                    .filter_map(Value::as_str)
                    .any(|name| is(value, name)),
                ("const", told) => value == told,
                ("anyOf", Value::Array(all)) => all.iter().any(|one| self.fits(one, value)),
                ("oneOf", Value::Array(all)) => {
                    all.iter().filter(|one| self.fits(one, value)).count() == 1
                }
                ("minimum", told) => value.as_f64().is_none_or(|it| Some(it) >= told.as_f64()),
                ("maximum", told) => value.as_f64().is_none_or(|it| Some(it) <= told.as_f64()),
                ("minItems", told) => {
                    let length = value.as_array().map(|items| items.len() as u64);
                    length.is_none_or(|length| Some(length) >= told.as_u64())
                }
                ("required", Value::Array(names)) => value.as_object().is_none_or(|entries| {
                    let mut names = names.iter().filter_map(Value::as_str);
                    names.all(|name| entries.contains_key(name))
                }),
                ("items", told) => {
                    for (index, item) in value.as_array().into_iter().flatten().enumerate() {
                        self.check(told, item, &format!("{place}.{index}"), mistakes);
                    }
                    true
                }
                ("properties", Value::Object(known)) => {
                    for (key, value) in value.as_object().into_iter().flatten() {
                        let place = format!("{place}.{key}");
                        match known.get(key) {
                            Some(schema) => self.check(schema, value, &place, mistakes),
                            None if rules.get("additionalProperties") == Some(&false.into()) => {
                                mistakes.push(format!("{place}: unknown"));
                            }
                            None => {}
                        }
                    }
                    true
                }
                (rule, told) => panic!("this test does not know `{rule}`: {told}"),
            };
            if !holds {
                mistakes.push(format!("{place}: {rule} {told}"));
            }
        }
    }
}

fn is(value: &Value, name: &str) -> bool {
    match name {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        name => panic!("no type `{name}`"),
    }
}

fn manifest(folder: &str) -> String {
    let path = root().join(folder).join("hulk.toml");
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn the_printed_schema_accepts_every_manifest_of_this_repository() {
    let schema = Schema::printed();
    let fixtures = FIXTURES.iter().map(|name| format!("tests/robots/{name}"));
    let others = ["".to_owned(), "tests/robots/zoo".to_owned()];
    for folder in fixtures.chain(others) {
        let mistakes = schema.mistakes(&manifest(&folder));
        assert_eq!(mistakes, Vec::<String>::new(), "{folder}/hulk.toml");
    }
}

#[test]
fn the_printed_schema_finds_what_the_reader_of_the_manifest_finds() {
    let schema = Schema::printed();
    let nao = manifest("");
    for (from, to, place) in [
        ("kind = \"real-time\"", "kind = \"sometimes\"", ".cycler"),
        ("name = \"nao\"", "nmae = \"nao\"", ".robot.nmae"),
        (
            "generated = \"generated\"",
            "generated = 1",
            ".robot.generated",
        ),
        ("[[target]]", "[[targets]]", ".targets"),
    ] {
        assert!(nao.contains(from), "`{from}` in hulk.toml");
        let mistakes = schema.mistakes(&nao.replacen(from, to, 1));
        let is_found = mistakes.iter().any(|mistake| mistake.starts_with(place));
        assert!(is_found, "{to}: {mistakes:?}");
    }
}
