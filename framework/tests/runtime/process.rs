//! Whole runs in processes of their own: what happens to a terminal happens to all of a process.

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, PipeReader, PipeWriter, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, mpsc};
use std::thread;
use std::time::{Duration, Instant};

use framework::launch;
use framework::testing::TARGET;
use framework::{OnFailure, Start, Stopped};
use hulkgen_recording::Recording;
use serde_json::Value;
use signal_hook::consts::{SIGHUP, SIGTERM};
use signal_hook::flag;
use signal_hook::low_level::raise;

use crate::body::{Parameters, Plan, Setting, robot};
use crate::scenario::written;
use crate::scripted::{Act, Script, ScriptedHardware};

/// Tells a process of this test which of the runs below it is.
const RUN: &str = "FRAMEWORK_TEST_RUN";

/// What a run that hangs leaves in its folder.
const RECORDING: &str = "run.mcap";

/// What the hardware leaves there when it is asked for the safe state.
pub(crate) const MARK: &str = "safe_state";

/// A reader of the report who has left.
struct Closed;

impl Write for Closed {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(io::ErrorKind::BrokenPipe.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Runs the robot of the tests as a generated binary would, and ends the process with its status.
fn launch(arguments: &[&str], setting: &Setting) -> ! {
    let directory = tempfile::tempdir().expect("a temporary directory");
    std::fs::write(directory.path().join("default.toml"), "gain = 1").expect("can be written");
    let mut all = vec![OsString::from("--parameters"), directory.path().into()];
    all.extend(arguments.iter().map(OsString::from));
    let create =
        |hardware: &Arc<ScriptedHardware>, _: Start<Parameters>| Ok(robot(hardware, setting));
    let status = launch::run(TARGET, all, &mut Closed, create, launch::nobody);
    drop(directory);
    std::process::exit(status.into())
}

/// Years of a scenario, until somebody presses Ctrl-C in the middle of its first second; the outcome goes to standard error.
fn interrupt_scenario() -> ! {
    let scenario = "ends = 1e9
[[event]]
at = 0.5
interrupt = true
[[assertion]]
what = 'what was so is told'
value = 'truth.events'
above = 49
before = 0.6
[[assertion]]
what = 'what was not yet so has failed'
value = 'truth.events'
above = 1000
before = 1e9
";
    let (directory, mut all) = written(scenario);
    all.extend(["--repeat", "3"].map(OsString::from));
    let create = |hardware: &Arc<ScriptedHardware>, _: Start<Parameters>| {
        Ok(robot(hardware, &Setting::default()))
    };
    let status = launch::run(TARGET, all, &mut io::stderr(), create, launch::nobody);
    drop(directory);
    std::process::exit(status.into())
}

/// Somebody ends the run while the robot is created, which is told so.
fn terminate_start(scenario: &[OsString]) -> ! {
    let directory = tempfile::tempdir().expect("a temporary directory");
    std::fs::write(directory.path().join("default.toml"), "gain = 1").expect("can be written");
    let plain = [OsString::from("--parameters"), directory.path().into()];
    let arguments = match scenario {
        [] => plain.to_vec(),
        _ => scenario.to_vec(),
    };
    let create = |_: &Arc<ScriptedHardware>, _: Start<Parameters>| {
        raise(SIGTERM)?;
        Err(Stopped.into())
    };
    let status = launch::run(TARGET, arguments, &mut io::stderr(), create, launch::nobody);
    std::process::exit(status.into())
}

#[test]
fn a_process_of_this_test_is_the_run_it_was_told_to_be() {
    let failing = |on_failure, acts: &[Act]| Setting {
        legs: Plan {
            work: Script::new(acts.iter().copied()),
            ..Plan::default()
        },
        on_failure,
        ..Setting::default()
    };
    match std::env::var(RUN).as_deref() {
        Ok("long enough for a line of status") => {
            let setting = failing(OnFailure::Skip, &[Act::Fail, Act::Panic]);
            launch(&["--for", "1200ms"], &setting)
        }
        Ok("recorded") => {
            let folder = std::env::temp_dir().join("runs/half");
            let folder = folder.to_str().expect("its name is text");
            let words = ["--for", "100ms", "--record", "on", "--run-folder", folder];
            launch(&words, &Setting::default())
        }
        Ok(run @ ("hung up" | "hung up and left alone")) => {
            thread::spawn(|| {
                thread::sleep(Duration::from_millis(100));
                raise(SIGHUP).expect("a valid signal");
            });
            if run != "hung up" {
                launch(&["--for", "1s"], &Setting::default());
            }
            // Whoever runs this test may have started it with `nohup`.
            flag::register(SIGHUP, Arc::default()).expect("a valid signal");
            launch(&["--for", "10s"], &Setting::default())
        }
        Ok("terminated while it starts") => terminate_start(&[]),
        Ok("terminated while its scenario starts") => {
            let scenario = "ends = 1.0
[[assertion]]
what = 'something happens'
value = 'truth.events'
above = 0
";
            let (_directory, arguments) = written(scenario);
            terminate_start(&arguments)
        }
        Ok("interrupted in a scenario") => interrupt_scenario(),
        Ok("failing") => {
            let setting = failing(OnFailure::Stop, &[Act::Fail]);
            launch(&["--format", "json"], &setting)
        }
        Ok("skipping") => launch(
            &["--for", "1s"],
            &failing(OnFailure::Skip, &[Act::Fail, Act::Panic]),
        ),
        Ok("catching by itself") => launch(
            &["--for", "1s"],
            &failing(
                OnFailure::Skip,
                &[&[Act::Catch; 10][..], &[Act::Fail]].concat(),
            ),
        ),
        Ok("catching by itself where that ends the robot") => launch(
            &["--for", "10s"],
            &failing(
                OnFailure::Stop,
                &[&[Act::Catch; 10][..], &[Act::Fail]].concat(),
            ),
        ),
        Ok("panicking twice at once") => launch(
            &["--for", "1s"],
            &failing(OnFailure::Skip, &[Act::PanicTwice]),
        ),
        Ok("restarting") => launch(
            &["--for", "1s"],
            &failing(OnFailure::Restart, &[Act::Panic]),
        ),
        Ok("stopping") => launch(&[], &failing(OnFailure::Stop, &[Act::Panic])),
        Ok("panicking in setup") => {
            let receive = Script::new([Act::Panic, Act::Fail]);
            let legs = Plan {
                receive,
                ..Plan::default()
            };
            let setting = Setting {
                legs,
                on_failure: OnFailure::Skip,
                ..Setting::default()
            };
            launch(&["--for", "1s"], &setting)
        }
        Ok("hanging") => {
            let eye = Plan {
                work: Script::new([Act::Work, Act::Work, Act::Take(u64::from(u32::MAX))]),
                ..Plan::default()
            };
            let setting = Setting {
                eye,
                ..Setting::default()
            };
            let recording = std::env::temp_dir().join(RECORDING);
            let recording = recording.to_str().expect("it was told as text");
            launch(&["--for", "5500ms", "--record", recording], &setting)
        }
        Ok("hanging before a terminal that stands still") => {
            let eye = Plan {
                work: Script::new([Act::Fail, Act::Fail]),
                ..Plan::default()
            };
            let acts = [Act::Fail, Act::Take(u64::from(u32::MAX))];
            let setting = Setting {
                eye,
                ..failing(OnFailure::Skip, &acts)
            };
            launch(&["--", MARK], &setting)
        }
        Ok(where_to @ ("hang in stop" | "hang in safe state" | "hang in drop")) => {
            let recording = std::env::temp_dir().join(RECORDING);
            let recording = recording.to_str().expect("it was told as text");
            let words = ["--for", "500ms", "--record", recording, "--", where_to];
            // The watchdog is the first who wants the safe state.
            let late = match where_to {
                "hang in safe state" => Act::Take(300),
                _ => Act::Work,
            };
            launch(&words, &failing(OnFailure::Skip, &[late]))
        }
        Ok("hang in drop of a robot that is not created") => {
            let directory = tempfile::tempdir().expect("a temporary directory");
            let file = directory.path().join("default.toml");
            std::fs::write(file, "gain = 1").expect("can be written");
            let words = ["--for", "1s", "--", "hang in drop"].map(OsString::from);
            let all = [OsString::from("--parameters"), directory.path().into()];
            let create = |_: &Arc<ScriptedHardware>, _: Start<Parameters>| Err("no legs".into());
            let all = all.into_iter().chain(words);
            let status = launch::run(TARGET, all, &mut Closed, create, launch::nobody);
            std::process::exit(status.into())
        }
        // Without a run it is one of many tests, and there is nothing to do.
        _ => {}
    }
}

/// How a run ends, by itself and in time.
fn end_of(run: &str, errors: Stdio) -> (ExitStatus, String) {
    end_within(Duration::from_secs(8), run, &std::env::temp_dir(), errors)
}

/// As [`end_of`], of a run that has a folder for what it leaves behind.
fn end_within(limit: Duration, run: &str, folder: &Path, errors: Stdio) -> (ExitStatus, String) {
    let this = Command::new(std::env::current_exe().expect("this test"));
    end_of_started(this, limit, run, folder, errors)
}

/// As [`end_within`], started by what `command` says.
fn end_of_started(
    mut command: Command,
    limit: Duration,
    run: &str,
    folder: &Path,
    errors: Stdio,
) -> (ExitStatus, String) {
    let mut child = command
        .args(["--exact", "--nocapture"])
        .env("TMPDIR", folder)
        .arg("process::a_process_of_this_test_is_the_run_it_was_told_to_be")
        .env(RUN, run)
        .stdout(Stdio::null())
        .stderr(errors)
        .spawn()
        .expect("this test can be started");
    let started = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("it is a child") {
            break status;
        }
        if started.elapsed() > limit {
            child.kill().expect("it is a child");
            child.wait().expect("it is a child");
            panic!("`{run}` does not end by itself");
        }
        thread::sleep(Duration::from_millis(10));
    };
    let mut text = String::new();
    if let Some(mut errors) = child.stderr.take() {
        errors.read_to_string(&mut text).expect("text");
    }
    (status, text)
}

#[test]
fn a_node_that_never_returns_is_told_and_keeps_neither_process_nor_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let limit = Duration::from_secs(60);
    let (status, errors) = end_within(limit, "hanging", folder.path(), Stdio::piped());
    assert_eq!(status.code(), Some(1), "{status}: {errors}");
    let told = |what| errors.lines().any(|line| line.ends_with(what));
    assert!(told("Eye has not finished a cycle for 5s"), "{errors}");
    assert!(errors.contains("Eye did not end within 10s"), "{errors}");
    assert!(!errors.contains("Legs did not"), "{errors}");
    let recording = Recording::open(&folder.path().join(RECORDING)).expect("it can be read");
    assert!(recording.is_complete(), "it has its end");
}

