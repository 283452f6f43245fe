//! On a disk with less room than the budget asks for the newest cycles are those that are recorded.

use std::fs::File;
use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

use hulkgen_recording::{
    Recorded, Recorder, Recording, Rewrites, Settings, Storage, Track, Way, Writer,
};

use crate::cycles;
use crate::description::{description, settings};
use crate::support::frame;

/// A disk that others use, too.
#[derive(Debug)]
struct Room {
    /// Bytes that are free.
    free: AtomicU64,
    /// Whether places in the midst of a file can be given back.
    has_holes: AtomicBool,
    /// Whether others take at once what is given back.
    is_wanted: AtomicBool,
    /// Whether it takes something over what is there.
    is_rewritten: AtomicBool,
}

/// A file on it.
#[derive(Debug)]
struct Small {
    file: File,
    room: Arc<Room>,
    position: u64,
    length: u64,
}

impl Write for Small {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let end = self.position + bytes.len() as u64;
        if end <= self.length && !self.room.is_rewritten.load(Ordering::Relaxed) {
            return Err(ErrorKind::Other.into());
        }
        let more = end.saturating_sub(self.length);
        let free = self.room.free.load(Ordering::Relaxed);
        // As a disk does, it takes what it has room for.
        let taken = bytes.len() - more.saturating_sub(free) as usize;
        if taken == 0 {
            return Err(ErrorKind::StorageFull.into());
        }
        let more = more.min(free);
        self.room.free.fetch_sub(more, Ordering::Relaxed);
        self.file.write_all(&bytes[..taken])?;
        self.position += taken as u64;
        self.length += more;
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Seek for Small {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.position = self.file.seek(to)?;
        Ok(self.position)
    }
}

impl Storage for Small {
    fn set_len(&mut self, length: u64) -> io::Result<()> {
        let less = self.length - length;
        self.room.free.fetch_add(less, Ordering::Relaxed);
        self.length = length;
        Storage::set_len(&mut self.file, length)
    }

    fn sync_all(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn give_back(&mut self, offset: u64, bytes: u64) -> bool {
        let bytes = bytes.min(self.length.saturating_sub(offset));
        let has_holes = self.room.has_holes.load(Ordering::Relaxed);
        if has_holes && !self.room.is_wanted.load(Ordering::Relaxed) {
            self.room.free.fetch_add(bytes, Ordering::Relaxed);
        }
        has_holes
    }
}

/// A recording on a disk with so much room.
fn start(path: &Path, free: u64, settings: Settings) -> (Recorder, Track, Arc<Room>) {
    let room = Arc::new(Room {
        free: AtomicU64::new(free),
        has_holes: AtomicBool::new(true),
        is_wanted: AtomicBool::new(false),
        is_rewritten: AtomicBool::new(true),
    });
    let small = Small {
        file: File::create_new(path).expect("it is new"),
        room: room.clone(),
        position: 0,
        length: 0,
    };
    let writer = Writer::onto(Box::new(small), description(), settings.budget).expect("its head");
    let started = Recorder::start_writing(path, writer, &["Control"], settings, Rewrites::new());
    let (recorder, mut tracks) = started.expect("a thread");
    (recorder, tracks.pop().expect("one was asked for"), room)
}

/// Records these cycles; all but those of the last blocks are then written, or lost.
fn record(track: &mut Track, cycles: Range<u32>) {
    for cycle in cycles {
        while frame(track, cycle, 1) != Recorded::Whole {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

#[test]
fn a_full_disk_is_a_budget() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track, _) = start(&path, 64 << 10, settings());
    record(&mut track, 0..60_000);
    let counts = track.counts().clone();
    drop(track);
    let ended = recorder.end();
    assert!(ended.error.is_none(), "{:?}", ended.error);
    let recording = Recording::open(&path).expect("it can be read");
    assert_eq!(recording.way, Way::Whole);
    assert!(recording.gone > 10, "{} chunks are gone", recording.gone);
    let found = cycles(&recording);
    let first = *found.first().expect("the newest are there");
    assert_eq!(found, Vec::from_iter(first..60_000));
    assert!(found.len() > 1000, "{} cycles are there", found.len());
    assert_eq!((counts.lost(), counts.overwritten()), (0, first.into()));
    let end = &recording.metadata("end").expect("it ended").entries;
    let overwritten = ("Control.overwritten".to_owned(), first.to_string());
    assert!(end.contains(&overwritten), "{first} of {end:?}");
}

#[test]
fn half_of_it_stays_where_others_take_what_it_gives_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track, room) = start(&path, 1 << 30, settings());
    let counts = track.counts().clone();
    record(&mut track, 0..20_000);
    room.is_wanted.store(true, Ordering::Relaxed);
    room.free.store(0, Ordering::Relaxed);
    assert_eq!((counts.overwritten(), counts.lost()), (0, 0));
    record(&mut track, 20_000..60_000);
    let (overwritten, lost) = (counts.overwritten(), counts.lost());
    assert!(lost > 10_000, "{lost} frames are lost");
    assert!(
        (5000..11_000).contains(&overwritten),
        "{overwritten} of 20000 went"
    );
    // They have gone, too.
    room.is_wanted.store(false, Ordering::Relaxed);
    room.free.store(1 << 30, Ordering::Relaxed);
    record(&mut track, 60_000..70_000);
    drop(track);
    assert!(!recorder.end().is_complete);
    let recording = Recording::open(&path).expect("it can be read");
    assert_eq!(recording.way, Way::Whole);
    let found = cycles(&recording);
    assert_eq!(
        found.len() as u64,
        counts.recorded() - counts.lost() - counts.overwritten()
    );
    assert!(found.ends_with(&Vec::from_iter(63_000..70_000)));
}

