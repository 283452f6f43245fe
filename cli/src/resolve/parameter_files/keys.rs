//! The keys by which derived serde reads the fields of a struct.

use syn::{Attribute, Expr, ExprLit, Lit, Meta, Token, punctuated::Punctuated};

use super::form::is_optional;
use crate::scan::fields::{StructField, StructFields};

/// A field that a table may give.
#[derive(Clone, Debug)]
pub(super) struct Key {
    /// As the files write it.
    pub(super) name: String,
    /// What they may write instead.
    pub(super) aliases: Vec<String>,
    /// It has no default, and is no `Option` that serde itself reads.
    pub(super) required: bool,
    /// Where an array ends before it, it has its default.
    pub(super) has_default: bool,
    /// A function of the author's reads it, which may take anything.
    pub(super) by_function: bool,
    pub(super) field: StructField,
}

impl Key {
    /// Every name that a file may use.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(&self.name)
            .chain(&self.aliases)
            .map(String::as_str)
    }
}

/// The keys in the order of the fields; `None` where serde does not read the fields, or an attribute means more than is
/// understood here.
pub(super) fn keys(structure: StructFields) -> Option<Vec<Key>> {
    if !crate::scan::derives(&structure.attributes, "Deserialize") {
        return None;
    }
    let mut has_default = false;
    let mut rule = "snake_case".to_owned();
    for item in serde_items(&structure.attributes)? {
        match (name(&item).as_str(), text(&item)) {
            ("default", _) => has_default = true,
            ("deny_unknown_fields", _) => {}
            ("rename_all", Some(text)) => rule = text,
            _ => return None,
        }
    }
    field_keys(structure.fields, &rule, has_default)
}

/// The keys of fields that have names by the rule of `rename_all`.
pub(super) fn field_keys(
    fields: Vec<StructField>,
    rule: &str,
    has_default: bool,
) -> Option<Vec<Key>> {
    let keys = fields.into_iter().map(|field| {
        let name = renamed(&field.name, rule)?;
        key(field, name, has_default)
    });
    let keys: Option<Vec<Option<Key>>> = keys.collect();
    Some(keys?.into_iter().flatten().collect())
}

/// Inner `None`: serde does not read the field.
fn key(field: StructField, name_by_rule: String, has_default: bool) -> Option<Option<Key>> {
    let mut key = Key {
        name: name_by_rule,
        aliases: Vec::new(),
        required: false,
        has_default,
        by_function: false,
        field,
    };
    let mut skipped = false;
    for item in serde_items(&key.field.attributes)? {
        match (name(&item).as_str(), text(&item)) {
            ("default", _) => key.has_default = true,
            ("skip" | "skip_deserializing", _) => skipped = true,
            ("rename", Some(name)) => key.name = name,
            ("alias", Some(name)) => key.aliases.push(name),
            ("skip_serializing" | "skip_serializing_if" | "serialize_with" | "borrow", _) => {}
            ("deserialize_with" | "with", _) => key.by_function = true,
            _ => return None,
        }
    }
    // What a function reads has to be there, also where it gives an `Option`.
    key.required = !key.has_default && (key.by_function || !is_optional(&key.field.data));
    Some((!skipped).then_some(key))
}

/// A field's name by the rule of `rename_all`.
fn renamed(field: &str, rule: &str) -> Option<String> {
    let pascal = || {
        let words = field.split('_').map(|word| {
            let mut characters = word.chars();
            let first = characters.next().map(|first| first.to_ascii_uppercase());
            first.into_iter().chain(characters).collect::<String>()
        });
        words.collect::<String>()
    };
    Some(match rule {
        // Fields are written so already.
        "lowercase" | "snake_case" => field.to_owned(),
        "UPPERCASE" | "SCREAMING_SNAKE_CASE" => field.to_ascii_uppercase(),
        "PascalCase" => pascal(),
        "camelCase" => with_small_beginning(&pascal()),
        "kebab-case" => field.replace('_', "-"),
        "SCREAMING-KEBAB-CASE" => field.to_ascii_uppercase().replace('_', "-"),
        _ => return None,
    })
}

/// `HalfLife` as `halfLife`.
pub(super) fn with_small_beginning(name: &str) -> String {
    let mut characters = name.chars();
    let first = characters.next().map(|first| first.to_ascii_lowercase());
    first.into_iter().chain(characters).collect()
}

/// Everything in `#[serde(…)]`; `None` if it cannot be read or depends on `cfg`.
pub(super) fn serde_items(attributes: &[Attribute]) -> Option<Vec<Meta>> {
    let mut items = Vec::new();
    for attribute in attributes {
        if attribute.path().is_ident("cfg_attr") || attribute.path().is_ident("cfg") {
            return None;
        }
        if attribute.path().is_ident("serde") {
            let list = attribute.parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated);
            items.extend(list.ok()?);
        }
    }
    Some(items)
}

/// The name of one of them.
pub(super) fn name(item: &Meta) -> String {
    let name = item.path().get_ident();
    name.map(ToString::to_string).unwrap_or_default()
}

/// The text behind the `=` of one of them.
pub(super) fn text(item: &Meta) -> Option<String> {
    match item {
        Meta::NameValue(meta) => match &meta.value {
            Expr::Lit(ExprLit {
                lit: Lit::Str(text),
                ..
            }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::renamed;

    #[test]
    fn fields_are_renamed_as_serde_does() {
        for (rule, name) in [
            ("lowercase", "half_life_2"),
            ("UPPERCASE", "HALF_LIFE_2"),
            ("PascalCase", "HalfLife2"),
            ("camelCase", "halfLife2"),
            ("snake_case", "half_life_2"),
            ("SCREAMING_SNAKE_CASE", "HALF_LIFE_2"),
            ("kebab-case", "half-life-2"),
            ("SCREAMING-KEBAB-CASE", "HALF-LIFE-2"),
        ] {
            assert_eq!(renamed("half_life_2", rule).as_deref(), Some(name));
        }
        assert_eq!(renamed("half_life", "Train-Case"), None);
    }
}
