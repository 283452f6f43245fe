//! What is never there: an instance that the robot does not have, a path that no value of an output's type has, a word of
//! `equals` and `is_not` likewise. Of such, `is_not` would hold of everything and `equals` of nothing.

use std::fmt::Display;

use serde_json::Value;

use super::assertion::{Assertion, Condition};
use crate::cycler::Instance;
use crate::parameters::{Fault, Origin, ParameterError, nearest};
use crate::recorded::shape_of;
use crate::reflect::{Content, Form, Shape, UnknownPath, VariantContent};
use crate::robot::Robot;

/// An assertion, counted from 0, with a path that never leads to a value, or a word that its value never is.
#[derive(Debug)]
pub(crate) struct Misspelt {
    assertion: usize,
    key: &'static str,
    message: String,
}

/// The first such path or word in what is asserted of the robot with this number, counted from 1.
///
/// Of truths nobody knows the type, and of types that serde writes in ways of its own nobody knows the words.
pub(crate) fn misspelt<P>(
    assertions: &[Assertion],
    robot: &Robot<P>,
    number: usize,
) -> Option<Misspelt> {
    let numbered = assertions.iter().enumerate();
    let mut own = numbered.filter(|(_, one)| one.robot == number);
    own.find_map(|(index, assertion)| {
        let told = |key, wrong: &dyn Display| Misspelt {
            assertion: index,
            key,
            message: format!(
                "`{}` of assertion `{}` {wrong}",
                assertion.value, assertion.what
            ),
        };
        if let Some(wrong) = no_instance(robot, assertion.instance()?) {
            return Some(told("value", &wrong));
        }
        let shape = match shape_of_value(robot, assertion)? {
            Ok(shape) => shape,
            Err(unknown) => return Some(told("value", &format_args!("is never there: {unknown}"))),
        };
        let (key, wanted) = match assertion.condition() {
            Condition::Equals(wanted) => ("equals", wanted),
            Condition::IsNot(unwanted) => ("is_not", unwanted),
            Condition::IsThere(_) | Condition::Between { .. } => return None,
        };
        Some(told(key, &wrong_word(&shape, wanted)?))
    })
}

impl Misspelt {
    /// Where the file says it.
    pub(crate) fn path(&self) -> String {
        format!("assertion.{}.{}", self.assertion, self.key)
    }

    /// What is told of it at that place.
    pub(crate) fn at(self, origin: Origin) -> ParameterError {
        ParameterError {
            origin,
            key: self.key.to_owned(),
            fault: Fault::Invalid,
            message: self.message,
        }
    }
}

/// What is told of an instance that there is not; of one that does not run here nobody knows more than that.
fn no_instance<P>(robot: &Robot<P>, name: &str) -> Option<String> {
    let instances = robot.instances.iter();
    let running = instances.map(|instance| instance.description().name);
    let mut known: Vec<_> = running.chain(robot.left_out.iter().copied()).collect();
    known.sort_unstable();
    (!known.contains(&name)).then(|| unknown_instance(name, &known))
}

fn unknown_instance(name: &str, known: &[&str]) -> String {
    let hint = match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("there are {}", known.join(", ")),
    };
    format!("is of no instance: there is no `{name}`; {hint}")
}

/// What is known of the type of what is looked at; an output that there is not is told when it is looked at.
fn shape_of_value<P>(
    robot: &Robot<P>,
    assertion: &Assertion,
) -> Option<Result<Shape, UnknownPath>> {
    let name = assertion.instance()?;
    let mut instances = robot.instances.iter().map(Box::as_ref);
    let instance: &dyn Instance = instances.find(|one| one.description().name == name)?;
    let access = robot.access.iter().find(|one| one.instance == name)?;
    let (shape, below) = shape_of(instance, &access.subscriptions, &assertion.value)?;
    match below {
        "" => Some(Ok(shape)),
        below => shape.known_at(&below.parse().ok()?),
    }
}

/// What is wrong with the first word in a value that its type does not have.
fn wrong_word(shape: &Shape, wanted: &Value) -> Option<String> {
    match (&shape.content, wanted) {
        (Content::Option(_) | Content::Recursive(_), Value::Null) => None,
        (Content::Option(_) | Content::Recursive(_), _) => wrong_word(&*shape.opened()?, wanted),
        (Content::List { item, .. } | Content::Set(item), Value::Array(values)) => {
            values.iter().find_map(|value| wrong_word(item, value))
        }
        (Content::Map(item), Value::Object(entries)) => {
            entries.values().find_map(|value| wrong_word(item, value))
        }
        (Content::Tuple(items), Value::Array(values)) => {
            let mut pairs = items.iter().zip(values);
            pairs.find_map(|(item, value)| wrong_word(item, value))
        }
        (Content::Struct(fields), Value::Object(entries)) => fields.iter().find_map(|field| {
            let value = entries.get(field.name)?;
            wrong_word(&field.shape, value)
        }),
        (Content::Enum(_), _) if shape.form == Form::Plain => wrong_variant(shape, wanted),
        _ => None,
    }
}

/// As serde writes enums by itself: the name alone, or the content below the name.
fn wrong_variant(shape: &Shape, wanted: &Value) -> Option<String> {
    let Content::Enum(variants) = &shape.content else {
        return None;
    };
    let (word, content) = match wanted {
        Value::String(word) => (word, None),
        Value::Object(entries) if entries.len() == 1 => {
            let (word, content) = entries.iter().next()?;
            (word, Some(content))
        }
        _ => return None,
    };
    let names = || variants.iter().map(|variant| variant.name);
    let Some(variant) = variants.iter().find(|variant| variant.name == *word) else {
        let hint = match nearest(word, names()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("there are {}", names().collect::<Vec<_>>().join(", ")),
        };
        return Some(format!("is never `{word}`; {hint}"));
    };
    match (&variant.content, content) {
        (VariantContent::Unit, None) => None,
        (VariantContent::Unit, Some(_)) => Some(format!(
            "is never `{word}` with something in it: write \"{word}\""
        )),
        (_, None) => Some(format!(
            "is never `{word}` alone: say what is in it, {{ {word} = … }}"
        )),
        (VariantContent::Value(inner), Some(content)) => wrong_word(inner, content),
        (VariantContent::Fields(fields), Some(content)) => {
            let inside = Shape {
                content: fields.clone(),
                ..shape.clone()
            };
            wrong_word(&inside, content)
        }
    }
}

#[cfg(test)]
mod tests;
