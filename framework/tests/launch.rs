//! From the command line to the exit status.

#[path = "launch/recorded.rs"]
mod recorded;

use std::ffi::OsString;
use std::fs;
use std::sync::Arc;
use std::sync::Mutex;
use std::time::Duration;

use framework::LiveParameters;
use framework::launch::{self, Target};
use framework::testing;
use framework::{
    Clock, Hardware, HardwareContext, Parameter, Reflect, Result, Robot, Start, Stop, buffer_of,
};
use serde::{Deserialize, Serialize};
use tempfile::TempDir;

const TARGET: Target = Target {
    identities: &["body", "head"],
    manifest: "[robot]\nname = \"test\"\n[[target]]\nname = \"simulated\"\n[[target]]\nname = \"real\"\n",
    dataflow: "# Who reads what\n",
    ..testing::TARGET
};

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    gain: f32,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    port: u16,
}

struct TestHardware {
    context: HardwareContext,
    port: u16,
    log: Mutex<Vec<&'static str>>,
}

impl Hardware for TestHardware {
    fn new(context: HardwareContext) -> Result<Self> {
        let Table { port } = context.parameters()?;
        if context.options == ["fail"] {
            return Err("the robot is not there".into());
        }
        if context.options == ["record"] {
            fs::write(context.create_run_folder()?.join("file"), "")?;
        }
        Ok(Self {
            context,
            port,
            log: Mutex::default(),
        })
    }

    fn check_parameters(context: &HardwareContext) -> Result<()> {
        if context.options == ["odd"] {
            return Err("there is no option `odd`".into());
        }
        context.parameters::<Table>().map(drop)
    }

    fn identities(&self) -> Vec<(String, String)> {
        [("head", "3"), ("body", "17"), ("tail", "1")]
            .map(|(name, id)| (name.into(), id.into()))
            .into()
    }

    fn options() -> &'static str {
        "--port NUMBER  connects there\n"
    }

    fn stop(&self) {
        self.log.lock().expect("not poisoned").push("stop");
    }

    fn enter_safe_state(&self) {
        self.log.lock().expect("not poisoned").push("safe state");
    }
}

struct Ran {
    status: u8,
    output: String,
    gain: Option<f32>,
    hardware: Option<Arc<TestHardware>>,
}

fn workspace(text: &str) -> TempDir {
    let directory = tempfile::tempdir().expect("a temporary directory");
    fs::create_dir(directory.path().join("lab")).expect("can be created");
    fs::write(directory.path().join("default.toml"), text).expect("can be written");
    fs::write(directory.path().join("lab/default.toml"), "gain = 2.0").expect("can be written");
    fs::write(directory.path().join("body.17.toml"), "gain = 17.0").expect("can be written");
    directory
}

const TEXT: &str = "gain = 1.0\n[hardware.simulated]\nport = 9559\n";

fn run(directory: &TempDir, arguments: &[&str]) -> Ran {
    run_served(directory, arguments, launch::nobody)
}

fn run_served(directory: &TempDir, arguments: &[&str], serve: launch::Serve) -> Ran {
    let mut all = vec![OsString::from("--parameters"), directory.path().into()];
    all.extend(arguments.iter().map(OsString::from));
    let (mut gain, mut seen) = (None, None);
    let mut output = Vec::new();
    let create = |hardware: &Arc<TestHardware>, start: Start<Parameters>| {
        let parameter: Parameter<'_, f32> = &start.parameters.gain;
        gain = Some(*parameter);
        seen = Some(hardware.clone());
        let (parameters, [], []) = buffer_of(|| start.parameters.clone(), []);
        Ok(Robot {
            name: "test",
            clock: start.clock.clone(),
            instances: vec![],
            access: vec![],
            left_out: &[],
            remotes: Vec::new(),
            parameters: LiveParameters::new(parameters, start.parameters, start.clock),
        })
    };
    let status = launch::run(TARGET, all, &mut output, create, serve);
    Ran {
        status,
        output: String::from_utf8(output).expect("text"),
        gain,
        hardware: seen,
    }
}

