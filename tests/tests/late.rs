//! Late errors: what only rustc finds stands at the field or the line of the manifest that it comes from.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;

use serde_json::Value;
use support::{compile_unoptimised, target_folder};

/// A blank robot, and the built hulkgen in it.
struct Robot {
    folder: tempfile::TempDir,
}

impl Robot {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let robot = Self { folder };
        let mut new = Command::new(target_folder().join("hulkgen"));
        new.args(["new", "robot"]).current_dir(robot.folder.path());
        assert!(new.output().expect("hulkgen was built").status.success());
        compile_unoptimised(&robot.folder.path().join("robot"));
        robot
    }

    fn write(&self, path: &str, text: &str) {
        let path = self.folder.path().join("robot").join(path);
        let folder = path.parent().expect("it lies in a folder");
        fs::create_dir_all(folder).expect("the folder is ours");
        fs::write(path, text).expect("the folder is ours");
    }

    fn edit(&self, path: &str, from: &str, to: &str) {
        let path = self.folder.path().join("robot").join(path);
        let text = fs::read_to_string(&path).expect("every blank robot has it");
        assert!(text.contains(from), "`{from}` in {}", path.display());
        fs::write(path, text.replace(from, to)).expect("the folder is ours");
    }

    /// `check --cargo` with packages compiled where those of the tests are.
    fn check(&self, form: &str) -> (Option<i32>, String) {
        self.check_and(form, || {}).0
    }

    /// The same, and what is done before the next robot is compiled.
    ///
    /// To cargo the packages of all blank robots are the same, whichever folder they lie in: one robot at a time, and what
    /// another one compiled is always old.
    fn check_and<T>(&self, form: &str, next: impl FnOnce() -> T) -> ((Option<i32>, String), T) {
        static TURN: Mutex<()> = Mutex::new(());
        let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        touch_sources(&self.folder.path().join("robot"));
        let target = target_folder();
        let mut command = Command::new(target.join("hulkgen"));
        command
            .args(["check", "--cargo", "--format", form])
            .current_dir(self.folder.path().join("robot"))
            .env("CARGO_NET_OFFLINE", "true")
            // Of whoever checks, not of the robot.
            .env("HULK_PARAMETERS__speed_choice__cruising", "-9.0")
            .env(
                "CARGO_TARGET_DIR",
                target.parent().expect("target/<profile>"),
            );
        let output = command.output().expect("hulkgen was built");
        let text = String::from_utf8(output.stdout).expect("hulkgen prints UTF-8");
        ((output.status.code(), text), next())
    }

    /// What the program that `check --cargo` built says about its parameters.
    fn ask_program(&self) -> (Option<i32>, Value) {
        let mut program = Command::new(target_folder().join("simulation"));
        program
            .args(["--check-parameters", "--format", "json"])
            .current_dir(self.folder.path().join("robot"));
        let output = program.output().expect("it was built");
        let answer = serde_json::from_slice(&output.stdout).expect("the answer is JSON");
        (output.status.code(), answer)
    }

    /// The only error.
    #[track_caller]
    fn error(&self) -> Value {
        let (status, text) = self.check("json");
        let answer: Value = serde_json::from_str(&text).expect("the answer is JSON");
        assert_eq!(status, Some(1), "{answer:#}");
        let all = answer["diagnostics"].as_array().expect("a list");
        let mut errors = all.iter().filter(|one| one["severity"] == "error");
        let first = errors.next().expect("there is an error").clone();
        assert!(errors.next().is_none(), "{answer:#}");
        first
    }
}

/// Gives every Rust file below the folder the time of now.
fn touch_sources(folder: &Path) {
    for entry in fs::read_dir(folder).expect("the folder is ours") {
        let path = entry.expect("it was just listed").path();
        if path.is_dir() {
            touch_sources(&path);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let file = fs::File::options().append(true).open(&path);
            let touched = file.and_then(|file| file.set_modified(SystemTime::now()));
            touched.expect("the folder is ours");
        }
    }
}

