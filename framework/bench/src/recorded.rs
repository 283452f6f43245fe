//! A recording of one instance, as the driver calls it, for cyclers that are measured.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use framework::driver::Observer;
use framework::recorded::{About, Counts, Recording, Saving, Settings};
use framework::{Finished, Instance, Record, Result, Robot, Timestamp, Waited};
use hulkgen_recording::Writing;
use tempfile::TempDir;

/// More than any frame takes, in bytes.
const ROOM: usize = 1 << 20;
/// Of one output.
const DIGEST: usize = 8;
/// The writer looks every 5 ms: it gets a core before blocks run out.
const PAUSE: Duration = Duration::from_millis(10);
/// The file does not grow beyond, in bytes.
const BUDGET: u64 = 64 << 20;

pub(crate) struct Recorder {
    observer: Box<dyn Observer>,
    counts: Vec<(String, Arc<Counts>)>,
    // Ends when it is dropped; the folder goes behind it.
    _recording: Recording,
    _folder: TempDir,
}

impl Recorder {
    /// Of every cycle of this instance, which the robot still has.
    pub(crate) fn of<P>(robot: &Robot<P>, name: &str) -> Result<Self> {
        let folder = tempfile::tempdir()?;
        let settings = Settings {
            budget: BUDGET,
            ..Settings::default()
        };
        let path = folder.path().join("run.mcap");
        let mut recording =
            Recording::start_with(&path, robot, About::default(), settings, |one| {
                if one.name == name {
                    Record::On
                } else {
                    Record::Off
                }
            })?;
        let description = robot.instance(name)?.description();
        let observer = recording.observer(description);
        Ok(Self {
            observer: observer.expect("this instance is recorded"),
            counts: recording.shared_counts(),
            _recording: recording,
            _folder: folder,
        })
    }

    /// As [`crate::turn::turn`], recorded.
    #[inline]
    pub(crate) fn turn(&mut self, instance: &mut dyn Instance) {
        let waited = instance.wait();
        assert!(matches!(waited, Ok(Waited::Ready)), "no setup node waits");
        instance.begin();
        self.observer.begun(instance);
        instance.run();
        let finished = instance.finish();
        assert!(matches!(finished, Ok(Finished::Completed)), "no node fails");
        self.observer.finished(instance);
    }

    /// Waits for the writer; every cycle must have found room.
    pub(crate) fn rest(&self) {
        thread::sleep(PAUSE);
        let is_complete = self.counts.iter().all(|(_, counts)| counts.is_complete());
        assert!(is_complete, "every cycle is recorded");
    }
}

/// How many bytes a recording gets of a cycle: its frame and the digests, without what other instances wrote. Asked of what the
/// cycle has left.
pub(crate) fn bytes(instance: &mut dyn Instance, since: Option<Timestamp>) -> usize {
    let mut room = vec![0; ROOM];
    let mut writing = Writing::new(&mut room);
    let mut saving = Saving::new(&mut writing);
    instance.save_alone(since, &mut saving);
    saving.end().expect("there is room for any frame");
    writing.length() + DIGEST * instance.digested().len()
}
