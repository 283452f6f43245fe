//! One bracket too few or too many in otherwise ordinary code.

use super::{Unbalanced, unbalanced};

const ORDINARY: &str = r##"
//! It's a file { with ( all sorts of things.
/* { /* ( */ [ */
/// (a comment
fn choose<'a>(one: &'a str) -> [char; 4] {
    let _ = ("}", r#"("}"#, b")", br"[", c"{");
    match one {
        "\"(" => ['(', '\'', b'{' as char, '\u{7d}'],
        other => [other.chars().next().unwrap_or('ü'); 4],
    }
}
"##;

/// The text of the place that is told.
fn told(text: &str) -> String {
    match unbalanced(text).expect("something is wrong") {
        Unbalanced::Closed(at) => format!("closes nothing: line {}", line(text, at.start)),
        Unbalanced::Opened(at, _) => format!("not closed: line {}", line(text, at.start)),
        Unbalanced::Endless(at, what, None) => {
            format!("endless {what}: line {}", line(text, at.start))
        }
        Unbalanced::Endless(at, what, Some(other)) => {
            let [at, other] = [at, other].map(|place| line(text, place.start));
            format!("endless {what}: line {at} or {other}")
        }
    }
}

fn line(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count() + 1
}

#[test]
fn brackets_in_texts_and_comments_are_none() {
    assert_eq!(unbalanced(ORDINARY), None);
    assert_eq!(unbalanced(""), None);
}

#[test]
fn every_bracket_that_is_left_out_is_missed() {
    let code =
        "struct A {\n    a: [u8; 2],\n}\n\nfn b() {\n    if c(1) {\n        d();\n    }\n}\n";
    assert_eq!(unbalanced(code), None);
    let brackets = code
        .char_indices()
        .filter(|(_, one)| "()[]{}".contains(*one));
    for (at, bracket) in brackets {
        let text = format!("{}{}", &code[..at], &code[at + 1..]);
        assert!(unbalanced(&text).is_some(), "without {bracket} at {at}");
    }
}

#[test]
fn the_bracket_is_told_and_not_the_end_of_the_file() {
    assert_eq!(
        told("struct A\n    a: u8,\n}\n\nstruct B {}\n"),
        "closes nothing: line 3"
    );
    let open = "impl A {\n    fn a() {\n        b();\n\n    fn c() {\n        d();\n    }\n}\n";
    assert_eq!(told(open), "not closed: line 2");
    assert_eq!(told("fn a() {\n    b(1;\n}\n"), "not closed: line 2");
    for extra in ["b(1));", "b 1);", "b[1]];"] {
        let text = format!("fn a() {{\n    {extra}\n}}\n");
        assert_eq!(told(&text), "closes nothing: line 2", "{extra}");
    }
    assert_eq!(told("fn a() {\n    /* b\n}\n"), "endless comment: line 2");
    assert_eq!(told("fn a() {\n    b(\"c);\n}\n"), "endless text: line 2");
    let more = "fn a() {\n    b(\"c);\n    d(\"e\");\n    f(\"g\");\n}\n";
    assert_eq!(told(more), "endless text: line 2");
}

#[test]
fn a_text_over_lines_is_not_blamed_for_a_later_one() {
    let long = "fn a() {\n    b(\"c\n        d\");\n";
    for (rest, expected) in [
        // Nobody can know: `;` may well be the end of a text.
        ("    let e = \"f;\n}\n", "line 4 or 2"),
        ("    e(\"f);\n    g(\"h\");\n}\n", "line 4"),
        (
            "    e(\"f);\n    g(\"h\", \"i\");\n    j(\"k\");\n}\n",
            "line 4",
        ),
        ("    e(\"f\", \"g, \"h\");\n    i(\"j\");\n}\n", "line 4"),
        (
            "    e(\"f);\n    g(\"h\n    i\");\n    j(\"k\");\n}\n",
            "line 4",
        ),
    ] {
        let text = format!("{long}{rest}");
        assert_eq!(told(&text), format!("endless text: {expected}"), "{text}");
    }
    // The one over lines itself.
    let text = "fn a() {\n    b(\"c\n        d);\n    e(\"f\");\n    g(\"h\");\n}\n";
    assert_eq!(told(text), "endless text: line 2");
}
