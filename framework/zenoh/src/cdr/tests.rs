//! Values whose bytes were counted by hand, and bytes that lie. `tests/bridge.rs` asks a reader from PyPI, too.

use serde_json::{Value, json};

use super::{Layout, attachment};

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
    // Four thousand million items that need no byte are no work.
    let nothing = layout(json!({ "kind": "list", "item": { "kind": "unit" } }));
    nothing.to_cdr(&[255; 4]).expect("each of them is nothing");
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
