//! How diagnostics are collected, sorted and printed.

use camino::Utf8Path;

use super::{
    Code, Diagnostic, Diagnostics, byte, listed, nearest, position, render, to_json, to_rustc_json,
};
use crate::workspace::Workspace;

fn two_files() -> (Workspace, Diagnostics) {
    let workspace = Workspace::in_memory([("a.rs", "ä: Input<u8>,\n"), ("b.rs", "x: u16\n")]);
    for file in ["a.rs", "b.rs"] {
        workspace.read(Utf8Path::new(file)).unwrap();
    }
    let mut diagnostics = Diagnostics::new();
    let mismatch = Diagnostic::new(Code::TypeMismatch, "`x` is a `u16`, not a `u8`")
        .at(Utf8Path::new("a.rs"), 10..12, "read here as `u8`")
        .at(Utf8Path::new("b.rs"), 3..6, "written here")
        .help("write `Input<u16>`");
    diagnostics.add(mismatch.clone());
    diagnostics.add(Diagnostic::new(Code::UnreadOutputs, "nobody reads").at(
        Utf8Path::new("a.rs"),
        0..2,
        "",
    ));
    diagnostics.add(mismatch);
    (workspace, diagnostics)
}

#[test]
fn codes_are_sorted_and_unlike() {
    let names: Vec<&str> = Code::ALL.iter().map(|code| code.name()).collect();
    assert!(names.is_sorted(), "{names:?}");
    for code in Code::ALL {
        assert_eq!(Code::from_name(code.name()), Some(*code));
        assert!(
            code.title().ends_with('.') && code.explanation().ends_with('.'),
            "{code:?}"
        );
    }
}

#[test]
fn a_report_shows_every_file_with_code_and_deed() {
    let (workspace, diagnostics) = two_files();
    let text = render(&diagnostics, &workspace, false);
    let expected = "\
warning[unread-outputs]: nobody reads
 --> a.rs:1:1
  |
1 | ä: Input<u8>,
  | ^

error[type-mismatch]: `x` is a `u16`, not a `u8`
 --> a.rs:1:10
  |
1 | ä: Input<u8>,
  |          ^^ read here as `u8`
  |
 ::: b.rs:1:4
  |
1 | x: u16
  |    --- written here
  |
  = help: write `Input<u16>`

";
    assert_eq!(text, expected);
    assert!(render(&diagnostics, &workspace, true).contains('\u{1b}'));
}

#[test]
fn diagnostics_are_sorted_by_place_and_shown_once() {
    let (_, diagnostics) = two_files();
    let codes: Vec<Code> = diagnostics.sorted().iter().map(|one| one.code).collect();
    assert_eq!(codes, [Code::UnreadOutputs, Code::TypeMismatch]);
    assert!(diagnostics.has_errors() && diagnostics.has_warnings());
}

#[test]
fn json_has_lines_and_columns_from_one() {
    let (workspace, diagnostics) = two_files();
    let json = to_json(&diagnostics, &workspace);
    assert_eq!(json["version"], 1);
    let mismatch = &json["diagnostics"][1];
    assert_eq!(mismatch["code"], "type-mismatch");
    assert_eq!(mismatch["severity"], "error");
    assert_eq!(mismatch["help"], "write `Input<u16>`");
    let expected = serde_json::json!({
        "file": "a.rs", "line": 1, "column": 10, "end_line": 1, "end_column": 12,
        "label": "read here as `u8`",
    });
    assert_eq!(mismatch["spans"][0], expected);
    assert_eq!(mismatch["spans"].as_array().unwrap().len(), 2);
}

fn messages(text: &str) -> Vec<serde_json::Value> {
    let lines = text.lines().map(serde_json::from_str);
    lines.map(|line| line.expect("each line is JSON")).collect()
}

