//! `generate --only`: what the crate of some cyclers says, and what it leaves alone.

use std::collections::BTreeMap;

use camino::{Utf8Path, Utf8PathBuf};
use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::pipeline::{self, Understood};
use hulkgen::render::{self, GeneratedFiles};
use hulkgen::resolve::robot::Robot;
use hulkgen::workspace::Workspace;
use hulkgen::{model, partial};
use support::{FIXTURES, fixture, purpose, root};

fn understood(workspace: &Workspace) -> Understood {
    let mut diagnostics = Diagnostics::new();
    pipeline::understand(workspace, &mut diagnostics)
        .unwrap_or_else(|_| panic!("{}", diagnostics::render(&diagnostics, workspace, false)))
}

fn nao() -> Workspace {
    Workspace::open(Utf8Path::from_path(&root()).expect("its path is UTF-8")).expect("it is there")
}

fn zoo() -> Workspace {
    let folder = root().join("tests/robots/zoo");
    Workspace::open(Utf8Path::from_path(&folder).expect("its path is UTF-8")).expect("it is there")
}

/// The robot of these cyclers.
fn only(workspace: &Workspace, robot: &Robot, names: &[&str]) -> Robot {
    let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    partial::restrict(workspace, robot, &names, None).expect("they are cyclers")
}

/// The crate of these cyclers, by paths in its folder.
fn crate_of(workspace: &Workspace, names: &[&str]) -> BTreeMap<Utf8PathBuf, String> {
    let understood = understood(workspace);
    let robot = only(workspace, &understood.robot, names);
    let files = render::render(&model::describe(&robot, &understood.schedule));
    below(&robot.generated, files)
}

fn below(folder: &Utf8Path, files: GeneratedFiles) -> BTreeMap<Utf8PathBuf, String> {
    let files = files.into_iter().map(|(path, text)| {
        let path = path.strip_prefix(folder).expect("it has one owner");
        (path.to_owned(), text)
    });
    files.collect()
}

/// What runs: all of the library but its title.
fn sources(files: BTreeMap<Utf8PathBuf, String>) -> BTreeMap<Utf8PathBuf, String> {
    let is_source = |path: &Utf8PathBuf| {
        let is_binary = path.starts_with("src/bin");
        path.starts_with("src") && !is_binary && path != "src/lib.rs"
    };
    let sources = files.into_iter().filter(|(path, _)| is_source(path));
    sources.collect()
}

#[test]
fn every_file_that_is_another_in_the_halves_of_a_robot() {
    let name = "perception_and_real_time";
    let whole = understood(&fixture(name));
    let files = render::render(&model::describe(&whole.robot, &whole.schedule));
    let whole = below(&whole.robot.generated, files);
    for cycler in ["Control", "Vision"] {
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(root().join("snapshots/partial").join(cycler));
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.set_description(purpose(name));
        settings.bind(|| {
            let mut files = crate_of(&fixture(name), &[cycler]);
            files.retain(|path, text| whole.get(path) != Some(text));
            for (path, text) in files {
                insta::assert_snapshot!(path.as_str().replace('/', "__"), text);
            }
        });
    }
}

#[test]
fn with_all_cyclers_named_the_same_runs_as_in_the_whole_robot() {
    let mut workspaces: Vec<Workspace> = FIXTURES.iter().map(|name| fixture(name)).collect();
    workspaces.extend([nao(), zoo()]);
    for workspace in workspaces {
        let understood = understood(&workspace);
        let robot = &understood.robot;
        let whole = render::render(&model::describe(robot, &understood.schedule));
        let whole = sources(below(&robot.generated, whole));
        let cyclers = robot.cyclers.iter();
        let names: Vec<&str> = cyclers.map(|cycler| cycler.name.as_str()).collect();
        assert!(whole.len() > 5, "only {whole:?}");
        assert_eq!(sources(crate_of(&workspace, &names)), whole, "{names:?}");
    }
}

#[test]
fn in_whatever_order_and_however_often_cyclers_are_named_the_bytes_are_the_same() {
    let zoo = zoo();
    let once = crate_of(&zoo, &["Vision", "Lights", "Reflexes"]);
    let again = crate_of(&zoo, &["Reflexes", "Vision", "Reflexes", "Lights"]);
    assert_eq!(once, again);
}

#[test]
fn the_nao_with_control_alone_names_only_what_control_needs() {
    let (nao, names) = (nao(), ["Control"]);
    let understood = understood(&nao);
    let robot = only(&nao, &understood.robot, &names);
    assert_eq!(robot.generated, "generated-control");
    assert_eq!(robot.command(), "hulkgen generate --only Control");
    let model = model::describe(&robot, &understood.schedule);
    let stubs: Vec<&str> = (model.runtime.stubs.iter())
        .map(|stub| stub.name.as_str())
        .collect();
    assert_eq!(stubs, ["VisionTop", "VisionBottom", "SplNetwork", "Audio"]);
    let outside = model.outside.iter().flat_map(|cycler| &cycler.outputs);
    let outside: Vec<&str> = outside.map(|output| output.name.as_str()).collect();
    let expected = [
        "ball_view",
        "balls",
        "center_circle",
        "corners",
        "field_border",
        "limb_mask",
        "lines",
        "obstacles",
        "penalty_mark",
        "game_controller_packet",
        "team_message",
        "whistle_evidence",
    ];
    assert_eq!(outside, expected);
    let of_control = ["Actuator", "Message", "Sensor", "Speaker"];
    let of_control = of_control.map(|name| format!("hardware::{name}Interface"));
    assert_eq!(model.runtime.hardware, of_control);
    let mut crates = robot.crates.iter().map(|one| one.name.as_str());
    // A node of Control reads a parameter whose type lies in the crate of Audio's nodes.
    assert!(crates.clone().any(|name| name == "audio"));
    let left_out = ["vision", "spl_network", "simulated_nao", "lola"];
    assert!(crates.all(|name| !left_out.contains(&name)));
    let files = crate_of(&nao, &names);
    let parameters = &files[Utf8Path::new("src/parameters.rs")];
    assert!(parameters.contains("pub ball_filter:"), "{parameters}");
    assert!(!parameters.contains("vision::"), "{parameters}");
    assert!(files.keys().all(|path| !path.starts_with("src/bin")));
}
