//! Files that are read one chunk at a time.

use hulkgen_recording::{ReadError, Recording, RecordingFile, Settings, Way};

use crate::description::settings;
use crate::support::record;

/// What both ways of reading must find alike.
fn assert_same(file: &RecordingFile, all: &Recording) {
    let contents = file.contents();
    assert_eq!(contents.channels.len(), all.channels.len());
    assert_eq!(contents.schemas, all.schemas);
    assert_eq!(contents.attachments, all.attachments);
    assert_eq!(contents.metadata, all.metadata);
    assert_eq!(
        (&contents.way, contents.gone, contents.chunks.len()),
        (&all.way, all.gone, all.chunks.len())
    );
    for (place, known) in contents.chunks.iter().zip(&all.chunks) {
        let chunk = file.chunk(place).expect("it is whole");
        assert_eq!(chunk.bytes(), known.bytes());
        let times = chunk.messages().map(|message| message.time);
        let (first, last) = times.fold((u64::MAX, 0), |(first, last), time| {
            (first.min(time), last.max(time))
        });
        assert_eq!(place.times, (first, last));
    }
}

#[test]
fn the_index_tells_what_looking_at_everything_tells() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    record(
        &path,
        60_000,
        1,
        Settings {
            budget: 64 << 10,
            ..settings()
        },
    );
    let bytes = std::fs::read(&path).expect("it was written");
    let all = Recording::read(&bytes).expect("it can be read");
    let file = RecordingFile::open(&path).expect("it can be read");
    assert!(file.contents().is_indexed && all.gone > 10);
    assert_same(&file, &all);
}

#[test]
fn a_cut_file_is_read_without_its_index() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    record(&path, 1500, 20, settings());
    let bytes = std::fs::read(&path).expect("it was written");
    let whole = Recording::read(&bytes).expect("it can be read");
    let boundaries = whole.chunks.iter().map(|chunk| chunk.offset as usize);
    let ends = [bytes.len() - 1, bytes.len() - 20, bytes.len() - 300];
    for cut in boundaries.chain(ends) {
        std::fs::write(&path, &bytes[..cut]).expect("there is room");
        let file = RecordingFile::open(&path).expect("its beginning is there");
        assert!(!file.contents().is_indexed && file.contents().way != Way::Whole);
        assert!(!file.contents().is_complete());
        assert_same(&file, &Recording::read(&bytes[..cut]).expect("the same"));
    }
}

#[test]
fn a_damaged_chunk_is_told_when_it_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    record(&path, 1500, 20, settings());
    let mut bytes = std::fs::read(&path).expect("it was written");
    let file = RecordingFile::open(&path).expect("it can be read");
    let damaged = file.contents().chunks[3];
    bytes[damaged.offset as usize + 200] ^= 1;
    std::fs::write(&path, &bytes).expect("there is room");
    let file = RecordingFile::open(&path).expect("its index is right");
    assert!(file.chunk(&file.contents().chunks[2]).is_ok());
    let read = file.chunk(&damaged);
    assert!(matches!(read, Err(ReadError::Damaged { offset }) if offset == damaged.offset));
    let all = Recording::open(&path).expect("what is before it can be read");
    assert_eq!(all.chunks.len(), 3);
    assert_eq!(
        all.way,
        Way::Cut {
            behind: damaged.offset
        }
    );
}

#[test]
fn what_is_no_recording_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    for bytes in [&b""[..], b"short", b"a text that is longer than that"] {
        std::fs::write(&path, bytes).expect("there is room");
        assert!(matches!(RecordingFile::open(&path), Err(ReadError::Other)));
    }
}
