//! Finding nodes and reading their files.

mod answers;
mod chosen;
mod names;
mod state;

use super::Library;
use super::fixture::{Fixture, Node};
use super::types::Resolved;
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

/// The type that an author writes in the node file `a` of a fixture that something is added to, resolved.
fn resolve_in(with: impl Fn(Fixture) -> Fixture, head: &str, written: &str) -> Resolved {
    let fixture = Fixture::control(&["a"]).node("a", Node { head, ..WRITER });
    let workspace = Workspace::in_memory(with(fixture).files());
    let library = Library::new(&workspace, "generated".into());
    let module = library.find_module("nodes::a").expect("it is there");
    library.resolve(&module, &syn::parse_str(written).expect("it is a type"))
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
fn a_missing_bracket_is_told_once_in_the_file_of_the_node() {
    let fixture = Fixture::control(&["a", "b"]).file(
        "crates/nodes/src/lib.rs",
        "pub mod a;\npub mod b;\npub struct Pose\n    x: f32,\n}\n",
    );
    let answer = fixture.answer();
    assert_eq!(answer.codes, ["syntax"], "{}", answer.text);
    for part in [
        "this `}` closes nothing",
        "crates/nodes/src/lib.rs:5:1",
        "help: ",
    ] {
        assert!(answer.text.contains(part), "{}", answer.text);
    }
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
fn a_node_is_not_named_through_a_private_use() {
    let single = Fixture::control(&["a"]).node("a", acting());
    let node = single.text("crates/nodes/src/a.rs");
    let node = node.as_str();
    for import in [
        "use m::{b, a as alias};",
        "pub(crate) use crate::m::a as alias;",
    ] {
        let fixture = Fixture::control(&["nodes::alias"])
            .file("crates/nodes/src/lib.rs", &format!("mod m; {import}"))
            .file("crates/nodes/src/m.rs", "pub mod a; pub mod b {}")
            .file("crates/nodes/src/m/a.rs", node);
        let place = import.find("alias").expect("it stands there") + 8;
        fixture.expect(
            "not-public",
            &[
                "module `nodes::alias` is private",
                &format!("crates/nodes/src/lib.rs:1:{place}"),
                "write `pub use` there",
            ],
        );
    }
    let public = Fixture::control(&["nodes::alias"])
        .file("crates/nodes/src/lib.rs", "mod m; pub use m::a as alias;")
        .file("crates/nodes/src/m.rs", "pub mod a;")
        .file("crates/nodes/src/m/a.rs", node);
    public.robot();
}

#[test]
fn a_private_module_is_told_once_for_all_of_its_nodes() {
    let fixture = Fixture::control(&["nodes::m::a", "nodes::m::b"])
        .file("crates/nodes/src/lib.rs", "mod m;")
        .file("crates/nodes/src/m.rs", "pub mod a;\npub mod b;");
    fixture.expect("not-public", &["module `nodes::m` is private"]);
}

#[test]
fn a_node_that_is_named_by_its_type_is_told_its_module() {
    for text in ["pub struct Node;", "struct Node;"] {
        let fixture = Fixture::control(&["nodes::a::Node"])
            .file("crates/nodes/src/lib.rs", "pub mod a;")
            .file("crates/nodes/src/a.rs", text);
        fixture.expect(
            "unknown-node",
            &[
                "`nodes::a::Node` is no module",
                "help: write `nodes::a`: a node is named by its module",
            ],
        );
    }
    let at_the_root = Fixture::control(&["Node"])
        .node("a", acting())
        .file("crates/nodes/src/lib.rs", "pub mod a;\npub struct Node;");
    at_the_root.expect("unknown-node", &["by its module; `nodes` declares `a`"]);
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
fn a_broken_package_of_nodes_is_told_once() {
    let nodes = || {
        Fixture::control(&["a", "b"])
            .node("a", acting())
            .node("b", acting())
    };
    let broken = nodes().file("crates/nodes/Cargo.toml", "x = = 1");
    broken.expect("syntax", &["crates/nodes/Cargo.toml:1:"]);
    let nameless = nodes().file("crates/nodes/Cargo.toml", "[package]\nversion = \"1.0.0\"");
    nameless.expect(
        "syntax",
        &["`[package]` needs a `name`", "crates/nodes/Cargo.toml:1:"],
    );
    // What the generated crate says hides nobody.
    let elsewhere = Fixture::control(&["node::a"])
        .node("a", acting())
        .file("generated/Cargo.toml", "x = = 1");
    elsewhere.expect(
        "unknown-node",
        &["no crate of the workspace is called `node`"],
    );
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

#[test]
fn a_file_that_is_named_in_an_inline_module_lies_where_rustc_looks() {
    let nodes = [
        "nodes::outer::moved",
        "nodes::folder::within",
        "nodes::files::deep::moved",
    ];
    let fixture = Fixture::control(&nodes).node("x", acting());
    let text = node_text(&fixture);
    let fixture = fixture
        .file(
            "crates/nodes/src/lib.rs",
            "pub mod outer { #[path = \"there.rs\"] pub mod moved; }\n\
             #[path = \"named\"] pub mod folder { pub mod within; }\npub mod files;",
        )
        .file(
            "crates/nodes/src/files.rs",
            "pub mod deep { #[path = \"there.rs\"] pub mod moved; }",
        );
    let files = ["outer/there.rs", "named/within.rs", "files/deep/there.rs"];
    let files = files.map(|file| format!("crates/nodes/src/{file}"));
    let fixture = files
        .iter()
        .fold(fixture, |fixture, file| fixture.file(file, &text));
    let workspace = Workspace::in_memory(fixture.files());
    let library = Library::new(&workspace, "generated".into());
    for (node, file) in nodes.iter().zip(&files) {
        let module = library.find_module(node);
        assert_eq!(module.expect("it is there").file, *file);
    }
}

#[test]
fn a_node_may_be_brought_in_by_a_glob() {
    let moved = |library: &str| {
        let fixture = Fixture::control(&["a"]).node("a", acting());
        let node = fixture.text("crates/nodes/src/a.rs");
        fixture
            .file("crates/nodes/src/lib.rs", library)
            .file("crates/nodes/src/folder.rs", "pub mod a;")
            .file("crates/nodes/src/folder/a.rs", &node)
    };
    let robot = moved("mod folder; pub use folder::*;").robot();
    let node = &robot.cyclers[0].nodes[0];
    assert_eq!(node.path, "nodes::a");
    assert_eq!(node.file, "crates/nodes/src/folder/a.rs");
    moved("mod folder; use folder::*;")
        .expect("unknown-node", &["module `nodes::a` is not declared"]);
}

#[test]
fn places_behind_a_line_for_the_shell_are_those_of_the_file() {
    for first in ["#!/usr/bin/env don't\n", "#! [cfg(all())]\n", ""] {
        let fixture = Fixture::control(&["a"]).node("a", acting());
        let text = fixture.text("crates/nodes/src/a.rs");
        let read = "x: Input<u8, \"x\">,\nhardware: HardwareInterface";
        let text = first.to_owned() + &text.replace("hardware: HardwareInterface", read);
        let before = text.lines().take_while(|line| !line.starts_with("x:"));
        let place = format!("crates/nodes/src/a.rs:{}:14", before.count() + 1);
        fixture
            .file("crates/nodes/src/a.rs", &text)
            .answer()
            .expect_error("unknown-output", &[&place]);
    }
}

#[test]
fn a_function_may_be_called_as_a_module_is() {
    for library in ["pub use a::a;\npub mod a;", "pub mod a;\npub use a::a;"] {
        let robot = Fixture::control(&["a"])
            .node("a", acting())
            .file("crates/nodes/src/lib.rs", library)
            .robot();
        assert_eq!(robot.cyclers[0].nodes[0].path, "nodes::a");
    }
}
