//! Types of which a macro or a condition decides whether generated code can write them.

use super::writes;
use crate::scan::fixture::Fixture;

/// A node that writes an output of this type, and this code in the root of its crate.
fn fixture(written: &str, library: &str) -> Fixture {
    let outputs = format!("made: MainOutput<{written}>,");
    let fixture = Fixture::control(&["a"]).node("a", writes(&outputs));
    let modules = fixture.text("crates/nodes/src/lib.rs");
    fixture.file(
        "crates/nodes/src/lib.rs",
        &format!(
            "{modules} macro_rules! make {{ ($name:ident) => {{ pub struct $name; }} }} {library}"
        ),
    )
}

#[test]
fn what_a_macro_makes_in_a_private_module_is_told() {
    for (written, library) in [
        ("crate::hidden::Made", "mod hidden { make!(Made); }"),
        (
            "crate::shown::Made",
            "mod hidden { make!(Made); } pub mod shown { pub(crate) use crate::hidden::Made; }",
        ),
        (
            "Vec<crate::hidden::Made>",
            "mod hidden { include!(\"made.rs\"); }",
        ),
    ] {
        fixture(written, library).answer().expect_error(
            "not-public",
            &[
                "`nodes::hidden::Made` is private",
                "crates/nodes/src/lib.rs:",
            ],
        );
    }
}

#[test]
fn what_may_be_public_is_counted() {
    for (written, library, path, left) in [
        (
            "crate::made::Made",
            "pub mod made { make!(Made); }",
            "nodes::made::Made",
            1,
        ),
        (
            "crate::hidden::Made",
            "mod hidden { make!(Made); } pub use hidden::Made;",
            "nodes::Made",
            1,
        ),
        (
            "crate::hidden::Made",
            "mod hidden { make!(Made); } pub mod shown { pub use crate::hidden::*; }",
            "nodes::shown::Made",
            1,
        ),
        (
            "crate::hidden::Made",
            "mod hidden { use somewhere::*; make!(Made); }",
            "nodes::hidden::Made",
            1,
        ),
        (
            "crate::hidden::T",
            "mod hidden { pub struct T; } #[cfg(any())] pub use hidden::T;",
            "nodes::T",
            1,
        ),
        (
            "crate::hidden::T",
            "mod hidden { pub struct T; } #[cfg(any())] pub use hidden::T; pub mod shown { pub use crate::hidden::T as U; }",
            "nodes::shown::U",
            0,
        ),
        (
            "crate::made::T",
            "#[cfg(any())] pub mod made { pub struct T; }",
            "nodes::made::T",
            0,
        ),
    ] {
        let robot = fixture(written, library).answer().robot.expect("no errors");
        assert_eq!(robot.cyclers[0].outputs[0].data.text, path, "{library}");
        assert_eq!(robot.besides_edges, left, "{library}");
    }
}
