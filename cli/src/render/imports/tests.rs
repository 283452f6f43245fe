//! How absolute paths become `use` lines.

use proc_macro2::TokenStream;
use quote::quote;

use super::*;

/// The items with their imports in front, without white space that means nothing.
fn imported(items: TokenStream, modules: &[&str]) -> String {
    let modules: Vec<String> = modules.iter().map(|module| (*module).to_owned()).collect();
    let mut file: syn::File = syn::parse2(items).expect("the test quotes Rust");
    let uses = import(&mut file.items, &modules);
    file.items.splice(0..0, uses);
    prettyplease::unparse(&file)
}

#[test]
fn paths_become_names_with_one_sorted_line_each() {
    let text = imported(
        quote! {
            #[derive(Clone, ::framework::Reflect)]
            struct Frame<'a> {
                parameters: &'a crate::parameters::Parameters,
                hardware: ::std::sync::Arc<::types::Vec2<::types::Ball>>,
            }
            fn new() -> ::framework::Result<()> {
                vec![::framework::Guarded::new(::control::motion::Motion::new)];
                ::framework::buffer([])
            }
        },
        &["control::motion"],
    );
    let expected = "\
use std::sync::Arc;
use control::motion;
use framework::Guarded;
use framework::Reflect;
use framework::Result;
use framework::buffer;
use types::Ball;
use types::Vec2;
use crate::parameters::Parameters;
#[derive(Clone, Reflect)]
struct Frame<'a> {
    parameters: &'a Parameters,
    hardware: Arc<Vec2<Ball>>,
}
fn new() -> Result<()> {
    vec![Guarded::new(motion::Motion::new)];
    buffer([])
}
";
    assert_eq!(text, expected);
}

#[test]
fn paths_that_end_in_the_same_name_stay_whole() {
    let text = imported(
        quote!(
            struct A(::types::Ball, ::sounds::Ball);
        ),
        &[],
    );
    assert_eq!(text, "struct A(types::Ball, sounds::Ball);\n");
}

#[test]
fn the_framework_keeps_its_names_and_others_stay_whole() {
    let text = imported(
        quote!(
            struct A(::framework::Timestamp, ::types::Timestamp);
        ),
        &[],
    );
    assert_eq!(
        text,
        "use framework::Timestamp;\nstruct A(Timestamp, types::Timestamp);\n"
    );
}

#[test]
fn nothing_hides_the_prelude_or_an_item_of_the_file() {
    let text = imported(
        quote!(
            struct Frame<Hardware>(::types::Frame, ::types::Option, ::simulated::Hardware);
        ),
        &[],
    );
    assert_eq!(
        text,
        "struct Frame<Hardware>(types::Frame, types::Option, simulated::Hardware);\n"
    );
}

#[test]
fn nothing_hides_a_primitive() {
    let text = imported(
        quote!(
            struct A(
                ::types::f32,
                f32,
                crate::databases::u8::Frame,
                u8,
                ::nodes::str::Node,
            );
        ),
        &["crate::databases::u8", "nodes::str"],
    );
    assert_eq!(
        text,
        "struct A(types::f32, f32, crate::databases::u8::Frame, u8, nodes::str::Node);\n"
    );
}

#[test]
fn a_crate_called_like_an_imported_module_is_named_from_the_root() {
    let text = imported(
        quote!(
            struct A(crate::databases::control::Frame, ::control::types::Pose);
        ),
        &["crate::databases::control"],
    );
    assert_eq!(
        text,
        "use ::control::types::Pose;\nuse crate::databases::control;\nstruct A(control::Frame, Pose);\n"
    );
}

#[test]
fn traits_are_imported_where_items_say_so() {
    let text = imported(
        quote!(
            use ::framework::InNode;
            struct A;
        ),
        &[],
    );
    assert_eq!(text, "use framework::InNode;\nstruct A;\n");
}

#[test]
fn a_constant_that_stays_whole_keeps_its_braces() {
    let text = imported(
        quote!(
            struct A(
                ::types::Few<{ ::types::N }>,
                ::types::Many<{ ::one::COUNT }, { ::two::COUNT }>,
                [u8; { ::types::N }],
            );
        ),
        &[],
    );
    assert!(
        text.contains("struct A(Few<N>, Many<{ one::COUNT }, { two::COUNT }>, [u8; N]);"),
        "{text}"
    );
}
