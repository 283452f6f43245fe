//! What the framework costs: rows that are measured together, and what is asked of their ratios.
//!
//! ```text
//! cargo run --release                 three process starts, one table, nothing is written
//! cargo run --release -- --rows       what one process start measures, one row a line
//! cargo run --release -- --threads    the same of what needs threads
//! cargo run --release -- --rows NAME  one row alone, for a profiler
//! cargo run --release -- --times N NAME   so often and no more, to count instructions
//! ```

#[path = "../../tests/allocation/counting.rs"]
mod counting;
mod floor;
mod measure;
mod mix;
mod parts;
mod recorded;
mod report;
mod threads;
mod trivial;
mod turn;

use std::process::{Command, ExitCode};

use framework::Result;

use measure::{Measured, Row};
use report::Report;

/// Placement in memory differs from start to start.
const STARTS: usize = 3;
const ROUNDS: usize = 61;

fn main() -> ExitCode {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
    let done = match arguments[..] {
        [] => measure_and_print(),
        ["--rows"] => rows().map(print_measured),
        ["--threads"] => threads::measure().map(print_all),
        ["--times", times, name] => rows().map(|rows| {
            let found = rows.into_iter().find(|row| row.is(name));
            found
                .zip(times.parse().ok())
                .map(|(mut row, times)| row.repeat(times))
                .is_some()
        }),
        ["--rows", name] => {
            rows().map(|rows| print_measured(rows.into_iter().filter(|row| row.is(name)).collect()))
        }
        _ => {
            eprintln!("no arguments: measures and prints the table");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn rows() -> Result<Vec<Row<'static>>> {
    let mut rows = trivial::rows()?;
    rows.extend(parts::rows());
    rows.extend(mix::rows()?);
    Ok(rows)
}

/// Whether all limits are met.
fn measure_and_print() -> Result<bool> {
    let mut runs = Vec::new();
    for _ in 0..STARTS {
        let mut run = measure_in_a_process("--rows")?;
        run.extend(measure_in_a_process("--threads")?);
        runs.push(run);
    }
    let report = Report::of(&runs);
    let sections = [
        trivial::section(&report),
        parts::section(&report),
        mix::section(&report),
        threads::section_of_pace(&report),
        threads::section(&report),
    ];
    Ok(sections
        .iter()
        .map(report::print)
        .fold(true, |all, met| all & met))
}

fn measure_in_a_process(what: &str) -> Result<Vec<Measured>> {
    let program = std::env::current_exe()?;
    let output = Command::new(program).arg(what).output()?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(framework::Error::new(format!("a process failed: {said}")));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let rows = text.lines().filter_map(|line| {
        let mut parts = line.split('\t');
        Some(Measured {
            name: parts.next()?.to_owned(),
            nanos: parts.next()?.parse().ok()?,
            allocations: parts.next()?.parse().ok()?,
        })
    });
    Ok(rows.collect())
}

fn print_measured(rows: Vec<Row<'static>>) -> bool {
    print_all(measure::measure(rows, ROUNDS))
}

fn print_all(measured: Vec<Measured>) -> bool {
    for Measured {
        name,
        nanos,
        allocations,
    } in measured
    {
        println!("{name}\t{nanos}\t{allocations}");
    }
    true
}
