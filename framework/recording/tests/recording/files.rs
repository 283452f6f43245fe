//! Files that are read one chunk at a time.

use std::ops::Range;

use hulkgen_mcap::opcode::{ATTACHMENT, DATA_END, METADATA};
use hulkgen_mcap::recover;
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
    let all = Recording::open(&path).expect("the others can be read");
    assert_eq!(all.chunks.len(), file.contents().chunks.len() - 1);
    assert_eq!(
        (all.way.clone(), &*all.damaged),
        (Way::Whole, &[damaged.offset][..])
    );
    assert!(!all.is_complete());
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

/// Offsets of what chunks begin with, and of the bytes of their messages.
fn sound(recording: &Recording) -> Vec<(u64, &[u8])> {
    let chunks = recording.chunks.iter();
    chunks.map(|chunk| (chunk.offset, chunk.bytes())).collect()
}

#[test]
fn whatever_bit_is_wrong_the_chunks_beside_it_are_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    record(&path, 1500, 20, settings());
    let bytes = std::fs::read(&path).expect("it was written");
    let whole = Recording::read(&bytes).expect("it can be read");
    let file = RecordingFile::open(&path).expect("it can be read");
    let places = file.contents().chunks.clone();
    assert!(places.len() > 5);
    // Any odd number that has nothing to do with the file.
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    for _ in 0..300 {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let place = places[(random >> 33) as usize % places.len()];
        // The kind of the record, or what is behind its length.
        let byte = match random >> 40 & 7 {
            0 => place.offset,
            _ => place.offset + 9 + (random >> 20) % (place.length - 9),
        };
        let mut damaged = bytes.clone();
        damaged[byte as usize] ^= 1 << (random >> 60 & 7);
        let others: Vec<_> = (sound(&whole).into_iter())
            .filter(|(offset, _)| *offset != place.offset)
            .collect();
        std::fs::write(&path, &damaged).expect("there is room");
        // Once by its index, once without.
        let indexed = Recording::open(&path).expect("it can be read");
        let scanned = Recording::read(&damaged).expect("it can be read");
        for read in [indexed, scanned] {
            let mut found = sound(&read);
            // Times of a chunk have no check sum.
            found.retain(|(offset, _)| *offset != place.offset);
            assert_eq!(found, others, "byte {byte}");
            assert_eq!(read.way, Way::Whole, "byte {byte}");
            let is_told = read.damaged == [place.offset];
            assert!(is_told || read.chunks.len() == places.len(), "byte {byte}");
        }
    }
}

/// Kinds and places of the records in front of a file's summary.
fn records(bytes: &[u8]) -> impl Iterator<Item = (u8, Range<usize>)> {
    let mut start = 8;
    std::iter::from_fn(move || {
        let kind = bytes[start];
        let (length, _) = bytes[start + 1..].split_first_chunk()?;
        let place = start..start + 9 + u64::from_le_bytes(*length) as usize;
        start = place.end;
        (kind != DATA_END).then_some((kind, place))
    })
}

#[test]
fn whatever_bit_of_metadata_or_an_attachment_is_wrong_all_chunks_are_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    record(&path("run.mcap"), 1500, 20, settings());
    let bytes = std::fs::read(path("run.mcap")).expect("it was written");
    let whole = Recording::read(&bytes).expect("it can be read");
    let places: Vec<_> = records(&bytes)
        .filter(|(kind, _)| [METADATA, ATTACHMENT].contains(kind))
        .collect();
    let kinds = |kind| places.iter().filter(|(one, _)| *one == kind).count();
    assert!(kinds(METADATA) > 1 && kinds(ATTACHMENT) > 0, "{places:?}");
    let mut untold = 0;
    for (kind, place) in &places {
        // Their last bytes: of text, or of a check sum.
        for (byte, bit) in [(place.end - 1, 7), (place.end - 2, 7), (place.start + 9, 5)] {
            let mut damaged = bytes.clone();
            damaged[byte] ^= 1 << bit;
            std::fs::write(path("damaged.mcap"), &damaged).expect("there is room");
            let indexed = Recording::open(&path("damaged.mcap")).expect("it can be read");
            let scanned = Recording::read(&damaged).expect("it can be read");
            for read in [indexed, scanned] {
                assert_eq!(sound(&read), sound(&whole), "byte {byte}");
                assert_eq!((&read.way, &*read.damaged), (&Way::Whole, &[][..]));
                let is_told = read.unreadable == [place.start as u64];
                assert_eq!(is_told, !read.is_complete(), "byte {byte}");
                untold += u32::from(!is_told);
                assert!(is_told || *kind == METADATA, "attachments have check sums");
            }
        }
    }
    assert!(untold < places.len() as u32, "{untold}");
    // What is left of the last one that was tried.
    let file = RecordingFile::open(&path("damaged.mcap")).expect("it can be read");
    let recovered = recover(&file, &path("recovered.mcap")).expect("there is room");
    assert_eq!(recovered.chunks as usize, whole.chunks.len());
    assert_eq!(recovered.unreadable, file.contents().unreadable);
    let again = Recording::open(&path("recovered.mcap")).expect("it can be read");
    assert_eq!((again.way.clone(), again.unreadable.len()), (Way::Whole, 0));
    assert!(!again.is_complete());
}

