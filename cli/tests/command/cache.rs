//! Answers of earlier runs: taken where nothing has changed, and never where anything has.

use std::fs::{self, File};
use std::os::unix::fs::{MetadataExt as _, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::robot::{Ended, Robot};

/// Each kept answer with what changes when it is written again.
fn kept(robot: &Robot) -> Vec<(PathBuf, u64, i64)> {
    let Ok(entries) = fs::read_dir(robot.cache().join("hulkgen")) else {
        return Vec::new();
    };
    let mut kept: Vec<_> = entries
        .map(|entry| {
            let entry = entry.expect("the folder can be read");
            let about = entry.metadata().expect("nobody else removes it");
            (entry.path(), about.ino(), about.ctime_nsec())
        })
        .collect();
    kept.sort();
    kept
}

/// Runs it, and tells whether its answer was an earlier one.
#[track_caller]
fn run(robot: &Robot, arguments: &str, status: i32) -> (Ended, bool) {
    let before = kept(robot);
    let ended = robot.run(arguments).expect(status);
    let after = kept(robot);
    let recalled = !before.is_empty() && before == after;
    (ended, recalled)
}

/// What is answered now, which has to be the same with and without earlier answers.
#[track_caller]
fn answer(robot: &Robot) -> String {
    let said = |arguments: &str, option: &str| {
        let ended = robot.run(&format!("{arguments} {option}"));
        let Ended {
            status,
            stdout,
            stderr,
        } = ended;
        format!("{arguments}: {status:?}\n{stdout}{stderr}")
    };
    let answers = ["check", "generate --check"].map(|arguments| {
        let fresh = said(arguments, "--no-cache");
        assert_eq!(
            said(arguments, ""),
            fresh,
            "`{arguments}` is told something old"
        );
        fresh
    });
    answers.concat()
}

/// Generates everything and keeps every answer.
fn settle(robot: &Robot) {
    // The generated crate is a member, so the first run changes what the second one reads.
    for arguments in ["generate", "generate", "check"] {
        robot.run(arguments).expect(0);
    }
}

fn settled() -> Robot {
    let robot = Robot::tiny();
    robot.edit("Cargo.toml", "[\"nodes\"]", "[\"generated\", \"nodes\"]");
    settle(&robot);
    robot
}

#[test]
fn where_nothing_has_changed_the_answer_is_an_earlier_one() {
    let robot = settled();
    for arguments in [
        "generate",
        "generate --check",
        "generate --format json",
        "check",
    ] {
        let fresh = robot.run(&format!("{arguments} --no-cache")).expect(0);
        let (ended, recalled) = run(&robot, arguments, 0);
        assert!(recalled, "`{arguments}` is answered anew");
        assert_eq!(ended.stdout, fresh.stdout, "{arguments}");
        assert_eq!(ended.stderr, fresh.stderr, "{arguments}");
    }
    // Bad answers are answers.
    robot.edit("nodes/src/counter.rs", "\"ticks\"", "\"ticsk\"");
    let (first, recalled) = run(&robot, "check", 1);
    assert!(!recalled);
    let (second, recalled) = run(&robot, "check", 1);
    assert!(recalled);
    assert_eq!(first.stdout, second.stdout);
    // Other questions have other answers.
    robot.edit("nodes/src/counter.rs", "\"ticsk\"", "\"ticks\"");
    robot.edit(
        "nodes/src/counter.rs",
        "    last: PreviousInput<u64, \"count\">,\n",
        "",
    );
    for _ in 0..2 {
        robot.run("check").expect(0);
        robot.run("check --deny-warnings").expect(1);
        let plain = robot.run("check --color never").expect(0).stdout;
        let colored = robot.run("check --color always").expect(0).stdout;
        assert!(!plain.contains('\x1b') && colored.contains('\x1b'));
    }
}

/// A change of a settled robot, by name.
type Change = (&'static str, fn(&Robot));

const NOTICED: &[Change] = &[
    ("a node is edited", |robot| {
        robot.edit("nodes/src/counter.rs", "\"ticks\"", "\"tocks\"");
    }),
    ("a node is edited, and its times and length stay", |robot| {
        let path = robot.path("nodes/src/counter.rs");
        let about = fs::metadata(&path).expect("it is there");
        robot.edit("nodes/src/counter.rs", "\"ticks\"", "\"tocks\"");
        let times = fs::FileTimes::new()
            .set_accessed(about.accessed().expect("times are known"))
            .set_modified(about.modified().expect("times are known"));
        let file = File::options()
            .write(true)
            .open(&path)
            .expect("it is there");
        file.set_times(times).expect("times can be set");
        let now = fs::metadata(&path).expect("it is there");
        assert_eq!(
            (now.mtime_nsec(), now.len()),
            (about.mtime_nsec(), about.len())
        );
    }),
    ("the manifest is edited", |robot| {
        robot.edit("hulk.toml", "name = \"real\"", "name = \"actual\"");
    }),
    ("a node is removed", |robot| {
        fs::remove_file(robot.path("nodes/src/counter.rs")).expect("it is there");
    }),
    ("a node is renamed", |robot| {
        let to = robot.path("nodes/src/count.rs");
        fs::rename(robot.path("nodes/src/counter.rs"), to).expect("it is there");
    }),
    ("a node is a folder now", |robot| {
        let text = robot.read("nodes/src/counter.rs");
        fs::remove_file(robot.path("nodes/src/counter.rs")).expect("it is there");
        robot.write(
            "nodes/src/counter/mod.rs",
            &text.replace("count:", "amount:"),
        );
    }),
    ("a file takes the place of another", |robot| {
        // `clock/mod.rs` is read only as long as there is no `clock.rs`.
        let text = robot
            .read("nodes/src/clock/mod.rs")
            .replace("ticks", "tocks");
        robot.write("nodes/src/clock.rs", &text);
    }),
    ("a node is no UTF-8", |robot| {
        fs::write(robot.path("nodes/src/counter.rs"), b"pub fn a() {}\n\xff").expect("writable");
    }),
    ("a node becomes unreadable", |robot| {
        fs::remove_file(robot.path("nodes/src/counter.rs")).expect("it is there");
        fs::create_dir(robot.path("nodes/src/counter.rs")).expect("writable");
    }),
    ("a link leads somewhere else", |robot| {
        robot.write(
            "nodes/other.rs",
            "pub mod inner;\npub type Linked = inner::Linked;\n",
        );
        fs::remove_file(robot.path("nodes/src/linked.rs")).expect("it is there");
        symlink("../other.rs", robot.path("nodes/src/linked.rs")).expect("links are known");
    }),
    ("a link leads back, to what says the same", |robot| {
        let inner = robot.path("nodes/src/linked/inner.rs");
        fs::remove_file(&inner).expect("it is there");
        symlink("../../linked.rs", inner).expect("links are known");
    }),
    ("what a link leads to is edited", |robot| {
        robot.edit(
            "nodes/linked.rs",
            "pub struct Linked;",
            "pub type Linked = u8;",
        );
    }),
    ("a file comes into a folder", |robot| {
        robot.write("parameters/moon/default.toml", "steps = 2\n");
    }),
    ("a package comes under a star", |robot| {
        robot.write("more/broken/Cargo.toml", "[package");
    }),
    ("the root's Cargo.toml is edited", |robot| {
        robot.edit("Cargo.toml", "\"nodes\"", "\"nods\"");
    }),
    ("a package's Cargo.toml is edited", |robot| {
        robot.edit("nodes/Cargo.toml", "name = \"nodes\"", "name = \"knots\"");
    }),
    ("a package outside of the robot is edited", |robot| {
        robot.edit(
            "outside/src/lib.rs",
            "pub type Step = u64;",
            "pub type Step = f32;",
        );
    }),
    ("a parameter is edited", |robot| {
        robot.edit("parameters/default.toml", "step = 1", "step = true");
    }),
    ("a parameter file is removed", |robot| {
        fs::remove_file(robot.path("parameters/default.toml")).expect("it is there");
    }),
    ("a generated file is edited", |robot| {
        let text = robot.read("generated/src/lib.rs") + "// more\n";
        robot.write("generated/src/lib.rs", &text);
    }),
    ("a generated file is removed", |robot| {
        fs::remove_file(robot.path("generated/src/lib.rs")).expect("it is there");
    }),
    ("an orphan is in the generated folder", |robot| {
        robot.write("generated/src/orphan.rs", "\n");
    }),
    ("the generated folder belongs to somebody else", |robot| {
        fs::create_dir(robot.path("generated/.git")).expect("writable");
    }),
];

/// A settled robot in which every change of the list means something.
fn varied() -> Robot {
    let robot = Robot::tiny();
    robot.write(
        "Cargo.toml",
        "[workspace]\nmembers = [\"generated\", \"nodes\", \"outside\", \"more/*\"]\n",
    );
    fs::create_dir(robot.path("more")).expect("writable");
    robot.write(
        "outside/Cargo.toml",
        "[package]\nname = \"outside\"\nversion = \"0.1.0\"\n",
    );
    robot.write("outside/src/lib.rs", "pub type Step = u64;\n");
    robot.edit(
        "nodes/Cargo.toml",
        "[dependencies]\n",
        "[dependencies]\noutside = { path = \"../outside\" }\n",
    );
    robot.edit(
        "nodes/src/counter.rs",
        "Parameter<u64,",
        "Parameter<outside::Step,",
    );
    let linked = "pub mod inner;\npub struct Linked;\n";
    robot.write("nodes/linked.rs", linked);
    robot.write("nodes/src/linked/inner.rs", linked);
    symlink("../linked.rs", robot.path("nodes/src/linked.rs")).expect("links are known");
    robot.edit(
        "nodes/src/lib.rs",
        "pub mod clock;",
        "pub mod clock;\npub mod linked;",
    );
    let text = robot.read("nodes/src/clock.rs");
    let text = text
        .replace("{MainOutput", "{AdditionalOutput, MainOutput")
        .replace(
            "pub struct CycleContext {}",
            "pub struct CycleContext {\n    mark: AdditionalOutput<crate::linked::inner::Linked, \"mark\">,\n    other: AdditionalOutput<crate::linked::Linked, \"other\">,\n}",
        );
    fs::remove_file(robot.path("nodes/src/clock.rs")).expect("it is there");
    robot.write("nodes/src/clock/mod.rs", &text);
    settle(&robot);
    robot
}

#[test]
fn every_change_is_noticed() {
    let before = answer(&varied());
    for (name, change) in NOTICED {
        let robot = varied();
        let (_, recalled) = run(&robot, "check", 0);
        assert!(recalled, "before {name}");
        change(&robot);
        let after = answer(&robot);
        assert_ne!(before, after, "{name}, and that changes nothing");
        assert_eq!(answer(&robot), after, "{name}, and one looks again");
    }
}

/// Numbers that are the same in every run.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: usize) -> usize {
        // Constants of Knuth's MMIX; the upper bits are the better ones.
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).expect("31 bits fit") % end
    }
}

