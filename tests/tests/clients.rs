//! The running NAO and everything that talks to it: the page in a browser, `hulkgen topic|param|call|log|top`, Python.

use std::io::{BufRead as _, BufReader};
use std::net::{SocketAddr, TcpListener};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde_json::Value;
use support::{root, skip, target_folder};

/// A busy machine may take so long for anything.
const PATIENCE: Duration = Duration::from_secs(60);

/// A page that is shown needs them; without `npm ci` playwright is not there either.
const BROWSERS: [&str; 3] = [
    "/usr/bin/chromium",
    "/usr/bin/chromium-browser",
    "/usr/bin/google-chrome",
];

/// One simulated NAO at a time: several on a small machine are slower than their clients are patient.
static TURN: Mutex<()> = Mutex::new(());

/// The robot's program beside this test. Where only this test is built, cargo is asked for it.
fn program() -> std::path::PathBuf {
    let program = target_folder().join("simulated");
    if !program.is_file() {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let target = target_folder();
        let built = Command::new(cargo)
            .args(["build", "--offline", "--quiet", "--package", "nao_runtime"])
            .arg("--target-dir")
            .arg(target.parent().expect("target/<profile>"))
            .current_dir(root())
            .status()
            .expect("cargo runs these tests, so it is there");
        assert!(built.success() && program.is_file(), "no {program:?}");
    }
    program
}

/// A running robot; it ends with the test.
struct Robot {
    child: Child,
    address: SocketAddr,
    folder: tempfile::TempDir,
    _turn: MutexGuard<'static, ()>,
}

impl Robot {
    fn start(options: &[&str]) -> Self {
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        let folder = tempfile::tempdir().expect("a temporary folder");
        let free = TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr());
        let address = free.expect("this machine has a free port");
        let mut child = Command::new(program())
            .args(["--headless", "--listen", &address.to_string()])
            .arg("--run-folder")
            .arg(folder.path())
            .args(options)
            .args(["--", "--free-ports"])
            .current_dir(root())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the robot can be started");
        let said = child.stderr.take().expect("it is a pipe");
        // Read to the end, so that the robot is never blocked by a full pipe.
        std::thread::spawn(move || BufReader::new(said).lines().count());
        let mut robot = Self {
            child,
            address,
            folder,
            _turn: turn,
        };
        let begin = Instant::now();
        while robot.hulkgen("topic list").status.code() != Some(0) {
            let ended = robot.child.try_wait().expect("it is our child");
            assert_eq!(ended, None, "the robot has ended");
            assert!(begin.elapsed() < PATIENCE, "the robot does not answer");
            std::thread::sleep(Duration::from_millis(200));
        }
        robot
    }

    /// What `hulkgen` with these words says about this robot.
    fn hulkgen(&self, words: &str) -> Output {
        let words: Vec<&str> = words.split(' ').collect();
        Command::new(target_folder().join("hulkgen"))
            .args(words)
            .args(["--host", &self.address.to_string()])
            // Needs no robot of its own: there is no hulk.toml.
            .current_dir(self.folder.path())
            .env_remove("HULKGEN_TOKEN")
            .output()
            .expect("hulkgen can be started")
    }

    /// Its answer, which must be a good one.
    fn answer(&self, words: &str) -> String {
        let output = self.hulkgen(words);
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{words}: {stderr}");
        String::from_utf8(output.stdout).expect("it prints UTF-8")
    }

    /// Its answer as JSON lines.
    fn lines(&self, words: &str) -> Vec<Value> {
        let answer = self.answer(&format!("{words} --format json"));
        let parse = |line| serde_json::from_str(line).expect("one object a line");
        answer.lines().map(parse).collect()
    }
}

