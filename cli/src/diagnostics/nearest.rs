//! The nearest valid name, and lists of names for messages.

pub use grammar::nearest;

/// The deed for a name that means nothing: the nearest that does, else all of them behind these words.
pub fn suggestion<'a>(
    wrong: &str,
    names: impl IntoIterator<Item = &'a str>,
    introduction: &str,
) -> String {
    let names: Vec<&str> = names.into_iter().collect();
    match nearest(wrong, names.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("{introduction} {}", listed(names)),
    }
}

/// Names for a message: "`a`, `b` and `c`", "nothing" if there is none, at most eight of them.
pub fn listed<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let mut names: Vec<&str> = names.into_iter().collect();
    names.sort_unstable();
    names.dedup();
    let more = names.len().saturating_sub(8);
    names.truncate(8);
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => "nothing".to_owned(),
        [only] => only.clone(),
        all if more > 0 => format!("{} and {more} more", all.join(", ")),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
