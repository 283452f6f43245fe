//! A cycler that another machine runs: what the robot's crate has of it, what is asked of whom, and what cannot be.

use std::collections::BTreeMap;

use camino::{Utf8Path, Utf8PathBuf};
use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::pipeline::{self, Understood};
use hulkgen::render;
use hulkgen::workspace::{Changes, MANIFEST, Workspace};
use hulkgen::{graph, model, partial};
use support::root;

fn outpost() -> Workspace {
    let folder = root().join("tests/robots/outpost");
    Workspace::open(Utf8Path::from_path(&folder).expect("its path is UTF-8")).expect("it is there")
}

/// The outpost with another text in its manifest.
fn with(before: &str, after: &str) -> Workspace {
    let file = root().join("tests/robots/outpost").join(MANIFEST);
    let manifest = std::fs::read_to_string(file).expect("it is there");
    assert!(manifest.contains(before), "{before}");
    let manifest = manifest.replacen(before, after, 1);
    outpost().after(&Changes::from([(MANIFEST.into(), Some(manifest))]))
}

fn understood(workspace: &Workspace) -> Understood {
    let mut found = Diagnostics::new();
    let understood = pipeline::understand(workspace, &mut found);
    let told = diagnostics::render(&found, workspace, false);
    assert_eq!(told, "");
    understood.expect("nothing is wrong")
}

/// What is told of a manifest that says something wrong.
fn told(before: &str, after: &str) -> String {
    let workspace = with(before, after);
    let mut found = Diagnostics::new();
    assert!(pipeline::understand(&workspace, &mut found).is_err());
    diagnostics::render(&found, &workspace, false)
}

/// The crate of these cyclers, of the whole robot without any, by paths in its folder.
fn crate_of(names: &[&str]) -> BTreeMap<Utf8PathBuf, String> {
    let (workspace, mut understood) = (outpost(), understood(&outpost()));
    if !names.is_empty() {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let robot = partial::restrict(&workspace, &understood.robot, &names, None);
        understood.robot = robot.expect("they are cyclers");
    }
    let files = render::render(&model::describe(&understood.robot, &understood.schedule));
    let files = files.into_iter().map(|(path, text)| {
        let path = path.strip_prefix(&understood.robot.generated);
        (path.expect("it has one owner").to_owned(), text)
    });
    files.collect()
}

#[test]
fn the_robot_has_its_slots_and_nothing_else_of_it() {
    let files = crate_of(&[]);
    let text = |path: &str| files.get(Utf8Path::new(path)).map(String::as_str);
    let runtime = text("src/runtime.rs").expect("it is written");
    for part in [
        "Remote::new(",
        "\"LookoutNorth\",",
        "left_out: &[\"LookoutNorth\", \"LookoutSouth\"]",
        "instances: vec![Box::new(keeper)]",
        "Hardware: ClockInterface + Send",
    ] {
        assert!(runtime.contains(part), "{part}: {runtime}");
    }
    let database = text("src/databases/lookout.rs").expect("it is written");
    assert!(
        database.contains("pub ship: Ship") && !database.contains("echo"),
        "{database}"
    );
    assert!(
        database.contains("which another machine runs"),
        "{database}"
    );
    for absent in ["src/cyclers/lookout.rs", "src/runtime/lookout.rs"] {
        assert_eq!(text(absent), None);
    }
    let parameters = text("src/parameters.rs").expect("it is written");
    assert!(!parameters.contains("speed_of_sound"), "{parameters}");
    let dataflow = text("DATAFLOW.md").expect("it is written");
    assert!(
        dataflow.contains("Another machine runs it and feeds"),
        "{dataflow}"
    );
}

#[test]
fn the_other_machine_has_its_nodes_and_who_does_without_it_a_stub() {
    let files = crate_of(&["Lookout"]);
    let runtime = &files[Utf8Path::new("src/runtime.rs")];
    assert!(
        runtime.contains("vec![Box::new(lookout_north), Box::new(lookout_south)]"),
        "{runtime}"
    );
    assert!(
        runtime.contains("Hardware: EarInterface") && runtime.contains("remotes: Vec::new()"),
        "{runtime}"
    );
    let files = crate_of(&["Keeper"]);
    let runtime = &files[Utf8Path::new("src/runtime.rs")];
    assert!(
        runtime.contains("lookout_north: Stub::new") && !runtime.contains("Remote"),
        "{runtime}"
    );
}

#[test]
fn the_graph_says_where_it_runs_and_has_all_of_it() {
    let understood = understood(&outpost());
    let graph = graph::describe(&understood.robot, &understood.schedule);
    let json: serde_json::Value =
        serde_json::from_str(&graph::json::render(&graph)).expect("it is JSON");
    assert_eq!(json["cyclers"][0]["remote"], true);
    assert_eq!(json["cyclers"][1].get("remote"), None);
    let nodes = json["cyclers"][0]["nodes"].as_array().expect("a list");
    assert_eq!(nodes.len(), 2);
    assert!(
        nodes
            .iter()
            .all(|node| !node["fields"].as_array().expect("a list").is_empty())
    );
    let bridge = &json["bridges"][0];
    assert_eq!(
        (&bridge["path"], &bridge["kind"]),
        (&"LookoutNorth".into(), &"remote".into())
    );
    assert_eq!(bridge["direction"], "in");
    let words = "Lookout (perception, on another machine)";
    for text in [graph::mermaid::render(&graph), graph::dot::render(&graph)] {
        assert!(text.contains(words), "{text}");
    }
    let clients = &crate_of(&[])[Utf8Path::new("graph.json")];
    assert!(
        clients.contains("\"remote\":true") && clients.contains("EarInterface"),
        "{clients}"
    );
}

#[test]
fn hardware_serves_what_runs_beside_it() {
    let told = told("remote = true\n", "");
    assert!(
        told.contains("unserved-trait") && told.contains("EarInterface"),
        "{told}"
    );
}

#[test]
fn what_cannot_be_said_of_it_is_told() {
    for (before, after, code, part) in [
        (
            "kind = \"real-time\"\n",
            "kind = \"real-time\"\nremote = true\n",
            "invalid-value",
            "only perception cyclers can be remote",
        ),
        (
            "key = \"outpost/north\"\n",
            "key = \"outpost/north\"\ndirection = \"both\"\n",
            "invalid-bridge",
            "nothing of it goes out from here",
        ),
        (
            "path = \"LookoutNorth\"\n",
            "path = \"LookoutNorth.main_outputs.ship\"\n",
            "invalid-bridge",
            "name the instance alone, `LookoutNorth`",
        ),
        (
            "path = \"LookoutNorth\"\n",
            "path = \"Keeper\"\n",
            "invalid-bridge",
            "names no output and no procedure of `Keeper`",
        ),
        (
            "key = \"outpost/north\"\n",
            "key = \"outpost/north\"\nencoding = \"cdr\"\n",
            "invalid-bridge",
            "cycles of `LookoutNorth` are told as JSON",
        ),
        (
            "kind = \"real-time\"\n",
            "kind = \"real-time\"\nrecord = { while = \"LookoutNorth.ship\" }\n",
            "unknown-instance",
            "another machine runs its cycler",
        ),
    ] {
        let told = told(before, after);
        assert!(told.contains(code) && told.contains(part), "{told}");
    }
}
