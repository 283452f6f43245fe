//! Messages in masses that are nearly right: each is answered once, nobody panics, and the robot goes on.

use proptest::prelude::any;
use proptest::sample::Index;
use proptest::strategy::{Strategy as _, ValueTree as _};
use proptest::test_runner::TestRunner;
use serde_json::{Value, json};

use crate::zoo::{Client, Zoo};

/// Mutations in a run of `cargo test`; more with `HULKGEN_FUZZ=number`.
const EXECUTIONS: usize = 600;

/// As many as may wait for a cycle or a node at a time.
const AT_ONCE: usize = 40;

/// What stands in place of something honest: ends of numbers, paths, and JSON that goes wrong.
const PIECES: &[&str] = &[
    "-1",
    "1e999",
    "18446744073709551616",
    "4294967296",
    "0.1",
    "null",
    "\"\"",
    "[]",
    "{}",
    "{\"\":{}}",
    "[[[[[[[[[[",
    "\\u0000",
    "\\ud800",
    "\"parameters.gait.period\"",
    "\"Control.main_outputs.pose.position.x\"",
    "..",
    "𝄞",
    ",",
    ":",
    "}",
];

/// One of each kind.
fn corpus() -> Vec<String> {
    let cycles = "Control.main_outputs.cycles";
    let image = "VisionTop.main_outputs.image";
    let asks = [
        json!({ "authenticate": { "token": "secret" } }),
        json!({ "paths": { "below": "Control.main_outputs", "depth": 3 } }),
        json!({ "schema": { "path": cycles } }),
        json!({ "layout": { "path": cycles } }),
        json!({ "read": { "path": "Control.main_outputs.pose" } }),
        json!({ "subscribe": { "path": cycles, "rate": 0.5, "encoding": "binary" } }),
        json!({ "subscribe": { "path": image, "rate": 0.5, "encoding": { "jpeg": { "quality": 50 } } } }),
        json!({ "unsubscribe": { "subscription": 1 } }),
        json!({ "bundle": {} }),
        json!({ "write": { "changes": [{ "path": "gait.period", "value": 0.5 }] } }),
        json!({ "parameters": { "path": "gait" } }),
        json!({ "unstored": {} }),
        json!({ "store": { "layer": "none", "paths": ["gait.period"] } }),
        json!({ "inject": { "path": image, "value": { "width": 1, "height": 1, "data": [1] } } }),
        json!({ "release": { "path": image } }),
        json!({ "call": { "path": "framework.procedures.rearm", "argument": null, "timeout": 0.1 } }),
        json!({ "set_log_level": { "of": "Control", "level": "error" } }),
        json!({ "trace": { "seconds": 0.1 } }),
        json!({ "timings": {} }),
        json!({ "graph": {} }),
    ];
    let message = |ask| json!({ "id": 7, "ask": ask }).to_string();
    asks.into_iter().map(message).collect()
}

/// The text with one to three changes.
fn mutated(text: &str, others: &[String], runner: &mut TestRunner) -> String {
    let mut characters: Vec<char> = text.chars().collect();
    let mut draw = || {
        let drawn = any::<Index>().new_tree(runner);
        drawn.expect("it draws").current()
    };
    for _ in 0..=draw().index(3) {
        let (one, other) = (draw(), draw());
        let length = characters.len().max(1);
        let (begin, end) = (one.index(length), one.index(length) + other.index(12));
        let end = end.min(characters.len());
        let begin = begin.min(end);
        let instead: Vec<char> = match draw().index(4) {
            0 => Vec::new(),
            1 => PIECES[draw().index(PIECES.len())].chars().collect(),
            2 => characters[begin..end].repeat(2),
            _ => {
                let other = &others[draw().index(others.len())];
                other.chars().skip(draw().index(other.len())).collect()
            }
        };
        characters.splice(begin..end, instead);
    }
    characters.into_iter().collect()
}

/// How many of so many answers are good.
fn good_answers(client: &mut Client, wanted: usize) -> usize {
    let mut good = 0;
    let mut seen = 0;
    while seen < wanted {
        let message = client.receive();
        if let Some(answer) = message.get("answer") {
            seen += 1;
            good += usize::from(answer.get("ok").is_some());
            assert!(
                answer.get("ok").is_some() != answer.get("error").is_some(),
                "{message}"
            );
        }
    }
    good
}

#[test]
fn every_message_is_answered_once_whatever_it_says() {
    let zoo = Zoo::new();
    let mut watching = zoo.client();
    let cycles = watching.subscribe("Control.main_outputs.cycles");
    let first = watching.update(cycles)["cycle"].as_u64().expect("a number");
    let corpus = corpus();
    let mut client = zoo.client();
    corpus.iter().for_each(|text| client.send(text));
    assert!(good_answers(&mut client, corpus.len()) > corpus.len() / 2);

    let executions = std::env::var("HULKGEN_FUZZ").ok();
    let executions = executions.map_or(EXECUTIONS, |number| number.parse().expect("a number"));
    let mut runner = TestRunner::deterministic();
    let mut good = 0;
    for begin in (0..executions).step_by(AT_ONCE) {
        // What a client holds ends with it.
        let mut client = zoo.client();
        let number = AT_ONCE.min(executions - begin);
        for execution in begin..begin + number {
            let text = &corpus[execution % corpus.len()];
            client.send(&mutated(text, &corpus, &mut runner));
        }
        good += good_answers(&mut client, number);
    }
    assert!(0 < good && good < executions, "{good} of {executions}");

    let mut expected = first;
    for _ in 0..200 {
        expected += 1;
        assert_eq!(watching.update(cycles)["cycle"], json!(expected));
    }
    let lost = |message: &Value| message.get("lost").is_some();
    assert!(!watching.waiting.iter().any(lost));
}
