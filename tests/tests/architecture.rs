//! What the house promises about its own sources.

use std::collections::BTreeMap;

use support::{Source, root, sources};
use syn::spanned::Spanned as _;
use syn::visit::Visit;

/// Folders with code written by hand.
const HAND_WRITTEN: &[&str] = &[
    "cli",
    "docs/examples/rover/base",
    "docs/examples/rover/nodes",
    "docs/examples/rover/simulation",
    "docs/examples/sprinkler/garden",
    "docs/examples/sprinkler/nodes",
    "docs/examples/timing/hardware",
    "docs/examples/timing/nodes",
    "framework",
    "robotics",
    "schema",
    "templates",
    "web",
];

/// Crates that hulkgen wrote.
const GENERATED: &[&str] = &[
    "docs/examples/rover/generated",
    "docs/examples/sprinkler/generated",
    "docs/examples/timing/generated",
    "generated",
    "tests/robots/k1/generated",
    "tests/robots/outpost/generated",
    "tests/robots/zoo/generated",
    "tests/robots/zoo/generated-control",
    "tests/robots/zoo/generated-vision-reflexes-lights",
];

fn is_test(source: &Source) -> bool {
    let parts = ["/tests/", "/benches/", "/tests.rs", "/fixture.rs"];
    parts.iter().any(|part| source.path.contains(part))
}

#[test]
fn no_file_is_longer_than_500_lines() {
    let page = [".ts", ".css"].map(|ending| sources(&["web/page/src"], ending));
    let long: Vec<_> = sources(HAND_WRITTEN, ".rs")
        .into_iter()
        .filter(|source| !is_test(source))
        .chain(page.into_iter().flatten())
        // Written from the schemas of the protocol.
        .filter(|source| source.path != "web/page/src/protocol.ts")
        .map(|source| (source.text.lines().count(), source.path))
        .filter(|(lines, _)| *lines > 500)
        .collect();
    assert!(long.is_empty(), "split by idea: {long:#?}");
}

#[test]
fn no_function_is_longer_than_80_lines() {
    #[derive(Default)]
    struct Functions {
        long: Vec<(String, usize)>,
    }
    impl Functions {
        fn measure(&mut self, name: &syn::Ident, block: &syn::Block) {
            let span = block.span();
            let lines = span.end().line - span.start().line + 1;
            if lines > 80 {
                self.long.push((name.to_string(), lines));
            }
        }
    }
    impl<'ast> Visit<'ast> for Functions {
        fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
            self.measure(&function.sig.ident, &function.block);
            syn::visit::visit_item_fn(self, function);
        }
        fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
            self.measure(&function.sig.ident, &function.block);
            syn::visit::visit_impl_item_fn(self, function);
        }
    }
    let mut long = BTreeMap::new();
    for source in sources(HAND_WRITTEN, ".rs")
        .into_iter()
        .filter(|source| !is_test(source))
    {
        let file = parse(&source);
        let mut functions = Functions::default();
        functions.visit_file(&file);
        if !functions.long.is_empty() {
            long.insert(source.path, functions.long);
        }
    }
    assert!(long.is_empty(), "too long: {long:#?}");
}

#[test]
fn every_module_says_what_it_owns() {
    let silent: Vec<_> = sources(HAND_WRITTEN, ".rs")
        .into_iter()
        .filter(|source| !source.text.trim_start().starts_with("//!"))
        .map(|source| source.path)
        .collect();
    assert!(silent.is_empty(), "no `//!` in {silent:#?}");
    let silent: Vec<_> = sources(&["web/page/src"], ".ts")
        .into_iter()
        .filter(|source| !source.text.starts_with("//"))
        .map(|source| source.path)
        .collect();
    assert!(silent.is_empty(), "no comment at the top of {silent:#?}");
}

#[test]
fn generated_files_say_who_wrote_them() {
    let silent: Vec<_> = sources(GENERATED, ".rs")
        .into_iter()
        .filter(|source| {
            !source.text.lines().take(4).any(|line| {
                line == "//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit."
            })
        })
        .map(|source| source.path)
        .collect();
    assert!(silent.is_empty(), "no header in {silent:#?}");
}

