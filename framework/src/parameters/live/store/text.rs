//! The text of a file, with values changed in it.

use std::path::Path as FilePath;

use toml_edit::{DocumentMut, Table};

use super::whole;
use crate::parameters::live::refusal::{Refusal, Refusals};

/// Some editors begin a file with it; the document does not keep it.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// Everything that `change` leaves stays as it is, line ends too.
pub(super) fn with(
    before: &str,
    file: &FilePath,
    change: impl FnOnce(&mut Table) -> Result<(), Refusal>,
) -> Result<String, Refusals> {
    let mut document: DocumentMut = before
        .parse()
        .map_err(|error| whole(format!("{}: {error}", file.display())))?;
    // Comments in front of nothing stay in front.
    let is_new = document.is_empty() && (before.is_empty() || before.ends_with('\n'));
    if is_new {
        document = DocumentMut::new();
    }
    change(document.as_table_mut())?;
    let text = match is_new {
        true => format!("{before}{document}"),
        false => document.to_string(),
    };
    Ok(with_line_ends_of(before, &text))
}

/// The document knows one kind of line end; in a file with both, the more frequent one is taken.
fn with_line_ends_of(before: &str, text: &str) -> String {
    let mut text = text.replace("\r\n", "\n");
    if before.starts_with(BYTE_ORDER_MARK) && !text.starts_with(BYTE_ORDER_MARK) {
        text.insert(0, BYTE_ORDER_MARK);
    }
    let all = before.matches('\n').count();
    let long = before.matches("\r\n").count();
    match 2 * long > all {
        true => text.replace('\n', "\r\n"),
        false => text,
    }
}
