//! The scaffold: what `new` writes is a whole robot, what the other commands change is whole or nothing.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use camino::{Utf8Path, Utf8PathBuf};
use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::drift;
use hulkgen::outcome::{Outcome, Refusal};
use hulkgen::pipeline::{self, Understood};
use hulkgen::scaffold::{
    self, Changes, CyclerKind, Framework, NewCycler, NewNode, NewRobot, Removal, Rename, Template,
};
use hulkgen::workspace::Workspace;
use support::{compile_unoptimised, root, skip, sources};

/// A robot in a folder of its own, and the built hulkgen in it.
struct Scaffolded {
    folder: tempfile::TempDir,
}

impl Scaffolded {
    fn new(arguments: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let words = ["new", "robot"].iter().chain(arguments);
        let output = hulkgen(folder.path(), words);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output));
        Self { folder }
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("robot")
    }

    #[track_caller]
    fn run(&self, arguments: &str, status: i32) -> String {
        let output = hulkgen(&self.path(), arguments.split_whitespace());
        assert_eq!(
            output.status.code(),
            Some(status),
            "{arguments}: {}",
            text(&output)
        );
        text(&output)
    }

    fn read(&self, path: &str) -> String {
        fs::read_to_string(self.path().join(path)).expect("the file is there")
    }

    fn edit(&self, path: &str, from: &str, to: &str) {
        let before = self.read(path);
        assert!(before.contains(from), "`{from}` in {path}");
        fs::write(self.path().join(path), before.replace(from, to)).expect("the folder is ours");
    }
}

/// The binary beside this test: `cargo test --workspace` builds it.
fn binary() -> PathBuf {
    target_folder().join(format!("hulkgen{}", std::env::consts::EXE_SUFFIX))
}

/// `target/<profile>`.
fn target_folder() -> PathBuf {
    let test = std::env::current_exe().expect("this test has a path");
    let folder = test.parent().and_then(Path::parent);
    folder.expect("target/<profile>/deps/<test>").to_owned()
}

fn hulkgen<'a>(folder: &Path, arguments: impl IntoIterator<Item = impl AsRef<str> + 'a>) -> Output {
    let words = arguments.into_iter().map(|word| word.as_ref().to_owned());
    let mut command = Command::new(binary());
    command.args(words).current_dir(folder);
    command.output().expect("hulkgen can be started")
}

fn text(output: &Output) -> String {
    format!(
        "{}{}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    )
}

/// Every file below a folder with its bytes, but for what cargo builds.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(&next).expect("a folder that exists") {
            let path = entry
                .expect("an entry of a folder that was just listed")
                .path();
            if path.is_dir() {
                open.push(path);
            } else {
                let content = fs::read(&path).expect("a file that was just listed");
                found.insert(path, content);
            }
        }
    }
    found
}

fn blank() -> Changes {
    let robot = NewRobot {
        name: "rover",
        template: Template::Blank,
        framework: &Framework::Version("0.1.0".to_owned()),
        checkout: None,
    };
    scaffold::new_robot(&robot).expect("it needs nothing")
}

/// The NAO of this repository as a team would get it, in memory.
fn nao_workspace() -> Workspace {
    let root = Utf8PathBuf::try_from(root()).expect("the repository has a plain name");
    let framework = Framework::choose(None, &root, &root, &root).expect("this is a checkout");
    let robot = NewRobot {
        name: "nao",
        template: Template::Nao,
        framework: &framework,
        checkout: Some(&root),
    };
    in_memory(scaffold::new_robot(&robot).expect("the repository is whole"))
}

fn in_memory(files: Changes) -> Workspace {
    let texts = files.into_iter();
    Workspace::in_memory(texts.filter_map(|(path, text)| Some((path, text?))))
}

#[track_caller]
fn understood(workspace: &Workspace) -> Understood {
    let mut found = Diagnostics::new();
    let understood = pipeline::understand(workspace, &mut found);
    let text = diagnostics::render(&found, workspace, false);
    assert!(!found.has_errors(), "{text}");
    understood.unwrap_or_else(|_| panic!("{text}"))
}

fn changed<'c>(changes: &'c Changes, path: &str) -> &'c str {
    let change = changes.get(Utf8Path::new(path)).expect("it is changed");
    change.as_deref().expect("it is not removed")
}

fn assert_snapshots<'t>(texts: impl IntoIterator<Item = (String, &'t str)>) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(root().join("snapshots/scaffold"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for (name, text) in texts {
            insta::assert_snapshot!(name.replace('/', "__"), text);
        }
    });
}

#[test]
fn every_file_of_a_blank_robot() {
    let files = blank();
    let texts = files.iter();
    assert_snapshots(texts.filter_map(|(path, text)| Some((path.to_string(), text.as_deref()?))));
}

