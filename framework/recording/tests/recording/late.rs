//! Values that a cycler leaves to the writer: the file is the one that it would have written itself.

use std::panic::AssertUnwindSafe;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use hulkgen_recording::{
    ChannelId, Full, Late, Recorded, Recorder, Recording, Rewrite, Rewrites, Rewritten, Settings,
    Track, Writing,
};
use proptest::prelude::*;

use crate::description::{FRAMES, VALUES, description, settings};

/// Bytes, and how many handles of it recordings have.
#[derive(Default)]
struct Large {
    bytes: Vec<u8>,
    refuses: bool,
    kept: AtomicUsize,
}

impl Large {
    fn of(bytes: &[u8]) -> Arc<Self> {
        Arc::new(Self {
            bytes: bytes.to_owned(),
            ..Self::default()
        })
    }

    fn kept(&self) -> usize {
        self.kept.load(Ordering::Relaxed)
    }
}

impl Late for Large {
    fn write(&self, bytes: &mut Vec<u8>) -> bool {
        assert!(self.kept() > 0, "it is written while it is kept");
        bytes.extend_from_slice(&self.bytes);
        !self.refuses
    }

    fn keep(&self) {
        self.kept.fetch_add(1, Ordering::Relaxed);
    }

    fn let_go(self: Arc<Self>) {
        self.kept.fetch_sub(1, Ordering::Relaxed);
    }
}

/// As a cycler does: what nobody takes, it writes itself. Whether somebody took it.
fn put(writing: &mut Writing<'_>, before: &[u8], value: &Arc<Large>) -> Result<bool, Full> {
    let is_left = writing.leave(before, value.clone());
    if !is_left {
        writing.put(before)?;
        writing.put(&value.bytes)?;
    }
    Ok(is_left)
}

/// A message: what it has before and behind each of its values.
type Parts = Vec<(Vec<u8>, Vec<u8>)>;

/// A frame with one message for others and one of its own. How many values it left.
fn frame(track: &mut Track, cycle: u32, messages: [&Parts; 2]) -> (Recorded<Full>, usize) {
    let mut left = 0;
    let recorded = track.frame(u64::from(cycle), 0, |frame| {
        for (channel, parts) in [VALUES, FRAMES].into_iter().zip(messages) {
            frame.message::<Full>(channel, cycle, u64::from(cycle), |writing| {
                for (before, value) in parts {
                    left += usize::from(put(writing, before, &Large::of(value))?);
                }
                writing.put(b"end")
            })?;
        }
        Ok(())
    });
    (recorded, left)
}

fn record(path: &Path, late: usize, frames: &[[Parts; 2]], rewrites: Rewrites) -> usize {
    let settings = Settings { late, ..settings() };
    let (recorder, mut track) = start_rewriting(path, settings, rewrites);
    let mut left = 0;
    for (cycle, [values, own]) in frames.iter().enumerate() {
        let more = loop {
            match frame(&mut track, cycle as u32, [values, own]) {
                (Recorded::Whole, left) => break left,
                // Its blocks are at the writer.
                _ => std::thread::sleep(Duration::from_millis(1)),
            }
        };
        left += more;
    }
    drop(track);
    assert_eq!(recorder.end().error.map(|error| error.to_string()), None);
    left
}

/// Channel, sequence, time and data of all messages.
fn messages(path: &Path) -> Vec<(u16, u32, u64, Vec<u8>)> {
    let recording = Recording::open(path).expect("it can be read");
    let messages = recording.chunks.iter().flat_map(|chunk| chunk.messages());
    messages
        .map(|one| (one.channel, one.sequence, one.time, one.data.to_vec()))
        .collect()
}

fn bytes(most: usize) -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(any::<u8>(), 0..most)
}

fn parts() -> impl Strategy<Value = Parts> {
    prop::collection::vec((bytes(5), bytes(200)), 0..4)
}

