//! The tokens that `#[context]` writes.

use proc_macro2::TokenStream as Tokens;

use super::expand;

/// What becomes of an item, without blanks.
fn expanded(item: &str) -> String {
    let tokens = item.parse::<Tokens>().expect("the item has tokens");
    expand(&Tokens::new(), tokens).to_string().replace(' ', "")
}

/// What becomes of one field of a cycle context.
fn field(kind: &str) -> String {
    let item = expanded(&format!("pub struct CycleContext {{ x: {kind} }}"));
    let start = item.find("pubx:").map_or(0, |start| start + "pubx:".len());
    let length = item[start..].find(['}', ';']).unwrap_or_default();
    item[start..start + length].to_owned()
}

fn errors(item: &str) -> usize {
    expanded(item).matches("compile_error!").count()
}

#[test]
fn every_kind_becomes_what_the_node_sees() {
    for (written, seen) in [
        ("Input<Image, \"i\">", "Input<'context,Image>"),
        (
            "Input<Option<U>, \"a?\">",
            "::core::option::Option<Input<'context,U>>",
        ),
        ("Input<Option<U>, \"a\">", "Input<'context,Option<U>>"),
        (
            "framework::Input<U, \"Control\", \"c.d\">",
            "framework::Input<'context,U>",
        ),
        (
            "RequiredInput<Option<M>, \"m?\">",
            "RequiredInput<'context,M>",
        ),
        (
            "RequiredInput<Option<M>, \"A\", \"m\">",
            "RequiredInput<'context,Option<M>>",
        ),
        ("LatestInput<T, \"A\", \"x\">", "LatestInput<&'contextT>"),
        (
            "LatestInput<Option<T>, \"A\", \"x?\">",
            "LatestInput<::core::option::Option<&'contextT>>",
        ),
        ("PreviousInput<T, \"x\">", "PreviousInput<'context,T>"),
        (
            "HistoricInput<T, \"x\">",
            "HistoricInput<'context,&'contextT>",
        ),
        (
            "PerceptionInput<T, \"A\", \"x\">",
            "PerceptionInput<'context,&'contextT>",
        ),
        (
            "PerceptionInput<Option<U>, \"A\", \"x?\">",
            "PerceptionInput<'context,::core::option::Option<&'contextU>>",
        ),
        ("Parameter<T, \"a.b\">", "Parameter<'context,T>"),
        (
            "Parameter<Option<T>, \"a?.b\">",
            "::core::option::Option<Parameter<'context,T>>",
        ),
        ("CyclerState<T, \"x\">", "CyclerState<'context,T>"),
        (
            "CyclerState<&T, \"x\">",
            "<CyclerState<'context,T>as::framework::ReadState>::Read",
        ),
        ("CycleTime", "CycleTime"),
        ("AdditionalOutput<T, \"x\">", "AdditionalOutput<'context,T>"),
        ("Procedure<A, B, \"x\">", "Procedure<'context,A,B>"),
        ("HardwareInterface", "HardwareInterface<'context,Interface>"),
        (
            "MainOutput<T>",
            "<MainOutput<T>as::framework::InPlace<'context>>::Slot",
        ),
    ] {
        assert_eq!(field(written), seen, "{written}");
        assert_eq!(
            errors(&format!("pub struct CycleContext {{ x: {written} }}")),
            0
        );
    }
}

#[test]
fn parameters_are_added_only_where_they_are_needed() {
    for (item, head) in [
        (
            "pub struct CycleContext { t: CycleTime }",
            "pubstructCycleContext{",
        ),
        (
            "struct CycleContext { t: Input<f32, \"x\"> }",
            "structCycleContext<'context>{",
        ),
        (
            "pub struct CreationContext { h: HardwareInterface }",
            "pubstructCreationContext<'context,Interface>{",
        ),
        ("pub struct MainOutputs {}", "pubstructMainOutputs{"),
        (
            "/// A.\npub struct MainOutputs { x: MainOutput<f32> }",
            "#[doc=r\"A.\"]#[repr(align(16))]pubstructMainOutputs{pubx:MainOutput<f32>}",
        ),
    ] {
        let expanded = expanded(item).replace("#[doc=\"A.\"]", "#[doc=r\"A.\"]");
        assert!(expanded.starts_with(head), "{expanded}");
    }
}

#[test]
fn types_are_required_to_be_what_the_framework_needs() {
    for (kind, requirement) in [
        ("CyclerState<&T, \"x\">", Some("data::<T>")),
        ("AdditionalOutput<T, \"x\">", Some("data::<T>")),
        ("MainOutput<T>", Some("data_in_place::<T>")),
        ("Parameter<T, \"x\">", Some("parameter_data::<T>")),
        ("Procedure<T, U, \"x\">", Some("parameter_data::<U>")),
        ("Input<T, \"x\">", None),
    ] {
        let item = expanded(&format!("pub struct CycleContext {{ x: {kind} }}"));
        match requirement {
            Some(required) => {
                let required = format!("::framework::data::require::{required}();");
                assert!(item.contains(&required), "{item}");
            }
            None => assert!(!item.contains("require"), "{item}"),
        }
    }
    let outputs = expanded("pub struct MainOutputs { x: MainOutput<T> }");
    assert!(outputs.contains("require::data::<T>();"), "{outputs}");
}

#[test]
fn one_mistake_is_one_error_and_the_field_stays_usable() {
    for (written, seen) in [
        ("Input<T, \"a..b\">", "Input<'context,T>"),
        ("Input<T>", "Input<'context,T>"),
        ("Input<T, \"a?\">", "Input<'context,T>"),
        ("Input<T, 5>", "Input<'context,T>"),
        (
            "RequiredInput<Option<T>, \"a\">",
            "RequiredInput<'context,T>",
        ),
        ("LatestInput<T, \"a\">", "LatestInput<&'contextT>"),
        ("CyclerState<&mut T, \"a\">", "CyclerState<'context,T>"),
        (
            "CyclerState<Option<T>, \"a?\">",
            "CyclerState<'context,Option<T>>",
        ),
        ("Input<&T, \"a\">", "Input<'context,T>"),
        ("CaptureTime", "CaptureTime"),
        ("Input", "()"),
        ("Imput<T, \"x\">", "()"),
        ("Vec<u8>", "Vec<u8>"),
    ] {
        assert_eq!(field(written), seen, "{written}");
        let item = format!("pub struct CycleContext {{ x: {written}, y: CycleTime }}");
        assert_eq!(errors(&item), 1, "{written}");
        assert!(expanded(&item).contains("puby:CycleTime"), "{written}");
    }
}

#[test]
fn what_is_no_context_is_told_and_left_as_it_is() {
    for item in [
        "pub struct Context { x: f32 }",
        "pub enum CycleContext { A }",
        "pub fn cycle() {}",
        "pub struct MainOutputs(f32);",
    ] {
        assert!(expanded(item).starts_with(&item.replace(' ', "")), "{item}");
        assert_eq!(errors(item), 1, "{item}");
    }
    let item = "pub struct MainOutputs {}"
        .parse()
        .expect("the item has tokens");
    let arguments = "x".parse().expect("it is a name");
    assert!(
        expand(&arguments, item)
            .to_string()
            .contains("takes no arguments")
    );
}