impl Drop for Robot {
    fn drop(&mut self) {
        // Killed: what it would still do is the business of other tests.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn topics_are_listed_and_described_and_come_again_and_again() {
    let robot = Robot::start(&[]);
    let list = robot.answer("topic list");
    let outputs = [
        "VisionTop.main_outputs.image ",
        "Control.main_outputs.sensor_data ",
    ];
    for output in outputs {
        assert!(list.contains(output), "{output} is missing:\n{list}");
    }
    assert!(!list.contains("parameters"), "{list}");
    let info = robot.answer("topic info Control.main_outputs.sensor_data.positions.head_pitch");
    assert!(
        info.contains("main output") && info.contains("f32"),
        "{info}"
    );
    let values = robot.lines("topic echo Control.main_outputs.sensor_data.positions --count 5");
    let cycles: Vec<u64> = values
        .iter()
        .filter_map(|value| value["cycle"].as_u64())
        .collect();
    assert!(
        cycles.len() == 5 && cycles.is_sorted_by(|one, next| one < next),
        "{cycles:?}"
    );
    assert!(
        values
            .iter()
            .all(|value| value["value"]["head_pitch"].is_f64()),
        "{values:?}"
    );
    let rates = robot.lines("topic hz Control.main_outputs.sensor_data --count 2");
    assert!(
        rates.iter().any(|rate| rate["updates"].as_u64() > Some(0)),
        "{rates:?}"
    );
}

#[test]
fn images_become_files() {
    let robot = Robot::start(&[]);
    let folder = robot.folder.path().join("images/top");
    let echo = format!(
        "topic echo VisionTop.main_outputs.image --rate 5 --count 2 --images {}",
        folder.display()
    );
    for line in robot.lines(&echo) {
        let file = line["file"].as_str().expect("a path");
        let cycle = line["cycle"].as_u64().expect("a number");
        assert!(file.ends_with(&format!("{cycle:08}.jpg")), "{file}");
        let bytes = std::fs::read(file).expect("it was written");
        // From the first marker of a JPEG file to the last.
        assert!(bytes.len() > 1000 && bytes.starts_with(&[0xff, 0xd8, 0xff]));
        assert!(bytes.ends_with(&[0xff, 0xd9]), "{file} is cut off");
    }
    let files = std::fs::read_dir(&folder).expect("it was made");
    assert_eq!(files.count(), 2);
    let refused = robot.hulkgen("topic echo Control.main_outputs.sensor_data --images nothing");
    assert_eq!(refused.status.code(), Some(1));
    assert!(!robot.folder.path().join("nothing").exists());
}

#[test]
fn what_is_not_there_is_told_with_what_is() {
    let robot = Robot::start(&[]);
    let output = robot.hulkgen("topic echo Control.main_outputs.sensor_data.position");
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr.contains("`positions`"), "{stderr}");
}

#[test]
fn nobody_who_answers_is_told_with_what_to_do() {
    let free = TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr());
    let address = free.expect("this machine has a free port").to_string();
    for command in [
        vec!["topic", "list"],
        vec!["param", "get"],
        vec!["call"],
        vec!["log"],
        vec!["top"],
    ] {
        let output = Command::new(target_folder().join("hulkgen"))
            .args(&command)
            .args(["--host", &address])
            .output()
            .expect("hulkgen can be started");
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{stderr}");
        let told = format!("no robot answers at {address}");
        assert!(
            stderr.contains(&told) && stderr.contains("hulkgen run"),
            "{stderr}"
        );
    }
}

#[test]
fn parameters_are_changed_together_or_not_at_all() {
    let robot = Robot::start(&[]);
    let now =
        robot.answer("param set ball_filter.gate=2.5 parameters.ball_filter.rolling_time=1.5");
    let lines = "ball_filter.gate = 2.5\nball_filter.rolling_time = 1.5\nversion ";
    assert!(now.starts_with(lines), "{now}");
    let gate = |robot: &Robot| robot.lines("param get ball_filter.gate")[0]["value"].clone();
    assert_eq!(gate(&robot), 2.5);
    let half = robot.hulkgen("param set ball_filter.gate=4 ball_filter.nothing=1");
    assert_eq!(half.status.code(), Some(1));
    assert_eq!(gate(&robot), 2.5, "the good half of a bad change was taken");
    let list = robot.lines("param list ball_filter");
    let of = |path: &str| {
        list.iter()
            .find(|one| one["path"] == path)
            .expect("it is listed")
    };
    assert_eq!(of("ball_filter.gate")["unstored"], true);
    assert_eq!(of("ball_filter.gate")["provenance"]["from"], "live");
    assert_eq!(of("ball_filter.resting_speed")["unstored"], false);
    assert_eq!(
        of("ball_filter.resting_speed")["provenance"]["from"],
        "file"
    );
    let unstored = &robot.lines("param store")[0];
    assert_eq!(
        unstored["changes"].as_array().map(Vec::len),
        Some(2),
        "{unstored}"
    );
}

#[test]
fn a_token_is_asked_for_before_anything_is_changed() {
    let robot = Robot::start(&["--token", "secret"]);
    let refused = robot.hulkgen("param set ball_filter.gate=2.5");
    let stderr = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(1));
    assert!(stderr.contains("--token"), "{stderr}");
    assert_eq!(
        robot
            .hulkgen("param set ball_filter.gate=2.5 --token wrong")
            .status
            .code(),
        Some(1)
    );
    robot.answer("param set ball_filter.gate=2.5 --token secret");
    assert_eq!(robot.lines("param get ball_filter.gate")[0]["value"], 2.5);
}

