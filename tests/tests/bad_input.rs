//! Hostile files on a real disk: a clear error, nothing half-written, no panic and no hang.

use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt as _, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use support::{fixture_files, skip};

/// The smallest robot in a folder of its own.
struct Robot {
    folder: tempfile::TempDir,
}

impl Robot {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let robot = Self { folder };
        for (path, text) in fixture_files("smallest") {
            robot.write(&path, text);
        }
        robot
    }

    fn path(&self, path: &str) -> PathBuf {
        self.folder.path().join(path)
    }

    fn write(&self, path: &str, content: impl AsRef<[u8]>) {
        let path = self.path(path);
        fs::create_dir_all(path.parent().expect("it lies in a folder"))
            .expect("the folder is ours");
        fs::write(path, content).expect("the folder is ours");
    }

    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(binary());
        command
            .args(arguments.split_whitespace())
            .current_dir(self.folder.path());
        command
    }

    #[track_caller]
    fn refuses(&self, arguments: &str, parts: &[&str]) {
        let (status, text) = ended(&mut self.command(arguments));
        assert_eq!(status, Some(1), "{arguments}: {text}");
        for part in parts {
            assert!(text.contains(part), "`{part}` is missing in: {text}");
        }
    }

    /// Names and bytes below the generated folder.
    fn generated(&self) -> Vec<(PathBuf, Vec<u8>)> {
        let mut found = Vec::new();
        let mut open = vec![self.path("generated")];
        while let Some(folder) = open.pop() {
            for entry in fs::read_dir(folder).into_iter().flatten() {
                let path = entry.expect("it was just listed").path();
                match fs::read(&path) {
                    Ok(content) => found.push((path, content)),
                    Err(_) => open.push(path),
                }
            }
        }
        found.sort();
        found
    }
}

fn binary() -> PathBuf {
    let test = std::env::current_exe().expect("this test has a path");
    let folder = test
        .parent()
        .and_then(Path::parent)
        .expect("target/<profile>/deps/<test>");
    folder.join("hulkgen")
}

/// Status and output; a hang is a failure.
#[track_caller]
fn ended(command: &mut Command) -> (Option<i32>, String) {
    let command = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().expect("hulkgen was built");
    let start = Instant::now();
    while child.try_wait().expect("it is our child").is_none() {
        if start.elapsed() > Duration::from_secs(60) {
            let _ = child.kill();
            panic!("it hangs");
        }
        thread::sleep(Duration::from_millis(5));
    }
    let Output {
        status,
        stdout,
        stderr,
    } = child.wait_with_output().expect("it is our child");
    let text = [stdout, stderr].concat();
    (
        status.code(),
        String::from_utf8(text).expect("hulkgen prints UTF-8"),
    )
}

#[test]
fn what_is_no_utf8_is_told_with_its_line() {
    for file in [
        "hulk.toml",
        "nodes/src/counter.rs",
        "parameters/default.toml",
    ] {
        let robot = Robot::new();
        robot.write(file, b"# one\n# two\n\xff\xfe");
        robot.refuses("check", &[file, "line 3 is no UTF-8"]);
    }
}

#[test]
fn ten_megabytes_are_refused() {
    for file in [
        "hulk.toml",
        "nodes/src/counter.rs",
        "parameters/default.toml",
    ] {
        let robot = Robot::new();
        robot.write(file, " ".repeat(10 << 20));
        robot.refuses("check", &[file, "larger than 4 MiB"]);
    }
}

#[test]
fn folders_and_pipes_are_no_files() {
    for file in [
        "nodes/Cargo.toml",
        "nodes/src/counter.rs",
        "parameters/default.toml",
    ] {
        let robot = Robot::new();
        fs::remove_file(robot.path(file)).expect("the fixture has it");
        fs::create_dir(robot.path(file)).expect("the folder is ours");
        robot.refuses("check", &[file]);
    }
    let robot = Robot::new();
    fs::remove_file(robot.path("parameters/default.toml")).expect("the fixture has it");
    let status = Command::new("mkfifo")
        .arg(robot.path("parameters/default.toml"))
        .status();
    if status.is_ok_and(|status| status.success()) {
        robot.refuses("check", &["parameters/default.toml", "no file"]);
    } else {
        skip("pipes are no files", "install coreutils");
    }
}

