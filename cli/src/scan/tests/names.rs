//! Following names to the types they stand for.

use super::resolve_in;
use crate::scan::compare::{Comparison, compare};
use crate::scan::fixture::Fixture;
use crate::scan::types::Resolved;

/// The type that an author writes in a node file, resolved.
fn resolve(head: &str, written: &str) -> Resolved {
    resolve_in(|fixture| fixture, head, written)
}

#[test]
fn names_resolve_as_rustc_would() {
    for (head, written, text, known) in [
        ("use types::Ball;", "Ball", "types::Ball", true),
        ("use types::Ball as B;", "Vec<B>", "Vec<types::Ball>", true),
        (
            "use types::{self, shapes::{self, Line}};",
            "(types::Ball, shapes::Shape, Line)",
            "(types::Ball, types::shapes::Shape, types::shapes::Line)",
            true,
        ),
        ("use types::*;", "Option<Ball>", "Option<types::Ball>", true),
        ("use types::*;", "Line", "types::shapes::Line", true),
        ("", "types::Shown", "types::Shown", true),
        ("use types::Found;", "Found", "types::Found", true),
        ("", "types::Distance", "f32", true),
        ("use types::*;", "Listed<Ball>", "Vec<types::Ball>", true),
        ("pub struct Own;", "Own", "nodes::a::Own", true),
        ("pub struct Own;", "self::Own", "nodes::a::Own", true),
        ("pub struct Own;", "crate::a::Own", "nodes::a::Own", true),
        ("pub struct Own;", "super::a::Own", "nodes::a::Own", true),
        (
            "pub mod parts { pub struct Leg; }",
            "parts::Leg",
            "nodes::a::parts::Leg",
            true,
        ),
        ("pub type Pair<T> = (T, T);", "Pair<u8>", "(u8, u8)", true),
        ("", "nalgebra::Point2<f32>", "nalgebra::Point2<f32>", true),
        (
            "use nalgebra as na;",
            "na::Point2<f32>",
            "nalgebra::Point2<f32>",
            true,
        ),
        (
            "use ordered_float::OrderedFloat;",
            "OrderedFloat<f32>",
            "ordered_float::OrderedFloat<f32>",
            true,
        ),
        (
            "use std::time::Duration;",
            "Duration",
            "std::time::Duration",
            true,
        ),
        (
            "use std::collections::{BTreeMap as Map};",
            "Map<String, u8>",
            "std::collections::BTreeMap<String, u8>",
            true,
        ),
        (
            "",
            "std::vec::Vec<core::option::Option<u8>>",
            "Vec<Option<u8>>",
            true,
        ),
        (
            "use types::COUNT;",
            "[f32; COUNT]",
            "[f32; types::COUNT]",
            true,
        ),
        ("", "[f32; 3_usize]", "[f32; 3]", true),
        ("", "&'static str", "&'static str", true),
        ("", "Unknown<u8>", "Unknown<u8>", false),
        ("use unknown::Thing;", "Thing", "Thing", false),
        ("", "<u8 as Trait>::Out", "<u8 as Trait>::Out", false),
        ("", "Box<dyn Fn()>", "Box<dyn Fn ()>", false),
        (
            "#[cfg(a)] pub struct X; #[cfg(not(a))] pub struct X;",
            "X",
            "nodes::a::X",
            false,
        ),
        ("use types::Vec;", "Vec<u8>", "Vec<u8>", false),
    ] {
        let resolved = resolve(head, written);
        assert_eq!(resolved.text, text, "{head} {written}");
        assert_eq!(resolved.is_known(), known, "{head} {written}");
        assert!(resolved.private.is_empty(), "{head} {written}");
    }
}

#[test]
fn a_needless_mark_of_a_raw_name_makes_no_difference() {
    // As a crate of edition 2024 names what is plain in one of edition 2021, and the other way round.
    let types = |fixture: Fixture| {
        fixture
            .file(
                "crates/types/src/lib.rs",
                "pub mod gen { pub struct Wide; } pub mod r#later { pub struct Late; } pub mod r#type { pub struct Of; }
                 pub struct r#Plain; pub type gen_of<r#T> = Vec<T>; pub use gen as r#new;",
            )
            .file("crates/types/src/gen.rs", "")
    };
    for (head, written, text) in [
        ("use types::r#gen::Wide;", "Wide", "types::gen::Wide"),
        ("use types::r#gen;", "r#gen::Wide", "types::gen::Wide"),
        (
            "use types::r#gen as r#wide;",
            "wide::Wide",
            "types::gen::Wide",
        ),
        ("use types::*;", "r#gen::Wide", "types::gen::Wide"),
        ("", "types::new::Wide", "types::gen::Wide"),
        ("", "types::later::r#Late", "types::later::Late"),
        ("", "types::r#type::Of", "types::r#type::Of"),
        ("", "types::gen_of<types::Plain>", "Vec<types::Plain>"),
    ] {
        let resolved = resolve_in(types, &format!("{head} type Of = {written};"), "Of");
        assert_eq!(resolved.text, text, "{head} {written}");
        assert!(resolved.is_known(), "{head} {written}");
    }
}

