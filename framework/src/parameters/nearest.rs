//! The valid name that was probably meant.

/// The nearest of `names` to `wanted`, if it is near enough to be a slip.
pub fn nearest<'a>(wanted: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = wanted.chars().count();
    let limit = 1 + length / 3;
    // The others are further away than that: `wanted` may be megabytes that somebody sent.
    let is_as_long = |name: &&str| name.chars().count().abs_diff(length) <= limit;
    let names = names.into_iter().filter(is_as_long);
    let distances = names.map(|name| (distance(wanted, name), name));
    let (distance, name) = distances.min_by_key(|(distance, _)| *distance)?;
    (distance <= limit).then_some(name)
}

/// Levenshtein's distance.
fn distance(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (index, character) in from.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = index + 1;
        for column in 1..row.len() {
            let replaced = diagonal + usize::from(to[column - 1] != character);
            diagonal = row[column];
            row[column] = replaced.min(row[column] + 1).min(row[column - 1] + 1);
        }
    }
    row[to.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_is_recognised_and_another_word_is_not() {
        let names = ["lamp_radius", "field_length", "step"];
        assert_eq!(nearest("bal_radius", names), Some("lamp_radius"));
        assert_eq!(nearest("stpe", names), Some("step"));
        assert_eq!(nearest("whistle", names), None);
        assert_eq!(nearest("step", []), None);
    }
}
