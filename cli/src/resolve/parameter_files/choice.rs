//! `parameters.toml` beside the layers: the location of targets that name none.

use std::ops::Range;

use camino::{Utf8Path, Utf8PathBuf};
use toml::de::{DeTable, DeValue};

use crate::diagnostics::{Code, Diagnostic, Diagnostics, nearest};
use crate::workspace::Workspace;

/// The location that the file names.
pub(super) struct Choice {
    pub(super) location: String,
    pub(super) file: Utf8PathBuf,
    /// Of the location.
    pub(super) range: Range<usize>,
}

const LOCATION: &str = "location";

/// What the folder's `parameters.toml` says, if it is there; everything else in it is an error, as it is for the robot.
pub(super) fn load(
    workspace: &Workspace,
    folder: &Utf8Path,
    diagnostics: &mut Diagnostics,
) -> Option<Choice> {
    let file = folder.join("parameters.toml");
    let text = match workspace.read(&file) {
        Ok(text) => text,
        Err(error) => {
            if !error.missing {
                let error = Diagnostic::new(Code::Syntax, error.to_string());
                diagnostics.add(error.at(&file, 0..0, ""));
            }
            return None;
        }
    };
    let (table, errors) = DeTable::parse_recoverable(&text);
    for error in &errors {
        let place = error.span().unwrap_or(0..0);
        diagnostics.add(Diagnostic::new(Code::Syntax, error.message()).at(&file, place, ""));
    }
    if !errors.is_empty() {
        return None;
    }
    report_unknown(table.get_ref(), &file, diagnostics);
    let value = table.get_ref().get(LOCATION)?;
    let DeValue::String(location) = value.get_ref() else {
        let error = Diagnostic::new(Code::InvalidValue, "`location` is no string")
            .at(&file, value.span(), "")
            .help("write the name of a folder beside this file");
        diagnostics.add(error);
        return None;
    };
    Some(Choice {
        location: location.to_string(),
        range: value.span(),
        file,
    })
}

fn report_unknown(table: &DeTable<'_>, file: &Utf8Path, diagnostics: &mut Diagnostics) {
    for key in table.keys().filter(|key| key.get_ref() != LOCATION) {
        let name = key.get_ref();
        let help = nearest(name, [LOCATION]).map(|near| format!("did you mean `{near}`?"));
        let error = Diagnostic::new(Code::UnknownKey, format!("`{name}` is no key here"))
            .at(file, key.span(), "")
            .help("remove it: values of parameters stand in `default.toml`")
            .help_if(help);
        diagnostics.add(error);
    }
}