#[test]
fn private_types_are_seen() {
    for (head, written) in [
        ("struct Own;", "Vec<Own>"),
        ("mod inner { pub struct Own; }", "inner::Own"),
        ("", "types::hidden::Lost"),
    ] {
        assert_eq!(resolve(head, written).private.len(), 1, "{head} {written}");
    }
    // What is hidden behind a public alias can be named by the alias.
    let alias = resolve(
        "mod inner { pub struct Own; } pub type Name = inner::Own;",
        "Name",
    );
    assert_eq!(
        (alias.text.as_str(), alias.private.len()),
        ("nodes::a::Name", 0)
    );
}

#[test]
fn types_are_only_told_apart_where_that_is_certain() {
    let head = "use types::*; use std::time::Duration;";
    for (a, b, answer) in [
        ("Ball", "types::Ball", Comparison::Same),
        ("Distance", "f32", Comparison::Same),
        ("[u8; COUNT]", "[u8; 3]", Comparison::Same),
        ("Wrapper<u8>", "Wrapper<u8>", Comparison::Same),
        ("Ball", "Point", Comparison::Different),
        ("Vec<Ball>", "Vec<Point>", Comparison::Different),
        ("Wrapper<u8>", "Wrapper<u16>", Comparison::Different),
        ("(u8, u8)", "(u8,)", Comparison::Different),
        ("[u8; 3]", "[u8; 4]", Comparison::Different),
        (
            "nalgebra::Point2<f32>",
            "nalgebra::Vector2<f32>",
            Comparison::Different,
        ),
        (
            "nalgebra::Point2<f32>",
            "nalgebra::Point2<f64>",
            Comparison::Different,
        ),
        (
            "nalgebra::Vector3<f32>",
            "nalgebra::SVector<f32, 3>",
            Comparison::Unknown,
        ),
        ("nalgebra::Point2<f32>", "f32", Comparison::Different),
        ("nalgebra::SVector<f32, 3>", "f32", Comparison::Different),
        ("nalgebra::Vector2<f32>", "[f32; 2]", Comparison::Different),
        ("nalgebra::Point2<f32>", "(f32, f32)", Comparison::Different),
        (
            "nalgebra::Point2<f32>",
            "Option<nalgebra::Point2<f32>>",
            Comparison::Different,
        ),
        ("nalgebra::Point2<f32>", "Vec<f32>", Comparison::Different),
        ("nalgebra::Vector2<f32>", "Duration", Comparison::Different),
        ("nalgebra::Point2<f32>", "Ball", Comparison::Different),
        // Nobody here knows what these are.
        ("nalgebra::Point2<f32>", "Missing", Comparison::Unknown),
        (
            "nalgebra::Point2<Missing>",
            "nalgebra::Point2<f32>",
            Comparison::Unknown,
        ),
        ("nalgebra::Scalar", "f32", Comparison::Unknown),
        ("ordered_float::NotNan<f32>", "f32", Comparison::Unknown),
        (
            "ordered_float::NotNan<f32>",
            "[f32; 2]",
            Comparison::Unknown,
        ),
        (
            "ordered_float::NotNan<f32>",
            "nalgebra::Point2<f32>",
            Comparison::Unknown,
        ),
        ("Duration", "core::time::Duration", Comparison::Same),
        (
            "std::collections::HashMap<u8, u8>",
            "std::collections::hash_map::HashMap<u8, u8>",
            Comparison::Unknown,
        ),
        ("Missing", "u8", Comparison::Unknown),
    ] {
        assert_eq!(
            compare(&resolve(head, a), &resolve(head, b)),
            answer,
            "{a} {b}"
        );
        assert_eq!(
            compare(&resolve(head, b), &resolve(head, a)),
            answer,
            "{b} {a}"
        );
    }
}

