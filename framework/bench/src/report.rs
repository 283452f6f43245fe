//! What several process starts measured, as one table with limits.

use crate::measure::{Measured, quantile};

/// Medians over the process starts.
pub(crate) struct Report {
    rows: Vec<Measured>,
}

/// A part of the table.
pub(crate) struct Section {
    pub(crate) title: &'static str,
    /// What durations are divided by, with its name.
    pub(crate) unit: (&'static str, f64),
    pub(crate) rows: Vec<Measured>,
    pub(crate) limits: Vec<Limit>,
}

/// A figure and what it must not exceed.
pub(crate) struct Limit {
    what: &'static str,
    figure: f64,
    limit: f64,
    unit: &'static str,
}

impl Limit {
    pub(crate) fn new(what: &'static str, figure: f64, limit: f64, unit: &'static str) -> Self {
        Self {
            what,
            figure,
            limit,
            unit,
        }
    }

    pub(crate) fn is_met(&self) -> bool {
        self.figure <= self.limit
    }
}

impl Report {
    /// `runs` have the same rows.
    pub(crate) fn of(runs: &[Vec<Measured>]) -> Self {
        let rows = runs.first().map_or(&[][..], Vec::as_slice);
        let median = |index: usize, of: fn(&Measured) -> f64| {
            let mut values: Vec<_> = runs.iter().map(|run| of(&run[index])).collect();
            quantile(&mut values, 0.5)
        };
        let rows = rows.iter().enumerate().map(|(index, row)| Measured {
            name: row.name.clone(),
            nanos: median(index, |row| row.nanos),
            allocations: median(index, |row| row.allocations),
        });
        Self {
            rows: rows.collect(),
        }
    }

    fn index(&self, name: &str) -> usize {
        let found = self.rows.iter().position(|row| row.name == name);
        found.unwrap_or_else(|| panic!("no row `{name}` was measured"))
    }

    pub(crate) fn nanos(&self, name: &str) -> f64 {
        self.rows[self.index(name)].nanos
    }

    pub(crate) fn allocations(&self, name: &str) -> f64 {
        self.rows[self.index(name)].allocations
    }

    pub(crate) fn rows_until(&self, first: &str, last: &str) -> Vec<Measured> {
        self.rows[self.index(first)..=self.index(last)].to_vec()
    }
}

/// Prints a part of the table; whether all of its limits are met.
pub(crate) fn print(section: &Section) -> bool {
    let (unit, nanos) = section.unit;
    println!("\n{}", section.title);
    println!("  {:<44} {:>10} {:>8} {:>8}", "row", "ns", unit, "allocs");
    for row in &section.rows {
        println!(
            "  {:<44} {:>10.1} {:>8.2} {:>8.2}",
            row.name,
            row.nanos,
            row.nanos / nanos,
            row.allocations
        );
    }
    for limit in &section.limits {
        let verdict = if limit.is_met() { "met" } else { "MISSED" };
        println!(
            "  {:<44} {:>10.2} {:<5} limit {:.2} {} {verdict}",
            limit.what, limit.figure, limit.unit, limit.limit, limit.unit
        );
    }
    section.limits.iter().all(Limit::is_met)
}
