//! Types whose serde form does not follow from their fields alone, and containers that few use.

#![expect(clippy::disallowed_types, reason = "authors may exchange hash maps")]

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::ops::RangeInclusive;
use std::path::PathBuf;

use framework::Reflect;
use nalgebra::{Isometry2, Quaternion, Rotation3, Unit, UnitQuaternion, Vector2};
use proptest::prelude::*;
use serde::{Deserialize, Serialize, Serializer};

use super::{Ball, Both, Metres, balls, number};

/// What there is besides the usual.
#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
pub(crate) struct Odd {
    pub(crate) flattened: Flattened,
    tagged: Vec<Tagged>,
    adjacent: Vec<Adjacent>,
    untagged: Vec<Untagged>,
    mixed: Vec<Mixed>,
    foreign: Foreign,
    pub(crate) sometimes: Sometimes,
    /// Written as a text.
    with: With,
    hidden: Hidden,
    hidden_item: HiddenItem,
    struct_with_tag: StructWithTag,
    pub(crate) tree: Tree,
    numbers: BTreeSet<i16>,
    texts: HashSet<String>,
    by_number: BTreeMap<i32, bool>,
    by_hashed_number: HashMap<u8, char>,
    inclusive: RangeInclusive<u8>,
    large: (i128, u128),
    address: IpAddr,
    socket: SocketAddr,
    path: PathBuf,
    direction: Unit<Vector2<f64>>,
    quaternion: Quaternion<f32>,
    rotation: Rotation3<f64>,
    isometry: Isometry2<f64>,
    nothings: Vec<()>,
    absent: Option<Option<()>>,
    renamed: Renamed,
    unit_variants: [Light; 3],
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
pub(crate) struct Flattened {
    own: u8,
    #[serde(flatten)]
    ball: Ball,
    #[serde(flatten)]
    perhaps: Option<Both<u8>>,
    #[serde(flatten)]
    rest: BTreeMap<String, u16>,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Tagged {
    Stand,
    Walk { speed: f32 },
    Kick(Ball),
    Rest(BTreeMap<String, u8>),
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(tag = "kind", content = "value")]
enum Adjacent {
    Stand,
    Walk { speed: f32 },
    Look(u8, bool),
    Kick(Ball),
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(untagged)]
enum Untagged {
    Word(String),
    Number(f64),
    Kick(Ball),
    Look(u8, bool),
    Nothing,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
enum Mixed {
    Stand,
    #[serde(untagged)]
    Number(f32),
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(from = "String", into = "String")]
struct Foreign(String);

impl From<String> for Foreign {
    fn from(text: String) -> Self {
        Self(text)
    }
}

impl From<Foreign> for String {
    fn from(foreign: Foreign) -> Self {
        foreign.0
    }
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
pub(crate) struct Sometimes {
    before: u8,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    items: Vec<Ball>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    text: Option<String>,
    #[serde(skip)]
    never: u8,
    after: u8,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
struct With {
    #[serde(serialize_with = "as_text", deserialize_with = "from_text")]
    number: f32,
    plain: u8,
}

fn as_text<S: Serializer>(number: &f32, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(number)
}

fn from_text<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<f32, D::Error> {
    let text = String::deserialize(deserializer)?;
    text.parse().map_err(serde::de::Error::custom)
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
struct Hidden {
    seen: u8,
    #[reflect(skip)]
    hidden: NotReflected,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
struct HiddenItem(#[reflect(skip)] NotReflected, u8);

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
struct NotReflected(u8, Option<char>);

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(tag = "type")]
struct StructWithTag {
    value: u8,
}

/// A type in itself.
#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
pub(crate) struct Tree {
    pub(crate) name: String,
    /// Smaller trees.
    pub(crate) branches: Vec<Tree>,
    pub(crate) parent: Option<Box<Tree>>,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(rename_all = "camelCase")]
struct Renamed {
    how_far: Metres,
    r#type: Light,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Reflect, Serialize)]
enum Light {
    Red,
    /// With documentation.
    Green,
    #[serde(skip)]
    #[expect(dead_code, reason = "it has no serde form")]
    Infrared,
    Blue,
}

fn lights() -> impl Strategy<Value = Light> {
    prop_oneof![Just(Light::Red), Just(Light::Green), Just(Light::Blue)]
}

fn tagged() -> impl Strategy<Value = Tagged> {
    prop_oneof![
        Just(Tagged::Stand),
        number().prop_map(|speed| Tagged::Walk { speed }),
        balls().prop_map(Tagged::Kick),
        prop::collection::btree_map("[a-j]{1,4}", any::<u8>(), 0..3).prop_map(Tagged::Rest),
    ]
}

fn adjacent() -> impl Strategy<Value = Adjacent> {
    prop_oneof![
        Just(Adjacent::Stand),
        number().prop_map(|speed| Adjacent::Walk { speed }),
        any::<(u8, bool)>().prop_map(|(angle, fast)| Adjacent::Look(angle, fast)),
        balls().prop_map(Adjacent::Kick),
    ]
}

fn untagged() -> impl Strategy<Value = Untagged> {
    prop_oneof![
        ".*".prop_map(Untagged::Word),
        number().prop_map(|number| Untagged::Number(number.into())),
        balls().prop_map(Untagged::Kick),
        any::<(u8, bool)>().prop_map(|(angle, fast)| Untagged::Look(angle, fast)),
        Just(Untagged::Nothing),
    ]
}

fn trees() -> impl Strategy<Value = Tree> {
    let leaf = "[a-z]{0,3}".prop_map(|name| Tree {
        name,
        branches: Vec::new(),
        parent: None,
    });
    leaf.prop_recursive(4, 12, 3, |inner| {
        (
            "[a-z]{0,3}",
            prop::collection::vec(inner.clone(), 0..3),
            prop::option::of(inner.prop_map(Box::new)),
        )
            .prop_map(|(name, branches, parent)| Tree {
                name,
                branches,
                parent,
            })
    })
}

fn odd_structs() -> impl Strategy<Value = (Flattened, Sometimes, With, Hidden, HiddenItem)> {
    let flattened = (
        any::<u8>(),
        balls(),
        prop::option::of(any::<(u8, u8)>()),
        prop::collection::btree_map("[a-j]{1,4}", any::<u16>(), 0..3),
    );
    let sometimes = (
        any::<(u8, u8)>(),
        prop::collection::vec(balls(), 0..2),
        any::<Option<String>>(),
    );
    let others = (number(), any::<(u8, Option<char>)>());
    (flattened, sometimes, others).prop_map(|(flattened, sometimes, (number, (byte, letter)))| {
        let (own, ball, perhaps, rest) = flattened;
        let ((before, after), items, text) = sometimes;
        let perhaps = perhaps.map(|(left, right)| Both { left, right });
        let hidden = NotReflected(byte, letter);
        (
            Flattened {
                own,
                ball,
                perhaps,
                rest,
            },
            Sometimes {
                before,
                items,
                text,
                never: 0,
                after,
            },
            With {
                number,
                plain: byte,
            },
            Hidden {
                seen: byte,
                hidden: hidden.clone(),
            },
            HiddenItem(hidden, byte),
        )
    })
}

pub(crate) fn odd() -> impl Strategy<Value = Odd> {
    let enums = (
        prop::collection::vec(tagged(), 0..4),
        prop::collection::vec(adjacent(), 0..4),
        prop::collection::vec(untagged(), 0..4),
        prop::collection::vec(
            prop_oneof![Just(Mixed::Stand), number().prop_map(Mixed::Number)],
            0..3,
        ),
        prop::array::uniform3(lights()),
    );
    let containers = (
        any::<BTreeSet<i16>>(),
        prop::collection::hash_set(".*", 0..3),
        prop::collection::btree_map(any::<i32>(), any::<bool>(), 0..3),
        prop::collection::hash_map(any::<u8>(), any::<char>(), 0..3),
        prop::collection::vec(Just(()), 0..3),
    );
    let leaves = (
        any::<(u8, u8)>(),
        any::<(i64, u64)>(),
        any::<[u8; 4]>(),
        ".*",
    );
    let geometry = (number(), number(), any::<Option<()>>());
    (odd_structs(), enums, containers, leaves, geometry, trees()).prop_map(
        |(structs, enums, containers, leaves, geometry, tree)| {
            let (flattened, sometimes, with, hidden, hidden_item) = structs;
            let (tagged, adjacent, untagged, mixed, unit_variants) = enums;
            let (numbers, texts, by_number, by_hashed_number, nothings) = containers;
            let (bytes, large, address, text) = leaves;
            let (angle, distance, absent) = geometry;
            let address = IpAddr::V4(Ipv4Addr::from(address));
            let turn = f64::from(angle);
            Odd {
                flattened,
                tagged,
                adjacent,
                untagged,
                mixed,
                foreign: Foreign(text.clone()),
                sometimes,
                with,
                hidden,
                hidden_item,
                struct_with_tag: StructWithTag { value: bytes.0 },
                tree,
                numbers,
                texts,
                by_number,
                by_hashed_number,
                inclusive: bytes.0..=bytes.1,
                large: (large.0.into(), large.1.into()),
                address,
                socket: SocketAddr::new(address, 10_001),
                path: PathBuf::from(text),
                direction: Unit::new_normalize(Vector2::new(turn.cos(), turn.sin())),
                quaternion: *UnitQuaternion::from_euler_angles(angle, distance, 0.5),
                rotation: Rotation3::from_euler_angles(turn, 0.5, 0.25),
                isometry: Isometry2::new(Vector2::new(distance.into(), turn), turn),
                nothings,
                absent: absent.map(Some),
                renamed: Renamed {
                    how_far: Metres(distance),
                    r#type: Light::Green,
                },
                unit_variants,
            }
        },
    )
}
