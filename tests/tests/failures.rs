//! Every node of the zoo fails once under every policy of the manifest: contract section 5.6, in lockstep.
//!
//! The zoo is copied, each node gets a place where it can be struck, and one robot is generated for each policy; all four are
//! compiled into the program `tests/robots/zoo/failures`, which strikes and judges. Its second program flips one bit of one
//! output at a time in a replay, of every output and instance that the zoo's graph has: contract section 7.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Mutex, MutexGuard, PoisonError};

use camino::Utf8Path;
use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::pipeline;
use hulkgen::resolve::robot::Robot;
use hulkgen::workspace::{Changes, Workspace};
use serde_json::{Value, json};
use support::sharing::unoptimised;
use support::{root, sources, target_folder};

const POLICIES: [&str; 4] = ["stop", "restart", "skip", "hold"];

/// Where a bit of each output of a node can be flipped, as late as the node itself could.
fn flipping(text: &str) -> String {
    let in_place = outputs_of(text, "CycleContext");
    let returned = outputs_of(text, "MainOutputs");
    let flip = |name: &str, value: String| {
        format!("crate::flip::flip(module_path!(), {name:?}, {value});\n")
    };
    let before = in_place
        .iter()
        .map(|name| flip(name, format!("&mut *context.{name}")));
    let before: String = before.collect();
    let each = returned
        .iter()
        .map(|name| flip(name, format!("&mut self.{name}.value")));
    let each: String = each.collect();
    let end = text
        .rfind("Ok(MainOutputs")
        .expect("every node ends with it");
    let (head, tail) = text.split_at(end);
    let tail = tail.replacen("Ok(MainOutputs", "crate::flip::flipped(MainOutputs", 1);
    format!(
        "{head}{before}{tail}\nimpl crate::flip::Outputs for MainOutputs {{\nfn flip(&mut self) {{\n{each}}}\n}}\n"
    )
}

/// Names of the main outputs in a struct of a node.
fn outputs_of(text: &str, name: &str) -> Vec<String> {
    let start = text
        .find(&format!("pub struct {name} {{"))
        .expect("every node has it");
    let (fields, _) = text[start..].split_once('}').expect("it ends");
    let fields = fields
        .lines()
        .filter_map(|line| line.split_once(": MainOutput<"));
    fields.map(|(name, _)| name.trim().to_owned()).collect()
}

/// Where the nodes of the copy can be struck.
fn struck(text: &str) -> String {
    let cycle = text.find("pub fn cycle").expect("every node has it");
    let body = text[cycle..].find("{\n").expect("it has a body");
    let (head, tail) = text.split_at(cycle + body + 2);
    format!("{head}        crate::fault::strike(module_path!())?;\n{tail}")
}

/// The zoo's manifest with one policy for every node.
fn with_policy(policy: &str) -> String {
    let manifest =
        fs::read_to_string(root().join("tests/robots/zoo/hulk.toml")).expect("the zoo has it");
    let mut manifest: toml::Table = manifest.parse().expect("hulkgen reads it, too");
    let robot = manifest["robot"].as_table_mut().expect("a table");
    robot.insert("name".to_owned(), policy.into());
    robot.insert("generated".to_owned(), policy.into());
    for cycler in manifest["cycler"].as_array_mut().expect("a list") {
        let cycler = cycler.as_table_mut().expect("a table");
        cycler.insert("on_failure".to_owned(), policy.into());
        for list in ["setup_nodes", "nodes"] {
            for node in cycler[list].as_array_mut().expect("a list") {
                if let Some(path) = node.get("node").cloned() {
                    *node = path;
                }
            }
        }
    }
    manifest.to_string()
}

