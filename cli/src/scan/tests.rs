//! Finding nodes, reading their files, following names.

use super::compare::{Comparison, compare};
use super::fixture::{Fixture, Node};
use super::{Library, types::Resolved};
use crate::workspace::Workspace;

const WRITER: Node<'_> = Node {
    head: "",
    creation: "",
    cycle: "",
    outputs: "a: MainOutput<u8>,",
    state: "",
    asks: "hardware::Motors",
    more: "",
};

/// A node that acts, so that nothing is said about unread outputs.
fn acting() -> Node<'static> {
    Node {
        cycle: "hardware: HardwareInterface,",
        ..WRITER
    }
}

#[test]
fn a_node_is_found_through_the_module_tree() {
    let node = Fixture::control(&["deep::inner", "files::other", "inline::within", "moved"])
        .node("x", acting());
    let text = node_text(&node);
    let fixture = node
        .file(
            "crates/nodes/src/lib.rs",
            "pub mod deep;\npub mod files;\npub mod inline { pub mod within; }\n\
             #[path = \"elsewhere/there.rs\"]\npub mod moved;\n#[cfg(test)] mod tests;\n",
        )
        .file("crates/nodes/src/deep.rs", "pub mod inner;")
        .file("crates/nodes/src/files/mod.rs", "pub mod other;");
    let fixture = [
        "deep/inner.rs",
        "files/other.rs",
        "inline/within.rs",
        "elsewhere/there.rs",
    ]
    .iter()
    .fold(fixture, |fixture, file| {
        fixture.file(&format!("crates/nodes/src/{file}"), &text)
    });
    let manifest = "[robot]\nname = \"test\"\n[[cycler]]\nname = \"Control\"\nkind = \"real-time\"\n\
        nodes = [\"nodes::deep::inner\"]\n[[cycler]]\nname = \"B\"\nkind = \"real-time\"\n\
        nodes = [\"nodes::files::other\"]\n[[cycler]]\nname = \"C\"\nkind = \"real-time\"\n\
        nodes = [\"nodes::inline::within\"]\n[[cycler]]\nname = \"D\"\nkind = \"real-time\"\nnodes = [\"nodes::moved\"]\n";
    let robot = fixture.file("hulk.toml", manifest).robot();
    let files: Vec<&str> = robot
        .cyclers
        .iter()
        .map(|one| one.nodes[0].file.as_str())
        .collect();
    assert_eq!(
        files,
        [
            "crates/nodes/src/deep/inner.rs",
            "crates/nodes/src/files/other.rs",
            "crates/nodes/src/inline/within.rs",
            "crates/nodes/src/elsewhere/there.rs",
        ]
    );
    assert_eq!(robot.cyclers[0].nodes[0].summary.as_deref(), Some("Test."));
}

fn node_text(fixture: &Fixture) -> String {
    fixture.text("crates/nodes/src/x.rs")
}

#[test]
fn a_misspelled_node_is_told_with_the_nearest() {
    let fixture = Fixture::control(&["recever"]).node("receiver", acting());
    fixture.expect(
        "unknown-node",
        &[
            "no module `nodes::recever`",
            "did you mean `nodes::receiver`?",
            "hulk.toml:7:",
        ],
    );
    let other_crate = Fixture::control(&["node::a"]).node("a", acting());
    other_crate.expect(
        "unknown-node",
        &["no crate of the workspace is called `node`", "`nodes::a`?"],
    );
}

#[test]
fn a_file_without_a_mod_line_is_told_as_such() {
    let fixture = Fixture::control(&["a"])
        .node("a", acting())
        .file("crates/nodes/src/lib.rs", "");
    fixture.expect(
        "unknown-node",
        &[
            "is not declared",
            "`crates/nodes/src/a.rs`",
            "add `pub mod a;` to `crates/nodes/src/lib.rs`",
        ],
    );
}

#[test]
fn a_mod_line_without_a_file_is_told_at_the_line() {
    let fixture = Fixture::control(&["a"]).file("crates/nodes/src/lib.rs", "pub mod a;\n");
    let answer = fixture.answer();
    assert!(
        answer.codes.iter().all(|code| *code == "unknown-node"),
        "{}",
        answer.text
    );
    assert!(
        answer.text.contains("create `crates/nodes/src/a.rs` or"),
        "{}",
        answer.text
    );
}

