//! Adds up what the robot, its clients and the system say.

use std::fmt::Write as _;
use std::time::Duration;

use serde_json::Value;

use crate::Result;
use crate::clients::Told;
use crate::deeds::Done;
use crate::vitals::Vitals;

/// What may be on its way between two cyclers when the robot ends.
const ON_ITS_WAY: u64 = 4;

/// It is made to fail.
const FAILING: &str = "control::tone_player";

/// No referee and no team talks to this robot.
const UNFED: &str = "SplNetwork";

/// What memory may grow by, beside a tenth: the recording's blocks and the server's queues fill up.
const SLACK: u64 = 32 << 10;

/// Files of clients that come and go.
const CONNECTIONS: u64 = 8;

/// A robot without a body looks for one once a second: half a second of every new one passes on average.
const LOOKED_FOR: Duration = Duration::from_millis(500);

/// A body says something every 12 ms.
const STATES_PER_SECOND: f64 = 1000.0 / 12.0;

/// What was looked at, and what of it does not add up.
#[derive(Default)]
pub(crate) struct Judge {
    rows: Vec<Row>,
}

struct Row {
    name: String,
    what: String,
    wrong: Vec<String>,
}

/// A counter of the report.
fn count(of: &Value, key: &str) -> u64 {
    of[key].as_u64().unwrap_or_default()
}

fn list<'a>(of: &'a Value, key: &str) -> &'a [Value] {
    of[key].as_array().map_or(&[], Vec::as_slice)
}

fn name<'a>(of: &'a Value, key: &str) -> &'a str {
    of[key].as_str().unwrap_or("?")
}

impl Judge {
    pub(crate) fn is_good(&self) -> bool {
        self.rows.iter().all(|row| row.wrong.is_empty())
    }

    /// Markdown, with what is wrong below.
    pub(crate) fn table(&self, seed: u64, lasted: Duration) -> String {
        let mut table = format!(
            "seed {seed}, {:.0} s\n\n| What | Counted | |\n|---|---|---|\n",
            lasted.as_secs_f64()
        );
        for Row { name, what, wrong } in &self.rows {
            let verdict = if wrong.is_empty() { "ok" } else { "WRONG" };
            let _ = writeln!(table, "| {name} | {what} | {verdict} |");
        }
        for row in &self.rows {
            for wrong in &row.wrong {
                let _ = writeln!(table, "\n{}: {wrong}", row.name);
            }
        }
        table
    }

    fn row(&mut self, name: impl Into<String>, what: String, wrong: Vec<String>) {
        self.rows.push(Row {
            name: name.into(),
            what,
            wrong,
        });
    }

    pub(crate) fn clients(&mut self, all: Vec<Result<Told>>) {
        for told in all {
            match told {
                Ok(Told { name, what, wrong }) => self.row(format!("client: {name}"), what, wrong),
                Err(message) => self.row("a client", String::new(), vec![message]),
            }
        }
    }

    /// Each deed was done; the node that was made to fail has failed, and no other.
    pub(crate) fn deeds(&mut self, done: &Done, report: &Value) {
        let mut wrong = Vec::new();
        for (what, count) in [
            ("failing nodes", done.failing_nodes),
            ("full disks", done.full_disks),
            ("killed simulators", done.killed_simulators),
        ] {
            if count == 0 {
                wrong.push(format!("no {what}: let it run longer"));
            }
        }
        let nodes = list(report, "instances")
            .iter()
            .flat_map(|it| list(it, "nodes"));
        let (made, others): (Vec<_>, Vec<_>) = nodes
            .filter(|node| count(node, "failures") > 0)
            .partition(|node| name(node, "node") == FAILING);
        if made.is_empty() == (done.failing_nodes > 0) {
            wrong.push(format!(
                "{FAILING} was made to fail {} times",
                done.failing_nodes
            ));
        }
        for node in others {
            wrong.push(format!(
                "{} has failed, and nobody made it",
                name(node, "node")
            ));
        }
        let what = format!(
            "{} failing nodes, {} full disks, {} killed simulators",
            done.failing_nodes, done.full_disks, done.killed_simulators
        );
        self.row("went wrong", what, wrong);
    }