#[test]
fn a_run_ends_when_its_time_is_over_and_reports_json() {
    let directory = workspace(TEXT);
    let run_folder = directory.path().join("run");
    let folder = run_folder.display().to_string();
    let ran = run(
        &directory,
        &[
            "--for",
            "50ms",
            "--format",
            "json",
            "--headless",
            "--run-folder",
            &folder,
            "--",
            "a",
        ],
    );
    assert_eq!(ran.status, 0);
    let report: serde_json::Value = serde_json::from_str(&ran.output).expect("one object");
    assert_eq!(
        (&report["version"], &report["target"]),
        (&1.into(), &"simulated".into())
    );
    assert!(report["duration_s"].as_f64().expect("a number") >= 0.05);
    let hardware = ran.hardware.expect("was created");
    assert_eq!(
        (hardware.port, &hardware.context.options[..]),
        (9559, &["a".to_owned()][..])
    );
    assert_eq!(
        *hardware.log.lock().expect("not poisoned"),
        ["safe state", "stop"]
    );
    assert!(!run_folder.exists(), "nobody asked for it");
}

#[test]
fn the_run_folder_is_there_once_the_hardware_asks_for_it() {
    let directory = workspace(TEXT);
    let run_folder = directory.path().join("deep/run");
    let folder = run_folder.display().to_string();
    let ran = run(
        &directory,
        &["--for", "1ms", "--run-folder", &folder, "--", "record"],
    );
    assert_eq!(ran.status, 0);
    assert!(run_folder.join("file").exists());
    assert!(ran.output.is_empty(), "text goes to standard error");
}

#[test]
fn identities_of_the_hardware_choose_layers_and_settings_win() {
    let directory = workspace(TEXT);
    assert_eq!(run(&directory, &["--for", "1ms"]).gain, Some(17.0));
    assert_eq!(
        run(&directory, &["--for", "1ms", "--location", "lab"]).gain,
        Some(17.0)
    );
    fs::remove_file(directory.path().join("body.17.toml")).expect("was written");
    assert_eq!(
        run(&directory, &["--for", "1ms", "--location", "lab"]).gain,
        Some(2.0)
    );
    assert_eq!(
        run(&directory, &["--for", "1ms", "--set", "gain=3"]).gain,
        Some(3.0)
    );
}

#[test]
fn an_empty_location_is_none_whatever_the_directory_chooses() {
    let directory = workspace(TEXT);
    fs::remove_file(directory.path().join("body.17.toml")).expect("was written");
    let choose = |text: &str| {
        fs::write(directory.path().join("parameters.toml"), text).expect("can be written");
    };
    choose("location = \"lab\"\n");
    let gain = |arguments: &[&str]| run(&directory, arguments).gain;
    assert_eq!(gain(&["--for", "1ms"]), Some(2.0));
    assert_eq!(gain(&["--for", "1ms", "--location", ""]), Some(1.0));
    let wrong = directory.path().join("lab/default.toml");
    fs::write(wrong, "gian = 2.0").expect("can be written");
    assert_eq!(check(&directory, ""), (0, vec![]));
    assert_eq!(check(&directory, "lab").0, 1);
}

fn check(directory: &TempDir, location: &str) -> (u8, Vec<serde_json::Value>) {
    let arguments = [
        "--check-parameters",
        "--format",
        "json",
        "--location",
        location,
    ];
    let ran = run(directory, &arguments);
    assert!(ran.hardware.is_none(), "nothing runs");
    let answer: serde_json::Value = serde_json::from_str(&ran.output).expect("one object");
    (
        ran.status,
        answer["mistakes"].as_array().expect("a list").clone(),
    )
}