#[test]
fn an_editor_reads_what_cargo_would_write() {
    let (workspace, diagnostics) = two_files();
    let messages = messages(&to_rustc_json(&diagnostics, &workspace, false));
    assert_eq!(messages.len(), 3);
    let last = serde_json::json!({ "reason": "build-finished", "success": false });
    assert_eq!(messages[2], last);
    for key in ["package_id", "manifest_path", "target"] {
        assert!(!messages[1][key].is_null(), "no {key}");
    }
    assert_eq!(messages[1]["reason"], "compiler-message");
    let message = &messages[1]["message"];
    assert_eq!(message["$message_type"], "diagnostic");
    assert_eq!(message["code"]["code"], "type-mismatch");
    assert_eq!(message["level"], "error");
    assert_eq!(message["children"][0]["level"], "help");
    assert_eq!(message["children"][0]["message"], "write `Input<u16>`");
    let rendered = message["rendered"].as_str().unwrap();
    assert!(rendered.starts_with("error[type-mismatch]: `x` is a `u16`"));
    let expected = serde_json::json!({
        "file_name": "a.rs", "byte_start": 10, "byte_end": 12, "line_start": 1, "line_end": 1,
        "column_start": 10, "column_end": 12, "is_primary": true, "label": "read here as `u8`",
        "text": [{ "text": "ä: Input<u8>,", "highlight_start": 10, "highlight_end": 12 }],
        "suggested_replacement": null, "suggestion_applicability": null, "expansion": null,
    });
    assert_eq!(message["spans"][0], expected);
    assert_eq!(message["spans"][1]["is_primary"], false);
}

#[test]
fn an_editor_gets_the_words_of_rustc_and_whole_paths() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let root = Utf8Path::from_path(folder.path()).expect("it is UTF-8");
    let workspace = Workspace::at_root(&root.join("robot"));
    let mut diagnostics = Diagnostics::new();
    for (code, file) in [
        (Code::Rustc, "../types/src/lib.rs"),
        (Code::LeftToRustc, "src/lib.rs"),
    ] {
        let one = Diagnostic::new(code, "mismatched types").at(Utf8Path::new(file), 0..0, "");
        diagnostics.add(one.help("mend it").rustc("error[E0308]: words".to_owned()));
    }
    let messages = messages(&to_rustc_json(&diagnostics, &workspace, false));
    let [author, generated] = [&messages[0]["message"], &messages[1]["message"]];
    let file = |message: &serde_json::Value| message["spans"][0]["file_name"].clone();
    assert_eq!(file(author), root.join("types/src/lib.rs").as_str());
    assert_eq!(file(generated), root.join("robot/src/lib.rs").as_str());
    assert_eq!(author["rendered"], "error[E0308]: words\n\n");
    assert_eq!(author["children"].as_array().expect("a list").len(), 1);
    assert_eq!(generated["children"][0]["level"], "help");
    let note = &generated["children"][1];
    assert_eq!(note["level"], "note");
    assert_eq!(note["message"], "error[E0308]: words");
}

#[test]
fn an_editor_is_told_a_place_for_everything() {
    let workspace = Workspace::in_memory([("hulk.toml", "x\ny\n")]);
    workspace.read(Utf8Path::new("hulk.toml")).unwrap();
    let mut diagnostics = Diagnostics::new();
    diagnostics.add(Diagnostic::new(Code::Syntax, "nothing can be read"));
    let both = Diagnostic::new(Code::Syntax, "both").at(Utf8Path::new("hulk.toml"), 0..3, "");
    diagnostics.add(both);
    let messages = messages(&to_rustc_json(&diagnostics, &workspace, true));
    let place = &messages[0]["message"]["spans"][0];
    assert_eq!(place["file_name"], "hulk.toml");
    assert_eq!(
        (&place["line_start"], &place["is_primary"]),
        (&1.into(), &true.into())
    );
    let lines = &messages[1]["message"]["spans"][0]["text"];
    assert_eq!(lines.as_array().unwrap().len(), 2);
    assert_eq!(lines[0]["highlight_end"], 2);
}

#[test]
fn a_place_behind_the_end_is_the_end() {
    let end = position("a\nbc", 99);
    assert_eq!((end.line, end.column), (2, 3));
}

#[test]
fn a_place_is_found_again_by_line_and_column() {
    let text = "aä\r\nbc";
    for at in text.char_indices().map(|(at, _)| at).chain([text.len()]) {
        let place = position(text, at);
        assert_eq!(byte(text, place.line, place.column), at);
    }
    assert_eq!(byte(text, 9, 9), text.len());
}

#[test]
fn the_nearest_name_is_few_edits_away() {
    for (wrong, meant) in [
        ("bal", Some("ball")),
        ("camera_matirx", Some("camera_matrix")),
        ("BALL", Some("ball")),
        ("imu", None),
    ] {
        assert_eq!(nearest(wrong, ["ball", "camera_matrix"]), meant, "{wrong}");
    }
}

#[test]
fn lists_are_sorted_and_short() {
    assert_eq!(listed([]), "nothing");
    assert_eq!(listed(["b", "a", "b"]), "`a` and `b`");
    let many: Vec<String> = (10..20).map(|number| number.to_string()).collect();
    assert!(listed(many.iter().map(String::as_str)).ends_with("`17` and 2 more"));
}
