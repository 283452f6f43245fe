//! Workspaces on disk and in memory.

use std::rc::Rc;

use camino::Utf8Path;

use super::{Changes, Workspace, glob};

fn workspace(files: &[(&str, &str)]) -> Workspace {
    Workspace::in_memory(files.iter().copied())
}

const ROOT: (&str, &str) = (
    "Cargo.toml",
    r#"
        [workspace]
        members = ["generated", "robotics/*"]
        exclude = ["robotics/old"]
        [workspace.dependencies]
        my-types = { path = "robotics/types" }
        serde = "1"
    "#,
);

#[test]
fn a_pattern_of_stars_and_question_marks_fits_names() {
    for (pattern, name, fits) in [
        ("*", "vision", true),
        ("v*n", "vision", true),
        ("v*x", "vision", false),
        ("visio?", "vision", true),
        ("?", "", false),
        ("*", "", true),
    ] {
        assert_eq!(glob::matches(pattern, name), fits, "{pattern} {name}");
    }
}

#[test]
fn members_are_found_by_the_name_of_their_library() {
    let workspace = workspace(&[
        ROOT,
        ("generated/Cargo.toml", "<<<<<<< HEAD"),
        (
            "robotics/types/Cargo.toml",
            "[package]\nname = \"my-types\"",
        ),
        ("robotics/types/src/lib.rs", ""),
        (
            "robotics/eyes/Cargo.toml",
            "[package]\nname = \"eyes\"\n[lib]\nname = \"vision\"\npath = \"seeing.rs\"\n\
             [dependencies]\nnalgebra = { version = \"0.35\", features = [\"serde-serialize\"] }",
        ),
        ("robotics/eyes/seeing.rs", ""),
        ("robotics/old/Cargo.toml", "[package]\nname = \"old\""),
        ("robotics/old/src/lib.rs", ""),
    ]);
    let members = workspace.members();
    let names: Vec<&str> = members
        .libraries()
        .map(|one| one.library.as_str())
        .collect();
    assert_eq!(names, ["my_types", "vision"]);
    assert_eq!(
        members.library("vision").unwrap().root_file,
        "robotics/eyes/seeing.rs"
    );
    assert_eq!(members.broken.len(), 1);
    assert_eq!(members.broken[0].file, "generated/Cargo.toml");
}

#[test]
fn a_package_may_have_its_old_name_before_edition_2024() {
    let own = "edition.workspace = true";
    for (shared, package, refusal) in [
        ("2024", "[project]\nname = \"eyes\"", None),
        (
            "2024",
            "[project]\nname = \"eyes\"\nedition = \"2021\"",
            None,
        ),
        ("2021", &format!("[project]\nname = \"eyes\"\n{own}"), None),
        (
            "2024",
            &format!("[project]\nname = \"eyes\"\n{own}"),
            Some("since edition 2024 `[project]` has to be called `[package]`"),
        ),
        (
            "2021",
            "[package]\nname = \"eyes\"\nedition = \"2024\"\n[project]",
            Some("since edition 2024 `[project]` has to be called `[package]`"),
        ),
        (
            "2021",
            "[project]\nversion = \"1.0.0\"",
            Some("`[package]` needs a `name`"),
        ),
    ] {
        let root = format!(
            "[workspace]\nmembers = [\"eyes\"]\n[workspace.package]\nedition = \"{shared}\""
        );
        let workspace = workspace(&[
            ("Cargo.toml", &root),
            ("eyes/Cargo.toml", package),
            ("eyes/src/lib.rs", ""),
        ]);
        let members = workspace.members();
        let broken = members.broken.iter().map(|broken| broken.message.as_str());
        assert_eq!(
            broken.collect::<Vec<_>>(),
            Vec::from_iter(refusal),
            "{package}"
        );
        let is_named = package.contains("name = ");
        assert_eq!(members.library("eyes").is_some(), is_named, "{package}");
    }
}

