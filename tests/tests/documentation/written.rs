//! Pages of the reference that are written from what they are about.

use std::fmt::Write;

use clap::{CommandFactory, Parser};
use hulkgen::arguments::Arguments;
use hulkgen::diagnostics::Code;
use serde_json::Value;

/// Every page of this kind: its path, and its text.
pub(crate) fn pages() -> [(&'static str, String); 4] {
    [
        ("docs/reference/cli.md", command_line()),
        ("docs/reference/diagnostics.md", diagnostics()),
        ("docs/reference/manifest.md", manifest()),
        ("docs/reference/messages.md", super::messages::page()),
    ]
}

/// What `--help` of every command prints.
fn command_line() -> String {
    let mut text = "# The command line\n\nWhat `--help` says, command by command. Written by the test `pages_of_the_reference_are_current`.\n".to_owned();
    let mut command = Arguments::command();
    command.build();
    describe(&command, &mut vec!["hulkgen".to_owned()], &mut text);
    text
}

fn describe(command: &clap::Command, path: &mut Vec<String>, text: &mut String) {
    let words = path.iter().map(String::as_str).chain(["--help"]);
    let help = Arguments::try_parse_from(words).expect_err("help is no arguments");
    let help = help.to_string();
    let lines: Vec<&str> = help.trim_end().lines().map(str::trim_end).collect();
    let name = path.join(" ");
    write!(text, "\n## {name}\n\n```text\n{}\n```\n", lines.join("\n")).expect("it is a text");
    let below = command.get_subcommands();
    for command in below.filter(|command| command.get_name() != "help") {
        path.push(command.get_name().to_owned());
        describe(command, path, text);
        path.pop();
    }
}

/// Every code with what it is about.
fn diagnostics() -> String {
    let mut text = "\
# Diagnostics

Every code, in the order of the alphabet; errors keep the robot from being generated. `hulkgen explain CODE` prints the page behind the link. Written by the test
`pages_of_the_reference_are_current`.

```sh
hulkgen explain unknown-output
hulkgen check --format json | jq '.diagnostics[].code'
```

| Code | | What is wrong |
|---|---|---|
"
    .to_owned();
    for code in Code::ALL {
        let (name, severity, title) = (code.name(), code.severity().name(), code.title());
        writeln!(
            text,
            "| [{name}](../diagnostics/{name}.md) | {severity} | {title} |"
        )
        .expect("it is a text");
    }
    text
}

/// Every table of hulk.toml with its keys, from the schema that editors use.
fn manifest() -> String {
    let schema: Value = serde_json::from_str(&schema::json_schema()).expect("it is JSON");
    let mut text = "\
# The manifest

Every table and key of `hulk.toml`, from the schema that editors use (`hulkgen schema`). [contract.md](../contract.md) has it as one example with comments. Written by the test
`pages_of_the_reference_are_current`.

```toml
[robot]
name = \"lamp\"

[[cycler]]
name = \"Control\"
kind = \"real-time\"
setup_nodes = [\"nodes::clock\"]
nodes = [{ node = \"nodes::lamp\", on_failure = \"hold\" }]

[[target]]
name = \"simulation\"
hardware = \"simulation::Hardware\"
```
"
    .to_owned();
    let tables = [
        ("`[robot]`", "Robot"),
        ("`[[cycler]]`", "Cycler"),
        ("An entry of `instances` as a table", "InstanceTable"),
        (
            "An entry of `setup_nodes` or `nodes` as a table",
            "NodeTable",
        ),
        ("`scheduling`", "Scheduling"),
        ("`record` as a table", "RecordSome"),
        ("`[[target]]`", "Target"),
        ("`[target.deploy]`", "Deploy"),
        ("`[[bridge]]`", "Bridge"),
    ];
    for (heading, name) in tables {
        let table = &schema["$defs"][name];
        let about = table["description"].as_str().unwrap_or_default();
        write!(
            text,
            "\n## {heading}\n\n{about}\n\n| Key | | Meaning |\n|---|---|---|\n"
        )
        .expect("it is a text");
        for (key, value, is_required) in keys(table) {
            let meaning = value["description"].as_str().unwrap_or_default();
            let choices = choices(&schema, &value);
            writeln!(text, "| `{key}` | {is_required} | {meaning}{choices} |")
                .expect("it is a text");
        }
    }
    text
}

/// Keys of a table, or of all the tables of which it may be one, each with whether it has to be there.
fn keys(table: &Value) -> Vec<(String, Value, &'static str)> {
    let variants = table["oneOf"].as_array().cloned().unwrap_or_default();
    let of_variants = variants.iter().flat_map(|variant| {
        let mut keys = keys(variant);
        for (_, value, is_required) in &mut keys {
            // Each variant requires its own key.
            *is_required = "one of these";
            if value["description"].is_null() {
                value["description"] = variant["description"].clone();
            }
        }
        keys
    });
    let is_required = |key: &String| {
        let required = table["required"].as_array().into_iter().flatten();
        match required.into_iter().any(|one| one == key) {
            true => "required",
            false => "",
        }
    };
    let own = table["properties"].as_object().into_iter().flatten();
    let own = own.map(|(key, value)| (key.clone(), value.clone(), is_required(key)));
    own.chain(of_variants).collect()
}

/// The words that a value may be, each with its meaning.
fn choices(schema: &Value, value: &Value) -> String {
    let nullable = value["anyOf"][0]["$ref"].as_str();
    let Some(name) = value["$ref"].as_str().or(nullable) else {
        return String::new();
    };
    let named = &schema["$defs"][name.trim_start_matches("#/$defs/")];
    let words = named["oneOf"].as_array().into_iter().flatten();
    let words = words.filter_map(|one| {
        let word = one["const"].as_str()?;
        let meaning = one["description"].as_str().unwrap_or_default();
        Some(format!(" `\"{word}\"`: {meaning}"))
    });
    words.collect()
}