#[test]
fn what_only_rustc_finds_stands_where_it_is_mended() {
    let robot = Robot::new();
    let (status, text) = robot.check("text");
    assert_eq!(status, Some(0), "{text}");

    let file = "nodes/src/control/wheel_sender.rs";
    // A type that a macro hides from the scanner.
    let types = "\nmacro_rules! quantity {\n    ($name:ident) => {\n        pub type $name = f64;\n    };\n}\n\nquantity!(Speed);\n";
    robot.edit(
        "nodes/src/types.rs",
        "//! What nodes exchange.\n",
        &format!("//! What nodes exchange.\n{types}"),
    );
    robot.edit(
        file,
        "RequiredInput<Option<f32>",
        "RequiredInput<Option<crate::types::Speed>",
    );
    robot.edit(
        file,
        "(*context.wheel_speed)",
        "(*context.wheel_speed as f32)",
    );
    let error = robot.error();
    assert_eq!(error["code"], "left-to-rustc", "{error:#}");
    assert_eq!(error["spans"][0]["file"], file, "{error:#}");
    assert_eq!(error["spans"][0]["line"], 18, "{error:#}");
    assert_eq!(
        error["spans"][1]["file"],
        "nodes/src/control/speed_choice.rs"
    );
    let rustc = error["rustc"].as_str().expect("rustc's words");
    assert!(
        rustc.contains("generated/src/cyclers/control.rs"),
        "{rustc}"
    );
    assert!(rustc.contains("expected `&f64`, found `&f32`"), "{rustc}");

    // The author's own body is rustc's matter.
    robot.edit(
        file,
        "(*context.wheel_speed as f32)",
        "(*context.wheel_speed)",
    );
    let error = robot.error();
    assert_eq!(error["code"], "rustc", "{error:#}");
    assert_eq!(error["spans"][0]["file"], file);
    assert_eq!(error["spans"][0]["line"], 34, "{error:#}");
    let (_, text) = robot.check("text");
    assert!(text.contains("error[E0308]: mismatched types\n"), "{text}");
    robot.edit(
        file,
        "RequiredInput<Option<crate::types::Speed>",
        "RequiredInput<Option<f32>",
    );

    robot.edit(
        "simulation/src/lib.rs",
        "impl Wheels for Hardware {",
        "impl Hardware {",
    );
    let error = robot.error();
    assert_eq!(error["code"], "left-to-rustc", "{error:#}");
    assert_eq!(error["spans"][0]["file"], "hulk.toml");
    let help = error["help"].as_str().expect("a deed");
    assert!(
        help.starts_with("implement `Wheels` for `simulation::Hardware`"),
        "{help}"
    );
    assert!(help.contains("`nodes::control::wheel_sender`"), "{help}");
}

/// A speed that derived serde reads by a function.
const SPEED: &str = r#"
/// Metres per second, never negative.
#[derive(Clone, Copy, Debug, Deserialize, Reflect, Serialize)]
#[serde(try_from = "f32")]
pub struct Speed {
    /// In metres per second.
    pub value: f32,
}

impl TryFrom<f32> for Speed {
    type Error = String;

    fn try_from(value: f32) -> Result<Self, Self::Error> {
        if value < 0.0 {
            return Err(format!("{value} m/s is no speed to cruise at"));
        }
        Ok(Self { value })
    }
}
"#;

/// The blank robot with such a parameter.
fn robot_with_opaque_parameter() -> Robot {
    let robot = Robot::new();
    let first = "use serde::{Deserialize, Serialize};\n";
    robot.edit("nodes/src/types.rs", first, &format!("{first}{SPEED}"));
    let node = "nodes/src/control/speed_choice.rs";
    robot.edit(
        node,
        "Parameter<f32, \"speed_choice.cruising\">",
        "Parameter<crate::types::Speed, \"speed_choice.cruising\">",
    );
    robot.edit(node, "*context.cruising", "context.cruising.value");
    let parameters = "parameters = \"parameters\"\n";
    let identities = format!("{parameters}identities = [\"head\"]\n");
    robot.edit("hulk.toml", parameters, &identities);
    robot
}

