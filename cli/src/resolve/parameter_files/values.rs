//! Values that cannot be what a node reads, as far as their types can be seen.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

use super::expected::Expected;
use crate::diagnostics::{listed, nearest};
use crate::scan::Sources;
use crate::scan::types::{Definition, Resolved, Shape};

/// A value of the wrong type.
pub(super) struct Mistake {
    /// Follows the parameter's path: "is a string, not a number".
    pub(super) message: String,
    pub(super) place: Range<usize>,
    pub(super) help: Option<String>,
}

/// What is wrong with a value; `None` also where that cannot be seen.
pub(super) fn mistake(
    value: &Spanned<DeValue<'_>>,
    expected: &Expected<'_>,
    sources: &Sources<'_>,
) -> Option<Mistake> {
    match expected {
        Expected::Tree(_) if value.get_ref().is_table() => None,
        Expected::Tree(_) => Some(wrong(value, "a table")),
        Expected::Value(data) => check(value, data, sources),
    }
}

fn check(value: &Spanned<DeValue<'_>>, data: &Resolved, sources: &Sources<'_>) -> Option<Mistake> {
    match &data.shape {
        Shape::Named {
            definition: Definition::Prelude(name),
            arguments,
        } => match (name.as_str(), arguments.as_slice()) {
            ("Option" | "Box", [inner]) => check(value, inner, sources),
            ("Vec", [element]) => check_elements(value, element, sources),
            (name, _) => check_primitive(value, name),
        },
        Shape::Named {
            definition: Definition::Workspace(_),
            ..
        } => {
            if let Some(variants) = sources.library.unit_variants(data) {
                return check_variant(value, &variants);
            }
            let is_struct = Expected::Value(data.clone()).children(sources).is_some();
            match value.get_ref().as_table() {
                Some(table) => check_element(value, table, data, sources),
                None => is_struct.then(|| wrong(value, "a table")),
            }
        }
        Shape::Array(element, length) => {
            let items = value.get_ref().as_array().map(|items| items.len());
            match (&length.shape, items) {
                (Shape::Constant(length), Some(items)) if length.parse() != Ok(items) => {
                    Some(Mistake {
                        message: format!("has {items} elements, not {length}"),
                        place: value.span(),
                        help: None,
                    })
                }
                _ => check_elements(value, element, sources),
            }
        }
        Shape::Tuple(parts) => {
            let Some(items) = value.get_ref().as_array() else {
                return Some(wrong(value, "an array"));
            };
            if items.len() != parts.len() {
                return Some(wrong(value, &format!("an array of {}", parts.len())));
            }
            items
                .iter()
                .zip(parts)
                .find_map(|(item, part)| check(item, part, sources))
        }
        _ => None,
    }
}

fn check_elements(
    value: &Spanned<DeValue<'_>>,
    element: &Resolved,
    sources: &Sources<'_>,
) -> Option<Mistake> {
    let Some(items) = value.get_ref().as_array() else {
        return Some(wrong(value, "an array"));
    };
    items.iter().find_map(|item| check(item, element, sources))
}

/// A table within an array: no other file adds to it, so it is whole.
fn check_element(
    value: &Spanned<DeValue<'_>>,
    table: &DeTable<'_>,
    data: &Resolved,
    sources: &Sources<'_>,
) -> Option<Mistake> {
    let children = Expected::Value(data.clone()).children(sources)?;
    for (key, value) in table {
        let name = key.get_ref();
        let Some(child) = children.get(name.as_ref()) else {
            let near = nearest(name, children.keys().map(String::as_str));
            return Some(Mistake {
                message: format!("has an element with `{name}`, which nobody declares"),
                place: key.span(),
                help: Some(near.map_or_else(
                    || "remove it".to_owned(),
                    |near| format!("did you mean `{near}`?"),
                )),
            });
        };
        if let Some(mistake) = mistake(value, &child.expected, sources) {
            return Some(mistake);
        }
    }
    let lacking = children.iter().find(|(name, child)| {
        child.required && !child.names(name).any(|name| table.contains_key(name))
    });
    lacking.map(|(name, _)| Mistake {
        message: format!("has an element without `{name}`"),
        place: value.span(),
        help: Some(format!("add `{name} = …` to it")),
    })
}

/// Whether [`mistake`] knows what this type of the prelude takes.
pub(super) fn is_checked(name: &str) -> bool {
    matches!(name, "bool" | "char" | "f32" | "f64" | "String") || limits(name).is_some()
}

fn check_primitive(value: &Spanned<DeValue<'_>>, name: &str) -> Option<Mistake> {
    let expected = match (name, value.get_ref()) {
        ("bool", DeValue::Boolean(_))
        | ("String", DeValue::String(_))
        | ("f32" | "f64", DeValue::Float(_) | DeValue::Integer(_)) => return None,
        ("bool", _) => "true or false",
        ("String", _) => "a string",
        ("f32" | "f64", _) => "a number",
        ("char", DeValue::String(text)) if text.chars().count() == 1 => return None,
        ("char", _) => "a string of one character",
        (integer, DeValue::Integer(number)) => match limits(integer) {
            Some((least, greatest)) if !(least..=greatest).contains(&parse(number)?) => {
                return Some(Mistake {
                    message: format!("does not fit into a `{integer}`"),
                    place: value.span(),
                    help: Some(format!("write a number from {least} to {greatest}")),
                });
            }
            _ => return None,
        },
        (integer, _) => {
            limits(integer)?;
            "a whole number"
        }
    };
    Some(wrong(value, expected))
}

fn check_variant(value: &Spanned<DeValue<'_>>, variants: &[String]) -> Option<Mistake> {
    let Some(name) = value.get_ref().as_str() else {
        return Some(wrong(value, "a string"));
    };
    if variants.iter().any(|variant| variant == name) {
        return None;
    }
    let names = || variants.iter().map(String::as_str);
    let help = match nearest(name, names()) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => format!("write one of {}", listed(names())),
    };
    Some(Mistake {
        message: format!("has no variant `{name}`"),
        place: value.span(),
        help: Some(help),
    })
}

fn wrong(value: &Spanned<DeValue<'_>>, expected: &str) -> Mistake {
    Mistake {
        message: format!("is {}, not {expected}", described(value.get_ref())),
        place: value.span(),
        help: Some(format!("write {expected}")),
    }
}

fn described(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a string",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "a boolean",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "an array",
        DeValue::Table(_) => "a table",
    }
}

fn parse(number: &DeInteger<'_>) -> Option<i128> {
    i128::from_str_radix(number.as_str(), number.radix()).ok()
}

/// TOML's integers have 64 bits with a sign.
fn limits(integer: &str) -> Option<(i128, i128)> {
    let (least, greatest) = match integer {
        "i8" => (i128::from(i8::MIN), i128::from(i8::MAX)),
        "i16" => (i128::from(i16::MIN), i128::from(i16::MAX)),
        "i32" => (i128::from(i32::MIN), i128::from(i32::MAX)),
        "i64" | "i128" | "isize" => (i128::from(i64::MIN), i128::from(i64::MAX)),
        "u8" => (0, i128::from(u8::MAX)),
        "u16" => (0, i128::from(u16::MAX)),
        "u32" => (0, i128::from(u32::MAX)),
        "u64" | "u128" | "usize" => (0, i128::from(i64::MAX)),
        _ => return None,
    };
    Some((least, greatest))
}
