//! `schema`: the JSON schema of the manifest.

use super::terminal::Terminal;
use crate::outcome::{Outcome, Refusal};

pub(super) fn run(terminal: &Terminal) -> Result<Outcome, Refusal> {
    terminal.data(&schema::json_schema())?;
    Ok(Outcome::Good)
}