#[test]
fn the_files_of_new_nodes() {
    let workspace = in_memory(blank());
    let robot = understood(&workspace).robot;
    let (path, cycler) = ("nodes::legs", "Control");
    let file = "nodes/src/legs.rs";
    for (name, setup) in [("new_node", false), ("new_setup_node", true)] {
        let node = NewNode {
            path,
            cycler,
            setup,
        };
        let changes = scaffold::add_node(&workspace, &robot, &node).expect("it can be added");
        assert_snapshots([(name.to_owned(), changed(&changes, file))]);
    }
    let cycler = NewCycler {
        name: "Legs",
        kind: CyclerKind::RealTime,
        instances: &[],
        setup_node: path,
    };
    let changes = scaffold::add_cycler(&workspace, &robot, &cycler).expect("it can be added");
    assert_snapshots([("first_setup_node".to_owned(), changed(&changes, file))]);
}

#[test]
fn a_new_robot_has_no_warnings_and_is_current() {
    for template in ["blank", "nao"] {
        let robot = Scaffolded::new(&["--template", template]);
        robot.run("check --deny-warnings", 0);
        robot.run("generate --check", 0);
        let before = files(&robot.path());
        assert!(robot.run("generate", 0).contains("`generated` is current"));
        assert_eq!(before, files(&robot.path()));
    }
}

#[test]
fn the_nao_of_a_team_is_that_of_the_repository() {
    let robot = Scaffolded::new(&["--template", "nao"]);
    for folder in ["robotics", "generated"] {
        for source in sources(&[folder], "") {
            assert_eq!(source.text, robot.read(&source.path), "{}", source.path);
        }
    }
}

/// cargo warns of profiles of packages that are not there.
#[test]
fn the_profiles_of_a_team_are_about_none_of_the_repositorys_packages() {
    let robot = Scaffolded::new(&["--template", "nao"]);
    let manifest: toml::Table = robot.read("Cargo.toml").parse().expect("it is TOML");
    let profiles = manifest["profile"].as_table().expect("a table");
    assert!(profiles["dev"].get("package").is_some());
    for (name, profile) in profiles {
        if let Some(packages) = profile.get("package") {
            let packages = packages.as_table().expect("a table");
            assert_eq!(packages.keys().collect::<Vec<_>>(), ["*"], "{name}");
        }
    }
}

#[test]
fn a_blank_robot_builds_tests_and_runs() {
    let robot = Scaffolded::new(&[]);
    compile_unoptimised(&robot.path());
    let target = target_folder();
    let target = target.parent().expect("target/<profile>");
    let cargo = |arguments: &str| {
        let mut command = Command::new(env!("CARGO"));
        command
            .args(arguments.split_whitespace())
            .arg("--offline")
            .current_dir(robot.path())
            .env("CARGO_TARGET_DIR", target)
            .env("HULKGEN", binary());
        let output = command.output().expect("cargo can be started");
        assert!(output.status.success(), "{arguments}: {}", text(&output));
        text(&output)
    };
    let tested = cargo("test --workspace");
    assert!(
        tested.contains("the_generated_crate_is_current ... ok"),
        "{tested}"
    );
    assert!(
        tested.contains("it_drives_and_stops_before_the_wall ... ok"),
        "{tested}"
    );
    let mut run = Command::new(binary());
    run.args("run --for 2s --headless --format json --profile dev --target-dir".split_whitespace())
        .arg(target)
        .current_dir(robot.path())
        .env("CARGO_NET_OFFLINE", "true");
    let output = run.output().expect("hulkgen can be started");
    assert!(output.status.success(), "{}", text(&output));
    let report: serde_json::Value =
        serde_json::from_slice(&output.stdout).expect("the report is JSON");
    let cycles = |instance: usize| report["instances"][instance]["cycles"].as_u64();
    assert!(cycles(0).is_some_and(|cycles| cycles > 0), "{report}");
    assert!(cycles(1).is_some_and(|cycles| cycles > 0), "{report}");
}

#[test]
fn a_folder_with_something_in_it_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let used = folder.path().join("used");
    fs::create_dir(&used).expect("the folder is ours");
    fs::write(used.join("notes.md"), "mine").expect("the folder is ours");
    fs::write(folder.path().join("file"), "mine").expect("the folder is ours");
    let before = files(folder.path());
    for words in [
        ["new", "used"].as_slice(),
        &["new", "file"],
        &["new", "1up"],
        &["new", "robot", "--framework", "nowhere"],
        &["new", "robot", "--template", "nao", "--name", "other"],
    ] {
        let output = hulkgen(folder.path(), words);
        assert_eq!(
            output.status.code(),
            Some(2),
            "{words:?}: {}",
            text(&output)
        );
        assert_eq!(before, files(folder.path()), "{words:?}");
        assert!(!folder.path().join("robot").exists());
    }
    fs::create_dir(folder.path().join("empty")).expect("the folder is ours");
    let output = hulkgen(folder.path(), ["new", "empty"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output));
}

