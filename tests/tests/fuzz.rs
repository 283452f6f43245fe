//! Bad input in masses: whatever stands in a manifest, a node file or a parameter file, hulkgen answers and does not panic.
//!
//! Every file of `tests/corpus/` is replayed as it is and in mutations that are the same in every run; more of them with
//! `HULKGEN_FUZZ=executions`. `tests/fuzz/` searches for hours; what it finds becomes a file of the corpus.

use std::fs;
use std::time::{Duration, Instant};

use support::fuzzed::{Answer, Input, Random, answer, mutated, on_deep_stack};
use support::root;

/// Mutations of one corpus in a run of `cargo test`.
const EXECUTIONS: u64 = 300;

/// No honest or broken input of a few kilobytes takes as long.
const SLOWEST: Duration = Duration::from_secs(10);

/// What somebody once found interesting, and what the robot has there.
fn corpus(input: Input) -> Vec<String> {
    let folder = root().join("tests/corpus").join(input.corpus());
    let entries = fs::read_dir(&folder).expect("the corpus is checked in");
    let mut paths: Vec<_> = entries
        .map(|entry| entry.expect("it was just listed").path())
        .collect();
    paths.sort();
    let text = |path| {
        let bytes = fs::read(path).expect("the corpus can be read");
        String::from_utf8_lossy(&bytes).into_owned()
    };
    let honest = [input.honest().to_owned()].into_iter();
    honest.chain(paths.iter().map(text)).collect()
}

fn number(variable: &str, otherwise: u64) -> u64 {
    let given = std::env::var(variable).ok();
    given.map_or(otherwise, |given| {
        let number = given.parse();
        number.unwrap_or_else(|_| panic!("{variable} is a number"))
    })
}

fn answered(input: Input, text: &str) -> Answer {
    let start = Instant::now();
    let result = std::panic::catch_unwind(|| answer(input, text));
    let Ok(answer) = result else {
        panic!("{input:?}: this panics:\n{text}");
    };
    assert!(
        start.elapsed() < SLOWEST,
        "{input:?}: this takes {:?}:\n{text}",
        start.elapsed()
    );
    answer
}

/// How many of the mutations were accepted: some, or nothing behind the first mistake was ever reached; not all.
fn replay(input: Input) {
    let corpus = corpus(input);
    let others: Vec<&str> = corpus.iter().map(String::as_str).collect();
    let mut random = Random::new(number("HULKGEN_FUZZ_SEED", 1));
    let executions = number("HULKGEN_FUZZ", EXECUTIONS);
    on_deep_stack(|| {
        assert!(
            answered(input, input.honest()).accepted,
            "{}",
            answer(input, input.honest()).words
        );
        for text in &corpus {
            assert_eq!(answered(input, text), answered(input, text));
        }
        let mut accepted = 0;
        for execution in 0..executions {
            // Half of them start where everything is right, so that the later stages are reached, too.
            let from = if execution % 2 == 0 { 0 } else { execution / 2 };
            let text = &corpus[from as usize % corpus.len()];
            let text = mutated(text, &others, &mut random);
            accepted += u64::from(answered(input, &text).accepted);
        }
        assert!(
            0 < accepted && accepted < executions,
            "{input:?}: {accepted} of {executions} accepted"
        );
    });
}

#[test]
fn no_manifest_makes_it_panic() {
    replay(Input::Manifest);
}

#[test]
fn no_node_file_makes_it_panic() {
    replay(Input::Scanner);
}

#[test]
fn no_parameter_file_makes_it_panic() {
    replay(Input::Parameters);
}

/// The robot of the corpus is there for what it reaches: mistakes of every stage are seen in it.
#[test]
fn every_stage_judges_the_robot() {
    for (input, from, to, code) in [
        (
            Input::Manifest,
            "kind = \"perception\"",
            "kind = \"x\"",
            "invalid-value",
        ),
        (Input::Scanner, "\"joints\"", "\"joint\"", "unknown-output"),
        (
            Input::Scanner,
            "Input<[f32; 3]",
            "Input<[f32; 4]",
            "type-mismatch",
        ),
        (
            Input::Scanner,
            "\"best?.certain\"",
            "\"best.certain\"",
            "option",
        ),
        (
            Input::Parameters,
            "threshold = 100",
            "threshold = 300",
            "300",
        ),
        (Input::Parameters, "most = 0.5", "least = 0.5", "least"),
        (
            Input::Parameters,
            "limits = [0.5",
            "limits = [true",
            "limits",
        ),
    ] {
        let text = input.honest().replacen(from, to, 1);
        assert_ne!(text, input.honest(), "{from} is not there");
        let answer = answer(input, &text);
        assert!(!answer.accepted, "{to} is accepted");
        assert!(answer.words.contains(code), "{to}: {}", answer.words);
    }
}

#[test]
fn ten_thousand_levels_are_an_error() {
    let around = |before: &str, inside: &str, after: &str| {
        format!("{}{inside}{}", before.repeat(10_000), after.repeat(10_000))
    };
    on_deep_stack(|| {
        for (input, text) in [
            (Input::Scanner, around("mod a {", "", "}")),
            (
                Input::Scanner,
                format!("type A = {};", around("Vec<", "u8", ">")),
            ),
            (
                Input::Scanner,
                format!("const A: u8 = {};", around("(", "1", ")")),
            ),
            (
                Input::Scanner,
                format!("const A: bool = {};", around("!", "true", "")),
            ),
            (Input::Scanner, format!("use {};", around("{", "a", "}"))),
            (Input::Manifest, format!("a = {}", around("[", "1", "]"))),
            (Input::Manifest, format!("{} = 1", around("a.", "a", ""))),
            (
                Input::Parameters,
                format!("a = {}", around("{a = ", "1", "}")),
            ),
            (Input::Parameters, format!("[{}]", around("a.", "a", ""))),
        ] {
            answer(input, &text);
        }
    });
}
