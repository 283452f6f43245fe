//! `--replay`: recorded cycles run again, instead of the robot.

use std::io::Write;
use std::path::Path;

use hulkgen_recording::Recording;

use super::options::{Format, Options};
use super::{DONE, FAILED, Target};
use crate::error::{Error, Result};
use crate::replay::verify;
use crate::report::tell;

/// Verifies a recording; gives the exit status.
pub(super) fn run(target: &Target, file: &Path, options: &Options, output: &mut dyn Write) -> u8 {
    match verified(target, file, options, output) {
        Ok(true) => DONE,
        Ok(false) => FAILED,
        Err(error) => {
            tell(format_args!("error: {}: {error}", file.display()));
            FAILED
        }
    }
}

fn verified(
    target: &Target,
    file: &Path,
    options: &Options,
    output: &mut dyn Write,
) -> Result<bool> {
    let recording = Recording::open(file).map_err(|error| Error::new(error.to_string()))?;
    let verification = verify(&recording, target.replayables)?;
    match options.format {
        Format::Json => writeln!(output, "{}", verification.to_json())?,
        Format::Text => write!(output, "{verification}")?,
    }
    if !recording.is_complete() {
        tell(format_args!(
            "the recording is INCOMPLETE: frames were dropped, or it was cut off"
        ));
    }
    Ok(verification.is_good())
}