#[test]
fn a_node_is_added_with_everything_that_belongs_to_it() {
    let robot = Scaffolded::new(&[]);
    let before = robot.read("hulk.toml");
    robot.run("add-node nodes::control::odometry --cycler Control", 0);
    let answer = robot.run(
        "add-node nodes::legs::gait::step_planner --cycler Control --setup",
        0,
    );
    let next = "next: write what it does into nodes/src/legs/gait/step_planner.rs, then `hulkgen generate`";
    assert!(answer.contains(next), "{answer}");
    let manifest = robot.read("hulk.toml");
    let added: Vec<&str> = manifest
        .lines()
        .filter(|line| !before.contains(line))
        .collect();
    assert_eq!(
        added,
        [
            "setup_nodes = [\"nodes::control::odometry_receiver\", \"nodes::legs::gait::step_planner\"]",
            "    \"nodes::control::odometry\",",
        ]
    );
    robot.run("check", 0);
    robot.run("generate --check", 0);
    let answer = robot.run("remove-node nodes::control::odometry --delete", 0);
    assert!(!answer.contains(" stay: "), "{answer}");
    let answer = robot.run("remove-node nodes::legs::gait::step_planner", 0);
    let kept = "nodes/src/legs/gait/step_planner.rs and its `mod` line stay: ";
    assert!(answer.contains(kept), "{answer}");
    assert_eq!(robot.read("hulk.toml"), before);
    assert!(!robot.path().join("nodes/src/control/odometry.rs").exists());
    assert!(
        robot
            .path()
            .join("nodes/src/legs/gait/step_planner.rs")
            .exists()
    );
    robot.run("check --deny-warnings", 0);
}

#[test]
fn line_ends_survive() {
    let robot = Scaffolded::new(&[]);
    for path in ["hulk.toml", "nodes/src/control.rs"] {
        robot.edit(path, "\n", "\r\n");
    }
    robot.run("add-node nodes::control::odometry --cycler Control", 0);
    for path in ["hulk.toml", "nodes/src/control.rs"] {
        let text = robot.read(path);
        assert_eq!(
            text.matches('\n').count(),
            text.matches("\r\n").count(),
            "{path}"
        );
    }
}

#[test]
fn crates_in_the_old_style_keep_it() {
    let robot = Scaffolded::new(&[]);
    let nodes = robot.path().join("nodes/src");
    for module in ["control", "perception"] {
        fs::rename(
            nodes.join(format!("{module}.rs")),
            nodes.join(module).join("mod.rs"),
        )
        .expect("the folder is ours");
    }
    robot.run("add-node nodes::control::odometry --cycler Control", 0);
    robot.run("add-node nodes::legs::gait --cycler Control", 0);
    assert!(
        robot
            .read("nodes/src/control/mod.rs")
            .contains("pub mod odometry;\n")
    );
    assert!(robot.path().join("nodes/src/legs/mod.rs").exists());
}

#[test]
fn a_crate_without_the_framework_gets_it_with_its_first_node() {
    let robot = Scaffolded::new(&[]);
    robot.edit("Cargo.toml", "members = [", "members = [\"extra\", ");
    fs::create_dir_all(robot.path().join("extra/src")).expect("the folder is ours");
    let package = "[package]\nname = \"extra\"\nedition = \"2024\"\n";
    fs::write(robot.path().join("extra/Cargo.toml"), package).expect("the folder is ours");
    fs::write(robot.path().join("extra/src/lib.rs"), "").expect("the folder is ours");
    robot.run("add-node extra::watcher --cycler Control", 0);
    let expected =
        "\n[dependencies]\nframework = { workspace = true }\nserde = { workspace = true }\n";
    assert_eq!(
        robot.read("extra/Cargo.toml"),
        format!("{package}{expected}")
    );
    assert_eq!(robot.read("extra/src/lib.rs"), "pub mod watcher;\n");
}

#[test]
fn a_cycler_stands_behind_the_others() {
    let robot = Scaffolded::new(&[]);
    robot.run(
        "add-cycler Radar --kind perception --instances Left,Right --setup-node nodes::radar::echo_receiver",
        0,
    );
    let expected = "watchdog = \"300ms\"\n\n[[cycler]]\nname = \"Radar\"\nkind = \"perception\"\n\
        instances = [\"Left\", \"Right\"]\nsetup_nodes = [\"nodes::radar::echo_receiver\"]\n\n# The first target";
    assert!(
        robot.read("hulk.toml").contains(expected),
        "{}",
        robot.read("hulk.toml")
    );
    robot.run("generate --check", 0);
}

