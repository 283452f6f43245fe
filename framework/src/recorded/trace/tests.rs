//! What a type's `Deserialize` tells, against the values it reads.

use std::collections::BTreeMap;
use std::time::Duration;

use hulkgen_mcap::Layout;
use hulkgen_mcap::layout::Values;
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::layout_of;

/// What is read of a value by its layout is what serde has in JSON.
fn assert_read<T: Serialize + DeserializeOwned>(values: impl IntoIterator<Item = T>) {
    let layout = layout_of::<T>();
    assert!(layout.is_known(), "{layout:?}");
    for value in values {
        let bytes = postcard::to_stdvec(&value).expect("it can be written");
        let expected: Value = serde_json::to_value(&value).expect("it has a JSON form");
        let mut read = Values::new(&bytes);
        assert_eq!(read.take(&layout), Ok(expected), "{layout:?}");
        assert!(read.is_empty());
    }
}

#[derive(Clone, Serialize, Deserialize)]
enum Motion {
    Stand,
    Walk { speed: f32, steps: Vec<Step> },
    Kick(Side, u8),
    Look(Option<Box<Motion>>),
}

#[derive(Clone, Copy, Serialize, Deserialize)]
enum Side {
    Left,
    Right,
}

#[derive(Clone, Serialize, Deserialize)]
struct Step {
    side: Side,
    #[serde(rename = "to")]
    target: (i16, i16),
    #[serde(skip)]
    _cache: u64,
}

#[derive(Clone, Serialize, Deserialize)]
struct Tree {
    weight: u64,
    below: Vec<Tree>,
    names: BTreeMap<String, Tree>,
}

/// Refuses what it is offered first.
#[derive(Serialize, Deserialize)]
#[serde(try_from = "f32", into = "f32")]
#[derive(Clone)]
struct Positive(f32);

impl TryFrom<f32> for Positive {
    type Error = String;

    fn try_from(value: f32) -> Result<Self, String> {
        (value > 0.0)
            .then_some(Self(value))
            .ok_or_else(|| "not positive".to_owned())
    }
}

impl From<Positive> for f32 {
    fn from(Positive(value): Positive) -> Self {
        value
    }
}

#[test]
fn every_variant_is_found() {
    let step = Step {
        side: Side::Right,
        target: (-300, 4),
        _cache: 0,
    };
    let walk = Motion::Walk {
        speed: 0.5,
        steps: vec![step.clone(), step],
    };
    assert_read([
        Motion::Stand,
        walk.clone(),
        Motion::Kick(Side::Left, 200),
        Motion::Look(None),
        Motion::Look(Some(Box::new(walk))),
    ]);
}

#[test]
fn what_contains_itself_has_a_layout() {
    let leaf = Tree {
        weight: u64::MAX,
        below: Vec::new(),
        names: BTreeMap::new(),
    };
    let tree = Tree {
        weight: 1,
        below: vec![leaf.clone(), leaf.clone()],
        names: BTreeMap::from([("one".to_owned(), leaf)]),
    };
    assert_read([vec![tree.clone()], vec![tree]]);
}

#[test]
fn types_of_others_have_a_layout() {
    let pose = Isometry3::from_parts(
        Vector3::new(1.0, 2.0, 3.0).into(),
        UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3),
    );
    assert_read([pose]);
    assert_read([(Duration::from_millis(1500), 'x', [1_i8, -2], Some(()))]);
}

#[test]
fn a_type_that_refuses_a_value_is_offered_another() {
    assert_read([(Positive(2.5), 3_u8)]);
}

/// Refuses everything that nobody thought of.
#[derive(Clone, Serialize, Deserialize)]
#[serde(try_from = "Vec<Step>", into = "Vec<Step>")]
struct Steps(Vec<Step>);

impl TryFrom<Vec<Step>> for Steps {
    type Error = String;

    fn try_from(steps: Vec<Step>) -> Result<Self, String> {
        match steps.len() {
            2 => Ok(Self(steps)),
            other => Err(format!("{other} steps")),
        }
    }
}

impl From<Steps> for Vec<Step> {
    fn from(Steps(steps): Steps) -> Self {
        steps
    }
}

#[test]
fn what_stands_behind_a_type_that_refuses_all_values_has_a_layout() {
    #[derive(Clone, Serialize, Deserialize)]
    enum Dance {
        Waltz { steps: Steps, measure: u8 },
        Break,
    }
    #[derive(Clone, Serialize, Deserialize)]
    struct Evening {
        before: bool,
        first: Steps,
        #[serde(skip)]
        _cache: u64,
        between: BTreeMap<String, Steps>,
        then: Dance,
        #[serde(rename = "last")]
        end: Option<Side>,
    }
    let step = |side| Step {
        side,
        target: (7, -7),
        _cache: 0,
    };
    let steps = Steps(vec![step(Side::Left), step(Side::Right)]);
    let evening = |then, end| Evening {
        before: true,
        first: steps.clone(),
        _cache: 0,
        between: BTreeMap::from([("a pause".to_owned(), steps.clone())]),
        then,
        end,
    };
    let waltz = Dance::Waltz {
        steps: steps.clone(),
        measure: 3,
    };
    assert_read([
        evening(waltz, Some(Side::Right)),
        evening(Dance::Break, None),
    ]);
}

#[test]
fn a_field_with_several_names_is_not_taken_for_several() {
    #[derive(Deserialize)]
    struct Renamed {
        _first: Steps,
        #[serde(alias = "other")]
        _second: u8,
    }
    let Layout::Struct(renamed) = layout_of::<Renamed>() else {
        panic!("it is a struct");
    };
    let known = renamed.fields.iter().filter(|(_, one)| one.is_known());
    assert_eq!(known.count(), 2, "{renamed:?}");
}

#[test]
fn what_no_type_tells_stays_unknown() {
    let layout = layout_of::<(u8, Value, u8)>();
    assert!(!layout.is_known());
    assert_eq!(layout.to_string(), "a tuple of 3");
}

#[test]
fn of_two_that_nobody_can_tell_what_is_behind_the_inner_one_is_found() {
    #[derive(Deserialize)]
    struct Inner {
        _any: Option<serde_json::Value>,
        _known: u8,
    }
    #[derive(Deserialize)]
    struct Outer {
        _inner: Inner,
        _any: Option<serde_json::Value>,
    }
    let Layout::Struct(outer) = layout_of::<Outer>() else {
        panic!("it is a struct");
    };
    let Layout::Struct(inner) = &outer.fields[0].1 else {
        panic!("it has one in it");
    };
    assert_eq!(inner.fields[1].1, Layout::Unsigned(8));
}

#[test]
fn a_type_that_panics_at_what_it_is_offered_is_offered_others() {
    struct Odd;
    impl<'de> Deserialize<'de> for Odd {
        fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            assert!(u8::deserialize(deserializer)? % 2 == 1, "it is even");
            Ok(Self)
        }
    }
    #[derive(Deserialize)]
    struct Both {
        _odd: Odd,
        _share: f32,
    }
    let Layout::Struct(both) = layout_of::<Both>() else {
        panic!("it is a struct");
    };
    let parts: Vec<_> = both.fields.into_iter().map(|(_, layout)| layout).collect();
    assert_eq!(parts, [Layout::Unsigned(8), Layout::Float(32)]);
}
