//! Results of nodes: aliases, and errors that become the framework's or do not.

use super::ACTS;
use crate::scan::fixture::Fixture;

/// A node of which `new` returns this, with this code in its file.
fn fixture(returns: &str, code: &str) -> Fixture {
    let fixture = Fixture::control(&["a"]).node("a", ACTS);
    let text = fixture.text("crates/nodes/src/a.rs");
    let text = text
        .replace(
            "use framework::*;",
            "use framework::{HardwareInterface, Result, context};",
        )
        .replace("-> Result<Self>", &format!("-> {returns}"));
    fixture.file("crates/nodes/src/a.rs", &format!("{text}\n{code}"))
}

#[test]
fn a_result_may_have_any_name() {
    for (returns, code) in [
        ("Res<Self>", "pub type Res<T> = framework::Result<T>;"),
        ("Res<Self>", "type Res<T> = framework::Result<T>;"),
        ("R", "type R = Result<Node>;"),
        (
            "R",
            "type S<T, E> = std::result::Result<T, E>; type R = S<Node, String>;",
        ),
        (
            "MyResult<String>",
            "type MyResult<E> = std::result::Result<Node, E>;",
        ),
    ] {
        assert_eq!(fixture(returns, code).robot().besides_edges, 0, "{returns}");
    }
    for (returns, code) in [
        ("Res<Self>", "type Res<T> = Option<T>;"),
        ("R", "type R = Result<u8>;"),
        ("R", "struct R;"),
        ("Self", ""),
    ] {
        fixture(returns, code).expect("invalid-signature", &["does not return a `Result<Self>`"]);
    }
    let hidden = fixture("made::Outcome<Self>", "").robot();
    assert_eq!((hidden.besides_edges, hidden.left_to_rustc), (1, 1));
}

#[test]
fn an_error_that_surely_is_none_is_told_at_the_function() {
    for error in ["()", "u8", "Option<u8>", "E", "types::Point"] {
        let returns = format!("std::result::Result<Self, {error}>");
        fixture(&returns, "#[derive(Debug)] pub struct E;").expect(
            "invalid-signature",
            &[
                "with which `new` may fail, is no error",
                "crates/nodes/src/a.rs:",
                "framework::Result",
            ],
        );
    }
    fixture("Result<Self, ()>", "").expect("invalid-signature", &["`()`"]);
    for code in [
        "struct E; impl std::error::Error for E {}",
        "pub(crate) struct E; impl std::error::Error for E {}",
    ] {
        let parts = ["`nodes::a::E` is private", "`new` may fail with it"];
        fixture("Result<Self, E>", code).expect("not-public", &parts);
    }
}

const FAULT: &str = "
    #[derive(Debug, thiserror::Error)] pub struct Fault<T: std::fmt::Debug = String> { detail: T }
    pub type Given = Fault<std::rc::Rc<u8>>;
";

#[test]
fn an_error_that_may_convert_is_left_to_rustc() {
    for (error, code, unknown) in [
        ("E", "pub struct E; impl std::error::Error for E {}", 0),
        (
            "E",
            "#[derive(Debug, thiserror::Error)] #[error(\"x\")] pub enum E { A }",
            0,
        ),
        ("framework::Error", "", 0),
        // The framework's error moves between threads.
        (
            "E",
            "pub struct E(Box<dyn std::error::Error>); impl std::error::Error for E {}",
            1,
        ),
        (
            "E",
            "pub struct E(Box<dyn std::error::Error + Send + Sync>); impl std::error::Error for E {}",
            0,
        ),
        (
            "E",
            "#[derive(Debug, thiserror::Error)] pub enum E { A { #[source] a: std::rc::Rc<u8> } }",
            1,
        ),
        (
            "E",
            "#[derive(Debug, thiserror::Error)] pub enum E { #[error(\"x\")] A { #[from] a: std::io::Error, b: String } }",
            0,
        ),
        (
            "E<'static>",
            "pub struct E<'a>(&'a str); impl std::error::Error for E<'_> {}",
            1,
        ),
        // What it keeps is of the type that is given, or of the default.
        ("Fault<std::rc::Rc<u8>>", FAULT, 1),
        ("Given", FAULT, 1),
        ("Fault", FAULT, 0),
        (
            "E<2>",
            "#[derive(Debug, thiserror::Error)] pub struct E<const N: usize>([u8; N]);",
            0,
        ),
        ("std::sync::PoisonError<u8>", "", 1),
        ("framework::Timestamp", "", 1),
        ("String", "", 0),
        ("&'static str", "", 0),
        ("std::io::Error", "", 0),
        ("Box<dyn std::error::Error + Send + Sync>", "", 0),
        ("E", "#[fails] pub struct E;", 1),
        ("E", "#[derive(Fails)] pub struct E;", 1),
        ("E", "pub struct E; fails!(E);", 1),
        (
            "E",
            "pub struct E; impl From<E> for framework::Error { }",
            1,
        ),
        (
            "E",
            "pub struct E; impl From<E> for Box<dyn std::error::Error + Send + Sync> { }",
            1,
        ),
        (
            "E",
            "pub struct E; mod other { use std::error::Error as X; impl X for super::E {} }",
            1,
        ),
        ("elsewhere::Error", "", 1),
    ] {
        let returns = format!("std::result::Result<Self, {error}>");
        let robot = fixture(&returns, code).robot();
        assert_eq!(robot.besides_edges, unknown, "{error}: {code}");
    }
}