#[test]
fn what_cannot_be_known_is_written_with_absolute_names() {
    let alias = "pub type Grid<T, const N: usize = 2> = [[T; N]; 2];";
    let with_out = "pub trait HasOut { type Out; } pub type Out<T> = <T as HasOut>::Out;";
    for (head, written, text, known) in [
        (
            "pub struct S;",
            "[f32; S::COUNT]",
            "[f32; nodes::a::S::COUNT]",
            false,
        ),
        (
            "use types::COUNT as N;",
            "Vec<[f32; N + 1]>",
            "Vec<[f32; types::COUNT + 1]>",
            false,
        ),
        (
            "",
            "[u8; u8::MAX as usize]",
            "[u8; u8::MAX as usize]",
            false,
        ),
        (
            "use types::Ball; const fn size() -> usize { 1 }",
            "[u8; size_of::<Ball>() + { let a = 1; a }]",
            "[u8; size_of::<types::Ball> () + { let a = 1; a }]",
            false,
        ),
        (
            "pub const fn size() -> usize { 1 }",
            "[u8; size()]",
            "[u8; nodes::a::size ()]",
            false,
        ),
        (
            "use nalgebra::*;",
            "Vector3<f32>",
            "nalgebra::Vector3<f32>",
            true,
        ),
        (
            "use std::collections::*;",
            "BTreeMap<u8, Vec<u8>>",
            "std::collections::BTreeMap<u8, Vec<u8>>",
            true,
        ),
        ("use nalgebra::*;", "types::Ball", "types::Ball", true),
        (alias, "Grid<u8, 3>", "[[u8; 3]; 2]", true),
        (alias, "Grid<u8>", "[[u8; 2]; 2]", true),
        (
            with_out,
            "Out<types::Ball>",
            "nodes::a::Out<types::Ball>",
            false,
        ),
        (
            with_out,
            "<types::Ball as HasOut>::Out",
            "<types::Ball as nodes::a::HasOut>::Out",
            false,
        ),
        (
            "use types::*;",
            "Box<dyn Fn(Ball) -> Point>",
            "Box<dyn Fn (types::Ball) -> types::Point>",
            false,
        ),
        (
            "use std::borrow::Cow;",
            "Cow<'static, str>",
            "std::borrow::Cow<'static, str>",
            true,
        ),
        (
            "macro_rules! define { ($name:ident) => { pub struct $name; } } define!(Made);",
            "Made",
            "nodes::a::Made",
            false,
        ),
        (
            "mod inner { pub use std::collections::*; pub use super::made::*; } use inner::*; pub mod made { \
             macro_rules! define { ($name:ident) => { pub struct $name; } } define!(Made); \
             const fn count() -> usize { 1 } pub const fn size() -> usize { 1 } }",
            "(Made, BTreeSet<u8>, [u8; size()])",
            "(nodes::a::made::Made, std::collections::BTreeSet<u8>, [u8; nodes::a::made::size ()])",
            false,
        ),
        (
            "use made::size as count; pub mod made { pub const fn size() -> usize { 1 } }",
            "[u8; count()]",
            "[u8; nodes::a::made::size ()]",
            false,
        ),
        (
            "pub struct W<const N: usize>; pub struct Foo; impl Foo { pub const N: usize = 2; }",
            "(W<{ 1 + 2 }>, W<{ Foo::N }>, W<{ 3 }>)",
            "(nodes::a::W<{ 1 + 2 }>, nodes::a::W<{ nodes::a::Foo::N }>, nodes::a::W<3>)",
            false,
        ),
        (
            "pub struct W<const N: usize>; pub type V<const M: usize> = W<{ M }>;",
            "(W<{ let x = 1; x }>, V<{ 1 + 2 }>)",
            "(nodes::a::W<{ let x = 1; x }>, nodes::a::V<{ 1 + 2 }>)",
            false,
        ),
        (
            "use types::COUNT; pub struct W<const N: usize>; pub type V<const M: usize> = W<M>;",
            "(W<COUNT>, W<{ types::COUNT }>, V<COUNT>)",
            "(nodes::a::W<{ types::COUNT }>, nodes::a::W<{ types::COUNT }>, nodes::a::W<{ types::COUNT }>)",
            true,
        ),
    ] {
        let resolved = resolve(head, written);
        assert_eq!(resolved.text, text, "{head} {written}");
        assert_eq!(resolved.is_known(), known, "{head} {written}");
        assert!(resolved.private.is_empty(), "{head} {written}");
    }
    assert_eq!(resolve("struct S;", "[u8; S::COUNT]").private.len(), 1);
}

