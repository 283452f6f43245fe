//! What came of a scenario, for people and for programs.

use std::fmt;
use std::path::PathBuf;

use serde::Serialize;

use super::judge::Verdict;
use crate::report::plural;

/// One run with one seed.
#[derive(Clone, Debug, Serialize)]
pub struct Played {
    /// What was drawn from it.
    pub seed: u64,
    /// Whether every assertion was so, and nothing stopped before the end, its recording neither.
    pub passed: bool,
    /// Why a robot, all of it, or a recording stopped before the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped: Option<String>,
    /// Calls of nodes that failed.
    pub failures: u64,
    /// Of all that each robot's instances wrote, if that was asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub digests: Vec<String>,
    /// What the run was recorded into, where it did not pass: one file for each robot.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<PathBuf>,
    /// One for each assertion.
    pub assertions: Vec<Verdict>,
    /// Seconds of the scenario.
    pub lasted: f64,
    /// How many of them passed in a second of this machine.
    pub real_time_factor: f64,
}

/// A scenario with all its seeds.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// Version of this form.
    pub version: u32,
    /// Where it stands.
    pub scenario: PathBuf,
    /// As it says about itself.
    pub about: String,
    /// Whether enough seeds passed.
    pub passed: bool,
    /// How many did.
    pub passes: usize,
    /// How many have to.
    pub needed: usize,
    /// In the order of the seeds.
    pub runs: Vec<Played>,
}

impl fmt::Display for Outcome {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = if self.passed { "passed" } else { "FAILED" };
        writeln!(
            formatter,
            "{word}  {}: {} of {} seeds, {} needed",
            self.scenario.display(),
            self.passes,
            self.runs.len(),
            self.needed
        )?;
        self.runs.iter().try_for_each(|run| run.fmt(formatter))
    }
}

impl Played {
    /// One line about the whole run.
    pub fn headline(&self) -> String {
        let word = if self.passed { "passed" } else { "FAILED" };
        format!(
            "seed {}: {word} ({:.1} s, {:.1} times real time)",
            self.seed, self.lasted, self.real_time_factor
        )
    }
}

impl fmt::Display for Played {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(formatter, "  {}", self.headline())?;
        if let Some(why) = &self.stopped {
            writeln!(formatter, "    FAILED  stopped early: {why}")?;
        }
        if self.failures > 0 {
            let calls = plural(self.failures, "call");
            writeln!(formatter, "    {calls} of nodes failed")?;
        }
        for (robot, digest) in (1..).zip(&self.digests) {
            writeln!(formatter, "    digest of robot {robot}: {digest}")?;
        }
        for recording in &self.recordings {
            writeln!(formatter, "    recorded into {}", recording.display())?;
        }
        for verdict in &self.assertions {
            let word = if verdict.passed { "passed" } else { "FAILED" };
            let at = verdict
                .at
                .map_or_else(String::new, |at| format!(" at {at:.3} s"));
            writeln!(
                formatter,
                "    {word}  {}: {}{at}",
                verdict.what, verdict.seen
            )?;
        }
        Ok(())
    }
}
