//! The command `hulkgen`; everything it does is in the library of the same name.

use std::process::ExitCode;
use std::thread;

use clap::Parser as _;
use hulkgen::arguments::Arguments;
use hulkgen::{commands, interrupt, outcome};

/// Bytes; syntax is read by functions that call themselves, as deep as `scan` permits. Only what is used is taken.
const STACK: usize = 256 << 20;

fn main() -> ExitCode {
    outcome::report_bugs();
    interrupt::end_hulkgen();
    let arguments = Arguments::parse();
    let commands = thread::Builder::new()
        .stack_size(STACK)
        .spawn(move || commands::run(&arguments));
    match commands.map(thread::JoinHandle::join) {
        Ok(Ok(outcome)) => outcome.into(),
        // The panic was reported as a bug when it happened.
        Ok(Err(_)) => ExitCode::from(101),
        Err(error) => panic!("no thread can be started: {error}"),
    }
}