#[test]
fn a_disk_without_holes_costs_no_chunk() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track, room) = start(&path, 64 << 10, settings());
    let counts = track.counts().clone();
    room.has_holes.store(false, Ordering::Relaxed);
    record(&mut track, 0..60_000);
    drop(track);
    let ended = recorder.end();
    assert!(!ended.is_complete);
    assert_eq!(
        ended.error.map(|error| error.kind()),
        Some(ErrorKind::StorageFull)
    );
    let recording = Recording::open(&path).expect("it can be read");
    assert_eq!((recording.gone, counts.overwritten()), (0, 0));
    let found = cycles(&recording);
    assert!(found.len() > 1000, "{} cycles are there", found.len());
    assert!(found.starts_with(&Vec::from_iter(0..1000)));
}

#[test]
fn a_chunk_that_does_not_go_costs_no_other_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let budget = 16 << 10;
    let settings = Settings {
        budget,
        ..settings()
    };
    let (recorder, mut track, room) = start(&path, 1 << 30, settings);
    let counts = track.counts().clone();
    record(&mut track, 0..20_000);
    room.is_rewritten.store(false, Ordering::Relaxed);
    // What is on its way may be counted yet.
    let before = counts.overwritten();
    assert!(before > 0, "it is a ring");
    record(&mut track, 20_000..30_000);
    assert_eq!((counts.overwritten(), counts.lost()), (before, 0));
    room.is_rewritten.store(true, Ordering::Relaxed);
    record(&mut track, 30_000..40_000);
    drop(track);
    let ended = recorder.end();
    assert!(ended.error.is_none(), "{:?}", ended.error);
    let recording = Recording::open(&path).expect("it can be read");
    let found = cycles(&recording);
    let first = *found.first().expect("the newest are there");
    assert_eq!(found, Vec::from_iter(first..40_000));
    assert_eq!(counts.overwritten(), u64::from(first));
    let kept: u64 = recording.chunks.len() as u64 * 8192;
    assert!(kept < 8 * budget, "it is within its budget again");
}

#[test]
fn nothing_goes_where_there_is_no_budget() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let settings = Settings {
        budget: u64::MAX,
        ..settings()
    };
    let (recorder, mut track, _) = start(&path, 64 << 10, settings);
    let counts = track.counts().clone();
    record(&mut track, 0..20_000);
    drop(track);
    let error = recorder.end().error.map(|error| error.kind());
    assert_eq!(error, Some(ErrorKind::StorageFull));
    assert!(counts.lost() > 0 && counts.overwritten() == 0);
    let recording = Recording::open(&path).expect("it can be read");
    assert_eq!(recording.gone, 0);
}

/// Where the child of the test below writes.
const LIMITED: &str = "HULKGEN_TEST_LIMITED";

#[test]
fn a_full_disk_stops_nobody_and_is_told() {
    const NAME: &str = "small::a_full_disk_stops_nobody_and_is_told";
    if let Some(path) = std::env::var_os(LIMITED) {
        let (recorder, mut tracks) =
            Recorder::start(path.as_ref(), description(), &["Control"], settings()).expect("new");
        let mut track = tracks.pop().expect("one was asked for");
        for cycle in 0..50_000 {
            while frame(&mut track, cycle, 1) != Recorded::Whole {
                std::thread::sleep(Duration::from_millis(1));
            }
        }
        drop(track);
        let lost = recorder
            .counts()
            .map(|(_, counts)| counts.lost())
            .sum::<u64>();
        let ended = recorder.end();
        assert!(!ended.is_complete && ended.error.is_some());
        assert!(lost > 0 && lost < 50_000, "{lost} frames are lost");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let test = std::env::current_exe().expect("it runs");
    // In blocks of 512 bytes; a write beyond is an error and no signal.
    let child = Command::new("sh")
        .args([
            "-c",
            "ulimit -f 256; trap '' XFSZ; exec \"$0\" --exact \"$1\"",
        ])
        .arg(test)
        .arg(NAME)
        .env(LIMITED, &path)
        .output();
    let child = child.expect("every Unix has a shell");
    let said = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success(), "{said}");
    let recording = Recording::open(&path).expect("it can be read");
    assert!(!recording.is_complete());
    let found = cycles(&recording);
    // What came last may be small enough for what is left.
    assert!(found.len() > 1000 && found.starts_with(&[0, 1, 2]) && found.is_sorted());
    let length = std::fs::metadata(&path).expect("it is there").len();
    assert!(length < 256 * 512, "half a chunk stands behind the end");
}
