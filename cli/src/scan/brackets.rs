//! Which bracket, text or comment of a file has no other end: all that is said elsewhere is that there are no tokens.

use std::ops::Range;

use camino::Utf8Path;

use crate::diagnostics::{Code, Diagnostic};

/// One end without the other.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Unbalanced {
    /// A bracket that closes nothing.
    Closed(Range<usize>),
    /// A bracket that nothing closes; the second place is that of another kind that came first.
    Opened(Range<usize>, Option<Range<usize>>),
    /// A text or comment that goes on to the end of the file; the second place is that of a text over lines in front of it
    /// whose own end it may be that is missing.
    Endless(Range<usize>, &'static str, Option<Range<usize>>),
}

/// A bracket that is still open.
struct Open {
    at: usize,
    bracket: u8,
    indentation: usize,
}

const TEXT: &str = "text";

/// The first such place; none in a text whose brackets are in order.
pub(super) fn unbalanced(text: &str) -> Option<Unbalanced> {
    let bytes = text.as_bytes();
    let mut open: Vec<Open> = Vec::new();
    // A bracket whose supposed end stands farther left than its line: more likely than any other the one that is not closed.
    let mut suspect: Option<usize> = None;
    let mut texts: Vec<Range<usize>> = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let next = match behind(text, at) {
            Ok(next) => next,
            Err(what) => {
                let (at, other) = match what {
                    TEXT => endless(text, &texts, at),
                    _ => (at, None),
                };
                let other = other.map(|other| other..other + 1);
                return Some(Unbalanced::Endless(at..at + 1, what, other));
            }
        };
        if next > at {
            if bytes[at] == b'"' {
                texts.push(at..next);
            }
            at = next;
            continue;
        }
        match bytes[at] {
            bracket @ (b'(' | b'[' | b'{') => open.push(Open {
                at,
                bracket,
                indentation: indentation(text, at).0,
            }),
            b')' | b']' | b'}' => {
                let Some(last) = open.pop() else {
                    return Some(Unbalanced::Closed(at..at + 1));
                };
                if closing(last.bracket) != bytes[at] {
                    let has_begun = open.iter().any(|one| closing(one.bracket) == bytes[at]);
                    return Some(match has_begun {
                        true => Unbalanced::Opened(last.at..last.at + 1, Some(at..at + 1)),
                        false => Unbalanced::Closed(at..at + 1),
                    });
                }
                let (indentation, is_first) = indentation(text, at);
                if is_first && indentation < last.indentation {
                    suspect.get_or_insert(last.at);
                }
            }
            _ => {}
        }
        at += 1;
    }
    let last = open.last()?.at;
    let at = suspect.unwrap_or(last);
    Some(Unbalanced::Opened(at..at + 1, None))
}

/// Which text lacks its end, where the one that begins here goes on to the end of the file; and which other one it may be.
///
/// Where one lacks its end, the next one's beginning is taken for it, and from then on code between two texts for a text.
fn endless(text: &str, texts: &[Range<usize>], at: usize) -> (usize, Option<usize>) {
    // What stands behind a text in code; few texts that go over lines begin so.
    let is_code = |start: &usize| {
        let inside = text[start + 1..].trim_start_matches(' ');
        inside.starts_with([')', ']', '}', ',', ';', '.', '?']) || inside.starts_with("=>")
    };
    let is_long = |one: &&Range<usize>| text[one.start..one.end].contains('\n');
    let mut long = texts.iter().filter(is_long).map(|one| one.start);
    let Some(code) = long.clone().chain([at]).find(is_code) else {
        return (at, long.next());
    };
    let mut before = texts.iter().map(|one| one.start);
    let last = before.rfind(|start| *start < code && !is_code(start));
    (last.unwrap_or(code), None)
}

fn closing(bracket: u8) -> u8 {
    match bracket {
        b'(' => b')',
        b'[' => b']',
        _ => b'}',
    }
}

/// How far right the line of this place begins, and whether it begins with the place.
fn indentation(text: &str, at: usize) -> (usize, bool) {
    let line = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let before = &text[line..at];
    let blank = before.len() - before.trim_start().len();
    (blank, blank == before.len())
}

