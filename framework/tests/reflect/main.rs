//! Values by path: reading, writing, shapes and messages.

#![expect(clippy::disallowed_types, reason = "authors may exchange hash maps")]

mod binary;
mod clients;
mod odd;
mod schema;

use std::collections::{BTreeMap, HashMap, VecDeque};
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use framework::reflect::{Content, Path, Reason, ResolvedPath, Segment, Shape, at, at_mut};
use framework::time::Timestamp;
use framework::{Given, Reflect};
use nalgebra::{
    Isometry2, Isometry3, Matrix2x3, Point2, Rotation2, Rotation3, Translation3, Unit, UnitComplex,
    UnitQuaternion, Vector2, Vector3, Vector4, Vector5,
};
use proptest::prelude::*;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// A struct with documentation.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
struct Ball {
    /// Where it is,
    /// in the ground frame.
    #[reflect(unit = "m")]
    position: Point2<f32>,
    #[reflect(unit = "m")]
    radius: f32,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
enum Motion {
    Unstiff,
    /// On the way.
    Walk {
        step: Vector2<f32>,
        turn: f32,
    },
    Kick(Ball),
    Look(f32, bool),
}

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
struct Metres(f32);

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
struct Pair(u8, bool);

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
struct Nothing;

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
struct Both<T> {
    left: T,
    right: T,
}

/// A type with everything in it.
#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
struct Everything {
    boolean: bool,
    small: i8,
    large: u64,
    single: f32,
    character: char,
    text: String,
    ball: Option<Ball>,
    nested: Option<Option<u8>>,
    motion: Motion,
    motions: Vec<Motion>,
    queue: VecDeque<u16>,
    array: [f32; 3],
    tuple: (u8, Ball, String),
    ordered: BTreeMap<String, Both<u8>>,
    hashed: HashMap<String, f32>,
    boxed: Box<Ball>,
    range: Range<f32>,
    duration: Duration,
    timestamp: Timestamp,
    metres: Metres,
    pair: Pair,
    nothing: Nothing,
    unit: (),
    feet: Both<Ball>,
    vector: Vector3<f32>,
    five: Vector5<f32>,
    matrix: Matrix2x3<f32>,
    pose: Isometry3<f32>,
    pose2: Isometry2<f32>,
    complex: UnitComplex<f32>,
    rotation: Rotation2<f32>,
    translation: Translation3<f32>,
}

fn path(text: &str) -> Path {
    text.parse()
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn read(value: &dyn Reflect, text: &str) -> Value {
    let part = at(value, &path(text)).unwrap_or_else(|error| panic!("{text}: {error}"));
    serde_json::to_value(part.as_serialize()).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn write(value: &mut dyn Reflect, text: &str, new: Value) -> Result<(), String> {
    let part = at_mut(value, &path(text)).map_err(|error| error.to_string())?;
    part.deserialize_from(&Given::from(&new))
        .map_err(|error| error.to_string())
}

fn message(value: &dyn Reflect, text: &str) -> String {
    match at(value, &path(text)) {
        Ok(_) => panic!("{text} is there"),
        Err(error) => error.to_string(),
    }
}

fn ball() -> Ball {
    Ball {
        position: Point2::new(1.0, 2.0),
        radius: 0.5,
    }
}

#[test]
fn a_path_is_shown_as_it_was_written() {
    for text in ["", "a", "a.b.c", "balls.0.position.x", "a.01", "a.größe"] {
        assert_eq!(path(text).to_string(), text);
    }
    let segments = path("a.0.01.10").segments().to_vec();
    let name = |name: &str| Segment::Field(name.into());
    assert_eq!(
        segments,
        [name("a"), Segment::Index(0), name("01"), Segment::Index(10)]
    );
    for text in [".", "a.", ".a", "a..b"] {
        let error = text.parse::<Path>().expect_err(text);
        assert!(
            error
                .to_string()
                .starts_with(&format!("`{text}` is no path")),
            "{error}"
        );
    }
}

#[test]
fn parts_of_structs_are_read_by_name() {
    let ball = ball();
    assert_eq!(
        read(&ball, ""),
        json!({"position": [1.0, 2.0], "radius": 0.5})
    );
    assert_eq!(read(&ball, "radius"), json!(0.5));
    assert_eq!(read(&ball, "position.y"), json!(2.0));
    assert_eq!(read(&ball, "position.1"), json!(2.0));
    assert_eq!(read(&Pair(3, true), "1"), json!(true));
    assert_eq!(read(&Metres(3.0), ""), json!(3.0));
    assert_eq!(
        read(
            &Both {
                left: Metres(1.0),
                right: Metres(2.0)
            },
            "right"
        ),
        json!(2.0)
    );
}

#[test]
fn of_an_enum_the_active_variant_is_seen() {
    let walk = Motion::Walk {
        step: Vector2::new(0.25, 0.0),
        turn: 1.0,
    };
    assert_eq!(read(&walk, "Walk.step.x"), json!(0.25));
    assert_eq!(read(&walk, "turn"), json!(1.0));
    assert_eq!(
        read(&walk, "Walk"),
        json!({"Walk": {"step": [0.25, 0.0], "turn": 1.0}})
    );
    assert_eq!(
        read(&Motion::Kick(ball()), "Kick"),
        json!({"position": [1.0, 2.0], "radius": 0.5})
    );
    assert_eq!(read(&Motion::Kick(ball()), "Kick.radius"), json!(0.5));
    assert_eq!(read(&Motion::Look(0.5, true), "Look.1"), json!(true));
    assert_eq!(read(&Motion::Unstiff, ""), json!("Unstiff"));
    assert_eq!(
        message(&Motion::Unstiff, "Walk"),
        "no `Walk`: the value has nothing below it"
    );
    assert_eq!(
        message(&walk, "Kick"),
        "no `Kick`: the value has `Walk`, `step`, `turn`"
    );
    assert_eq!(
        message(&Motion::Kick(ball()), "speed"),
        "no `speed`: the value has `Kick`"
    );
}

#[test]
fn options_boxes_and_arcs_stand_for_their_content() {
    assert_eq!(read(&Some(ball()), "radius"), json!(0.5));
    assert_eq!(read(&Box::new(ball()), "radius"), json!(0.5));
    assert_eq!(
        read(&Arc::new(ball()), ""),
        json!({"position": [1.0, 2.0], "radius": 0.5})
    );
    let absent = at(&None::<Ball>, &path("radius"))
        .err()
        .expect("nothing is there");
    assert!(absent.is_absent());
    let holder = Both {
        left: None,
        right: Some(ball()),
    };
    assert_eq!(
        message(&holder, "left.radius"),
        "no `radius` now: `left` is absent"
    );
    assert_eq!(
        message(&holder, "right.x"),
        "no `x`: `right` has `position`, `radius`"
    );
}

#[test]
fn writing_to_a_shared_arc_leaves_the_others_alone() {
    let mut value = Arc::new(ball());
    let other = Arc::clone(&value);
    write(&mut value, "radius", json!(2.0)).expect("it is there");
    assert_eq!((value.radius, other.radius), (2.0, 0.5));
}

#[test]
fn collections_are_read_by_index_and_key() {
    let map = BTreeMap::from([("a".to_owned(), vec![1, 2]), ("7".to_owned(), vec![])]);
    assert_eq!(read(&map, "a.1"), json!(2));
    assert_eq!(read(&map, "7"), json!([]));
    assert_eq!(message(&map, "b"), "no `b`: the value has `7`, `a`");
    assert_eq!(message(&map, "a.2"), "no `2`: `a` has `0` to `1`");
    assert_eq!(message(&map, "a.x"), "no `x`: `a` has `0` to `1`");
    assert_eq!(message(&map, "7.0"), "no `0`: `7` has nothing below it");
    assert_eq!(message(&vec![1], "1"), "no `1`: the value has `0`");
    assert_eq!(read(&(0.5..2.0), "end"), json!(2.0));
    assert_eq!(read(&(0..=3), "start"), json!(0));
    assert_eq!(read(&(1, true, 'c'), "2"), json!("c"));
}

#[test]
fn geometry_is_read_by_axis_and_index() {
    let rotation = UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3);
    let pose = Isometry3::from_parts(Translation3::new(1.0, 2.0, 3.0), rotation);
    assert_eq!(read(&pose, "translation.z"), json!(3.0));
    assert_eq!(read(&pose, "rotation.w"), json!(rotation.w));
    assert_eq!(read(&pose, "rotation.i"), read(&pose, "rotation.0"));
    assert_eq!(read(&Vector4::new(1, 2, 3, 4), "w"), json!(4));
    assert_eq!(read(&Matrix2x3::new(1, 2, 3, 4, 5, 6), "2"), json!(2));
    assert_eq!(read(&UnitComplex::new(0.0), "re"), json!(1.0));
    assert_eq!(read(&Rotation3::<f32>::identity(), "4"), json!(1.0));
    assert_eq!(
        read(&Unit::new_unchecked(Vector2::new(0.0, 1.0)), "y"),
        json!(1.0)
    );
    assert_eq!(
        message(&pose, "rotation.x"),
        "no `x`: `rotation` has `i`, `j`, `k`, `w`, `0` to `3`"
    );
    assert_eq!(
        message(&Vector5::<f32>::zeros(), "x"),
        "no `x`: the value has `0` to `4`"
    );
    assert_eq!(
        message(&Vector2::<f32>::zeros(), "z"),
        "no `z`: the value has `x`, `y`, `0` to `1`"
    );
}

#[test]
fn rotations_are_written_as_a_whole_and_stay_rotations() {
    let mut pose = Isometry3::<f64>::identity();
    let error = write(&mut pose, "rotation.w", json!(0.5)).expect_err("it would be no rotation");
    assert_eq!(
        error,
        "`w` cannot be written alone: write `rotation` as a whole"
    );
    let error = at_mut(&mut pose, &path("rotation.w"))
        .err()
        .expect("as before");
    assert_eq!(error.reason, Reason::OnlyWhole);
    write(&mut pose, "rotation", json!([1.0, 1.0, 0.0, 0.0])).expect_err("its length is not one");
    assert_eq!(pose, Isometry3::identity());
    write(&mut pose, "rotation", json!([1.0, 0.0, 0.0, 0.0])).expect("it is a rotation");
    write(&mut pose, "translation.y", json!(4.0)).expect("any translation is one");
    assert_eq!(
        read(&pose, ""),
        json!({"rotation": [1.0, 0.0, 0.0, 0.0], "translation": [0.0, 4.0, 0.0]})
    );
    let mut rotation = Rotation2::<f64>::identity();
    write(&mut rotation, "", json!([2.0, 0.0, 0.0, 1.0])).expect_err("it stretches");
    write(&mut rotation, "", json!([0.0, 1.0, -1.0, 0.0])).expect("it turns");
    let mut complex = UnitComplex::<f32>::identity();
    write(&mut complex, "", json!([0.5, 0.5])).expect_err("its length is not one");
    write(&mut complex, "", json!([0.0, 1.0])).expect("its length is one");
}

#[test]
fn a_value_that_does_not_fit_changes_nothing() {
    let mut value = Both {
        left: ball(),
        right: ball(),
    };
    for (text, new) in [
        ("left.radius", json!("wide")),
        ("left", json!({"radius": 1.0})),
        ("right.position", json!([1.0])),
        ("", json!({"left": null, "right": null})),
    ] {
        write(&mut value, text, new).expect_err(text);
        assert_eq!(
            value,
            Both {
                left: ball(),
                right: ball()
            },
            "{text}"
        );
    }
}

#[test]
fn names_are_those_of_serde() {
    #[derive(Debug, Default, Deserialize, Reflect, Serialize)]
    #[serde(rename_all = "camelCase")]
    struct Renamed {
        ball_radius: f32,
        #[serde(rename = "Höhe")]
        height: f32,
        #[serde(rename(serialize = "out", deserialize = "out"))]
        direction: f32,
        #[serde(default, skip)]
        hidden: f32,
        #[serde(default)]
        #[reflect(skip)]
        private: f32,
        r#type: u8,
    }
    let value = Renamed::default();
    for name in ["ballRadius", "Höhe", "out", "type"] {
        read(&value, name);
    }
    let all = "`Höhe`, `ballRadius`, `out`, `type`";
    for name in [
        "ball_radius",
        "height",
        "direction",
        "hidden",
        "private",
        "r#type",
    ] {
        assert_eq!(
            message(&value, name),
            format!("no `{name}`: the value has {all}")
        );
    }
    assert_eq!((value.hidden, value.private), (0.0, 0.0));
}

#[test]
fn names_inside_of_variants_are_those_of_serde() {
    #[derive(Debug, Deserialize, Reflect, Serialize)]
    #[serde(rename_all = "snake_case", rename_all_fields = "camelCase")]
    enum Renamed {
        WalkFast {
            step_size: f32,
        },
        #[serde(rename_all = "kebab-case")]
        WalkSlowly {
            step_size: f32,
        },
        #[serde(rename = "Halt!")]
        Halt(u8),
        Part(#[serde(skip)] u8, bool, u16),
    }
    assert_eq!(
        read(&Renamed::WalkFast { step_size: 1.0 }, "walk_fast.stepSize"),
        json!(1.0)
    );
    assert_eq!(
        read(
            &Renamed::WalkSlowly { step_size: 1.0 },
            "walk_slowly.step-size"
        ),
        json!(1.0)
    );
    assert_eq!(read(&Renamed::Halt(3), "Halt!"), json!(3));
    let part = Renamed::Part(1, true, 2);
    assert_eq!(read(&part, ""), json!({"part": [true, 2]}));
    assert_eq!(read(&part, "part.1"), json!(2));
}

#[test]
fn flattened_transparent_and_foreign_types_look_as_in_their_serde_form() {
    #[derive(Debug, Deserialize, Reflect, Serialize)]
    struct Outer {
        own: u8,
        #[serde(flatten)]
        inner: Ball,
        #[serde(flatten)]
        rest: BTreeMap<String, u8>,
    }
    #[derive(Debug, Deserialize, Reflect, Serialize)]
    #[serde(transparent)]
    struct Wrapped {
        ball: Ball,
    }
    #[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
    #[serde(from = "String", into = "String")]
    struct Foreign {
        name: String,
    }
    impl From<String> for Foreign {
        fn from(name: String) -> Self {
            Self { name }
        }
    }
    impl From<Foreign> for String {
        fn from(foreign: Foreign) -> Self {
            foreign.name
        }
    }
    let mut outer = Outer {
        own: 1,
        inner: ball(),
        rest: BTreeMap::from([("more".to_owned(), 7)]),
    };
    assert_eq!(read(&outer, "radius"), json!(0.5));
    assert_eq!(read(&outer, "more"), json!(7));
    write(&mut outer, "more", json!(8)).expect("it is there");
    assert_eq!(outer.rest["more"], 8);
    let all = "`more`, `own`, `position`, `radius`";
    assert_eq!(
        message(&outer, "inner"),
        format!("no `inner`: the value has {all}")
    );
    let wrapped = Wrapped { ball: ball() };
    assert_eq!(read(&wrapped, "radius"), json!(0.5));
    assert_eq!(
        message(&wrapped, "ball"),
        "no `ball`: the value has `position`, `radius`"
    );
    let foreign = Foreign { name: "a".into() };
    assert_eq!(read(&foreign, ""), json!("a"));
    assert_eq!(
        message(&foreign, "name"),
        "no `name`: the value has nothing below it"
    );
    Foreign::shape();
}

#[test]
fn tagged_enums_are_read_as_their_serde_form_shows_them() {
    #[derive(Debug, Deserialize, Reflect, Serialize)]
    #[serde(
        tag = "kind",
        rename_all = "snake_case",
        bound = "",
        deny_unknown_fields
    )]
    enum Tagged {
        Walk {
            #[serde(alias = "velocity", default)]
            speed: f32,
        },
        Kick(Ball),
    }
    let mut walk = Tagged::Walk { speed: 1.0 };
    assert_eq!(read(&walk, ""), json!({"kind": "walk", "speed": 1.0}));
    write(&mut walk, "speed", json!(2.0)).expect("it is there");
    assert_eq!(read(&walk, "walk.speed"), json!(2.0));
    assert_eq!(read(&Tagged::Kick(ball()), "radius"), json!(0.5));
}

#[test]
fn only_what_is_named_is_serialised() {
    #[derive(Deserialize, Reflect)]
    struct Costly;
    impl Serialize for Costly {
        fn serialize<S: serde::Serializer>(&self, _: S) -> Result<S::Ok, S::Error> {
            panic!("nobody asked for it")
        }
    }
    #[derive(Deserialize, Reflect, Serialize)]
    struct Holder {
        costly: Costly,
        cheap: u8,
    }
    assert_eq!(
        read(
            &Holder {
                costly: Costly,
                cheap: 3
            },
            "cheap"
        ),
        json!(3)
    );
}

#[test]
fn a_shape_tells_names_documentation_and_units() {
    let shape = serde_json::to_value(Ball::shape()).expect("shapes are plain");
    let position = &shape["content"]["struct"][0];
    assert_eq!(position["name"], "position");
    assert_eq!(position["docs"], "Where it is,\nin the ground frame.");
    assert_eq!(position["unit"], "m");
    assert_eq!(
        position["shape"]["content"]["list"],
        json!({"item": {"type_name": "f32", "content": {"leaf": {"float": {"bits": 32}}}}, "length": 2, "names": ["x", "y"]})
    );
    let motion = serde_json::to_value(Motion::shape()).expect("shapes are plain");
    let variants = &motion["content"]["enum"];
    assert_eq!(variants[0], json!({"name": "Unstiff", "content": "unit"}));
    assert_eq!(variants[1]["docs"], "On the way.");
    assert_eq!(
        variants[1]["content"]["fields"]["struct"][1]["name"],
        "turn"
    );
    assert_eq!(
        variants[2]["content"]["value"]["type_name"],
        Ball::shape().type_name
    );
    assert!(Ball::shape().type_name.ends_with("::Ball"));
}

#[test]
fn a_shape_knows_paths_that_no_value_has_yet() {
    let shape = Everything::shape();
    for text in [
        "ball.position.x",
        "motion.Walk.step.y",
        "motion.Kick.radius",
        "motions.9.Look.1",
        "ordered.any.left",
        "array.2",
        "tuple.1.radius",
        "pose.rotation.k",
        "matrix.5",
        "metres",
        "range.end",
    ] {
        shape
            .at(&path(text))
            .unwrap_or_else(|error| panic!("{text}: {error}"));
    }
    for (text, told) in [
        (
            "ball.colour",
            "no `colour`: `ball` has `position`, `radius`",
        ),
        (
            "motion.Fly",
            "no `Fly`: `motion` has `Kick`, `Look`, `Walk`",
        ),
        ("array.3", "no `3`: `array` has `0` to `2`"),
        (
            "motion.Unstiff",
            "no `Unstiff`: `motion` has `Kick`, `Look`, `Walk`",
        ),
        (
            "motion.Walk.radius",
            "no `radius`: `motion.Walk` has `step`, `turn`",
        ),
    ] {
        assert_eq!(shape.at(&path(text)).expect_err(text).to_string(), told);
    }
    let walk = shape.at(&path("motion.Walk")).expect("is a variant");
    assert_eq!(walk.type_name, Motion::shape().type_name);
}

/// Names of variants are names of what is in others.
#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
enum Outer {
    Idle,
    Walk { fast: bool },
    Kick(u32),
    Other(Inner),
    Moving(Motion),
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
enum Inner {
    Idle { since: f32 },
    Walk { step: Ball },
    Kick { radius: f32 },
    Twice(Box<Outer>),
}

/// Values of every variant, so deep.
fn outers(depth: usize) -> Vec<Outer> {
    let deeper = match depth {
        0 => Vec::new(),
        depth => outers(depth - 1),
    };
    let deeper = deeper
        .into_iter()
        .map(|outer| Inner::Twice(Box::new(outer)));
    let flat = [
        Inner::Idle { since: 0.5 },
        Inner::Walk { step: ball() },
        Inner::Kick { radius: 0.5 },
    ];
    let walk = Motion::Walk {
        step: Vector2::new(1.0, 2.0),
        turn: 0.5,
    };
    let inner = flat.into_iter().chain(deeper).map(Outer::Other);
    let outer = [
        Outer::Idle,
        Outer::Walk { fast: true },
        Outer::Kick(3),
        Outer::Moving(Motion::Kick(ball())),
        Outer::Moving(walk),
    ];
    inner.chain(outer).collect()
}

#[test]
fn a_shape_has_every_path_that_some_value_has_and_no_other() {
    let (values, shape) = (outers(4), Outer::shape());
    let names = [
        "Walk", "fast", "Kick", "Other", "Moving", "Idle", "since", "step", "radius", "Twice",
    ];
    let longer = |paths: &[String]| -> Vec<String> {
        let below = |path: &String| names.map(|name| format!("{path}.{name}"));
        paths.iter().flat_map(below).collect()
    };
    let one = names.map(str::to_owned);
    let two = longer(&one);
    let three = longer(&two);
    let mut found = 0;
    for text in one.iter().chain(&two).chain(&three) {
        let is_there = |value: &Outer| at(value, &path(text)).is_ok();
        let is_somewhere = values.iter().any(is_there);
        found += usize::from(is_somewhere);
        assert_eq!(shape.at(&path(text)).is_ok(), is_somewhere, "{text}");
    }
    assert!((50..1000).contains(&found), "{found}");
    let inside = |text: &str| shape.inside(&path(text)).expect("is there");
    assert!(matches!(
        &inside("Moving")[..],
        [Shape {
            content: Content::Enum(_),
            ..
        }]
    ));
    // Of the walk itself, of the one inside, and of the motion's.
    assert_eq!(inside("Walk").len(), 3);
    assert!(
        inside("Walk")
            .iter()
            .all(|fields| matches!(fields.content, Content::Struct(_)))
    );
    let error = shape.at(&path("Walk.x")).expect_err("nothing has it");
    assert_eq!(
        error.to_string(),
        "no `x`: `Walk` has `fast`, `step`, `turn`"
    );
}

/// An option of itself and nothing else.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
struct Nested(Option<Box<Nested>>);

#[test]
fn a_type_that_is_an_option_of_itself_has_an_end() {
    let shape = Nested::shape();
    assert!(shape.opened().is_none());
    let error = shape.at(&path("x")).expect_err("nothing has it");
    assert_eq!(error.to_string(), "no `x`: the value has nothing below it");
    assert!(ResolvedPath::new(&shape, &path("x")).is_err());
    assert!(Both::<Nested>::shape().at(&path("left.x")).is_err());
}

#[test]
fn a_resolved_path_follows_what_a_value_is_now() {
    let resolved = |text: &str| {
        ResolvedPath::new(&Both::<Option<Motion>>::shape(), &path(text))
            .unwrap_or_else(|error| panic!("{text}: {error}"))
    };
    let mut value = Both {
        left: None,
        right: Some(Motion::Kick(ball())),
    };
    let json = |part: Option<&dyn Reflect>| part.map(|part| read(part, ""));
    let [left, right, turn] = ["left.Kick.radius", "right.Kick.radius", "right.turn"].map(resolved);
    assert_eq!(json(left.find(&value)), None);
    assert_eq!(json(right.find(&value)), Some(json!(0.5)));
    assert_eq!(json(turn.find(&value)), None);
    value.right = Some(Motion::Walk {
        step: Vector2::zeros(),
        turn: 0.25,
    });
    assert_eq!(json(right.find(&value)), None);
    assert_eq!(json(turn.find(&value)), Some(json!(0.25)));
    let unknown = ResolvedPath::new(&Ball::shape(), &path("position.q"));
    assert_eq!(
        unknown.expect_err("there is none").to_string(),
        "no `q`: `position` has `x`, `y`, `0` to `1`"
    );
    // No text stands for a place.
    at(&ball(), &path("0")).err().expect("it has names only");
}

#[test]
fn a_type_inside_of_itself_has_a_shape() {
    #[derive(Deserialize, Reflect, Serialize)]
    struct Tree {
        name: String,
        branches: Vec<Tree>,
        parent: Option<Box<Tree>>,
    }
    let shape = Tree::shape();
    shape
        .at(&path("branches.0.branches.1.parent.name"))
        .expect("it goes on and on");
    shape
        .at(&path("branches.0.leaf"))
        .expect_err("it has no such field");
    serde_json::to_value(&shape).expect("it ends");
    let twig = Tree {
        name: "b".into(),
        branches: vec![],
        parent: None,
    };
    let tree = Tree {
        name: "a".into(),
        branches: vec![twig],
        parent: None,
    };
    assert_eq!(read(&tree, "branches.0.name"), json!("b"));
}

/// Whether a JSON pointer of that path leads to the same value.
fn pointer(path: &[String]) -> String {
    path.iter().map(|part| format!("/{part}")).collect()
}

/// All paths of a value, the whole first.
fn paths(value: &Value, prefix: &[String], found: &mut Vec<Vec<String>>) {
    found.push(prefix.to_vec());
    let mut below = |name: String, part: &Value| {
        let mut longer = prefix.to_vec();
        longer.push(name);
        paths(part, &longer, found);
    };
    match value {
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                below(index.to_string(), item);
            }
        }
        Value::Object(fields) => {
            for (name, field) in fields {
                below(name.clone(), field);
            }
        }
        _ => {}
    }
}

