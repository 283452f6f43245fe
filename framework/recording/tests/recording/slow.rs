//! A disk that takes its time: who waits for it are frames, not cyclers.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::time::Duration;

use hulkgen_recording::{
    Full, Recorded, Recorder, Recording, Rewrites, Settings, Storage, Track, Writer,
};

use crate::cycles;
use crate::description::{description, settings};
use crate::support::frame;

/// Where writes wait while it is closed.
#[derive(Debug, Default)]
struct Gate {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct State {
    is_closed: bool,
    somebody_waits: bool,
}

impl Gate {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().expect("nobody panics with it")
    }

    /// Until what it gives is dropped, also where an assertion fails.
    fn close(&self) -> Closed<'_> {
        self.state().is_closed = true;
        Closed(self)
    }

    fn pass(&self) {
        let mut state = self.state();
        while state.is_closed {
            state.somebody_waits = true;
            self.changed.notify_all();
            state = self.changed.wait(state).expect("nobody panics with it");
        }
        state.somebody_waits = false;
    }

    fn await_somebody(&self) {
        let state = self.state();
        let waited = self
            .changed
            .wait_while(state, |state| !state.somebody_waits);
        drop(waited.expect("nobody panics with it"));
    }
}

/// A closed gate.
struct Closed<'gate>(&'gate Gate);

impl Drop for Closed<'_> {
    fn drop(&mut self) {
        self.0.state().is_closed = false;
        self.0.changed.notify_all();
    }
}

/// A file behind a gate.
#[derive(Debug)]
struct Slow {
    file: File,
    gate: Arc<Gate>,
}

impl Write for Slow {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.gate.pass();
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for Slow {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

impl Storage for Slow {
    fn set_len(&mut self, length: u64) -> io::Result<()> {
        Storage::set_len(&mut self.file, length)
    }

    fn sync_all(&mut self) -> io::Result<()> {
        Storage::sync_all(&mut self.file)
    }

    fn give_back(&mut self, offset: u64, bytes: u64) -> bool {
        self.file.give_back(offset, bytes)
    }
}

/// An instance that notes what became of its cycles.
struct Noted {
    track: Track,
    cycle: u32,
    recorded: Vec<u32>,
    dropped: u64,
}

impl Noted {
    fn new(track: Track, cycle: u32) -> Self {
        Self {
            track,
            cycle,
            recorded: Vec::new(),
            dropped: 0,
        }
    }

    /// Records one cycle; whether there was room.
    fn record(&mut self) -> bool {
        let cycle = self.cycle;
        self.cycle += 1;
        match frame(&mut self.track, cycle, 20) {
            Recorded::Whole => self.recorded.push(cycle),
            Recorded::Dropped => self.dropped += 1,
            Recorded::Failed(Full) => panic!("numbers can be encoded"),
        }
        self.recorded.last() == Some(&cycle)
    }

    fn counts(&self) -> (u64, u64) {
        (self.recorded.len() as u64, self.dropped)
    }
}

#[test]
fn a_slow_disk_costs_frames_that_are_counted_by_instance() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let settings = Settings {
        // Each block is a chunk at once, so that the writer has none while it waits.
        chunk_bytes: 1,
        ..settings()
    };
    let gate = Arc::new(Gate::default());
    let file = Slow {
        file: File::create_new(&path).expect("it is new"),
        gate: gate.clone(),
    };
    let writer = Writer::onto(Box::new(file), description(), settings.budget);
    let writer = writer.expect("the gate is open");
    let instances = ["One", "Other"];
    let started = Recorder::start_writing(&path, writer, &instances, settings, Rewrites::new());
    let (recorder, mut tracks) = started.expect("a thread can be started");
    let mut other = Noted::new(tracks.pop().expect("two were asked for"), 30_000);
    let mut one = Noted::new(tracks.pop().expect("two were asked for"), 0);
    let counts = || -> Vec<_> {
        let counts = recorder.counts();
        counts
            .map(|(_, counts)| (counts.recorded(), counts.dropped()))
            .collect()
    };

    let closed = gate.close();
    assert!(one.record() && other.record());
    one.track.hand_over();
    gate.await_somebody();
    // Its own block and those that nobody writes away: no cycler waits, and each comes to the end of them.
    for instance in [&mut one, &mut other] {
        while instance.record() {
            assert!(instance.recorded.len() < 5000, "blocks have no end");
        }
    }
    assert!(one.recorded.len() > other.recorded.len() && other.recorded.len() > 20);
    assert!((0..7).all(|_| !one.record()) && (0..3).all(|_| !other.record()));
    assert_eq!((one.dropped, other.dropped), (8, 4));
    assert_eq!(counts(), [one.counts(), other.counts()]);

    drop(closed);
    for instance in [&mut one, &mut other] {
        while !instance.record() {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
    assert_eq!(counts(), [one.counts(), other.counts()]);
    let told = [one.counts(), other.counts()];
    let recorded = [one.recorded, other.recorded].concat();
    drop((one.track, other.track));
    let ended = recorder.end();
    assert!(!ended.is_complete && ended.error.is_none(), "{ended:?}");

    let recording = Recording::open(&path).expect("it can be read");
    let end = &recording.metadata("end").expect("it ended").entries;
    let entry = |key: &str| {
        let entry = end.iter().find(|(one, _)| one == key);
        &*entry.expect("it is told").1
    };
    assert_eq!(entry("state"), "INCOMPLETE");
    for (instance, (recorded, dropped)) in instances.iter().zip(told) {
        assert_eq!(entry(&format!("{instance}.recorded")), recorded.to_string());
        assert_eq!(entry(&format!("{instance}.dropped")), dropped.to_string());
        assert_eq!(entry(&format!("{instance}.lost")), "0");
    }
    // Those that came are whole, with what they refer to, and in the order of their instance.
    let (other, one): (Vec<_>, Vec<_>) = cycles(&recording)
        .into_iter()
        .partition(|cycle| *cycle >= 30_000);
    assert_eq!([one, other].concat(), recorded);
}

#[test]
fn a_disk_that_hangs_is_no_longer_waited_for_when_nobody_wants_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let gate = Arc::new(Gate::default());
    let file = Slow {
        file: File::create_new(&path).expect("it is new"),
        gate: gate.clone(),
    };
    let start = |file| {
        let writer = Writer::onto(Box::new(file), description(), settings().budget);
        let writer = writer.expect("the gate is open");
        let started = Recorder::start_writing(&path, writer, &["One"], settings(), Rewrites::new());
        let (recorder, mut tracks) = started.expect("a thread can be started");
        let mut one = Noted::new(tracks.pop().expect("one was asked for"), 0);
        assert!(one.record());
        recorder
    };
    let recorder = start(file);
    let closed = gate.close();
    let mut patience = 3..;
    let ended = recorder.end_while(Vec::new(), || patience.next() != Some(5));
    assert_eq!(patience.start, 6, "it is asked again and again");
    assert!(ended.is_outstanding && !ended.is_complete, "{ended:?}");
    drop(closed);
    // The thread that was left alone ends its file.
    while Recording::open(&path).map_or(true, |file| file.metadata("end").is_none()) {
        std::thread::sleep(Duration::from_millis(1));
    }
    std::fs::remove_file(&path).expect("it is there");
    let file = Slow {
        file: File::create_new(&path).expect("it is new"),
        gate,
    };
    let ended = start(file).end_while(Vec::new(), || true);
    assert!(ended.is_complete && !ended.is_outstanding, "{ended:?}");
}
