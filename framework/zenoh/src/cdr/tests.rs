//! Values whose bytes were counted by hand, and bytes that lie. `tests/bridge.rs` asks a reader from PyPI, too.

use serde_json::{Value, json};

use super::{Beside, attachment};
use crate::layout::Layout;
use crate::random::{Random, Written};

fn layout(root: Value) -> Layout {
    Layout::read(json!({ "root": root })).expect("CDR has a form for it")
}

fn float(bits: u32) -> Value {
    json!({ "kind": "float", "bits": bits })
}

fn unsigned(bits: u32) -> Value {
    json!({ "kind": "unsigned", "bits": bits })
}

fn field(name: &str, layout: Value) -> Value {
    json!({ "name": name, "layout": layout })
}

/// Without the head, which is checked here.
fn cdr(layout: &Layout, bytes: &[u8]) -> Vec<u8> {
    let cdr = layout.to_cdr(bytes).expect("it is laid out so");
    assert_eq!(cdr[..4], [0, 1, 0, 0]);
    cdr[4..].to_vec()
}

#[test]
fn numbers_are_aligned_to_their_size() {
    let layout = layout(json!({ "kind": "struct", "fields": [
        field("on", json!({ "kind": "bool" })),
        field("level", unsigned(16)),
        field("small", unsigned(8)),
        field("speed", float(64)),
        field("last", json!({ "kind": "signed", "bits": 32 })),
    ] }));
    let mut bytes = vec![1, 0x03, 0x02, 7];
    bytes.extend(1.5_f64.to_le_bytes());
    bytes.extend((-2_i32).to_le_bytes());
    let mut expected = vec![1, 0, 0x03, 0x02, 7, 0, 0, 0];
    expected.extend(1.5_f64.to_le_bytes());
    expected.extend((-2_i32).to_le_bytes());
    assert_eq!(cdr(&layout, &bytes), expected);
}

#[test]
fn texts_lists_options_and_names_have_their_counts() {
    let layout = layout(json!({ "kind": "struct", "fields": [
        field("name", json!({ "kind": "text" })),
        field("list", json!({ "kind": "list", "item": unsigned(16) })),
        field("there", json!({ "kind": "option", "content": unsigned(8) })),
        field("absent", json!({ "kind": "option", "content": float(64) })),
        { "name": "left_out", "layout": unsigned(8), "optional": true },
        field("mode", json!({ "kind": "enum", "variants": [{ "name": "A" }, { "name": "B" }] })),
        field("pair", json!({ "kind": "array", "length": 2, "item": float(32) })),
    ] }));
    let mut bytes = vec![3, 0, 0, 0, b'n', 0xc3, 0xa9];
    bytes.extend([2, 0, 0, 0, 1, 0, 2, 0]);
    bytes.extend([1, 9, 0, 0]);
    bytes.extend([1, 0, 0, 0]);
    bytes.extend([1.0_f32, 2.0].map(f32::to_le_bytes).concat());
    let mut expected = vec![4, 0, 0, 0, b'n', 0xc3, 0xa9, 0];
    expected.extend([2, 0, 0, 0, 1, 0, 2, 0]);
    expected.extend([1, 0, 0, 0, 9, 0, 0, 0]);
    expected.extend([0, 0, 0, 0]);
    expected.extend([0, 0, 0, 0]);
    expected.extend([1, 0, 0, 0]);
    expected.extend([1.0_f32, 2.0].map(f32::to_le_bytes).concat());
    assert_eq!(cdr(&layout, &bytes), expected);
}