/// Turns what it has around.
fn backwards(_: u64, recorded: &[u8], into: &mut Vec<u8>) -> Rewritten {
    into.extend(recorded.iter().rev());
    Rewritten::Whole
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_file_has_what_the_cycler_would_have_written(
        frames in prop::collection::vec([parts(), parts()], 1..40),
        late in 0_usize..6,
        rewrites in any::<bool>(),
    ) {
        let rewrites: Rewrites = rewrites
            .then_some((VALUES, Arc::new(backwards) as Rewrite))
            .into_iter()
            .collect();
        let folder = tempfile::tempdir().expect("a folder");
        let paths = ["late.mcap", "copied.mcap"].map(|name| folder.path().join(name));
        let values = frames.iter().flatten().map(Vec::len).sum::<usize>();
        let left = record(&paths[0], late, &frames, rewrites.clone());
        prop_assert!(left > 0 || late == 0 || values == 0);
        prop_assert_eq!(record(&paths[1], 0, &frames, rewrites), 0);
        prop_assert_eq!(messages(&paths[0]), messages(&paths[1]));
    }
}

fn start(path: &Path, settings: Settings) -> (Recorder, Track) {
    start_rewriting(path, settings, Rewrites::new())
}

fn start_rewriting(path: &Path, settings: Settings, rewrites: Rewrites) -> (Recorder, Track) {
    let started = Recorder::start_rewriting(path, description(), &["Control"], settings, rewrites);
    let (recorder, mut tracks) = started.expect("it is new");
    (recorder, tracks.pop().expect("one was asked for"))
}

/// A frame of one value.
fn one(track: &mut Track, cycle: u32, value: &Arc<Large>) -> (Recorded<Full>, bool) {
    let mut is_left = false;
    let recorded = track.frame(u64::from(cycle), 0, |frame| {
        frame.message(FRAMES, cycle, u64::from(cycle), |writing| {
            is_left = put(writing, b"1", value)?;
            Ok(())
        })
    });
    (recorded, is_left)
}

#[test]
fn so_many_are_kept_as_there_is_room_for_and_none_when_they_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track) = start(&path, settings());
    let values: Vec<_> = (0..5).map(|value| Large::of(&[value; 8])).collect();
    let left: Vec<_> = (0..5)
        .map(|cycle| one(&mut track, cycle, &values[cycle as usize]))
        .collect();
    // `settings` has room for three.
    let expected = [true, true, true, false, false].map(|is_left| (Recorded::Whole, is_left));
    assert_eq!(left, expected);
    let kept: Vec<_> = values.iter().map(|value| value.kept()).collect();
    assert_eq!(kept, [1, 1, 1, 0, 0]);
    drop(track);
    assert!(recorder.end().is_complete);
    assert!(values.iter().all(|value| value.kept() == 0));
    assert!(values.iter().all(|value| Arc::strong_count(value) == 1));
    let found = messages(&path);
    for ((_, cycle, _, data), value) in found.iter().zip(&values) {
        assert_eq!(data[..], [&b"1"[..], &value.bytes].concat(), "{cycle}");
    }
    assert_eq!(found.len(), 5);
}

#[test]
fn a_frame_that_is_not_whole_keeps_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track) = start(&path, settings());
    let value = Large::of(&[1; 8]);
    assert_eq!(one(&mut track, 0, &value), (Recorded::Whole, true));
    let failed = track.frame(1, 0, |frame| {
        frame.message::<Full>(FRAMES, 1, 1, |writing| {
            assert!(writing.leave(b"", value.clone()));
            Ok(())
        })?;
        frame.message(FRAMES, 1, 1, |writing| {
            assert!(writing.leave(b"", value.clone()));
            Err(Full)
        })
    });
    assert_eq!(failed, Recorded::Failed(Full));
    assert_eq!(value.kept(), 1, "that of the frame before");
    // Larger than a block.
    let dropped = track.frame::<Full>(2, 0, |frame| {
        frame.message(FRAMES, 2, 2, |writing| {
            assert!(writing.leave(b"", value.clone()));
            writing.put(&[0; 8192])
        })
    });
    assert_eq!(dropped, Recorded::Dropped);
    await_none_kept(&value);
    // While it is written something panics, behind another frame and in the first one of a block.
    assert_eq!(one(&mut track, 3, &value), (Recorded::Whole, true));
    for kept in [1, 0] {
        let panicked = std::panic::catch_unwind(AssertUnwindSafe(|| {
            track.frame::<Full>(4, 0, |frame| {
                frame.message(FRAMES, 4, 4, |writing| {
                    assert!(writing.leave(b"", value.clone()));
                    panic!("not with me")
                })
            })
        }));
        assert!(panicked.is_err());
        assert_eq!(value.kept(), kept, "that of the frame before");
        track.hand_over();
        await_none_kept(&value);
    }
    assert_eq!(one(&mut track, 5, &value), (Recorded::Whole, true));
    drop(track);
    assert_eq!(recorder.end().error.map(|error| error.to_string()), None);
    let found = messages(&path);
    let (cycles, data): (Vec<_>, Vec<_>) = found.iter().map(|one| (one.1, &one.3[..])).unzip();
    assert_eq!(cycles, [0, 3, 5]);
    assert_eq!(data, [b"1\x01\x01\x01\x01\x01\x01\x01\x01"; 3]);
}

