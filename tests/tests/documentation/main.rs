//! What the pages say, as far as a machine can judge it: links lead somewhere, commands are commands, code is code.

mod messages;
mod others;
mod page;
mod shell;
mod written;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::process::Command;

use camino::{Utf8Path, Utf8PathBuf};
use clap::{CommandFactory, Parser, error::ErrorKind};
use grammar::{ContextKind, is_context_attribute, parse_context};
use hulkgen::arguments::Arguments;
use hulkgen::commands;
use hulkgen::outcome::Outcome;
use page::{Block, Page};
use support::{root, skip, sources};
use syn::Item;

const AT_ROOT: [&str; 5] = [
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "README.md",
    "STYLE.md",
];
const SUMMARY: &str = "docs/SUMMARY.md";

/// Every page by its path.
fn pages() -> BTreeMap<Utf8PathBuf, Page> {
    let root = root();
    let read = |path: &str| fs::read_to_string(root.join(path)).expect("the page is there");
    let mut texts: BTreeMap<Utf8PathBuf, String> = AT_ROOT
        .iter()
        .map(|path| (Utf8PathBuf::from(path), read(path)))
        .collect();
    // What hulkgen writes beside an example is no page.
    let docs = sources(&["docs"], ".md").into_iter();
    let docs = docs.filter(|page| !page.path.contains("/generated/"));
    texts.extend(docs.map(|page| (page.path.into(), page.text)));
    let parsed = texts.into_iter().map(|(path, text)| {
        let page = Page::parse(&text);
        (path, page)
    });
    parsed.collect()
}

/// Pages whose code is judged by a test of its own: `diagnostics.rs` compares it with the robots that it is cut from.
fn is_of_robots(path: &Utf8Path) -> bool {
    path.starts_with("docs/diagnostics")
}

/// Every block with its place.
fn blocks<'a>(
    pages: &'a BTreeMap<Utf8PathBuf, Page>,
    language: &'a str,
) -> impl Iterator<Item = (String, &'a Block)> {
    let own = pages.iter().filter(|(path, _)| !is_of_robots(path));
    let blocks = own.flat_map(|(path, page)| page.blocks.iter().map(move |block| (path, block)));
    let blocks = blocks.filter(move |(_, block)| block.language == language);
    blocks.map(|(path, block)| (format!("{path}:{}", block.line), block))
}

/// A path without `.` and `..`.
fn straight(path: &Utf8Path) -> Utf8PathBuf {
    let mut straight = Utf8PathBuf::new();
    for part in path.components() {
        match part.as_str() {
            "." => {}
            ".." => assert!(straight.pop(), "{path} leads out of the repository"),
            part => straight.push(part),
        }
    }
    straight
}

#[track_caller]
fn assert_none(what: &str, wrong: &[String]) {
    assert!(wrong.is_empty(), "{what}:\n{}", wrong.join("\n"));
}

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let (pages, mut wrong, mut followed) = (pages(), Vec::new(), 0);
    for (path, page) in &pages {
        let folder = path.parent().expect("a page lies in a folder");
        for link in &page.links {
            let place = format!("{path}:{}: {}", link.line, link.target);
            if link.target.contains("://") {
                continue;
            }
            followed += 1;
            let (file, anchor) = link.target.split_once('#').unwrap_or((&link.target, ""));
            let target = match file {
                "" => path.clone(),
                file => straight(&folder.join(file)),
            };
            if !root().join(&target).exists() {
                wrong.push(format!("{place}: there is no {target}"));
            } else if !anchor.is_empty() {
                let anchors = pages.get(&target).map(|page| &page.anchors);
                if !anchors.is_some_and(|anchors| anchors.contains(anchor)) {
                    wrong.push(format!("{place}: {target} has no such heading"));
                }
            }
        }
    }
    assert_none("links that lead nowhere", &wrong);
    assert!(followed > 100, "only {followed} links");
}

/// `[`name`](file)` says that the name is found there.
#[test]
fn code_that_is_a_link_stands_in_the_file_to_which_it_leads() {
    let (mut wrong, mut found) = (Vec::new(), 0);
    for (path, page) in &pages() {
        let folder = path.parent().expect("a page lies in a folder");
        for link in &page.links {
            let Some(code) = &link.code else { continue };
            let target = straight(&folder.join(&link.target));
            let Ok(text) = fs::read_to_string(root().join(&target)) else {
                continue;
            };
            found += 1;
            if !text.contains(code) && !target.as_str().ends_with(code) {
                wrong.push(format!("{path}:{}: {target} has no `{code}`", link.line));
            }
        }
    }
    assert_none("names that stand elsewhere", &wrong);
    assert!(found > 20, "only {found} names");
}

