//! Reads the manifest's types although parts are wrong, so that all mistakes come at once.
//!
//! Serde stops at the first mistake. The smallest part around it is then left out and the rest is read again.

use std::ops::Range;

use camino::Utf8Path;
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use crate::diagnostics::{Code, Diagnostic, Diagnostics, Reported, nearest};

/// Everything that is wrong with the manifest's keys and values, or the manifest.
pub(super) fn read(
    table: &Spanned<DeTable<'_>>,
    file: &Utf8Path,
    diagnostics: &mut Diagnostics,
) -> Result<schema::Manifest, Reported> {
    let mut rest = Spanned::new(table.span(), DeValue::Table(table.get_ref().clone()));
    let mut left_out: Vec<LeftOut> = Vec::new();
    let mut reported = None;
    let fail = |diagnostics: &mut Diagnostics, mistake: &toml::de::Error, range: Range<usize>| {
        diagnostics.fail(describe(mistake.message()).at(file, range, ""))
    };
    loop {
        let mistake = match schema::Manifest::deserialize(ValueDeserializer::from(rest.clone())) {
            Ok(manifest) => return reported.map_or(Ok(manifest), Err),
            Err(mistake) => mistake,
        };
        let range = mistake.span().unwrap_or_else(|| table.span());
        let follows = quoted(mistake.message(), "missing field ").is_some_and(|key| {
            // Where one of several keys is missing, it may be the one that was left out.
            let is_choice = mistake.message().contains("` or `");
            left_out
                .iter()
                .any(|one| (one.key == key || is_choice) && one.table == range)
        });
        if !follows {
            let place = first_line(table, range.clone());
            let error = describe(mistake.message()).at(file, place, "");
            reported = Some(diagnostics.fail(match range == table.span() {
                true => error.help_if(missing_table(mistake.message())),
                false => error,
            }));
        }
        match (leave_out(&mut rest, &range), reported) {
            (Some(entry), _) => left_out.push(entry),
            (None, Some(reported)) => return Err(reported),
            (None, None) => return Err(fail(diagnostics, &mistake, range)),
        }
    }
}

/// What the manifest itself lacks is a table: `robot`.
fn missing_table(message: &str) -> Option<String> {
    let key = quoted(message, "missing field ")?;
    Some(format!("add a table `[{key}]`"))
}

/// A missing key is reported at its whole table, of which the beginning is enough.
fn first_line(table: &Spanned<DeTable<'_>>, range: Range<usize>) -> Range<usize> {
    if range == table.span() {
        range.start..range.start
    } else {
        range
    }
}

/// An entry that was removed.
struct LeftOut {
    /// Empty for an element of an array.
    key: String,
    /// Of the table or array that had it.
    table: Range<usize>,
}

/// Removes the smallest entry around a place; nothing if there is no such entry.
fn leave_out(value: &mut Spanned<DeValue<'_>>, place: &Range<usize>) -> Option<LeftOut> {
    let whole = value.span();
    let holds = |range: Range<usize>| range.start <= place.start && place.end <= range.end;
    match value.get_mut() {
        DeValue::Table(table) => {
            // The span of a table under a header is that of the header alone: its inside is asked, whatever it is.
            let (key, deeper) = table.iter_mut().find_map(|(key, value)| {
                if holds(key.span()) {
                    return Some((key.clone(), None));
                }
                let removed = leave_out(value, place);
                (holds(value.span()) || removed.is_some()).then(|| (key.clone(), removed))
            })?;
            if deeper.is_some() {
                return deeper;
            }
            table.remove(&key);
            Some(LeftOut {
                key: key.get_ref().to_string(),
                table: whole,
            })
        }
        DeValue::Array(array) => {
            let mut removed = None;
            let index = array.iter_mut().position(|element| {
                removed = leave_out(element, place);
                removed.is_some() || holds(element.span())
            })?;
            if removed.is_none() {
                let others = array
                    .iter()
                    .enumerate()
                    .filter(|(other, _)| *other != index);
                *array = others.map(|(_, element)| element.clone()).collect();
                removed = Some(LeftOut {
                    key: String::new(),
                    table: whole,
                });
            }
            removed
        }
        _ => None,
    }
}

/// The diagnostic for one of serde's messages.
fn describe(message: &str) -> Diagnostic {
    if let Some(key) = quoted(message, "unknown field ") {
        let valid = expected(message);
        let help = suggestion(key, &valid);
        return Diagnostic::new(Code::UnknownKey, format!("`{key}` is no key here")).help_if(help);
    }
    if let Some(keys) = message
        .strip_prefix("missing field ")
        .filter(|keys| keys.contains("` or `"))
    {
        return Diagnostic::new(Code::MissingKey, format!("{keys} is missing"))
            .help("add one of the two");
    }
    if let Some(key) = quoted(message, "missing field ") {
        return Diagnostic::new(Code::MissingKey, format!("`{key}` is missing"))
            .help(format!("add `{key} = …`"));
    }
    if let Some(value) = quoted(message, "unknown variant ") {
        let valid = expected(message);
        let message = format!("`{value}` is not known here");
        return Diagnostic::new(Code::InvalidValue, message).help_if(suggestion(value, &valid));
    }
    match message.split_once(": ") {
        Some((what, help)) if what.contains(" is no ") => {
            let is_name = [" is no name of ", " is no path of ", " is no suffix of "];
            let is_name = is_name.iter().any(|part| what.contains(part));
            let code = if is_name {
                Code::InvalidName
            } else {
                Code::InvalidValue
            };
            Diagnostic::new(code, what).help(help)
        }
        _ => Diagnostic::new(Code::InvalidValue, message),
    }
}

fn suggestion(wrong: &str, valid: &[&str]) -> Option<String> {
    match nearest(wrong, valid.iter().copied()) {
        Some(nearest) => Some(format!("did you mean `{nearest}`?")),
        None if valid.is_empty() => None,
        None => {
            let quoted: Vec<String> = valid.iter().map(|name| format!("`{name}`")).collect();
            Some(format!("write one of {}", quoted.join(", ")))
        }
    }
}

/// The word in backticks right behind a beginning.
fn quoted<'a>(message: &'a str, beginning: &str) -> Option<&'a str> {
    let rest = message.strip_prefix(beginning)?.strip_prefix('`')?;
    rest.split_once('`').map(|(word, _)| word)
}

/// The words in backticks behind "expected".
fn expected(message: &str) -> Vec<&str> {
    let list = message.split_once("expected ").map_or("", |(_, list)| list);
    list.split('`').skip(1).step_by(2).collect()
}
