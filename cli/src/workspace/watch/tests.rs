//! Files that change, come and do not matter.

use camino::Utf8Path;

use super::{Asked, Glance};
use crate::workspace::Workspace;

#[test]
fn a_changed_and_a_new_file_are_seen_and_generated_ones_are_not() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let root = Utf8Path::from_path(folder.path()).expect("it is UTF-8");
    let write = |file: &str, text: &str| {
        std::fs::create_dir_all(root.join("generated")).expect("the folder is ours");
        std::fs::write(root.join(file), text).expect("the folder is ours");
    };
    write("hulk.toml", "a");
    let glance = || Glance::at(&Workspace::at_root(root), &Asked::default());
    let before = glance();
    assert!(glance().is_as(&before, None));
    write("notes.md", "");
    assert!(glance().is_as(&before, None));
    write("generated/lib.rs", "");
    assert!(glance().is_as(&before, Some("generated".into())));
    assert!(!glance().is_as(&before, None));
    write("hulk.toml", "ab");
    assert!(!glance().is_as(&before, Some("generated".into())));
}

#[cfg(unix)]
#[test]
fn what_somebody_asked_for_is_seen_outside_and_behind_links() {
    use std::os::unix::fs::symlink;

    let folder = tempfile::tempdir().expect("a temporary folder");
    let outer = Utf8Path::from_path(folder.path()).expect("it is UTF-8");
    let root = outer.join("robot");
    for folder in ["robot", "shared", "linked"] {
        std::fs::create_dir(outer.join(folder)).expect("the folder is ours");
    }
    let write = |file: &str, text: &str| {
        std::fs::write(root.join(file), text).expect("the folder is ours");
    };
    symlink("../linked", root.join("nodes")).expect("the folder is ours");
    write("hulk.toml", "");
    write("../shared/default.toml", "a");
    write("nodes/lib.rs", "a");
    let reading = Workspace::at_root(&root);
    for file in ["../shared/default.toml", "nodes/lib.rs"] {
        reading.read(file.into()).expect("it is there");
    }
    assert!(!reading.is_file("nodes/more.rs".into()));
    assert!(reading.list("../shared".into()).len() == 1);
    let asked = Asked::of(&reading);
    let glance = || Glance::at(&Workspace::at_root(&root), &asked);
    for (file, text) in [
        ("../shared/default.toml", "ab"),
        ("../shared/head.toml", "a"),
        ("nodes/lib.rs", "ab"),
        ("nodes/more.rs", "a"),
    ] {
        let before = glance();
        assert!(glance().is_as(&before, None));
        write(file, text);
        assert!(!glance().is_as(&before, None), "{file}");
    }
    assert!(!reading.is_as_read());
}

#[cfg(unix)]
#[test]
fn links_to_folders_are_not_followed_and_links_to_files_are() {
    use std::os::unix::fs::symlink;

    let folder = tempfile::tempdir().expect("a temporary folder");
    let root = Utf8Path::from_path(folder.path()).expect("it is UTF-8");
    std::fs::create_dir(root.join("src")).expect("the folder is ours");
    std::fs::write(root.join("src/lib.rs"), "").expect("the folder is ours");
    symlink("lib.rs", root.join("src/same.rs")).expect("the folder is ours");
    symlink("..", root.join("src/again")).expect("the folder is ours");
    let workspace = Workspace::at_root(root);
    assert_eq!(
        workspace.files_below("".into()),
        ["src/lib.rs", "src/same.rs"]
    );
}
