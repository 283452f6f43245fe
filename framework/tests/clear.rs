//! Back to default, heap capacity kept.

#![expect(clippy::disallowed_types, reason = "authors may exchange hash maps")]

use std::collections::{BTreeMap, HashMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use framework::Clear;
use framework::time::Timestamp;
use nalgebra::{Isometry3, Matrix3, Point2, UnitQuaternion, Vector3};

#[derive(Clear, Clone, Debug, Default, PartialEq)]
struct Image {
    width: u32,
    data: Vec<u8>,
    name: String,
    lines: Vec<Vec<u8>>,
    queue: VecDeque<u8>,
    times: HashMap<String, Timestamp>,
}

#[derive(Clear, Clone, Debug, Default, PartialEq)]
enum Mode {
    Fast(Vec<u8>),
    #[default]
    Still,
}

#[derive(Clear, Clone, Debug, Default, PartialEq)]
struct Everything<T> {
    image: Image,
    mode: Mode,
    pair: (bool, Vec<u8>),
    array: [Vec<u8>; 2],
    maybe: Option<Vec<u8>>,
    boxed: Box<Image>,
    shared: Arc<Image>,
    sorted: BTreeMap<u8, u8>,
    pose: Isometry3<f32>,
    rotation: UnitQuaternion<f32>,
    vector: Vector3<f32>,
    matrix: Matrix3<f64>,
    point: Point2<f32>,
    duration: Duration,
    other: T,
}

#[derive(Clear, Clone, Debug, Default, PartialEq)]
struct Tuple(Vec<u8>, f32);

#[derive(Clear, Clone, Copy, Debug, Default, PartialEq)]
struct Nothing;

/// A type whose default is not that of its fields.
#[derive(Clear, Clone, Debug, PartialEq)]
struct Camera {
    focal: f32,
    mask: Vec<u8>,
    table: [u8; 40],
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            focal: 1.0,
            mask: vec![1, 2],
            table: [3; 40],
        }
    }
}

fn image() -> Image {
    Image {
        width: 640,
        data: vec![1; 1000],
        name: "top camera".repeat(10),
        lines: vec![vec![1; 100]; 10],
        queue: VecDeque::from(vec![1; 50]),
        times: HashMap::from([("a".to_owned(), Timestamp::NEVER)]),
    }
}

fn everything() -> Everything<Camera> {
    Everything {
        image: image(),
        mode: Mode::Fast(vec![1]),
        pair: (true, vec![1; 100]),
        array: [vec![1; 100], vec![1; 100]],
        maybe: Some(vec![1]),
        boxed: Box::new(image()),
        shared: Arc::new(image()),
        sorted: BTreeMap::from([(1, 2)]),
        pose: Isometry3::translation(1.0, 2.0, 3.0),
        rotation: UnitQuaternion::from_euler_angles(1.0, 0.0, 0.0),
        vector: Vector3::new(1.0, 2.0, 3.0),
        matrix: Matrix3::identity(),
        point: Point2::new(1.0, 2.0),
        duration: Duration::from_secs(1),
        other: Camera {
            focal: 2.0,
            mask: vec![9; 100],
            table: [0; 40],
        },
    }
}

#[test]
fn a_cleared_value_is_the_default() {
    let mut value = everything();
    value.clear();
    assert_eq!(value, Everything::default());
    let mut tuple = Tuple(vec![1], 2.0);
    tuple.clear();
    assert_eq!(tuple, Tuple::default());
    Nothing.clear();
}

#[test]
fn heap_capacity_is_kept() {
    let mut value = everything();
    let data = value.image.data.as_ptr();
    let boxed: *const Image = &*value.boxed;
    value.clear();
    assert_eq!(value.image.data.as_ptr(), data);
    assert_eq!(&raw const *value.boxed, boxed);
    for capacity in [
        value.image.data.capacity(),
        value.image.name.capacity(),
        value.image.queue.capacity(),
        value.pair.1.capacity(),
        value.array[1].capacity(),
        value.boxed.data.capacity(),
        value.shared.data.capacity(),
        value.other.mask.capacity(),
    ] {
        assert!(capacity >= 50, "{capacity}");
    }
}

#[test]
fn what_others_share_is_left_to_them() {
    let mut value = everything();
    let other = Arc::clone(&value.shared);
    value.clear();
    assert_eq!((&*value.shared, &*other), (&Image::default(), &image()));
}

#[test]
fn content_takes_content_without_a_new_allocation() {
    let mut place = Some(vec![1_u8; 100]);
    let before = place.as_ref().map(Vec::as_ptr);
    place.assign(Some(vec![2]));
    assert_eq!(
        (place.as_ref().map(Vec::as_ptr), &place),
        (before, &Some(vec![2]))
    );
    place.assign(None);
    assert_eq!(place, None);
    place.assign(Some(vec![3]));
    assert_eq!(place, Some(vec![3]));
}
