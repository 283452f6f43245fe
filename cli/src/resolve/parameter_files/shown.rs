//! What clients of a running robot see of a type: serde writes values under the names by which it reads them.

use std::collections::BTreeSet;

use super::form::{Form, bare};
use super::keys::keys;
use super::variants::Content;
use crate::scan::Sources;
use crate::scan::types::Resolved;

/// What lies under a name in a value.
pub(in crate::resolve) enum Part {
    Of(Resolved),
    /// Certainly nothing; these are the names.
    None(Vec<String>),
    /// Only the running robot knows.
    Unknown,
}

/// What lies under a name in a value of a type.
pub(in crate::resolve) fn part(data: &Resolved, name: &str, sources: &Sources<'_>) -> Part {
    let data = bare(data);
    let Some(structure) = sources.library.fields(data) else {
        return if matches!(
            Form::of_itself(data, sources),
            Form::Boolean | Form::Number { .. } | Form::Text
        ) {
            Part::None(Vec::new())
        } else {
            Part::Unknown
        };
    };
    let Some(keys) = keys(structure) else {
        return Part::Unknown;
    };
    match keys.iter().find(|key| key.name == name) {
        Some(key) if key.by_function => Part::Unknown,
        Some(key) => Part::Of(key.field.data.clone()),
        None => Part::None(keys.into_iter().map(|key| key.name).collect()),
    }
}

/// The first part of a type that CDR certainly has no form for.
pub(in crate::resolve) fn without_cdr(data: &Resolved, sources: &Sources<'_>) -> Option<String> {
    search(data, sources, &mut BTreeSet::new())
}

fn search(data: &Resolved, sources: &Sources<'_>, seen: &mut BTreeSet<String>) -> Option<String> {
    let data = bare(data);
    if !seen.insert(data.text.clone()) {
        return None;
    }
    if let Some(structure) = sources.library.fields(data) {
        let keys = keys(structure)?;
        let told = keys.iter().filter(|key| !key.by_function);
        return told
            .map(|key| search(&key.field.data, sources, seen))
            .find_map(|found| found);
    }
    let has_none = match Form::of_itself(data, sources) {
        Form::List(element) | Form::Repeated { element, .. } => {
            return search(&element, sources, seen);
        }
        Form::Several(parts) => {
            return parts.iter().find_map(|part| search(part, sources, seen));
        }
        Form::Variants(variants) => (variants.iter())
            .any(|variant| !matches!(variant.content, Content::Nothing | Content::Unknown)),
        Form::Whole { name, .. } => matches!(name.as_str(), "i128" | "u128"),
        Form::Map(_) | Form::Letter => true,
        _ => false,
    };
    has_none.then(|| data.text.clone())
}
