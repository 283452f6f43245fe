//! What `check` says of values in parameter files, against what the robot's program says of them: for every type that
//! hulkgen can see, and every value of a long list.

#![expect(
    clippy::disallowed_types,
    reason = "the type of a parameter may be a hash map"
)]

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::net::{IpAddr, SocketAddrV4};
use std::num::{NonZero, NonZeroI16, NonZeroU8};
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

use hulkgen::diagnostics::{Diagnostics, Severity};
use hulkgen::pipeline;
use hulkgen::workspace::Workspace;
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// Types that rustc compiles here, and their text for hulkgen.
macro_rules! both {
    ($($item:item)*) => {
        $($item)*
        const TYPES: &str = concat!($(stringify!($item), "\n"),*);
    };
}

both! {
    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct Limits {
        pub low: f32,
        pub high: Option<u8>,
        #[serde(default, rename = "a", alias = "b")]
        pub step: u8,
        #[serde(default)]
        pub inner: Option<Box<Limits>>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(rename_all = "snake_case", deny_unknown_fields)]
    pub enum Mode {
        Off,
        #[serde(alias = "held")]
        HoldStill,
        Fixed(f32),
        Pair(u8, u8),
        #[serde(rename_all = "UPPERCASE")]
        Ramp { from: f32, to: Option<f32> },
    }

    #[derive(Debug, Deserialize)]
    pub enum Either<T> {
        Left(T),
        Right(Vec<T>),
    }
}

/// Whether the robot's program takes `a = value`.
fn is_taken<T: DeserializeOwned>(value: &str) -> bool {
    #[derive(Deserialize)]
    struct Parameters<T> {
        #[serde(rename = "a")]
        _a: T,
    }
    let text = format!("a = {value}\n");
    framework::parameters::from_text::<Parameters<T>>("default.toml", &text).is_ok()
}

/// Errors of `check` where a node reads the parameter `a` of this type; `true`: the type is opaque.
fn errors(data: &str, files: &[(&str, &str)]) -> (Vec<String>, bool) {
    let node = format!(
        "use framework::*;\nuse serde::{{Deserialize, Serialize}};\n\
         use std::collections::{{BTreeMap, BTreeSet, HashMap}}; use std::net::{{IpAddr, SocketAddrV4}};\n\
         use std::num::{{NonZero, NonZeroI16, NonZeroU8}}; use std::ops::Range; use std::path::PathBuf; use std::time::Duration;\n\
         use crate::types::*;\n\
         #[derive(Deserialize, Serialize)]\npub struct Node;\n\
         #[context]\npub struct CreationContext {{}}\n\
         #[context]\npub struct CycleContext {{ a: Parameter<{data}, \"a\"> }}\n\
         #[context]\npub struct MainOutputs {{}}\n\
         impl Node {{\npub fn new(_: CreationContext) -> Result<Self> {{ Ok(Self) }}\n\
         pub fn cycle(&mut self, _: CycleContext) -> Result<MainOutputs> {{ Ok(MainOutputs {{}}) }}\n}}\n"
    );
    let manifest = "[robot]\nname = \"test\"\ngenerated = \"generated\"\nparameters = \"parameters\"\nidentities = [\"head\"]\n\
                    [[cycler]]\nname = \"Control\"\nkind = \"real-time\"\nnodes = [\"nodes::node\"]\n";
    let package = "[package]\nname = \"nodes\"\n[dependencies]\nframework = \"1\"\nnalgebra = \"0.35\"\nserde = \"1\"\n";
    let types = format!("use serde::Deserialize;\n{TYPES}");
    let mut all = vec![
        ("Cargo.toml", "[workspace]\nmembers = [\"nodes\"]\n"),
        ("hulk.toml", manifest),
        ("nodes/Cargo.toml", package),
        ("nodes/src/lib.rs", "pub mod node;\npub mod types;\n"),
        ("nodes/src/node.rs", &node),
        ("nodes/src/types.rs", &types),
    ];
    all.extend(files);
    let mut found = Diagnostics::new();
    let understood = pipeline::understand(&Workspace::in_memory(all), &mut found);
    let understood = understood.expect("only parameter files are wrong");
    let sorted = found.sorted();
    let errors = sorted
        .iter()
        .filter(|one| one.severity() == Severity::Error);
    let told = errors.map(|one| format!("{}: {}", one.code.name(), one.message));
    (told.collect(), !understood.unchecked.opaque.is_empty())
}

