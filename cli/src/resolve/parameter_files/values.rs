//! Values that cannot be what a node reads, as far as their types can be seen.

use grammar::Range;
use toml::Spanned;
use toml::de::{DeInteger, DeValue};

use super::expected::{Child, Children, Expected};
use super::form::{self, Form};
use super::variants::{Content, Variant};
use crate::diagnostics::{listed, nearest};
use crate::scan::Sources;
use crate::scan::types::Resolved;

/// A value of the wrong type.
pub(super) struct Mistake {
    /// Follows the parameter's path: "is a string, not a number".
    pub(super) message: String,
    pub(super) place: std::ops::Range<usize>,
    pub(super) help: Option<String>,
}

/// What values are judged by.
#[derive(Clone, Copy)]
struct Judge<'a> {
    /// Where numbers must lie.
    limits: Option<Range>,
    sources: &'a Sources<'a>,
}

/// What is wrong with a value; `None` also where that cannot be seen.
pub(super) fn mistake(
    value: &Spanned<DeValue<'_>>,
    place: &Child<'_>,
    sources: &Sources<'_>,
) -> Option<Mistake> {
    let limits = place.limits;
    match &place.expected {
        Expected::Tree(_) if value.get_ref().is_table() => None,
        Expected::Tree(_) => Some(wrong(value, "a table")),
        Expected::Value(data) => Judge { limits, sources }.check(value, data),
    }
}

impl Judge<'_> {
    /// A value that stands in no table which other files add to, so it is whole.
    fn check(mut self, value: &Spanned<DeValue<'_>>, data: &Resolved) -> Option<Mistake> {
        if form::is_duration(data) {
            self.limits = None;
        }
        match Form::of(data, self.sources) {
            Form::Unknown => None,
            Form::List(element) => self.check_elements(value, &element),
            Form::Repeated { element, length } => {
                let items = value.get_ref().as_array().map(|items| items.len());
                match items {
                    Some(items) if length != items => Some(wrong_count(value, items, length)),
                    _ => self.check_elements(value, &element),
                }
            }
            Form::Several(parts) => self.check_parts(value, &parts),
            Form::Map(data) => self.check_fields(value, &Children::Any(data)),
            Form::Fields { order, .. } if !order.is_empty() && value.get_ref().is_array() => {
                self.check_in_order(value, &order)
            }
            Form::Fields { children, .. } => self.check_fields(value, &children),
            Form::Variants(variants) => self.check_variant(value, &variants),
            simple => check_simple(value, &simple).or_else(|| check_range(value, self.limits?)),
        }
    }

    fn check_elements(self, value: &Spanned<DeValue<'_>>, element: &Resolved) -> Option<Mistake> {
        let Some(items) = value.get_ref().as_array() else {
            return Some(wrong(value, "an array"));
        };
        items.iter().find_map(|item| self.check(item, element))
    }

    /// An array with one element of each of these types.
    fn check_parts(self, value: &Spanned<DeValue<'_>>, parts: &[Resolved]) -> Option<Mistake> {
        let Some(items) = value.get_ref().as_array() else {
            return Some(wrong(value, "an array"));
        };
        if items.len() != parts.len() {
            return Some(wrong_count(value, items.len(), parts.len()));
        }
        let mut items = items.iter().zip(parts);
        items.find_map(|(item, part)| self.check(item, part))
    }

    /// An array with the values of these fields; the last may be left out if they have defaults.
    fn check_in_order(self, value: &Spanned<DeValue<'_>>, fields: &[Child<'_>]) -> Option<Mistake> {
        let items = value.get_ref().as_array()?;
        let mut rest = fields.iter().skip(items.len());
        if items.len() > fields.len() || rest.any(|field| !field.has_default) {
            return Some(wrong_count(value, items.len(), fields.len()));
        }
        let mut items = items.iter().zip(fields);
        items.find_map(|(item, field)| {
            mistake(item, &field.clone().within(self.limits), self.sources)
        })
    }

    fn check_fields(
        self,
        value: &Spanned<DeValue<'_>>,
        children: &Children<'_>,
    ) -> Option<Mistake> {
        let Some(table) = value.get_ref().as_table() else {
            return Some(wrong(value, "a table"));
        };
        for (key, value) in table {
            let name = key.get_ref();
            let Some(child) = children.get(name) else {
                let near = nearest(name, children.names());
                return Some(Mistake {
                    message: format!("has a table with `{name}`, which nobody declares"),
                    place: key.span(),
                    help: Some(near.map_or_else(
                        || "remove it".to_owned(),
                        |near| format!("did you mean `{near}`?"),
                    )),
                });
            };
            if let Some(name) = child
                .alias_of
                .as_ref()
                .filter(|name| table.contains_key(name.as_str()))
            {
                return Some(Mistake {
                    message: format!(
                        "has a table with `{name}` and its other name `{}`",
                        key.get_ref()
                    ),
                    place: key.span(),
                    help: Some("remove one of them".to_owned()),
                });
            }
            if let Some(mistake) = mistake(value, &child.within(self.limits), self.sources) {
                return Some(mistake);
            }
        }
        let children = children.clone().of_tables([table]);
        let lacking = children.iter().find(|(name, child)| {
            child.required && !child.names(name).any(|name| table.contains_key(name))
        });
        lacking.map(|(name, _)| Mistake {
            message: format!("has a table without `{name}`"),
            place: value.span(),
            help: Some(format!("add `{name} = …` to it")),
        })
    }

    /// The name of a variant, or a table of that name with what the variant holds.
    fn check_variant(self, value: &Spanned<DeValue<'_>>, variants: &[Variant]) -> Option<Mistake> {
        let (name, place, content) = match value.get_ref() {
            DeValue::String(name) => (name, value.span(), None),
            DeValue::Table(table) => match table.iter().next() {
                Some((key, content)) if table.len() == 1 => {
                    (key.get_ref(), key.span(), Some(content))
                }
                _ => return Some(wrong(value, "a table with one variant")),
            },
            _ => return Some(wrong(value, "a string")),
        };
        let mistake = |message: String, help: String| Mistake {
            message,
            place: place.clone(),
            help: Some(help),
        };
        let mut named = variants
            .iter()
            .filter(|one| one.names().any(|one| one == name));
        let Some(variant) = named.next() else {
            let names = || variants.iter().flat_map(Variant::names);
            let help = match nearest(name, names()) {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => format!("write one of {}", listed(names())),
            };
            return Some(mistake(format!("has no variant `{name}`"), help));
        };
        match (&variant.content, content) {
            (Content::Unknown, _) | (Content::Nothing, None) => None,
            (Content::Nothing, Some(_)) => {
                let message = format!("has a value for `{name}`, which takes none");
                Some(mistake(message, format!("write \"{name}\"")))
            }
            (_, None) => {
                let message = format!("has no value for `{name}`");
                Some(mistake(message, format!("write {{ {name} = … }}")))
            }
            (Content::One(data), Some(content)) => self.check(content, data),
            (Content::Several(parts), Some(content)) => self.check_parts(content, parts),
            (Content::Fields(children), Some(content)) => self.check_fields(content, children),
        }
    }
}

