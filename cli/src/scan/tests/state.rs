//! What a node's struct stores.

use super::WRITER;
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