fn number() -> impl Strategy<Value = f32> {
    (-1000..1000_i16).prop_map(|number| f32::from(number) / 8.0)
}

fn balls() -> impl Strategy<Value = Ball> {
    (number(), number(), number()).prop_map(|(x, y, radius)| Ball {
        position: Point2::new(x, y),
        radius,
    })
}

fn motions() -> impl Strategy<Value = Motion> {
    prop_oneof![
        Just(Motion::Unstiff),
        (number(), number(), number()).prop_map(|(x, y, turn)| Motion::Walk {
            step: Vector2::new(x, y),
            turn
        }),
        balls().prop_map(Motion::Kick),
        (number(), any::<bool>()).prop_map(|(angle, fast)| Motion::Look(angle, fast)),
    ]
}

fn key() -> impl Strategy<Value = String> {
    "[a-z_]{1,3}|[1-9][0-9]?"
}

fn everything() -> impl Strategy<Value = Everything> {
    let numbers = prop::array::uniform9(number());
    let lists = (
        prop::collection::vec(motions(), 0..4),
        prop::collection::vec_deque(any::<u16>(), 0..4),
        prop::collection::btree_map(key(), (any::<u8>(), any::<u8>()), 0..4),
        prop::collection::hash_map(key(), number(), 0..4),
    );
    let plain = (
        any::<bool>(),
        any::<i8>(),
        any::<u64>(),
        any::<char>(),
        ".*",
        any::<Option<u8>>(),
    );
    let parts = (prop::option::of(balls()), motions(), balls(), any::<u32>());
    (numbers, lists, plain, parts).prop_map(|(n, lists, plain, (ball, motion, other, time))| {
        let rotation = UnitQuaternion::from_euler_angles(n[0], n[1], n[2]);
        let translation = Translation3::new(n[3], n[4], n[5]);
        Everything {
            boolean: plain.0,
            small: plain.1,
            large: plain.2,
            single: n[0],
            character: plain.3,
            text: plain.4.clone(),
            ball,
            nested: plain.5.map(Some),
            motion,
            motions: lists.0,
            queue: lists.1,
            array: [n[0], n[1], n[2]],
            tuple: (7, other.clone(), plain.4),
            ordered: lists
                .2
                .into_iter()
                .map(|(key, (left, right))| (key, Both { left, right }))
                .collect(),
            hashed: lists.3,
            boxed: Box::new(other.clone()),
            range: n[0]..n[1],
            duration: Duration::from_micros(u64::from(time)),
            timestamp: Timestamp::from_nanos(u64::from(time)),
            metres: Metres(n[6]),
            pair: Pair(plain.5.unwrap_or(0), plain.0),
            nothing: Nothing,
            unit: (),
            feet: Both {
                left: other.clone(),
                right: other,
            },
            vector: Vector3::new(n[0], n[1], n[2]),
            five: Vector5::new(n[0], n[1], n[2], n[3], n[4]),
            matrix: Matrix2x3::new(n[0], n[1], n[2], n[3], n[4], n[5]),
            pose: Isometry3::from_parts(translation, rotation),
            pose2: Isometry2::new(Vector2::new(n[0], n[1]), n[2]),
            complex: UnitComplex::new(n[3]),
            rotation: Rotation2::new(n[4]),
            translation,
        }
    })
}