#[test]
fn parameters_of_a_removed_node_leave_with_it() {
    let robot = Scaffolded::new(&[]);
    robot.edit(
        "nodes/src/control/speed_choice.rs",
        "obstacles: PerceptionInput<Option<Obstacle>, \"Perception\", \"obstacle\">",
        "obstacles: PerceptionInput<f32, \"Perception\", \"range\">",
    );
    let answer = robot.run("remove-node nodes::perception::obstacle_detection", 0);
    assert!(answer.contains("~ parameters/default.toml"), "{answer}");
    let parameters = robot.read("parameters/default.toml");
    assert!(!parameters.contains("obstacle_detection"), "{parameters}");
    assert!(
        parameters.starts_with("# What the nodes take as given. SI units.\n\n[speed_choice]\n")
    );
    assert!(parameters.contains("cruising = 1.0 # m/s while nothing is in the way"));
}

#[test]
fn what_cannot_be_done_changes_no_byte() {
    let robot = Scaffolded::new(&[]);
    let before = files(&robot.path());
    for (arguments, status, words) in [
        (
            "add-node node::a --cycler Control",
            2,
            "did you mean `nodes`?",
        ),
        (
            "add-node nodes::a --cycler Contrl",
            2,
            "did you mean `Control`?",
        ),
        (
            "add-node nodes::type --cycler Control",
            2,
            "is no path of a node",
        ),
        (
            "add-node nodes::BallFilter --cycler Control",
            2,
            "write `ball_filter`",
        ),
        ("add-node nodes --cycler Control", 2, "crate::module::path"),
        (
            "add-node nodes::control --cycler Control",
            2,
            "is there already",
        ),
        (
            "add-node my_robot_runtime::a --cycler Control",
            2,
            "no crate of the workspace",
        ),
        (
            "add-node thinking::a --cycler Control",
            2,
            "the robot's nodes stand in `nodes`\n",
        ),
        (
            "add-cycler control --kind real-time --setup-node nodes::a",
            2,
            "UpperCamelCase",
        ),
        (
            "add-cycler Control --kind real-time --setup-node nodes::a",
            2,
            "is there already",
        ),
        (
            "add-cycler CONTROL --kind real-time --setup-node nodes::a",
            1,
            "duplicate-name",
        ),
        (
            "remove-node nodes::control::wheel_sende",
            2,
            "did you mean `nodes::control::wheel_sender`?",
        ),
        (
            "remove-node nodes::control::speed_choice",
            1,
            "unknown-output",
        ),
        (
            "remove-node nodes::control::speed_choice --delete",
            1,
            "nothing was changed",
        ),
        (
            "remove-node nodes::control::speed_choice --cycler Perception",
            2,
            "has no node",
        ),
        (
            "rename-output Perception.obstacl thing",
            2,
            "did you mean `obstacle`?",
        ),
        (
            "rename-output Perceptio.obstacle thing",
            2,
            "did you mean `Perception`?",
        ),
        (
            "rename-output Perception.obstacle range",
            2,
            "has an output `range` already",
        ),
        ("rename-output Perception.obstacle Thing", 2, "snake_case"),
        ("rename-output obstacle thing", 2, "Cycler.output"),
    ] {
        let said = robot.run(arguments, status);
        assert!(said.contains(words), "{arguments}: {said}");
        assert!(
            before == files(&robot.path()),
            "{arguments} changed something"
        );
    }
}

#[test]
fn a_robot_with_errors_is_not_changed() {
    let robot = Scaffolded::new(&[]);
    robot.edit(
        "nodes/src/control/wheel_sender.rs",
        "wheel_speed?\"",
        "speed_of_wheels?\"",
    );
    let before = files(&robot.path());
    let said = robot.run("add-node nodes::watcher --cycler Control", 1);
    assert!(
        said.contains("nothing was changed: the robot has errors"),
        "{said}"
    );
    assert!(before == files(&robot.path()));
}

#[test]
fn a_failure_at_any_file_leaves_every_byte() {
    let robot = Scaffolded::new(&[]);
    let folder = robot.path();
    let folder = Utf8Path::from_path(&folder).expect("temporary folders have plain names");
    let workspace = Workspace::at_root(folder);
    let node = NewNode {
        path: "nodes::legs::gait",
        cycler: "Control",
        setup: false,
    };
    let mut changes = scaffold::add_node(&workspace, &understood(&workspace).robot, &node)
        .expect("it can be added");
    changes.insert(Utf8PathBuf::from("README.md"), None);
    changes.insert(Utf8PathBuf::from("parameters/default.toml"), None);
    let before = files(folder.as_std_path());
    for failing in 0..changes.len() {
        let mut asked = 0;
        let result = drift::write_all_asking(folder, &changes, |_| {
            asked += 1;
            match asked > failing {
                true => Err(io::Error::other("the disk is full")),
                false => Ok(()),
            }
        });
        let error = result.expect_err("it fails").to_string();
        assert!(error.starts_with("cannot write"), "{error}");
        assert!(
            before == files(folder.as_std_path()),
            "after {failing} files"
        );
        assert!(
            !folder.join("nodes/src/legs").exists(),
            "after {failing} files"
        );
        assert!(folder.join("parameters").exists(), "after {failing} files");
    }
    // The real disk, too: a folder stands where a file should be.
    fs::create_dir_all(folder.join("nodes/src/legs/gait.rs/inside")).expect("the folder is ours");
    let before = files(folder.as_std_path());
    drift::write_all(folder, &changes).expect_err("it is a folder");
    assert!(before == files(folder.as_std_path()));
    fs::remove_dir_all(folder.join("nodes/src/legs")).expect("the folder is ours");
    drift::write_all(folder, &changes).expect("now it can");
    assert!(folder.join("nodes/src/legs/gait.rs").exists());
}

