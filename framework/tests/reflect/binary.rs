//! Values as bytes: what a layout tells is what is written.

use framework::Reflect;
use framework::reflect::binary::{Layout, LayoutContent, decode, encode, encode_as};
use framework::reflect::{Shape, at};
use proptest::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::odd::{Odd, Tree, odd};
use super::{Everything, everything, path, paths};

pub(crate) fn bytes_of(value: &dyn Reflect) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode(value, &mut bytes).expect("it has a binary form");
    bytes
}

/// The layout as a client gets it.
pub(crate) fn layout(shape: &Shape) -> Layout {
    let json = serde_json::to_string(&shape.layout()).expect("it is plain");
    serde_json::from_str(&json).expect("it is its own")
}

/// Encoded, and decoded by the layout of its shape.
fn there_and_back(shape: &Shape, value: &dyn Reflect) -> Value {
    let mut bytes = Vec::new();
    encode_as(shape, value, &mut bytes).expect("it has a binary form");
    decode(&layout(shape), &bytes).unwrap_or_else(|error| panic!("{error} in {bytes:?}"))
}

fn json_of(value: &dyn Reflect) -> Value {
    serde_json::to_value(value.as_serialize()).expect("it has a serde form")
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
struct Small {
    on: bool,
    level: Option<u16>,
    mode: Mode,
    name: String,
    points: Vec<f32>,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
enum Mode {
    Off,
    Speed(i8),
    Both { left: u8, right: u8 },
}

#[test]
fn every_byte_is_where_the_page_says() {
    let small = Small {
        on: true,
        level: Some(0x0203),
        mode: Mode::Both { left: 7, right: 8 },
        name: "né".into(),
        points: vec![1.0, -2.0],
    };
    let expected: Vec<u8> = [
        &[1][..],
        &[1, 3, 2],
        &[2, 0, 0, 0, 7, 8],
        &[3, 0, 0, 0, b'n', 0xc3, 0xa9],
        &[2, 0, 0, 0, 0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0],
    ]
    .concat();
    assert_eq!(bytes_of(&small), expected);
    assert_eq!(
        serde_json::to_value(layout(&Small::shape())).expect("it is plain"),
        json!({"root": {"kind": "struct", "fields": [
            {"name": "on", "layout": {"kind": "bool"}},
            {"name": "level", "layout": {"kind": "option", "content": {"kind": "unsigned", "bits": 16}}},
            {"name": "mode", "layout": {"kind": "enum", "variants": [
                {"name": "Off"},
                {"name": "Speed", "content": {"kind": "signed", "bits": 8}},
                {"name": "Both", "content": {"kind": "struct", "fields": [
                    {"name": "left", "layout": {"kind": "unsigned", "bits": 8}},
                    {"name": "right", "layout": {"kind": "unsigned", "bits": 8}},
                ]}},
            ]}},
            {"name": "name", "layout": {"kind": "text"}},
            {"name": "points", "layout": {"kind": "list", "item": {"kind": "float", "bits": 32}}},
        ]}})
    );
    let off = Small {
        on: false,
        level: None,
        mode: Mode::Off,
        name: String::new(),
        points: Vec::new(),
    };
    assert_eq!(bytes_of(&off), [0; 14]);
}

#[test]
fn what_fails_half_way_leaves_nothing() {
    let paths = (5_u8, std::path::PathBuf::from(broken_path()));
    let mut bytes = vec![1, 2, 3];
    let error = encode(&paths, &mut bytes).expect_err("the path is no Unicode");
    assert!(error.to_string().contains("is no Unicode"), "{error}");
    assert_eq!(bytes, [1, 2, 3]);
}

fn broken_path() -> std::ffi::OsString {
    use std::os::unix::ffi::OsStringExt;
    std::ffi::OsString::from_vec(vec![0xff, 0xfe])
}

#[test]
fn numbers_that_json_does_not_have_are_kept_in_bytes() {
    let numbers = [f32::NAN, f32::INFINITY, 1.0];
    assert_eq!(bytes_of(&numbers)[..4], f32::NAN.to_le_bytes());
    let json = there_and_back(&<[f32; 3]>::shape(), &numbers);
    assert_eq!(json, json!([null, null, 1.0]));
    let wide = (i128::MIN, u128::MAX);
    let json = there_and_back(&<(i128, u128)>::shape(), &wide);
    assert_eq!(json, json!([i128::MIN.to_string(), u128::MAX.to_string()]));
}

#[test]
fn bytes_that_are_no_value_are_told() {
    let layout = Small::shape().layout();
    for (bytes, message) in [
        (&[][..], "byte 0: expected 1 bytes, 0 are left"),
        (&[2], "byte 1: expected 0 or 1, found 2"),
        (&[0, 0, 9, 0, 0, 0], "byte 6: no variant 9"),
        (
            &[0, 0, 0, 0, 0, 0, 9, 0, 0, 0, b'a'],
            "byte 10: a text of 9 bytes goes beyond the end",
        ),
        (
            &[0, 0, 0, 0, 0, 0, 2, 0, 0, 0, b'a', 0xff],
            "byte 11: the text is no UTF-8",
        ),
        (
            &[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 7],
            "byte 14: 1 bytes more than the value has",
        ),
    ] {
        let error = decode(&layout, bytes).expect_err(message);
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn few_bytes_cannot_make_much() {
    // Four thousand million nothings, nested lists of them, and lists that only open.
    let nothings = Vec::<()>::shape().layout();
    decode(&nothings, &[0xff; 4]).expect_err("there are too many");
    let nested = Vec::<Vec<()>>::shape().layout();
    let many = [&[0, 4, 0, 0][..], &[0xff, 0xff, 0, 0].repeat(1024)].concat();
    decode(&nested, &many).expect_err("there are too many");
    let any = Layout {
        root: LayoutContent::Any,
        definitions: Default::default(),
    };
    let opened = [7, 1, 0, 0, 0].repeat(100_000);
    let error = decode(&any, &opened).expect_err("it is too deep");
    assert!(error.message.contains("inside of each other"), "{error}");
    let ring = json!({"root": {"kind": "reference", "name": "A"}, "definitions": {"A": {"kind": "tuple", "items": [{"kind": "reference", "name": "A"}, {"kind": "reference", "name": "A"}]}}});
    let ring: Layout = serde_json::from_value(ring).expect("it is a layout");
    decode(&ring, &[]).expect_err("it never ends");
}

#[test]
fn a_type_inside_of_itself_is_laid_out_once() {
    let twig = Tree {
        name: "twig".into(),
        branches: Vec::new(),
        parent: None,
    };
    let tree = Tree {
        name: "tree".into(),
        branches: vec![twig.clone(), twig.clone()],
        parent: Some(Box::new(twig)),
    };
    let shape = Tree::shape();
    assert_eq!(shape.layout().definitions.len(), 1);
    assert_eq!(there_and_back(&shape, &tree), json_of(&tree));
}

/// Every part of a value, by itself, too: what a client subscribes to.
fn check_parts(shape: &Shape, value: &dyn Reflect) {
    assert_eq!(there_and_back(shape, value), json_of(value));
    let mut all = Vec::new();
    paths(&json_of(value), &[], &mut all);
    for text in all.iter().map(|parts| parts.join(".")) {
        // Of what is written as one only the whole is a value.
        if let (Ok(text), Ok(part)) = (text.parse(), at(value, &path(&text))) {
            // Of a flattened map a type does not know the keys.
            let Ok(shape) = shape.at(&text) else {
                assert!(text.to_string().starts_with("flattened."), "{text}");
                continue;
            };
            assert_eq!(there_and_back(&shape, part), json_of(part), "{text}");
        }
    }
}

proptest! {
    #[test]
    fn what_is_decoded_is_the_serde_form(value in everything()) {
        check_parts(&Everything::shape(), &value);
    }

    #[test]
    fn also_of_odd_types(value in odd()) {
        check_parts(&Odd::shape(), &value);
    }

    #[test]
    fn changed_bytes_never_panic(value in odd(), changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8), cut in any::<prop::sample::Index>()) {
        let layout = Odd::shape().layout();
        let mut bytes = bytes_of(&value);
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        let _ = decode(&layout, &bytes);
        let _ = decode(&layout, &bytes[..cut.index(bytes.len())]);
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        for shape in [Odd::shape(), Everything::shape(), Tree::shape()] {
            let _ = decode(&shape.layout(), &bytes);
        }
    }
}
