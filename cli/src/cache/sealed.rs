//! A text with the digest of itself in front: what was cut off, mixed up or written by another version is not opened.

use crate::digest::Digest;

/// The first words; the number changes with the form of what follows.
const HEADER: &str = "hulkgen answer 1 ";

/// The text as it is kept.
pub(super) fn seal(text: &str) -> String {
    format!("{HEADER}{}\n{text}", Digest::of(text.as_bytes()))
}

/// The text that was sealed; `None` if it is not whole.
pub(super) fn open(sealed: &str) -> Option<&str> {
    let (digest, text) = sealed.strip_prefix(HEADER)?.split_once('\n')?;
    (Digest::of(text.as_bytes()).to_string() == digest).then_some(text)
}

#[cfg(test)]
mod tests {
    use super::{open, seal};

    #[test]
    fn only_a_whole_text_is_opened() {
        let sealed = seal("{\"a\": 1}");
        assert_eq!(open(&sealed), Some("{\"a\": 1}"));
        for end in 0..sealed.len() {
            assert_eq!(open(&sealed[..end]), None, "{}", &sealed[..end]);
        }
        assert_eq!(open(&sealed.replace(": 1", ": 2")), None);
        assert_eq!(open(&sealed.replace("answer 1", "answer 2")), None);
        assert_eq!(open(&format!("{sealed} ")), None);
    }
}