#[test]
fn a_private_module_cannot_be_a_node() {
    let fixture = Fixture::control(&["a"])
        .node("a", acting())
        .file("crates/nodes/src/lib.rs", "mod a;");
    fixture.expect(
        "not-public",
        &["module `nodes::a` is private", "write `pub mod a;`"],
    );
}

#[test]
fn a_node_file_that_is_no_rust_is_shown() {
    let fixture = Fixture::control(&["a"])
        .node("a", acting())
        .file("crates/nodes/src/a.rs", "pub struct {");
    let answer = fixture.answer();
    assert!(answer.codes.contains(&"syntax"), "{}", answer.text);
    assert!(
        answer.text.contains("crates/nodes/src/a.rs:1:12"),
        "{}",
        answer.text
    );
}

#[test]
fn the_generated_crate_may_hold_anything() {
    let fixture = Fixture::control(&["a"])
        .node("a", acting())
        .file(
            "generated/Cargo.toml",
            "<<<<<<< HEAD\n=======\n>>>>>>> other\n",
        )
        .file("generated/src/lib.rs", "<<<<<<< HEAD\n");
    fixture.robot();
}

#[test]
fn a_broken_package_elsewhere_is_an_error() {
    let fixture = Fixture::control(&["a"])
        .node("a", acting())
        .file("crates/types/Cargo.toml", "x = = 1");
    fixture.expect("syntax", &["crates/types/Cargo.toml:1:"]);
}

#[test]
fn a_node_file_has_all_three_structs_with_their_attribute() {
    let fixture = Fixture::control(&["a"]).node("a", acting());
    let text = node_text_of(&fixture, "a");
    let without = text.replace(
        "#[context]\npub struct MainOutputs {\na: MainOutput<u8>,\n}\n",
        "",
    );
    fixture.file("crates/nodes/src/a.rs", &without).expect(
        "missing-context",
        &[
            "node `nodes::a` has no `MainOutputs`",
            "add `#[context] pub struct MainOutputs {}`",
        ],
    );
    let bare = text.replace(
        "#[context]\npub struct MainOutputs",
        "pub struct MainOutputs",
    );
    Fixture::control(&["a"])
        .node("a", acting())
        .file("crates/nodes/src/a.rs", &bare)
        .expect("missing-context", &["lacks the attribute `#[context]`"]);
}

fn node_text_of(fixture: &Fixture, name: &str) -> String {
    fixture.text(&format!("crates/nodes/src/{name}.rs"))
}

#[test]
fn a_file_without_a_node_is_an_error() {
    let fixture = Fixture::control(&["a"]).node("a", acting());
    let text = node_text_of(&fixture, "a").replace("impl Node", "impl Trait for Node");
    fixture
        .file("crates/nodes/src/a.rs", &text)
        .expect("missing-node", &[]);
}

#[test]
fn mistakes_of_the_grammar_have_codes_and_places() {
    for (node, code, part) in [
        (
            Node {
                cycle: "x: Inptu<u8, \"a\">,",
                ..WRITER
            },
            "invalid-field",
            "Inptu",
        ),
        (
            Node {
                cycle: "x: Input<u8, \"a..b\">,",
                ..WRITER
            },
            "invalid-path",
            "a..b",
        ),
        (
            Node {
                cycle: "x: Input<u8, \"a?\">,",
                ..WRITER
            },
            "option-mismatch",
            "Option",
        ),
        (
            Node {
                creation: "x: Input<u8, \"a\">,",
                ..WRITER
            },
            "misplaced-kind",
            "CreationContext",
        ),
        (
            Node {
                cycle: "x: Input<u8, \"no name\", \"a\">,",
                ..WRITER
            },
            "invalid-name",
            "no name",
        ),
        (
            Node {
                more: "pub fn restore(&self, context: CreationContext) -> Result<()> {}",
                ..WRITER
            },
            "invalid-signature",
            "restore",
        ),
    ] {
        let asks = Node { asks: "", ..node };
        Fixture::control(&["a"])
            .node("a", asks)
            .expect(code, &[part, "crates/nodes/src/a.rs:"]);
    }
}