/// The repository's workspace with other members. Four robots are compiled sooner than optimised.
fn workspace_manifest() -> String {
    let text = fs::read_to_string(root().join("Cargo.toml")).expect("the root has it");
    let mut manifest: toml::Table = text.parse().expect("cargo reads it, too");
    let workspace = manifest["workspace"].as_table_mut().expect("a workspace");
    workspace.remove("default-members");
    workspace.remove("exclude");
    let members = ["failures", "hardware", "nodes"]
        .into_iter()
        .chain(POLICIES);
    workspace.insert("members".to_owned(), members.collect::<Vec<_>>().into());
    let dependencies = workspace["dependencies"].as_table_mut().expect("a table");
    for (name, dependency) in dependencies.iter_mut() {
        let Some(path) = dependency.get_mut("path") else {
            continue;
        };
        *path = match name.as_str() {
            "zoo_nodes" => "nodes".into(),
            "zoo_hardware" => "hardware".into(),
            _ => {
                let path = root().join(path.as_str().expect("a path"));
                path.to_string_lossy().into_owned().into()
            }
        };
    }
    dependencies.remove("zoo_runtime");
    let profiles = manifest["profile"].as_table_mut().expect("a table");
    profiles.insert("dev".to_owned(), unoptimised().into());
    manifest.to_string()
}

fn program_manifest() -> String {
    let runtimes = POLICIES.map(|policy| {
        format!("{policy}_runtime = {{ path = \"../{policy}\", default-features = false }}\n")
    });
    format!(
        "[package]\nname = \"zoo_failures\"\nversion.workspace = true\nedition.workspace = true\n\n\
         [[bin]]\nname = \"zoo_failures\"\npath = \"main.rs\"\n\n\
         [[bin]]\nname = \"zoo_mutants\"\npath = \"mutants.rs\"\n\n\
         [dependencies]\nframework.workspace = true\nhulkgen-recording.workspace = true\nserde_json.workspace = true\n\
         zoo_hardware.workspace = true\nzoo_nodes.workspace = true\n{}",
        runtimes.concat()
    )
}

/// One test at a time writes the copy.
static WRITING: Mutex<()> = Mutex::new(());

struct Zoo {
    folder: PathBuf,
    _writing: MutexGuard<'static, ()>,
}

impl Zoo {
    /// In the same place every time: what did not change is not compiled again.
    fn new() -> Self {
        let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join("failures");
        let zoo = Self {
            folder: place,
            _writing: WRITING.lock().unwrap_or_else(PoisonError::into_inner),
        };
        let from = "tests/robots/zoo/";
        for source in sources(&["tests/robots/zoo"], "") {
            let path = source.path.strip_prefix(from).expect("it lies there");
            let text = match path {
                "hulk.toml" => continue,
                _ if path.starts_with("generated") || path.contains("/tests/") => continue,
                "nodes/src/lib.rs" => format!("{}pub mod fault;\npub mod flip;\n", source.text),
                // Two of its nodes fail by themselves: where it is dark, and where it is loud.
                "hardware/src/lib.rs" => {
                    let bright = replaced(&source.text, "number % 10 != 9", "number < u64::MAX");
                    replaced(&bright, "number % 25 == 24", "number == u64::MAX")
                }
                // Its tests stay behind, and with them what they need.
                "hardware/Cargo.toml" => {
                    let (text, _) = source
                        .text
                        .split_once("[dev-dependencies]")
                        .expect("its tests");
                    text.to_owned()
                }
                "nodes/Cargo.toml" => {
                    let serde = "serde.workspace = true";
                    replaced(
                        &source.text,
                        serde,
                        &format!("postcard.workspace = true\n{serde}"),
                    )
                }
                _ if source.text.contains("pub fn cycle") => flipping(&struck(&source.text)),
                _ => source.text,
            };
            zoo.write(path, &text);
        }
        zoo.write(
            "nodes/src/fault.rs",
            include_str!("../robots/zoo/failures/fault.rs"),
        );
        for (path, text) in [
            (
                "nodes/src/flip.rs",
                include_str!("../robots/zoo/failures/flip.rs"),
            ),
            (
                "failures/main.rs",
                include_str!("../robots/zoo/failures/main.rs"),
            ),
            (
                "failures/mutants.rs",
                include_str!("../robots/zoo/failures/mutants.rs"),
            ),
        ] {
            zoo.write(path, text);
        }
        zoo.write("Cargo.toml", &workspace_manifest());
        zoo.write("failures/Cargo.toml", &program_manifest());
        for policy in POLICIES {
            // Each robot sees the packages of the others.
            let package = format!("[package]\nname = \"{policy}_runtime\"\n");
            zoo.write(&format!("{policy}/Cargo.toml"), &package);
        }
        let lock = fs::read_to_string(root().join("Cargo.lock")).expect("it is checked in");
        zoo.write("Cargo.lock", &lock);
        zoo
    }

