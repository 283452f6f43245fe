//! Parameter files: what lacks, what is too much, what has the wrong type.

use crate::diagnostics::Diagnostics;
use crate::pipeline;
use crate::scan::fixture::{Fixture, Node, cycler};
use crate::workspace::Workspace;

mod endless;
mod instances;
mod missing;
mod ranges;

/// A robot whose node `a` has these parameters.
fn robot(fields: &str, targets: &str) -> Fixture {
    let manifest = format!(
        "identities = [\"head\"]\n{}{targets}",
        cycler("Control", "real-time", "", &[], &["a"])
    );
    let cycle = format!("{fields}\nhardware: HardwareInterface,");
    Fixture::new(&manifest).node(
        "a",
        Node {
            head: "use types::*;",
            cycle: &cycle,
            asks: "hardware::Motors",
            ..Node::default()
        },
    )
}

const NAO: &str =
    "[[target]]\nname = \"nao\"\nhardware = \"hardware::Hardware\"\nlocation = \"field\"\n";

#[test]
fn files_that_fit_are_silent() {
    robot("a: Parameter<f32, \"a.b\">,\nb: Parameter<Limits, \"limits\">,\nc: Parameter<[u8; COUNT], \"c\">,", NAO)
        .file(
            "parameters/default.toml",
            "c = [1, 2, 3]\n[a]\nb = 1\n[limits]\nlow = 0.5\n[hardware.nao]\nanything = [1]\n",
        )
        .file("parameters/field/default.toml", "[limits]\nhigh = 2\n")
        .file("parameters/head.P1.toml", "[a]\nb = 2.5\n")
        .robot();
}

#[test]
fn a_missing_file_is_named() {
    let fixture =
        robot("a: Parameter<f32, \"a\">,", NAO).file("parameters/field/default.toml", "a = 1\n");
    fixture.expect(
        "missing-parameter-file",
        &[
            "parameters/default.toml",
            "create `parameters/default.toml`",
        ],
    );
    let fixture =
        robot("a: Parameter<f32, \"a\">,", NAO).file("parameters/default.toml", "a = 1\n");
    fixture.expect(
        "missing-parameter-file",
        &["parameters/field/default.toml", "location = \"field\""],
    );
}

#[test]
fn a_value_that_no_file_gives_is_named_with_its_reader() {
    let fixture = robot(
        "a: Parameter<f32, \"a.b\">,\nb: Parameter<Option<u8>, \"maybe\">,",
        "",
    );
    fixture.file("parameters/default.toml", "[a]\n").expect(
        "missing-parameter",
        &[
            "no file gives the parameter `a.b`",
            "parameters/default.toml:1:2",
            "a.rs:15:4",
            "read here",
            "add `a.b = …`",
        ],
    );
    let limits = robot("a: Parameter<Limits, \"limits\">,", "");
    limits
        .file("parameters/default.toml", "[limits]\nhigh = 1\n")
        .expect("missing-parameter", &["`limits.low`"]);
}

#[test]
fn a_forgotten_mark_of_the_instance_is_shown_where_it_was_forgotten() {
    let fields =
        "a: Parameter<f32, \"$cycler_instance.a\">,\nb: Parameter<f32, \"cycler_instance.a\">,";
    robot(fields, "")
        .file("parameters/default.toml", "control.a = 1\n")
        .expect(
            "missing-parameter",
            &[
                "no file gives the parameter `cycler_instance.a`",
                "a.rs:16:4",
            ],
        );
}

#[test]
fn a_value_of_another_location_does_not_count() {
    let second = "[[target]]\nname = \"sim\"\nhardware = \"hardware::Hardware\"\n";
    robot("a: Parameter<f32, \"a\">,", &format!("{NAO}{second}"))
        .file("parameters/default.toml", "")
        .file("parameters/field/default.toml", "a = 1\n")
        .expect(
            "missing-parameter",
            &[
                "no file gives the parameter `a` for target `sim`",
                "parameters/field/default.toml:1:1",
                "given for location `field`",
                "add `a = …`",
            ],
        );
}