#[test]
fn the_summary_has_every_page_once() {
    let pages = pages();
    let summary = &pages[Utf8Path::new(SUMMARY)];
    let linked: Vec<Utf8PathBuf> = summary
        .links
        .iter()
        .map(|link| Utf8Path::new("docs").join(&link.target))
        .collect();
    let once: BTreeSet<&Utf8PathBuf> = linked.iter().collect();
    assert_eq!(once.len(), linked.len(), "a page stands twice in {SUMMARY}");
    let in_docs = pages.keys().filter(|path| path.starts_with("docs"));
    let in_docs: BTreeSet<&Utf8PathBuf> = in_docs.filter(|path| *path != SUMMARY).collect();
    assert_eq!(once, in_docs, "{SUMMARY} on the left, docs/ on the right");
}

#[test]
fn every_page_of_the_docs_has_an_example() {
    let pages = pages();
    let in_docs = pages.iter().filter(|(path, _)| path.starts_with("docs"));
    let without = in_docs.filter(|(path, page)| *path != SUMMARY && page.blocks.is_empty());
    let without: Vec<String> = without.map(|(path, _)| path.to_string()).collect();
    assert_none("pages without an example", &without);
}

/// Lines of a page that a screen shows at once, pictures apart.
const FIRST_SCREEN: usize = 50;

#[test]
fn the_first_screen_shows_the_page_a_generated_diff_and_two_commands() {
    let pages = pages();
    let readme = &pages[Utf8Path::new("README.md")];
    let mut links = readme.links.iter();
    let picture = links.find(|link| link.target == "docs/page/game.webp");
    assert!(picture.is_some_and(|link| link.line < FIRST_SCREEN));
    let block = |language: &str| {
        let mut blocks = readme.blocks.iter();
        let block = blocks.find(|block| block.language == language);
        block.filter(|block| block.line < FIRST_SCREEN)
    };
    assert!(block("diff").is_some());
    let commands = block("sh").map(|block| block.text.as_str());
    let both = "cargo run --release -- run\ncargo test --workspace\n";
    assert_eq!(commands, Some(both));
}

#[test]
fn every_command_of_a_page_is_one_that_hulkgen_understands() {
    let (pages, mut wrong, mut understood) = (pages(), Vec::new(), 0);
    for (place, block) in blocks(&pages, "sh") {
        for words in shell::calls(&block.text) {
            match Arguments::try_parse_from(&words) {
                Err(error) if error.kind() != ErrorKind::DisplayHelp => {
                    wrong.push(format!("{place}: {}\n{error}", words.join(" ")));
                }
                _ => understood += 1,
            }
        }
    }
    assert_none("commands that hulkgen does not understand", &wrong);
    assert!(understood > 80, "only {understood} commands");
}

#[test]
fn every_other_command_names_what_there_is() {
    let (pages, named, mut wrong, mut known) = (pages(), others::Named::load(), Vec::new(), 0);
    for (place, block) in blocks(&pages, "sh") {
        for command in shell::others(&block.text) {
            let objection = named.objection(&command);
            known += usize::from(objection.is_none());
            let line = |objection| format!("{place}: {}: {objection}", command.join(" "));
            wrong.extend(objection.map(line));
        }
    }
    assert_none("commands that nothing answers", &wrong);
    assert!(known > 30, "only {known} commands");
}

#[test]
fn every_block_of_python_can_be_parsed() {
    let name = "every_block_of_python_can_be_parsed";
    let pages = pages();
    let mut parsed = 0;
    for (place, block) in blocks(&pages, "python") {
        let program = "import ast, sys; ast.parse(sys.argv[1])";
        let python = Command::new("python3")
            .args(["-c", program, &block.text])
            .output();
        let Ok(output) = python else {
            return skip(name, "install Python 3");
        };
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{place}: {error}");
        parsed += 1;
    }
    assert!(parsed > 1, "only {parsed} blocks");
}

#[test]
fn commands_that_sentences_name_are_commands() {
    let command = Arguments::command();
    let mut wrong = Vec::new();
    for (path, page) in &pages() {
        for (line, code) in &page.code {
            let Some(words) = code.strip_prefix("hulkgen ") else {
                continue;
            };
            let name = words.split([' ', '|', '/']).next().unwrap_or_default();
            let is_one = command.find_subcommand(name).is_some() || name.starts_with('-');
            if name
                .chars()
                .all(|one| one.is_ascii_lowercase() || one == '-')
                && !is_one
            {
                wrong.push(format!("{path}:{line}: `{code}`"));
            }
        }
    }
    assert_none("commands that there are not", &wrong);
}

