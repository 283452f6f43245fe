//! Several hulkgens in one workspace, and an editor beside one.

use std::fs::File;
use std::io::{Read as _, Write as _};
use std::path::Path;
use std::process::Stdio;

use rustix::fs::inotify;

use crate::robot::{Ended, Robot};

#[test]
fn nodes_that_are_added_at_once_are_all_there() {
    let robot = Robot::tiny();
    robot.run("generate").expect(0);
    let names = ["a1", "b1", "c1", "d1", "e1", "f1"];
    let adding = names.map(|name| {
        let mut command = robot.command(&format!("add-node nodes::{name} --cycler Control"));
        let piped = command.stdout(Stdio::piped()).stderr(Stdio::piped());
        piped.spawn().expect("hulkgen was built")
    });
    // Whoever generates meanwhile does not write what was before.
    robot.run("generate").expect(0);
    for child in adding {
        let output = child.wait_with_output().expect("it ends");
        assert!(output.status.success(), "{output:?}");
    }
    let (manifest, library) = (robot.read("hulk.toml"), robot.read("nodes/src/lib.rs"));
    for name in names {
        assert!(
            manifest.contains(&format!("\"nodes::{name}\"")),
            "{manifest}"
        );
        assert!(library.contains(&format!("mod {name};")), "{library}");
        assert!(robot.path(&format!("nodes/src/{name}.rs")).is_file());
    }
    robot.run("generate --check").expect(0);
}

/// Appends to the file as soon as hulkgen has read it, and tells how hulkgen ended.
fn saved_meanwhile(robot: &Robot, arguments: &str, file: &str, text: &str) -> Ended {
    let watch = inotify::init(inotify::CreateFlags::CLOEXEC).expect("there is inotify");
    let is_read = inotify::WatchFlags::CLOSE_NOWRITE;
    inotify::add_watch(&watch, robot.path(file), is_read).expect("the file is there");
    let mut command = robot.command(arguments);
    let piped = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = piped.spawn().expect("hulkgen was built");
    File::from(watch)
        .read_exact(&mut [0; 16])
        .expect("hulkgen reads the file");
    let mut editor = File::options();
    let editor = editor.append(true).open(robot.path(file));
    let saved = editor.expect("it is ours").write_all(text.as_bytes());
    saved.expect("there is room");
    Ended::from(child.wait_with_output().expect("it ends"))
}

#[test]
fn what_an_editor_has_saved_meanwhile_is_not_written_over() {
    for (file, text) in [("hulk.toml", "# mine\n"), ("nodes/src/lib.rs", "// mine\n")] {
        // On a busy machine the editor may be so late that all is written already.
        let refused = (0..20).any(|_| is_refused(file, text));
        assert!(refused, "{file}");
    }
}

/// Whether the editor saved before hulkgen wrote, and what has to be so then.
fn is_refused(file: &str, text: &str) -> bool {
    const ADD: &str = "add-node nodes::watcher --cycler Control";
    let robot = Robot::tiny();
    robot.run("generate").expect(0);
    let mut expected = robot.files();
    let ended = saved_meanwhile(&robot, ADD, file, text);
    if ended.status == Some(0) {
        return false;
    }
    let stderr = ended.expect(1).stderr;
    let message = format!("nothing was changed: `{file}` was changed meanwhile");
    assert!(stderr.contains(&message), "{stderr}");
    assert!(stderr.contains("run it again"), "{stderr}");
    let changed = expected.get_mut(Path::new(file)).expect("it is there");
    changed.extend(text.as_bytes());
    assert!(robot.files() == expected, "{file}");
    robot.run(ADD).expect(0);
    assert!(robot.read(file).contains(text.trim()));
    true
}