fn check_simple(value: &Spanned<DeValue<'_>>, form: &Form) -> Option<Mistake> {
    let expected = match (form, value.get_ref()) {
        (Form::Boolean, DeValue::Boolean(_))
        | (Form::Text, DeValue::String(_))
        | (Form::Number { .. }, DeValue::Integer(_)) => return None,
        (Form::Number { name }, DeValue::Float(number)) => {
            return is_too_large(name, number.as_str()).then(|| Mistake {
                message: format!("does not fit into a `{name}`"),
                place: value.span(),
                help: None,
            });
        }
        (Form::Boolean, _) => "true or false",
        (Form::Text, _) => "a string",
        (Form::Number { .. }, _) => "a number",
        (Form::Letter, DeValue::String(text)) if text.chars().count() == 1 => return None,
        (Form::Letter, _) => "a string of one character",
        (Form::Address(is_right), DeValue::String(text)) if is_right(text) => return None,
        (Form::Address(_), _) => "an address",
        (
            Form::Whole {
                name,
                least,
                greatest,
                zero,
            },
            DeValue::Integer(number),
        ) => {
            let number = parse(number)?;
            if (*least..=*greatest).contains(&number) && (*zero || number != 0) {
                return None;
            }
            let but = if *zero { "" } else { ", but not 0" };
            return Some(Mistake {
                message: format!("does not fit into a `{name}`"),
                place: value.span(),
                help: Some(format!("write a number from {least} to {greatest}{but}")),
            });
        }
        (Form::Whole { .. }, _) => "a whole number",
        _ => return None,
    };
    Some(wrong(value, expected))
}

/// A finite number that would become infinite.
fn is_too_large(name: &str, text: &str) -> bool {
    let is_infinite = match name {
        "f32" => text.parse().is_ok_and(f32::is_infinite),
        _ => text.parse().is_ok_and(f64::is_infinite),
    };
    is_infinite && !text.ends_with("inf")
}

/// A number that its field's `#[reflect(range = …)]` leaves out.
fn check_range(value: &Spanned<DeValue<'_>>, limits: Range) -> Option<Mistake> {
    let text = match value.get_ref() {
        DeValue::Float(number) => number.as_str(),
        DeValue::Integer(number) => number.as_str(),
        _ => return None,
    };
    let number: f64 = text.parse().ok()?;
    if limits.contains(number) {
        return None;
    }
    Some(Mistake {
        message: format!("is {text}, not within {limits}"),
        place: value.span(),
        help: None,
    })
}

fn wrong_count(value: &Spanned<DeValue<'_>>, items: usize, expected: usize) -> Mistake {
    Mistake {
        message: match items {
            1 => format!("has 1 element, not {expected}"),
            _ => format!("has {items} elements, not {expected}"),
        },
        place: value.span(),
        help: None,
    }
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
