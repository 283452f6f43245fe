//! Bad input in masses: whatever stands in a manifest, a node file or a parameter file, hulkgen answers and does not panic.
//!
//! Every file of `tests/corpus/` is replayed as it is and in mutations that are the same in every run; more of them with
//! `HULKGEN_FUZZ=executions`.

use std::fs;
use std::time::{Duration, Instant};

use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::pipeline;
use hulkgen::workspace::Workspace;
use support::{fixture_files, root};

/// Mutations of one corpus in a run of `cargo test`.
const EXECUTIONS: u64 = 300;

/// No honest or broken input of a few kilobytes takes as long.
const SLOWEST: Duration = Duration::from_secs(10);

/// As the binary: as deep as the scanner permits.
const STACK: usize = 256 << 20;

/// What mutations put in: words that mean something, and characters that break something.
const WORDS: &[&str] = &[
    "",
    "\"",
    "'",
    "{",
    "}",
    "[",
    "]",
    "(",
    ")",
    "<",
    ">",
    "?",
    ".",
    "::",
    "$cycler_instance",
    "Option<",
    "&",
    "#",
    "//",
    "/*",
    "\n",
    "\0",
    "ä",
    "🤖",
    "\u{feff}",
    "\u{202e}",
    "r#type",
    "self",
    "super",
    "crate",
    "pub use *;",
    "=",
    "==",
    "-1",
    "1e999",
    "18446744073709551616",
    "Input<u64, \"count\">",
    "[[cycler]]",
    "name",
    "nodes::node",
    "inf",
    "nan",
    "1979-05-27",
    "'''",
    "\"\"\"",
    "\\u{110000}",
    "\\",
];

/// The same sequence in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        // xorshift64*, Vigna 2016.
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }

    /// A place between two characters.
    fn place(&mut self, text: &str) -> usize {
        let place = self.below(text.len() + 1);
        (place..=text.len())
            .find(|place| text.is_char_boundary(*place))
            .unwrap_or(text.len())
    }

    fn range(&mut self, text: &str) -> std::ops::Range<usize> {
        let start = self.place(text);
        let longest = text.len() - start;
        let end = start + self.below(longest.min(40) + 1);
        let end = (end..=text.len()).find(|end| text.is_char_boundary(*end));
        start..end.unwrap_or(text.len())
    }
}

fn mutated(corpus: &[String], random: &mut Random) -> String {
    let mut text = corpus[random.below(corpus.len())].clone();
    for _ in 0..=random.below(4) {
        let range = random.range(&text);
        let with = match random.below(5) {
            0 => String::new(),
            1 => WORDS[random.below(WORDS.len())].to_owned(),
            2 => text[range.clone()].repeat(1 + random.below(4)),
            3 => {
                let other = &corpus[random.below(corpus.len())];
                other[random.range(other)].to_owned()
            }
            _ => WORDS[random.below(WORDS.len())].repeat(1 + random.below(600)),
        };
        text.replace_range(range, &with);
    }
    text
}

/// All stages, with one file of the smallest robot replaced, and every diagnostic in both forms.
fn answer(file: &str, text: &str) {
    let mut files = fixture_files("smallest");
    if file.ends_with("node.rs") {
        files.push((
            "nodes/src/lib.rs".to_owned(),
            "pub mod node;\npub struct Hardware;\n".to_owned(),
        ));
        let manifest = files.iter_mut().find(|(path, _)| path == "hulk.toml");
        let (_, manifest) = manifest.expect("every fixture has a manifest");
        *manifest = manifest.replace("nodes::counter", "nodes::node");
    }
    files.push((file.to_owned(), text.to_owned()));
    let workspace = Workspace::in_memory(files);
    let mut found = Diagnostics::new();
    let files = pipeline::generate(&workspace, &mut found);
    assert!(
        files.is_ok() || found.has_errors(),
        "it fails and does not say why"
    );
    diagnostics::render(&found, &workspace, false);
    diagnostics::to_json(&found, &workspace);
}

fn replay(corpus: &'static str, file: &'static str) {
    let work = move || {
        let folder = root().join("tests/corpus").join(corpus);
        let entries = fs::read_dir(&folder).expect("the corpus is checked in");
        let mut paths: Vec<_> = entries
            .map(|entry| entry.expect("it was just listed").path())
            .collect();
        paths.sort();
        let texts: Vec<String> = paths
            .iter()
            .map(|path| fs::read_to_string(path).expect("the corpus is UTF-8"))
            .collect();
        let executions = std::env::var("HULKGEN_FUZZ").ok();
        let executions = executions.map_or(EXECUTIONS, |number| {
            number.parse().expect("HULKGEN_FUZZ is a number")
        });
        let seed = std::env::var("HULKGEN_FUZZ_SEED").ok();
        let seed = seed.map_or(1, |seed| {
            seed.parse().expect("HULKGEN_FUZZ_SEED is a number")
        });
        let mut random = Random(seed);
        let mutations = (0..executions).map(|_| mutated(&texts, &mut random));
        for text in texts.iter().cloned().chain(mutations) {
            let start = Instant::now();
            let result = std::panic::catch_unwind(|| answer(file, &text));
            assert!(result.is_ok(), "{corpus}: this panics:\n{text}");
            assert!(
                start.elapsed() < SLOWEST,
                "{corpus}: this takes {:?}:\n{text}",
                start.elapsed()
            );
        }
    };
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(work);
    let result = thread.expect("a thread can be started").join();
    if let Err(panic) = result {
        std::panic::resume_unwind(panic);
    }
}

#[test]
fn no_manifest_makes_it_panic() {
    replay("manifest", "hulk.toml");
}

#[test]
fn no_node_file_makes_it_panic() {
    replay("scanner", "nodes/src/node.rs");
}

#[test]
fn no_parameter_file_makes_it_panic() {
    replay("parameters", "parameters/default.toml");
}

#[test]
fn ten_thousand_levels_are_an_error() {
    let around = |before: &str, inside: &str, after: &str| {
        format!("{}{inside}{}", before.repeat(10_000), after.repeat(10_000))
    };
    let work = move || {
        for (file, text) in [
            ("nodes/src/node.rs", around("mod a {", "", "}")),
            (
                "nodes/src/node.rs",
                format!("type A = {};", around("Vec<", "u8", ">")),
            ),
            (
                "nodes/src/node.rs",
                format!("const A: u8 = {};", around("(", "1", ")")),
            ),
            (
                "nodes/src/node.rs",
                format!("const A: bool = {};", around("!", "true", "")),
            ),
            (
                "nodes/src/node.rs",
                format!("use {};", around("{", "a", "}")),
            ),
            ("hulk.toml", format!("a = {}", around("[", "1", "]"))),
            ("hulk.toml", format!("{} = 1", around("a.", "a", ""))),
            (
                "parameters/default.toml",
                format!("a = {}", around("{a = ", "1", "}")),
            ),
            (
                "parameters/default.toml",
                format!("[{}]", around("a.", "a", "")),
            ),
        ] {
            answer(file, &text);
        }
    };
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(work);
    thread
        .expect("a thread can be started")
        .join()
        .expect("no panic");
}
