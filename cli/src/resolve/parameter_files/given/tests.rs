//! Values of one robot with all four kinds of layers.

use super::{Answer, Asked, Given, Value, comment_in, given};
use crate::diagnostics::Diagnostics;
use crate::manifest;
use crate::scan;
use crate::scan::fixture::{Fixture, Node, cycler};
use crate::workspace::Workspace;

const TYPES: &str = "
    #[derive(Deserialize)]
    pub struct Filter {
        /// In s.
        #[reflect(unit = \"s\", range = 0.0..)]
        pub time: f32,
        pub mode: Mode,
    }
    #[derive(Deserialize)]
    pub enum Mode { Off, On { gain: f32 } }
";

fn fixture() -> Fixture {
    let manifest = format!(
        "identities = [\"body\", \"head\"]\n{}",
        cycler("Control", "real-time", "", &[], &["a"])
    );
    let node = Node {
        head: "use types::*;",
        cycle: "filter: Parameter<filter::Filter, \"filter\">,\nhardware: HardwareInterface,",
        asks: "hardware::Motors",
        ..Node::default()
    };
    Fixture::new(&manifest)
        .node("a", node)
        .file("crates/types/src/lib.rs", "pub mod filter;")
        .file("crates/types/src/filter.rs", TYPES)
        .file(
            "parameters/default.toml",
            "[filter]\ntime = 0.1  # s, measured\nmode = { On = { gain = 1 } }\n",
        )
        .file("parameters/field/default.toml", "filter.time = 0.2")
        .file("parameters/field/head.P1.toml", "filter.time = 0.5")
        .file("parameters/head.P1.toml", "filter.time = 0.4")
        .file("parameters/body.B1.toml", "filter.time = 0.3")
}

fn answer(fixture: &Fixture, below: &[&str]) -> Option<Answer> {
    let workspace = Workspace::in_memory(fixture.files());
    let mut diagnostics = Diagnostics::new();
    let manifest = manifest::load(&workspace, &mut diagnostics).expect("it is right");
    let sources = scan::scan(&workspace, &manifest, &mut diagnostics).expect("they are right");
    let asked = Asked {
        declared: "filter",
        data: "types::filter::Filter",
        node: "nodes::a",
        below,
        hints: None,
    };
    given(&workspace, &manifest, &sources, asked)
}

fn values(below: &[&str]) -> Vec<Value> {
    let answer = answer(&fixture(), below);
    answer.map(|answer| answer.values).unwrap_or_default()
}