#[test]
fn what_a_member_depends_on_by_a_path_is_a_member() {
    let depends =
        |name: &str, on: &str| format!("[package]\nname = \"{name}\"\n[dependencies]\n{on}");
    let eyes = depends(
        "eyes",
        "types = { path = \"../types\" }\nlegs = { workspace = true }\n\
         far = { path = \"../../../far\" }\nold = { path = \"../old\" }\ngone = { path = \"../gone\" }",
    );
    let types = depends(
        "types",
        "math = { path = \"math\" }\neyes = { path = \"../eyes\" }",
    );
    let workspace = workspace(&[
        (
            "Cargo.toml",
            "[workspace]\nmembers = [\"robotics/eyes\"]\nexclude = [\"robotics/old\"]\n\
             [workspace.dependencies]\nlegs = { path = \"robotics/legs\" }",
        ),
        ("robotics/eyes/Cargo.toml", &eyes),
        ("robotics/eyes/src/lib.rs", ""),
        ("robotics/types/Cargo.toml", &types),
        ("robotics/types/src/lib.rs", ""),
        ("robotics/types/math/Cargo.toml", &depends("math", "")),
        ("robotics/types/math/src/lib.rs", ""),
        ("robotics/legs/Cargo.toml", &depends("legs", "")),
        ("robotics/legs/src/lib.rs", ""),
        ("robotics/old/Cargo.toml", &depends("old", "")),
        ("robotics/old/src/lib.rs", ""),
        ("far/Cargo.toml", &depends("far", "")),
        ("far/src/lib.rs", ""),
    ]);
    let members = workspace.members();
    let names: Vec<&str> = members
        .libraries()
        .map(|one| one.library.as_str())
        .collect();
    assert_eq!(names, ["eyes", "legs", "math", "types"]);
    assert_eq!(members.broken, []);
}

#[test]
fn a_dependency_comes_from_the_root_then_a_member_then_a_user() {
    let workspace = workspace(&[
        ROOT,
        (
            "robotics/types/Cargo.toml",
            "[package]\nname = \"my-types\"",
        ),
        ("robotics/types/src/lib.rs", ""),
        (
            "robotics/vision/Cargo.toml",
            "[package]\nname = \"vision\"\n[dependencies]\n\
             ordered-float = \"5\"\nown = { path = \"../../own\" }\nserde = { workspace = true }",
        ),
        ("robotics/vision/src/lib.rs", ""),
    ]);
    let requirement = |library| {
        let line =
            workspace
                .members()
                .requirement(library, Utf8Path::new("generated"), &["vision"]);
        line.map(|(key, requirement)| format!("{key} = {requirement}"))
    };
    for (library, line) in [
        ("my_types", "my-types = { workspace = true }"),
        ("serde", "serde = { workspace = true }"),
        ("vision", "vision = { path = \"../robotics/vision\" }"),
        ("ordered_float", "ordered-float = \"5\""),
        ("own", "own = { path = \"../own\" }"),
    ] {
        assert_eq!(requirement(library).as_deref(), Some(line));
    }
    assert_eq!(requirement("unknown"), None);
}

#[test]
fn a_text_is_kept_as_it_was_read() {
    let folder = tempfile::tempdir().unwrap();
    let root = Utf8Path::from_path(folder.path()).unwrap();
    std::fs::write(root.join("hulk.toml"), "first").unwrap();
    std::fs::create_dir_all(root.join("a/b")).unwrap();
    let workspace = Workspace::open(&root.join("a/b")).unwrap();
    let manifest = Utf8Path::new("hulk.toml");
    assert_eq!(workspace.text(manifest), None);
    assert_eq!(&*workspace.read(manifest).unwrap(), "first");
    std::fs::write(root.join("hulk.toml"), "second").unwrap();
    assert_eq!(&*workspace.read(manifest).unwrap(), "first");
    assert!(workspace.read(Utf8Path::new("other")).unwrap_err().missing);
}

#[test]
fn changes_are_seen_before_they_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let root = Utf8Path::from_path(folder.path()).unwrap();
    for file in ["kept", "changed", "removed"] {
        std::fs::write(root.join(file), "before").unwrap();
    }
    let workspace = Workspace::at_root(root);
    let read = |workspace: &Workspace, file: &str| {
        let text = workspace.read(Utf8Path::new(file));
        text.map(|text| text.to_string()).ok()
    };
    assert_eq!(read(&workspace, "changed").as_deref(), Some("before"));
    let changes = Changes::from([
        ("changed".into(), Some("after".to_owned())),
        ("removed".into(), None),
        ("new/one".into(), Some("after".to_owned())),
    ]);
    let after = workspace.after(&changes);
    for (file, text) in [
        ("kept", Some("before")),
        ("changed", Some("after")),
        ("removed", None),
        ("new/one", Some("after")),
    ] {
        assert_eq!(read(&after, file).as_deref(), text, "{file}");
        assert_eq!(after.is_file(Utf8Path::new(file)), text.is_some(), "{file}");
    }
    assert_eq!(after.list(Utf8Path::new("")), ["changed", "kept", "new"]);
    assert_eq!(after.files_below(Utf8Path::new("new")), ["new/one"]);
    assert_eq!(read(&workspace, "changed").as_deref(), Some("before"));
    assert!(!root.join("new").exists());
}

