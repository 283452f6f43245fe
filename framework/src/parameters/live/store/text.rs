//! The text of a file, with values changed in it.

use std::path::Path as FilePath;

use toml_edit::{DocumentMut, Table};

use super::whole;
use crate::parameters::live::refusal::{Refusal, Refusals};

/// Everything that `change` leaves stays as it is.
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
    Ok(text)
}
