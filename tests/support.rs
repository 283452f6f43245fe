//! What the tests of this crate share: where the repository is, and its own source files.

pub mod api;
pub mod fuzzed;
pub mod nao;
pub mod sharing;

use std::fs;
use std::path::{Path, PathBuf};

pub use framework::testing::skip;
use hulkgen::workspace::Workspace;
pub use sharing::compile_unoptimised;

/// The root of the repository.
pub fn root() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    folder.expect("the crate lies in the repository").to_owned()
}

/// `target/<profile>`, where this test and hulkgen were built.
///
/// A test that compiles a robot does it in the folder above: what it shares with the tests is compiled already.
pub fn target_folder() -> PathBuf {
    let test = std::env::current_exe().expect("this test has a path");
    let folder = test.parent().and_then(Path::parent);
    folder.expect("target/<profile>/deps/<test>").to_owned()
}

/// A source file by its path relative to the root.
pub struct Source {
    pub path: String,
    pub text: String,
}

/// Every file with this ending below the folders, sorted; build output and fixtures' generated crates included.
pub fn sources(folders: &[&str], ending: &str) -> Vec<Source> {
    let root = root();
    let mut found = Vec::new();
    for folder in folders {
        collect(&root, &root.join(folder), ending, &mut found);
    }
    found.sort_by(|left, right| left.path.cmp(&right.path));
    assert!(!found.is_empty(), "no {ending} files below {folders:?}");
    found
}

fn collect(root: &Path, folder: &Path, ending: &str, found: &mut Vec<Source>) {
    let entries = fs::read_dir(folder)
        .unwrap_or_else(|error| panic!("{} cannot be listed: {error}", folder.display()));
    for entry in entries {
        let path = entry
            .expect("an entry of a folder that was just listed")
            .path();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if path.is_dir() {
            // What programs write and nobody checks in.
            let is_output = matches!(
                name.as_str(),
                "artifacts" | "coverage" | "node_modules" | "target" | "written"
            ) || path.ends_with("tests/fuzz/corpus");
            if !is_output && !name.starts_with('.') {
                collect(root, &path, ending, found);
            }
        } else if name.ends_with(ending) {
            let text = fs::read_to_string(&path)
                .unwrap_or_else(|error| panic!("{} cannot be read: {error}", path.display()));
            let path = path.strip_prefix(root).expect("it lies below the root");
            found.push(Source {
                path: path.to_string_lossy().into_owned(),
                text,
            });
        }
    }
}

/// The fixture robots under `tests/robots/` that live in memory only, by name.
pub const FIXTURES: &[&str] = &[
    "cycler_state",
    "perception_and_real_time",
    "required_input",
    "smallest",
    "two_instances",
];

/// The workspace of a fixture robot: its manifest, and one crate `nodes` of its node files.
pub fn fixture(name: &str) -> Workspace {
    Workspace::in_memory(fixture_files(name))
}

/// The same as path and text, for tests that change a file first.
pub fn fixture_files(name: &str) -> Vec<(String, String)> {
    workspace_files(&format!("tests/robots/{name}"))
}

/// The robot of `tests/diagnostics/CODE` without its mistake: what `repaired/` holds, in place of the same files.
pub fn repaired_files(folder: &str) -> Vec<(String, String)> {
    let repaired = format!("{folder}/repaired");
    let mut files = workspace_files(folder);
    let changed = [".rs", ".toml"].iter().flat_map(|ending| {
        let all = sources(&[folder], ending).into_iter();
        all.filter(|source| source.path.starts_with(&repaired))
    });
    for source in changed {
        let path = source.path[repaired.len() + 1..].replace("nodes/", "nodes/src/");
        files.retain(|(other, _)| *other != path);
        files.push((path, source.text));
    }
    files
}

/// A folder with `hulk.toml`, `nodes/*.rs` (a `lib.rs` among them, or it is made) and perhaps `parameters/*.toml`, as a whole workspace.
pub fn workspace_files(folder: &str) -> Vec<(String, String)> {
    let below = |path: &str| {
        path.trim_start_matches(folder)
            .trim_start_matches('/')
            .to_owned()
    };
    let mut files = vec![
        ("Cargo.toml".to_owned(), WORKSPACE.to_owned()),
        ("nodes/Cargo.toml".to_owned(), NODES.to_owned()),
    ];
    let mut modules = String::new();
    let own_library = root().join(folder).join("nodes/lib.rs").is_file();
    let of_folder = |source: &Source| !below(&source.path).starts_with("repaired/");
    for source in sources(&[folder], ".rs").into_iter().filter(of_folder) {
        let path = below(&source.path).replace("nodes/", "nodes/src/");
        let module = path
            .trim_start_matches("nodes/src/")
            .trim_end_matches(".rs");
        modules.push_str(&format!("pub mod {module};\n"));
        files.push((path, source.text));
    }
    modules.push_str("pub struct Hardware;\nimpl framework::Hardware for Hardware {}\n");
    if !own_library {
        files.push(("nodes/src/lib.rs".to_owned(), modules));
    }
    for source in sources(&[folder], ".toml").into_iter().filter(of_folder) {
        files.push((below(&source.path), source.text));
    }
    files
}

const WORKSPACE: &str = r#"[workspace]
members = ["generated", "nodes"]

[workspace.package]
version = "0.1.0"
edition = "2024"

[workspace.dependencies]
framework = { package = "hulkgen-framework", version = "0.1.0" }
nodes = { path = "nodes" }
serde = { version = "1", features = ["derive"] }
"#;

const NODES: &str = r#"[package]
name = "nodes"
version.workspace = true
edition.workspace = true

[dependencies]
framework.workspace = true
serde.workspace = true
"#;

/// The first comment of a fixture's manifest: what the robot is there to show.
pub fn purpose(name: &str) -> String {
    let path = root().join("tests/robots").join(name).join("hulk.toml");
    let manifest = fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{} cannot be read: {error}", path.display()));
    let first = manifest.lines().next().unwrap_or_default();
    first.trim_start_matches("# ").to_owned()
}
