//! What is counted, and that the bound is one.

use super::bound::is_shallow;
use super::{DOCUMENTATION, count, too_deep};

#[test]
fn whatever_nests_is_counted() {
    let around = |before: &str, inside: &str, after: &str| {
        format!("{}{inside}{}", before.repeat(10_000), after.repeat(10_000))
    };
    for text in [
        around("(", "1", ")"),
        around("mod a {", "", "}"),
        format!("type A = {};", around("Vec<", "u8", ">")),
        format!("type A = {};", around("Map<u8, ", "u8", ">")),
        format!("type A = {};", around("Map<<A as B>::C, ", "u8", ">")),
        format!("type A = {};", around("Vec<<A as B<", "u8", ">>::C>")),
        format!("const A: bool = {};", around("!", "true", "")),
        format!("const A: u8 = {};", around("1 + ", "1", "")),
        format!("fn a() {{ {} {{}} }}", around("if a {} else ", "", "")),
    ] {
        assert!(too_deep(&text).is_some(), "{}", &text[..40]);
        let for_shells = format!("#!/bin/run `\n{text}");
        assert!(too_deep(&for_shells).is_some(), "{}", &for_shells[..40]);
    }
}

#[test]
fn what_stands_one_after_another_is_not_deep() {
    for part in [
        "//! text\n",
        "/// text\n#[a] pub fn a() -> Vec<u8> { 1 + 1 }\n",
        "use a::b::c;\n",
        "const A: bool = 1 < 2;\n",
        "impl A for B { fn a() { if a {} else {} } }\n",
    ] {
        assert!(too_deep(&part.repeat(10_000)).is_none(), "{part}");
    }
    for part in ["1 + 1, ", "1 << n, ", "n << (2), "] {
        let list = format!("const A: &[u8] = &[{}];", part.repeat(10_000));
        assert!(too_deep(&list).is_none(), "{part}");
    }
}

#[test]
fn honest_files_need_no_tokens() {
    for (name, text) in [
        ("depth.rs", include_str!("../depth.rs")),
        ("lookup.rs", include_str!("../lookup.rs")),
        ("served.rs", include_str!("../served.rs")),
        ("tests.rs", include_str!("tests.rs")),
    ] {
        assert!(is_shallow(text, 100), "{name}");
    }
    assert!(is_shallow("fn r#type<'a>(r#a: &'a str) {}", 9));
}

#[test]
fn what_looks_like_a_string_and_is_none_is_counted() {
    for text in [
        r#"/*/**/"*/<<<<<<//""#,
        r##"r#""#r"\""<<<<<<//""##,
        r#""a"r"\""<<<<<<//""#,
        r#"'"'<<<<<<//""#,
        r#"b'"'<<<<<<//""#,
        r#"'a'<<<<<<//'"#,
        r##"r#r"\""<<<<<<//""##,
        r#"r"\"<<<<<<//""#,
        r#"br"\"<<<<<<//""#,
        "//\"\n<<<<<<//\"",
    ] {
        assert!(count(text, 5).is_some() && !is_shallow(text, 5), "{text}");
    }
}

/// Tokens, and what begins or ends one, in every way that may confuse a reader.
const PARTS: &[&str] = &[
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    "{",
    "}",
    "(",
    ")",
    "<",
    ">",
    ">>",
    "->",
    "=>",
    ",",
    ";",
    "=",
    "-",
    "!",
    "#",
    "#!",
    "'",
    "'a",
    "'a'",
    "'('",
    r"'\''",
    "'\"'",
    r"'\u{28}'",
    "'''",
    r"b'\''",
    "b'('",
    "b",
    "c",
    "r",
    "br",
    "cr",
    "\"",
    "\"(\"",
    r#""\"""#,
    r#""\"#,
    r"\",
    r#"r"\""#,
    "r#\"\"(\"#",
    r#"br"\""#,
    "r##\"\"#(\"##",
    "c\"(\"",
    "b\"(\"",
    "r#type",
    "r#r",
    "r#b",
    "'r#a",
    "1",
    "1.",
    "1.0",
    "1e",
    "1r",
    "..",
    "a",
    "else",
    "if",
    "\"a\"r",
    "'a'r",
    "//",
    "///",
    "//!",
    "/*",
    "*/",
    "/**",
    "/**/",
    "/*/",
    "\n",
    "\r",
    "\r\n",
    " ",
    "\t",
    "ä",
    "'ä'",
    "\u{2028}",
    "\u{200e}",
    "_",
    "::",
    "&",
    "|",
    "?",
    "$",
    "~",
    "@",
    "`",
    "\0",
];

#[test]
fn the_bound_is_never_below_what_is_counted() {
    let mut seed = 7_u64;
    let mut below = |end: usize| {
        // Constants of Knuth's MMIX; the upper bits are the better ones.
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(seed >> 33).expect("31 bits fit") % end
    };
    let (mut shallow, mut others) = (0, 0);
    for _ in 0..300_000 {
        let parts = (0..=below(14)).map(|_| PARTS[below(PARTS.len())]);
        let text = parts.collect::<Vec<_>>().concat();
        let deepest = below(8);
        if is_shallow(&text, deepest) {
            shallow += 1;
            let place = count(&text, deepest + DOCUMENTATION);
            assert!(place.is_none(), "{text:?} is deeper than {deepest}");
        } else if count(&text, deepest + DOCUMENTATION).is_some() {
            others += 1;
        }
    }
    assert!(shallow > 1_000 && others > 1_000, "{shallow}, {others}");
}
