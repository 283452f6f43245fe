//! Values that somebody outside of the robot gives it: a client, a scenario, a test.

use std::borrow::Cow;

use serde::de::DeserializeOwned;

use super::deserialize::Node;
use super::error::Origin;
use super::tree::Tree;
use crate::error::{Error, Result};

/// One such value, not yet of any type.
///
/// It is a tree of one type whatever it was written in, so that types are compiled once for all formats.
#[derive(Clone, Debug)]
pub struct Given<'tree>(Cow<'tree, Tree>);

impl<'tree> Given<'tree> {
    pub(super) fn of(tree: &'tree Tree) -> Self {
        Self(Cow::Borrowed(tree))
    }

    pub(super) fn tree(&self) -> &Tree {
        &self.0
    }

    /// The type that it stands for; an error has a [`Refusal`](super::Refusal) of the part that is wrong.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T> {
        T::deserialize(Node::of(&self.0)).map_err(|mistake| Error::from(mistake.refusal()))
    }
}

impl From<&serde_json::Value> for Given<'_> {
    fn from(json: &serde_json::Value) -> Self {
        Self(Cow::Owned(Tree::from_json(json)))
    }
}

/// Where numbers need not be finite, as in JSON they must.
impl From<&toml::Value> for Given<'_> {
    fn from(toml: &toml::Value) -> Self {
        Self(Cow::Owned(Tree::from_value(toml, &Origin::Unknown)))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde::Deserialize;
    use serde_json::{Value, json};

    use super::*;

    #[derive(Debug, PartialEq, Deserialize)]
    enum Motion {
        Stand,
        Walk { speed: f32 },
        Turn(f64),
        Look(i8, i8),
    }

    #[derive(Debug, PartialEq, Deserialize)]
    struct All {
        motion: Motion,
        by_number: BTreeMap<u8, Option<char>>,
        by_flag: BTreeMap<bool, ()>,
        largest: u64,
        least: i64,
    }

    fn given<T: DeserializeOwned>(json: Value) -> Result<T, String> {
        let read = Given::from(&json).read();
        read.map_err(|error| error.to_string())
    }

    /// As serde_json itself reads it.
    #[test]
    fn what_json_says_is_read() {
        let motions = [
            json!("Stand"),
            json!({ "Stand": null }),
            json!({ "Walk": { "speed": 1 } }),
            json!({ "Turn": 0.5 }),
            json!({ "Look": [1, -2] }),
        ];
        for motion in motions {
            let all = json!({
                "motion": motion,
                "by_number": { "7": null, "255": "a" },
                "by_flag": { "true": null },
                "largest": u64::MAX,
                "least": i64::MIN,
            });
            let by_json: All = serde_json::from_value(all.clone()).expect("JSON for this type");
            assert_eq!(given(all), Ok(by_json));
        }
    }

    #[test]
    fn toml_has_numbers_that_are_not_finite() {
        let given = Given::from(&toml::Value::Float(f64::NEG_INFINITY));
        assert_eq!(given.read().ok(), Some(f32::NEG_INFINITY));
    }

    /// Of what lies deep and is large nothing is copied at each step.
    #[test]
    fn what_is_no_variant_is_told_at_once() {
        let mut deep = Value::from(vec![0; 100_000]);
        for _ in 0..100 {
            deep = json!({ "Turn": deep });
        }
        let message = given::<Motion>(deep).expect_err("it is none");
        assert_eq!(message, "`Turn`: expected f64, found map");
    }

    #[test]
    fn mistakes_name_their_place() {
        let message = |json| given::<All>(json).expect_err("it is none");
        let numbers = json!({ "256": null });
        let all = json!({ "motion": "Stand", "by_number": numbers });
        let too_large = "`by_number.256`: invalid value: integer `256`, expected u8";
        assert_eq!(message(all), too_large);
        for number in ["+7", "07", "-0", "seven"] {
            let numbers = json!({ number: null });
            let all = json!({ "motion": "Stand", "by_number": numbers });
            let wrong = format!("`by_number.{number}`: expected u8, found string \"{number}\"");
            assert_eq!(message(all), wrong);
        }
        let all = json!({ "motion": { "Walk": { "speed": "fast" } } });
        let wrong = "`motion.Walk.speed`: expected f32, found string \"fast\"";
        assert_eq!(message(all), wrong);
        assert_eq!(
            message(json!({ "motion": "Stand" })),
            "`by_number`: is missing"
        );
        let flies = message(json!({ "motion": "Wlak" }));
        assert!(flies.starts_with("`motion`: "), "{flies}");
        let nothing = |wanted| format!("expected {wanted}, found nothing");
        assert_eq!(given::<f32>(json!(null)), Err(nothing("f32")));
        let table = given::<toml::Table>(json!(null));
        assert_eq!(table.map(drop), Err(nothing("a map")));
    }
}