    /// Calls of nodes, failures and queues of each instance.
    pub(crate) fn report(&mut self, report: &Value) {
        let instances = list(report, "instances");
        for instance in instances {
            let cycles = count(instance, "cycles");
            let nodes = list(instance, "nodes");
            let failures: u64 = nodes.iter().map(|node| count(node, "failures")).sum();
            let mut wrong = Vec::new();
            if cycles == 0 && name(instance, "instance") != UNFED {
                wrong.push("no cycle".to_owned());
            }
            if failures != count(instance, "failures") {
                wrong.push(format!(
                    "{failures} failures of nodes, {} of the instance",
                    count(instance, "failures")
                ));
            }
            let whole = |node: &&Value| count(node, "calls") + count(node, "skipped");
            // Setup nodes wait: one call more may have found nothing.
            let is_counted = |node: &&Value| whole(node).abs_diff(cycles) <= ON_ITS_WAY;
            for node in nodes.iter().skip(1).filter(|node| !is_counted(node)) {
                wrong.push(format!(
                    "{}: {} calls and {} skipped in {cycles} cycles",
                    name(node, "node"),
                    count(node, "calls"),
                    count(node, "skipped")
                ));
            }
            for queue in list(instance, "queues") {
                let from = name(queue, "from");
                let announced = instances
                    .iter()
                    .find(|it| name(it, "instance") == from)
                    .map_or(0, |it| count(it, "cycles"));
                let came = count(queue, "delivered") + count(queue, "dropped");
                if came > announced || announced - came > ON_ITS_WAY {
                    wrong.push(format!(
                        "{announced} cycles of {from}, {came} delivered or dropped"
                    ));
                }
            }
            let what = format!("{cycles} cycles, {failures} failures of nodes");
            self.row(name(instance, "instance").to_owned(), what, wrong);
        }
    }

    /// What was wanted is in the file or counted as not, and what is in the file, computed again, is the same.
    pub(crate) fn recording(&mut self, report: &Value, verified: Result<Value>) {
        let verified = verified.unwrap_or_else(Value::String);
        let (mut wanted, mut frames, mut wrong) = (0, 0, Vec::new());
        // Lines of the log are recorded, too, but nobody computes them again: those that a full disk takes are counted.
        let recorded = list(report, "recorded").iter();
        for one in recorded.filter(|one| one.get("wanted").is_some()) {
            let instance = name(one, "instance");
            let again = list(&verified, "instances")
                .iter()
                .find(|it| name(it, "instance") == instance)
                .unwrap_or(&Value::Null);
            wanted += count(one, "wanted");
            frames += count(again, "frames");
            let missing = ["dropped", "failed", "lost", "overwritten"].map(|key| count(one, key));
            let missing: u64 = missing.iter().sum();
            let is_counted = count(again, "frames") + missing == count(one, "wanted");
            let is_equal = count(again, "verified") + count(again, "unfinished")
                == count(again, "frames")
                && count(again, "diverged") == 0;
            if !(is_counted && is_equal) {
                wrong.push(format!(
                    "{instance}: recorded {one}, computed again {again}"
                ));
            }
        }
        if frames == 0 {
            wrong.push(format!(
                "nothing is recorded, or computed again: {verified}"
            ));
        }
        let state = name(report, "recording_state");
        let what = format!("{state}: {frames} of {wanted} cycles, computed again");
        self.row("recording", what, wrong);
    }

    /// Memory and open files do not grow.
    pub(crate) fn vitals(&mut self, vitals: &Vitals) {
        // The first quarter fills what is kept.
        let (memory, files) = vitals.most(25, 50);
        let (later, later_files) = vitals.most(50, 100);
        let mut wrong = Vec::new();
        if vitals.looks.len() < 4 {
            wrong.push("nobody looked".to_owned());
        }
        if later > memory + memory / 10 + SLACK {
            wrong.push("memory grows".to_owned());
        }
        if later_files > files + CONNECTIONS {
            wrong.push("open files grow".to_owned());
        }
        let what = format!(
            "{} MiB then {} MiB, {files} files then {later_files}",
            memory >> 10,
            later >> 10
        );
        self.row("memory, files", what, wrong);
    }

    /// Nothing panicked that nobody made panic.
    pub(crate) fn log(&mut self, log: &[String]) {
        let panics = log.iter().filter(|line| line.contains("panicked at"));
        let wrong: Vec<_> = panics.cloned().collect();
        self.row("log", format!("{} lines", log.len()), wrong);
    }

    /// How many of the body's states Control had a cycle for.
    pub(crate) fn rate(&mut self, report: &Value, done: &Done, has_to_be: bool) {
        let control = list(report, "instances")
            .iter()
            .find(|it| name(it, "instance") == "Control")
            .map_or(0, |it| count(it, "cycles"));
        let kills = u32::try_from(done.killed_simulators).unwrap_or(u32::MAX);
        let with_body = done.with_body.saturating_sub(LOOKED_FOR * kills);
        #[expect(clippy::cast_precision_loss, reason = "a few million cycles")]
        let rate = control as f64 / with_body.as_secs_f64();
        let mut wrong = Vec::new();
        if has_to_be && rate < 0.95 * STATES_PER_SECOND {
            wrong.push(format!("of {STATES_PER_SECOND:.1} a second"));
        }
        self.row(
            "rate of Control",
            format!("{rate:.1} a second while it has a body"),
            wrong,
        );
    }
}
