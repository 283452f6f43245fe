//! Modules from which conditions choose.

use super::acting;
use crate::scan::fixture::Fixture;

/// A node `a` whose text lies in `there.rs`, declared by these lines.
fn fixture(declared: &str) -> Fixture {
    let node = Fixture::control(&["a"]).node("a", acting());
    let text = node.text("crates/nodes/src/a.rs");
    let mut fixture = Fixture::control(&["a"]);
    fixture.add("crates/nodes/src/there.rs", &text);
    fixture.file("crates/nodes/src/lib.rs", declared)
}

#[test]
fn of_two_modules_that_is_taken_whose_condition_holds_here() {
    let here = "#[cfg(all())] #[path = \"there.rs\"] pub mod a;";
    let never = "#[cfg(not(all()))] #[path = \"elsewhere.rs\"] pub mod a;";
    for declared in [
        format!("{here} {never}"),
        format!("{never} {here}"),
        format!("{never} {never} {here} {never}"),
        "#[cfg_attr(all(), path = \"there.rs\")] pub mod a;".to_owned(),
        "#[cfg_attr(any(), path = \"elsewhere.rs\")] #[cfg_attr(all(), path = \"there.rs\")] pub mod a;".to_owned(),
    ] {
        let robot = fixture(&declared).robot();
        let node = &robot.cyclers[0].nodes[0];
        assert_eq!(node.file, "crates/nodes/src/there.rs", "{declared}");
        assert_eq!(robot.besides_edges, 1, "{declared}");
    }
}

#[test]
fn modules_between_which_nobody_here_can_choose_are_told() {
    let declared = "#[cfg(feature = \"x\")] #[path = \"there.rs\"] pub mod a; \
                    #[cfg(not(feature = \"x\"))] #[path = \"elsewhere.rs\"] pub mod a;";
    fixture(declared).expect(
        "unknown-node",
        &[
            "`nodes` declares `a` several times",
            "declare one `pub mod a;` in `crates/nodes/src/lib.rs`",
        ],
    );
}
