//! What became another type.

use std::fmt;

use super::{Enum, Layout, Part, Struct};

/// The first part that is not laid out as it was, in words.
pub fn first_difference(was: &[Part], is: &[Part]) -> Option<String> {
    for (was, is) in was.iter().zip(is) {
        if (&was.name, was.kind) != (&is.name, is.kind) {
            return Some(format!("`{}` is in the place of `{}`", is.name, was.name));
        }
        if let Some(difference) = difference(&was.layout, &is.layout, &was.name) {
            return Some(difference);
        }
    }
    let (was, is) = (was.get(is.len()), is.get(was.len()));
    was.map(|gone| format!("`{}` is gone", gone.name))
        .or_else(|| is.map(|new| format!("`{}` is new", new.name)))
}

/// Where two layouts differ first.
pub(super) fn difference(was: &Layout, is: &Layout, path: &str) -> Option<String> {
    // Of what was unknown then nothing can be said.
    if was == is || *was == Layout::Unknown {
        return None;
    }
    let inside = match (was, is) {
        (Layout::Option(was), Layout::Option(is)) => difference(was, is, path),
        (Layout::List(was), Layout::List(is)) => difference(was, is, &format!("{path}[]")),
        (Layout::Map(was), Layout::Map(is)) => {
            difference(&was.0, &is.0, &format!("keys of {path}"))
                .or_else(|| difference(&was.1, &is.1, &format!("{path}[]")))
        }
        (Layout::Tuple(was), Layout::Tuple(is)) if was.len() == is.len() => {
            let mut items = was.iter().zip(is).enumerate();
            items.find_map(|(index, (was, is))| difference(was, is, &format!("{path}.{index}")))
        }
        (Layout::Struct(was), Layout::Struct(is)) if was.name == is.name => {
            named(&was.fields, &is.fields, ("field", path))
        }
        (Layout::Enum(was), Layout::Enum(is)) if was.name == is.name => {
            named(&was.variants, &is.variants, ("variant", path))
        }
        _ => None,
    };
    inside.or_else(|| Some(format!("`{path}` was {was}, is {is}")))
}

fn named(
    was: &[(String, Layout)],
    is: &[(String, Layout)],
    (noun, path): (&str, &str),
) -> Option<String> {
    let has = |all: &[(String, Layout)], name: &str| all.iter().any(|(known, _)| known == name);
    if let Some((gone, _)) = was.iter().find(|(name, _)| !has(is, name)) {
        return Some(format!("the {noun} `{gone}` of `{path}` is gone"));
    }
    if let Some((new, _)) = is.iter().find(|(name, _)| !has(was, name)) {
        return Some(format!("the {noun} `{new}` of `{path}` is new"));
    }
    let mut pairs = was.iter().zip(is);
    if pairs.clone().any(|((was, _), (is, _))| was != is) {
        return Some(format!("the {noun}s of `{path}` have another order"));
    }
    pairs.find_map(|((name, was), (_, is))| difference(was, is, &format!("{path}.{name}")))
}

/// In few words.
impl fmt::Display for Layout {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown => formatter.write_str("unknown"),
            Self::Unit => formatter.write_str("()"),
            Self::Bool => formatter.write_str("bool"),
            Self::Signed(bits) => write!(formatter, "i{bits}"),
            Self::Unsigned(bits) => write!(formatter, "u{bits}"),
            Self::Float(bits) => write!(formatter, "f{bits}"),
            Self::Character => formatter.write_str("char"),
            Self::Text => formatter.write_str("text"),
            Self::Bytes => formatter.write_str("bytes"),
            Self::Option(inner) => write!(formatter, "Option<{inner}>"),
            Self::List(inner) => write!(formatter, "[{inner}]"),
            Self::Map(both) => write!(formatter, "map of {} to {}", both.0, both.1),
            Self::Tuple(items) => write!(formatter, "a tuple of {}", items.len()),
            Self::Struct(Struct { name, .. }) => write!(formatter, "the struct `{name}`"),
            Self::Enum(Enum { name, .. }) => write!(formatter, "the enum `{name}`"),
            Self::Again(_) => formatter.write_str("what it stands in"),
        }
    }
}