/// The writer looks every few milliseconds.
fn await_none_kept(value: &Large) {
    for _ in 0..10_000 {
        if value.kept() == 0 {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("{} are kept", value.kept());
}

#[test]
fn frames_from_one_without_bytes_on_are_lost_and_those_before_stay() {
    let folder = tempfile::tempdir().expect("a folder");
    let settings = Settings {
        late: 100,
        ..settings()
    };
    let good = Large::of(&[7; 300]);
    let bad = Arc::new(Large {
        refuses: true,
        bytes: b"half".to_vec(),
        ..Large::default()
    });
    // In the one message of a frame, behind another one in it, and in the second message.
    let three: [[&[&Arc<Large>]; 2]; 3] =
        [[&[], &[&bad]], [&[], &[&good, &bad]], [&[&good], &[&bad]]];
    for (number, messages_of_bad) in three.into_iter().enumerate() {
        for rewrites in [
            Rewrites::new(),
            [(VALUES, Arc::new(backwards) as Rewrite)].into(),
        ] {
            let path = folder
                .path()
                .join(format!("{number}-{}.mcap", rewrites.len()));
            let (recorder, mut track) = start_rewriting(&path, settings, rewrites);
            assert_eq!(one(&mut track, 0, &good), (Recorded::Whole, true));
            let recorded = track.frame::<Full>(1, 0, |frame| {
                for (channel, values) in [VALUES, FRAMES].into_iter().zip(messages_of_bad) {
                    frame.message::<Full>(channel, 1, 1, |writing| {
                        for value in values {
                            assert!(writing.leave(b"before", (*value).clone()));
                        }
                        writing.put(b"behind")
                    })?;
                }
                Ok(())
            });
            assert_eq!(recorded, Recorded::Whole);
            // In the same block, without any such value; and in the next one.
            assert_eq!(plain(&mut track, 2), Recorded::Whole);
            track.hand_over();
            assert_eq!(plain(&mut track, 3), Recorded::Whole);
            let counts = track.counts().clone();
            drop(track);
            assert!(!recorder.end().is_complete);
            let expected = [(0, [&b"1"[..], &[7; 300]].concat()), (3, b"plain".to_vec())];
            let found = messages(&path).into_iter().map(|one| (one.1, one.3));
            assert_eq!(Vec::from_iter(found), expected);
            assert_eq!((counts.recorded(), counts.lost()), (4, 2));
            assert_eq!((good.kept(), bad.kept()), (0, 0));
        }
    }
}

#[test]
fn a_block_of_which_nothing_is_left_takes_no_other_one_out_of_the_counts() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    // Each block is a chunk at once.
    let settings = Settings {
        chunk_bytes: 1,
        ..settings()
    };
    let (recorder, mut track) = start(&path, settings);
    let bad = Arc::new(Large {
        refuses: true,
        ..Large::default()
    });
    for cycle in 0..6 {
        let recorded = match cycle % 2 {
            0 => plain(&mut track, cycle),
            _ => one(&mut track, cycle, &bad).0,
        };
        assert_eq!(recorded, Recorded::Whole);
        track.hand_over();
        await_none_kept(&bad);
    }
    let counts = track.counts().clone();
    drop(track);
    recorder.end();
    let cycles: Vec<_> = messages(&path).iter().map(|one| one.1).collect();
    assert_eq!(cycles, [0, 2, 4]);
    assert_eq!((counts.lost(), counts.overwritten()), (3, 0));
}

/// A frame that leaves nothing.
fn plain(track: &mut Track, cycle: u32) -> Recorded<Full> {
    track.frame(u64::from(cycle), 0, |frame| {
        frame.message(FRAMES, cycle, 3, |writing| writing.put(b"plain"))
    })
}

#[test]
fn what_ends_a_frame_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_recorder, mut track) = start(&folder.path().join("run.mcap"), settings());
    let value = Large::of(b"large");
    assert_eq!(one(&mut track, 0, &value), (Recorded::Whole, true));
    let mut is_left = true;
    let ended = track.end::<Full>(0, |frame| {
        frame.message(FRAMES, 0, 0, |writing| {
            is_left = put(writing, b"", &value)?;
            Ok(())
        })
    });
    assert_eq!((ended, is_left), (Recorded::Whole, false));
}