#[test]
fn a_hash_in_quotes_is_no_comment() {
    for (line, comment) in [
        (", colour = \"#fff\" }", None),
        (", colour = '#fff' } # white", Some(" white")),
        (r##", text = "\"#" } # said"##, Some(" said")),
        (" # it's \"so\"", Some(" it's \"so\"")),
        ("", None),
    ] {
        assert_eq!(comment_in(line), comment, "{line}");
    }
}

#[test]
fn layers_stand_in_the_order_in_which_they_are_merged() {
    let values = values(&["time"]);
    let [time] = values.as_slice() else {
        panic!("{values:#?}")
    };
    assert_eq!(time.path, "filter.time");
    assert_eq!(time.data.as_deref(), Some("f32"));
    assert_eq!(time.docs.as_deref(), Some("In s."));
    assert_eq!(time.unit.as_deref(), Some("s"));
    assert_eq!(time.range.as_deref(), Some("0.."));
    assert_eq!(time.given[0].comment.as_deref(), Some("s, measured"));
    let line = |given: &Given| format!("{}:{} {}", given.file, given.line, given.value);
    let lines: Vec<String> = time.given.iter().map(line).collect();
    assert_eq!(
        lines,
        [
            "parameters/default.toml:2 0.1",
            "parameters/field/default.toml:1 0.2",
            "parameters/body.B1.toml:1 0.3",
            "parameters/head.P1.toml:1 0.4",
            "parameters/field/head.P1.toml:1 0.5",
        ]
    );
}

#[test]
fn a_struct_is_merged_field_by_field_and_an_enum_is_not() {
    let values = values(&[]);
    let paths: Vec<&str> = values.iter().map(|value| value.path.as_str()).collect();
    assert_eq!(paths, ["filter.time", "filter.mode"]);
    assert_eq!(values[1].given[0].value, "{ On = { gain = 1 } }");
}

#[test]
fn a_field_that_there_is_not_has_no_values() {
    assert_eq!(answer(&fixture(), &["tiem"]), None);
}

#[test]
fn fields_are_called_as_files_call_them() {
    let types = "
        #[derive(Deserialize)]
        #[serde(rename_all = \"kebab-case\")]
        pub struct Filter {
            /// In s.
            pub half_life: f32,
            #[serde(rename = \"on\", alias = \"enabled\")]
            pub is_on: bool,
            #[serde(skip)]
            pub count: u8,
        }
    ";
    let robot = fixture()
        .file("crates/types/src/filter.rs", types)
        .file(
            "parameters/default.toml",
            "[filter]\nhalf-life = 0.1\nenabled = true\n",
        )
        .file("parameters/field/default.toml", "filter.enabled = false")
        .file("parameters/field/head.P1.toml", "")
        .file("parameters/head.P1.toml", "")
        .file("parameters/body.B1.toml", "");
    // The checks of files know them by the same names.
    assert_eq!(robot.answer().codes, Vec::<&str>::new());
    let whole = answer(&robot, &[]).expect("it is a parameter").values;
    let paths: Vec<&str> = whole.iter().map(|value| value.path.as_str()).collect();
    assert_eq!(paths, ["filter.half-life", "filter.on"]);
    let given = |value: &Value| {
        let given = value.given.iter().map(|given| given.value.clone());
        given.collect::<Vec<_>>()
    };
    assert_eq!(given(&whole[0]), ["0.1"]);
    assert_eq!(given(&whole[1]), ["true", "false"]);
    assert_eq!(whole[0].docs.as_deref(), Some("In s."));
    // Whoever asks may use the name of the files or that of the code.
    for name in ["half-life", "half_life"] {
        let answer = answer(&robot, &[name]).expect("it is a field");
        assert_eq!(answer.fields, ["half_life"]);
        assert_eq!(answer.values, whole[..1]);
    }
    for name in ["on", "is_on", "enabled"] {
        let answer = answer(&robot, &[name]).expect("it is a field");
        assert_eq!(
            (answer.fields, answer.values.as_slice()),
            (vec!["is_on".to_owned()], &whole[1..])
        );
    }
    assert_eq!(answer(&robot, &["count"]), None);
    // A name that only the code uses is a mistake in a file.
    let misspelt = robot.file("parameters/field/default.toml", "filter.half_life = 1");
    assert_eq!(misspelt.answer().codes, ["unknown-parameter"]);
}

#[test]
fn every_kind_of_robot_has_one_winner() {
    let winners = values(&["time"])[0].winners();
    let text = |index: usize| {
        let winner = &winners[index];
        let identities = winner.identities.iter().map(|it| it.id.as_str());
        (
            winner.location.as_deref(),
            identities.collect::<Vec<_>>(),
            winner.value.as_str(),
        )
    };
    let all: Vec<_> = (0..winners.len()).map(text).collect();
    assert_eq!(
        all,
        [
            (None, vec![], "0.1"),
            (None, vec!["P1"], "0.4"),
            (None, vec!["B1"], "0.3"),
            (None, vec!["B1", "P1"], "0.4"),
            (Some("field"), vec![], "0.2"),
            (Some("field"), vec!["P1"], "0.5"),
            (Some("field"), vec!["B1"], "0.3"),
            (Some("field"), vec!["B1", "P1"], "0.5"),
        ]
    );
}

#[test]
fn a_value_that_is_taken_away_is_told_for_everything_below_it() {
    let robot = fixture().file(
        "parameters/field/default.toml",
        "filter = { unset = true }  # never here\n",
    );
    let answer = answer(&robot, &["time"]).expect("it is a parameter");
    let given = &answer.values[0].given[1];
    assert_eq!(given.value, "{ unset = true }");
    assert_eq!(given.comment.as_deref(), Some("never here"));
}