#[test]
fn where_the_length_of_a_damaged_chunk_is_wrong_the_file_breaks_off_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    record(&path, 1500, 20, settings());
    let mut bytes = std::fs::read(&path).expect("it was written");
    let file = RecordingFile::open(&path).expect("it can be read");
    let place = file.contents().chunks[3];
    let length = place.offset as usize + 1;
    bytes[length..length + 8].copy_from_slice(&(place.length / 2).to_le_bytes());
    let read = Recording::read(&bytes).expect("what is before it can be read");
    assert_eq!(read.chunks.len(), 3);
    let behind = place.offset;
    assert_eq!((read.way, read.damaged), (Way::Cut { behind }, Vec::new()));
}

#[test]
fn a_chunk_of_another_kind_is_a_chunk_nevertheless() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    record(&path, 1500, 20, settings());
    let bytes = std::fs::read(&path).expect("it was written");
    let whole = Recording::read(&bytes).expect("it can be read");
    let end = whole.chunks[6].offset as usize;
    for kind in 0..=u8::MAX {
        let mut cut = bytes[..end].to_vec();
        cut[whole.chunks[3].offset as usize] = kind;
        std::fs::write(&path, &cut).expect("there is room");
        let file = RecordingFile::open(&path).expect("its beginning is there");
        let read = Recording::read(&cut).expect("its beginning is there");
        assert_same(&file, &read);
        assert_eq!(sound(&read), sound(&whole)[..6], "kind {kind}");
        assert_eq!((read.gone, read.damaged), (0, Vec::new()), "kind {kind}");
    }
}

#[test]
fn a_recovered_file_says_what_the_ring_closed_over() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let budget = 64 << 10;
    let settings = Settings {
        budget,
        ..settings()
    };
    record(&path("run.mcap"), 60_000, 1, settings);
    let bytes = std::fs::read(path("run.mcap")).expect("it was written");
    let whole = Recording::read(&bytes).expect("it can be read");
    let last = whole.chunks.last().expect("there are some").offset;
    let cut = |from: &str, into: &str, end: usize| {
        let bytes = std::fs::read(path(from)).expect("it was written");
        std::fs::write(path(into), &bytes[..end]).expect("there is room");
        RecordingFile::open(&path(into)).expect("it can be read")
    };
    let gone = |file: &RecordingFile| file.contents().gone;
    // Before what the end says, and in its index.
    for end in [last as usize, bytes.len() - 20] {
        let broken = cut("run.mcap", &format!("{end}.cut"), end);
        assert_eq!(gone(&broken), whole.gone);
        let recovered = path(&format!("{end}.recovered"));
        hulkgen_mcap::recover(&broken, &recovered).expect("there is room");
        let recovered = RecordingFile::open(&recovered).expect("it can be read");
        assert!(recovered.contents().is_indexed);
        assert_eq!(gone(&recovered), whole.gone);
        let named = |name: &str| {
            let all = recovered.contents().metadata.iter();
            all.filter(|one| one.name == name).count()
        };
        assert_eq!(named("ring"), 1);
        let length = recovered.length().expect("it is there") as usize;
        let again = cut(
            &format!("{end}.recovered"),
            &format!("{end}.again"),
            length - 20,
        );
        assert!(!again.contents().is_indexed);
        assert_eq!(gone(&again), whole.gone);
    }
}