    fn write(&self, path: &str, text: &str) {
        let path = self.folder.join(path);
        // What is touched is compiled again.
        if fs::read_to_string(&path).ok().as_deref() != Some(text) {
            fs::create_dir_all(path.parent().expect("a file lies in a folder"))
                .and_then(|()| fs::write(&path, text))
                .expect("the folder is ours");
        }
    }

    /// Writes the robot whose nodes all have this policy.
    fn generate(&self, policy: &str) -> Robot {
        let manifest = Changes::from([("hulk.toml".into(), Some(with_policy(policy)))]);
        let folder = Utf8Path::from_path(&self.folder).expect("the path is UTF-8");
        let workspace = Workspace::at_root(folder).after(&manifest);
        let mut found = Diagnostics::new();
        let files = pipeline::generate(&workspace, &mut found);
        let told = || diagnostics::render(&found, &workspace, false);
        let files = files.unwrap_or_else(|_| panic!("{}", told()));
        for (path, text) in files {
            // Its test asks for a manifest of its own.
            if !path.as_str().contains("/tests/") {
                self.write(path.as_str(), &text);
            }
        }
        let understood = pipeline::understand(&workspace, &mut found);
        understood.expect("it was just generated").robot
    }

    /// What a program of the copy says; it is built first.
    fn run(&self, program: &str, arguments: &[&str]) -> Output {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let target = target_folder();
        Command::new(cargo)
            .args(["run", "--offline", "--quiet"])
            .args([
                "--package",
                "zoo_failures",
                "--bin",
                program,
                "--target-dir",
            ])
            .arg(target.parent().expect("target/<profile>"))
            .arg("--")
            .args(arguments)
            .current_dir(&self.folder)
            .output()
            .expect("cargo runs these tests, so it is there")
    }
}

fn replaced(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "{from}");
    text.replace(from, to)
}

/// The nodes as the program wants them, each once.
fn plan(robot: &Robot) -> serde_json::Value {
    let mut nodes: Vec<serde_json::Value> = Vec::new();
    for cycler in &robot.cyclers {
        let instances: Vec<_> = cycler
            .instances
            .iter()
            .map(|instance| &instance.name)
            .collect();
        for node in &cycler.nodes {
            let outputs = cycler
                .outputs
                .iter()
                .filter(|output| cycler.nodes[output.producer].path == node.path);
            let outputs: Vec<_> = outputs.map(|output| &output.name).collect();
            if let Some(known) = nodes
                .iter_mut()
                .find(|known| known["path"] == node.path.as_str())
            {
                let known = known["instances"].as_array_mut().expect("a list");
                known.extend(instances.iter().map(|name| json!(name)));
            } else {
                nodes.push(json!({
                    "path": node.path,
                    "setup": node.setup,
                    "instances": instances,
                    "outputs": outputs,
                }));
            }
        }
    }
    nodes.into()
}

#[test]
fn every_node_may_fail_under_every_policy() {
    let zoo = Zoo::new();
    let robots = POLICIES.map(|policy| zoo.generate(policy));
    let plan = plan(&robots[0]);
    let output = zoo.run("zoo_failures", &[&plan.to_string()]);
    let (said, words) = (
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr),
    );
    let tried: Vec<_> = said.lines().collect();
    assert!(output.status.success(), "{:?}\n{words}", tried.last());
    let nodes = plan.as_array().map_or(0, Vec::len);
    assert!(nodes >= 21, "only {nodes} nodes");
    assert_eq!(tried.len(), nodes * POLICIES.len() * 2);
}

