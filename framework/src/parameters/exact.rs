//! Values as trees of what TOML can say, exactly: JSON has no word for numbers that are not finite.

mod serializer;

use serde::ser::Serialize;

use super::error::Origin;
use super::tree::{Layer, Tree, Value};
use crate::error::{Error, Result};
use crate::reflect::{self, Path, Reflect};

/// The whole value.
pub(super) fn of(value: &dyn Reflect) -> Result<Tree> {
    let written = value.as_serialize().serialize(serializer::Exactly);
    written.map_err(|error| Error::new(error.to_string()))
}

/// A part of it; `None` where it is not there.
pub(super) fn part(value: &dyn Reflect, path: &Path) -> Option<Tree> {
    of(reflect::at(value, path).ok()?).ok()
}

/// The first finite number that became none: its type is too small for it.
///
/// Gives its path and what it was.
pub(super) fn too_large(given: &Tree, held: &Tree) -> Option<(String, f64)> {
    match (&given.value, &held.value) {
        (Value::Table(given), Value::Table(held)) => given.iter().find_map(|(key, given)| {
            let found = too_large(given, held.get(key)?)?;
            Some(below(key, found))
        }),
        (Value::Array(given), Value::Array(held)) => {
            let mut pairs = given.iter().zip(held).enumerate();
            pairs.find_map(|(index, (given, held))| {
                Some(below(&index.to_string(), too_large(given, held)?))
            })
        }
        (_, Value::Float(held)) if !held.is_finite() => {
            let number = given.as_number()?;
            exceeds_32_bits(number).then(|| (String::new(), number))
        }
        _ => None,
    }
}

fn below(key: &str, (path, number): (String, f64)) -> (String, f64) {
    let path = match path.as_str() {
        "" => key.to_owned(),
        _ => format!("{key}.{path}"),
    };
    (path, number)
}

#[expect(clippy::cast_possible_truncation, reason = "that is the question")]
fn exceeds_32_bits(number: f64) -> bool {
    number.is_finite() && (number as f32).is_infinite()
}

/// What is wrong with the number that [`too_large`] found.
pub(super) fn is_too_large(number: f64) -> String {
    format!("{number:?} is outside of what f32 holds")
}

/// As TOML writes it, which Rust does not.
pub(super) fn float_text(float: f64) -> String {
    match float.is_nan() {
        true => "nan".to_owned(),
        false => format!("{float:?}"),
    }
}

impl From<Value> for Tree {
    /// Of no layer.
    fn from(value: Value) -> Self {
        Self {
            origin: Origin::Unknown,
            layer: Layer::default(),
            value,
        }
    }
}

impl Tree {
    pub(super) fn from_json(json: &serde_json::Value) -> Self {
        Self::from(match json {
            serde_json::Value::Null => Value::Absent,
            serde_json::Value::Bool(flag) => Value::Boolean(*flag),
            serde_json::Value::String(text) => Value::String(text.clone()),
            serde_json::Value::Number(number) => match (number.as_i128(), number.as_f64()) {
                (Some(integer), _) => Value::Integer(integer),
                (None, Some(float)) => Value::Float(float),
                (None, None) => Value::Absent,
            },
            serde_json::Value::Array(items) => {
                Value::Array(items.iter().map(Self::from_json).collect())
            }
            serde_json::Value::Object(entries) => {
                let entries = entries.iter();
                let entries = entries.map(|(key, value)| (key.clone(), Self::from_json(value)));
                Value::Table(entries.collect())
            }
        })
    }

    /// With a text where JSON has no number.
    pub(super) fn to_json(&self) -> serde_json::Value {
        match &self.value {
            Value::Absent => serde_json::Value::Null,
            Value::Boolean(flag) => (*flag).into(),
            Value::String(text) | Value::Datetime(text) => text.as_str().into(),
            Value::Integer(integer) => {
                let number = serde_json::Number::from_i128(*integer);
                number.map_or(serde_json::Value::Null, serde_json::Value::Number)
            }
            Value::Float(float) => match serde_json::Number::from_f64(*float) {
                Some(number) => serde_json::Value::Number(number),
                None => float_text(*float).into(),
            },
            Value::Array(items) => items.iter().map(Self::to_json).collect(),
            Value::Table(entries) => {
                let entries = entries.iter();
                let entries = entries.map(|(key, tree)| (key.clone(), tree.to_json()));
                serde_json::Value::Object(entries.collect())
            }
        }
    }

    /// Whether it is the same value, wherever it comes from; what is no number is the same as itself.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        match (&self.value, &other.value) {
            (Value::Table(one), Value::Table(other)) => {
                let mut pairs = one.iter().zip(other);
                one.len() == other.len()
                    && pairs.all(|(one, other)| one.0 == other.0 && one.1.is_same(other.1))
            }
            (Value::Array(one), Value::Array(other)) => {
                let mut pairs = one.iter().zip(other);
                one.len() == other.len() && pairs.all(|(one, other)| one.is_same(other))
            }
            (Value::Float(one), Value::Float(other)) => {
                one == other || (one.is_nan() && other.is_nan())
            }
            (Value::Integer(one), Value::Integer(other)) => one == other,
            (Value::Boolean(one), Value::Boolean(other)) => one == other,
            (Value::String(one), Value::String(other))
            | (Value::Datetime(one), Value::Datetime(other)) => one == other,
            (Value::Absent, Value::Absent) => true,
            _ => false,
        }
    }

    #[expect(
        clippy::cast_precision_loss,
        reason = "large ones are only compared with larger ones"
    )]
    fn as_number(&self) -> Option<f64> {
        match self.value {
            Value::Float(float) => Some(float),
            Value::Integer(integer) => Some(integer as f64),
            _ => None,
        }
    }
}
