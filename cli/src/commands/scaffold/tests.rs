//! What is said where nothing could be written, or not all of it taken back, and of what names a deleted module.

use std::fs;
use std::io;

use camino::Utf8Path;

use super::{UNTOUCHED, not_written, words};
use crate::drift;
use crate::scaffold::{Changes, Leftovers};

#[test]
fn nothing_was_changed_is_said_only_where_it_is_so() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let root = Utf8Path::from_path(folder.path()).expect("it is UTF-8");
    fs::write(root.join("a"), "before").expect("the folder is ours");
    let changes = ["a", "b"].map(|file| (file.into(), Some("after".to_owned())));
    let changes = Changes::from(changes);
    let full = |path: &Utf8Path| match path.as_str() {
        "b" => Err(io::Error::other("the disk is full")),
        _ => Ok(()),
    };
    let error = drift::write_all_asking(root, &changes, full).expect_err("the disk is full");
    let refusal = not_written(&error);
    assert_eq!(
        refusal.message,
        format!("{UNTOUCHED}: cannot write `b`: the disk is full")
    );
    let in_the_way = |path: &Utf8Path| {
        if path == "b" {
            fs::remove_file(root.join("a"))?;
            fs::create_dir_all(root.join("a/b"))?;
        }
        full(path)
    };
    let error = drift::write_all_asking(root, &changes, in_the_way).expect_err("as before");
    let refusal = not_written(&error);
    let message = &refusal.message;
    assert!(!message.contains(UNTOUCHED), "{message}");
    for part in [
        "cannot write `b`: the disk is full",
        "taken back: cannot",
        "irectory",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }
    assert!(refusal.help.is_some());
}

#[test]
fn only_lines_that_people_wrote_are_to_be_changed() {
    let only = Some("hulkgen generate --only Control".to_owned());
    let leftovers = Leftovers {
        lines: [("nodes/src/lib.rs".into(), 2)].into(),
        generated: [
            ("../cat/generated-control".into(), only.clone()),
            ("generated-control".into(), only),
            ("old".into(), None),
        ]
        .into(),
    };
    assert_eq!(
        words(&leftovers, "nodes::gone"),
        "nodes/src/lib.rs:2: this names `nodes::gone`, which is gone; change it\n\
         ../cat/generated-control: this generated crate names `nodes::gone`, which is gone; \
         `hulkgen generate --only Control` in the folder of its robot writes it anew\n\
         generated-control: this generated crate names `nodes::gone`, which is gone; \
         `hulkgen generate --only Control` writes it anew\n\
         old: this generated crate names `nodes::gone`, which is gone; write it anew or delete it\n"
    );
    assert_eq!(words(&Leftovers::default(), "nodes::gone"), "");
}