#[test]
fn every_block_says_what_it_is() {
    let known = [
        "sh",
        "toml",
        "json",
        "rust",
        "rust,ignore",
        "text",
        "diff",
        "python",
    ];
    let (pages, mut wrong) = (pages(), Vec::new());
    for (path, page) in &pages {
        let unknown = page.blocks.iter();
        let unknown = unknown.filter(|block| !known.contains(&block.language.as_str()));
        wrong.extend(unknown.map(|block| format!("{path}:{}: {:?}", block.line, block.language)));
    }
    assert_none("blocks of no known language", &wrong);
}

#[test]
fn every_block_of_data_can_be_read() {
    let pages = pages();
    let mut wrong = Vec::new();
    for (place, block) in blocks(&pages, "toml") {
        if let Err(error) = block.text.parse::<toml::Table>() {
            wrong.push(format!("{place}: {error}"));
        }
    }
    for (place, block) in blocks(&pages, "json") {
        let values = serde_json::Deserializer::from_str(&block.text).into_iter();
        let values: Result<Vec<serde_json::Value>, _> = values.collect();
        wrong.extend(values.err().map(|error| format!("{place}: {error}")));
    }
    assert_none("data that cannot be read", &wrong);
}

#[test]
fn every_block_of_rust_is_rust_and_its_contexts_are_contexts() {
    let (pages, mut wrong, mut contexts) = (pages(), Vec::new(), 0);
    for (place, block) in blocks(&pages, "rust") {
        let file = match syn::parse_file(&block.text) {
            Ok(file) => file,
            Err(error) => {
                wrong.push(format!(
                    "{place}: {error}; a part of a file is `rust,ignore`"
                ));
                continue;
            }
        };
        for item in &file.items {
            let Item::Struct(item) = item else { continue };
            if !item.attrs.iter().any(is_context_attribute) {
                continue;
            }
            match parse_context(item) {
                Some((_, mistakes)) => {
                    contexts += 1;
                    wrong.extend(
                        mistakes
                            .iter()
                            .map(|one| format!("{place}: {}", one.message)),
                    );
                }
                None => wrong.push(format!("{place}: `{}` is no context", item.ident)),
            }
        }
    }
    assert_none("Rust that is none", &wrong);
    assert!(contexts > 30, "only {contexts} contexts");
}

/// The kinds of the grammar, each with the contexts in which it has a meaning.
fn kinds() -> BTreeSet<(String, String)> {
    let of = |context, name: &str| {
        let kinds = grammar::kinds(context).map(move |kind| (kind, name.to_owned()));
        kinds.collect::<Vec<_>>()
    };
    let creation = of(ContextKind::Creation, "creation");
    let cycle = of(ContextKind::Cycle, "cycle");
    let outputs = of(ContextKind::MainOutputs, "outputs");
    let all = creation.into_iter().chain(cycle).chain(outputs);
    all.map(|(kind, context)| (kind.to_owned(), context))
        .collect()
}

#[test]
fn tables_of_kinds_have_every_kind_where_it_has_a_meaning() {
    for path in ["docs/reference/fields.md", "docs/contract.md"] {
        let text = fs::read_to_string(root().join(path)).expect("the page is there");
        let rows = text
            .lines()
            .skip_while(|line| !line.starts_with("| Kind |"));
        let rows = rows.skip(2).take_while(|line| line.starts_with('|'));
        let mut told = BTreeSet::new();
        for row in rows {
            let mut cells = row.split('|').skip(1);
            let (kind, contexts) = (cells.next().unwrap_or(""), cells.next().unwrap_or(""));
            let kind = kind.trim().trim_matches('`');
            let kind = kind.split('<').next().unwrap_or(kind).to_owned();
            let words = contexts.split(|one: char| !one.is_ascii_lowercase());
            let contexts = words.filter(|word| ["creation", "cycle", "outputs"].contains(word));
            told.extend(contexts.map(|context| (kind.clone(), context.to_owned())));
        }
        assert_eq!(
            told,
            kinds(),
            "{path} on the left, the grammar on the right"
        );
    }
}

#[test]
fn pages_of_the_reference_are_current() {
    let is_update = std::env::var("INSTA_UPDATE").is_ok_and(|value| value == "always");
    for (path, text) in written::pages() {
        let path = root().join(path);
        if is_update {
            fs::write(&path, &text).expect("the repository can be written");
        }
        let is = fs::read_to_string(&path).unwrap_or_default();
        let stale = format!(
            "{} is stale: `INSTA_UPDATE=always` writes it",
            path.display()
        );
        assert!(is == text, "{stale}");
    }
}

/// A number from 20 to 99 in words.
fn in_words(number: usize) -> String {
    let tens = [
        "twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety",
    ];
    let ones = [
        "", "-one", "-two", "-three", "-four", "-five", "-six", "-seven", "-eight", "-nine",
    ];
    format!("{}{}", tens[number / 10 - 2], ones[number % 10])
}

