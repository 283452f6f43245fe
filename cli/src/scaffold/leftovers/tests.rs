//! Which lines name a module that is gone, and which crates.

use super::*;

#[test]
fn what_names_the_module_is_found_wherever_it_stands() {
    let package =
        |name: &str, needs: &str| format!("[package]\nname = \"{name}\"\n[dependencies]\n{needs}");
    let files = [
        (
            "Cargo.toml",
            "[workspace]\nmembers = [\"nodes\", \"tools\", \"generated\"]".to_owned(),
        ),
        ("nodes/Cargo.toml", package("nodes", "")),
        (
            "nodes/src/lib.rs",
            "pub mod control;\npub use control::gone::Gone;\nmod gone {}\n".to_owned(),
        ),
        (
            "nodes/src/control.rs",
            "pub mod other;\n\npub use gone::Gone;\nfn f() -> gone::Gone { g(gone) }\n".to_owned(),
        ),
        (
            "nodes/src/control/other.rs",
            "use super::{\n    gone::Gone,\n    other,\n};\nuse crate::gone::Gone;\n\
                 mod tests {\n    use super::super::gone;\n    use super::gone;\n}\n"
                .to_owned(),
        ),
        (
            "nodes/tests/all.rs",
            "use crate::control::gone;\nuse nodes::control::gone as x;\n".to_owned(),
        ),
        (
            "tools/Cargo.toml",
            package(
                "tools",
                "brain = { package = \"nodes\", path = \"../nodes\" }",
            ),
        ),
        (
            "tools/src/lib.rs",
            "use brain::control::gone::*;\nuse brain::control::*;\n".to_owned(),
        ),
        ("generated/Cargo.toml", package("generated", "")),
        (
            "generated/src/lib.rs",
            "use nodes::control::gone;".to_owned(),
        ),
    ];
    let files = files.map(|(file, text)| (Utf8PathBuf::from(file), text));
    let workspace = Workspace::in_memory(files);
    let found = still_named(
        &workspace,
        Utf8Path::new("generated"),
        "nodes::control::gone",
    );
    assert_eq!(found.generated, BTreeMap::new());
    let found: Vec<String> = found
        .lines
        .iter()
        .map(|(file, line)| format!("{file}:{line}"))
        .collect();
    assert_eq!(
        found,
        [
            "nodes/src/control/other.rs:2",
            "nodes/src/control/other.rs:7",
            "nodes/src/control.rs:3",
            "nodes/src/control.rs:4",
            "nodes/src/lib.rs:2",
            "nodes/tests/all.rs:2",
            "tools/src/lib.rs:1",
        ]
    );
}
/// The Cargo.toml of a crate that hulkgen wrote for a robot of the repository.
fn generated_package(folder: &str) -> String {
    let robots = Utf8Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/robots");
    std::fs::read_to_string(robots.join(folder).join("Cargo.toml")).expect("it is checked in")
}

#[test]
fn a_generated_crate_is_named_with_its_command_and_no_line_of_it() {
    let package = |name: &str| format!("[package]\nname = \"{name}\"\n");
    let names_it = || "use zoo_nodes::control::gone;\n".to_owned();
    let files = [
        (
            // The root's own package holds the others.
            "Cargo.toml",
            "[workspace]\nmembers = [\"nodes\", \"generated\", \"generated-*\", \"old\"]\n"
                .to_owned()
                + &package("all"),
        ),
        ("src/lib.rs", names_it()),
        ("nodes/Cargo.toml", package("zoo_nodes")),
        (
            "nodes/src/lib.rs",
            "//! Not written by `hulkgen generate`.\nuse crate::control::gone;\n".to_owned(),
        ),
        ("generated/Cargo.toml", generated_package("zoo/generated")),
        ("generated/src/lib.rs", names_it()),
        (
            "generated-control/Cargo.toml",
            generated_package("zoo/generated-control"),
        ),
        (
            "generated-control/src/lib.rs",
            "pub mod cyclers;\n".to_owned(),
        ),
        ("generated-control/src/cyclers.rs", names_it()),
        (
            "generated-vision-reflexes-lights/Cargo.toml",
            generated_package("zoo/generated-vision-reflexes-lights"),
        ),
        ("generated-vision-reflexes-lights/src/lib.rs", String::new()),
        ("old/Cargo.toml", generated_package("k1/generated")),
        ("old/src/lib.rs", names_it()),
    ];
    let folder = tempfile::tempdir().expect("a temporary folder");
    let root = Utf8Path::from_path(folder.path()).expect("it is UTF-8");
    for (file, text) in files {
        let file = root.join(file);
        let above = file.parent().expect("it lies in the folder");
        std::fs::create_dir_all(above).expect("the folder is ours");
        std::fs::write(file, text).expect("the folder is ours");
    }
    let workspace = Workspace::at_root(root);
    let found = still_named(
        &workspace,
        Utf8Path::new("generated"),
        "zoo_nodes::control::gone",
    );
    let command = "hulkgen generate --only Control".to_owned();
    assert_eq!(
        found,
        Leftovers {
            lines: [("nodes/src/lib.rs".into(), 2), ("src/lib.rs".into(), 1)].into(),
            generated: [
                ("generated-control".into(), Some(command)),
                ("old".into(), None)
            ]
            .into(),
        }
    );
}
