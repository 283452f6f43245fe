//! How a recording went.

use std::fmt;

use hulkgen_recording::Ended;
use serde_json::{Value, json};

/// How a recording went.
#[derive(Debug)]
pub struct RecordingReport {
    pub ended: Ended,
    /// In manifest order.
    pub instances: Vec<InstanceRecorded>,
    /// Values of outputs, and log messages, that are missing.
    pub missing: Vec<Missing>,
}

/// What the file should have beside frames, and has not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// `INSTANCE.outputs`, or `logs`.
    pub of: String,
    /// There was no room for them, or they are larger than a block.
    pub dropped: u64,
    /// They could not be encoded.
    pub failed: u64,
    /// The disk did not take them, or a value of theirs could not be written.
    pub lost: u64,
}

/// What became of the cycles of one instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InstanceRecorded {
    pub instance: &'static str,
    /// Cycles that its `record` asks for.
    pub wanted: u64,
    /// Handed over; those that are lost or overwritten are among them.
    pub recorded: u64,
    /// There was no room for them.
    pub dropped: u64,
    /// They could not be encoded.
    pub failed: u64,
    /// The disk did not take them, or a value of theirs could not be written.
    pub lost: u64,
    /// They were recorded, and left to younger ones when the file had its budget or the disk was full.
    pub overwritten: u64,
}

/// Its counts are those of what was handed over until then.
const OUTSTANDING: &str = "the disk is too slow or hangs and has not taken all of it: how much is missing at its end is not known";

impl RecordingReport {
    /// `COMPLETE` where everything that was wanted was recorded.
    pub fn state(&self) -> &'static str {
        if self.ended.is_complete {
            "COMPLETE"
        } else {
            "INCOMPLETE"
        }
    }

    /// What the disk said first, or that it has not taken all of it.
    pub fn error(&self) -> Option<String> {
        let outstanding = || self.ended.is_outstanding.then(|| OUTSTANDING.to_owned());
        let said = self.ended.error.as_ref().map(ToString::to_string);
        said.or_else(outstanding)
    }

    /// Counts by instance.
    pub fn to_json(&self) -> Value {
        let instances = self.instances.iter().map(|one| {
            json!({
                "instance": one.instance,
                "wanted": one.wanted,
                "recorded": one.recorded,
                "dropped": one.dropped,
                "failed": one.failed,
                "lost": one.lost,
                "overwritten": one.overwritten,
            })
        });
        let missing = self.missing.iter().map(|one| {
            json!({
                "instance": one.of,
                "dropped": one.dropped,
                "failed": one.failed,
                "lost": one.lost,
            })
        });
        instances.chain(missing).collect()
    }
}

impl fmt::Display for RecordingReport {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.ended.path.display();
        write!(formatter, "recording {path}: {}", self.state())?;
        if let Some(error) = self.error() {
            write!(formatter, " ({error})")?;
        }
        writeln!(formatter)?;
        for one in &self.instances {
            let counts = [
                (one.dropped, "dropped"),
                (one.failed, "not encoded"),
                (one.lost, "lost on the way to the file"),
                (
                    one.overwritten,
                    "gave way to younger ones: a larger `--recording-budget`, or more room on the disk, keeps more",
                ),
            ];
            for (count, what) in counts.into_iter().filter(|(count, _)| *count > 0) {
                writeln!(
                    formatter,
                    "{}: {count} of {} frames {what}",
                    one.instance, one.wanted
                )?;
            }
        }
        for one in &self.missing {
            let Missing {
                of,
                dropped,
                failed,
                lost,
            } = one;
            writeln!(
                formatter,
                "{of}: {dropped} dropped (larger than a block, or none was free), {failed} not encoded, {lost} lost on the way to the file"
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_disk_has_not_taken_is_told_with_what_is_known() {
        let report = RecordingReport {
            ended: Ended {
                path: "run.mcap".into(),
                is_complete: false,
                error: None,
                is_outstanding: true,
            },
            instances: vec![InstanceRecorded {
                instance: "Legs",
                wanted: 5,
                recorded: 4,
                dropped: 1,
                failed: 0,
                lost: 0,
                overwritten: 2,
            }],
            missing: vec![Missing {
                of: "Legs.outputs".to_owned(),
                dropped: 0,
                failed: 0,
                lost: 3,
            }],
        };
        let text = report.to_string();
        let first = format!("recording run.mcap: INCOMPLETE ({OUTSTANDING})\n");
        assert!(text.starts_with(&first), "{text}");
        assert!(text.contains("Legs: 1 of 5 frames dropped"), "{text}");
        // Neither the disk nor the budget alone takes something.
        for help in [
            "2 of 5 frames gave way to younger ones: a larger `--recording-budget`, or more room on the disk, keeps more\n",
            "3 lost on the way to the file\n",
        ] {
            assert!(text.contains(help), "{text}");
        }
        assert_eq!(report.error().as_deref(), Some(OUTSTANDING));
        assert_eq!(report.to_json()[0]["recorded"], 4);
    }
}
