//! Bad input in masses: the robot around the fuzzed file, how files are mutated, and what must hold of every answer.
//!
//! `tests/tests/fuzz.rs` replays the corpus and some mutations with it, `tests/fuzz/` searches with it for hours.

use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::resolve::{self, parameter_files};
use hulkgen::workspace::Workspace;
use hulkgen::{manifest, pipeline, scan};

/// As the program of hulkgen has: as deep as the scanner permits.
const STACK: usize = 256 << 20;

/// What people write and may get wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    Manifest,
    Scanner,
    Parameters,
}

/// Everything of the robot but `Cargo.toml`, which stands below: `tests/corpus/robot`.
const ROBOT: &[(&str, &str)] = &[
    ("hulk.toml", include_str!("corpus/robot/hulk.toml")),
    (
        "nodes/src/body.rs",
        include_str!("corpus/robot/nodes/body.rs"),
    ),
    (
        "nodes/src/eye.rs",
        include_str!("corpus/robot/nodes/eye.rs"),
    ),
    (
        "nodes/src/interfaces.rs",
        include_str!("corpus/robot/nodes/interfaces.rs"),
    ),
    (
        "nodes/src/legs.rs",
        include_str!("corpus/robot/nodes/legs.rs"),
    ),
    (
        "nodes/src/lib.rs",
        include_str!("corpus/robot/nodes/lib.rs"),
    ),
    (
        "nodes/src/node.rs",
        include_str!("corpus/robot/nodes/node.rs"),
    ),
    (
        "nodes/src/spots.rs",
        include_str!("corpus/robot/nodes/spots.rs"),
    ),
    (
        "nodes/src/types.rs",
        include_str!("corpus/robot/nodes/types.rs"),
    ),
    (
        "parameters/default.toml",
        include_str!("corpus/robot/parameters/default.toml"),
    ),
    (
        "parameters/body.P0001.toml",
        include_str!("corpus/robot/parameters/body.P0001.toml"),
    ),
    (
        "parameters/field/default.toml",
        include_str!("corpus/robot/parameters/field/default.toml"),
    ),
    (
        "Cargo.toml",
        "[workspace]\nmembers = [\"generated\", \"nodes\"]\n",
    ),
    (
        "nodes/Cargo.toml",
        "[package]\nname = \"nodes\"\nversion = \"0.1.0\"\nedition = \"2024\"\n",
    ),
];

impl Input {
    /// The file of the robot that the input stands in place of.
    pub fn file(self) -> &'static str {
        match self {
            Input::Manifest => "hulk.toml",
            Input::Scanner => "nodes/src/node.rs",
            Input::Parameters => "parameters/default.toml",
        }
    }

    /// What the robot has there.
    pub fn honest(self) -> &'static str {
        let mut files = ROBOT.iter();
        let file = files.find(|(path, _)| *path == self.file());
        file.expect("the robot has every file that is fuzzed").1
    }

    /// The folder below `tests/corpus`.
    pub fn corpus(self) -> &'static str {
        match self {
            Input::Manifest => "manifest",
            Input::Scanner => "scanner",
            Input::Parameters => "parameters",
        }
    }
}

/// What hulkgen says of the robot with this text in place of one file, and the generated text.
///
/// # Panics
///
/// If hulkgen panics, or fails without a word: the bugs that are looked for.
pub fn answer(input: Input, text: &str) -> Answer {
    let workspace = workspace(input, text);
    let mut found = Diagnostics::new();
    let files = pipeline::generate(&workspace, &mut found).ok();
    assert!(
        files.is_some() || found.has_errors(),
        "it fails and does not say why"
    );
    Answer {
        accepted: !found.has_errors(),
        words: told(&found, &workspace),
        generated: files.map(|files| format!("{files:?}")),
    }
}

fn workspace(input: Input, text: &str) -> Workspace {
    Workspace::in_memory(ROBOT.iter().map(|(path, honest)| {
        let text = if *path == input.file() { text } else { honest };
        (*path, text)
    }))
}

/// Every diagnostic in both forms.
fn told(found: &Diagnostics, workspace: &Workspace) -> String {
    diagnostics::to_json(found, workspace);
    diagnostics::render(found, workspace, false)
}

