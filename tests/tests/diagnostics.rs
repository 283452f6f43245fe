//! What an author reads when something is wrong: for each code a robot with one mistake in `tests/diagnostics/CODE`, its
//! whole report, and the same robot with the smallest repair.

use std::collections::BTreeSet;

use hulkgen::diagnostics::{self, Code, Diagnostics};
use hulkgen::pipeline;
use hulkgen::workspace::Workspace;
use support::{repaired_files, root, workspace_files};

/// What only rustc finds: `late.rs` of this folder builds robots that are told so.
const BY_RUSTC: [Code; 3] = [Code::LeftToRustc, Code::Rustc, Code::RustcWarning];

/// The codes that hulkgen finds itself.
fn own_codes() -> impl Iterator<Item = Code> {
    let all = Code::ALL.iter().copied();
    all.filter(|code| !BY_RUSTC.contains(code))
}

fn folder(code: Code) -> String {
    format!("tests/diagnostics/{}", code.name())
}

/// The codes of a robot in the order of the report, and the report.
fn report(files: Vec<(String, String)>) -> (Vec<&'static str>, String) {
    let workspace = Workspace::in_memory(files);
    let mut found = Diagnostics::new();
    let _understood = pipeline::understand(&workspace, &mut found);
    let codes = found.sorted().iter().map(|one| one.code.name()).collect();
    (codes, diagnostics::render(&found, &workspace, false))
}

#[test]
fn every_code_has_a_robot_that_is_told_about_it_first() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(root().join("snapshots/diagnostics"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    for code in own_codes() {
        let (codes, text) = report(workspace_files(&folder(code)));
        assert_eq!(codes.first(), Some(&code.name()), "{text}");
        assert!(text.contains("--> "), "no place in {text}");
        // What a parser expected is in its message.
        let has_deed = text.contains("help: ") || code == Code::Syntax;
        assert!(has_deed, "no deed in {text}");
        settings.bind(|| insta::assert_snapshot!(code.name(), text));
    }
}

#[test]
fn every_repaired_robot_is_clean() {
    for code in own_codes() {
        let (_, text) = report(repaired_files(&folder(code)));
        assert_eq!(text, "", "{}", code.name());
        let repaired = root().join(folder(code)).join("repaired");
        assert!(repaired.is_dir(), "{} is missing", repaired.display());
    }
}

#[test]
fn every_robot_and_report_and_page_is_of_a_code() {
    let names = |codes: &mut dyn Iterator<Item = Code>| -> BTreeSet<String> {
        codes.map(|one| one.name().to_owned()).collect()
    };
    let all = names(&mut Code::ALL.iter().copied());
    let own = names(&mut own_codes());
    for (folder, ending, codes) in [
        ("tests/diagnostics", "", &own),
        ("snapshots/diagnostics", ".snap", &own),
        ("docs/diagnostics", ".md", &all),
    ] {
        let entries = std::fs::read_dir(root().join(folder)).expect("the folder is there");
        let names = entries.map(|entry| {
            let entry = entry.expect("an entry of a folder that was just listed");
            let name = entry.file_name().to_string_lossy().into_owned();
            name.trim_end_matches(ending).to_owned()
        });
        assert_eq!(&names.collect::<BTreeSet<String>>(), codes, "{folder}");
    }
}

/// What stands in code blocks below a heading of a page, line by line.
fn example<'a>(page: &'a str, heading: &str) -> Vec<&'a str> {
    let below = page.split_once(heading).map(|(_, below)| below);
    let section = below.and_then(|below| below.split("\n## ").next());
    let mut is_code = false;
    let lines = section.unwrap_or_default().lines().filter(|line| {
        let is_fence = line.starts_with("```");
        is_code ^= is_fence;
        is_code && !is_fence && !line.contains('…') && !line.is_empty()
    });
    lines.collect()
}

#[test]
fn every_code_has_a_page_whose_example_is_its_robot() {
    for &code in Code::ALL {
        let page = code.page();
        let heading = format!("# {} ({})\n\n", code.name(), code.severity().name());
        assert!(page.starts_with(&heading), "{heading}");
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let title = page[heading.len()..].split("\n\n").next();
        assert_eq!(title.map(words).as_deref(), Some(code.title()));
        assert!(code.explanation().len() > 80, "{}", code.name());
        let why = page.split_once("## Why\n\n").map(|(_, why)| why);
        assert!(why.is_some_and(|why| why.len() > 30), "{}", code.name());
        if BY_RUSTC.contains(&code) {
            continue;
        }
        for (heading, files) in [
            ("## Wrong", workspace_files(&folder(code))),
            ("## Repaired", repaired_files(&folder(code))),
        ] {
            let lines = example(page, heading);
            assert!(!lines.is_empty(), "{}: {heading}", code.name());
            for line in lines {
                let is_there = files.iter().any(|(_, text)| text.contains(line.trim()));
                assert!(is_there, "{}: `{line}` is not in the robot", code.name());
            }
        }
    }
}

#[test]
fn the_fixture_robots_have_no_mistakes() {
    for name in support::FIXTURES {
        let workspace = support::fixture(name);
        let mut found = Diagnostics::new();
        let understood = pipeline::understand(&workspace, &mut found);
        let text = diagnostics::render(&found, &workspace, false);
        assert!(understood.is_ok() && !found.has_errors(), "{name}: {text}");
    }
}
