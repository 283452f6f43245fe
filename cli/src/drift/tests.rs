//! What is compared with the disk, written and removed.

use super::*;

fn files(texts: &[(&str, &str)]) -> GeneratedFiles {
    texts
        .iter()
        .map(|(path, text)| ((*path).into(), (*text).to_owned()))
        .collect()
}

struct Folder(tempfile::TempDir);

impl Folder {
    fn with(texts: &[(&str, &str)]) -> Self {
        let folder = Self(tempfile::tempdir().expect("the temporary folder is writable"));
        for (path, text) in texts {
            write_file(&folder.root().join(path), text).expect("the temporary folder is writable");
        }
        folder
    }

    fn root(&self) -> &Utf8Path {
        Utf8Path::from_path(self.0.path()).expect("temporary folders have plain names")
    }

    fn compare(&self, files: &GeneratedFiles) -> Drift {
        Drift::compare(self.root(), "generated".into(), files).expect("everything is readable")
    }
}

#[test]
fn writing_what_differs_leaves_nothing_that_differs() {
    let folder = Folder::with(&[
        ("generated/src/lib.rs", "old\n"),
        ("generated/src/gone/orphan.rs", "\n"),
        ("generated/target/debug/huge", "\n"),
        ("generated/Cargo.lock", "\n"),
        ("elsewhere.rs", "\n"),
    ]);
    let files = files(&[
        ("generated/Cargo.toml", "new\n"),
        ("generated/src/lib.rs", "new\n"),
    ]);
    let drift = folder.compare(&files);
    assert_eq!(
        drift.summary(),
        "+ generated/Cargo.toml\n- generated/src/gone/orphan.rs\n~ generated/src/lib.rs\n"
    );
    drift
        .write(folder.root(), &files)
        .expect("everything is writable");
    assert!(folder.compare(&files).is_empty());
    assert!(!folder.root().join("generated/src/gone").exists());
    assert!(folder.root().join("generated/target/debug/huge").exists());
    assert!(folder.root().join("elsewhere.rs").exists());
}

#[test]
fn an_unchanged_file_is_not_touched() {
    let folder = Folder::with(&[("generated/a", "same\n"), ("generated/b", "old\n")]);
    let written = |name: &str| {
        let metadata = folder.root().join("generated").join(name).metadata();
        metadata
            .and_then(|metadata| metadata.modified())
            .expect("the file is there")
    };
    let before = written("a");
    let files = files(&[("generated/a", "same\n"), ("generated/b", "new\n")]);
    folder
        .compare(&files)
        .write(folder.root(), &files)
        .expect("everything is writable");
    assert_eq!(written("a"), before);
}

#[test]
fn the_diff_shows_changes_and_names_the_rest() {
    let folder = Folder::with(&[("generated/a", "one\ntwo\n"), ("generated/c", "\n")]);
    let drift = folder.compare(&files(&[
        ("generated/a", "one\nthree\n"),
        ("generated/b", "\n"),
    ]));
    assert_eq!(
        drift.diff(),
        "--- a/generated/a\n+++ b/generated/a\n@@ -1,2 +1,2 @@\n one\n-two\n+three\n\
         missing: generated/b\norphaned: generated/c\n"
    );
}

#[test]
fn a_folder_of_others_is_never_cleaned() {
    let folder = Folder::with(&[("hulk.toml", ""), ("robot/hulk.toml", "")]);
    for unsafe_folder in ["", ".", "..", "/", "generated/../..", "robot"] {
        let compared = Drift::compare(folder.root(), unsafe_folder.into(), &GeneratedFiles::new());
        assert!(
            matches!(compared, Err(DriftError::NotOwned { .. })),
            "{unsafe_folder}"
        );
    }
}

#[test]
fn text_that_is_no_utf_8_is_drift_and_no_failure() {
    let folder = Folder::with(&[("generated/a", "")]);
    std::fs::write(folder.root().join("generated/a"), [0xff]).expect("the file is writable");
    assert_eq!(
        folder
            .compare(&files(&[("generated/a", "text\n")]))
            .changed
            .len(),
        1
    );
}
