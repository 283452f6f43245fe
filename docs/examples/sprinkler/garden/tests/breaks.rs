//! Every change of `breaks/` is answered as the file beside it says.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use camino::Utf8Path;
use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::pipeline;
use hulkgen::workspace::Workspace;

/// What hulkgen has to know of the workspace around the example.
const WORKSPACE: &str = r#"[workspace]
members = ["garden", "nodes"]

[workspace.package]
version = "0.1.0"
edition = "2024"

[workspace.dependencies]
framework = { package = "hulkgen-framework", version = "0.1.0" }
sprinkler_nodes = { path = "nodes" }
"#;

fn example(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn copy(from: &Path, to: &Path) {
    if from.is_dir() {
        fs::create_dir_all(to).expect("the folder is ours");
        for entry in fs::read_dir(from).expect("it can be listed") {
            let name = entry.expect("it was just listed").file_name();
            copy(&from.join(&name), &to.join(&name));
        }
    } else {
        fs::copy(from, to).expect("a file of the example");
    }
}

/// What hulkgen says of the example, changed by a patch: its report, and the codes in it.
fn answer(patch: Option<&Path>) -> (String, Vec<&'static str>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for part in ["hulk.toml", "nodes", "garden", "parameters"] {
        copy(&example(part), &folder.path().join(part));
    }
    fs::write(folder.path().join("Cargo.toml"), WORKSPACE).expect("the folder is ours");
    if let Some(patch) = patch {
        let git = Command::new("git")
            .args(["apply", "--whitespace=error-all"])
            .arg(patch.canonicalize().expect("it is there"))
            .current_dir(folder.path())
            .output()
            .expect("git can be started");
        assert!(git.status.success(), "{}: {git:?}", patch.display());
    }
    let root = Utf8Path::from_path(folder.path()).expect("its path is UTF-8");
    let workspace = Workspace::at_root(root);
    let mut found = Diagnostics::new();
    let _understood = pipeline::understand(&workspace, &mut found);
    let codes = found.sorted().iter().map(|one| one.code.name()).collect();
    let report = diagnostics::render(&found, &workspace, false);
    (report.trim_end().to_owned(), codes)
}

#[test]
fn nothing_is_wrong_with_it_as_it_is() {
    assert_eq!(answer(None), (String::new(), Vec::new()));
}

#[test]
fn every_break_is_answered_as_it_says_and_stands_in_the_readme() {
    let readme = fs::read_to_string(example("README.md")).expect("it is there");
    let entries = fs::read_dir(example("breaks")).expect("it can be listed");
    let mut patches: Vec<PathBuf> = entries
        .map(|entry| entry.expect("it was just listed").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "patch"))
        .collect();
    patches.sort();
    assert!(patches.len() >= 15, "{patches:?}");
    for patch in patches {
        let (report, codes) = answer(Some(&patch));
        let [code] = codes.as_slice() else {
            panic!("{}: {report}", patch.display());
        };
        let expected = patch.with_extension("txt");
        if std::env::var("INSTA_UPDATE").is_ok_and(|value| value == "always") {
            fs::write(&expected, format!("{report}\n")).expect("the repository can be written");
        }
        let says = fs::read_to_string(&expected).unwrap_or_default();
        assert_eq!(report, says.trim_end(), "{}", expected.display());
        let name = patch.file_stem().expect("it has a name").to_string_lossy();
        let row = format!("| [{name}](breaks/{name}.patch) |");
        let link = format!("[{code}](../../diagnostics/{code}.md)");
        let rows = readme.lines().filter(|line| line.starts_with(&row));
        assert_eq!(
            rows.filter(|line| line.contains(&link)).count(),
            1,
            "{row} {link}"
        );
    }
}
