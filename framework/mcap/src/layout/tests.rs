//! Layouts, against what postcard writes.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::{Value, json};

use super::{Enum, Layout, Part, PartKind, Struct, Values, first_difference};

fn read(layout: &Layout, value: &impl Serialize) -> Value {
    let bytes = postcard::to_stdvec(value).expect("it can be written");
    let mut values = Values::new(&bytes);
    let read = values.take(layout).expect("it is of that layout");
    assert!(values.is_empty(), "all of it");
    let mut values = Values::new(&bytes);
    assert_eq!(values.skip(layout), Ok(bytes.len()));
    read
}

fn names(parts: &[(&str, Layout)]) -> Vec<(String, Layout)> {
    let parts = parts.iter();
    parts
        .map(|(name, layout)| ((*name).to_owned(), layout.clone()))
        .collect()
}

fn list(item: Layout) -> Layout {
    Layout::List(Box::new(item))
}

/// Itself, some times.
#[derive(Serialize)]
struct Tree {
    weight: i16,
    below: Vec<Tree>,
    other: Option<Box<Tree>>,
}

fn tree() -> Layout {
    Layout::Struct(Struct {
        name: "Tree".to_owned(),
        fields: names(&[
            ("weight", Layout::Signed(16)),
            ("below", list(Layout::Again(1))),
            ("other", Layout::Option(Box::new(Layout::Again(1)))),
        ]),
    })
}

#[test]
fn numbers_are_those_that_were_written() {
    for number in [0, 1, -1, 63, -64, 64, i64::MAX, i64::MIN] {
        assert_eq!(read(&Layout::Signed(64), &number), json!(number));
    }
    assert_eq!(read(&Layout::Signed(8), &-3_i8), json!(-3));
    for number in [0, 127, 128, u64::MAX] {
        assert_eq!(read(&Layout::Unsigned(64), &number), json!(number));
    }
    let large = i128::MIN;
    assert_eq!(read(&Layout::Signed(128), &large), json!(large.to_string()));
    assert_eq!(read(&Layout::Float(32), &0.5_f32), json!(0.5));
    assert_eq!(read(&Layout::Float(64), &f64::NAN), Value::Null);
}

#[test]
fn collections_are_as_serde_has_them_in_json() {
    let bytes = vec![1_u8, 2, 3];
    assert_eq!(read(&list(Layout::Unsigned(8)), &bytes), json!(bytes));
    let map = BTreeMap::from([(3_u32, 'x')]);
    let layout = Layout::Map(Box::new((Layout::Unsigned(32), Layout::Character)));
    assert_eq!(read(&layout, &map), json!({"3": "x"}));
    let pair = Layout::Tuple(vec![Layout::Bool, Layout::Text]);
    assert_eq!(read(&pair, &(true, "yes")), json!([true, "yes"]));
    let option = Layout::Option(Box::new(Layout::Unit));
    assert_eq!(read(&option, &Some(())), Value::Null);
}

#[test]
fn enums_have_their_variants_by_name() {
    #[derive(Serialize)]
    enum Shape {
        None,
        Circle(f32),
        Box { width: u8 },
    }
    let layout = Layout::Enum(Enum {
        name: "Shape".to_owned(),
        variants: names(&[
            ("None", Layout::Unit),
            ("Circle", Layout::Float(32)),
            (
                "Box",
                Layout::Struct(Struct {
                    name: String::new(),
                    fields: names(&[("width", Layout::Unsigned(8))]),
                }),
            ),
        ]),
    });
    for (shape, expected) in [
        (Shape::None, json!("None")),
        (Shape::Circle(1.5), json!({"Circle": 1.5})),
        (Shape::Box { width: 4 }, json!({"Box": {"width": 4}})),
    ] {
        assert_eq!(read(&layout, &shape), expected);
    }
}

#[test]
fn what_contains_itself_is_read_and_has_an_end() {
    let leaf = |weight| Tree {
        weight,
        below: Vec::new(),
        other: None,
    };
    let value = Tree {
        weight: -1,
        below: vec![leaf(2), leaf(3)],
        other: Some(Box::new(leaf(4))),
    };
    assert_eq!(read(&tree(), &value)["below"][1]["weight"], json!(3));
    assert_eq!(read(&tree(), &value)["other"]["weight"], json!(4));
    // Again and again the first of one.
    let endless = [0, 1].repeat(100_000);
    assert!(Values::new(&endless).take(&tree()).is_err());
    assert!(Values::new(&[1]).take(&Layout::Again(1)).is_err());
}

#[test]
fn a_count_that_lies_is_no_value() {
    let bytes = postcard::to_stdvec(&u64::MAX).expect("it can be written");
    for item in [Layout::Unit, Layout::Unsigned(8), Layout::Text] {
        assert!(Values::new(&bytes).take(&list(item)).is_err());
    }
}

#[test]
fn parts_without_bytes_are_counted_wherever_they_stand() {
    let wide = Layout::Tuple(vec![Layout::Unit; 1000]);
    let bytes = postcard::to_stdvec(&60_000_u64).expect("it can be written");
    assert!(Values::new(&bytes).skip(&list(wide.clone())).is_err());
    let mut values = Values::new(&[]);
    assert!((0..1000).any(|_| values.skip(&wide).is_err()));
}

#[test]
fn a_number_of_more_bits_than_there_are_is_no_value() {
    let endless = [0xff; 40];
    for layout in [Layout::Unsigned(255), Layout::Signed(255)] {
        assert!(Values::new(&endless).take(&layout).is_err());
    }
}

#[test]
fn what_changed_is_named() {
    let part = |layout| Part {
        name: "control::walk".to_owned(),
        kind: PartKind::Node,
        layout,
    };
    let was = [part(tree())];
    assert_eq!(first_difference(&was, &was), None);
    let text = |is: Layout| first_difference(&was, &[part(is)]).expect("it differs");
    let Layout::Struct(mut changed) = tree() else {
        panic!("it is a struct");
    };
    changed.fields[0].1 = Layout::Float(32);
    assert_eq!(
        text(Layout::Struct(changed.clone())),
        "`control::walk.weight` was i16, is f32"
    );
    changed.fields[0].0 = "mass".to_owned();
    assert_eq!(
        text(Layout::Struct(changed)),
        "the field `weight` of `control::walk` is gone"
    );
    assert_eq!(first_difference(&[part(Layout::Unknown)], &was), None);
    assert_eq!(
        text(Layout::Unknown),
        "`control::walk` was the struct `Tree`, is unknown"
    );
    assert_eq!(
        first_difference(&was, &[]).as_deref(),
        Some("`control::walk` is gone")
    );
    assert_ne!(Layout::digest(&was), Layout::digest(&[]));
}
