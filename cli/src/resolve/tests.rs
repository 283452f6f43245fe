//! What nodes and the manifest can disagree about, one robot per diagnostic, and the robot where they agree.

mod agreement;
mod bridges;
mod conditional;
mod declared;
mod failures;
mod inputs;
mod nondeterminism;
mod sendable;
mod served;
mod trees;
mod warnings;

use crate::scan::fixture::{Fixture, Node, cycler};

/// A node that acts, so that nothing is said about outputs that nobody reads.
const ACTS: Node<'_> = Node {
    head: "use types::*;",
    creation: "",
    cycle: "hardware: HardwareInterface,",
    outputs: "",
    state: "",
    asks: "hardware::Motors",
    more: "",
};

/// A node that writes.
fn writes(outputs: &str) -> Node<'_> {
    Node {
        head: "use types::*;",
        outputs,
        ..Node::default()
    }
}

/// A node that acts and has this field in its cycle context.
fn with_field(fixture: Fixture, name: &str, field: &str) -> Fixture {
    let cycle = format!("{field},\nhardware: HardwareInterface,");
    fixture.node(
        name,
        Node {
            cycle: &cycle,
            ..ACTS
        },
    )
}

/// Cycler `Vision` with instances `VisionTop` and `VisionBottom` and the node `eye`, cycler `Control` with the node `hand`.
fn two_cyclers() -> Fixture {
    let vision = cycler(
        "Vision",
        "perception",
        "instances = [\"Top\", \"Bottom\"]",
        &[],
        &["eye"],
    );
    let control = cycler("Control", "real-time", "", &[], &["hand"]);
    Fixture::new(&(vision + &control)).node("eye", writes("ball: MainOutput<Option<Ball>>,"))
}