/// What the graph of the zoo says of mutants.
#[derive(Debug, Default)]
struct Mutants {
    /// Instance, node, main output of each that there has to be.
    all: BTreeSet<[String; 3]>,
    /// Nodes of which none can be: a replay does not call them.
    setup: BTreeSet<String>,
    /// Nodes of which none can be: they have no main output.
    silent: BTreeSet<String>,
}

impl Mutants {
    fn of(graph: &str) -> Self {
        let graph: Value = serde_json::from_str(graph).expect("it is JSON");
        let list = |value: &Value| value.as_array().expect("a list").clone();
        let text = |value: &Value| value.as_str().expect("a text").to_owned();
        let mut mutants = Self::default();
        for cycler in list(&graph["cyclers"]) {
            for node in list(&cycler["nodes"]) {
                let fields = list(&node["fields"]).into_iter();
                let outputs: Vec<_> = fields
                    .filter(|field| field["kind"] == "MainOutput")
                    .collect();
                let path = text(&node["path"]);
                if node["setup"] == true {
                    mutants.setup.insert(path);
                } else if outputs.is_empty() {
                    mutants.silent.insert(path);
                } else {
                    for instance in list(&cycler["instances"]) {
                        let all = outputs.iter();
                        mutants.all.extend(
                            all.map(|output| {
                                [text(&instance), path.clone(), text(&output["name"])]
                            }),
                        );
                    }
                }
            }
        }
        mutants
    }
}

#[test]
fn a_flipped_bit_of_any_node_is_named_by_the_verification() {
    let zoo = Zoo::new();
    // All four are compiled with it.
    let _robots = POLICIES.map(|policy| zoo.generate(policy));
    let graph = fs::read_to_string(zoo.folder.join("stop/graph.json")).expect("it was generated");
    let mutants = Mutants::of(&graph);
    // Who adds a node of which there can be no mutant says so here.
    let last = |paths: &BTreeSet<String>| -> Vec<String> {
        let last = |path: &String| path.trim_start_matches("zoo_nodes::").to_owned();
        paths.iter().map(last).collect()
    };
    assert_eq!(
        last(&mutants.setup),
        [
            "control::body",
            "hearing::ear",
            "lights::setup",
            "reflexes::bumper",
            "vision::exposure",
            "vision::eye",
        ]
    );
    assert_eq!(
        last(&mutants.silent),
        [
            "control::legs",
            "lights::cycle",
            "lights::lamp",
            "reflexes::flinch",
            "reflexes::node",
        ]
    );
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let tape = folder.path().join("zoo.mcap");
    let tape = tape.to_str().expect("the path is UTF-8");
    let plan = json!(mutants.all).to_string();
    let output = zoo.run("zoo_mutants", &[tape, &plan]);
    let (said, words) = (
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr),
    );
    assert!(output.status.success(), "{words}");
    let named: BTreeSet<_> = said
        .lines()
        .map(|line| {
            let mut words = line.split(' ').map(str::to_owned);
            [(); 3].map(|()| words.next().expect("instance, node, output"))
        })
        .collect();
    assert_eq!(named, mutants.all);
    // The same node in several instances, in each of them.
    let counters = named
        .iter()
        .filter(|[_, node, _]| node == "zoo_nodes::shared::counter");
    let counters: Vec<_> = counters.map(|[instance, ..]| instance).collect();
    assert_eq!(counters, ["Control", "VisionBottom", "VisionTop"]);
    // What other instances read, the recording has itself: there the place in the output is named, too.
    let with_place = said.lines().filter(|line| line.contains(" at `")).count();
    assert!(with_place >= 6, "{said}");
}