/// The end of the comment, text, name or character that begins here; `at` itself where none does.
fn behind(text: &str, at: usize) -> Result<usize, &'static str> {
    let rest = &text[at..];
    let bytes = rest.as_bytes();
    let found = |length: Option<usize>, what| length.map(|length| at + length).ok_or(what);
    match bytes[0] {
        b'/' if rest.starts_with("//") => Ok(at + rest.find('\n').unwrap_or(rest.len())),
        b'/' if rest.starts_with("/*") => found(comment(bytes), "comment"),
        b'"' => found(quoted(bytes, b'"'), TEXT),
        b'\'' => Ok(at + character(rest)),
        _ => {
            let is_of_name = |one: char| one.is_alphanumeric() || one == '_';
            let name = rest.len() - rest.trim_start_matches(is_of_name).len();
            let behind = &rest[name..];
            let hashes = behind.len() - behind.trim_start_matches('#').len();
            let is_raw = matches!(&rest[..name], "r" | "br" | "cr");
            if is_raw && behind[hashes..].starts_with('"') {
                let end = format!("\"{}", "#".repeat(hashes));
                let begin = name + hashes + 1;
                let length = rest[begin..].find(&end);
                return found(length.map(|length| begin + length + end.len()), TEXT);
            }
            Ok(at
                + match bytes[0].is_ascii() {
                    true => name,
                    false => name.max(rest.chars().next().map_or(0, char::len_utf8)),
                })
        }
    }
}

/// The length of a comment that may have others in it.
fn comment(bytes: &[u8]) -> Option<usize> {
    let (mut depth, mut at) = (0, 0);
    while at + 1 < bytes.len() {
        match &bytes[at..at + 2] {
            b"/*" => (depth, at) = (depth + 1, at + 2),
            b"*/" => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

/// The length of what stands between two of these quotes.
fn quoted(bytes: &[u8], quote: u8) -> Option<usize> {
    let mut at = 1;
    while at < bytes.len() {
        match bytes[at] {
            b'\\' => at += 2,
            end if end == quote => return Some(at + 1),
            _ => at += 1,
        }
    }
    None
}

/// The length of a character, or that of the quote alone in front of a lifetime.
fn character(rest: &str) -> usize {
    let mut inside = rest[1..].chars();
    match inside.next() {
        Some('\\') => quoted(rest.as_bytes(), b'\'').unwrap_or(1),
        Some(one) if inside.next() == Some('\'') => 2 + one.len_utf8(),
        _ => 1,
    }
}

impl Unbalanced {
    /// The diagnostic, at this place of the file.
    pub(super) fn describe(&self, file: &Utf8Path, text: &str) -> Diagnostic {
        let error = |message: String| Diagnostic::new(Code::Syntax, message);
        match self {
            Self::Closed(at) => {
                let bracket = &text[at.clone()];
                error(format!("this `{bracket}` closes nothing"))
                    .at(file, at.clone(), "")
                    .help("remove it, or write the bracket in front of it that is missing")
            }
            Self::Opened(at, other) => {
                let end = char::from(closing(text.as_bytes()[at.start]));
                let error = error(format!("this `{}` is not closed", &text[at.clone()]));
                let error = error.at(file, at.clone(), format!("where is its `{end}`?"));
                match other {
                    Some(other) => {
                        let came = format!("`{}` came first", &text[other.clone()]);
                        error.at(file, other.clone(), came)
                    }
                    None => error,
                }
                .help(format!(
                    "write the `{end}`, or remove the `{}`",
                    &text[at.clone()]
                ))
            }
            Self::Endless(at, what, other) => {
                let error = error(format!("this {what} has no end"));
                let error = error.at(file, at.clone(), "begins here");
                match other {
                    Some(other) => {
                        let may_be = "or this one, which goes over lines, has none";
                        error.at(file, other.clone(), may_be)
                    }
                    None => error,
                }
                .help(match *what {
                    "comment" => "write `*/` where it ends",
                    _ => "write `\"` where it ends",
                })
            }
        }
    }
}

#[cfg(test)]
mod tests;