/// Until `top` tells that frames of this instance are recorded.
fn await_recorded(robot: &Robot, instance: &str) {
    let begin = Instant::now();
    loop {
        let timings = robot.lines("top --count 1").remove(0);
        let all = timings["recording"].as_array().into_iter().flatten();
        let mut own = all.filter(|one| one["of"] == instance);
        if own.any(|one| one["recorded"].as_u64() > Some(0)) {
            break;
        }
        assert!(begin.elapsed() < PATIENCE, "{timings}");
    }
}

#[test]
fn procedures_timings_and_logs_are_there() {
    let robot = Robot::start(&[]);
    assert!(robot.answer("call").contains("framework.procedures.rearm"));
    let timings = &robot.lines("top --count 1")[0];
    let instances = timings["instances"]
        .as_array()
        .expect("there are instances");
    let control = instances.iter().find(|one| one["name"] == "Control");
    let nodes = control.and_then(|control| control["nodes"].as_array());
    assert!(nodes.is_some_and(|nodes| nodes.len() > 20), "{timings}");
    await_recorded(&robot, "Control");
    let table = robot.answer("top --count 1");
    assert!(
        table.contains("overruns") && table.contains("vision::image_receiver"),
        "{table}"
    );
    let mut below = table
        .lines()
        .skip_while(|line| !line.starts_with("recording "));
    assert!(below.any(|line| line.starts_with("Control ")), "{table}");
    let trace = &robot.lines("top --trace 0.5")[0];
    let events = trace["traceEvents"].as_array().expect("a list");
    for name in ["Control", "VisionTop", "vision::image_receiver"] {
        let mut spans = events.iter().filter(|event| event["ph"] == "X");
        assert!(spans.any(|span| span["name"] == name), "{name}");
    }
}