/// Changes one line of one file, or one whole file, or takes all changes back.
fn change_at_random(robot: &Robot, originals: &[(&str, String)], numbers: &mut Numbers) {
    let (path, original) = &originals[numbers.below(originals.len())];
    let Ok(text) = fs::read_to_string(robot.path(path)) else {
        robot.write(path, original);
        return;
    };
    let mut lines: Vec<&str> = text.lines().collect();
    let line = numbers.below(lines.len().max(1));
    match numbers.below(8) {
        0 => fs::remove_file(robot.path(path)).expect("it was read"),
        1 | 2 => {
            for (path, original) in originals {
                robot.write(path, original);
            }
        }
        3 => robot.write(path, original),
        _ if lines.is_empty() => robot.write(path, original),
        4 => {
            lines.remove(line);
            robot.write(path, &lines.join("\n"));
        }
        5 => {
            lines.insert(line, lines[line]);
            robot.write(path, &lines.join("\n"));
        }
        6 => {
            let longer = format!("{} ", lines[line]);
            lines[line] = &longer;
            robot.write(path, &lines.join("\n"));
        }
        _ => {
            let other = lines[line].replace("u64", "f32").replace("count", "amount");
            lines[line] = &other;
            robot.write(path, &lines.join("\n"));
        }
    }
}