/// Paths below which the serde form has parts that are no values of their own.
fn is_within_leaf(path: &[String]) -> bool {
    path.len() > 1 && path[0] == "duration"
}

proptest! {
    #[test]
    fn what_is_given_as_json_is_read_as_json_is(value in odd::odd()) {
        let json = serde_json::to_value(&value).expect("it has a serde form");
        let given = Given::from(&json).read::<odd::Odd>();
        let given = given.map_err(|error| TestCaseError::fail(error.to_string()))?;
        let read: odd::Odd = serde_json::from_value(json).expect("it was just written");
        prop_assert_eq!(given, read);
    }

    #[test]
    fn every_part_of_the_serde_form_is_found(value in everything()) {
        let json = serde_json::to_value(&value).expect("it has a serde form");
        let mut all = Vec::new();
        paths(&json, &[], &mut all);
        for parts in all.iter().filter(|parts| !is_within_leaf(parts)) {
            let expected = json.pointer(&pointer(parts)).expect("it was found there");
            let text = parts.join(".");
            let found = read(&value, &text);
            // A variant with several fields is no value of its own: its name leads to the enum.
            let variant = parts.last().filter(|last| *last == "Walk" || *last == "Look");
            match variant {
                Some(variant) => prop_assert_eq!(&found[variant.as_str()], expected, "{}", text),
                None => prop_assert_eq!(&found, expected, "{}", text),
            }
            let resolved = ResolvedPath::new(&Everything::shape(), &path(&text));
            let resolved = resolved.unwrap_or_else(|error| panic!("{text}: {error}"));
            let part = resolved.find(&value).expect("it is there");
            prop_assert_eq!(read(part, ""), found, "{}", text);
        }
    }

    #[test]
    fn what_is_not_in_the_serde_form_is_not_found(value in everything(), parts in prop::collection::vec(prop_oneof![key(), Just("ball".to_owned()), Just("pose".to_owned()), Just("motions".to_owned())], 1..4)) {
        let json = serde_json::to_value(&value).expect("it has a serde form");
        let text = parts.join(".");
        // Axes have names besides their indices, and fields of the active variant are found without its name.
        let other_word = |part: &String| ["x", "y", "z", "w", "i", "j", "k"].contains(&part.as_str());
        if json.pointer(&pointer(&parts)).is_none() && !parts.iter().any(other_word) {
            prop_assert!(at(&value, &path(&text)).is_err(), "{}", text);
        }
    }

    #[test]
    fn what_is_written_is_read_again(mut value in everything(), other in everything()) {
        let source = serde_json::to_value(&other).expect("it has a serde form");
        for name in source.as_object().expect("it is a struct").keys() {
            write(&mut value, name, source[name].clone()).expect("it is a value of that part");
            prop_assert_eq!(read(&value, name), source[name].clone());
        }
        // `Some(None)` is null in the serde form and comes back as `None`.
        let again = copy(&other);
        prop_assert_eq!(&value, &again);
    }

    #[test]
    fn leaves_are_written_alone(mut value in everything(), new in number()) {
        let json = serde_json::to_value(&value).expect("it has a serde form");
        let mut all = Vec::new();
        paths(&json, &[], &mut all);
        for parts in &all {
            let text = parts.join(".");
            let whole = ["pose.rotation.", "pose2.rotation.", "complex.", "rotation."];
            let float = json.pointer(&pointer(parts)).is_some_and(Value::is_f64);
            if float && !whole.iter().any(|prefix| text.starts_with(prefix)) {
                write(&mut value, &text, json!(new)).expect("it is a number");
                prop_assert_eq!(read(&value, &text), json!(new), "{}", text);
            }
        }
    }
}

fn copy<T: Serialize + DeserializeOwned>(value: &T) -> T {
    let json = serde_json::to_value(value).expect("it has a serde form");
    serde_json::from_value(json).expect("it is its own")
}