#[test]
fn every_output_of_the_nao_can_be_renamed() {
    let workspace = nao_workspace();
    let robot = understood(&workspace).robot;
    let mut count = 0;
    for cycler in &robot.cyclers {
        for output in &cycler.outputs {
            let rename = Rename {
                cycler: &cycler.name,
                old: &output.name,
                new: "another_name",
            };
            let renamed =
                scaffold::rename_output(&workspace, &robot, &rename).expect("it can be renamed");
            let after = workspace.after(&renamed.changes);
            let robot = understood(&after).robot;
            let named = robot.cyclers.iter().flat_map(|cycler| &cycler.outputs);
            assert!(
                named.clone().any(|one| one.name == "another_name"),
                "{}",
                output.name
            );
            for (path, text) in &renamed.changes {
                if path.extension() == Some("rs") {
                    syn::parse_file(text.as_deref().unwrap_or_default()).expect("it is Rust");
                }
            }
            count += 1;
        }
    }
    assert!(count > 10, "{count} outputs");
}

#[test]
fn a_rename_follows_every_kind_of_reader_and_the_manifest() {
    let files = support::fixture_files("perception_and_real_time").into_iter();
    let files = files.map(|(path, text)| match path.as_str() {
        "hulk.toml" => {
            let recorded = "kind = \"real-time\"\nrecord = { while = \"is_sure\" } # little";
            let elsewhere = "kind = \"perception\"\nrecord = { while = \"Control.is_sure\" }";
            let text = text.replace("kind = \"perception\"", elsewhere);
            let instance = "{ name = \"Bottom\", record = { while = \"Control.is_sure\" } }";
            let text = text.replace("\"Bottom\"", instance);
            let bridge = |path| format!("[[bridge]]\npath = \"{path}\"\nkey = \"{path}\"\n");
            let bridges = [
                "Control.main_outputs.is_sure",
                "VisionTop.main_outputs.seen",
            ]
            .map(bridge);
            let text = format!("{text}\n{}", bridges.concat());
            (path, text.replace("kind = \"real-time\"", recorded))
        }
        "nodes/src/filter.rs" => {
            let declared = "estimate: MainOutput<f32>,";
            let text = text.replace(
                declared,
                &format!("{declared}\n    is_sure: MainOutput<bool>,"),
            );
            let written = "estimate: estimate.into()";
            (
                path,
                text.replace(written, &format!("{written}, is_sure: true.into()")),
            )
        }
        _ => (path, text),
    });
    let workspace = Workspace::in_memory(files);
    let robot = understood(&workspace).robot;
    let rename = |cycler, old, new| {
        let renamed = scaffold::rename_output(&workspace, &robot, &Rename { cycler, old, new });
        let renamed = renamed.expect("it can be renamed");
        understood(&workspace.after(&renamed.changes));
        renamed.changes
    };
    let changes = rename("Control", "is_sure", "is_certain");
    let manifest = changed(&changes, "hulk.toml");
    assert!(manifest.contains("record = { while = \"is_certain\" } # little"));
    assert_eq!(
        manifest.matches("while = \"Control.is_certain\" }").count(),
        2
    );
    assert!(manifest.contains("path = \"Control.main_outputs.is_certain\"\n"));
    let changes = rename("Control", "estimate", "guess");
    assert!(
        changed(&changes, "nodes/src/filter.rs").contains("before: PreviousInput<f32, \"guess\">")
    );
    assert!(
        changed(&changes, "nodes/src/filter.rs")
            .contains("MainOutputs { guess: estimate.into(), is_sure")
    );
    let detector = changed(&changes, "nodes/src/detector.rs");
    assert!(detector.contains("estimate: LatestInput<f32, \"Control\", \"guess\">"));
    assert!(
        detector.contains("context.estimate.map_or"),
        "readers keep the names of their fields"
    );
    let changes = rename("Vision", "seen", "found");
    assert!(
        changed(&changes, "nodes/src/filter.rs")
            .contains("seen: PerceptionInput<Vec<f32>, \"Vision\", \"found\">")
    );
    let manifest = changed(&changes, "hulk.toml");
    assert!(manifest.contains("path = \"VisionTop.main_outputs.found\"\n"));
    let changes = rename("Control", "raw", "pace");
    assert!(
        changed(&changes, "nodes/src/filter.rs").contains("past: HistoricInput<f32, \"pace\">")
    );
    let changes = rename("Vision", "brightness", "light");
    assert!(
        changed(&changes, "nodes/src/detector.rs").contains("brightness: Input<u8, \"light\">")
    );
}