#[test]
fn generated_code_suppresses_no_lint() {
    for source in sources(GENERATED, ".rs") {
        assert!(
            !source.text.contains("#[allow"),
            "{} allows a lint",
            source.path
        );
        assert!(
            !source.text.contains("[expect("),
            "{} expects a lint",
            source.path
        );
        assert!(
            !source.text.contains("#![allow"),
            "{} allows a lint",
            source.path
        );
    }
}

/// The stages in the order of the data.
const STAGES: &[&str] = &[
    "workspace",
    "manifest",
    "scan",
    "resolve",
    "schedule",
    "partial",
    "model",
    "render",
    "drift",
];

#[test]
fn a_stage_imports_only_earlier_stages() {
    let mut backwards = Vec::new();
    for source in sources(&["cli/src"], ".rs") {
        let Some(own) = STAGES
            .iter()
            .position(|stage| stage_of(&source.path) == *stage)
        else {
            continue;
        };
        if is_test(&source) {
            continue;
        }
        for stage in imported_modules(&source) {
            let Some(other) = STAGES.iter().position(|known| *known == stage) else {
                continue;
            };
            // Rendering reads the model and nothing before it; only the drift reads what was rendered.
            let behind_the_model = STAGES[own] == "render" && STAGES[other] != "model";
            if other > own || (behind_the_model && other != own) {
                backwards.push(format!("{} imports {stage}", source.path));
            }
        }
    }
    assert!(
        backwards.is_empty(),
        "against the direction of the data: {backwards:#?}"
    );
}

/// The modules of the crate's root that a file imports or names by path.
fn imported_modules(source: &Source) -> Vec<String> {
    #[derive(Default)]
    struct Imports(Vec<String>);
    impl Imports {
        fn below_the_root(&mut self, tree: &syn::UseTree) {
            match tree {
                syn::UseTree::Path(path) => self.0.push(path.ident.to_string()),
                syn::UseTree::Name(name) => self.0.push(name.ident.to_string()),
                syn::UseTree::Rename(rename) => self.0.push(rename.ident.to_string()),
                syn::UseTree::Group(group) => {
                    group
                        .items
                        .iter()
                        .for_each(|tree| self.below_the_root(tree));
                }
                syn::UseTree::Glob(_) => self.0.push("*".to_owned()),
            }
        }
    }
    impl<'ast> Visit<'ast> for Imports {
        fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
            if let syn::UseTree::Path(path) = &item.tree
                && path.ident == "crate"
            {
                self.below_the_root(&path.tree);
            }
        }
        fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
            if module.ident != "tests" {
                syn::visit::visit_item_mod(self, module);
            }
        }
        fn visit_path(&mut self, path: &'ast syn::Path) {
            let mut segments = path
                .segments
                .iter()
                .map(|segment| segment.ident.to_string());
            if segments.next().as_deref() == Some("crate") {
                self.0.extend(segments.next());
            }
            syn::visit::visit_path(self, path);
        }
    }
    let mut imports = Imports::default();
    imports.visit_file(&parse(source));
    assert!(
        !imports.0.contains(&"*".to_owned()),
        "{} imports everything",
        source.path
    );
    imports.0
}

fn parse(source: &Source) -> syn::File {
    syn::parse_file(&source.text).unwrap_or_else(|error| panic!("{}: {error}", source.path))
}

fn stage_of(path: &str) -> &str {
    let below = path.trim_start_matches("cli/src/");
    below.split(['/', '.']).next().unwrap_or_default()
}

