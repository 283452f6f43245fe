//! Recordings in which something is not what was written.

use super::{folder, record};
use crate::recording::{info, open, recover};

#[test]
fn a_recovered_file_is_complete_only_where_nothing_was_lost() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let all = recover(&path, None).expect("the other file is new");
    assert_eq!(all.lost, 0);
    assert_eq!(info(&all.into).expect("it is whole").state, "COMPLETE");

    let mut bytes = std::fs::read(&path).expect("it was written");
    let file = open(&path).expect("it can be read");
    // Behind the head of the chunk: what is compressed.
    bytes[file.contents().chunks[2].offset as usize + 60] ^= 1;
    std::fs::write(&path, &bytes).expect("there is room");
    let into = folder.join("b.mcap");
    let some = recover(&path, Some(&into)).expect("the other file is new");
    let damaged = file.contents().chunks[2].offset;
    let of_damaged = info(&path).expect("the others can be read");
    assert_eq!((of_damaged.state, of_damaged.chunks), ("INCOMPLETE", 4));
    assert_eq!(
        (of_damaged.cut_behind, of_damaged.damaged),
        (None, vec![damaged])
    );
    assert_eq!((some.chunks, some.lost), (4, 0));
    assert_eq!(some.damaged, [damaged]);
    assert_eq!(info(&into).expect("it is whole").state, "INCOMPLETE");
}

#[test]
fn an_attachment_that_is_damaged_is_told_and_costs_no_chunk() {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    record(&path, true);
    let whole = info(&path).expect("it can be read");
    let mut bytes = std::fs::read(&path).expect("it was written");
    let text = b"application/json";
    let at = bytes.windows(text.len()).position(|part| part == text);
    bytes[at.expect("its first attachment")] ^= 1;
    std::fs::write(&path, &bytes).expect("there is room");
    let damaged = info(&path).expect("all else can be read");
    assert_eq!((damaged.state, damaged.cut_behind), ("INCOMPLETE", None));
    assert_eq!(
        (damaged.chunks, damaged.unreadable.len()),
        (whole.chunks, 1)
    );
    let some = recover(&path, None).expect("the other file is new");
    assert_eq!(
        (some.chunks, some.unreadable),
        (whole.chunks, damaged.unreadable)
    );
}
