//! The names and contents by which derived serde reads the variants of an enum.

use super::expected::{self, Children};
use super::keys::{self, field_keys, name, serde_items, text};
use crate::scan::fields::{self, Variants};
use crate::scan::types::Resolved;

/// A variant that a file may name.
#[derive(Clone, Debug)]
pub(super) struct Variant {
    pub(super) name: String,
    pub(super) aliases: Vec<String>,
    pub(super) content: Content,
}

/// What stands behind the name of a variant.
#[derive(Clone, Debug)]
pub(super) enum Content {
    /// The name stands alone.
    Nothing,
    One(Resolved),
    Several(Vec<Resolved>),
    Fields(Children<'static>),
    /// Something that only serde knows.
    Unknown,
}

impl Variant {
    /// Every name that a file may use.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(&self.name)
            .chain(&self.aliases)
            .map(String::as_str)
    }
}

/// The variants in their order; `None` where serde does not read their names, or an attribute means more than is
/// understood here.
pub(super) fn variants(found: Variants) -> Option<Vec<Variant>> {
    if !crate::scan::derives(&found.attributes, "Deserialize") {
        return None;
    }
    let (mut rule, mut rule_of_fields) = ("PascalCase".to_owned(), "snake_case".to_owned());
    for item in serde_items(&found.attributes)? {
        match (name(&item).as_str(), text(&item)) {
            ("deny_unknown_fields", _) => {}
            ("rename_all", Some(text)) => rule = text,
            ("rename_all_fields", Some(text)) => rule_of_fields = text,
            _ => return None,
        }
    }
    let read = |one| variant(one, &rule, &rule_of_fields);
    let variants: Option<Vec<Option<Variant>>> = found.variants.into_iter().map(read).collect();
    Some(variants?.into_iter().flatten().collect())
}

/// Inner `None`: serde does not read the variant.
fn variant(found: fields::Variant, rule: &str, rule_of_fields: &str) -> Option<Option<Variant>> {
    let mut variant = Variant {
        name: renamed(&found.name, rule)?,
        aliases: Vec::new(),
        content: Content::Unknown,
    };
    let (mut skipped, mut by_function) = (false, false);
    let mut rule_of_fields = rule_of_fields.to_owned();
    for item in serde_items(&found.attributes)? {
        match (name(&item).as_str(), text(&item)) {
            ("skip" | "skip_deserializing", _) => skipped = true,
            ("rename", Some(name)) => variant.name = name,
            ("alias", Some(name)) => variant.aliases.push(name),
            ("rename_all", Some(text)) => rule_of_fields = text,
            ("skip_serializing" | "serialize_with", _) => {}
            ("deserialize_with" | "with", _) => by_function = true,
            _ => return None,
        }
    }
    if !by_function {
        variant.content = content(found, &rule_of_fields)?;
    }
    Some((!skipped).then_some(variant))
}

fn content(variant: fields::Variant, rule: &str) -> Option<Content> {
    if variant.has_names {
        let keys = field_keys(variant.fields, rule, false)?;
        return Some(Content::Fields(expected::children(keys)));
    }
    let has_attributes = |field: &fields::StructField| {
        serde_items(&field.attributes).is_none_or(|items| !items.is_empty())
    };
    if variant.fields.iter().any(has_attributes) {
        return Some(Content::Unknown);
    }
    let mut parts: Vec<Resolved> = variant.fields.into_iter().map(|field| field.data).collect();
    Some(match (parts.len(), parts.pop()) {
        (1, Some(only)) => Content::One(only),
        (_, Some(last)) => {
            parts.push(last);
            Content::Several(parts)
        }
        (_, None) => Content::Nothing,
    })
}

/// A variant's name by the rule of `rename_all`.
fn renamed(variant: &str, rule: &str) -> Option<String> {
    let snake = || {
        let mut snake = String::new();
        for letter in variant.chars() {
            if letter.is_uppercase() && !snake.is_empty() {
                snake.push('_');
            }
            snake.push(letter.to_ascii_lowercase());
        }
        snake
    };
    Some(match rule {
        // Variants are written so already.
        "PascalCase" => variant.to_owned(),
        "lowercase" => variant.to_ascii_lowercase(),
        "UPPERCASE" => variant.to_ascii_uppercase(),
        "camelCase" => keys::with_small_beginning(variant),
        "snake_case" => snake(),
        "SCREAMING_SNAKE_CASE" => snake().to_ascii_uppercase(),
        "kebab-case" => snake().replace('_', "-"),
        "SCREAMING-KEBAB-CASE" => snake().to_ascii_uppercase().replace('_', "-"),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::renamed;

    #[test]
    fn variants_are_renamed_as_serde_does() {
        for (rule, name) in [
            ("PascalCase", "HalfLife2"),
            ("lowercase", "halflife2"),
            ("UPPERCASE", "HALFLIFE2"),
            ("camelCase", "halfLife2"),
            ("snake_case", "half_life2"),
            ("SCREAMING_SNAKE_CASE", "HALF_LIFE2"),
            ("kebab-case", "half-life2"),
            ("SCREAMING-KEBAB-CASE", "HALF-LIFE2"),
        ] {
            assert_eq!(renamed("HalfLife2", rule).as_deref(), Some(name));
        }
        assert_eq!(renamed("HalfLife", "Train-Case"), None);
    }
}
