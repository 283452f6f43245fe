//! What the methods of hardware traits give.

use super::WRITER;
use crate::scan::fixture::{Fixture, Node};
use crate::scan::traits::Answer;

#[test]
fn what_a_method_gives_is_told_by_what_its_names_stand_for() {
    for (head, gives, answer) in [
        ("", "()", Answer::Nothing),
        ("pub type Nothing = ();", "Nothing", Answer::Nothing),
        ("", "Result<(), u8>", Answer::ResultOfNothing),
        ("", "framework::Result<()>", Answer::ResultOfNothing),
        (
            "use framework::Result as Outcome;",
            "Outcome<()>",
            Answer::ResultOfNothing,
        ),
        (
            "pub type Done = framework::Result<()>;",
            "Done",
            Answer::ResultOfNothing,
        ),
        ("", "std::fmt::Result", Answer::ResultOfNothing),
        ("", "std::io::Result<()>", Answer::ResultOfNothing),
        ("", "framework::Result<u8>", Answer::Something),
        (
            "pub type Result<T> = Vec<T>;",
            "Result<()>",
            Answer::Something,
        ),
        (
            "pub type Done = framework::Result<u8>;",
            "Done",
            Answer::Something,
        ),
        ("", "u8", Answer::Something),
    ] {
        let node = Node {
            cycle: "hardware: HardwareInterface,",
            outputs: "",
            ..WRITER
        };
        let library = format!(
            "pub struct Hardware; {head} pub trait Motors {{ fn write(&self, value: u8) -> {gives}; }}"
        );
        let manifest = "[package]\nname = \"hardware\"\n[dependencies]\nframework = \"1\"\n";
        let answered = Fixture::control(&["a"])
            .node("a", node)
            .file("crates/hardware/Cargo.toml", manifest)
            .file("crates/hardware/src/lib.rs", &library)
            .answer();
        let robot = answered.robot.expect("only warnings");
        let bound = &robot.cyclers[0].nodes[0].cycle_bounds[0];
        let methods = bound.methods.as_deref().unwrap_or_default();
        assert_eq!(methods.len(), 1, "{head} {gives}");
        assert_eq!(methods[0].answer, answer, "{head} {gives}");
        let reading = answer == Answer::Something;
        assert_eq!(bound.reading, Some(reading), "{head} {gives}");
        assert_eq!(
            answered.codes.contains(&"hardware-read-outside-setup"),
            reading,
            "{head} {gives}"
        );
    }
}