#[test]
fn hardware_that_hangs_is_told_and_keeps_neither_process_nor_recording() {
    let runs = [
        (
            "hang in stop",
            "The hardware did not end within 10s of the stop: its `enter_safe_state`, ",
        ),
        (
            "hang in safe state",
            "The hardware did not end within 10s of the stop: its `enter_safe_state`, ",
        ),
        (
            "hang in drop",
            "the run did not end within 10s because of the hardware or a node: its `Drop`",
        ),
    ];
    thread::scope(|scope| {
        for (run, expected) in runs {
            scope.spawn(move || {
                let folder = tempfile::tempdir().expect("a folder");
                let limit = Duration::from_secs(40);
                let (status, errors) = end_within(limit, run, folder.path(), Stdio::piped());
                assert_eq!(status.code(), Some(1), "{status}: {errors}");
                assert!(errors.contains(expected), "{errors}");
                let recording = Recording::open(&folder.path().join(RECORDING));
                let recording = recording.expect("it can be read");
                assert!(recording.is_complete(), "it has its end");
            });
        }
    });
}

#[test]
fn hardware_of_a_run_that_does_not_begin_has_no_longer_for_its_end() {
    let run = "hang in drop of a robot that is not created";
    let limit = Duration::from_secs(30);
    let (status, errors) = end_within(limit, run, &std::env::temp_dir(), Stdio::piped());
    assert_eq!(status.code(), Some(1), "{status}: {errors}");
    assert!(
        errors.contains("the run did not end within 10s"),
        "{errors}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_robot_whose_standard_error_cannot_be_written_runs_to_its_end() {
    let full = File::options()
        .write(true)
        .open("/dev/full")
        .expect("Linux has it");
    let (status, _) = end_of("long enough for a line of status", full.into());
    assert_eq!(status.code(), Some(0), "{status}");
}

/// A pipe that is full, and stays so as long as what is read from it is not.
fn full_pipe() -> (PipeReader, PipeWriter) {
    let (reader, writer) = io::pipe().expect("a pipe");
    let mut filling = writer.try_clone().expect("a second end");
    let (sender, written) = mpsc::channel();
    thread::spawn(move || while filling.write_all(b"\n").is_ok() && sender.send(()).is_ok() {});
    // Where the next byte finds no place, nothing is said any more.
    while written.recv_timeout(Duration::from_secs(1)).is_ok() {}
    (reader, writer)
}

#[test]
fn a_robot_whose_terminal_stands_still_has_its_safe_state_its_signals_and_its_end() {
    let folder = tempfile::tempdir().expect("a folder");
    let (reader, writer) = full_pipe();
    let mut child = Command::new(std::env::current_exe().expect("this test"))
        .args(["--exact", "--nocapture"])
        .env("TMPDIR", folder.path())
        .arg("process::a_process_of_this_test_is_the_run_it_was_told_to_be")
        .env(RUN, "hanging before a terminal that stands still")
        .stdout(Stdio::null())
        .stderr(writer)
        .spawn()
        .expect("this test can be started");
    let mut is_within = |limit: Duration, is_so: &mut dyn FnMut(&mut Child) -> bool| {
        let begun = Instant::now();
        while !is_so(&mut child) {
            if begun.elapsed() > limit {
                child.kill().expect("it is a child");
                return false;
            }
            thread::sleep(Duration::from_millis(10));
        }
        true
    };
    let mark = folder.path().join(MARK);
    let limit = Duration::from_secs(20);
    assert!(
        is_within(limit, &mut |_| mark.exists()),
        "no safe state for a cycle that hangs"
    );
    assert!(is_within(limit, &mut |child| {
        let id = rustix::process::Pid::from_child(child);
        rustix::process::kill_process(id, rustix::process::Signal::TERM).is_ok()
    }));
    let mut status = None;
    // Its threads have 10 s for their end.
    let limit = Duration::from_secs(30);
    let is_over = is_within(limit, &mut |child| {
        status = child.try_wait().expect("it is a child");
        status.is_some()
    });
    assert!(is_over, "the robot does not end");
    assert_eq!(status.and_then(|status| status.code()), Some(1));
    drop(reader);
}

/// Leaves the disk one page, for the parameters that a run of this test has there.
#[cfg(target_os = "linux")]
fn fill(path: &Path) {
    let mut file = File::create(path).expect("it needs no page");
    let page = [0; 4096];
    while file.write_all(&page).is_ok() {}
    let pages = file.metadata().expect("it is there").len() / 4096;
    file.set_len((pages - 1) * 4096).expect("it gets shorter");
}

#[cfg(target_os = "linux")]
#[test]
fn a_robot_whose_disk_is_full_before_it_starts_runs_without_a_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut mount = Command::new("mount");
    mount.args(["-t", "tmpfs", "-o", "size=1m", "none"]);
    let mounted = mount.arg(folder.path()).output();
    if !mounted.is_ok_and(|output| output.status.success()) {
        framework::testing::skip(
            "a_robot_whose_disk_is_full_before_it_starts_runs_without_a_recording",
            "run as root, or in a container that may mount a tmpfs",
        );
        return;
    }
    let run =
        |folder: &Path| end_within(Duration::from_secs(8), "recorded", folder, Stdio::piped());
    let (first, told) = run(folder.path());
    let half = folder.path().join("runs/half");
    let is_recorded = half.join("recording.mcap").is_file();
    std::fs::remove_dir_all(folder.path().join("runs")).expect("it is ours");
    fill(&folder.path().join("others"));
    let (second, untold) = run(folder.path());
    let is_left = folder.path().join("runs/half").exists();
    drop(Command::new("umount").arg(folder.path()).output());
    assert!(first.success() && is_recorded, "{told}");
    assert!(second.success(), "{untold}");
    assert!(
        untold.contains("No space left on device (os error 28); this run is not recorded: remove"),
        "{untold}"
    );
    assert!(!untold.contains("the robot goes on"), "{untold}");
    assert!(!is_left, "half a beginning of a recording is left");
}