#[test]
fn a_rename_takes_the_marks_of_raw_names_along() {
    let files = support::fixture_files("perception_and_real_time").into_iter();
    let files = files.map(|(path, text)| match path.as_str() {
        "nodes/src/filter.rs" => {
            let text = text.replace("estimate: MainOutput", "r#estimate: MainOutput");
            let text = text.replace("estimate: estimate.into()", "r#estimate: estimate.into()");
            let test = "#[test]\nfn it_estimates() {\n    let outputs = node.cycle(context).unwrap();\n    \
                assert_eq!(outputs.r#estimate.value, 1.0);\n    let MainOutputs { r#estimate, .. } = outputs;\n    \
                assert!(matches!(other.r#estimate, x | y));\n}\n";
            (path, format!("{text}\n{test}"))
        }
        _ => (path, text),
    });
    let workspace = Workspace::in_memory(files);
    let robot = understood(&workspace).robot;
    let (cycler, old, new) = ("Control", "estimate", "pace");
    let renamed = scaffold::rename_output(&workspace, &robot, &Rename { cycler, old, new });
    let renamed = renamed.expect("it can be renamed");
    let filter = changed(&renamed.changes, "nodes/src/filter.rs");
    for part in [
        " pace: MainOutput<f32>",
        "MainOutputs { pace: estimate.into()",
        "assert_eq!(outputs.pace.value, 1.0)",
        "let MainOutputs { pace: r#estimate, .. } = outputs",
    ] {
        assert!(filter.contains(part), "{part}:\n{filter}");
    }
    let text = workspace
        .read("nodes/src/filter.rs".into())
        .expect("it is there");
    let line = text
        .lines()
        .position(|line| line.contains("other.r#estimate"));
    let line = line.expect("it stands there") + 1;
    assert_eq!(
        renamed.unclear.into_iter().collect::<Vec<_>>(),
        [("nodes/src/filter.rs".into(), line)]
    );
}

/// A robot whose `estimate` of Control is named by scenarios, tests, programs and pages.
fn named_everywhere() -> Workspace {
    let captured = "//! Cycle 7 of Control as it was recorded.\n//!\n//! Written by `hulkgen capture`, with its values.\n\n\
        use nodes::filter::{CycleContext, Filter};\n\n#[test]\nfn again() {\n    \
        let outputs = node.cycle(context).expect(\"it did\");\n    \
        captured.assert_output(\"estimate\", &outputs.estimate.value);\n}\n";
    let data = "{\n  \"node\": \"nodes::filter\",\n  \"fields\": {\n    \"estimate\": 1\n  },\n  \
        \"outputs\": {\n    \"raw\": 1,\n    \"estimate\": {\n      \"estimate\": 2\n    }\n  }\n}\n";
    let scenario = "# Control.main_outputs.estimate is not far.\n[[assertion]]\nvalue = \"Control.main_outputs.estimate.x\" # it\n\
        [[assertion]]\nvalue = 'Control.main_outputs.estimate'\n[[assertion]]\nvalue = \"Control.main_outputs.estimates\"\n\
        [[assertion]]\nvalue = \"VisionTop.main_outputs.estimate\"\nwhat = \"as Control.main_outputs.estimate is\"\n";
    let by_hand = "use nodes::filter::Filter;\n\nfn f() {\n    let outputs = node.cycle(context).unwrap();\n    \
        outputs.estimate;\n}\n";
    let elsewhere = "fn f() { other.estimate; }\n";
    let more = [
        ("scenarios/near.toml", scenario),
        ("nodes/tests/filter_control_7.rs", captured),
        ("nodes/tests/captured/filter_control_7.json", data),
        ("nodes/tests/filter_control_8.rs", captured),
        ("nodes/tests/by_hand.rs", by_hand),
        ("nodes/tests/elsewhere.rs", elsewhere),
        (
            "page.md",
            "\nhulkgen topic echo Control.main_outputs.estimate.x\n",
        ),
        ("other/hulk.toml", ""),
        ("other/scenarios/near.toml", scenario),
    ];
    let more = more.map(|(path, text)| (path.into(), text.to_owned()));
    let files = support::fixture_files("perception_and_real_time");
    Workspace::in_memory(files.into_iter().chain(more))
}

