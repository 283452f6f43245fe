//! The command `hulkgen`; everything it does is in the library of the same name.

use std::process::ExitCode;

use clap::Parser as _;
use hulkgen::arguments::Arguments;
use hulkgen::{commands, outcome};

fn main() -> ExitCode {
    outcome::report_bugs();
    outcome::end_at_interrupt();
    commands::run(&Arguments::parse()).into()
}