#[test]
fn what_only_serde_can_read_is_asked_of_the_robots_program() {
    let robot = robot_with_opaque_parameter();
    let file = "parameters/default.toml";
    let (status, text) = robot.check("text");
    assert_eq!(status, Some(0), "{text}");
    assert!(text.ends_with("all checked\n"), "{text}");
    robot.edit(file, "cruising = 1.0", "cruising = -1.0");
    let mut hulkgen = Command::new(target_folder().join("hulkgen"));
    hulkgen
        .arg("check")
        .current_dir(robot.folder.path().join("robot"));
    let alone = hulkgen.output().expect("hulkgen was built");
    let alone = String::from_utf8_lossy(&alone.stdout).into_owned();
    let left = "all checked, 1 parameter left to `check --cargo`\n";
    assert!(alone.ends_with(left), "{alone}");

    let error = robot.error();
    assert_eq!(error["code"], "mistyped-parameter", "{error:#}");
    assert_eq!(
        error["message"],
        "`speed_choice.cruising`: -1 m/s is no speed to cruise at"
    );
    let span = &error["spans"][0];
    assert_eq!(
        (&span["file"], &span["line"]),
        (&file.into(), &7.into()),
        "{error:#}"
    );
    assert_eq!(
        (&span["column"], &span["end_column"]),
        (&12.into(), &16.into())
    );
    assert_eq!(span["label"], "");
    robot.edit(file, "cruising = -1.0", "cruising = 1.0");

    // A location where no target runs: what is there must be right, whatever it leaves out.
    robot.write(
        "parameters/field/head.P1.toml",
        "speed_choice.cruising = -2.0\n",
    );
    let error = robot.error();
    let span = &error["spans"][0];
    assert_eq!(span["file"], "parameters/field/head.P1.toml", "{error:#}");
    assert_eq!(span["label"], "at `field`, for head P1");
    robot.write(
        "parameters/field/head.P1.toml",
        "speed_choice.cruising = 2.0\n",
    );
    robot.write("parameters/head.P2.toml", "speed_choice.cruising = -2.0\n");
    let (status, text) = robot.check("text");
    assert_eq!(status, Some(1), "{text}");
    // It is read at both locations and is one mistake.
    assert_eq!(
        text.matches("error[mistyped-parameter]").count(),
        1,
        "{text}"
    );
    assert!(text.contains("--> parameters/head.P2.toml:1:25"), "{text}");
    assert!(text.contains("for head P2"), "{text}");
    robot.write("parameters/head.P2.toml", "");

    // Without the value nothing starts where a target runs.
    robot.edit(file, "cruising = 1.0", "# cruising = 1.0");
    let error = robot.error();
    assert_eq!(error["code"], "missing-parameter", "{error:#}");
}

#[test]
fn what_the_hardware_refuses_is_told_by_the_robots_program_alone() {
    let robot = robot_with_opaque_parameter();
    let file = "parameters/default.toml";
    robot.edit(file, "wall = 8.0", "wal = 8.0");
    // The table belongs to the hardware, which reads it at the start: the program knows, `check` does not tell.
    let ((status, text), (asked, answer)) = robot.check_and("text", || robot.ask_program());
    assert_eq!(status, Some(0), "{text}");
    assert!(text.ends_with("all checked\n"), "{text}");
    assert_eq!(asked, Some(1), "{answer:#}");
    let mistakes = answer["mistakes"].as_array().expect("a list");
    assert_eq!(mistakes.len(), 1, "{answer:#}");
    let parts = ["key", "fault", "line"].map(|part| mistakes[0][part].to_string());
    let expected = ["\"hardware.simulation.wal\"", "\"unknown\"", "13"];
    assert_eq!(parts, expected, "{answer:#}");

    // What it says in its own words, of no key and in no file.
    robot.edit(file, "wal = 8.0", "wall = 8.0");
    robot.edit(
        "simulation/src/lib.rs",
        "context.parameters::<Settings>().map(drop)",
        "match context.parameters::<Settings>()? {\n\
                    Settings { wall, .. } if wall < 1.0 => Err(\"no room to drive\".into()),\n\
                    _ => Ok(()),\n\
                }",
    );
    robot.edit(file, "wall = 8.0", "wall = 0.5");
    let ((status, text), (asked, answer)) = robot.check_and("text", || robot.ask_program());
    assert_eq!((status, asked), (Some(0), Some(1)), "{text}{answer:#}");
    let said = "hardware of `simulation`: no room to drive";
    assert_eq!(answer["mistakes"][0]["message"], said, "{answer:#}");

    // It hides nothing of what the nodes read.
    robot.edit(file, "cruising = 1.0", "cruising = -1.0");
    let error = robot.error();
    let said = "`speed_choice.cruising`: -1 m/s is no speed to cruise at";
    assert_eq!(error["message"], said, "{error:#}");
}