#[test]
fn a_rename_reaches_scenarios_and_captured_tests_and_lists_what_else_names_the_output() {
    let workspace = named_everywhere();
    let robot = understood(&workspace).robot;
    let (cycler, old, new) = ("Control", "estimate", "pace");
    let renamed = scaffold::rename_output(&workspace, &robot, &Rename { cycler, old, new });
    let renamed = renamed.expect("it can be renamed");
    let text = |path: &str| {
        workspace
            .read(path.into())
            .expect("it is there")
            .to_string()
    };
    let scenario = text("scenarios/near.toml")
        .replace(
            "\"Control.main_outputs.estimate.x",
            "\"Control.main_outputs.pace.x",
        )
        .replace(
            "'Control.main_outputs.estimate'",
            "'Control.main_outputs.pace'",
        );
    assert_eq!(changed(&renamed.changes, "scenarios/near.toml"), scenario);
    let test = "nodes/tests/filter_control_7.rs";
    let expected = text(test).replace("estimate", "pace");
    assert_eq!(changed(&renamed.changes, test), expected);
    let data = "nodes/tests/captured/filter_control_7.json";
    let expected = text(data).replace("\"estimate\": {", "\"pace\": {");
    assert_eq!(changed(&renamed.changes, data), expected);
    let told = renamed.unclear.iter();
    let told: Vec<_> = told.map(|(file, line)| (file.as_str(), *line)).collect();
    assert_eq!(
        told,
        [
            ("nodes/tests/by_hand.rs", 5),
            // Its data is not there.
            ("nodes/tests/filter_control_8.rs", 10),
            ("page.md", 2),
            ("scenarios/near.toml", 1),
            ("scenarios/near.toml", 10),
        ]
    );
}

#[test]
fn the_nao_has_no_test_or_scenario_left_with_the_old_name() {
    let root = Utf8PathBuf::try_from(root()).expect("the repository has a plain name");
    let workspace = Workspace::at_root(&root);
    let robot = understood(&workspace).robot;
    let (cycler, old, new) = ("Control", "ball", "ball_estimate");
    let renamed = scaffold::rename_output(&workspace, &robot, &Rename { cycler, old, new });
    let changes = renamed.expect("it can be renamed").changes;
    for path in [
        "robotics/control/tests/ball_filter_control_1157.rs",
        "robotics/control/tests/captured/ball_filter_control_1157.json",
        "robotics/scenarios/ball_taken_away.toml",
    ] {
        assert!(changed(&changes, path).contains(new), "{path}");
    }
}

#[test]
fn edits_hit_their_place_in_a_file_with_a_byte_order_mark() {
    let marked = |mark: &str| {
        let files = support::fixture_files("perception_and_real_time").into_iter();
        Workspace::in_memory(files.map(|(path, text)| (path, format!("{mark}{text}"))))
    };
    let (plain, marked) = (marked(""), marked("\u{feff}"));
    let renamed = |workspace: &Workspace| {
        let rename = Rename {
            cycler: "Control",
            old: "estimate",
            new: "guess",
        };
        let robot = understood(workspace).robot;
        let renamed = scaffold::rename_output(workspace, &robot, &rename);
        renamed.expect("it can be renamed").changes
    };
    assert_eq!(renamed(&marked), renamed(&plain));
    let added = |workspace: &Workspace| {
        let node = NewNode {
            path: "nodes::deep::thinker",
            cycler: "Control",
            setup: false,
        };
        let robot = understood(workspace).robot;
        scaffold::add_node(workspace, &robot, &node).expect("it can be added")
    };
    assert_eq!(added(&marked), added(&plain));
}

#[test]
fn a_file_that_begins_with_a_byte_order_mark_keeps_it() {
    const MARK: char = '\u{feff}';
    let robot = Scaffolded::new(&[]);
    let own = |path: &Path| path.ends_with("hulk.toml") || path.extension() == Some("rs".as_ref());
    let mut before = files(&robot.path());
    before.retain(|path, _| own(path) && !path.starts_with(robot.path().join("generated")));
    for (path, content) in &mut before {
        let text = String::from_utf8_lossy(content);
        *content = format!("{MARK}{text}").into_bytes();
        fs::write(path, &content).expect("the folder is ours");
    }
    robot.run("add-node nodes::control::watcher --cycler Control", 0);
    let after = files(&robot.path());
    let changed: Vec<_> = before
        .iter()
        .filter(|(path, text)| after[*path] != **text)
        .collect();
    assert_eq!(changed.len(), 2, "manifest and module: {changed:?}");
    for path in before.keys() {
        let text = String::from_utf8_lossy(&after[path]);
        let rest = text.strip_prefix(MARK);
        assert!(
            rest.is_some_and(|rest| !rest.contains(MARK)),
            "{}",
            path.display()
        );
    }
    let others = after.iter().filter(|(path, _)| !before.contains_key(*path));
    let marked = others.filter(|(_, text)| text.starts_with("\u{feff}".as_bytes()));
    assert_eq!(marked.count(), 0, "what hulkgen writes has none");
    robot.run("generate --check", 0);
}