#[test]
fn a_value_may_contain_its_own_type() {
    let tree = json!({
        "root": { "kind": "reference", "name": "Tree" },
        "definitions": { "Tree": { "kind": "struct", "fields": [
            field("below", json!({ "kind": "list", "item": { "kind": "reference", "name": "Tree" } })),
        ] } }
    });
    let layout = Layout::read(tree).expect("CDR has a form for it");
    let bytes = [2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    assert_eq!(cdr(&layout, &bytes), bytes);
}

#[test]
fn what_cdr_cannot_say_is_told_before_a_value_comes() {
    for (part, word) in [
        (json!({ "kind": "any" }), "that only its values tell"),
        (json!({ "kind": "character" }), "a letter"),
        (json!({ "kind": "map", "value": float(32) }), "a map"),
        (unsigned(128), "a number of unusual size"),
        (
            json!({ "kind": "enum", "variants": [{ "name": "A", "content": float(32) }] }),
            "variant `A` holds something",
        ),
    ] {
        let inner = json!({ "kind": "struct", "fields": [field("x", part)] });
        let list = json!({ "root": { "kind": "list", "item": inner } });
        let message = Layout::read(list).expect_err("it has no form");
        assert!(
            message.starts_with("`x` is ") && message.contains(word),
            "{message}"
        );
    }
    assert!(Layout::read(json!({ "root": { "kind": "new" } })).is_err());
}

#[test]
fn bytes_that_lie_are_refused() {
    let list = layout(json!({ "kind": "list", "item": float(32) }));
    for bytes in [
        &[][..],
        &[1, 0, 0],
        &[1, 0, 0, 0],
        &[255; 8],
        &[0, 0, 0, 0, 0],
    ] {
        list.to_cdr(bytes)
            .expect_err("the bytes are not laid out so");
    }
    let text = layout(json!({ "kind": "text" }));
    text.to_cdr(&[255, 255, 255, 255, b'a'])
        .expect_err("there are not so many bytes");
    let option = layout(json!({ "kind": "option", "content": { "kind": "unit" } }));
    option.to_cdr(&[2]).expect_err("neither there nor absent");
    let name = layout(json!({ "kind": "enum", "variants": [{ "name": "A" }] }));
    name.to_cdr(&[1, 0, 0, 0])
        .expect_err("there is no such variant");
    // Four thousand million items that need no byte are more than anybody sends.
    let nothing = layout(json!({ "kind": "list", "item": { "kind": "unit" } }));
    nothing
        .to_cdr(&[255; 4])
        .expect_err("each of them is a byte");
    let ring = json!({ "root": { "kind": "reference", "name": "A" },
        "definitions": { "A": { "kind": "reference", "name": "A" } } });
    let ring = Layout::read(ring).expect("nobody followed it");
    ring.to_cdr(&[]).expect_err("it never ends");
}

#[test]
fn an_attachment_is_what_rmw_zenoh_reads() {
    let bytes = attachment(2, 3, [7; 16]);
    let mut expected = vec![2, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 16];
    expected.extend([7; 16]);
    assert_eq!(bytes, expected);
}

#[test]
fn what_has_no_parts_is_a_byte() {
    let unit = json!({ "kind": "unit" });
    let empty = json!({ "kind": "struct", "fields": [] });
    let number = unsigned(16);
    for nothing in [
        unit,
        empty,
        json!({ "kind": "tuple", "items": [] }),
        json!({ "kind": "array", "length": 0, "item": number }),
    ] {
        let alone = layout(nothing.clone());
        assert_eq!(cdr(&alone, &[]), [0]);
        let inside = layout(json!({ "kind": "struct", "fields": [
            field("nothing", nothing), field("number", unsigned(16)),
        ] }));
        assert_eq!(cdr(&inside, &[3, 2]), [0, 0, 3, 2]);
        // Some send nothing at all.
        for bytes in [&[0, 1, 0, 0][..], &[0, 1, 0, 0, 0]] {
            alone.read_cdr(bytes).expect("it has no parts");
        }
    }
}

#[test]
fn values_come_back_as_they_went() {
    let mut random = Random(1);
    for _ in 0..3000 {
        let described = random.layout(4);
        let layout = Layout::read(described.clone()).expect("CDR has a form for it");
        let mut written = Written::default();
        let value = random.value(&described["root"], &mut written);
        let cdr = layout.to_cdr(&written.bytes).expect("it is laid out so");
        assert_eq!(layout.read_cdr(&cdr).as_ref(), Ok(&value), "{described}");
        assert_eq!(
            layout.json_to_cdr(&value),
            Ok(Some(cdr)),
            "{described}: {value}"
        );
    }
}

#[test]
fn no_bytes_do_harm() {
    let mut random = Random(2);
    let (mut read, mut refused) = (0, 0);
    for _ in 0..500 {
        let described = random.layout(4);
        let layout = Layout::read(described.clone()).expect("CDR has a form for it");
        let mut written = Written::default();
        random.value(&described["root"], &mut written);
        let mut cdr = layout.to_cdr(&written.bytes).expect("it is laid out so");
        for _ in 0..10 {
            match random.below(4) {
                0 => cdr = random.bytes(64),
                1 => cdr.truncate(random.below(cdr.len() + 1)),
                2 => cdr.extend(random.bytes(8)),
                _ => {
                    let length = cdr.len();
                    if let Some(byte) = cdr.get_mut(random.below(length)) {
                        *byte = random.byte();
                    }
                }
            }
            let _ = layout.to_cdr(&cdr);
            match layout.read_cdr(&cdr) {
                // What was read is a value: it can be written again.
                Ok(value) => {
                    layout.json_to_cdr(&value).expect("it is laid out so");
                    read += 1;
                }
                Err(_) => refused += 1,
            }
        }
    }
    assert!(
        read > 100 && refused > 1000,
        "{read} read, {refused} refused"
    );
}

#[test]
fn what_comes_in_is_refused_with_its_place() {
    let layout = layout(json!({ "kind": "struct", "fields": [
        field("mode", json!({ "kind": "enum", "variants": [{ "name": "A" }, { "name": "B" }] })),
        field("names", json!({ "kind": "list", "item": { "kind": "text" } })),
        field("speed", float(32)),
        field("there", json!({ "kind": "option", "content": { "kind": "bool" } })),
    ] }));
    let good = [
        &[1, 0, 0, 0][..],
        &[1, 0, 0, 0, 2, 0, 0, 0, b'a', 0],
        &[0, 0],
        &1.5_f32.to_le_bytes(),
        &[1, 0, 0, 0, 1],
    ];
    let good = [&[0, 1, 0, 0][..], &good.concat()].concat();
    let value = layout.read_cdr(&good).expect("it is good");
    assert_eq!(
        value,
        json!({ "mode": "B", "names": ["a"], "speed": 1.5, "there": true })
    );
    let filled = [&good[..], &[0, 0, 0]].concat();
    assert_eq!(layout.read_cdr(&filled), Ok(value));
    let changed = |at: usize, bytes: &[u8]| {
        let mut changed = good.clone();
        changed[at..at + bytes.len()].copy_from_slice(bytes);
        layout.read_cdr(&changed).expect_err("it is wrong")
    };
    for (told, words) in [
        (changed(1, &[2]), "no CDR of version 1"),
        (
            changed(4, &[2]),
            "`mode` of the payload is 2: its variants are 0 to 1",
        ),
        (
            changed(8, &[255, 255, 255, 255]),
            "`names` of the payload has 4294967295 items, and 17 bytes are left",
        ),
        (
            changed(12, &[255, 255, 255, 255]),
            "`names.0` of the payload wants 4294967295 bytes",
        ),
        (changed(16, &[255]), "no UTF-8"),
        (changed(17, b"b"), "does not end with a zero"),
        (
            changed(20, &f32::NAN.to_le_bytes()),
            "`speed` of the payload is NaN",
        ),
        (changed(24, &[2]), "there 2 times"),
        (changed(28, &[7]), "no bool but 7"),
        (
            layout.read_cdr(&good[..27]).expect_err("it is short"),
            "`there` of the payload wants 4 bytes, and 3 are left",
        ),
        (
            layout
                .read_cdr(&[good.clone(), good.clone()].concat())
                .expect_err("it is long"),
            "another message",
        ),
        (
            layout.read_cdr(&[0, 1]).expect_err("it is short"),
            "too short",
        ),
    ] {
        assert!(told.contains(words), "{told}");
    }
}

/// A machine of the other byte order sends this.
#[test]
fn either_byte_order_is_read() {
    let layout = layout(json!({ "kind": "struct", "fields": [
        field("level", unsigned(16)), field("speed", float(64)),
    ] }));
    let mut bytes = vec![0, 0, 0, 0, 2, 3, 0, 0, 0, 0, 0, 0];
    bytes.extend(1.5_f64.to_be_bytes());
    assert_eq!(
        layout.read_cdr(&bytes),
        Ok(json!({ "level": 0x0203, "speed": 1.5 }))
    );
}

#[test]
fn a_value_of_very_many_parts_is_refused() {
    let list = layout(json!({ "kind": "list", "item": { "kind": "bool" } }));
    let mut bytes = vec![0, 1, 0, 0];
    bytes.extend(1_000_000_u32.to_le_bytes());
    bytes.resize(1_000_008, 1);
    let told = list.read_cdr(&bytes).expect_err("it takes too much memory");
    assert!(told.contains("more than 262144 parts"), "{told}");
}

/// Of parameters and answers the robot has JSON alone.
#[test]
fn what_json_cannot_say_is_not_made_up() {
    let number = layout(float(32));
    assert_eq!(number.json_to_cdr(&json!(null)), Ok(None));
    let option = layout(json!({ "kind": "option", "content": float(32) }));
    assert_eq!(
        option.json_to_cdr(&json!(null)),
        Ok(Some(vec![0, 1, 0, 0, 0, 0, 0, 0]))
    );
    for (kind, value) in [
        (unsigned(8), json!(256)),
        (unsigned(8), json!(-1)),
        (json!({ "kind": "signed", "bits": 8 }), json!(-129)),
        (json!({ "kind": "bool" }), json!(1)),
        (
            json!({ "kind": "array", "length": 2, "item": float(32) }),
            json!([1.0]),
        ),
        (
            json!({ "kind": "enum", "variants": [{ "name": "A" }] }),
            json!("B"),
        ),
        (
            json!({ "kind": "struct", "fields": [field("x", float(32))] }),
            json!({}),
        ),
    ] {
        let refused = layout(kind).json_to_cdr(&value);
        assert!(refused.is_err(), "{value}: {refused:?}");
    }
}

#[test]
fn what_stands_beside_a_request_is_read() {
    let bytes = attachment(5, 3, [7; 16]);
    assert_eq!(
        Beside::read(&bytes),
        Some(Beside {
            number: 5,
            id: [7; 16]
        })
    );
    for length in 0..bytes.len() {
        assert_eq!(Beside::read(&bytes[..length]), None);
    }
    assert_eq!(Beside::read(&attachment_of_other_length()), None);
}

fn attachment_of_other_length() -> Vec<u8> {
    let mut bytes = attachment(5, 3, [7; 16]);
    bytes[16] = 15;
    bytes
}
