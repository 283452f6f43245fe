//! What is not the same in every run, in whatever way it is written, and what only looks like it.

use super::ACTS;
use crate::scan::fixture::{Fixture, Node};

/// The names that a node is warned of, sorted by place: its head, and the body of a function of it.
fn names(head: &str, body: &str) -> Vec<String> {
    of(&node(head, body))
}

fn node(head: &str, body: &str) -> Fixture {
    let more = format!("fn more(&mut self) {{ {body} }}");
    Fixture::control(&["a"]).node(
        "a",
        Node {
            head,
            more: &more,
            ..ACTS
        },
    )
}

fn of(fixture: &Fixture) -> Vec<String> {
    let answer = fixture.answer();
    assert!(
        answer.codes.iter().all(|code| *code == "nondeterminism"),
        "{}",
        answer.text
    );
    let lines = answer.text.lines().filter_map(|line| {
        let (_, rest) = line.split_once("warning[nondeterminism]: `")?;
        Some(rest.split('`').next()?.to_owned())
    });
    lines.collect()
}

#[test]
fn names_are_followed_as_rustc_would() {
    for (head, body, expected) in [
        (
            "",
            "let a = std::time::Instant::now();",
            "std::time::Instant::now",
        ),
        (
            "use std::time::{Duration, Instant as Now};",
            "Now::now();",
            "Now::now",
        ),
        (
            "use std::{env, fs as files};",
            "env::var(\"A\");",
            "env::var",
        ),
        (
            "use std::fs as files;",
            "files::read(\"A\");",
            "files::read",
        ),
        (
            "use std::thread::{self, spawn};",
            "thread::sleep(x);",
            "thread::sleep",
        ),
        ("use std::thread::spawn;", "spawn(|| {});", "spawn"),
        (
            "use std::collections::*;",
            "let x = HashMap::new();",
            "HashMap::new",
        ),
        (
            "",
            "use std::time::SystemTime; SystemTime::now();",
            "SystemTime::now",
        ),
        (
            "",
            "{ use std::collections::*; HashSet::<u8>::new(); }",
            "HashSet::new",
        ),
        (
            "",
            "println!(\"{:?}\", std::time::Instant::now());",
            "std::time::Instant::now",
        ),
        (
            "struct Inner { map: std::collections::HashMap<u8, u8> }",
            "",
            "std::collections::HashMap",
        ),
        (
            "mod inner { use std::time::Instant; fn f() { Instant::now(); } }",
            "",
            "Instant::now",
        ),
        ("use rand::thread_rng;", "thread_rng();", "thread_rng"),
        ("", "rand::rng();", "rand::rng"),
        ("", "rand::make_rng();", "rand::make_rng"),
        (
            "use std::thread::*;",
            "let sleep = 1; sleep(sleep);",
            "sleep",
        ),
        ("static mut COUNT: u8 = 0;", "", "COUNT"),
        (
            "use std::sync::atomic::AtomicU8;",
            "static A: AtomicU8 = AtomicU8::new(0);",
            "A",
        ),
        ("static A: Option<std::sync::Mutex<u8>> = None;", "", "A"),
        ("thread_local! { static A: u8 = 0; }", "", "thread_local!"),
    ] {
        assert_eq!(names(head, body), [expected], "{head} {body}");
    }
}

#[test]
fn of_the_globs_of_other_crates_only_functions_are_meant() {
    let of = |body: &str| {
        let dependencies =
            "[package]\nname = \"nodes\"\n[dependencies]\nframework = \"1\"\nrand = \"0.8\"";
        of(&node("use rand::prelude::*;", body).file("crates/nodes/Cargo.toml", dependencies))
    };
    assert_eq!(of("let random = random(); draw(random);"), ["random"]);
    let variable =
        "let mut rng = self.generator.clone(); let rng = Draws { rng }; draw(rng, random);";
    assert_eq!(of(variable), [""; 0]);
    assert_eq!(of("let rng = rng();"), [""; 0], "the prelude has no `rng`");
}

#[test]
fn what_only_looks_like_it_is_not_told() {
    for (head, body) in [
        (
            "use std::time::{Duration, Instant};",
            "let a = Duration::ZERO;",
        ),
        (
            "struct Instant; impl Instant { fn now() {} }",
            "Instant::now();",
        ),
        ("mod env { pub fn var() {} }", "env::var();"),
        (
            "use std::collections::BTreeMap as HashMap;",
            "let a: HashMap<u8, u8> = HashMap::new();",
        ),
        ("", "let types = 1; let fs = 2; types + fs;"),
        (
            "use std::{env::*, fs::*, thread::*};",
            "let (current, file, copy, vars) = (1, 2, 3, 4); current + file + copy - vars;",
        ),
        ("type Map = std::collections::HashMap<u8, u8, Fixed>;", ""),
        ("static NAMES: [&str; 1] = [\"a\"];", ""),
        (
            "static A: std::sync::LazyLock<Vec<u8>> = std::sync::LazyLock::new(Vec::new);",
            "",
        ),
        (
            "#[cfg(test)] mod tests { fn f() { std::time::Instant::now(); } }",
            "",
        ),
        (
            "#[cfg(test)] use std::time::Instant;\n#[test] fn f() { std::thread::spawn(|| {}); }",
            "",
        ),
        ("", "let home = env!(\"HOME\");"),
    ] {
        assert_eq!(names(head, body), [""; 0], "{head} {body}");
    }
}

#[test]
fn modules_that_a_node_names_are_meant_and_others_are_not() {
    let clock = "pub fn now() { std::time::Instant::now(); }";
    let fixture = |head: &str| {
        node(head, "")
            .file(
                "crates/types/src/shapes.rs",
                "pub struct Line;\npub enum Shape { Round }",
            )
            .file(
                "crates/types/src/hidden.rs",
                &format!("pub struct Shown; pub struct Buried; {clock}"),
            )
    };
    assert_eq!(
        of(&fixture("use types::Shown;")),
        ["std::time::Instant::now"]
    );
    assert_eq!(
        of(&fixture("use types::Found as F;")),
        ["std::time::Instant::now"]
    );
    assert_eq!(of(&fixture("use types::Line;")), [""; 0]);
}

#[test]
fn it_is_silenced_at_its_line() {
    let comment = "// hulkgen: allow(nondeterminism) only logged\n";
    let body = format!("\n{comment}std::time::Instant::now();");
    assert_eq!(names("", &body), [""; 0]);
}