#[test]
fn a_robot_whose_terminal_is_gone_stops_in_order() {
    let (status, errors) = end_of("hung up", Stdio::piped());
    assert_eq!(status.code(), Some(0), "{status}: {errors}");
    assert!(errors.contains("simulated ran for 0."), "{errors}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_robot_that_is_to_outlive_its_terminal_does() {
    let mut command = Command::new("sh");
    // As `nohup` does it.
    command.args(["-c", "trap '' HUP; exec \"$0\" \"$@\""]);
    command.arg(std::env::current_exe().expect("this test"));
    let limit = Duration::from_secs(8);
    let folder = std::env::temp_dir();
    let run = "hung up and left alone";
    let (status, errors) = end_of_started(command, limit, run, &folder, Stdio::piped());
    assert_eq!(status.code(), Some(0), "{status}: {errors}");
    assert!(errors.contains("simulated ran for 1."), "{errors}");
}

#[test]
fn a_robot_that_somebody_ends_while_it_starts_has_not_failed() {
    let (status, errors) = end_of("terminated while it starts", Stdio::piped());
    assert_eq!(status.code(), Some(0), "{status}: {errors}");
    assert!(!errors.contains("error"), "{errors}");
    // A scenario that was not played has not passed.
    let (status, errors) = end_of("terminated while its scenario starts", Stdio::piped());
    assert_eq!(status.code(), Some(1), "{status}: {errors}");
    assert!(errors.contains("is being stopped"), "{errors}");
}

#[test]
fn a_scenario_that_somebody_ends_tells_what_was_seen_until_then() {
    let (status, errors) = end_of("interrupted in a scenario", Stdio::piped());
    assert_eq!(status.code(), Some(130), "{status}: {errors}");
    let outcome = errors.lines().last().unwrap_or_default();
    let outcome: Value = serde_json::from_str(outcome).expect(&errors);
    assert_eq!(
        (&outcome["passed"], &outcome["needed"]),
        (&false.into(), &3.into())
    );
    let runs = outcome["runs"].as_array().expect("one was begun");
    assert_eq!(runs.len(), 1, "no further seed: {outcome:#}");
    let stopped = runs[0]["stopped"].as_str().unwrap_or_default();
    assert!(stopped.starts_with("somebody ended it after "), "{stopped}");
    assert!(runs[0]["recordings"].is_null(), "{outcome:#}");
    let [told, failed] = [0, 1].map(|index| &runs[0]["assertions"][index]);
    assert_eq!((&told["passed"], &told["seen"]), (&true.into(), &50.into()));
    assert_eq!(failed["passed"], false);
}

#[test]
fn why_the_robot_failed_is_told_even_if_nobody_reads_the_report() {
    let (status, errors) = end_of("failing", Stdio::piped());
    assert_eq!(status.code(), Some(1), "{status}: {errors}");
    assert!(
        errors.contains("error: node `test::worker` in cycle 1: Legs failed: as scripted"),
        "{errors}"
    );
}

/// What was told of failures, without the place of a panic.
fn told(run: &str) -> Vec<String> {
    let (_, errors) = end_of(run, Stdio::piped());
    let lines = errors.lines().filter(|line| line.contains("as scripted"));
    let without_place = |line: &str| match (line.find(" at "), line.find(": as scripted")) {
        (Some(place), Some(text)) => format!("{}{}", &line[..place], &line[text..]),
        _ => line.to_owned(),
    };
    lines.map(without_place).collect()
}

#[test]
fn a_failure_is_told_once_with_its_node_and_cycle() {
    for (run, expected) in [
        (
            "skipping",
            &[
                "Legs: node `test::worker` in cycle 1: as scripted (failure 1 of this node)",
                "Legs: node `test::worker` in cycle 2: panicked: as scripted (failure 2 of this node)",
            ][..],
        ),
        // What it catches itself is nobody else's, however often.
        (
            "catching by itself",
            &["Legs: node `test::worker` in cycle 11: as scripted (failure 1 of this node)"],
        ),
        (
            "catching by itself where that ends the robot",
            &["error: node `test::worker` in cycle 11: Legs failed: as scripted"],
        ),
        (
            "restarting",
            &["Legs restarts: node `test::worker` in cycle 1: panicked: as scripted"],
        ),
        (
            "stopping",
            &["error: node `test::worker` in cycle 1: Legs failed: panicked: as scripted"],
        ),
        (
            "panicking in setup",
            &[
                "Legs: node `test::receiver` in cycle 1: panicked: as scripted (failure 1 of this instance)",
                "Legs: node `test::receiver` in cycle 1: as scripted (failure 2 of this instance)",
            ],
        ),
    ] {
        assert_eq!(told(run), expected, "{run}");
    }
}

#[test]
fn two_panics_at_once_end_the_process_and_are_both_told() {
    let (status, errors) = end_of("panicking twice at once", Stdio::piped());
    assert_eq!(status.code(), None, "{status}: {errors}");
    for text in [": as scripted", ": in between, as scripted"] {
        let told = |line: &str| line.starts_with("Legs panicked at ") && line.ends_with(text);
        assert!(errors.lines().any(told), "{text}: {errors}");
    }
}
