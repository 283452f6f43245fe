//! What `[[bridge]]` may map.

use super::ACTS;
use crate::resolve::robot::BridgeKind;
use crate::scan::fixture::{Fixture, Node, cycler};

/// A cycler with every kind of thing that a client can name, and these lines behind `[[bridge]]`.
fn bridged(bridges: &[&str]) -> Fixture {
    let control = cycler("Control", "real-time", "", &[], &["a"]);
    let tables = bridges
        .iter()
        .map(|lines| format!("\n[[bridge]]\n{lines}\n"));
    let fixture = Fixture::new(&(control + &tables.collect::<String>()));
    let cycle = "hardware: HardwareInterface,
        limits: Parameter<Limits, \"gait.limits\">,
        seen: AdditionalOutput<u8, \"seen.$cycler_instance.count\">,
        by_letter: Parameter<char, \"by_letter\">,
        walk: Procedure<f32, bool, \"walk\">,
        spell: Procedure<char, bool, \"spell\">,";
    let outputs = "limits: MainOutput<Limits>, side: MainOutput<Option<Side>>,
        big: MainOutput<Vec<u128>>, by_name: MainOutput<std::collections::BTreeMap<String, f32>>,";
    let node = Node {
        cycle,
        outputs,
        ..ACTS
    };
    let mut fixture = fixture.node("a", node);
    fixture.add(
        "parameters/default.toml",
        "by_letter = \"a\"\n[gait.limits]\nlow = 1.0\n",
    );
    fixture
}

#[test]
fn everything_that_clients_can_name_can_be_bridged() {
    let robot = bridged(&[
        "path = \"Control.main_outputs.limits\"\nkey = \"a/b\"\nencoding = \"cdr\"\nrate = 5",
        "path = \"Control.main_outputs.limits.high\"\nkey = \"a/c\"",
        "path = \"Control.main_outputs.side\"\nkey = \"a/d\"\nencoding = \"cdr\"",
        "path = \"Control.additional_outputs.seen.control.count\"\nkey = \"a/e\"",
        "path = \"Control.procedures.walk\"\nkey = \"a/f\"\nencoding = \"cdr\"",
        "path = \"framework.procedures.rearm\"\nkey = \"a/g\"",
        "path = \"parameters.gait\"\nkey = \"a/h\"",
        "path = \"parameters.gait.limits.low\"\nkey = \"a/i\"\ndirection = \"both\"\nencoding = \"cdr\"",
    ])
    .robot();
    let kinds: Vec<BridgeKind> = robot.bridges.iter().map(|bridge| bridge.kind).collect();
    use BridgeKind::{AdditionalOutput, MainOutput, Parameter, Procedure};
    let outputs = [MainOutput, MainOutput, MainOutput, AdditionalOutput];
    let others = [Procedure, Procedure, Parameter, Parameter];
    assert_eq!(kinds, [outputs, others].concat());
    let types: Vec<_> = robot
        .bridges
        .iter()
        .map(|one| one.data.as_deref())
        .collect();
    assert_eq!(types[0], Some("types::Limits"));
    assert_eq!(types[1], Some("Option<f32>"));
    assert_eq!(types[4], None);
    assert_eq!(types[7], Some("f32"));
    assert_eq!(robot.bridges[7].direction, Some(schema::Direction::Both));
    assert_eq!(robot.bridges[4].direction, None);
}

#[test]
fn what_cannot_be_bridged_is_told_with_the_nearest_name() {
    for (lines, message, help) in [
        (
            "path = \"Contrl.main_outputs.limits\"",
            "there is no instance `Contrl`",
            "did you mean `Control`?",
        ),
        (
            "path = \"Control.main_output.limits\"",
            "names no output and no procedure of `Control`",
            "did you mean `main_outputs`?",
        ),
        (
            "path = \"Control.main_outputs.limit\"",
            "the robot has no main output `limit`",
            "did you mean `limits`?",
        ),
        (
            "path = \"Control.main_outputs\"",
            "`Control.main_outputs` names no main output",
            "there are `big`, `by_name`, `limits` and `side`",
        ),
        (
            "path = \"Control.main_outputs.limits.hihg\"",
            "`types::Limits` has no part `hihg`",
            "did you mean `high`?",
        ),
        (
            "path = \"Control.main_outputs.limits.low.x\"",
            "`f32` has no part `x`",
            "its parts are nothing",
        ),
        (
            "path = \"Control.additional_outputs.seen\"",
            "holds several values",
            "`seen.control.count`",
        ),
        (
            "path = \"Control.procedures.wlak\"",
            "answers a procedure `wlak`",
            "did you mean `walk`?",
        ),
        (
            "path = \"parameters.gait.limit\"",
            "the robot has no parameter `gait.limit`",
            "did you mean `gait.limits`?",
        ),
        (
            "path = \"Control.main_outputs.limits\"\ndirection = \"in\"",
            "is an output, which nodes alone write",
            "remove `direction`",
        ),
        (
            "path = \"Control.procedures.walk\"\ndirection = \"out\"",
            "has no direction",
            "whoever queries the key calls it",
        ),
        (
            "path = \"parameters.gait\"\nrate = 1",
            "is no output, so `rate` means nothing",
            "remove `rate`",
        ),
        (
            "path = \"Control.main_outputs.limits\"\nrate = 0",
            "cannot be sent 0 times in a second",
            "above 0",
        ),
        (
            "path = \"parameters.by_letter\"\nencoding = \"cdr\"",
            "has no form in CDR because of `char`",
            "name a part of it",
        ),
        (
            "path = \"Control.procedures.spell\"\nencoding = \"cdr\"",
            "has no form in CDR because of `char`",
            "write `encoding = \"json\"`",
        ),
        (
            "path = \"Control.main_outputs.big\"\nencoding = \"cdr\"",
            "has no form in CDR because of `u128`",
            "write `encoding = \"json\"`",
        ),
        (
            "path = \"Control.main_outputs.by_name\"\nencoding = \"cdr\"",
            "because of `std::collections::BTreeMap<String, f32>`",
            "name a part of it",
        ),
    ] {
        let fixture = bridged(&[&format!("{lines}\nkey = \"a\"")]);
        let parts = [message, help, "hulk.toml:"];
        fixture.answer().expect_error("invalid-bridge", &parts);
    }
}

#[test]
fn keys_are_plain_and_stand_once() {
    let path = "path = \"Control.main_outputs.limits\"";
    for key in ["", "/a", "a/", "a//b", "a/*", "a?b", "a b", "@a/b"] {
        let fixture = bridged(&[&format!("{path}\nkey = \"{key}\"")]);
        fixture.expect(
            "invalid-value",
            &["is no key of a bridge", "words joined by `/`"],
        );
    }
    let twice = format!("{path}\nkey = \"a/b\"");
    bridged(&[&twice, &twice]).expect("duplicate-name", &["key `a/b` stands twice"]);
}

#[test]
fn a_bridge_reads_what_it_carries() {
    let fixture = |bridge: &str| {
        let control = cycler("Control", "real-time", "", &[], &["a"]);
        let writes = Node {
            outputs: "x: MainOutput<u8>,",
            ..Node::default()
        };
        Fixture::new(&(control + bridge)).node("a", writes)
    };
    fixture("").expect("unread-outputs", &[]);
    fixture("\n[[bridge]]\npath = \"Control.main_outputs.x\"\nkey = \"x\"\n").robot();
}