#[test]
fn a_file_is_parsed_again_where_its_text_or_the_source_map_is_another() {
    let file = Utf8Path::new("a.rs");
    let workspace = Workspace::in_memory([("a.rs", "struct A;")]);
    workspace.begin_parsing();
    let text = workspace.read(file).expect("it is there");
    let syntax = Rc::new(syn::parse_file(&text).expect("it is Rust"));
    workspace.keep_parsed(file, &text, &syntax);
    let after = workspace.after(&Changes::from([("b.rs".into(), Some(String::new()))]));
    after.begin_parsing();
    let kept = after.parsed(file, &text).expect("it was not changed");
    assert!(Rc::ptr_eq(&kept, &syntax));
    assert!(after.parsed(file, "struct B;").is_none());
    let other = Workspace::in_memory([("a.rs", "struct A;")]);
    other.begin_parsing();
    assert!(
        after.parsed(file, &text).is_none(),
        "its spans lead nowhere"
    );
    after.begin_parsing();
    assert!(after.parsed(file, &text).is_none());
}

#[test]
fn a_pattern_names_packages_and_what_a_neighbour_will_write_may_be_missing() {
    let folder = tempfile::tempdir().unwrap();
    let root = Utf8Path::from_path(folder.path()).unwrap();
    let write = |file: &str, text: &str| {
        let file = root.join(file);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(file, text).unwrap();
    };
    write(
        "Cargo.toml",
        "[workspace]\nmembers = [\"robots/*/nodes\", \"robots/one/generated\", \"robots/lost\"]",
    );
    for robot in ["one", "two"] {
        write(&format!("robots/{robot}/hulk.toml"), "");
    }
    write("robots/one/nodes/Cargo.toml", "[package]\nname = \"one\"");
    write("robots/one/nodes/src/lib.rs", "");
    let workspace = Workspace::at_root(&root.join("robots/two"));
    let members = workspace.members();
    let libraries: Vec<_> = members
        .libraries()
        .map(|one| one.library.as_str())
        .collect();
    assert_eq!(libraries, ["one"]);
    let missing = members.broken.iter().map(|broken| {
        let is_excused = crate::scan::is_of_a_neighbour(&workspace, &broken.file);
        (broken.file.as_str(), is_excused)
    });
    let missing: Vec<_> = missing.collect();
    assert_eq!(
        missing,
        [
            ("../one/generated/Cargo.toml", true),
            ("../lost/Cargo.toml", false)
        ]
    );
}

#[test]
fn a_dependency_keeps_the_name_and_the_package_that_its_author_gave() {
    let depends =
        |name: &str, on: &str| format!("[package]\nname = \"{name}\"\n[dependencies]\n{on}");
    let vision = depends(
        "vision",
        "rays = { package = \"light\", path = \"../../light\" }\nnew = { package = \"rand\", version = \"0.9\" }",
    );
    let types = depends(
        "my-types",
        "linear = { package = \"linear-algebra\", version = \"0.3\", optional = true }\n\
         rand = \"0.8\"\nlight = { path = \"../../light\" }\nserde_two = { package = \"serde\", version = \"1.0.2\" }",
    );
    let workspace = workspace(&[
        ROOT,
        ("robotics/types/Cargo.toml", &types),
        ("robotics/types/src/lib.rs", ""),
        ("robotics/vision/Cargo.toml", &vision),
        ("robotics/vision/src/lib.rs", ""),
    ]);
    let line = |name| {
        let found = workspace
            .members()
            .requirement(name, Utf8Path::new("generated"), &["vision"]);
        found.map(|(key, requirement)| format!("{key} = {requirement}"))
    };
    for (name, expected) in [
        (
            "linear",
            "linear = { package = \"linear-algebra\", version = \"0.3\" }",
        ),
        ("new", "new = { package = \"rand\", version = \"0.9\" }"),
        ("rand", "rand = \"0.8\""),
        // The root calls it so already.
        ("serde", "serde = { workspace = true }"),
        // Its users call one package by two names.
        (
            "light",
            "light = { package = \"light\", path = \"../light\" }",
        ),
    ] {
        assert_eq!(line(name).as_deref(), Some(expected));
    }
    for name in ["rays", "serde_two"] {
        assert_eq!(line(name), None, "it has another name");
    }
}

#[test]
fn the_framework_is_called_as_generated_code_calls_it_by_whatever_other_name_the_root_has_it_too() {
    let root = "[workspace]\nmembers = []\n[workspace.dependencies]\n\
                hulkgen-framework = { path = \"/elsewhere/framework\" }\n\
                framework = { package = \"hulkgen-framework\", path = \"/elsewhere/framework\" }\n";
    let workspace = workspace(&[("Cargo.toml", root)]);
    let line = workspace
        .members()
        .requirement("framework", Utf8Path::new("generated"), &[]);
    let (key, requirement) = line.expect("the root has it");
    assert_eq!(
        (&*key, &*requirement),
        ("framework", "{ workspace = true }")
    );
}
