//! Errors of rustc whose place in the generated crate names no node.

use camino::Utf8Path;
use serde_json::{Value, json};

use super::rustc::Message;
use super::{Home, diagnose};
use crate::diagnostics::{Diagnostics, to_json};
use crate::scan::fixture::{Fixture, Node};
use crate::workspace::Workspace;
use crate::{manifest, model, pipeline, render};

const FILE: &str = "crates/nodes/src/a.rs";

/// What is told of an error in the part of `Control` that starts its thread, with these notes.
fn told(children: &Value) -> Value {
    let node = Node {
        cycle: "hardware: HardwareInterface,",
        asks: "hardware::Motors",
        ..Node::default()
    };
    let robot = Fixture::control(&["a"]).node("a", node);
    told_at(&robot, "generated/src/runtime/control.rs", "", children)
}

/// What is told of an error where a generated file first has this text.
fn told_at(robot: &Fixture, file: &str, text: &str, children: &Value) -> Value {
    let workspace = Workspace::in_memory(robot.files());
    let mut found = Diagnostics::new();
    let manifest = manifest::load(&workspace, &mut found).expect("it has no errors");
    let understood = pipeline::understand(&workspace, &mut found).expect("it has no errors");
    let model = model::describe(&understood.robot, &understood.schedule);
    let files = render::render(&model);
    let mut lines = files[Utf8Path::new(file)].lines().enumerate();
    let place = lines.find_map(|(line, words)| Some((line + 1, words.find(text)? + 1)));
    let (line, column) = place.expect("it is generated");
    let mut primary = span(file, line, true);
    primary["column_start"] = column.into();
    let home = Home {
        workspace: &workspace,
        manifest: &manifest,
        robot: &understood.robot,
        model: &model,
        files: &files,
    };
    let message: Message = serde_json::from_value(json!({
        "message": "`Rc<u8>` cannot be sent between threads safely", "level": "error", "rendered": "all",
        "spans": [primary], "children": children,
    }))
    .expect("it is a message");
    let answer = to_json(&diagnose(&[message], &home), &workspace);
    answer["diagnostics"][0].clone()
}

fn span(file: &str, line: usize, is_primary: bool) -> Value {
    json!({
        "file_name": file, "byte_start": 0, "byte_end": 3, "line_start": line, "column_start": 1,
        "is_primary": is_primary, "label": null, "expansion": null,
    })
}

#[test]
fn a_note_about_a_file_of_the_authors_is_the_place() {
    let one = told(&json!([
        { "message": "it could be boxed", "level": "help", "spans": [span("crates/types/src/lib.rs", 1, true)] },
        { "message": "required because it appears within the type `Inner`", "level": "note",
            "spans": [span("crates/types/src/lib.rs", 2, true)] },
        { "message": "required because it appears within the type `Node`", "level": "note",
            "spans": [span(FILE, 5, true)] },
    ]));
    assert_eq!(one["spans"][0]["file"], FILE, "{one:#}");
    assert_eq!(one["spans"][0]["line"], 5);
    assert_eq!(
        one["spans"][0]["label"],
        "required because it appears within the type `Node`"
    );
    assert_eq!(one["spans"][1]["file"], "hulk.toml");
    assert_eq!(one["help"], format!("mend `{FILE}` as rustc says below"));
}

#[test]
fn a_note_that_names_a_state_names_the_node() {
    let note = "required because it appears within the type `nodes::a::Node`";
    let one = told(
        &json!([{ "message": note, "level": "note", "spans": [], "rendered": null, "children": [] }]),
    );
    assert_eq!(one["spans"][0]["file"], "hulk.toml");
    assert_eq!(
        one["help"],
        format!("mend `{FILE}` as rustc says below"),
        "{one:#}"
    );
}

#[test]
fn what_names_no_node_stands_at_the_cycler_with_a_deed() {
    let one = told(&json!([]));
    assert_eq!(one["spans"][0]["file"], "hulk.toml");
    assert!(
        one["help"]
            .as_str()
            .is_some_and(|help| help.contains("rustc names below")),
        "{one:#}"
    );
}

#[test]
fn a_variable_that_is_not_called_as_its_field_leads_to_it() {
    let writer = Node {
        outputs: "x: MainOutput<Option<u8>>, y: MainOutput<Option<u8>>,",
        ..Node::default()
    };
    let reader = Node {
        cycle: "node: RequiredInput<Option<u8>, \"x?\">,\nnode_input: RequiredInput<Option<u8>, \"y?\">,",
        ..Node::default()
    };
    let robot = Fixture::control(&["w", "a"])
        .node("w", writer)
        .node("a", reader);
    for (variable, field) in [("node_input_input", "node"), ("node_input", "node_input")] {
        let (file, text) = (
            "generated/src/cyclers/control.rs",
            format!("Some({variable})"),
        );
        let one = told_at(&robot, file, &text, &json!([]));
        let label = format!("what is generated from `{field}` does not compile");
        assert_eq!(one["spans"][0]["label"], label, "{one:#}");
    }
}