#[test]
fn parameters_are_checked_for_every_robot_that_files_name() {
    let directory = workspace(TEXT);
    assert_eq!(check(&directory, ""), (0, vec![]));
    let write = |file: &str, text: &str| {
        fs::write(directory.path().join(file), text).expect("can be written");
    };
    write("head.3.toml", "gain = 3.0\n\ngian = 1\n");
    write("lab/body.18.toml", "gain = \"much\"\n");
    // body 17 and nobody, each with head 3 and without.
    let (status, mistakes) = check(&directory, "");
    assert_eq!((status, mistakes.len()), (1, 1), "{mistakes:#?}");
    let mistake = &mistakes[0];
    let file = directory.path().join("head.3.toml").display().to_string();
    assert_eq!(
        (&mistake["file"], &mistake["line"]),
        (&file.clone().into(), &3.into())
    );
    assert_eq!(
        (&mistake["key"], &mistake["fault"]),
        (&"gian".into(), &"unknown".into())
    );
    assert_eq!(mistake["message"], "nothing reads it; did you mean `gain`?");
    assert_eq!(mistake["identities"], serde_json::json!({ "head": "3" }));

    let (_, mistakes) = check(&directory, "lab");
    let faults: Vec<_> = mistakes.iter().map(|one| &one["fault"]).collect();
    assert_eq!(faults, ["unknown", "invalid"], "{mistakes:#?}");
    assert_eq!(
        mistakes[1]["identities"],
        serde_json::json!({ "body": "18" })
    );

    // Some robot's file has it, so it is not missing; without any file it is.
    let directory = workspace("[hardware.simulated]\nport = 9559\n");
    assert_eq!(check(&directory, ""), (0, vec![]));
    fs::remove_file(directory.path().join("body.17.toml")).expect("was written");
    let (status, mistakes) = check(&directory, "");
    assert_eq!(
        (status, &mistakes[0]["fault"]),
        (1, &"missing".into()),
        "{mistakes:#?}"
    );
    assert_eq!(check(&directory, "lab"), (0, vec![]));

    // A file that is no TOML, and a location that is not there.
    fs::write(directory.path().join("default.toml"), "gain = \n").expect("can be written");
    let (_, mistakes) = check(&directory, "");
    assert_eq!(
        (&mistakes[0]["line"], &mistakes[0]["fault"]),
        (&1.into(), &"invalid".into())
    );
    let (status, mistakes) = check(&directory, "moon");
    assert_eq!(
        (status, &mistakes[0]["file"]),
        (1, &serde_json::Value::Null)
    );
    let text = run(&directory, &["--check-parameters"]);
    assert_eq!(
        (text.status, text.output.as_str()),
        (1, ""),
        "text goes to standard error"
    );
}

#[test]
fn the_table_of_the_hardware_is_checked_without_the_hardware() {
    let mistake = |text: &str| {
        let directory = workspace(text);
        let (status, mistakes) = check(&directory, "");
        assert_eq!((status, mistakes.len()), (1, 1), "{mistakes:#?}");
        let file = directory.path().join("default.toml").display().to_string();
        assert_eq!(mistakes[0]["file"], file);
        let words = ["key", "fault", "line"].map(|key| mistakes[0][key].to_string());
        words.join(" ").replace('"', "")
    };
    let table = "gain = 1.0\n[hardware.simulated]\n";
    assert_eq!(
        mistake(&format!("{table}port = 1\nprot = 1\n")),
        "hardware.simulated.prot unknown 4"
    );
    assert_eq!(mistake(table), "hardware.simulated.port missing 2");
    assert_eq!(
        mistake("gain = 1.0\n[hardware]\nsimulated = 1\n"),
        "hardware.simulated invalid 3"
    );
    // As at the start, where the hardware says which identities there are, and its options count.
    let directory = workspace(TEXT);
    let file = directory.path().join("body.17.toml");
    fs::write(file, "[hardware.simulated]\nprot = 1\n").expect("can be written");
    assert_eq!(check(&directory, ""), (0, vec![]));
    let asked = ["--check-parameters", "--format", "json", "--", "odd"];
    let ran = run(&directory, &asked);
    let answer: serde_json::Value = serde_json::from_str(&ran.output).expect("one object");
    let mistake = &answer["mistakes"][0];
    assert_eq!(
        (ran.status, &mistake["key"], &mistake["message"]),
        (
            1,
            &"hardware.simulated".into(),
            &"hardware of `simulated`: there is no option `odd`".into()
        )
    );
}

#[test]
fn wrong_usage_is_2_help_is_0_and_a_failure_is_1() {
    let directory = workspace(TEXT);
    assert_eq!(run(&directory, &["--for", "ever"]).status, 2);
    let help = run(&directory, &["--help"]);
    assert_eq!(help.status, 0);
    assert!(help.output.contains("--set PATH=VALUE"), "{}", help.output);
    assert_eq!(run(&directory, &["--for", "1ms", "--", "fail"]).status, 1);
    assert_eq!(run(&workspace("gian = 1\n"), &["--for", "1ms"]).status, 1);
}

#[test]
fn an_unknown_key_of_the_hardware_is_named() {
    let context = HardwareContext {
        options: vec![],
        table: toml::from_str("prot = 1").expect("valid TOML"),
        run_folder: "run".into(),
        clock: Clock::wall(),
        stop: Stop::new(),
    };
    let message = context
        .parameters::<Table>()
        .expect_err("misspelt")
        .to_string();
    assert!(
        message.ends_with("`prot`: nothing reads it; did you mean `port`?"),
        "{message}"
    );
    // The launcher knows the file, too; here it is enough that the run does not start.
    let directory = workspace("gain = 1.0\n[hardware.simulated]\nprot = 1\n");
    let ran = run(&directory, &["--for", "1ms"]);
    assert_eq!((ran.status, ran.gain), (1, None));
}