/// Calls `next` for text after text, and judges each by the stages that the input can change, which is many times
/// faster than [`answer`]. Of one text in 64 everything is told that is wrong, one in 256 is answered
/// whole.
///
/// # Panics
///
/// As [`answer`].
pub fn judge(input: Input, mut next: impl FnMut() -> Option<String>) {
    let honest = workspace(input, input.honest());
    let mut found = Diagnostics::new();
    let bound = "the robot of the corpus has no mistakes";
    let manifest = manifest::load(&honest, &mut found).expect(bound);
    let sources = scan::scan(&honest, &manifest, &mut found).expect(bound);
    let robot = resolve::resolve(&honest, &manifest, &sources, &mut found).expect(bound);
    while let Some(text) = next() {
        let chance = text.bytes().fold(0_u16, |sum, byte| {
            sum.wrapping_mul(31).wrapping_add(byte.into())
        });
        if chance.is_multiple_of(256) {
            answer(input, &text);
            continue;
        }
        let workspace = workspace(input, &text);
        let mut found = Diagnostics::new();
        if input == Input::Parameters {
            parameter_files::check(&workspace, &manifest, &sources, &robot, &mut found);
        } else {
            let understood = pipeline::understand(&workspace, &mut found);
            assert!(
                understood.is_ok() || found.has_errors(),
                "it fails and does not say why"
            );
        }
        if chance.is_multiple_of(64) {
            told(&found, &workspace);
        }
    }
}

/// What came of one text.
#[derive(Debug, PartialEq, Eq)]
pub struct Answer {
    /// Whether it may be generated.
    pub accepted: bool,
    /// Every diagnostic, as people read it.
    pub words: String,
    /// Every generated file, where nothing keeps it from being written.
    pub generated: Option<String>,
}

/// Runs it where the stack is as deep as that of hulkgen's own program.
///
/// # Panics
///
/// As `work` does.
pub fn on_deep_stack<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK);
        let thread = thread.spawn_scoped(scope, work);
        let result = thread.expect("a thread can be started").join();
        result.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

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
    "Box<dyn Fn(&u8) -> u8>",
    "[u8; 1 << 70]",
    "impl<'a, const N: usize>",
    "#[cfg(all(test, not(test)))]",
    "#[path = \"node.rs\"]",
    "macro_rules! x { ($($t:tt)*) => { $($t)* } }",
    "mod node;",
    "unsafe extern \"C\"",
    "where Self: Sized",
];

/// The same sequence in every run: xorshift64*, Vigna 2016.
#[derive(Debug)]
pub struct Random(u64);

impl Random {
    /// Nought would stay nought.
    pub fn new(seed: u64) -> Self {
        Self(seed.max(1))
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }

    fn of<'t, T: ?Sized>(&mut self, all: &[&'t T]) -> &'t T {
        all[self.below(all.len())]
    }
}

/// One to four changes of the text: characters, tokens, and lines, also such of the other texts.
pub fn mutated(text: &str, others: &[&str], random: &mut Random) -> String {
    let mut text = text.to_owned();
    for _ in 0..=random.below(4) {
        let cuts = match random.below(4) {
            0 => characters(&text),
            1 => lines(&text),
            _ => tokens(&text),
        };
        let at = |index: usize| cuts[index.min(cuts.len() - 1)];
        let start = random.below(cuts.len());
        let range = at(start)..at(start + random.below(12));
        match random.below(8) {
            0 => text.replace_range(range, ""),
            1 => text.replace_range(range, random.of(WORDS)),
            2 => {
                let many = 1 + random.below(600);
                text.replace_range(range, &random.of(WORDS).repeat(many));
            }
            3 => {
                let again = text[range.clone()].repeat(2 + random.below(3));
                text.replace_range(range, &again);
            }
            4 => {
                let moved = text[range.clone()].to_owned();
                text.insert_str(at(random.below(cuts.len())), &moved);
            }
            _ => {
                let from = if random.below(2) == 0 || others.is_empty() {
                    text.clone()
                } else {
                    random.of(others).to_owned()
                };
                let cuts = tokens(&from);
                let start = random.below(cuts.len());
                let end = (start + random.below(8)).min(cuts.len() - 1);
                text.replace_range(range, &from[cuts[start]..cuts[end]]);
            }
        }
    }
    text
}

/// Where characters begin, and the end. Never empty.
fn characters(text: &str) -> Vec<usize> {
    let places = text.char_indices().map(|(place, _)| place);
    places.chain([text.len()]).collect()
}

/// Where lines begin, and the end.
fn lines(text: &str) -> Vec<usize> {
    let places = text.match_indices('\n').map(|(place, _)| place + 1);
    [0].into_iter().chain(places).chain([text.len()]).collect()
}

/// Where words, blanks and single signs begin, and the end.
fn tokens(text: &str) -> Vec<usize> {
    let kind = |character: char| match character {
        _ if character.is_alphanumeric() || character == '_' => 0,
        _ if character.is_whitespace() => 1,
        _ => 2,
    };
    let mut before = 2;
    let mut places = Vec::new();
    for (place, character) in text.char_indices() {
        let now = kind(character);
        if now == 2 || now != before {
            places.push(place);
        }
        before = now;
    }
    places.push(text.len());
    places
}
