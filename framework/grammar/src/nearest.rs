//! The valid name that an author probably meant.

/// The candidate with the fewest edits, if so few that it was probably meant.
pub(crate) fn nearest<'a>(
    written: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|candidate| (edits(written, candidate), candidate))
        .filter(|(edits, candidate)| *edits <= candidate.len().max(written.len()) / 3)
        .min()
        .map(|(_, candidate)| candidate)
}

/// Levenshtein distance, upper and lower case alike.
fn edits(left: &str, right: &str) -> usize {
    let right: Vec<char> = right.to_lowercase().chars().collect();
    let mut row: Vec<usize> = (0..=right.len()).collect();
    for (above, character) in left.to_lowercase().chars().enumerate() {
        let mut diagonal = above;
        row[0] = above + 1;
        for (column, other) in right.iter().enumerate() {
            let replaced = diagonal + usize::from(character != *other);
            diagonal = row[column + 1];
            row[column + 1] = replaced.min(row[column] + 1).min(diagonal + 1);
        }
    }
    row[right.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn the_name_with_the_fewest_edits_is_meant() {
        let kinds = ["Input", "LatestInput", "Parameter", "PreviousInput"];
        for (written, meant) in [
            ("Imput", Some("Input")),
            ("input", Some("Input")),
            ("Paramter", Some("Parameter")),
            ("LastInput", Some("LatestInput")),
            ("Vec", None),
            ("", None),
        ] {
            assert_eq!(nearest(written, kinds), meant, "{written}");
        }
    }
}
