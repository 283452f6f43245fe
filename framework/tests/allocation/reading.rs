//! What a client subscribes to is found and written without allocating.

use std::collections::BTreeMap;

use framework::Reflect;
use framework::reflect::ResolvedPath;
use framework::reflect::binary::encode_as;
use nalgebra::{Isometry3, Point2};
use serde::{Deserialize, Serialize};

use crate::counting::allocations;

#[derive(Deserialize, Reflect, Serialize)]
struct Database {
    spots: Vec<Spot>,
    rooms: BTreeMap<String, Spot>,
    pose: Option<Isometry3<f32>>,
    kind: Kind,
    tagged: Tagged,
    name: String,
}

#[derive(Clone, Deserialize, Reflect, Serialize)]
struct Spot {
    position: Point2<f32>,
    label: String,
}

#[derive(Deserialize, Reflect, Serialize)]
enum Kind {
    Near(Spot),
}

/// Without a layout of its own.
#[derive(Deserialize, Reflect, Serialize)]
#[serde(tag = "kind")]
enum Tagged {
    Far { spot: Spot },
}

#[test]
fn a_standing_subscription_allocates_nothing() {
    let spot = Spot {
        position: Point2::new(1.0, 2.0),
        label: "spot".into(),
    };
    let database = Database {
        spots: vec![spot.clone(), spot.clone()],
        rooms: BTreeMap::from([("7".to_owned(), spot.clone())]),
        pose: Some(Isometry3::identity()),
        kind: Kind::Near(spot.clone()),
        tagged: Tagged::Far { spot },
        name: "database".into(),
    };
    let shape = Database::shape();
    let paths = [
        "",
        "spots.1.position.x",
        "rooms.7.label",
        "pose.translation",
        "kind.Near.position",
        "tagged",
        "tagged.spot.label",
        "name",
    ];
    let resolved = paths.map(|path| {
        let path = path.parse().expect("it is a path");
        ResolvedPath::new(&shape, &path).expect("it is there")
    });
    let mut bytes = Vec::new();
    let mut cycle = || {
        bytes.clear();
        for path in &resolved {
            let part = path.find(&database).expect("it is there");
            encode_as(path.shape(), part, &mut bytes).expect("it has a binary form");
        }
        bytes.len()
    };
    let first = cycle();
    let before = allocations();
    assert_eq!(cycle(), first);
    assert_eq!(allocations(), before);
}
