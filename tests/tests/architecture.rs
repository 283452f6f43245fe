//! What the house promises about its own sources.

use std::collections::BTreeMap;

use support::{Source, sources};
use syn::spanned::Spanned as _;
use syn::visit::Visit;

/// Folders with code written by hand.
const HAND_WRITTEN: &[&str] = &["cli", "framework", "robotics", "schema", "templates", "web"];

fn is_test(source: &Source) -> bool {
    let parts = ["/tests/", "/benches/", "/tests.rs", "/fixture.rs"];
    parts.iter().any(|part| source.path.contains(part))
}

#[test]
fn no_file_is_longer_than_500_lines() {
    let long: Vec<_> = sources(HAND_WRITTEN, ".rs")
        .into_iter()
        .filter(|source| !is_test(source))
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
        let file = syn::parse_file(&source.text)
            .unwrap_or_else(|error| panic!("{}: {error}", source.path));
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
}

#[test]
fn generated_files_say_who_wrote_them() {
    let silent: Vec<_> = sources(&["generated", "tests/robots/zoo/generated"], ".rs")
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
    for source in sources(&["generated", "tests/robots/zoo/generated"], ".rs") {
        assert!(
            !source.text.contains("#[allow"),
            "{} allows a lint",
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
    "model",
    "render",
];

#[test]
fn a_stage_imports_only_earlier_stages() {
    let mut backwards = Vec::new();
    for source in sources(&["cli/src"], ".rs") {
        if is_test(&source) {
            continue;
        }
        let Some(own) = STAGES
            .iter()
            .position(|stage| stage_of(&source.path) == *stage)
        else {
            continue;
        };
        for (number, line) in source.text.lines().enumerate() {
            for (position, stage) in STAGES.iter().enumerate() {
                let later = position > own && line.contains(&format!("crate::{stage}::"));
                let behind_the_model = STAGES[own] == "render"
                    && position < own - 1
                    && line.contains(&format!("crate::{stage}::"));
                if later || behind_the_model {
                    backwards.push(format!("{}:{}: {}", source.path, number + 1, line.trim()));
                }
            }
        }
    }
    assert!(
        backwards.is_empty(),
        "against the direction of the data: {backwards:#?}"
    );
}

fn stage_of(path: &str) -> &str {
    let below = path.trim_start_matches("cli/src/");
    below.split(['/', '.']).next().unwrap_or_default()
}

#[test]
fn only_the_two_doors_touch_the_disk() {
    const DOORS: &[&str] = &["workspace", "drift", "commands"];
    let others: Vec<_> = sources(&["cli/src"], ".rs")
        .into_iter()
        .filter(|source| !DOORS.contains(&stage_of(&source.path)))
        .filter(|source| source.text.contains("std::fs") || source.text.contains("File::open"))
        .map(|source| source.path)
        .collect();
    assert!(
        others.is_empty(),
        "the disk is read or written in {others:#?}"
    );
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
fn unsafe_code_stands_only_where_the_workspace_says() {
    const UNSAFE: &[&str] = &["framework/src/buffer/slots.rs"];
    let others: Vec<_> = sources(HAND_WRITTEN, ".rs")
        .into_iter()
        .filter(|source| !is_test(source))
        .filter(|source| source.text.contains("unsafe {") || source.text.contains("unsafe impl"))
        .filter(|source| {
            !UNSAFE
                .iter()
                .any(|allowed| source.path.starts_with(allowed))
        })
        .map(|source| source.path)
        .collect();
    assert!(others.is_empty(), "unsafe code in {others:#?}");
}