#[test]
fn a_value_of_an_identity_at_another_location_does_not_count() {
    robot("a: Parameter<f32, \"a\">,", NAO)
        .file("parameters/default.toml", "")
        .file("parameters/field/default.toml", "")
        .file("parameters/lab/head.P1.toml", "a = 1\n")
        .expect(
            "missing-parameter",
            &[
                "no file gives the parameter `a`\n",
                "looked at `parameters/default.toml` and `parameters/field/default.toml`",
                "parameters/lab/head.P1.toml:1:1",
                "given for head `P1` at location `lab`",
            ],
        );
}

#[test]
fn what_a_file_would_give_that_cannot_be_read_is_not_missed() {
    robot("a: Parameter<f32, \"a\">,", NAO)
        .file("parameters/default.toml", "")
        .file("parameters/field/default.toml", "a = \n")
        .expect("syntax", &["parameters/field/default.toml:1:"]);
}

#[test]
fn the_folder_may_name_the_location_of_targets_without_one() {
    robot("a: Parameter<f32, \"a\">,", "")
        .file("parameters/default.toml", "")
        .file("parameters/parameters.toml", "location = \"field\"\n")
        .file("parameters/field/default.toml", "a = 1\n")
        .robot();
}

#[test]
fn the_file_that_names_the_location_is_checked() {
    let fixture = || {
        robot("a: Parameter<f32, \"a\">,", "")
            .file("parameters/default.toml", "a = 1\n")
            .file("parameters/field/default.toml", "a = 2\n")
    };
    for (text, code, part) in [
        ("location = \n", "syntax", "parameters/parameters.toml:1:"),
        (
            "locatoin = \"field\"\n",
            "unknown-key",
            "did you mean `location`?",
        ),
        (
            "location = \"field\"\na = 1\n",
            "unknown-key",
            "parameters/parameters.toml:2:1",
        ),
        (
            "location = 1\n",
            "invalid-value",
            "parameters/parameters.toml:1:12",
        ),
        (
            "location = \"feild\"\n",
            "missing-parameter-file",
            "did you mean `field`?",
        ),
    ] {
        fixture()
            .file("parameters/parameters.toml", text)
            .expect(code, &[part, "parameters/parameters.toml"]);
    }
    fixture()
        .file("parameters/parameters.toml", "location = \"home\"\n")
        .file("parameters/home/notes.md", "")
        .expect(
            "missing-parameter-file",
            &["create `parameters/home/default.toml`"],
        );
    fixture()
        .file("parameters/parameters.toml", "location = \"far/away\"\n")
        .file("parameters/far/away/default.toml", "b = 1\n")
        .expect(
            "unknown-parameter",
            &["parameters/far/away/default.toml:1:1"],
        );
}

#[test]
fn a_location_of_a_target_is_a_folder() {
    robot(
        "a: Parameter<f32, \"a\">,",
        &NAO.replace("\"field\"", "\"feild\""),
    )
    .file("parameters/default.toml", "a = 1\n")
    .file("parameters/field/default.toml", "a = 2\n")
    .expect(
        "missing-parameter-file",
        &[
            "`parameters` has no location `feild`",
            "did you mean `field`?",
            "hulk.toml:",
        ],
    );
}

#[test]
fn a_field_may_be_called_like_a_keyword() {
    let head = "#[derive(Deserialize)]\npub struct Filter { pub r#type: u8 }";
    let manifest = cycler("Control", "real-time", "", &[], &["a"]);
    let fixture = || {
        Fixture::new(&manifest).node(
            "a",
            Node {
                head,
                cycle: "a: Parameter<Filter, \"filter\">,\nhardware: HardwareInterface,",
                asks: "hardware::Motors",
                ..Node::default()
            },
        )
    };
    let default = "parameters/default.toml";
    fixture().file(default, "[filter]\ntype = 1\n").robot();
    fixture()
        .file(default, "[filter]\n")
        .expect("missing-parameter", &["`filter.type`"]);
}

#[test]
fn a_value_of_an_identity_counts() {
    robot("a: Parameter<f32, \"a\">,", "")
        .file("parameters/default.toml", "")
        .file("parameters/head.P1.toml", "a = 1\n")
        .robot();
    robot("a: Parameter<f32, \"a\">,", NAO)
        .file("parameters/default.toml", "")
        .file("parameters/field/default.toml", "")
        .file("parameters/field/head.P1.toml", "a = 1\n")
        .robot();
}

