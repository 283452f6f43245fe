//! Every kind in every context, written well and written wrongly.

use grammar::{
    AnyContext, ContextKind, CreationField, CycleField, Mistake, OutputField, Rule, parse_context,
};
use quote::ToTokens;

const CONTEXTS: [ContextKind; 3] = [
    ContextKind::Creation,
    ContextKind::Cycle,
    ContextKind::MainOutputs,
];

struct Read {
    text: String,
    context: AnyContext,
    mistakes: Vec<Mistake>,
}

impl Read {
    fn field(context: ContextKind, field: &str) -> Self {
        Self::item(&format!("pub struct {} {{ {field} }}", context.name()))
    }

    fn item(text: &str) -> Self {
        let item = syn::parse_str(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        let (context, mistakes) = parse_context(&item).expect("it is a context");
        Self {
            text: text.into(),
            context,
            mistakes,
        }
    }

    fn fields(&self) -> usize {
        match &self.context {
            AnyContext::Creation(context) => context.fields.len(),
            AnyContext::Cycle(context) => context.fields.len(),
            AnyContext::MainOutputs(context) => context.fields.len(),
        }
    }

    fn cycle(self) -> CycleField {
        assert!(
            self.mistakes.is_empty(),
            "{}: {:?}",
            self.text,
            self.mistakes
        );
        match self.context {
            AnyContext::Cycle(mut context) => context.fields.remove(0).kind,
            _ => panic!("{} is no cycle context", self.text),
        }
    }

    /// The one mistake: rule, marked text, message, help.
    fn mistake(&self) -> (Rule, &str, &str, &str) {
        let [mistake] = &self.mistakes[..] else {
            panic!(
                "{}: expected one mistake, not {:?}",
                self.text, self.mistakes
            );
        };
        let marked = &self.text[mistake.span.byte_range()];
        (
            mistake.rule,
            marked,
            &mistake.message,
            mistake.help.as_deref().unwrap_or(""),
        )
    }
}

fn text(data: &impl ToTokens) -> String {
    data.to_token_stream().to_string().replace(' ', "")
}

/// Every kind written well, and where it has a meaning.
const KINDS: [(&str, &str, &[ContextKind]); 14] = {
    use ContextKind::{Creation, Cycle, MainOutputs};
    [
        ("AdditionalOutput", "AdditionalOutput<f32, \"x\">", &[Cycle]),
        ("CaptureTime", "CaptureTime", &[MainOutputs]),
        ("CycleTime", "CycleTime", &[Cycle]),
        ("CyclerState", "CyclerState<f32, \"x\">", &[Creation, Cycle]),
        ("HardwareInterface", "HardwareInterface", &[Creation, Cycle]),
        ("HistoricInput", "HistoricInput<f32, \"x\">", &[Cycle]),
        ("Input", "Input<f32, \"x\">", &[Cycle]),
        (
            "LatestInput",
            "LatestInput<f32, \"Control\", \"x\">",
            &[Cycle],
        ),
        ("MainOutput", "MainOutput<f32>", &[Cycle, MainOutputs]),
        ("Parameter", "Parameter<f32, \"x\">", &[Creation, Cycle]),
        (
            "PerceptionInput",
            "PerceptionInput<f32, \"VisionTop\", \"x\">",
            &[Cycle],
        ),
        ("PreviousInput", "PreviousInput<f32, \"x\">", &[Cycle]),
        ("Procedure", "Procedure<f32, u8, \"x\">", &[Cycle]),
        (
            "RequiredInput",
            "RequiredInput<Option<f32>, \"x?\">",
            &[Cycle],
        ),
    ]
};

#[test]
fn every_kind_has_a_meaning_only_in_its_contexts() {
    for (kind, written, places) in KINDS {
        for context in CONTEXTS {
            let read = Read::field(context, &format!("field: framework::{written}"));
            if places.contains(&context) {
                assert_eq!(read.fields(), 1, "{}: {:?}", read.text, read.mistakes);
                assert!(
                    read.mistakes.is_empty(),
                    "{}: {:?}",
                    read.text,
                    read.mistakes
                );
                continue;
            }
            assert_eq!(read.fields(), 0, "{}", read.text);
            let (rule, marked, message, help) = read.mistake();
            assert_eq!((rule, marked), (Rule::MisplacedKind, kind));
            assert_eq!(
                message,
                format!("`{kind}` has no meaning in `{}`", context.name())
            );
            let places: Vec<_> = places
                .iter()
                .map(|place| format!("`{}`", place.name()))
                .collect();
            assert_eq!(
                help,
                format!("`{kind}` is allowed in {}", places.join(" and "))
            );
        }
    }
}

#[test]
fn the_fields_of_a_cycle_context_are_read() {
    let read = |field: &str| Read::field(ContextKind::Cycle, &format!("field: {field}")).cycle();
    match read(
        "Input<Vec<types::Ball>, \"VisionTop\", \"balls?.first\">"
            .replace("Vec", "Option")
            .as_str(),
    ) {
        CycleField::Input(input) => {
            assert_eq!(text(&input.data), "Option<types::Ball>");
            assert_eq!(input.instance.expect("it is named").text, "VisionTop");
            assert_eq!(input.path.to_string(), "balls?.first");
        }
        other => panic!("{other:?}"),
    }
    match read("Input<f32, \"x\">") {
        CycleField::Input(input) => assert!(input.instance.is_none()),
        other => panic!("{other:?}"),
    }
    match read("RequiredInput<f32, \"Control\", \"x\">") {
        CycleField::RequiredInput(input) => {
            assert_eq!(input.instance.expect("it is named").text, "Control");
        }
        other => panic!("{other:?}"),
    }
    for (written, shared) in [("f32", false), ("&f32", true), ("&Option<f32>", true)] {
        match read(&format!("CyclerState<{written}, \"a.b\">")) {
            CycleField::CyclerState(state) => {
                assert_eq!(text(&state.data), written.trim_start_matches('&'));
                assert_eq!(
                    (state.shared, state.path.to_string()),
                    (shared, "a.b".into())
                );
            }
            other => panic!("{other:?}"),
        }
    }
    match read("Procedure<(u8, f32), Vec<u8>, \"walk\">") {
        CycleField::Procedure(procedure) => {
            assert_eq!(text(&procedure.request), "(u8,f32)");
            assert_eq!(text(&procedure.response), "Vec<u8>");
            assert_eq!(procedure.name.text, "walk");
        }
        other => panic!("{other:?}"),
    }
    match read("MainOutput<[Image; 2]>") {
        CycleField::MainOutput(data) => assert_eq!(text(&data), "[Image;2]"),
        other => panic!("{other:?}"),
    }
    match read("AdditionalOutput<f32, \"debug.$cycler_instance.x\">") {
        CycleField::AdditionalOutput(output) => assert_eq!(output.path.cycler_instances(), 1),
        other => panic!("{other:?}"),
    }
}

#[test]
fn names_documentation_and_places_are_kept() {
    let source = "pub struct CreationContext {\n    /// In metres.\n    ///\n    /// Measured.\n    radius: framework::Parameter<f32, \"a\">,\n    pub hardware: HardwareInterface,\n}";
    let read = Read::item(source);
    let AnyContext::Creation(context) = read.context else {
        panic!("{source}")
    };
    let [radius, hardware] = &context.fields[..] else {
        panic!("{:?}", context.fields)
    };
    assert_eq!(radius.name, "radius");
    assert_eq!(radius.docs, ["In metres.", "", "Measured."]);
    assert_eq!(text(&radius.kind_path), "framework::Parameter");
    assert_eq!(
        &source[radius.span.byte_range()],
        "framework::Parameter<f32, \"a\">"
    );
    assert_eq!(&source[context.name_span.byte_range()], "CreationContext");
    let CreationField::Parameter(parameter) = &radius.kind else {
        panic!("{radius:?}")
    };
    assert_eq!(&source[parameter.path.span.byte_range()], "\"a\"");
    assert!(matches!(hardware.kind, CreationField::HardwareInterface));
}

#[test]
fn wrong_arguments_are_marked_and_told_with_the_form() {
    for (field, marked, start) in [
        ("Input", "Input", "`Input` lacks a type"),
        ("Input<f32>", "Input<f32>", "`Input` lacks its path"),
        ("Input<\"x\">", "Input<\"x\">", "`Input` lacks a type"),
        (
            "Input<f32, u8, \"x\">",
            "Input<f32, u8, \"x\">",
            "`Input` has too many types",
        ),
        (
            "Input<f32, \"A\", \"x\", \"y\">",
            "Input<f32, \"A\", \"x\", \"y\">",
            "`Input` has too many strings",
        ),
        ("Input<f32, 5>", "5", "unexpected `5`, which is no string"),
        (
            "Input<f32, b\"x\">",
            "b\"x\"",
            "unexpected `b\"x\"`, which is no string",
        ),
        (
            "Input<f32, 'x'>",
            "'x'",
            "unexpected `'x'`, which is no string",
        ),
        (
            "Input<f32, { \"x\" }>",
            "{ \"x\" }",
            "unexpected `{ \"x\" }`, which is no string",
        ),
        (
            "Input<\"x\", f32>",
            "f32",
            "unexpected `f32` behind a string",
        ),
        ("Input<'a, f32, \"x\">", "'a", "unexpected `'a`"),
        (
            "Input<f32, PATH>",
            "Input<f32, PATH>",
            "`Input` has too many types",
        ),
        (
            "LatestInput<f32, \"x\">",
            "LatestInput<f32, \"x\">",
            "`LatestInput` needs an instance and a path",
        ),
        (
            "PerceptionInput<f32>",
            "PerceptionInput<f32>",
            "`PerceptionInput` lacks its path",
        ),
        (
            "PreviousInput<f32, \"A\", \"x\">",
            "PreviousInput<f32, \"A\", \"x\">",
            "`PreviousInput` has too many strings",
        ),
        (
            "Procedure<f32, \"x\">",
            "Procedure<f32, \"x\">",
            "`Procedure` lacks a type",
        ),
        (
            "Procedure<f32, u8>",
            "Procedure<f32, u8>",
            "`Procedure` lacks its name",
        ),
        (
            "CycleTime<f32>",
            "CycleTime<f32>",
            "`CycleTime` has too many types",
        ),
        (
            "HardwareInterface<\"x\">",
            "HardwareInterface<\"x\">",
            "`HardwareInterface` has too many strings",
        ),
        (
            "MainOutput<f32, \"x\">",
            "MainOutput<f32, \"x\">",
            "`MainOutput` has too many strings",
        ),
    ] {
        let read = Read::field(ContextKind::Cycle, &format!("field: {field}"));
        let (rule, found, message, _) = read.mistake();
        assert_eq!((rule, found), (Rule::InvalidField, marked), "{field}");
        assert!(message.starts_with(start), "{field}: {message}");
        let kind = field.split(['<', '(']).next().unwrap_or_default();
        assert!(
            message.contains(&format!(": expected `{kind}")),
            "{field}: {message}"
        );
    }
}

#[test]
fn a_reference_is_no_data_type() {
    for (field, marked) in [
        ("Input<&f32, \"x\">", "&f32"),
        ("Parameter<&'static f32, \"x\">", "&'static f32"),
        ("MainOutput<&mut f32>", "&mut f32"),
        ("Procedure<u8, &f32, \"x\">", "&f32"),
        ("CyclerState<&mut f32, \"x\">", "&mut f32"),
        ("CyclerState<&'a f32, \"x\">", "&'a f32"),
    ] {
        let read = Read::field(ContextKind::Cycle, &format!("field: {field}"));
        let (rule, found, _, help) = read.mistake();
        assert_eq!((rule, found), (Rule::InvalidField, marked), "{field}");
        assert!(!help.is_empty(), "{field}");
    }
}

#[test]
fn what_owns_the_value_of_a_reference_is_told() {
    for (field, expected) in [
        ("MainOutput<&'static str>", "write `String`"),
        ("Parameter<&[u8], \"x\">", "write `Vec<u8>`"),
        ("Parameter<&u8, \"x\">", "write `u8` without `&`"),
    ] {
        let read = Read::field(ContextKind::Cycle, &format!("field: {field}"));
        let (_, _, _, help) = read.mistake();
        assert_eq!(help, expected, "{field}");
    }
}

#[test]
fn question_marks_and_options_agree() {
    for field in [
        "Input<Option<f32>, \"x\">",
        "Input<Option<f32>, \"a?.x\">",
        "Input<std::option::Option<f32>, \"A\", \"x?\">",
        "LatestInput<Option<f32>, \"A\", \"x?\">",
        "PerceptionInput<Option<f32>, \"A\", \"x?\">",
        "Parameter<Option<f32>, \"x?\">",
        "RequiredInput<Option<f32>, \"A\", \"x?\">",
        "RequiredInput<Option<f32>, \"A\", \"x\">",
        "CyclerState<Option<f32>, \"x\">",
    ] {
        let read = Read::field(ContextKind::Cycle, &format!("field: {field}"));
        assert!(read.mistakes.is_empty(), "{field}: {:?}", read.mistakes);
    }
    for (field, marked, message) in [
        (
            "Input<f32, \"x?\">",
            "f32",
            "`x?` may be absent, so the type is written `Option<…>`, not `f32`",
        ),
        (
            "RequiredInput<types::Ball, \"A\", \"x?\">",
            "types::Ball",
            "`x?` may be absent, so the type is written `Option<…>`, not `types::Ball`",
        ),
        (
            "HistoricInput<Vec<Option<f32>>, \"x?\">",
            "Vec<Option<f32>>",
            "`x?` may be absent, so the type is written `Option<…>`, not `Vec<Option<f32>>`",
        ),
        (
            "RequiredInput<Option<f32>, \"x\">",
            "\"x\"",
            "`x` is never absent: `RequiredInput` needs a `?` or another instance",
        ),
        (
            "CyclerState<Option<f32>, \"x?\">",
            "\"x?\"",
            "the path `x?` of `CyclerState` has a `?`: it names what is there always",
        ),
        (
            "AdditionalOutput<f32, \"a?.x\">",
            "\"a?.x\"",
            "the path `a?.x` of `AdditionalOutput` has a `?`: it names what is there always",
        ),
    ] {
        let read = Read::field(ContextKind::Cycle, &format!("field: {field}"));
        let (rule, found, told, _) = read.mistake();
        assert_eq!(
            (rule, found, told),
            (Rule::OptionMismatch, marked, message),
            "{field}"
        );
    }
}

#[test]
fn the_cycler_instance_has_a_meaning_in_two_kinds() {
    for (kind, arguments) in [
        ("Input", "f32, \"$cycler_instance.x\""),
        ("PreviousInput", "f32, \"$cycler_instance.x\""),
        ("HistoricInput", "f32, \"$cycler_instance.x\""),
        ("LatestInput", "f32, \"A\", \"$cycler_instance.x\""),
        ("PerceptionInput", "f32, \"A\", \"$cycler_instance.x\""),
        ("CyclerState", "f32, \"$cycler_instance.x\""),
    ] {
        let read = Read::field(ContextKind::Cycle, &format!("field: {kind}<{arguments}>"));
        let (rule, found, message, _) = read.mistake();
        assert_eq!((rule, found), (Rule::InvalidPath, "\"$cycler_instance.x\""));
        assert_eq!(
            message,
            format!(
                "`$cycler_instance` has no meaning in `{kind}`, only in `AdditionalOutput` and `Parameter`"
            )
        );
    }
}

#[test]
fn names_are_identifiers_and_come_before_the_path() {
    let read = Read::field(
        ContextKind::Cycle,
        "field: Input<f32, \"Vision Top\", \"x\">",
    );
    let (rule, marked, message, _) = read.mistake();
    assert_eq!((rule, marked), (Rule::InvalidName, "\"Vision Top\""));
    assert_eq!(
        message,
        "`Vision Top` is no name of an instance: expected one identifier"
    );
    let read = Read::field(ContextKind::Cycle, "field: Procedure<f32, f32, \"a.b\">");
    assert_eq!(
        read.mistake().2,
        "`a.b` is no name of a procedure: expected one identifier"
    );
    let read = Read::field(
        ContextKind::Cycle,
        "field: Input<f32, \"sensor_data\", \"Control\">",
    );
    let (rule, marked, message, _) = read.mistake();
    assert_eq!((rule, marked), (Rule::InvalidField, "\"sensor_data\""));
    assert_eq!(
        message,
        "the path `sensor_data` stands before the instance `Control`"
    );
}

#[test]
fn an_unknown_kind_is_told_with_the_nearest_or_all() {
    let read = Read::field(ContextKind::Cycle, "field: framework::Imput<f32, \"x\">");
    assert_eq!(
        read.mistake(),
        (
            Rule::UnknownKind,
            "Imput",
            "`Imput` is no kind of field",
            "did you mean `Input`?"
        )
    );
    for field in ["Vec<u8>", "&f32", "(f32, u8)", "<A as B>::C"] {
        let read = Read::field(ContextKind::Creation, &format!("field: {field}"));
        let (rule, _, _, help) = read.mistake();
        assert_eq!(rule, Rule::UnknownKind, "{field}");
        assert_eq!(
            help, "`CreationContext` may have `CyclerState`, `HardwareInterface`, `Parameter`",
            "{field}"
        );
    }
}

#[test]
fn a_field_is_not_conditional_and_an_output_no_keyword() {
    let read = Read::field(ContextKind::Cycle, "#[cfg(test)] field: CycleTime");
    assert_eq!(
        (read.mistake().0, read.mistake().1),
        (Rule::InvalidField, "#[cfg(test)]")
    );
    for name in ["r#type", "gen", "r#gen"] {
        let field = format!("{name}: MainOutput<f32>");
        let read = Read::field(ContextKind::MainOutputs, &field);
        assert_eq!(
            (read.mistake().0, read.mistake().1),
            (Rule::InvalidName, name)
        );
    }
    let read = Read::field(ContextKind::MainOutputs, "r#speed: MainOutput<f32>");
    assert!(read.mistakes.is_empty(), "`r#speed` is `speed`");
    for field in [
        "r#type: Input<f32, \"x\">",
        "r#type: Parameter<f32, \"x\">",
        "r#type: CycleTime",
    ] {
        let read = Read::field(ContextKind::Cycle, field);
        assert!(read.mistakes.is_empty(), "{field}");
    }
}

#[test]
fn no_parameter_lies_where_the_hardware_of_targets_does() {
    for path in ["hardware", "hardware.x"] {
        let field = format!("field: Parameter<f32, \"{path}\">");
        let read = Read::field(ContextKind::Cycle, &field);
        let (rule, marked, message, _) = read.mistake();
        assert_eq!(
            (rule, marked),
            (Rule::InvalidPath, &*format!("\"{path}\"")),
            "{message}"
        );
        assert!(
            message.contains("`hardware` belongs to the targets"),
            "{message}"
        );
    }
    for field in [
        "field: Parameter<f32, \"x.hardware\">",
        "field: CyclerState<f32, \"hardware.x\">",
    ] {
        let read = Read::field(ContextKind::Cycle, field);
        assert!(read.mistakes.is_empty(), "{field}");
    }
}

#[test]
fn a_struct_is_public_with_named_fields_and_no_parameters() {
    for (item, marked, message) in [
        (
            "struct MainOutputs {}",
            "MainOutputs",
            "`MainOutputs` is not public",
        ),
        (
            "pub(crate) struct CycleContext {}",
            "CycleContext",
            "`CycleContext` is not public",
        ),
        (
            "pub struct CycleContext<'a> {}",
            "'a",
            "`CycleContext` has parameters of its own",
        ),
        (
            "pub struct CycleContext<T: Copy> {}",
            "T: Copy",
            "`CycleContext` has parameters of its own",
        ),
        (
            "pub struct CreationContext;",
            "CreationContext",
            "`CreationContext` has no named fields",
        ),
        (
            "pub struct MainOutputs(f32);",
            "MainOutputs",
            "`MainOutputs` has no named fields",
        ),
    ] {
        let read = Read::item(item);
        let (rule, found, told, help) = read.mistake();
        assert_eq!(
            (rule, found, told),
            (Rule::InvalidContext, marked, message),
            "{item}"
        );
        assert!(!help.is_empty(), "{item}");
    }
}

#[test]
fn one_field_with_a_mistake_does_not_hide_the_others() {
    let read = Read::item(
        "pub struct MainOutputs { a: MainOutput<f32>, b: Input<f32, \"x\">, c: CaptureTime, d: MainOutput }",
    );
    let rules: Vec<_> = read.mistakes.iter().map(|mistake| mistake.rule).collect();
    assert_eq!(rules, [Rule::MisplacedKind, Rule::InvalidField]);
    let AnyContext::MainOutputs(context) = read.context else {
        panic!("{}", read.text)
    };
    assert!(matches!(context.fields[0].kind, OutputField::MainOutput(_)));
    assert!(matches!(context.fields[1].kind, OutputField::CaptureTime));
    assert_eq!(context.fields.len(), 2);
}

#[test]
fn a_cycle_has_one_capture_time() {
    let read = Read::item("pub struct MainOutputs { a: CaptureTime, b: framework::CaptureTime }");
    let (rule, marked, message, _) = read.mistake();
    assert_eq!(
        (rule, marked),
        (Rule::InvalidField, "framework::CaptureTime")
    );
    assert_eq!(
        message,
        "`a` and `b` are both the capture time: a cycle has one"
    );
}

#[test]
fn a_struct_of_another_name_is_no_context() {
    let item = syn::parse_str("pub struct Context { a: CycleTime }").expect("it is a struct");
    assert!(parse_context(&item).is_none());
}

#[test]
fn the_attribute_is_known_by_its_last_segment() {
    let item: syn::ItemStruct =
        syn::parse_str("#[context] #[framework::context] #[derive(Debug)] struct A;")
            .expect("it is a struct");
    let found: Vec<_> = item
        .attrs
        .iter()
        .map(grammar::is_context_attribute)
        .collect();
    assert_eq!(found, [true, true, false]);
}

#[test]
fn the_argument_of_an_option_is_found() {
    for (data, inner) in [
        ("Option<f32>", Some("f32")),
        ("std::option::Option<Vec<u8>>", Some("Vec<u8>")),
        ("(Option<f32>)", Some("f32")),
        ("Vec<Option<f32>>", None),
        ("Option", None),
        ("Option<f32, u8>", None),
        ("[Option<f32>; 2]", None),
    ] {
        let data = syn::parse_str(data).expect("it is a type");
        assert_eq!(grammar::option_argument(&data).map(text).as_deref(), inner);
    }
}

#[test]
fn only_parameters_have_units_and_ranges() {
    let read = Read::item(
        "pub struct CycleContext { #[reflect(unit = \"m\", range = 0..)] a: Parameter<f32, \"a\"> }",
    );
    assert!(read.mistakes.is_empty(), "{:?}", read.mistakes);
    let AnyContext::Cycle(context) = &read.context else {
        panic!("it is a cycle context");
    };
    let hints = &context.fields[0].hints;
    assert_eq!(
        hints.unit.as_ref().map(syn::LitStr::value).as_deref(),
        Some("m")
    );
    assert!(hints.range.is_some());
    for (field, marked, message) in [
        (
            "#[reflect(unit = \"m\")] a: Input<f32, \"a\">",
            "Input<f32, \"a\">",
            "`Input` has no unit and no range: its type says them",
        ),
        (
            "#[reflect(range = 2..1)] a: Parameter<f32, \"a\">",
            "2..1",
            "the range is empty",
        ),
        (
            "#[reflect(skip)] a: Parameter<f32, \"a\">",
            "#[reflect(skip)]",
            "a field of a context says `unit` and `range`: a parameter that only `new` reads is known to be",
        ),
    ] {
        let read = Read::item(&format!("pub struct CycleContext {{ {field} }}"));
        let (rule, found, said, _) = read.mistake();
        assert_eq!(
            (rule, found, said),
            (Rule::InvalidField, marked, message),
            "{field}"
        );
    }
}
