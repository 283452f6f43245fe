//! Errors of rustc whose place in the generated crate names no node.

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
    let files = Fixture::control(&["a"]).node("a", node).files();
    let workspace = Workspace::in_memory(files);
    let mut found = Diagnostics::new();
    let manifest = manifest::load(&workspace, &mut found).expect("it has no errors");
    let understood = pipeline::understand(&workspace, &mut found).expect("it has no errors");
    let model = model::describe(&understood.robot, &understood.schedule);
    let home = Home {
        workspace: &workspace,
        manifest: &manifest,
        robot: &understood.robot,
        model: &model,
        files: &render::render(&model),
    };
    let message: Message = serde_json::from_value(json!({
        "message": "`Rc<u8>` cannot be sent between threads safely", "level": "error", "rendered": "all",
        "spans": [span("generated/src/runtime/control.rs", 1, true)], "children": children,
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
