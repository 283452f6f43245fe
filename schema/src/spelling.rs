//! Names that check their own spelling: they become identifiers and files of the generated crate.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Visitor;
use serde::{Deserialize, Deserializer, Serialize};

/// A name is not spelled as its kind has to be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is no {kind}: {rule}{}", self.about_letters())]
pub struct SpellingError {
    /// What was written.
    pub text: String,
    /// What it should be, for example "name of a cycler".
    pub kind: &'static str,
    /// How that is spelled.
    pub rule: &'static str,
}

impl SpellingError {
    /// What of the rule people overlook whose language has more letters.
    fn about_letters(&self) -> &'static str {
        match self.text.is_ascii() || self.kind == KEY {
            true => "",
            false => "; of letters only ASCII ones are taken",
        }
    }
}

/// Reads a text that keeps a rule.
struct Spelled<T>(PhantomData<T>);

impl<T: FromStr<Err = SpellingError>> Visitor<'_> for Spelled<T> {
    type Value = T;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a string")
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<T, E> {
        text.parse().map_err(E::custom)
    }
}

/// A newtype around a string that keeps a rule.
macro_rules! spelled {
    ($(#[$documentation:meta])* $name:ident, $kind:expr, $rule:literal, $pattern:literal, $check:expr) => {
        $(#[$documentation])*
        #[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
        pub struct $name(String);

        impl $name {
            /// The text.
            pub fn as_str(&self) -> &str {
                &self.0
            }
        }

        impl FromStr for $name {
            type Err = SpellingError;

            fn from_str(text: &str) -> Result<Self, SpellingError> {
                let check: fn(&str) -> bool = $check;
                if check(text) {
                    return Ok(Self(text.to_owned()));
                }
                Err(SpellingError { text: text.to_owned(), kind: $kind, rule: $rule })
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str(&self.0)
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                // Within the visitor, so that a mistake has the place of the text and not that of the list around it.
                deserializer.deserialize_str(Spelled(PhantomData))
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({ "type": "string", "description": $rule, "pattern": $pattern })
            }
        }
    };
}

spelled! {
    /// Name of a robot: `nao`.
    RobotName, "name of a robot",
    "write it in snake_case, beginning with a letter", "^[a-z][a-z0-9_]*$", is_snake_case
}
spelled! {
    /// Name of a cycler: `Vision`.
    CyclerName, "name of a cycler",
    "write it in UpperCamelCase, and let it be no keyword of Rust", "^[A-Z][A-Za-z0-9]*$", is_camel_name
}
spelled! {
    /// What follows the cycler's name in an instance's name: `Top`.
    InstanceSuffix, "suffix of an instance",
    "write it in UpperCamelCase", "^[A-Z0-9][A-Za-z0-9]*$", is_suffix
}
spelled! {
    /// Name of an instance: cycler name and suffix, `VisionTop`.
    InstanceName, "name of an instance",
    "write it in UpperCamelCase, and let it be no keyword of Rust", "^[A-Z][A-Za-z0-9]*$", is_camel_name
}
spelled! {
    /// Name of a part of the robot that reports an id: `head`.
    IdentityName, "name of an identity",
    "write it in snake_case, beginning with a letter", "^[a-z][a-z0-9_]*$", is_snake_case
}
spelled! {
    /// Name of a target: `simulated`.
    TargetName, "name of a target",
    "write it in lower case, beginning with a letter; digits, `-` and `_` may follow; cargo keeps `build`, `deps`, `examples` and `incremental` for itself",
    "^[a-z][a-z0-9_-]*$", is_target_name
}
spelled! {
    /// A node's module: `vision::ball_detection`.
    NodePath, "path of a node",
    "write `crate::module::path`", "^[A-Za-z_][A-Za-z0-9_]*(::[A-Za-z_][A-Za-z0-9_]*)+$", is_path
}
spelled! {
    /// A hardware type: `simulated_nao::Hardware`.
    HardwarePath, "path of a hardware type",
    "write `crate::Type`", "^[A-Za-z_][A-Za-z0-9_]*(::[A-Za-z_][A-Za-z0-9_]*)+$", is_path
}

/// It is nobody's identifier: its letters are free.
const KEY: &str = "key of a bridge";

spelled! {
    /// A key of Zenoh: `robot/pose`.
    BridgeKey, KEY,
    "write words joined by `/`, without `*`, `$`, `?`, `#` and white space, and none that begins with `@`",
    r"^[^/*$?#@\s][^/*$?#\s]*(/[^/*$?#@\s][^/*$?#\s]*)*$", is_key
}

impl NodePath {
    /// Its identifiers; at least two.
    pub fn segments(&self) -> impl Iterator<Item = &str> {
        self.0.split("::")
    }
}

impl HardwarePath {
    /// Its identifiers; at least two.
    pub fn segments(&self) -> impl Iterator<Item = &str> {
        self.0.split("::")
    }
}

impl InstanceName {
    /// The only instance of a cycler that names none.
    pub fn of_cycler(cycler: &CyclerName) -> Self {
        Self(cycler.0.clone())
    }

    /// An instance with a suffix.
    pub fn joined(cycler: &CyclerName, suffix: &InstanceSuffix) -> Self {
        Self(format!("{cycler}{suffix}"))
    }
}

/// `VisionTop` as a file or field is called: `vision_top`. `HSLNetwork2` is `hsl_network2`.
pub fn snake_case(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    let mut snake = String::new();
    for (index, letter) in letters.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| letters[before]);
        let after = letters.get(index + 1);
        let begins_word = letter.is_uppercase()
            && before.is_some_and(|before| {
                !before.is_uppercase() && before != '_'
                    || before.is_uppercase() && after.is_some_and(|after| after.is_lowercase())
            });
        if begins_word {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}

/// `field_dimensions` as a type is called: `FieldDimensions`.
pub fn upper_camel_case(name: &str) -> String {
    name.split('_')
        .flat_map(|word| {
            let mut letters = word.chars();
            letters
                .next()
                .into_iter()
                .flat_map(char::to_uppercase)
                .chain(letters)
        })
        .collect()
}

/// Whether a text is an ASCII identifier of Rust and no keyword.
pub fn is_identifier(text: &str) -> bool {
    let mut letters = text.chars();
    letters
        .next()
        .is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
        && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
        && text != "_"
        && !KEYWORDS.contains(&text)
}

fn is_snake_case(text: &str) -> bool {
    is_identifier(text)
        && text.starts_with(|first: char| first.is_ascii_lowercase())
        && !text.contains(|letter: char| letter.is_ascii_uppercase())
}

fn is_camel_name(text: &str) -> bool {
    text.starts_with(|first: char| first.is_ascii_uppercase())
        && text.chars().all(|letter| letter.is_ascii_alphanumeric())
        && is_identifier(text)
        && is_identifier(&snake_case(text))
}

fn is_suffix(text: &str) -> bool {
    text.starts_with(|first: char| first.is_ascii_uppercase() || first.is_ascii_digit())
        && text.chars().all(|letter| letter.is_ascii_alphanumeric())
}

/// Folders of cargo's own, for which it refuses programs of these names.
const CARGOS_FOLDERS: &[&str] = &["build", "deps", "examples", "incremental"];

fn is_target_name(text: &str) -> bool {
    !CARGOS_FOLDERS.contains(&text)
        && text.starts_with(|first: char| first.is_ascii_lowercase())
        && text.chars().all(|letter| {
            letter.is_ascii_lowercase() || letter.is_ascii_digit() || matches!(letter, '-' | '_')
        })
}

fn is_path(text: &str) -> bool {
    text.contains("::") && text.split("::").all(is_identifier)
}

/// What Zenoh takes as a key: chunks between `/`, none of them empty, without its wildcards and marks.
fn is_key(text: &str) -> bool {
    let is_plain = |character: char| !"*$?#".contains(character) && !character.is_whitespace();
    text.split('/')
        .all(|chunk| !chunk.is_empty() && !chunk.starts_with('@') && chunk.chars().all(is_plain))
}

/// Keywords of edition 2024, also those without a meaning yet.
const KEYWORDS: &[&str] = &[
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue",
    "crate", "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if",
    "impl", "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub",
    "ref", "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];
