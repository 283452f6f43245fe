//! `mod` lines in every order that people keep.

use super::{parse, with_module, without};
use crate::scan::range;
use syn::spanned::Spanned as _;

fn added(text: &str, name: &str) -> String {
    with_module(
        text,
        &parse("lib.rs".into(), text).expect("it is Rust"),
        name,
    )
}

#[test]
fn a_line_is_added_where_its_author_would_write_it() {
    for (before, after) in [
        ("", "pub mod m;\n"),
        ("//! Nodes.\n", "//! Nodes.\n\npub mod m;\n"),
        (
            "//! Nodes.\n\nuse a::B;\n",
            "//! Nodes.\n\npub mod m;\n\nuse a::B;\n",
        ),
        ("pub struct A;\n", "pub mod m;\n\npub struct A;\n"),
        (
            "pub mod a;\npub mod z;\n",
            "pub mod a;\npub mod m;\npub mod z;\n",
        ),
        (
            "pub mod n;\npub mod z;\n",
            "pub mod m;\npub mod n;\npub mod z;\n",
        ),
        (
            "pub mod z;\n\npub mod a; // last\n\nuse b;\n",
            "pub mod z;\n\npub mod a; // last\npub mod m;\n\nuse b;\n",
        ),
        ("pub mod a;", "pub mod a;\npub mod m;\n"),
        (
            "/// Why.\npub mod n;\n",
            "pub mod m;\n/// Why.\npub mod n;\n",
        ),
        (
            "//! Nodes.\r\n\r\npub mod a;\r\n",
            "//! Nodes.\r\n\r\npub mod a;\r\npub mod m;\r\n",
        ),
        (
            "mod private;\n\n#[cfg(test)]\nmod tests;\n",
            "pub mod m;\nmod private;\n\n#[cfg(test)]\nmod tests;\n",
        ),
    ] {
        assert_eq!(added(before, "m"), after, "{before}");
    }
}

#[test]
fn a_line_goes_with_what_belongs_to_it() {
    for (before, after) in [
        (
            "pub mod a;\npub mod m;\npub mod z;\n",
            "pub mod a;\npub mod z;\n",
        ),
        (
            "pub mod a;\n\n/// Why.\npub mod m;\n\npub mod z;\n",
            "pub mod a;\n\npub mod z;\n",
        ),
        ("//! Nodes.\n\npub mod m;\n", "//! Nodes.\n"),
        ("pub mod m; // beside\n\nuse b;\n", "use b;\n"),
        ("pub mod a; pub mod m;\n", "pub mod a;\n"),
        ("pub mod m; pub mod z; // both\n", "pub mod z; // both\n"),
        (
            "use b;\n  pub mod a; pub mod m; pub mod z;",
            "use b;\n  pub mod a; pub mod z;",
        ),
    ] {
        let syntax = parse("lib.rs".into(), before).expect("it is Rust");
        let item = super::find(&syntax, "m").expect("it is there");
        assert_eq!(without(before, range(item.span())), after, "{before}");
    }
}