#[test]
fn whatever_changes_the_answer_is_that_of_a_run_without_earlier_ones() {
    let robot = settled();
    let paths = [
        "Cargo.toml",
        "generated/Cargo.toml",
        "generated/src/lib.rs",
        "hulk.toml",
        "nodes/Cargo.toml",
        "nodes/src/clock.rs",
        "nodes/src/counter.rs",
        "nodes/src/lib.rs",
        "parameters/default.toml",
    ];
    let originals = paths.map(|path| (path, robot.read(path)));
    let mut numbers = Numbers(4);
    let mut answers = std::collections::BTreeSet::new();
    for _ in 0..40 {
        change_at_random(&robot, &originals, &mut numbers);
        answers.insert(answer(&robot));
    }
    assert!(answers.len() > 8, "only {} answers differ", answers.len());
}

/// What may happen to the file of an answer, by name.
type Spoil = (&'static str, fn(&Path));

#[test]
fn a_spoilt_answer_is_none() {
    let spoil: &[Spoil] = &[
        ("cut off", |path| {
            let text = fs::read(path).expect("it is there");
            fs::write(path, &text[..text.len() / 2]).expect("writable");
        }),
        ("empty", |path| fs::write(path, "").expect("writable")),
        ("changed", |path| {
            let text = fs::read_to_string(path).expect("it is text");
            assert_eq!(text.matches("robot tiny").count(), 1, "{text}");
            fs::write(path, text.replace("robot tiny", "robot huge")).expect("writable");
        }),
        ("of another version", |path| {
            let text = fs::read_to_string(path).expect("it is text");
            fs::write(path, text.replacen("answer 1", "answer 2", 1)).expect("writable");
        }),
        ("no text", |path| {
            fs::write(path, [0xff; 99]).expect("writable")
        }),
        ("removed", |path| {
            fs::remove_file(path).expect("it is there")
        }),
        ("a folder", |path| {
            fs::remove_file(path).expect("it is there");
            fs::create_dir(path).expect("writable");
        }),
        ("a pipe without writer", |path| {
            fs::remove_file(path).expect("it is there");
            let made = Command::new("mkfifo").arg(path).status();
            assert!(made.expect("every Unix has it").success());
        }),
    ];
    for (name, spoil) in spoil {
        let robot = Robot::tiny();
        let fresh = robot.run("check --no-cache").expect(0).stdout;
        robot.run("check").expect(0);
        let kept = kept(&robot);
        assert_eq!(kept.len(), 1, "{name}: {kept:?}");
        spoil(&kept[0].0);
        for _ in 0..2 {
            let ended = robot.run("check").expect(0);
            assert_eq!(ended.stdout, fresh, "{name}");
            assert_eq!(ended.stderr, "", "{name}");
        }
    }
}

#[test]
fn without_a_usable_folder_everything_works_and_nothing_is_kept() {
    let robot = Robot::tiny();
    let fresh = robot.run("check --no-cache").expect(0).stdout;
    assert!(!robot.cache().join("hulkgen").exists());
    let inside = robot.path("cache");
    let file = robot.path("hulk.toml");
    for folder in ["", "relative", "/proc/none", text(&inside), text(&file)] {
        let mut command = robot.command("check");
        command.env("XDG_CACHE_HOME", folder).env_remove("HOME");
        let ended = Ended::of(&mut command).expect(0);
        assert_eq!(ended.stdout, fresh, "{folder}");
        assert_eq!(ended.stderr, "", "{folder}");
    }
    assert!(!robot.path("relative").exists() && !inside.exists());
    // Without the variable it is below the home folder.
    let mut command = robot.command("check");
    command
        .env_remove("XDG_CACHE_HOME")
        .env("HOME", robot.cache());
    Ended::of(&mut command).expect(0);
    assert!(robot.cache().join(".cache/hulkgen").is_dir());
    assert!(kept(&robot).is_empty());
}

fn text(path: &Path) -> &str {
    path.to_str().expect("temporary folders have plain names")
}

#[test]
fn the_folder_may_go_at_any_time() {
    let robot = settled();
    fs::remove_dir_all(robot.cache()).expect("it is there");
    let (_, recalled) = run(&robot, "generate", 0);
    assert!(!recalled);
    let (_, recalled) = run(&robot, "generate", 0);
    assert!(recalled);
}

#[test]
fn several_at_once_say_the_same() {
    let robot = Robot::tiny();
    robot.run("generate --no-cache").expect(0);
    let fresh = robot.run("check --no-cache").expect(0).stdout;
    for _ in 0..3 {
        let children: Vec<_> = (0..6)
            .map(|_| {
                let mut command = robot.command("check");
                command.stdout(Stdio::piped()).stderr(Stdio::piped());
                command.spawn().expect("hulkgen was built")
            })
            .collect();
        for child in children {
            let output = child.wait_with_output().expect("it ends");
            assert!(output.status.success() && output.stderr.is_empty());
            assert_eq!(String::from_utf8_lossy(&output.stdout), fresh);
        }
    }
    let (_, recalled) = run(&robot, "check", 0);
    assert!(recalled);
    assert_eq!(kept(&robot).len(), 1, "nothing is left half-written");
}

#[test]
fn another_hulkgen_has_answers_of_its_own() {
    let robot = settled();
    let own = kept(&robot).len();
    let other = robot.cache().join("other");
    // Not by this process: what it has open for writing, another test's new process has open too, and nobody may start it.
    let copied = Command::new("cp")
        .arg(env!("CARGO_BIN_EXE_hulkgen"))
        .arg(&other)
        .status();
    assert!(copied.is_ok_and(|status| status.success()));
    let check = || {
        let mut command = Command::new(&other);
        command.arg("check").current_dir(robot.folder());
        command.env("XDG_CACHE_HOME", robot.cache());
        Ended::of(&mut command).expect(0).stdout
    };
    let answer = check();
    assert_eq!(kept(&robot).len(), own + 1);
    let before = kept(&robot);
    assert_eq!(check(), answer);
    assert_eq!(kept(&robot), before);
}

#[test]
fn old_answers_make_room() {
    let robot = Robot::tiny();
    let folder = robot.cache().join("hulkgen");
    fs::create_dir_all(&folder).expect("writable");
    for number in 0..100 {
        fs::write(folder.join(format!("answer-{number}")), "old").expect("writable");
    }
    fs::write(folder.join("not-ours"), "").expect("writable");
    robot.run("check").expect(0);
    let kept = kept(&robot);
    assert_eq!(kept.len(), 64 + 1);
    let is_new = |path: &Path| fs::read_to_string(path).is_ok_and(|text| text.len() > 9);
    assert!(
        kept.iter().any(|(path, ..)| is_new(path)),
        "the newest one stays"
    );
    assert!(folder.join("not-ours").exists());
}