#[test]
fn keys_that_nobody_declares_are_told_with_line() {
    let fixture = || {
        robot(
            "a: Parameter<f32, \"a.bcd\">,\nb: Parameter<Limits, \"limits\">,",
            NAO,
        )
    };
    let default = (
        "parameters/default.toml",
        "[a]\nbcd = 1\n[limits]\nlow = 1\n",
    );
    fixture()
        .file(default.0, &format!("{}hgih = 2\n", default.1))
        .file(
            "parameters/field/default.toml",
            "[a]\nbcde = 1\n[hardware.noa]\n",
        )
        .answer()
        .expect_all(
            &[
                "unknown-parameter",
                "unknown-parameter",
                "unknown-parameter",
            ],
            &[
                "`limits.hgih`",
                "did you mean `high`?",
                "parameters/default.toml:5:1",
                "`a.bcde`",
                "did you mean `bcd`?",
                "no target `noa`",
            ],
        );
}

#[test]
fn values_of_the_wrong_type_are_told() {
    for (data, value, part) in [
        ("f32", "\"one\"", "is a string, not a number"),
        ("bool", "1", "is a number, not true or false"),
        ("u8", "300", "write a number from 0 to 255"),
        ("f32", "-1e39", "does not fit into a `f32`"),
        ("f64", "1e999", "does not fit into a `f64`"),
        ("u8", "1.5", "is a number, not a whole number"),
        ("String", "1", "is a number, not a string"),
        ("Vec<u8>", "[1, \"a\"]", "is a string, not a whole number"),
        ("[u8; COUNT]", "[1, 2]", "has 2 elements, not 3"),
        ("(u8, u8)", "[1]", "has 1 element, not 2"),
        ("Side", "\"Lefd\"", "did you mean \"Left\"?"),
        ("Limits", "1", "is a number, not a table"),
        ("Option<u8>", "\"x\"", "is a string"),
        (
            "Vec<Limits>",
            "[{ low = 1 }, { low = \"a\" }]",
            "is a string, not a number",
        ),
        (
            "Vec<Limits>",
            "[{ low = 1, hgih = 2 }]",
            "did you mean `high`?",
        ),
        ("[Limits; 1]", "[{ high = 2 }]", "has a table without `low`"),
    ] {
        robot(&format!("a: Parameter<{data}, \"a\">,"), "")
            .file("parameters/default.toml", &format!("a = {value}\n"))
            .expect("mistyped-parameter", &[part, "parameters/default.toml:1:"]);
    }
    robot("a: Parameter<f32, \"a.b\">,", "")
        .file("parameters/default.toml", "a = 1\n")
        .answer()
        .expect_all(
            &["missing-parameter", "mistyped-parameter"],
            &["`a` is a number, not a table"],
        );
}

#[test]
fn floats_that_their_types_hold_are_right() {
    for (data, value) in [("f32", "-inf"), ("f32", "3e38"), ("f64", "1e39")] {
        robot(&format!("a: Parameter<{data}, \"a\">,"), "")
            .file("parameters/default.toml", &format!("a = {value}\n"))
            .robot();
    }
}

#[test]
fn what_cannot_be_seen_is_not_judged() {
    robot(
        "a: Parameter<nalgebra::Point2<f32>, \"a\">,\nb: Parameter<Ball, \"b\">,",
        "",
    )
    .file(
        "parameters/default.toml",
        "a = [1.0, 2.0]\nb = \"anything\"\n",
    )
    .robot();
}

#[test]
fn a_file_that_is_no_toml_is_shown() {
    robot("a: Parameter<f32, \"a\">,", "")
        .file("parameters/default.toml", "a = \n")
        .expect("syntax", &["parameters/default.toml:1:"]);
}