/// The code map tells which crate uses which; it may not forget one.
#[test]
fn the_code_map_has_every_crate_with_those_that_it_uses() {
    let read = |path: &str| std::fs::read_to_string(root().join(path)).expect("it is there");
    let table = |path: &str| read(path).parse::<toml::Table>().expect("it is TOML");
    let page = read("ARCHITECTURE.md");
    let code = |cell: &str| -> Vec<String> {
        let names = cell.split('`').skip(1).step_by(2);
        names.map(str::to_owned).collect()
    };
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `"));
    let told: BTreeMap<String, Vec<String>> = rows
        .map(|row| row.split('|').map(code).collect::<Vec<_>>())
        .filter_map(|cells| Some((cells.get(1)?.first()?.clone(), cells.get(2)?.clone())))
        .filter(|(name, _)| name.starts_with("hulkgen") && name != "hulkgen-tests")
        .collect();

    let workspace = table("Cargo.toml");
    let members = workspace["workspace"]["members"].as_array();
    let members = members
        .expect("a list")
        .iter()
        .filter_map(|one| one.as_str());
    let manifests = members.map(|member| table(&format!("{member}/Cargo.toml")));
    let mut found = BTreeMap::new();
    for manifest in manifests {
        let name = manifest["package"]["name"].as_str().expect("a name");
        if !name.starts_with("hulkgen") || name == "hulkgen-tests" {
            continue;
        }
        let uses = manifest.get("dependencies").and_then(toml::Value::as_table);
        let uses = uses.into_iter().flatten().map(|(name, _)| name.as_str());
        let uses = uses.filter_map(|name| match name {
            "framework" => Some("hulkgen-framework".to_owned()),
            name => name.starts_with("hulkgen").then(|| name.to_owned()),
        });
        found.insert(name.to_owned(), uses.collect::<Vec<_>>());
    }
    assert_eq!(
        told, found,
        "ARCHITECTURE.md on the left, Cargo.toml on the right"
    );
}

#[test]
fn only_the_doors_touch_the_disk() {
    /// Whoever reads or writes files uses one of these.
    const READING: &[&str] = &[
        "fs::read",
        "fs::metadata",
        "symlink_metadata",
        "File::open",
        "read_dir",
        "is_dir()",
        "canonicalize",
    ];
    const WRITING: &[&str] = &[
        "fs::write",
        "fs::remove",
        "create_dir",
        "File::create",
        "tempfile",
        "fs::rename",
    ];
    let mut trespassers = Vec::new();
    for source in sources(&["cli/src"], ".rs")
        .into_iter()
        .filter(|source| !is_test(source))
    {
        // There they are names that a node may not use.
        let is_list = source.path == "cli/src/scan/nondeterminism/sources.rs";
        let uses = |words: &[&str]| !is_list && words.iter().any(|word| source.text.contains(word));
        let (reads, writes) = (uses(READING), uses(WRITING));
        // Which manifest is meant is asked of the disk before there is a workspace.
        let reads = reads && source.path != "cli/src/commands/session.rs";
        let stage = stage_of(&source.path);
        // The cache has a folder of its own, outside of the robot's; so have the tools that build for other machines, and
        // the programs that they built are read, too. Recordings are no files of the robot; what is sent to robots is
        // collected in a temporary folder.
        let may_write = ["drift", "cache", "cross", "recording", "deploy"].contains(&stage);
        let may_read = may_write || stage == "workspace";
        if writes && !may_write || reads && !may_read {
            trespassers.push(source.path);
        }
    }
    assert!(
        trespassers.is_empty(),
        "the disk is touched in {trespassers:#?}"
    );
}

#[test]
fn only_commands_ask_the_cache() {
    let asking: Vec<_> = sources(&["cli/src"], ".rs")
        .into_iter()
        .filter(|source| !["cache", "commands"].contains(&stage_of(&source.path)))
        .filter(|source| imported_modules(source).contains(&"cache".to_owned()))
        .map(|source| source.path)
        .collect();
    assert!(asking.is_empty(), "{asking:#?} know earlier answers");
}

#[test]
fn only_commands_print() {
    let printing: Vec<_> = sources(&["cli/src"], ".rs")
        .into_iter()
        .filter(|source| !is_test(source))
        .filter(|source| !["commands", "main", "outcome"].contains(&stage_of(&source.path)))
        .filter(|source| {
            ["println!", "print!(", "eprint", "io::stdout", "io::stderr"]
                .iter()
                .any(|word| source.text.contains(word))
        })
        .map(|source| source.path)
        .collect();
    assert!(printing.is_empty(), "{printing:#?} print");
}

#[test]
fn the_framework_knows_no_robot() {
    const FOREIGN: &[&str] = &["nao", "football", "soccer", "ball", "lola", "robocup"];
    let mut named = Vec::new();
    for source in sources(
        &[
            "framework/src",
            "framework/grammar/src",
            "framework/macros/src",
        ],
        ".rs",
    ) {
        for (number, line) in source.text.lines().enumerate() {
            let words = line.split(|character: char| !character.is_alphanumeric());
            for word in words.filter(|word| FOREIGN.contains(&word.to_lowercase().as_str())) {
                named.push(format!("{}:{}: {word}", source.path, number + 1));
            }
        }
    }
    assert!(named.is_empty(), "the framework names {named:#?}");
}

#[test]
fn unsafe_code_stands_only_where_the_workspace_says_and_runs_under_the_sanitizer() {
    const UNSAFE: [&str; 5] = [
        "framework/src/buffer/slots.rs",
        "framework/src/timing/allocations.rs",
        "framework/src/timing/ticks.rs",
        "robotics/nao/src/kernel.rs",
        "robotics/nao/src/sound/library.rs",
    ];
    let mut paths: Vec<_> = sources(HAND_WRITTEN, ".rs")
        .into_iter()
        .filter(|source| !is_test(source))
        .filter(|source| {
            ["unsafe {", "unsafe impl", "unsafe fn", "unsafe trait"]
                .iter()
                .any(|word| source.text.contains(word))
        })
        .map(|source| source.path)
        .collect();
    paths.sort();
    assert_eq!(paths, UNSAFE, "unsafe code");
    let sanitized = sources(&["framework/tests/sanitized"], ".rs");
    let script = std::fs::read_to_string(root().join(".ci/sanitize")).expect("it is there");
    for path in UNSAFE {
        let is_sanitized = match path.strip_prefix("robotics/") {
            Some(rest) => {
                let (name, _) = rest.split_once('/').expect("it is in a crate");
                script.contains(&format!("/robotics/{name}/src/lib.rs"))
            }
            None => {
                let (_, file) = path.rsplit_once('/').expect("it is in a folder");
                let module = format!("mod {};", file.trim_end_matches(".rs"));
                let includes = |source: &Source| source.text.contains(&module);
                sanitized.iter().any(includes)
            }
        };
        assert!(is_sanitized, "{path} is not sanitized");
    }
}

/// Clippy reads the nearest clippy.toml alone.
#[test]
fn robotics_has_the_rules_of_the_workspace_and_those_for_its_numbers() {
    let rules = |path: &str, key: &str| -> BTreeMap<String, String> {
        let text = std::fs::read_to_string(support::root().join(path)).expect("it is there");
        let table: toml::Table = text.parse().expect("it is TOML");
        let rules = table[key].as_array().expect("rules are a list");
        let said = |rule: &toml::Value, what: &str| rule[what].as_str().expect("text").to_owned();
        rules
            .iter()
            .map(|rule| (said(rule, "path"), said(rule, "reason")))
            .collect()
    };
    let here = rules("robotics/clippy.toml", "disallowed-types");
    for (path, reason) in rules("clippy.toml", "disallowed-types") {
        assert_eq!(
            here.get(&path),
            Some(&reason),
            "{path} in robotics/clippy.toml"
        );
    }

    let methods = rules("robotics/clippy.toml", "disallowed-methods");
    let math = std::fs::read_to_string(support::root().join("framework/src/math.rs")).unwrap();
    // `    sin(angle) = sinf, sin;`
    let mut names: Vec<_> = math
        .lines()
        .filter_map(|line| {
            line.strip_prefix("    ")?
                .strip_suffix(';')?
                .split_once(") = ")
        })
        .filter_map(|(declared, _)| Some(declared.split_once('(')?.0))
        .collect();
    assert!(names.len() >= 20, "{names:?}");
    names.extend(["powi", "sin_cos"]);
    for name in names {
        for float in ["f32", "f64"] {
            let reason = methods.get(&format!("{float}::{name}"));
            let deed = format!("use `framework::math::{name}`");
            let says_so = reason.is_some_and(|reason| reason.contains(&deed));
            assert!(says_so, "{float}::{name} in robotics/clippy.toml");
        }
    }
}
