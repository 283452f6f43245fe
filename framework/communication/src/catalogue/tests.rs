//! What types are called, and that lists agree with each other and with what can be looked up.

use framework::Reflect;
use serde::{Deserialize, Serialize};

use super::*;

#[test]
fn types_are_named_without_their_modules() {
    for (long, expected) in [
        ("f32", "f32"),
        ("alloc::vec::Vec<types::ball::Ball>", "Vec<Ball>"),
        ("core::option::Option<[f32; 3]>", "Option<[f32; 3]>"),
        ("(a::B, &c::D)", "(B, &D)"),
    ] {
        assert_eq!(short(long), expected);
    }
}

#[derive(Deserialize, Reflect, Serialize)]
enum Phase {
    Stand,
    Walk { side: Side, step: [f32; 2] },
    Kick(Side),
    Both(u8, Option<Side>),
}

#[derive(Deserialize, Reflect, Serialize)]
struct Side {
    is_left: bool,
}

fn listed(path: &str, shape: &Shape, depth: usize) -> Vec<String> {
    let mut listing = Listing {
        entries: Vec::new(),
        most: 100,
    };
    listing.below_shape(path, EntryKind::MainOutput, shape, Told::default(), depth);
    listing
        .entries
        .into_iter()
        .map(|entry| entry.path)
        .collect()
}

#[test]
fn lists_level_by_level_have_what_the_whole_list_has_and_all_of_it_is_there() {
    let shape = Option::<Phase>::shape();
    let mut all = listed("phase", &shape, 9);
    let mut found: Vec<String> = Vec::new();
    let mut next = vec!["phase".to_owned()];
    while let Some(path) = next.pop() {
        let below: Path = path
            .split_once('.')
            .map_or("", |(_, below)| below)
            .parse()
            .expect("it is a path");
        let inside = shape.inside(&below).expect("it is listed, so it is there");
        assert!(shape.at(&below).is_ok(), "{path}");
        next.extend(inside.iter().flat_map(|shape| listed(&path, shape, 1)));
        found.push(path);
        assert!(found.len() < 100, "{found:?}");
    }
    found.retain(|path| path != "phase");
    found.sort();
    all.sort();
    assert_eq!(found, all);
    assert!(found.contains(&"phase.Walk.side.is_left".to_owned()));
}