#[test]
fn a_table_of_a_target_that_is_none_is_told_with_its_place() {
    let directory =
        workspace("gain = 1.0\n[hardware.simulated]\nport = 1\n[hardware.simulatd]\nport = 2\n");
    let ran = run(&directory, &["--for", "1ms"]);
    assert_eq!((ran.status, ran.gain), (1, None));
    let (_, mistakes) = check(&directory, "lab");
    let mistake = &mistakes[0];
    assert_eq!(
        (&mistake["line"], &mistake["key"], &mistake["message"]),
        (
            &4.into(),
            &"hardware.simulatd".into(),
            &"the robot has no target `simulatd`; did you mean `simulated`?".into()
        )
    );
    let directory =
        workspace("gain = 1.0\n[hardware.simulated]\nport = 1\n[hardware.real]\nport = 2\n");
    assert_eq!(run(&directory, &["--for", "1ms"]).status, 0);
    // Layers of the identities are known once the hardware is there.
    let of_body = directory.path().join("body.17.toml");
    fs::write(of_body, "gain = 2.0\n[hardware.reel]\nport = 2\n").expect("can be written");
    let ran = run(&directory, &["--for", "1ms"]);
    assert_eq!((ran.status, ran.gain), (1, None));
}

#[test]
fn where_nobody_can_come_no_file_of_a_run_is_left() {
    let directory = workspace(TEXT);
    let folder = directory.path().join("run");
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a free port");
    let taken = taken.local_addr().expect("it has one").to_string();
    for address in ["foo", &taken] {
        let words = [
            "--for=1ms",
            "--record=on",
            "--listen",
            address,
            "--run-folder",
        ];
        let folder = folder.display().to_string();
        let words: Vec<_> = words
            .into_iter()
            .chain([folder.as_str(), "--", "record"])
            .collect();
        assert_eq!(
            run_served(&directory, &words, listens).status,
            1,
            "{address}"
        );
    }
    assert!(!folder.exists());
}

/// A server that is only there.
struct Door(std::net::TcpListener);

impl launch::Served for Door {
    fn address(&self) -> std::net::SocketAddr {
        self.0.local_addr().expect("it has one")
    }
}

fn listens(
    _: framework::link::Link,
    listening: launch::Listening,
) -> Result<Option<Box<dyn launch::Served>>> {
    let open = listening.open()?.expect("an address was said");
    Ok(Some(Box::new(Door(open))))
}

/// As [`listens`], where nobody else could listen since the run began.
fn listens_alone(
    link: framework::link::Link,
    listening: launch::Listening,
) -> Result<Option<Box<dyn launch::Served>>> {
    let address = listening.address.as_deref().expect("an address was said");
    let other = std::net::TcpListener::bind(address);
    assert!(other.is_err(), "somebody else took the port");
    listens(link, listening)
}

#[test]
fn nobody_takes_the_port_while_a_run_begins() {
    let directory = workspace(TEXT);
    let free = std::net::TcpListener::bind("127.0.0.1:0").and_then(|free| free.local_addr());
    let free = free.expect("a free port").to_string();
    let words = ["--for=1ms", "--record=off", "--listen", &free];
    assert_eq!(run_served(&directory, &words, listens_alone).status, 0);
    // It is free again when the robot has ended.
    std::net::TcpListener::bind(&free).expect("nobody has it");
}

#[test]
fn a_clock_waits_and_a_stop_ends_the_wait() {
    let (clock, stop) = (Clock::wall(), Stop::new());
    let soon = clock.now() + Duration::from_millis(5);
    clock.wait_until(soon, &stop).expect("nobody stops it");
    assert!(clock.now() >= soon);
    let ended = std::thread::scope(|scope| {
        scope.spawn(|| stop.request());
        clock.wait_until(clock.now() + Duration::from_secs(3600), &stop)
    });
    assert!(ended.expect_err("it was stopped").is_stopped());
    let stepped = Clock::stepped();
    assert!(stepped.wait_until(stepped.now(), &Stop::new()).is_ok());
    assert!(
        stepped
            .wait_until(stepped.now().next(), &Stop::new())
            .is_err(),
        "it would have to wait"
    );
}

#[test]
fn a_hardware_tells_what_its_options_do() {
    let ran = run(&workspace(TEXT), &["--", "--help"]);
    assert_eq!(
        (ran.status, ran.output.as_str()),
        (0, "--port NUMBER  connects there\n")
    );
    assert!(ran.hardware.is_none(), "nothing is started");
}
