//! Which words are wrong, by type.

use serde::{Deserialize, Serialize};

use super::*;
use crate::Reflect;

#[derive(Deserialize, Reflect, Serialize)]
#[serde(rename_all = "snake_case")]
enum Motion {
    StandUp,
    Walk { side: Side },
    Kick(Side),
    Look(f32),
}

#[derive(Deserialize, Reflect, Serialize)]
enum Side {
    Left,
    Right,
}

#[derive(Deserialize, Reflect, Serialize)]
struct Both {
    first: Side,
    others: Vec<Option<Side>>,
    pair: (u8, Side),
    name: String,
}

#[derive(Deserialize, Reflect, Serialize)]
#[serde(untagged)]
enum Either {
    Side(Side),
    Name(String),
}

fn wrong<T: Reflect>(toml: &str) -> Option<String> {
    let table: toml::Table = format!("v = {toml}").parse().expect("it is TOML");
    let value = serde_json::to_value(&table["v"]).expect("it has JSON");
    wrong_word(&T::shape(), &value)
}

#[test]
fn words_that_the_type_has_are_right() {
    for right in [
        "'stand_up'",
        "{ walk = { side = 'Left' } }",
        "{ kick = 'Right' }",
        "{ look = 0.5 }",
        // Of another type: that is no word.
        "3",
    ] {
        assert_eq!(wrong::<Motion>(right), None, "{right}");
        assert_eq!(wrong::<Option<Motion>>(right), None, "{right}");
    }
    let both = "{ first = 'Left', others = ['Right'], pair = [1, 'Left'], name = 'Lfet' }";
    assert_eq!(wrong::<Both>(both), None);
    assert_eq!(wrong::<String>("'anything'"), None);
    assert_eq!(wrong::<Either>("'anything'"), None);
}

#[test]
fn words_that_no_variant_has_are_told_with_the_nearest() {
    for (toml, expected) in [
        ("'StandUp'", "is never `StandUp`; did you mean `stand_up`?"),
        (
            "'dance'",
            "is never `dance`; there are stand_up, walk, kick, look",
        ),
        (
            "{ walk = { side = 'left' } }",
            "is never `left`; did you mean `Left`?",
        ),
        (
            "{ kick = 'Rihgt' }",
            "is never `Rihgt`; did you mean `Right`?",
        ),
        ("{ walks = {} }", "is never `walks`; did you mean `walk`?"),
        (
            "'walk'",
            "is never `walk` alone: say what is in it, { walk = … }",
        ),
        (
            "{ stand_up = 1 }",
            "is never `stand_up` with something in it: write \"stand_up\"",
        ),
    ] {
        assert_eq!(wrong::<Motion>(toml).as_deref(), Some(expected), "{toml}");
        assert_eq!(
            wrong::<Vec<Option<Motion>>>(&format!("[{toml}]")).as_deref(),
            Some(expected),
            "{toml}"
        );
    }
    for toml in [
        "{ first = 'Lefft' }",
        "{ others = ['Left', 'Lefft'] }",
        "{ pair = [0, 'Lefft'] }",
    ] {
        let told = wrong::<Both>(toml);
        let expected = "is never `Lefft`; did you mean `Left`?";
        assert_eq!(told.as_deref(), Some(expected), "{toml}");
    }
}

#[derive(Deserialize, Reflect, Serialize)]
struct Open {
    side: Side,
    #[serde(flatten)]
    others: std::collections::BTreeMap<String, u32>,
}

#[derive(Deserialize, Reflect, Serialize)]
enum Kept {
    Open(Open),
    Not,
}

/// Lies in itself.
#[derive(Deserialize, Reflect, Serialize)]
enum Sum {
    Number(f32),
    Negative(Box<Sum>),
    Both(Box<Sum>, Box<Sum>),
}

#[test]
fn paths_that_the_type_does_not_have_are_wrong_unless_it_may_have_more() {
    let told = |shape: &Shape, path: &str| {
        let path = path.parse().expect("is a path");
        shape
            .known_at(&path)
            .map(|found| found.err().map(|unknown| unknown.to_string()))
    };
    let motion = Option::<Motion>::shape();
    assert_eq!(told(&motion, "walk.side"), Some(None));
    let wrong = told(&motion, "walk.sied").flatten();
    assert_eq!(wrong.as_deref(), Some("no `sied`: `walk` has `side`"));
    assert_eq!(told(&Open::shape(), "side"), Some(None));
    assert_eq!(told(&Open::shape(), "sied"), None);
    assert_eq!(told(&Vec::<Option<Open>>::shape(), "0.sied"), None);
    assert_eq!(told(&Option::<Kept>::shape(), "sied"), None);
    assert_eq!(told(&Sum::shape(), "Both.0.Negative"), Some(None));
    assert!(told(&Sum::shape(), "Both.0.sied").flatten().is_some());
    let opaque = Shape::leaf::<Side>(crate::reflect::Leaf::Opaque);
    assert_eq!(told(&opaque, "side"), None);
}

#[test]
fn an_instance_that_there_is_not_is_told_with_the_nearest() {
    let told = |name| unknown_instance(name, &["VisionTop", "Control"]);
    assert_eq!(
        told("Contrl"),
        "is of no instance: there is no `Contrl`; did you mean `Control`?"
    );
    assert_eq!(
        told("Nobody"),
        "is of no instance: there is no `Nobody`; there are VisionTop, Control"
    );
}
