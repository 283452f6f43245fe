//! Late errors: what only rustc finds stands at the field or the line of the manifest that it comes from.

use std::fs;
use std::process::Command;

use serde_json::Value;
use support::target_folder;

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
        robot
    }

    fn edit(&self, path: &str, from: &str, to: &str) {
        let path = self.folder.path().join("robot").join(path);
        let text = fs::read_to_string(&path).expect("every blank robot has it");
        assert!(text.contains(from), "`{from}` in {}", path.display());
        fs::write(path, text.replace(from, to)).expect("the folder is ours");
    }

    /// `check --cargo` with packages compiled where those of the tests are.
    fn check(&self, form: &str) -> (Option<i32>, String) {
        let target = target_folder();
        let mut command = Command::new(target.join("hulkgen"));
        command
            .args(["check", "--cargo", "--format", form])
            .current_dir(self.folder.path().join("robot"))
            .env("CARGO_NET_OFFLINE", "true")
            .env(
                "CARGO_TARGET_DIR",
                target.parent().expect("target/<profile>"),
            );
        let output = command.output().expect("hulkgen was built");
        let text = String::from_utf8(output.stdout).expect("hulkgen prints UTF-8");
        (output.status.code(), text)
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
