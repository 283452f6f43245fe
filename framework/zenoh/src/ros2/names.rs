//! Names by the rules of ROS 2, of names by the rules of Rust and JSON.

/// Words that a field's name must not be, as some language that ROS 2 generates code in has a meaning for them.
const KEYWORDS: &str = "\
and and_eq asm assert async auto await bitand bitor bool break byte case catch char class compl concept const constexpr \
continue decltype def default del delete do double elif else enum except explicit export extern false finally float for \
from friend global goto if import in inline int is lambda long mutable namespace new noexcept none nonlocal not not_eq \
nullptr operator or or_eq pass private protected public raise register requires return self short signed sizeof static \
string struct switch template this throw true try typedef typeid typename union unsigned using virtual void volatile \
while with xor xor_eq yield";

/// The words of a name in lower case: `ballSeen`, `ball-seen` and `BALL_SEEN` are the same two.
fn words(name: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut is_inside = false;
    let mut was_lower = false;
    for letter in name.chars() {
        if !letter.is_ascii_alphanumeric() {
            is_inside = false;
            continue;
        }
        if !is_inside || (was_lower && letter.is_ascii_uppercase()) {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut() {
            word.push(letter.to_ascii_lowercase());
        }
        is_inside = true;
        was_lower = !letter.is_ascii_uppercase();
    }
    words
}

/// The name of a field, which none of these is.
pub(super) fn field(name: &str, others: &[&str]) -> String {
    let mut field = words(name).join("_");
    let begins = field.bytes().next();
    if !begins.is_some_and(|byte| byte.is_ascii_lowercase()) {
        field = format!("field_{field}");
    }
    let field = field.trim_end_matches('_');
    let is_keyword = KEYWORDS.split(' ').any(|keyword| keyword == field);
    let field = if is_keyword {
        format!("{field}_value")
    } else {
        field.to_owned()
    };
    apart(&field, "_", others)
}

/// The name of a constant of this field, which none of these is.
pub(super) fn constant(field: &str, variant: &str, others: &[&str]) -> String {
    let mut words = words(variant);
    words.insert(0, field.to_owned());
    apart(&words.join("_").to_ascii_uppercase(), "_", others)
}

/// The part of a message's name that a field gives to the message in it.
pub(super) fn camel(name: &str) -> String {
    let words = words(name);
    let words = words.iter().map(|word| {
        let mut letters = word.chars();
        let first = letters.next().map(|letter| letter.to_ascii_uppercase());
        first.into_iter().chain(letters).collect::<String>()
    });
    words.collect()
}

/// The name of a message, which none of these is: files and headers of two may not differ by their letters' case alone.
pub(super) fn message(name: &str, others: &[&str]) -> String {
    let is_free = |name: &str| !others.iter().any(|other| other.eq_ignore_ascii_case(name));
    let numbered = (2..).map(|number| format!("{name}{number}"));
    let mut names = [name.to_owned()].into_iter().chain(numbered);
    names.find(|name| is_free(name)).unwrap_or_default()
}

/// The name of a node.
pub(crate) fn node(name: &str) -> String {
    let name: Vec<&str> = name
        .split(|letter: char| !letter.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty())
        .collect();
    let name = name.join("_");
    let begins = name.bytes().next();
    if begins.is_some_and(|byte| byte.is_ascii_alphabetic()) {
        name
    } else {
        format!("robot_{name}").trim_end_matches('_').to_owned()
    }
}

fn apart(name: &str, between: &str, others: &[&str]) -> String {
    let numbered = (2..).map(|number| format!("{name}{between}{number}"));
    let mut names = [name.to_owned()].into_iter().chain(numbered);
    let free = names.find(|name| !others.contains(&name.as_str()));
    free.unwrap_or_default()
}

/// One of the names that a topic's is made of.
pub(super) fn is_of_topic(chunk: &str) -> bool {
    let mut letters = chunk.bytes();
    let begins = letters.next();
    begins.is_some_and(|byte| byte.is_ascii_alphabetic() || byte == b'_')
        && letters.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

pub(super) fn is_package(name: &str) -> bool {
    let is_lower = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_';
    name.starts_with(|letter: char| letter.is_ascii_lowercase())
        && name.bytes().all(is_lower)
        && !name.contains("__")
        && !name.ends_with('_')
}

pub(super) fn is_message(name: &str) -> bool {
    name.starts_with(|letter: char| letter.is_ascii_uppercase())
        && name.bytes().all(|byte| byte.is_ascii_alphanumeric())
}