#[test]
fn nodes_and_cyclers_of_the_nao_come_and_go() {
    let workspace = nao_workspace();
    let robot = understood(&workspace).robot;
    let node = NewNode {
        path: "control::fall_detector",
        cycler: "Control",
        setup: false,
    };
    let changes = scaffold::add_node(&workspace, &robot, &node).expect("it can be added");
    let after = workspace.after(&changes);
    let grown = understood(&after).robot;
    let removal = Removal {
        path: "control::fall_detector",
        cycler: None,
        delete: true,
    };
    let removed = scaffold::remove_node(&after, &grown, &removal).expect("it can be removed");
    for path in ["hulk.toml", "robotics/control/src/lib.rs"] {
        let original = workspace.read(Utf8Path::new(path)).expect("it was read");
        assert_ne!(changed(&changes, path), &*original);
        assert_eq!(changed(&removed, path), &*original);
    }
    let cycler = NewCycler {
        name: "Hearing",
        kind: CyclerKind::Perception,
        instances: &[],
        setup_node: "audio::sound_receiver",
    };
    let changes = scaffold::add_cycler(&workspace, &robot, &cycler).expect("it can be added");
    understood(&workspace.after(&changes));
    // Every node that somebody reads stays.
    for path in robot
        .cyclers
        .iter()
        .flat_map(|cycler| &cycler.nodes)
        .map(|node| &node.path)
    {
        let removal = Removal {
            path,
            cycler: None,
            delete: false,
        };
        scaffold::remove_node(&workspace, &robot, &removal).expect("it stands in the manifest");
    }
}

#[test]
fn a_module_inside_of_another_file_is_refused() {
    let workspace = in_memory(blank());
    let inline = Changes::from([(
        Utf8PathBuf::from("nodes/src/lib.rs"),
        Some("pub mod control;\npub mod interfaces;\npub mod perception;\npub mod types;\npub mod inner {}\n".to_owned()),
    )]);
    let workspace = workspace.after(&inline);
    let robot = understood(&workspace).robot;
    let node = NewNode {
        path: "nodes::inner::watcher",
        cycler: "Control",
        setup: false,
    };
    let refusal: Refusal = scaffold::add_node(&workspace, &robot, &node).expect_err("it is inside");
    assert_eq!(refusal.outcome, Outcome::Bad);
    assert!(
        refusal
            .message
            .contains("stands inside of `nodes/src/lib.rs`")
    );
}

#[test]
fn git_stops_at_generated_files_and_leaves_no_marks() {
    if Command::new("git").arg("--version").output().is_err() {
        return skip("git_stops_at_generated_files_and_leaves_no_marks", "git");
    }
    let robot = Scaffolded::new(&[]);
    let git = |arguments: &[&str]| {
        let mut command = Command::new("git");
        command.args(arguments).current_dir(robot.path());
        command.env("GIT_CONFIG_GLOBAL", "/dev/null");
        command.output().expect("git can be started")
    };
    let driver = format!("'{}' merge-driver %O %A %B", binary().display());
    git(&["init", "-q", "-b", "main"]);
    git(&["config", "merge.hulkgen.driver", &driver]);
    git(&["config", "user.name", "Test"]);
    git(&["config", "user.email", "test@localhost"]);
    let commit = || git(&["commit", "-qam", "Change"]);
    git(&["add", "-A"]);
    commit();
    git(&["checkout", "-qb", "theirs"]);
    robot.run("add-node nodes::control::left --cycler Control", 0);
    git(&["add", "-A"]);
    commit();
    git(&["checkout", "-q", "main"]);
    robot.run("add-node nodes::control::right --cycler Control", 0);
    git(&["add", "-A"]);
    commit();
    let merged = git(&["merge", "theirs"]);
    assert!(!merged.status.success(), "{}", text(&merged));
    assert!(
        text(&merged).contains("hulkgen generate && git add generated"),
        "{}",
        text(&merged)
    );
    for (path, content) in files(&robot.path().join("generated")) {
        let content = String::from_utf8_lossy(&content).into_owned();
        assert!(!content.contains("<<<<<<<"), "marks in {}", path.display());
    }
    let manifest = robot
        .read("hulk.toml")
        .replace("<<<<<<< HEAD\n", "")
        .replace("=======\n", "");
    let manifest = manifest.replace(">>>>>>> theirs\n", "");
    fs::write(robot.path().join("hulk.toml"), manifest).expect("the folder is ours");
    robot.run("generate", 0);
    git(&["add", "-A"]);
    assert!(git(&["commit", "-qm", "Merge"]).status.success());
    robot.run("generate --check", 0);
}