#[test]
fn a_block_with_many_goes_to_the_writer_before_it_is_full() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let settings = Settings {
        late: 100,
        longest: Duration::from_secs(3600),
        ..settings()
    };
    let (recorder, mut track) = start(&path, settings);
    let value = Large::of(b"large");
    let mut firsts = Vec::new();
    for cycle in 0..20 {
        let recorded = track.frame::<Full>(cycle, 0, |frame| {
            firsts.push(frame.is_first());
            frame.message(ChannelId(0), cycle as u32, cycle, |writing| {
                put(writing, b"", &value).map(|is_left| assert!(is_left))
            })
        });
        assert_eq!(recorded, Recorded::Whole);
        // What ends a frame stands beside it.
        let ended = track.end::<Full>(cycle, |frame| {
            frame.message(ChannelId(0), cycle as u32, cycle, |writing| {
                writing.put(b"end")
            })
        });
        assert_eq!(ended, Recorded::Whole);
        // Not only when there is another frame.
        if cycle % 4 == 3 {
            await_none_kept(&value);
        }
    }
    let begun: Vec<_> = (0..20).filter(|cycle| firsts[*cycle]).collect();
    assert_eq!(begun, [0, 4, 8, 12, 16]);
    drop(track);
    assert!(recorder.end().is_complete);
    assert_eq!(messages(&path).len(), 40);
}

#[test]
fn messages_that_become_nothing_are_left_out_or_lost() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let rewrite = |_: u64, recorded: &[u8], into: &mut Vec<u8>| {
        into.extend(recorded);
        match recorded[0] % 3 {
            0 => Rewritten::Whole,
            1 => Rewritten::Absent,
            _ => Rewritten::Lost,
        }
    };
    let rewrites = Rewrites::from([(FRAMES, Arc::new(rewrite) as Rewrite)]);
    let (recorder, mut track) = start_rewriting(&path, settings(), rewrites);
    for cycle in 0..10_u8 {
        let recorded = track.frame::<Full>(0, 0, |frame| {
            frame.message(FRAMES, cycle.into(), 0, |writing| writing.put(&[cycle]))
        });
        assert_eq!(recorded, Recorded::Whole);
    }
    let counts = track.counts().clone();
    drop(track);
    let ended = recorder.end();
    assert!(ended.error.is_none() && !ended.is_complete);
    assert_eq!((counts.recorded(), counts.lost()), (10, 3));
    let found = messages(&path).into_iter().map(|(_, cycle, ..)| cycle);
    assert_eq!(Vec::from_iter(found), [0, 3, 6, 9]);
}

#[test]
fn a_block_that_is_written_in_pieces_is_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let settings = Settings {
        block_bytes: 8 << 20,
        ..settings()
    };
    let (recorder, mut track) = start(&path, settings);
    // One is larger than a piece, five small ones are less.
    let lengths = [700_000, 100_000, 100_000, 300_000, 10, 20, 900_000, 7];
    let frames: Vec<Vec<u8>> = lengths.map(|length| vec![length as u8; length]).into();
    for (cycle, data) in frames.iter().enumerate() {
        let recorded = track.frame::<Full>(cycle as u64, 0, |frame| {
            frame.message(FRAMES, cycle as u32, 3, |writing| writing.put(data))
        });
        assert_eq!(recorded, Recorded::Whole);
    }
    drop(track);
    // Before it is told that this is the end.
    std::thread::sleep(Duration::from_millis(100));
    assert!(recorder.end().is_complete);
    let found: Vec<_> = messages(&path).into_iter().map(|one| one.3).collect();
    assert!(found == frames);
}