#[test]
fn what_serde_alone_can_read_is_opaque_and_nothing_else() {
    let types = "
        #[derive(Deserialize)]
        #[serde(rename_all = \"camelCase\")]
        pub struct Mixed {
            pub plain_field: [u8; 2],
            pub free_point: nalgebra::Point2<f32>,
            #[serde(deserialize_with = \"read\")]
            pub angle: f32,
            pub inner: Inner,
        }
        #[derive(Deserialize)]
        pub struct Inner { pub list: Vec<Option<Kind>>, pub time: std::time::Duration, pub more: Option<Box<Inner>>, pub odd: Speed }
        #[derive(Deserialize)]
        pub enum Kind { One, Two }
        #[derive(Deserialize)]
        pub enum Data { One, Two(f32) }
        #[derive(Deserialize)]
        #[serde(try_from = \"f32\")]
        pub struct Speed { pub value: f32 }
        pub struct ByHand { pub value: f32 }
        #[derive(Deserialize)]
        pub struct Clear { pub kind: Kind, pub pair: (f32, String), #[serde(default)] pub on: bool }
    ";
    let fields = "
        a: Parameter<mixed::Mixed, \"mixed\">,
        b: Parameter<mixed::Data, \"deep.data\">,
        c: Parameter<mixed::Speed, \"deep.speed\">,
        d: Parameter<mixed::ByHand, \"deep.by_hand\">,
        e: Parameter<mixed::Clear, \"deep.clear\">,
        f: Parameter<Vec<mixed::Clear>, \"list\">,
        g: Parameter<Vec<mixed::Speed>, \"speeds\">,
        h: Parameter<Option<char>, \"letter\">,
    ";
    let fixture = robot(fields, NAO)
        .file("crates/types/src/lib.rs", "pub mod mixed;")
        .file("crates/types/src/mixed.rs", types)
        .file("parameters/default.toml", "")
        .file("parameters/field/default.toml", "")
        .file("parameters/lab/head.P1.toml", "");
    let workspace = Workspace::in_memory(fixture.files());
    let understood = pipeline::understand(&workspace, &mut Diagnostics::new());
    let unchecked = understood
        .expect("only parameter files have mistakes")
        .unchecked;
    assert_eq!(
        unchecked.opaque,
        [
            "deep.by_hand",
            "deep.speed",
            "mixed.angle",
            "mixed.freePoint",
            "mixed.inner.odd",
            "speeds",
        ]
    );
    let field = [Some("field".to_owned())];
    assert!(unchecked.locations.iter().eq(&field));
    assert!(unchecked.other_locations.iter().eq(["lab"]));
}

#[test]
fn what_a_layer_takes_away_is_missed_where_it_has_to_be_given() {
    let limits = "b: Parameter<Limits, \"limits\">,\na: Parameter<Option<f32>, \"a\">,";
    let robot = |field: &str, head: &str| {
        robot(limits, NAO)
            .file(
                "parameters/default.toml",
                "a = 1\nlimits = { low = 1, high = 2 }\n",
            )
            .file("parameters/field/default.toml", field)
            .file("parameters/head.P1.toml", head)
    };
    let gone = "a = { unset = true }\n";
    robot(gone, "").robot();
    robot("limits.low = { unset = true }\n", "")
        .expect("missing-parameter", &["no file gives", "`limits.low`"]);
    robot("limits = { unset = true }\n", "limits.high = 1\n")
        .expect("missing-parameter", &["no file gives", "`limits.low`"]);
    // Only of robots that have this head, and nobody knows which those are.
    robot("", "limits.low = { unset = true }\n").robot();
    // Nothing but `unset = true` takes away.
    robot("a = { unset = false }\n", "").expect("mistyped-parameter", &["`a` is a table"]);
    robot("b = { unset = true }\n", "").expect("unknown-parameter", &["`b`"]);
}

#[test]
fn a_file_that_is_a_layer_of_no_robot_is_told() {
    for (file, help) in [
        ("haed.P1.toml", "did you mean `head.P1.toml`?"),
        ("field/defaults.toml", "did you mean `default.toml`?"),
        ("wrist.P1.toml", "add `\"wrist\"` to the `identities`"),
        ("notes.toml", "or call it `default.toml`"),
    ] {
        robot("a: Parameter<f32, \"a\">,", NAO)
            .file("parameters/default.toml", "a = 1\n")
            .file("parameters/field/default.toml", "")
            .file(&format!("parameters/{file}"), "a = 1\n")
            .expect("unused-file", &[file, "is read for no robot", help]);
    }
}
