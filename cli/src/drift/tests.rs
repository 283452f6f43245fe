//! What is compared with the disk, written and removed.

use super::*;
use crate::workspace::Workspace;

fn files(texts: &[(&str, &str)]) -> GeneratedFiles {
    texts
        .iter()
        .map(|(path, text)| ((*path).into(), (*text).to_owned()))
        .collect()
}

/// What makes a folder hulkgen's.
const HEADER: &str = "# Written by `hulkgen generate` from an older manifest.\n";

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
        ("generated/src/lib.rs", &format!("old\n{HEADER}")),
        ("generated/src/gone/orphan.rs", "\n"),
        ("generated/target/debug/huge", "\n"),
        ("generated/Cargo.lock", "\n"),
        ("elsewhere.rs", "\n"),
    ]);
    let files = files(&[
        ("generated/Cargo.toml", HEADER),
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
    let folder = Folder::with(&[("generated/a", HEADER), ("generated/b", "old\n")]);
    let written = |name: &str| {
        let metadata = folder.root().join("generated").join(name).metadata();
        metadata
            .and_then(|metadata| metadata.modified())
            .expect("the file is there")
    };
    let before = written("a");
    let files = files(&[("generated/a", HEADER), ("generated/b", "new\n")]);
    folder
        .compare(&files)
        .write(folder.root(), &files)
        .expect("everything is writable");
    assert_eq!(written("a"), before);
}

#[test]
fn links_and_permissions_stay() {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    let folder = Folder::with(&[("shared/hulk.toml", "old\n"), ("own.rs", "old\n")]);
    let path = |name: &str| folder.root().join(name);
    symlink("shared/hulk.toml", path("hulk.toml")).expect("the folder is ours");
    let own = std::fs::Permissions::from_mode(0o600);
    std::fs::set_permissions(path("own.rs"), own).expect("it is ours");
    for name in ["hulk.toml", "own.rs"] {
        super::write_file(&path(name), "new\n").expect("it can be written");
    }
    assert!(path("hulk.toml").is_symlink());
    let read = |name: &str| std::fs::read_to_string(path(name)).expect("it is there");
    assert_eq!(read("shared/hulk.toml"), "new\n");
    let kept = std::fs::metadata(path("own.rs")).expect("it is there");
    assert_eq!(kept.permissions().mode() & 0o777, 0o600);
}

#[test]
fn the_diff_shows_changes_and_names_the_rest() {
    let folder = Folder::with(&[
        ("generated/Cargo.toml", HEADER),
        ("generated/a", "one\ntwo\n"),
        ("generated/c", "\n"),
    ]);
    let drift = folder.compare(&files(&[
        ("generated/Cargo.toml", HEADER),
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
fn a_folder_with_files_that_hulkgen_did_not_write_is_never_cleaned() {
    let files = files(&[
        ("generated/Cargo.toml", "new\n"),
        ("generated/src/lib.rs", "new\n"),
    ]);
    for foreign in ["generated/default.toml", "generated/src/lib.rs"] {
        let folder = Folder::with(&[(foreign, "mine\n")]);
        let error = Drift::compare(folder.root(), "generated".into(), &files)
            .expect_err("somebody else's files are there");
        let text = error.to_string();
        assert!(
            text.contains("`generated` cannot be the generated folder") && text.contains(foreign),
            "{text}"
        );
    }
    let text = format!("<<<<<<< ours\n{HEADER}=======\n{HEADER}>>>>>>> theirs\n");
    for own in ["generated/Cargo.toml", "generated/src/lib.rs"] {
        let drift = Folder::with(&[(own, &text), ("generated/mine", "\n")]).compare(&files);
        assert_eq!(drift.orphaned, ["generated/mine"]);
    }
    let folder = Folder::with(&[("generated/target/debug/huge", "\n")]);
    assert_eq!(folder.compare(&files).added.len(), 2);
    std::fs::remove_dir_all(folder.root().join("generated")).expect("the folder is ours");
    assert_eq!(folder.compare(&files).added.len(), 2);
}

#[test]
fn an_orphaned_link_goes_and_what_it_leads_to_stays() {
    use std::os::unix::fs::symlink;
    let folder = Folder::with(&[("generated/Cargo.toml", HEADER), ("mine/file", "mine\n")]);
    let path = |name: &str| folder.root().join(name);
    let links = [
        ("generated/src/folder", "../../mine"),
        ("generated/nowhere", "gone"),
    ];
    std::fs::create_dir(path("generated/src")).expect("the folder is ours");
    for (link, target) in links {
        symlink(target, path(link)).expect("the folder is ours");
    }
    let files = files(&[("generated/Cargo.toml", HEADER)]);
    let drift = folder.compare(&files);
    assert_eq!(
        drift.orphaned,
        ["generated/nowhere", "generated/src/folder"]
    );
    // A failure at the last of them brings the others back.
    let mut asked = 0;
    let refused = write_all_asking(folder.root(), &drift.changes(&files), |_| {
        asked += 1;
        match asked {
            2 => Err(std::io::ErrorKind::PermissionDenied.into()),
            _ => Ok(()),
        }
    });
    assert!(refused.is_err());
    assert_eq!(folder.compare(&files).orphaned, drift.orphaned);
    let target = path("generated/nowhere").read_link_utf8();
    assert_eq!(target.expect("it is back"), "gone");
    drift.write(folder.root(), &files).expect("it is ours");
    assert!(folder.compare(&files).is_empty());
    assert!(path("mine/file").is_file() && !path("generated/src").exists());
}

#[test]
fn text_that_is_no_utf_8_is_drift_and_no_failure() {
    let folder = Folder::with(&[("generated/Cargo.toml", HEADER), ("generated/a", "")]);
    std::fs::write(folder.root().join("generated/a"), [0xff]).expect("the file is writable");
    let files = files(&[("generated/Cargo.toml", HEADER), ("generated/a", "text\n")]);
    assert_eq!(folder.compare(&files).changed.len(), 1);
}

#[test]
fn what_is_not_as_it_was_read_is_not_written_over() {
    let folder = Folder::with(&[("a", "read\n"), ("b", "\u{feff}read\n"), ("gone", "\n")]);
    let workspace = Workspace::at_root(folder.root());
    for file in ["a", "b", "gone"] {
        workspace.read(file.into()).expect("it is there");
    }
    let text = |text: &str| Some(text.to_owned());
    let changes = [
        ("a", text("new\n")),
        ("b", text("new\n")),
        ("gone", None),
        ("new/c", text("new\n")),
    ];
    let changes: Changes = changes.map(|(path, text)| (path.into(), text)).into();
    let read = workspace.as_read(&changes);
    let turn = Turn::wait_for(folder.root()).expect("nobody else has it");
    let content = |file: &str| std::fs::read_to_string(folder.root().join(file)).ok();
    for (file, saved) in [
        ("a", "mine\n"),
        ("b", "read\n"),
        ("gone", "mine\n"),
        ("new/c", "mine\n"),
    ] {
        let before = content(file);
        write_file(&folder.root().join(file), saved).expect("the folder is ours");
        let error = write_all_in(&turn, &changes, &read).expect_err("somebody has saved it");
        assert_eq!(error.to_string(), format!("`{file}` was changed meanwhile"));
        assert_eq!(content(file).as_deref(), Some(saved));
        match before {
            Some(before) => write_file(&folder.root().join(file), &before).expect("it is ours"),
            None => std::fs::remove_file(folder.root().join(file)).expect("it is ours"),
        }
    }
    write_all_in(&turn, &changes, &read).expect("all is as it was read");
    assert_eq!(content("new/c").as_deref(), Some("new\n"));
    assert_eq!(content("gone"), None);
}

#[test]
fn a_file_that_is_written_by_two_ways_is_written() {
    let folder = Folder::with(&[("a", "read\n")]);
    std::os::unix::fs::symlink("a", folder.root().join("link")).expect("the folder is ours");
    let workspace = Workspace::at_root(folder.root());
    for file in ["a", "link"] {
        workspace.read(file.into()).expect("it is there");
    }
    let turn = Turn::wait_for(folder.root()).expect("nobody else has it");
    let both = |link: &str| -> Changes {
        let texts = [("a", "new\n"), ("link", link)];
        texts
            .map(|(path, text)| (path.into(), Some(text.to_owned())))
            .into()
    };
    let read = workspace.as_read(&both("new\n"));
    write_all_in(&turn, &both("other\n"), &read).expect_err("it cannot say both");
    write_all_in(&turn, &both("new\n"), &read).expect("they say the same");
    let content = std::fs::read_to_string(folder.root().join("a"));
    assert_eq!(content.expect("it is there"), "new\n");
    assert!(folder.root().join("link").is_symlink());
}