#[test]
fn modules_that_bring_each_other_in_by_globs_are_searched_once() {
    const MODULES: usize = 20;
    let globs = |own: usize| -> String {
        let others = (0..MODULES).filter(|other| *other != own);
        others
            .map(|other| format!("pub use super::m{other}::*; "))
            .collect()
    };
    let modules: String = (0..MODULES)
        .map(|own| format!("pub mod m{own} {{ {} pub struct T{own}; }} ", globs(own)))
        .collect();
    let head = format!("{modules} use m0::*;");
    let begin = std::time::Instant::now();
    let last = resolve(&head, "T19");
    assert_eq!(
        (last.text.as_str(), last.private.len()),
        ("nodes::a::m19::T19", 0)
    );
    assert_eq!(resolve(&head, "Missing").lost, ["Missing"]);
    assert!(begin.elapsed() < std::time::Duration::from_secs(20));
    // Two of one name are none, however they come.
    let two = "pub mod x { pub struct T; } pub mod y { pub struct T; } pub mod z { pub use super::x::*; pub use super::y::*; } use z::*;";
    assert!(!resolve(two, "T").is_known());
}

#[test]
fn lifetimes_of_aliases_are_those_that_are_given() {
    let aliases = "pub type Speeds<'a> = &'a [f32]; pub type Named<'a, T> = std::borrow::Cow<'a, T>; \
                   pub type Calls<'a> = Box<dyn Fn(&'a u8) + 'a>; type Hidden<'a> = &'a u8;";
    for (written, text) in [
        ("Speeds<'_>", "&'_ [f32]"),
        ("Speeds", "&'_ [f32]"),
        ("Option<Speeds<'static>>", "Option<&'static [f32]>"),
        ("Named<'static, str>", "std::borrow::Cow<'static, str>"),
        ("Hidden<'_>", "&'_ u8"),
    ] {
        let resolved = resolve(aliases, written);
        assert_eq!(resolved.text, text, "{written}");
        assert!(resolved.is_known(), "{written}");
    }
    // What is known to rustc alone stays behind its alias.
    assert_eq!(resolve(aliases, "Calls<'_>").text, "nodes::a::Calls<'_>");
}

#[test]
fn dependencies_of_some_machines_are_dependencies() {
    let manifest = "[package]\nname = \"nodes\"\n[dependencies]\nframework = \"1\"\nserde = \"1\"\n\
                    [target.'cfg(unix)'.dependencies]\nnalgebra = \"0.35\"\n";
    let with = |fixture: Fixture| fixture.file("crates/nodes/Cargo.toml", manifest);
    let found = resolve_in(with, "", "nalgebra::Vector3<f32>");
    assert_eq!(found.text, "nalgebra::Vector3<f32>");
    assert!(found.is_known() && found.lost.is_empty());
}

#[test]
fn a_crate_may_give_itself_another_name() {
    for library in [
        "extern crate self as me; pub mod types { pub struct F; }",
        "extern crate types as me;",
    ] {
        let with = |fixture: Fixture| {
            let modules = fixture.text("crates/nodes/src/lib.rs");
            fixture.file("crates/nodes/src/lib.rs", &format!("{modules} {library}"))
        };
        let (written, text) = match library.contains("self") {
            true => ("me::types::F", "nodes::types::F"),
            false => ("me::Ball", "types::Ball"),
        };
        let found = resolve_in(with, "", written);
        assert_eq!(found.text, text);
        assert!(found.is_known());
    }
}

#[test]
fn types_that_double_come_to_an_end() {
    let aliases: String = (0..40)
        .map(|own| format!("pub type A{own} = (A{0}, A{0}); ", own + 1))
        .collect();
    let head = format!("{aliases} pub type A40 = f32; pub type D<T> = (T, T);");
    assert_eq!(resolve(&head, "A39").text, "(f32, f32)");
    let whole = resolve(&head, "A0");
    assert!(!whole.is_known());
    assert_eq!(whole.text, "nodes::a::A0");
    let written = format!("{}u8{}", "D<".repeat(40), ">".repeat(40));
    assert!(!resolve(&head, &written).is_known());
}
