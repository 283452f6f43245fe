//! Every position of a comment that rendering relies on.

use super::*;

/// The text of a file with only these items, without its header.
fn body(items: TokenStream) -> String {
    let text = rust_file("A file.", &[], items);
    let header = format!("//! A file.\n//!\n//! {DO_NOT_EDIT}\n\n");
    text.strip_prefix(&header)
        .expect("every file starts with its header")
        .to_owned()
}

#[test]
fn comments_stand_before_items_and_fields() {
    let (item, field) = (comment("An item."), comment("A field."));
    let text = body(quote! {
        #item
        pub struct Frame {
            #field
            pub cycle: u64,
        }
    });
    assert_eq!(
        text,
        "// An item.\npub struct Frame {\n    // A field.\n    pub cycle: u64,\n}\n"
    );
}

#[test]
fn comments_stand_before_every_kind_of_statement() {
    let [binding, call, assignment, deref, condition, last] = [
        "A let.",
        "A call.",
        "An assignment.",
        "Through a reference.",
        "An if.",
        "The last.",
    ]
    .map(comment);
    let text = body(quote! {
        fn run(frame: &mut Frame) -> u64 {
            #binding
            let a = 1;
            #call
            frame.own.swap();
            #assignment
            frame.own.balls = a;
            #deref
            *frame.time = a;
            #condition
            if a == 1 {
                return a;
            }
            #last
            Ok(a)
        }
    });
    let expected = "\
fn run(frame: &mut Frame) -> u64 {
    // A let.
    let a = 1;
    // A call.
    frame.own.swap();
    // An assignment.
    frame.own.balls = a;
    // Through a reference.
    *frame.time = a;
    // An if.
    if a == 1 {
        return a;
    }
    // The last.
    Ok(a)
}
";
    assert_eq!(text, expected);
}

#[test]
fn comments_stand_before_match_arms_and_fields_of_literals() {
    let (arm, field) = (comment("An arm."), comment("A field."));
    let text = body(quote! {
        fn run(name: &str) -> Option<Frame> {
            match name {
                #arm
                "a" => None,
                _ => Some(Frame {
                    #field
                    cycle: 1,
                    time: 2,
                }),
            }
        }
    });
    let expected = "\
fn run(name: &str) -> Option<Frame> {
    match name {
        // An arm.
        \"a\" => None,
        _ => {
            Some(Frame {
                // A field.
                cycle: 1,
                time: 2,
            })
        }
    }
}
";
    assert_eq!(text, expected);
}

#[test]
fn empty_lines_stand_between_items_methods_and_where_they_are_asked_for() {
    let empty_line = empty_line();
    let text = body(quote! {
        pub mod a;
        pub mod b;
        struct Nodes;
        impl Nodes {
            fn new() -> Self {
                let nodes = Self;
                #empty_line
                nodes
            }
            #[doc = " Documented."]
            fn cycle(&mut self) {}
        }
    });
    let expected = "\
pub mod a;
pub mod b;

struct Nodes;

impl Nodes {
    fn new() -> Self {
        let nodes = Self;

        nodes
    }

    /// Documented.
    fn cycle(&mut self) {}
}
";
    assert_eq!(text, expected);
}

#[test]
fn empty_literals_and_blocks_are_one_line() {
    let text = body(quote! {
        fn run() {
            let context = CreationContext {};
            if context.is_empty() {}
        }
    });
    let expected = "\
fn run() {
    let context = CreationContext {};
    if context.is_empty() {}
}
";
    assert_eq!(text, expected);
}

#[test]
fn layout_does_not_count_as_meaning() {
    let bare = quote! { match a { B => c, _ => d } };
    let why = comment("Why.");
    let laid_out = quote! { match a { #why B => { c } _ => d, } };
    assert_eq!(without_layout(bare), without_layout(laid_out));
    assert_ne!(without_layout(quote!(a.b())), without_layout(quote!(a.c())));
}

#[test]
fn long_slice_patterns_are_indented() {
    let names: Vec<_> = (0..9)
        .map(|index| quote::format_ident!("reader_with_a_long_name_{index}"))
        .collect();
    let text = body(quote! {
        fn run() {
            let (writer, [#(#names),*], []) = buffer();
        }
    });
    let readers: String = (names.iter())
        .map(|name| format!("            {name},\n"))
        .collect();
    assert_eq!(
        text,
        format!(
            "fn run() {{\n    let (\n        writer,\n        [\n{readers}        ],\n        [],\n    ) = buffer();\n}}\n"
        )
    );
}
