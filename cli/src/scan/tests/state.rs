//! Where a node's struct stands, and what it stores.

use super::{WRITER, acting, node_text_of};
use crate::scan::fixture::{Fixture, Node};

fn fixture(state: &str, head: &str) -> Fixture {
    let node = Node {
        state,
        head,
        cycle: "hardware: HardwareInterface,",
        more: "pub fn restore(&mut self, context: CreationContext) -> Result<()> {}",
        ..WRITER
    };
    Fixture::control(&["a"]).node("a", node)
}

#[test]
fn a_field_that_is_read_from_text_that_lives_forever_is_told() {
    for field in [
        "s: &'static str,",
        "s: Option<&'static [u8]>,",
        "#[serde(borrow)] s: std::borrow::Cow<'static, str>,",
        "#[serde(default)] s: &'static str,",
    ] {
        fixture(field, "").expect(
            "missing-derive",
            &[
                "the node `Node` cannot be restored",
                "crates/nodes/src/a.rs:",
            ],
        );
    }
    for field in [
        "#[serde(skip)] s: &'static str,",
        "#[serde(deserialize_with = \"one\")] s: &'static str,",
        "s: std::borrow::Cow<'static, str>,",
        "s: String,",
    ] {
        fixture(field, "").robot();
    }
}

#[test]
fn serde_may_be_implemented_anywhere_in_the_crate() {
    let text = fixture("", "").text("crates/nodes/src/a.rs");
    let text = text.replacen("Deserialize, Serialize)]", "Deserialize)]", 1);
    for (more, is_there, left) in [
        (
            "mod m { use super::Node; use serde::Serialize; impl Serialize for Node {} }",
            true,
            0,
        ),
        (
            "mod m { use serde::Serialize as S; impl S for super::Node {} }",
            true,
            0,
        ),
        (
            "#[cfg(any())] mod m { impl serde::Serialize for super::Node {} }",
            true,
            1,
        ),
        ("serializes!(Node);", true, 1),
        (
            "#[cfg(test)] mod m { impl serde::Serialize for super::Node {} }",
            false,
            0,
        ),
        (
            "mod m { impl serde::Serialize for super::Other {} }",
            false,
            0,
        ),
        (
            "mod m { impl std::fmt::Debug for super::Node {} }",
            false,
            0,
        ),
    ] {
        let fixture = fixture("", "").file("crates/nodes/src/a.rs", &format!("{text}{more}"));
        if is_there {
            assert_eq!(fixture.robot().besides_edges, left, "{more}");
        } else {
            fixture.expect("missing-derive", &["does not derive `Serialize`"]);
        }
    }
    let elsewhere = fixture("", "").file("crates/nodes/src/a.rs", &text).file(
        "crates/nodes/src/lib.rs",
        "pub mod a; mod impls { impl serde::Serialize for crate::a::Node {} }",
    );
    assert_eq!(elsewhere.robot().besides_edges, 0);
}

#[test]
fn the_struct_of_a_node_stands_beside_its_impl() {
    let fixture = Fixture::control(&["a"]).node("a", acting());
    let text = node_text_of(&fixture, "a");
    let (head, rest) = text.split_once("#[derive").expect("it derives");
    let (_, rest) = rest.split_once("}").expect("a struct has an end");
    let with = |own: &str| {
        let text = format!("{head}{own}{rest}");
        let library = "pub mod a; pub mod stat;";
        let stat = "#[derive(Deserialize, Serialize)] pub struct Node {}";
        let fixture = fixture.clone().file("crates/nodes/src/a.rs", &text);
        let fixture = fixture.file("crates/nodes/src/lib.rs", library);
        fixture.file("crates/nodes/src/stat.rs", stat)
    };
    for own in [
        "use super::stat::Node;",
        "pub use super::stat::Node;",
        "use super::stat::*;",
        "use super::stat::Node; lazy! { static X: u8 = 1; }",
    ] {
        let parts = [
            "the struct of the node `Node` does not stand beside its `impl`",
            "help: write `pub struct Node` here",
        ];
        with(own).expect("invalid-signature", &parts);
    }
    with("type Node = super::stat::Node;").expect(
        "invalid-signature",
        &["write the struct here, and its own name in place of `Node`"],
    );
    let derived = "#[derive(Deserialize, Serialize)]";
    with("enum Node {}").expect("invalid-signature", &["write `pub enum Node`"]);
    with("pub enum Node {}").expect("missing-derive", &["does not derive"]);
    with(&format!("{derived} pub enum Node {{}}")).robot();
    for own in [
        "state!(Node);",
        "include!(\"state.rs\");",
        "#[states] mod states {}",
    ] {
        // Whether it is there, and whether it is `Send`.
        assert_eq!(with(own).robot().left_to_rustc, 2, "{own}");
    }
}

#[test]
fn a_node_that_cannot_be_stored_is_an_error() {
    let fixture = Fixture::control(&["a"]).node("a", acting());
    let text = node_text_of(&fixture, "a")
        .replace("#[derive(Deserialize, Serialize)]", "#[derive(Serialize)]");
    fixture.file("crates/nodes/src/a.rs", &text).expect(
        "missing-derive",
        &[
            "does not derive `Deserialize`",
            "write `#[derive(Deserialize)]` above it",
        ],
    );
}
