//! `check --format rustc-json` against cargo's own messages: what rust-analyzer reads of both is of one form.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::process::Command;

use serde::Deserialize;
use serde_json::Value;

use crate::Ended;
use crate::robot::Robot;

/// A line of cargo's, as strictly as the readers of editors take it: nothing may lack, nothing may be unknown.
#[derive(Debug, Deserialize)]
#[serde(tag = "reason", rename_all = "kebab-case")]
enum Line {
    CompilerMessage(Box<Compiled>),
    BuildFinished(Finished),
    /// Of cargo alone.
    CompilerArtifact {},
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Finished {
    success: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Compiled {
    package_id: String,
    manifest_path: String,
    target: Target,
    message: Message,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Target {
    kind: Vec<Kind>,
    crate_types: Vec<CrateType>,
    name: String,
    src_path: String,
    edition: String,
    doc: bool,
    doctest: bool,
    test: bool,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    Lib,
    CustomBuild,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case")]
enum CrateType {
    Lib,
    Bin,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Message {
    /// Children have none.
    #[serde(rename = "$message_type")]
    message_type: Option<String>,
    message: String,
    code: Option<Code>,
    level: Level,
    spans: Vec<Span>,
    children: Vec<Self>,
    rendered: Option<String>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case")]
enum Level {
    Error,
    Warning,
    FailureNote,
    Note,
    Help,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Code {
    code: String,
    explanation: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Span {
    file_name: String,
    byte_start: u32,
    byte_end: u32,
    line_start: usize,
    line_end: usize,
    column_start: usize,
    column_end: usize,
    is_primary: bool,
    text: Vec<SpanLine>,
    label: Option<String>,
    suggested_replacement: Option<String>,
    suggestion_applicability: Option<String>,
    expansion: Option<Value>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SpanLine {
    text: String,
    highlight_start: usize,
    highlight_end: usize,
}

#[track_caller]
fn lines(text: &str) -> Vec<Line> {
    let parse = |line: &str| {
        serde_json::from_str(line).unwrap_or_else(|error| panic!("{error} in:\n{line}"))
    };
    text.lines().map(parse).collect()
}

/// The keys of every kind of object in the messages.
fn keys(text: &str) -> BTreeMap<&'static str, BTreeSet<String>> {
    fn add(
        kind: &'static str,
        object: &Value,
        keys: &mut BTreeMap<&'static str, BTreeSet<String>>,
    ) {
        for (key, value) in object.as_object().into_iter().flatten() {
            keys.entry(kind).or_default().insert(key.clone());
            let below = match (kind, key.as_str()) {
                ("line", "target") => "target",
                ("line", "message") => "message",
                ("message", "children") => "child",
                ("message" | "child", "spans") => "span",
                ("message" | "child", "code") => "code",
                ("span", "text") => "span line",
                _ => continue,
            };
            match value {
                Value::Array(items) => items.iter().for_each(|item| add(below, item, keys)),
                value => add(below, value, keys),
            }
        }
    }
    let mut found = BTreeMap::new();
    for line in text.lines() {
        let line: Value = serde_json::from_str(line).expect("every line is JSON");
        match line["reason"].as_str() {
            Some("compiler-message") => add("line", &line, &mut found),
            Some("build-finished") => add("last line", &line, &mut found),
            _ => {}
        }
    }
    found
}

/// What cargo says about a package of one file with an error and a warning.
fn of_cargo() -> String {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |path: &str, text: &str| {
        fs::write(folder.path().join(path), text).expect("the folder is ours");
    };
    fs::create_dir(folder.path().join("src")).expect("the folder is ours");
    write(
        "Cargo.toml",
        "[package]\nname = \"broken\"\nedition = \"2024\"\n[workspace]\n",
    );
    write(
        "src/lib.rs",
        "pub fn count() -> u32 {\n    let unused = 1;\n    let found: u32 = Some(1u32);\n    found\n}\n",
    );
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut check = Command::new(cargo);
    check
        .args(["check", "--message-format=json", "--offline"])
        .current_dir(folder.path())
        .env("CARGO_TARGET_DIR", folder.path().join("target"));
    Ended::of(&mut check).expect(101).stdout
}

/// Two robots: an error with two places and a deed, then an error in a parameter file, each with a warning.
fn of_hulkgen() -> [String; 2] {
    let mut answers = Vec::new();
    for is_of_parameters in [false, true] {
        let robot = Robot::new("perception_and_real_time");
        let deadline = "deadline = \"12ms\"";
        robot.edit(
            "hulk.toml",
            deadline,
            &format!("{deadline}\npending_timeout = \"1s\""),
        );
        if is_of_parameters {
            robot.write("parameters/default.toml", "\"größe\" = 1\n");
        } else {
            let input = "Input<u8, \"brightness\">";
            let other = "Input<u16, \"brightness\">";
            robot.edit("nodes/src/detector.rs", input, other);
        }
        answers.push(robot.run("check --format rustc-json").expect(1).stdout);
    }
    answers.try_into().expect("two were asked for")
}

#[test]
fn every_message_is_one_that_cargo_could_have_sent() {
    let (cargo, hulkgen) = (of_cargo(), of_hulkgen());
    // The structs are strict enough only if cargo's own messages fit exactly.
    assert!(lines(&cargo).len() > 2, "{cargo}");
    assert_eq!(keys(&cargo), keys(&hulkgen.concat()));
    let mut codes = Vec::new();
    for answer in &hulkgen {
        let lines = lines(answer);
        let [
            messages @ ..,
            Line::BuildFinished(Finished { success: false }),
        ] = &*lines
        else {
            panic!("the last line is another: {answer}")
        };
        codes.extend(messages.iter().map(|line| match line {
            Line::CompilerMessage(compiled) => check_compiled(compiled),
            line => panic!("{line:?}"),
        }));
    }
    let code = |name: &str, level| (name.to_owned(), level);
    for expected in [
        code("type-mismatch", "error"),
        code("unknown-parameter", "error"),
        code("unused-key", "warning"),
    ] {
        assert!(codes.contains(&expected), "{codes:?}");
    }
}

fn check_compiled(compiled: &Compiled) -> (String, &'static str) {
    assert!(compiled.package_id.starts_with("path+file:///"));
    assert!(compiled.manifest_path.ends_with("/Cargo.toml"));
    let target = &compiled.target;
    assert_eq!(target.kind, [Kind::CustomBuild]);
    assert_eq!(target.crate_types, [CrateType::Bin]);
    assert!(target.src_path.ends_with("/hulk.toml") && !target.name.is_empty());
    assert!(!target.edition.is_empty() && !target.doc && !target.doctest && !target.test);
    assert_eq!(compiled.message.message_type.as_deref(), Some("diagnostic"));
    check(&compiled.message)
}

/// What an editor needs of a message; its code and level.
fn check(message: &Message) -> (String, &'static str) {
    assert!(!message.message.is_empty());
    let code = message.code.as_ref().expect("each of ours has one");
    assert!(code.explanation.is_some());
    let rendered = message.rendered.as_deref().expect("each of ours is");
    assert!(rendered.contains(&message.message), "{rendered}");
    let primary = message.spans.iter().filter(|span| span.is_primary).count();
    assert_eq!(primary, 1, "{message:?}");
    for span in &message.spans {
        assert!(span.byte_start <= span.byte_end);
        assert!((span.line_start, span.column_start) <= (span.line_end, span.column_end));
        assert!(span.line_start > 0 && span.column_start > 0);
        assert_eq!(
            span.text.len(),
            span.line_end - span.line_start + 1,
            "{span:?}"
        );
        for line in &span.text {
            let length = line.text.chars().count();
            assert!(line.highlight_start <= line.highlight_end, "{line:?}");
            assert!(line.highlight_end <= length + 1, "{line:?}");
        }
        assert!(
            span.file_name.starts_with('/'),
            "found wherever cargo's workspace begins: {span:?}"
        );
        assert!(span.label.as_deref() != Some(""));
        // Nothing of ours is applied without being read.
        assert!(span.suggested_replacement.is_none() && span.suggestion_applicability.is_none());
        assert!(span.expansion.is_none());
    }
    for child in &message.children {
        assert!([Level::Help, Level::Note].contains(&child.level));
        assert_eq!(child.message_type, None);
        assert!(child.spans.is_empty() && child.children.is_empty() && child.code.is_none());
    }
    let level = match message.level {
        Level::Error => "error",
        Level::Warning => "warning",
        Level::FailureNote | Level::Note | Level::Help => panic!("{message:?}"),
    };
    (code.code.clone(), level)
}

#[test]
fn a_clean_robot_is_a_build_that_succeeds() {
    let robot = Robot::new("perception_and_real_time");
    let text = robot.run("check --format rustc-json").expect(0).stdout;
    assert!(
        matches!(
            &*lines(&text),
            [Line::BuildFinished(Finished { success: true })]
        ),
        "{text}"
    );
}

#[test]
fn an_umlaut_is_one_column() {
    let [_, text] = of_hulkgen();
    let messages = lines(&text).into_iter().filter_map(|line| match line {
        Line::CompilerMessage(compiled) => Some(compiled.message),
        _ => None,
    });
    let mut spans = messages.flat_map(|message| message.spans);
    let key = spans.find(|span| span.file_name.ends_with("/parameters/default.toml"));
    let key = key.expect("the parameter is unknown");
    assert_eq!(key.text[0].text, "\"größe\" = 1");
    assert_eq!((key.column_start, key.column_end), (1, 8));
    assert_eq!((key.byte_start, key.byte_end), (0, 9));
}
