//! What is shown of files with a damaged chunk.

use camino::Utf8Path;

use super::{CYCLES, folder, of, record};
use crate::recording::{Export, cat, export, open};

/// Damages the third and fourth of five chunks of eight cycles, or only the third; `with_index`: of a file that did not break off.
fn damage(path: &Utf8Path, count: usize, with_index: bool) -> Vec<u64> {
    record(path, true);
    let chunks = open(path).expect("it can be read").into_contents().chunks;
    let mut bytes = std::fs::read(path).expect("it was written");
    let damaged: Vec<u64> = chunks[2..2 + count].iter().map(|one| one.offset).collect();
    for offset in &damaged {
        // Behind the head of the chunk: what is compressed.
        bytes[*offset as usize + 60] ^= 1;
    }
    if !with_index {
        let last = chunks[4];
        bytes.truncate((last.offset + last.length) as usize);
    }
    std::fs::write(path, &bytes).expect("there is room");
    assert_eq!(
        open(path).expect("it can be read").contents().is_indexed,
        with_index
    );
    damaged
}

/// Exports of a file with one damaged chunk.
fn export_all(with_index: bool) {
    let (_keep, folder) = folder();
    let path = folder.join("a.mcap");
    let damaged = damage(&path, 1, with_index);
    let told = |output: &str, kind, into: &str| {
        let into = folder.join(into);
        let refusal = export(&path, &of(&[output]), kind, &into).expect_err("it is damaged");
        (into, refusal.message)
    };
    let ball = "Control.main_outputs.ball";
    let rest = CYCLES as usize - 8;
    let (table, message) = told(ball, Export::Csv, "ball.csv");
    let text = std::fs::read_to_string(&table).expect("it was written");
    assert_eq!(text.lines().count(), 1 + rest);
    assert!(text.contains("\r\n38,0.380000000,38.0,0.5,"), "{text}");
    let expected = format!(
        "the chunk at byte {} is damaged: what it had is missing in `{table}`, everything else is there",
        damaged[0]
    );
    assert_eq!(message, expected);
    let (lines, _) = told(ball, Export::Json, "ball.json");
    let text = std::fs::read_to_string(lines).expect("it was written");
    assert_eq!(text.lines().count(), rest);
    let (images, _) = told("Camera.main_outputs.image", Export::Png, "images");
    assert_eq!(images.read_dir().expect("it is there").count(), rest);
    assert!(images.join("00000039.png").exists());
    let left = folder.read_dir().expect("it is there").count();
    assert_eq!(left, 4, "no halves are left");
}

#[test]
fn all_but_a_damaged_chunk_is_exported() {
    export_all(true);
}

#[test]
fn all_but_a_damaged_chunk_is_exported_of_a_file_without_an_index() {
    export_all(false);
}

#[test]
fn cat_shows_all_but_damaged_chunks_and_tells_them() {
    for (count, with_index) in [(1, true), (1, false), (2, true), (2, false)] {
        let (_keep, folder) = folder();
        let path = folder.join("a.mcap");
        let first = damage(&path, count, with_index)[0];
        let file = open(&path).expect("it can be read");
        let mut values = 0;
        let shown = cat(&file, &of(&["Control.main_outputs.ball"]), &mut |_| {
            values += 1;
            Ok(true)
        });
        let shown = shown.expect("the others can be read");
        assert_eq!(
            values,
            CYCLES as usize - 8 * count,
            "those behind are shown"
        );
        let what = match count {
            1 => format!("the chunk at byte {first} is damaged: what it had"),
            _ => format!("the chunk at byte {first} and 1 more are damaged: what they had"),
        };
        let refusal = shown.complete(None).expect_err("the damage is told");
        let expected = format!("{what} is missing, everything else is there");
        assert_eq!(refusal.message, expected, "with index: {with_index}");
    }
}
