//! The standard output of the process, where data goes.

use std::fs::File;
use std::io::{self, LineWriter, Write};
use std::os::fd::AsFd;

use rustix::stdio::dup2_stdout;

use super::FAILED;
use super::options::Options;
use crate::error::Error;
use crate::report::tell;

/// Where this process writes its data; else the exit status. What nodes and hardware print, and libraries of theirs, may not
/// come between its answers: it goes to standard error from here on.
pub(super) fn of_process(options: &Options) -> Result<Box<dyn Write>, u8> {
    if !options.answers() {
        return Ok(Box::new(io::stdout()));
    }
    let output = apart().map_err(|error| {
        let error = Error::from(error).context("cannot keep standard output for answers");
        tell(format_args!("error: {error}"));
        FAILED
    })?;
    Ok(Box::new(LineWriter::new(output)))
}

fn apart() -> io::Result<File> {
    io::stdout().flush()?;
    let output = io::stdout().as_fd().try_clone_to_owned()?;
    dup2_stdout(io::stderr())?;
    Ok(output.into())
}