const VALUES: &[&str] = &[
    "0",
    "1",
    "-1",
    "255",
    "256",
    "70000",
    "1.5",
    "nan",
    "true",
    "\"\"",
    "\"x\"",
    "\"text\"",
    "\"10.0.0.1\"",
    "\"10.0.0\"",
    "\"::1\"",
    "\"10.0.0.1:80\"",
    "\"off\"",
    "\"Off\"",
    "\"held\"",
    "\"hold_still\"",
    "\"fixed\"",
    "\"pair\"",
    "[]",
    "[1]",
    "[1, 2]",
    "[1, 2, 3]",
    "[1, 2, 3, 4]",
    "[1, 2, 3, 4, 5, 6, 7, 8, 9]",
    "[1, -2]",
    "[\"x\"]",
    "[\"off\", \"off\"]",
    "[1, \"x\"]",
    "[[1, 2], [3, 4]]",
    "[[1, 0], [1, 2]]",
    "[{ low = 1 }]",
    "[{ high = 1 }]",
    "[{ low = 1, high = 2, a = 3 }]",
    "[{ low = 1, a = 1, b = 2 }]",
    "[{ low = 1, inner = { low = 1 } }]",
    "[{ low = 1, inner = { high = 1 } }]",
    "{}",
    "{ x = 1 }",
    "{ x = 300 }",
    "{ x = \"x\" }",
    "{ x = [1, 2] }",
    "{ x = { low = 1 } }",
    "{ x = { high = 1 } }",
    "{ low = 1 }",
    "{ low = 1, high = 1 }",
    "{ low = 1, hgih = 1 }",
    "{ high = 1 }",
    "{ low = 1, a = 1 }",
    "{ low = 1, b = 1 }",
    "{ low = 1, a = 1, b = 1 }",
    "{ low = 1, inner = { low = 2 } }",
    "{ low = 1, inner = { b = 2 } }",
    "{ low = 1, inner = 2 }",
    "{ secs = 1, nanos = 2 }",
    "{ secs = 1 }",
    "{ secs = -1, nanos = 0 }",
    "{ secs = 1, nanos = 2, millis = 3 }",
    "{ start = 1, end = 2 }",
    "{ start = 1, end = 300 }",
    "{ start = 1 }",
    "{ begin = 1, end = 2 }",
    "{ rotation = [1, 0], translation = [1, 2] }",
    "{ rotation = [1, 0, 0, 0], translation = [1, 2, 3] }",
    "{ rotation = [1, 0], translation = [1, 2, 3] }",
    "{ translation = [1, 2] }",
    "{ isometry = { rotation = [1, 0], translation = [1, 2] }, scaling = 2 }",
    "{ isometry = 1, scaling = 2 }",
    "{ off = 1 }",
    "{ off = {} }",
    "{ fixed = 1 }",
    "{ fixed = \"x\" }",
    "{ pair = [1, 2] }",
    "{ pair = [1] }",
    "{ pair = 1 }",
    "{ ramp = { FROM = 1 } }",
    "{ ramp = { from = 1 } }",
    "{ ramp = { FROM = 1, TO = 2 } }",
    "{ ramp = { TO = 2 } }",
    "{ ramp = { FROM = 1, OVER = 2 } }",
    "{ fixed = 1, off = 2 }",
    "{ Left = 1 }",
    "{ Left = \"x\" }",
    "{ Right = [1, 2] }",
    "{ Right = 1 }",
    "{ Middle = 1 }",
];

/// Whatever the two do not agree about is a hole or a false alarm.
fn compare<T: DeserializeOwned>(data: &str, wrong: &mut Vec<String>) {
    let (mut taken, mut refused) = (0, 0);
    for value in VALUES {
        let text = format!("a = {value}\n");
        let (told, opaque) = errors(data, &[("parameters/default.toml", &text)]);
        assert!(!opaque, "`{data}` can be seen");
        match is_taken::<T>(value) {
            true => taken += 1,
            false => refused += 1,
        }
        // Serde reads structs from arrays, too, by the order of the fields; files name them.
        let by_position = |one: &String| one.ends_with("is an array, not a table");
        let is_refused = !told.is_empty();
        let is_by_position = is_refused && told.iter().all(by_position);
        if is_taken::<T>(value) == is_refused && !is_by_position {
            wrong.push(format!("{data} = {value}: {told:?}"));
        }
    }
    assert!(
        taken > 0 && refused > 0,
        "`{data}`: {taken} values are right, {refused} wrong"
    );
}

macro_rules! compare_all {
    ($($data:ty),* $(,)?) => {{
        let mut wrong = Vec::new();
        $(compare::<$data>(stringify!($data), &mut wrong);)*
        assert!(wrong.is_empty(), "{} of check and robot disagree:\n{}", wrong.len(), wrong.join("\n"));
    }};
}