#[test]
fn a_module_that_contains_itself_is_an_error() {
    let robot = Robot::new();
    let file = "nodes/src/counter.rs";
    let node = fs::read_to_string(robot.path(file)).expect("the fixture has it");
    let circle = node
        .replace("cycle(&mut self", "other(&mut self")
        .replace("count:", "other:");
    robot.write(
        file,
        format!("#[path = \"counter.rs\"]\npub mod again;\n{circle}"),
    );
    let manifest = fs::read_to_string(robot.path("hulk.toml")).expect("the fixture has it");
    robot.write(
        "hulk.toml",
        manifest.replace("nodes::counter", "nodes::counter::again::again"),
    );
    robot.refuses("check", &["would contain itself", file]);
}

#[test]
fn links_that_lead_in_circles_are_no_hang() {
    let robot = Robot::new();
    for name in ["a", "b"] {
        symlink(".", robot.path("nodes/src").join(name)).expect("the folder is ours");
    }
    robot.write("nodes/src/mod.rs", "pub mod a;\npub mod b;\n");
    robot.write(
        "nodes/src/lib.rs",
        "pub mod a;\npub mod b;\npub mod counter;\npub struct Hardware;\nimpl framework::Hardware for Hardware {}\n",
    );
    let node = fs::read_to_string(robot.path("nodes/src/counter.rs")).expect("the fixture has it");
    let reads = "pub struct CycleContext { x: framework::Input<u64, \"nothing\">, ";
    robot.write(
        "nodes/src/counter.rs",
        node.replace("pub struct CycleContext {", reads),
    );
    robot.refuses("check", &["nothing"]);
    symlink("hulk.toml", robot.path("link.toml")).expect("the folder is ours");
    fs::remove_file(robot.path("hulk.toml")).expect("the fixture has it");
    symlink("link.toml", robot.path("hulk.toml")).expect("the folder is ours");
    robot.refuses("check", &["hulk.toml"]);
}

#[test]
fn what_may_not_be_read_or_written_is_told() {
    let robot = Robot::new();
    let file = robot.path("nodes/src/counter.rs");
    fs::set_permissions(&file, Permissions::from_mode(0o0)).expect("the file is ours");
    if fs::read(&file).is_ok() {
        eprintln!("root may read and write everything, so there is nothing to tell");
        return;
    }
    robot.refuses("check", &["nodes/src/counter.rs", "ermission denied"]);
    fs::set_permissions(&file, Permissions::from_mode(0o644)).expect("the file is ours");
    fs::create_dir(robot.path("generated")).expect("the folder is ours");
    fs::set_permissions(robot.path("generated"), Permissions::from_mode(0o555))
        .expect("it is ours");
    robot.refuses("generate", &["generated", "ermission denied"]);
    assert!(robot.generated().is_empty());
    fs::set_permissions(robot.path("generated"), Permissions::from_mode(0o755))
        .expect("it is ours");
}

#[test]
fn a_file_where_the_folder_should_be_is_told() {
    let robot = Robot::new();
    robot.write("generated", "mine");
    robot.refuses("generate", &["generated"]);
    assert_eq!(
        fs::read_to_string(robot.path("generated")).expect("it stays"),
        "mine"
    );
}

#[test]
fn a_full_disk_leaves_everything_as_it_was() {
    let robot = Robot::new();
    assert_eq!(ended(&mut robot.command("generate")).0, Some(0));
    let before = robot.generated();
    let manifest = fs::read_to_string(robot.path("hulk.toml")).expect("the fixture has it");
    robot.write("hulk.toml", manifest.replace("\"smallest\"", "\"smaller\""));
    // No file may grow beyond one block: as a full disk, the write fails half-way.
    let mut limited = Command::new("bash");
    let script = format!(
        "ulimit -f 1; trap '' XFSZ; exec {} generate",
        binary().display()
    );
    limited
        .args(["-c", &script])
        .current_dir(robot.folder.path());
    let (status, text) = ended(&mut limited);
    assert_eq!(status, Some(1), "{text}");
    assert!(text.contains("cannot write"), "{text}");
    assert_eq!(before, robot.generated());
}

#[test]
fn two_at_once_leave_what_one_would() {
    let robot = Robot::new();
    let children: Vec<_> = (0..8)
        .map(|_| robot.command("generate").stderr(Stdio::null()).spawn())
        .collect();
    for child in children {
        let status = child
            .expect("hulkgen was built")
            .wait()
            .expect("it is our child");
        assert_eq!(status.code(), Some(0));
    }
    assert_eq!(ended(&mut robot.command("generate --check")).0, Some(0));
}
