//! Where the numbers of a field must lie: `#[reflect(range = 0.0..=1.0)]`.

use std::fmt;

use serde::Serialize;
use serde_json::Value;

use super::lookup::fields_of;
use super::{Content, Form, Leaf, Shape, VariantContent, VariantShape};

/// An interval of numbers; a bound that is not there does not limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limits {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub minimum: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub maximum: Option<f64>,
    /// Whether the maximum itself is outside.
    pub is_half_open: bool,
}

/// A number that lies outside of its field's range.
#[derive(Clone, Debug, PartialEq)]
pub struct OutOfRange {
    /// From the value downwards, as a path names it; empty for the value itself.
    pub path: String,
    /// As JSON shows it, and files `inf` and `nan`.
    pub found: String,
    pub limits: Limits,
}

impl Limits {
    /// Whether a number lies in it.
    pub fn contains(&self, number: f64) -> bool {
        let is_above = self.minimum.is_none_or(|minimum| number >= minimum);
        let is_below = self
            .maximum
            .is_none_or(|maximum| number < maximum || (number == maximum && !self.is_half_open));
        is_above && is_below
    }

    /// With bounds as an `f32` has them, so that `0.1` is within `..=0.1`.
    pub(super) fn rounded(&self) -> Self {
        Self {
            minimum: self.minimum.map(rounded),
            maximum: self.maximum.map(rounded),
            is_half_open: self.is_half_open,
        }
    }
}

impl Shape {
    /// Every number of a value of this shape, given as JSON, that lies outside of the range of its field.
    ///
    /// `limits` are those of the field that holds the value. A number that is not finite may be a text.
    pub fn out_of_range(&self, value: &Value, limits: Option<Limits>) -> Vec<OutOfRange> {
        let mut search = Search::default();
        search.look(self, value, limits);
        search.found
    }
}

#[derive(Default)]
struct Search {
    path: Vec<String>,
    found: Vec<OutOfRange>,
}

impl Search {
    fn look(&mut self, shape: &Shape, value: &Value, limits: Option<Limits>) {
        match (&shape.content, value) {
            (Content::Leaf(leaf), _) => self.judge(*leaf, value, limits),
            (Content::Option(_) | Content::Recursive(_), Value::Null) => {}
            (Content::Option(_) | Content::Recursive(_), _) => {
                if let Some(opened) = shape.opened() {
                    self.look(&opened, value, limits);
                }
            }
            (Content::List { item, .. } | Content::Set(item), Value::Array(items)) => {
                for (index, value) in items.iter().enumerate() {
                    self.below(&index.to_string(), item, value, limits);
                }
            }
            (Content::Tuple(shapes), Value::Array(items)) => {
                for (index, (shape, value)) in shapes.iter().zip(items).enumerate() {
                    self.below(&index.to_string(), shape, value, limits);
                }
            }
            (Content::Map(inner), Value::Object(entries)) => {
                for (key, value) in entries {
                    self.below(key, inner, value, limits);
                }
            }
            (Content::Struct(fields), Value::Object(entries)) => {
                for field in fields {
                    if let Some(value) = entries.get(field.name) {
                        self.below(field.name, &field.shape, value, field.range.or(limits));
                    }
                }
            }
            (Content::Enum(variants), _) => self.look_into_variant(shape, variants, value, limits),
            _ => {}
        }
    }

    fn look_into_variant(
        &mut self,
        shape: &Shape,
        variants: &[VariantShape],
        value: &Value,
        limits: Option<Limits>,
    ) {
        let named = |name: Option<&str>| variants.iter().find(|it| Some(it.name) == name);
        let tagged = |tag| named(value.get(tag).and_then(Value::as_str));
        let (variant, content) = match shape.form {
            Form::Plain => match value.as_object().and_then(|entries| entries.iter().next()) {
                Some((name, content)) => (named(Some(name)), Some(content)),
                None => return,
            },
            Form::Tagged { tag } => (tagged(tag), Some(value)),
            Form::Adjacent { tag, content } => (tagged(tag), value.get(content)),
            // Which variant it is cannot be told.
            Form::Untagged | Form::Open => return,
        };
        let (Some(variant), Some(content)) = (variant, content) else {
            return;
        };
        let inside = match &variant.content {
            VariantContent::Unit => return,
            VariantContent::Value(inside) => inside.clone(),
            VariantContent::Fields(fields) => fields_of(shape, fields),
        };
        match shape.form {
            Form::Tagged { .. } => self.look(&inside, content, limits),
            _ => self.below(variant.name, &inside, content, limits),
        }
    }

    fn below(&mut self, name: &str, shape: &Shape, value: &Value, limits: Option<Limits>) {
        self.path.push(name.to_owned());
        self.look(shape, value, limits);
        self.path.pop();
    }

    fn judge(&mut self, leaf: Leaf, value: &Value, limits: Option<Limits>) {
        let Some(limits) = limits else {
            return;
        };
        let (number, exact) = match leaf {
            Leaf::Float { bits: 32 } => (value.as_f64().map(rounded), limits.rounded()),
            Leaf::Float { .. } | Leaf::Signed { .. } | Leaf::Unsigned { .. } => {
                (value.as_f64(), limits)
            }
            Leaf::Duration => (seconds(value), limits),
            Leaf::Bool | Leaf::Character | Leaf::Opaque | Leaf::Text | Leaf::Unit => return,
        };
        // Without a number it is NaN or infinite.
        if !number.is_some_and(|number| exact.contains(number)) {
            self.found.push(OutOfRange {
                path: self.path.join("."),
                found: value
                    .as_str()
                    .map_or_else(|| value.to_string(), str::to_owned),
                limits,
            });
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "that is what is wanted")]
fn rounded(number: f64) -> f64 {
    f64::from(number as f32)
}

fn seconds(duration: &Value) -> Option<f64> {
    let part = |name| duration.get(name).and_then(Value::as_f64);
    Some(part("secs")? + part("nanos")? * 1e-9)
}

impl fmt::Display for Limits {
    /// As Rust writes a range.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(minimum) = self.minimum {
            write!(formatter, "{minimum}")?;
        }
        let is_closed = self.maximum.is_some() && !self.is_half_open;
        formatter.write_str(if is_closed { "..=" } else { ".." })?;
        match self.maximum {
            Some(maximum) => write!(formatter, "{maximum}"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { found, limits, .. } = self;
        write!(formatter, "{found} is outside of {limits}")
    }
}