#[test]
fn a_private_context_is_an_error() {
    let fixture = Fixture::control(&["a"]).node("a", acting());
    let text = node_text_of(&fixture, "a").replace("pub struct MainOutputs", "struct MainOutputs");
    fixture
        .file("crates/nodes/src/a.rs", &text)
        .expect("invalid-context", &["`MainOutputs` is not public"]);
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

/// The type that an author writes in a node file, resolved.
fn resolve(head: &str, written: &str) -> Resolved {
    let fixture = Fixture::control(&["a"]).node("a", Node { head, ..WRITER });
    let workspace = Workspace::in_memory(fixture.files());
    let library = Library::new(&workspace, "generated".into());
    let module = library.find_module("nodes::a").expect("it is there");
    library.resolve(&module, &syn::parse_str(written).expect("it is a type"))
}

#[test]
fn names_resolve_as_rustc_would() {
    for (head, written, text, known) in [
        ("use types::Ball;", "Ball", "types::Ball", true),
        ("use types::Ball as B;", "Vec<B>", "Vec<types::Ball>", true),
        (
            "use types::{self, shapes::{self, Line}};",
            "(types::Ball, shapes::Shape, Line)",
            "(types::Ball, types::shapes::Shape, types::shapes::Line)",
            true,
        ),
        ("use types::*;", "Option<Ball>", "Option<types::Ball>", true),
        ("use types::*;", "Line", "types::shapes::Line", true),
        ("", "types::Shown", "types::Shown", true),
        ("use types::Found;", "Found", "types::Found", true),
        ("", "types::Distance", "f32", true),
        ("use types::*;", "Listed<Ball>", "Vec<types::Ball>", true),
        ("pub struct Own;", "Own", "nodes::a::Own", true),
        ("pub struct Own;", "self::Own", "nodes::a::Own", true),
        ("pub struct Own;", "crate::a::Own", "nodes::a::Own", true),
        ("pub struct Own;", "super::a::Own", "nodes::a::Own", true),
        (
            "pub mod parts { pub struct Leg; }",
            "parts::Leg",
            "nodes::a::parts::Leg",
            true,
        ),
        ("pub type Pair<T> = (T, T);", "Pair<u8>", "(u8, u8)", true),
        ("", "nalgebra::Point2<f32>", "nalgebra::Point2<f32>", true),
        (
            "use nalgebra as na;",
            "na::Point2<f32>",
            "nalgebra::Point2<f32>",
            true,
        ),
        (
            "use ordered_float::OrderedFloat;",
            "OrderedFloat<f32>",
            "ordered_float::OrderedFloat<f32>",
            true,
        ),
        (
            "use std::time::Duration;",
            "Duration",
            "std::time::Duration",
            true,
        ),
        (
            "use std::collections::{BTreeMap as Map};",
            "Map<String, u8>",
            "std::collections::BTreeMap<String, u8>",
            true,
        ),
        (
            "",
            "std::vec::Vec<core::option::Option<u8>>",
            "Vec<Option<u8>>",
            true,
        ),
        (
            "use types::COUNT;",
            "[f32; COUNT]",
            "[f32; types::COUNT]",
            true,
        ),
        ("", "[f32; 3_usize]", "[f32; 3]", true),
        ("", "&'static str", "&'static str", true),
        ("", "Unknown<u8>", "Unknown<u8>", false),
        ("use unknown::Thing;", "Thing", "Thing", false),
        ("", "<u8 as Trait>::Out", "<u8 as Trait>::Out", false),
        ("", "Box<dyn Fn()>", "Box<dyn Fn ()>", false),
        (
            "#[cfg(a)] struct X; #[cfg(not(a))] struct X;",
            "X",
            "X",
            false,
        ),
        ("use types::Vec;", "Vec<u8>", "Vec<u8>", false),
    ] {
        let resolved = resolve(head, written);
        assert_eq!(resolved.text, text, "{head} {written}");
        assert_eq!(resolved.is_known(), known, "{head} {written}");
        assert!(resolved.private.is_empty(), "{head} {written}");
    }
}

#[test]
fn private_types_are_seen() {
    for (head, written) in [
        ("struct Own;", "Vec<Own>"),
        ("mod inner { pub struct Own; }", "inner::Own"),
        ("", "types::hidden::Lost"),
    ] {
        assert_eq!(resolve(head, written).private.len(), 1, "{head} {written}");
    }
    // What is hidden behind a public alias can be named by the alias.
    let alias = resolve(
        "mod inner { pub struct Own; } pub type Name = inner::Own;",
        "Name",
    );
    assert_eq!(
        (alias.text.as_str(), alias.private.len()),
        ("nodes::a::Name", 0)
    );
}

#[test]
fn types_are_only_told_apart_where_that_is_certain() {
    let head = "use types::*; use std::time::Duration;";
    for (a, b, answer) in [
        ("Ball", "types::Ball", Comparison::Same),
        ("Distance", "f32", Comparison::Same),
        ("[u8; COUNT]", "[u8; 3]", Comparison::Same),
        ("Wrapper<u8>", "Wrapper<u8>", Comparison::Same),
        ("Ball", "Point", Comparison::Different),
        ("Vec<Ball>", "Vec<Point>", Comparison::Different),
        ("Wrapper<u8>", "Wrapper<u16>", Comparison::Different),
        ("(u8, u8)", "(u8,)", Comparison::Different),
        ("[u8; 3]", "[u8; 4]", Comparison::Different),
        (
            "nalgebra::Point2<f32>",
            "nalgebra::Vector2<f32>",
            Comparison::Different,
        ),
        (
            "nalgebra::Point2<f32>",
            "nalgebra::Point2<f64>",
            Comparison::Different,
        ),
        (
            "nalgebra::Vector3<f32>",
            "nalgebra::SVector<f32, 3>",
            Comparison::Unknown,
        ),
        ("nalgebra::Point2<f32>", "f32", Comparison::Different),
        ("nalgebra::SVector<f32, 3>", "f32", Comparison::Different),
        ("nalgebra::Vector2<f32>", "[f32; 2]", Comparison::Different),
        ("nalgebra::Point2<f32>", "(f32, f32)", Comparison::Different),
        (
            "nalgebra::Point2<f32>",
            "Option<nalgebra::Point2<f32>>",
            Comparison::Different,
        ),
        ("nalgebra::Point2<f32>", "Vec<f32>", Comparison::Different),
        ("nalgebra::Vector2<f32>", "Duration", Comparison::Different),
        ("nalgebra::Point2<f32>", "Ball", Comparison::Different),
        // Nobody here knows what these are.
        ("nalgebra::Point2<f32>", "Missing", Comparison::Unknown),
        (
            "nalgebra::Point2<Missing>",
            "nalgebra::Point2<f32>",
            Comparison::Unknown,
        ),
        ("nalgebra::Scalar", "f32", Comparison::Unknown),
        ("ordered_float::NotNan<f32>", "f32", Comparison::Unknown),
        (
            "ordered_float::NotNan<f32>",
            "[f32; 2]",
            Comparison::Unknown,
        ),
        (
            "ordered_float::NotNan<f32>",
            "nalgebra::Point2<f32>",
            Comparison::Unknown,
        ),
        ("Duration", "core::time::Duration", Comparison::Same),
        (
            "std::collections::HashMap<u8, u8>",
            "std::collections::hash_map::HashMap<u8, u8>",
            Comparison::Unknown,
        ),
        ("Missing", "u8", Comparison::Unknown),
    ] {
        assert_eq!(
            compare(&resolve(head, a), &resolve(head, b)),
            answer,
            "{a} {b}"
        );
        assert_eq!(
            compare(&resolve(head, b), &resolve(head, a)),
            answer,
            "{b} {a}"
        );
    }
}

#[test]
fn a_trait_reads_if_a_method_returns_something() {
    for (asks, path, reading) in [
        ("hardware::Camera", "hardware::Camera", Some(true)),
        ("hardware::Motors", "hardware::Motors", Some(false)),
        ("hardware::Both", "hardware::Both", Some(true)),
        ("framework::Unknown", "framework::Unknown", None),
    ] {
        let node = Node {
            cycle: "hardware: HardwareInterface,",
            asks,
            outputs: "",
            ..WRITER
        };
        let answer = Fixture::control(&["a"]).node("a", node).answer();
        let robot = answer.robot.expect("only warnings");
        let bounds = &robot.cyclers[0].nodes[0].cycle_bounds;
        assert_eq!(
            (bounds[0].path.as_str(), bounds[0].reading),
            (path, reading)
        );
    }
}