#[test]
fn pages_count_the_nodes_of_the_nao_as_its_manifest_does() {
    let read = |path: &str| fs::read_to_string(root().join(path)).expect("it is there");
    let manifest: toml::Table = read("hulk.toml").parse().expect("it is TOML");
    let cyclers = manifest["cycler"].as_array().expect("there are cyclers");
    let lists = cyclers
        .iter()
        .flat_map(|one| [one.get("setup_nodes"), one.get("nodes")]);
    let nodes = lists.flatten().filter_map(toml::Value::as_array).flatten();
    let paths = nodes.filter_map(|node| node.as_str().or_else(|| node.get("node")?.as_str()));
    let count = paths.collect::<BTreeSet<_>>().len();
    let told = [
        ("README.md", format!("{} nodes", in_words(count))),
        ("docs/nao.md", format!("{} nodes", in_words(count))),
        ("docs/tutorial.md", format!("{count} nodes")),
    ];
    for (page, told) in told {
        assert!(read(page).contains(&told), "{page} does not say {told:?}");
    }
}

/// The block of a page that has this line.
fn block_of<'a>(page: &'a Page, line: &str) -> &'a str {
    let mut blocks = page.blocks.iter();
    let block = blocks.find(|block| block.text.lines().any(|one| one == line));
    &block
        .unwrap_or_else(|| panic!("no block has {line:?}"))
        .text
}

/// hulkgen in this process.
#[track_caller]
fn hulkgen(robot: &Utf8Path, words: &[&str]) -> Outcome {
    let words = ["hulkgen", "--manifest", robot.as_str()]
        .into_iter()
        .chain(words.iter().copied());
    commands::run(&Arguments::try_parse_from(words).expect("it is a command"))
}

#[test]
fn the_tutorial_leads_to_a_robot_without_mistakes() {
    let pages = pages();
    let tutorial = &pages[Utf8Path::new("docs/tutorial.md")];
    let folder = tempfile::tempdir().expect("a temporary folder");
    let robot = Utf8Path::from_path(folder.path())
        .expect("its path is UTF-8")
        .join("scout");
    let (framework, path) = (root().display().to_string(), robot.as_str());
    let good = Outcome::Good;
    assert_eq!(
        hulkgen(&robot, &["new", path, "--framework", &framework]),
        good
    );
    let added = [
        "add-node",
        "nodes::control::speed_ramp",
        "--cycler",
        "Control",
    ];
    assert_eq!(hulkgen(&robot, &added), good);

    let edit = |file: &str, from: &str, to: &str| {
        let file = robot.join(file);
        let text = fs::read_to_string(&file).expect("the robot has it");
        assert_eq!(text.matches(from).count(), 1, "{from:?} in {file}");
        fs::write(&file, text.replace(from, to)).expect("the folder is ours");
    };
    let node = "//! Changes the speed so slowly that nothing on the robot falls over.";
    let node = block_of(tutorial, node);
    fs::write(robot.join("nodes/src/control/speed_ramp.rs"), node).expect("the folder is ours");
    let reading = "    wheel_speed: RequiredInput<Option<f32>, \"ramped_speed?\">,";
    let reading = block_of(tutorial, reading);
    let before = reading.replace("ramped_speed?", "wheel_speed?");
    edit("nodes/src/control/wheel_sender.rs", &before, reading);
    assert_eq!(
        hulkgen(&robot, &["check"]),
        Outcome::Bad,
        "it lacks a value"
    );
    let value = block_of(tutorial, "[speed_ramp]");
    let comment = "# Belongs to the hardware";
    edit(
        "parameters/default.toml",
        comment,
        &format!("{value}\n{comment}"),
    );
    assert_eq!(hulkgen(&robot, &["check", "--deny-warnings"]), good);
    assert_eq!(hulkgen(&robot, &["generate"]), good);
    let generated = fs::read_to_string(robot.join("generated/src/cyclers/control.rs"));
    let generated = generated.expect("it was just generated");
    let readme = &pages[Utf8Path::new("README.md")];
    for page in [tutorial, readme] {
        let diff = block_of(page, "+        self.speed_ramp(frame)?;");
        for hunk in diff.split("@@\n") {
            let after: String = hunk
                .lines()
                .map(|line| format!("{}\n", &line[1..]))
                .collect();
            assert!(generated.contains(&after), "{after}\n{generated}");
        }
    }

    let broken = "    obstacles: PerceptionInput<Option<Obstacle>, \"Perception\", \"obstacle\">,";
    let reading = block_of(tutorial, broken);
    let text = fs::read_to_string(robot.join("nodes/src/control/speed_choice.rs"));
    assert!(
        text.expect("the robot has it").contains(reading),
        "{reading}"
    );
}
