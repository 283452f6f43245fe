//! Data paths and names in string literals.

use grammar::{AnyContext, CreationField, Rule, SegmentName, parse_context};

/// The path of a `Parameter`, or the messages about it.
fn read(path: &str) -> Result<grammar::DataPath, Vec<(Rule, String)>> {
    let text = format!("pub struct CreationContext {{ x: Parameter<Option<f32>, {path:?}> }}");
    let item = syn::parse_str(&text).expect("the struct is written well");
    let (context, mistakes) = parse_context(&item).expect("it is a context");
    let AnyContext::Creation(mut context) = context else {
        panic!("it is a creation context");
    };
    match context.fields.pop().map(|field| field.kind) {
        Some(CreationField::Parameter(parameter)) => Ok(parameter.path),
        _ => Err(mistakes
            .into_iter()
            .map(|mistake| (mistake.rule, mistake.message))
            .collect()),
    }
}

#[test]
fn a_path_is_read_and_shown_as_it_was_written() {
    for (text, names, optional) in [
        ("a", &["a"][..], &[false][..]),
        (
            "field_dimensions.ball_radius",
            &["field_dimensions", "ball_radius"],
            &[false, false],
        ),
        ("a?", &["a"], &[true]),
        ("a?.b.c?", &["a", "b", "c"], &[true, false, true]),
        ("_x1.größe", &["_x1", "größe"], &[false, false]),
        (
            "cameras.$cycler_instance.focal",
            &["cameras", "$cycler_instance", "focal"],
            &[false; 3],
        ),
        ("$cycler_instance", &["$cycler_instance"], &[false]),
    ] {
        let path = read(text).unwrap_or_else(|mistakes| panic!("{text}: {mistakes:?}"));
        let found: Vec<_> = path
            .segments
            .iter()
            .map(|segment| segment.name.to_string())
            .collect();
        assert_eq!(found, names, "{text}");
        let found: Vec<_> = path
            .segments
            .iter()
            .map(|segment| segment.optional)
            .collect();
        assert_eq!(found, optional, "{text}");
        assert_eq!(path.to_string(), text);
    }
}

#[test]
fn the_cycler_instance_is_no_field() {
    let path = read("a.$cycler_instance").expect("it may stand in a parameter");
    assert_eq!(path.segments[0].name, SegmentName::Field("a".into()));
    assert_eq!(path.segments[1].name, SegmentName::CyclerInstance);
    assert_eq!(path.cycler_instances(), 1);
}

#[test]
fn what_is_no_path_is_told_with_the_reason() {
    for (text, reason) in [
        ("", "a name is missing"),
        (".", "a name is missing"),
        ("a.", "a name is missing"),
        (".a", "a name is missing"),
        ("a..b", "a name is missing"),
        ("?", "a name is missing"),
        ("a??", "at most one `?` ends a name"),
        ("a?b", "at most one `?` ends a name"),
        ("a b", "`a b` is no identifier"),
        (" a", "` a` is no identifier"),
        ("1a", "`1a` is no identifier"),
        ("a.0", "`0` is no identifier"),
        ("a-b", "`a-b` is no identifier"),
        ("a.type", "`type` is a keyword of Rust"),
        ("gen.a", "`gen` is a keyword of Rust"),
        ("a._", "`_` is no identifier"),
        ("a/*x*/", "`a/*x*/` is no identifier"),
        (
            "$instance.a",
            "`$instance` is not known, only `$cycler_instance` is",
        ),
        (
            "a.$cycler_instance?",
            "`$cycler_instance` is always there, it takes no `?`",
        ),
    ] {
        let mistakes = read(text).expect_err(text);
        let expected = format!("`{text}` is no path: {reason}");
        assert_eq!(mistakes, [(Rule::InvalidPath, expected)], "{text}");
    }
}

#[test]
fn the_cycler_instance_is_named_once() {
    let mistakes = read("a.$cycler_instance.$cycler_instance").expect_err("it is named twice");
    assert_eq!(mistakes.len(), 1);
    assert_eq!(mistakes[0].0, Rule::InvalidPath);
    assert!(
        mistakes[0]
            .1
            .ends_with("names `$cycler_instance` more than once"),
        "{mistakes:?}"
    );
}
