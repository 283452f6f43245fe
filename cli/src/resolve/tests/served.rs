//! Targets whose hardware does not serve what nodes ask.

use super::ACTS;
use crate::scan::fixture::{Fixture, Node, cycler};

const TRAITS: &str = "
    pub trait Camera { fn read(&self) -> Result<u8>; }
    pub trait Motors { fn write(&self, value: u8) -> Result<()>; }
    mod inner;
    impl framework::Hardware for Hardware {}
";

/// A node that asks for `hardware::Motors`, and this code in the crate of the hardware.
fn fixture(library: &str, inner: &str) -> Fixture {
    let target = "[[target]]\nname = \"bench\"\nhardware = \"hardware::Hardware\"\n";
    let control = cycler("Control", "real-time", "", &[], &["a"]);
    Fixture::new(&format!("{control}{target}"))
        .node("a", ACTS)
        .file("crates/hardware/src/lib.rs", &format!("{TRAITS}{library}"))
        .file("crates/hardware/src/inner.rs", inner)
}

#[test]
fn a_trait_that_is_not_served_is_told_at_the_node_and_the_target() {
    fixture("pub struct Hardware;", "").expect(
        "unserved-trait",
        &[
            "`hardware::Hardware` does not serve `Motors`, which `nodes::a` asks for",
            "crates/nodes/src/a.rs:",
            "asked for by `nodes::a`",
            "hulk.toml:",
            "target `bench`",
            "impl Motors for Hardware",
        ],
    );
    let other =
        "pub struct Hardware; struct Other; impl Motors for Other {} impl Camera for Hardware {}";
    fixture(other, "").expect("unserved-trait", &["`Motors`"]);
    let attributes = "
        pub struct Hardware;
        #[derive(thiserror::Error)] #[cfg_attr(never, derive(Debug))] enum Bad { #[error(\"a\")] A }
        impl Hardware { #[inline] #[must_use] #[rustfmt::skip] fn f(&self) {} }
        #[cfg(test)] #[serves] impl Hardware {}
    ";
    fixture(attributes, "").expect("unserved-trait", &["`Motors`"]);
}

#[test]
fn creation_and_restoring_ask_too() {
    let asks = Node {
        creation: "hardware: HardwareInterface,",
        more: "pub fn restore(&mut self, context: CreationContext<impl hardware::Camera>) -> Result<()> {}",
        ..ACTS
    };
    let fixture = fixture("pub struct Hardware; impl Motors for Hardware {}", "").node("a", asks);
    let text = fixture.text("crates/nodes/src/a.rs");
    let text = text.replace(
        "new(context: CreationContext)",
        "new(context: CreationContext<impl hardware::Camera>)",
    );
    let library = fixture
        .text("crates/nodes/src/lib.rs")
        .replacen("pub mod a;\n", "", 1);
    fixture
        .file("crates/nodes/src/a.rs", &text)
        .file("crates/nodes/src/lib.rs", &library)
        .expect("unserved-trait", &["does not serve `Camera`"]);
}

#[test]
fn an_impl_is_found_wherever_it_stands() {
    for (library, inner) in [
        ("pub struct Hardware; impl Motors for Hardware {}", ""),
        (
            "pub struct Hardware;",
            "impl crate::Motors for super::Hardware {}",
        ),
        (
            "pub struct Hardware;",
            "use crate::{Hardware as H, Motors as M}; impl M for H {}",
        ),
        (
            "pub struct Hardware;",
            "use crate::*; const _: () = { impl Motors for Hardware {} };",
        ),
        (
            "pub use inner::Hardware;",
            "pub struct Hardware; impl crate::Motors for Hardware {}",
        ),
        (
            "pub struct Real<T>(T); pub type Hardware = Real<u8>; impl<T> Motors for Real<T> {}",
            "",
        ),
    ] {
        fixture(library, inner).robot();
    }
}

#[test]
fn what_cannot_be_known_is_left_to_rustc() {
    for (library, inner) in [
        ("pub struct Hardware; impl<T> Motors for T {}", ""),
        ("pub struct Hardware; serve!(Hardware);", ""),
        ("pub struct Hardware;", "serve!(Hardware);"),
        ("#[derive(Motors)] pub struct Hardware;", ""),
        ("#[serves] pub struct Hardware;", ""),
        ("pub struct Hardware; #[cfg(never)] mod absent;", ""),
        ("pub use elsewhere::Hardware;", ""),
        (
            "#[cfg_attr(never, derive(Motors))] pub struct Hardware;",
            "",
        ),
        ("pub struct Hardware; #[serves] impl Hardware {}", ""),
        (
            "pub struct Hardware; #[cfg_attr(never, serves(Motors))] struct Other;",
            "",
        ),
        (
            "pub struct Hardware; impl Hardware { #[serves] fn write(&self) {} }",
            "",
        ),
        ("pub struct Hardware; #[serves] trait Other {}", ""),
        ("pub struct Hardware; trait Other { #[serves] fn a(); }", ""),
        ("pub struct Hardware; #[serves] mod more {}", ""),
        (
            "pub struct Hardware;",
            "#[serves(super::Hardware)] mod more {}",
        ),
    ] {
        let answer = fixture(library, inner).answer();
        assert!(!answer.codes.contains(&"unserved-trait"), "{}", answer.text);
    }
}

#[test]
fn an_impl_for_other_arguments_is_left_to_rustc() {
    let left = |asks: &str, library: &str| {
        let traits =
            "pub trait Get<T> { fn get(&self) -> Result<T>; } pub struct Local; pub struct Other;";
        let node = Node { asks, ..ACTS };
        let target = "[[target]]\nname = \"bench\"\nhardware = \"hardware::Robot\"\n";
        let control = cycler("Control", "real-time", "", &[], &["a"]);
        let library = format!(
            "{traits} pub struct Real<T>(T); impl framework::Hardware for Robot {{}} {library}"
        );
        let answer = Fixture::new(&format!("{control}{target}"))
            .node("a", node)
            .file(
                "crates/hardware/Cargo.toml",
                "[package]\nname = \"hardware\"\n[dependencies]\nframework = \"1\"\n",
            )
            .file("crates/hardware/src/lib.rs", &library)
            .answer();
        let robot = answer.robot.unwrap_or_else(|| panic!("{}", answer.text));
        robot.besides_edges
    };
    let get = "hardware::Get<hardware::Local>";
    let plain = |served: &str| format!("pub struct Robot; {served}");
    let served = plain("use Local as L; impl Get<L> for Robot {}");
    let known = left(get, &served);
    let both = plain("impl Get<f32> for Robot {} impl Get<Local> for Robot {}");
    assert_eq!(left(get, &both), known);
    let twice = format!("{get} + hardware::Get<f32>");
    assert_eq!(left(&twice, &both), known);
    assert_eq!(left(&twice, &served), known + 1);
    for other in [
        "impl Get<f32> for Robot {}",
        "impl Get<Other> for Robot {}",
        "impl<T> Get<T> for Robot where T: Into<u8> {}",
        "impl Get<elsewhere!()> for Robot {}",
    ] {
        assert_eq!(left(get, &plain(other)), known + 1, "{other}");
    }
    let real = |argument: &str| {
        format!("pub type Robot = Real<u8>; impl Get<Local> for Real<{argument}> {{}}")
    };
    assert_eq!(left(get, &real("u8")), known);
    assert_eq!(left(get, &real("f32")), known + 1);
}

/// A robot whose target has this hardware, and this code in its crate.
fn with_hardware(path: &str, library: &str) -> Fixture {
    let target = format!("[[target]]\nname = \"bench\"\nhardware = \"{path}\"\n");
    let control = cycler("Control", "real-time", "", &[], &["a"]);
    let library =
        format!("pub trait Motors {{ fn write(&self, value: u8) -> Result<()>; }} {library}");
    Fixture::new(&format!("{control}{target}"))
        .node("a", ACTS)
        .file("crates/hardware/src/lib.rs", &library)
}

#[test]
fn what_is_no_hardware_for_the_framework_is_told_at_the_target() {
    for library in [
        "pub struct Hardware; impl Motors for Hardware {}",
        "pub struct Hardware; trait Other {} impl Other for Hardware {} impl Motors for Hardware {}",
        "pub struct Hardware; struct X; impl framework::Hardware for X {} impl Motors for Hardware {}",
    ] {
        with_hardware("hardware::Hardware", library).expect(
            "unknown-hardware",
            &[
                "`hardware::Hardware` does not implement `framework::Hardware`",
                "hulk.toml:",
                "target `bench`",
                "write `impl framework::Hardware for Hardware",
            ],
        );
    }
    for library in [
        "pub struct Robot; impl framework::Hardware for Robot {} impl Motors for Robot {}",
        "use framework::Hardware as H; pub struct Robot; impl H for Robot {} impl Motors for Robot {}",
        "use framework::*; pub struct Robot; mod x { use super::*; impl Hardware for Robot {} } impl Motors for Robot {}",
        "pub struct Robot; is_hardware!(Robot); impl Motors for Robot {}",
        "pub struct Robot; impl<T> framework::Hardware for T {} impl Motors for Robot {}",
    ] {
        with_hardware("hardware::Robot", library).robot();
    }
}

#[test]
fn a_hardware_is_public_on_the_whole_way() {
    let hardware =
        "pub struct Robot; impl framework::Hardware for Robot {} impl Motors for Robot {}";
    for (path, more, hidden) in [
        (
            "m::Robot",
            "mod m { pub use super::Robot; }",
            "module `hardware::m`",
        ),
        (
            "m::Robot",
            "pub mod m { use super::Robot; }",
            "`hardware::m::Robot`",
        ),
        (
            "m::Robot",
            "pub mod m { pub(crate) use super::Robot; }",
            "`hardware::m::Robot`",
        ),
        (
            "m::Robot",
            "pub mod m { use super::*; }",
            "`hardware::m::Robot`",
        ),
        (
            "n::Robot",
            "mod m { pub use super::Robot; } use m as n;",
            "module `hardware::n`",
        ),
        (
            "m::n::Robot",
            "mod n { pub use super::Robot; } pub mod m { use super::*; }",
            "module `hardware::m::n`",
        ),
    ] {
        let path = format!("hardware::{path}");
        with_hardware(&path, &format!("{hardware} {more}")).expect(
            "unknown-hardware",
            &[
                &format!("{hidden} is private"),
                "help: write `hardware::Robot`",
            ],
        );
    }
    let inside = format!("mod m {{ use super::Motors; {hardware} }}");
    with_hardware("hardware::m::Robot", &inside).expect(
        "unknown-hardware",
        &[
            "module `hardware::m` is private",
            "write `pub` at `Robot` and its modules",
        ],
    );
    for (path, more) in [
        ("m::Robot", "pub mod m { pub use super::Robot; }"),
        ("m::Robot", "pub mod m { pub use super::*; }"),
        (
            "m::Robot",
            "pub mod m { pub use super::n::*; } mod n { pub use super::*; }",
        ),
        (
            "n::Robot",
            "mod m { pub use super::Robot; } pub use m as n;",
        ),
        (
            "m::n::Robot",
            "pub mod n { pub use super::Robot; } pub mod m { pub use super::*; }",
        ),
        // These may be another, public one.
        ("m::Robot", "pub mod m { use super::*; hardware!(); }"),
        (
            "m::Robot",
            "pub mod m { #[cfg(x)] use super::Robot; #[cfg(not(x))] pub use super::Robot; }",
        ),
    ] {
        let path = format!("hardware::{path}");
        with_hardware(&path, &format!("{hardware} {more}")).robot();
    }
}

#[test]
fn a_hardware_with_parameters_needs_their_arguments() {
    let library = "pub struct Hardware<T>(T); impl framework::Hardware for Hardware<f32> {} impl Motors for Hardware<f32> {}";
    with_hardware("hardware::Hardware", library).expect(
        "unknown-hardware",
        &[
            "nothing tells what `T` of `hardware::Hardware` is",
            "hulk.toml:",
            "`pub type`",
        ],
    );
    let constant = library.replace("<T>(T)", "<const N: usize>");
    with_hardware("hardware::Hardware", &constant).expect("unknown-hardware", &["`N`"]);
    let default = library.replace("<T>(T)", "<T = f32>(T)");
    with_hardware("hardware::Hardware", &default).robot();
    let alias = format!("{library} pub type Robot = Hardware<f32>;");
    with_hardware("hardware::Robot", &alias).robot();
}