#[test]
fn check_and_the_robot_agree_about_primitives_and_what_is_made_of_them() {
    compare_all!(
        bool,
        u8,
        i16,
        u64,
        f32,
        char,
        String,
        Option<u8>,
        Box<u8>,
        Option<Box<f32>>,
        Vec<u8>,
        [u8; 2],
        [[u8; 2]; 2],
        (u8, f32),
        (u8, String),
        Vec<Option<u8>>,
        Vec<(u8, u8)>,
    );
}

#[test]
fn check_and_the_robot_agree_about_types_of_std() {
    compare_all!(
        Duration, Option<Duration>, PathBuf, NonZeroU8, NonZeroI16, NonZero<u8>, Range<u8>, Range<f32>,
        IpAddr, SocketAddrV4, BTreeMap<String, u8>, HashMap<String, Limits>, BTreeMap<String, [u8; 2]>,
        BTreeSet<u8>, Vec<Range<u8>>,
    );
}

#[test]
fn check_and_the_robot_agree_about_nalgebra() {
    compare_all!(
        nalgebra::Point2<f32>,
        nalgebra::Point3<u8>,
        nalgebra::Vector2<f32>,
        nalgebra::SVector<f32, 3>,
        nalgebra::Matrix2<f32>,
        nalgebra::SMatrix<f32, 3, 3>,
        nalgebra::Rotation2<f32>,
        nalgebra::Translation3<f32>,
        nalgebra::UnitQuaternion<f32>,
        nalgebra::UnitComplex<f32>,
        nalgebra::UnitVector3<f32>,
        nalgebra::Isometry2<f32>,
        nalgebra::Isometry3<f32>,
        nalgebra::Similarity2<f32>,
        Option<nalgebra::Point2<f32>>,
        Vec<nalgebra::Point2<f32>>,
    );
}

#[test]
fn check_and_the_robot_agree_about_the_workspaces_types() {
    compare_all!(
        Limits, Vec<Limits>, Mode, Vec<Mode>, [Mode; 2], Either<u8>, BTreeMap<String, Mode>,
    );
}

#[test]
fn what_serde_alone_knows_is_not_judged() {
    for data in [
        "BTreeMap<u8, u8>",
        "nalgebra::DVector<f32>",
        "nalgebra::Unseen",
        "Either<nalgebra::Unseen>",
        "(u8, nalgebra::DMatrix<f32>)",
        "std::sync::Mutex<u8>",
    ] {
        let (told, opaque) = errors(data, &[("parameters/default.toml", "a = { any = true }\n")]);
        let is_judged = data.starts_with('(') || data.starts_with("Either");
        assert!(opaque && (is_judged || told.is_empty()), "{data}: {told:?}");
    }
}

#[test]
fn values_of_maps_may_be_completed_by_other_layers() {
    let data = "BTreeMap<String, Limits>";
    let default = ("parameters/default.toml", "a.x.low = 1\na.y.high = 2\n");
    let (told, _) = errors(data, &[default]);
    assert_eq!(
        told,
        ["missing-parameter: no file gives the parameter `a.y.low`"]
    );
    let (told, _) = errors(
        data,
        &[default, ("parameters/head.P1.toml", "a.y.low = 3\n")],
    );
    assert_eq!(told, [""; 0]);
}

#[test]
fn two_names_of_one_field_clash_only_where_one_robot_reads_both() {
    let default = ("parameters/default.toml", "a.low = 1\na.a = 2\n");
    let by_alias = "a.b = 3\n";
    let clash = "duplicate-parameter: `a.a` is given by two names";
    let (told, _) = errors("Limits", &[default, ("parameters/head.P1.toml", by_alias)]);
    assert_eq!(told, [clash]);
    let (told, _) = errors(
        "Limits",
        &[("parameters/default.toml", "a = { low = 1, a = 2, b = 3 }\n")],
    );
    assert_eq!(told, [clash]);
    let without = ("parameters/default.toml", "a.low = 1\n");
    let (one, other) = ("parameters/head.P1.toml", "parameters/head.P2.toml");
    let (told, _) = errors("Limits", &[without, (one, "a.a = 2\n"), (other, by_alias)]);
    assert_eq!(told, [""; 0], "no robot has two heads");
    let located = "parameters/field/head.P1.toml";
    let (told, _) = errors(
        "Limits",
        &[without, (one, "a.a = 2\n"), (located, by_alias)],
    );
    assert_eq!(told, [clash]);
    let (here, there) = (
        "parameters/lab/head.P1.toml",
        "parameters/field/head.P1.toml",
    );
    let (told, _) = errors("Limits", &[without, (here, "a.a = 2\n"), (there, by_alias)]);
    assert_eq!(told, [""; 0], "no robot is at two places");
}