#[test]
fn a_simulated_world_tells_the_truth_and_is_disturbed() {
    let robot = Robot::start(&["--set", "hardware.simulated.ball.position=[3.0, 0.0]"]);
    robot.answer(r#"call framework.procedures.disturb {"ball":[1.5,-0.5]}"#);
    let truth = &robot.lines("call framework.procedures.truth")[0];
    let truth = truth.get("response").unwrap_or(truth);
    let near = |value: &Value, expected: f64| {
        value
            .as_f64()
            .is_some_and(|value| (value - expected).abs() < 0.2)
    };
    assert!(
        near(&truth["ball"]["x"], 1.5) && near(&truth["ball"]["y"], -0.5),
        "{truth}"
    );
    for (argument, told) in [
        (r#" {"bal":[1.0,0.0]}"#, "unknown field `bal`"),
        (r#" {"push":3}"#, "an array of length 3 in `push`\n"),
        ("", "help: if it wants an argument"),
    ] {
        let refused = robot.hulkgen(&format!("call framework.procedures.disturb{argument}"));
        let stderr = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(1));
        assert!(stderr.contains(told), "{stderr}");
    }
}

/// A robot without eyes, and the ball at that place ahead of it.
fn scenario(ball: f64) -> String {
    format!(
        "ends = 3600.0\n[world]\ncameras = false\nmicrophones = false\nball.position = [{ball}, 0.0]\n\
         [[assertion]]\nwhat = \"it has a height\"\nvalue = \"truth.height\"\nabove = 0.0\n"
    )
}

#[test]
fn who_watches_a_scenario_chooses_another_one() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| {
        let file = folder.path().join(name);
        std::fs::write(&file, text).expect("it is written");
        file.to_str().expect("it is text").to_owned()
    };
    let near = write("near.toml", &scenario(1.0));
    write("far.toml", &scenario(0.5));
    write("wrong.toml", "ends = 0\n");
    // What the hardware alone knows is not looked at before.
    write(
        "strange.toml",
        &format!("{}[random]\nnothing = 1.0\n", scenario(0.0)),
    );
    let robot = Robot::start(&["--scenario", &near, "--record", "on"]);
    let call = |argument: &str| format!("call framework.procedures.scenario {argument}");
    let programme = |argument: &str| {
        let answer = robot.lines(&call(argument)).remove(0);
        answer.get("response").unwrap_or(&answer).clone()
    };
    let ball = || {
        let output = robot.hulkgen("call framework.procedures.truth --format json");
        let truth: Value = serde_json::from_slice(&output.stdout).ok()?;
        let truth = truth.get("response").unwrap_or(&truth);
        truth["ball"]["x"].as_f64()
    };
    let choices = serde_json::json!(["far", "near", "strange"]);
    let is = |playing: &str| serde_json::json!({ "playing": playing, "choices": choices });
    assert_eq!(programme("null"), is("near"));
    await_recorded(&robot, "Control");
    for (argument, told) in [
        (r#""nowhere""#, "there are: far, near, strange"),
        (r#""wrong""#, "wrong.toml"),
    ] {
        let refused = robot.hulkgen(&call(argument));
        let stderr = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(1));
        assert!(stderr.contains(told), "{stderr}");
    }
    assert_eq!(ball(), Some(1.0), "what is refused changes nothing");
    // The ball is somewhere else, until the same begins anew.
    robot.answer(r#"call framework.procedures.disturb {"ball":[1.5,0.0]}"#);
    for (name, place) in [("near", 1.0), ("far", 0.5)] {
        assert_eq!(programme(&format!("\"{name}\"")), is(name));
        let begin = Instant::now();
        while ball().is_none_or(|ball| (ball - place).abs() > 0.01) {
            assert!(begin.elapsed() < PATIENCE, "{name} is not played");
            std::thread::sleep(Duration::from_millis(200));
        }
    }
    robot.answer(r#"call framework.procedures.disturb {"ball":[1.5,0.0]}"#);
    assert_eq!(programme("\"strange\""), is("strange"));
    let begin = Instant::now();
    while ball() != Some(0.5) {
        assert!(begin.elapsed() < PATIENCE, "what was played before is not");
        std::thread::sleep(Duration::from_millis(200));
    }
    assert_eq!(programme("null"), is("far"));
    for recording in ["near-seed-1.mcap", "near-seed-1-2.mcap", "far-seed-1.mcap"] {
        let file = robot.folder.path().join(recording);
        assert!(file.is_file(), "{recording} is missing");
    }
}

#[test]
fn python_reads_and_writes_with_nothing_but_websockets() {
    let name = "python_reads_and_writes_with_nothing_but_websockets";
    let has_websockets = Command::new("python3")
        .args(["-c", "import websockets.sync.client"])
        .stderr(Stdio::null())
        .status();
    if !has_websockets.is_ok_and(|status| status.success()) {
        skip(name, "python3 -m pip install websockets");
        return;
    }
    let robot = Robot::start(&[]);
    let client = root().join("docs/clients/hulk.py");
    let python = |words: &str| {
        let output = Command::new("python3")
            .arg(&client)
            .args(["--host", &robot.address.to_string()])
            .args(words.split(' '))
            .output()
            .expect("python3 was there a moment ago");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{words}: {stderr}");
        String::from_utf8(output.stdout).expect("it prints UTF-8")
    };
    assert!(python("list").contains("Control.main_outputs.sensor_data\tSensorData"));
    python("set ball_filter.gate=2.5");
    assert_eq!(python("get ball_filter.gate").trim(), "2.5");
    let image = python("echo VisionTop.main_outputs.image --count 1 --binary");
    let image: Value = serde_json::from_str(&image).expect("JSON");
    let (width, height) = (&image["value"]["width"], &image["value"]["height"]);
    let bytes = image["value"]["data"].as_array().map_or(0, Vec::len) as u64;
    assert_eq!(
        Some(bytes),
        width
            .as_u64()
            .zip(height.as_u64())
            .map(|(width, height)| width * height * 2)
    );
    assert!(bytes > 0);
    let path = "Control.main_outputs.sensor_data.positions.head_pitch";
    assert!(
        python(&format!("plot {path} --seconds 0.5 --csv"))
            .lines()
            .count()
            > 2
    );
}

#[test]
fn the_page_works_in_a_browser() {
    let name = "the_page_works_in_a_browser";
    let page = root().join("web/page");
    let has_browser = BROWSERS.iter().any(|browser| Path::new(browser).is_file());
    if !has_browser || !page.join("node_modules/playwright-core").is_dir() {
        skip(name, "chromium, node 20, and `npm ci` in web/page");
        return;
    }
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let output = Command::new("node")
        .arg(page.join("test/browser.mjs"))
        .arg(program())
        // A robot that plays may just be falling when it is to be driven.
        .args(["--", "--free-ports", "--game", "Set"])
        .current_dir(root())
        .output()
        .expect("npm came with node");
    let said = String::from_utf8_lossy(&output.stdout);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}{stderr}");
}
