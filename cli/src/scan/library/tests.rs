//! Files that cannot be read as they stand.

use super::Library;
use crate::diagnostics::Diagnostics;
use crate::scan::fixture::{Fixture, Node};
use crate::workspace::Workspace;

const LIBRARY: &str = "crates/nodes/src/lib.rs";

#[test]
fn what_was_looked_at_quietly_is_told_to_who_asks_aloud() {
    let fixture = Fixture::control(&["a"])
        .node("a", Node::default())
        .file("crates/nodes/src/a.rs", "pub struct {");
    let workspace = Workspace::in_memory(fixture.files());
    let library = Library::new(&workspace, "generated".into());
    let told = || {
        let mut diagnostics = Diagnostics::new();
        library.report_problems(&mut diagnostics);
        diagnostics.sorted().len()
    };
    assert!(library.quietly(|| library.module("nodes::a")).is_none());
    assert_eq!(told(), 0);
    assert!(library.module("nodes::a").is_none());
    assert_eq!(told(), 1);
    assert!(library.quietly(|| library.module("nodes::a")).is_none());
    assert!(library.module("nodes::a").is_none());
    assert_eq!(told(), 0, "it was told already");
}

#[test]
fn a_byte_order_mark_moves_no_place() {
    let answer = |mark: &str| {
        let declared = format!("{mark}pub mod absent;");
        let fixture = Fixture::control(&["absent"]).file(LIBRARY, &declared);
        let manifest = format!("{mark}{}", fixture.text("hulk.toml"));
        fixture.file("hulk.toml", &manifest).answer().text
    };
    let plain = answer("");
    assert!(plain.contains(&format!("{LIBRARY}:1:9")), "{plain}");
    assert_eq!(answer("\u{feff}"), plain);
}
