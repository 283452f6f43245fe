//! The node of a file and its functions.

use grammar::{Mistake, Rule, Signatures, find_node};
use quote::ToTokens;

const CONTEXTS: &str = "
    #[context] pub struct CreationContext { hardware: HardwareInterface }
    #[context] pub struct CycleContext { hardware: HardwareInterface }
    #[context] pub struct MainOutputs {}
    pub struct Node {}
";
const NO_HARDWARE: &str = "
    #[context] pub struct CreationContext {}
    #[context] pub struct CycleContext {}
    #[context] pub struct MainOutputs {}
    pub struct Node {}
";
const NEW: &str = "pub fn new(context: CreationContext) -> Result<Self> { todo() }";
const CYCLE: &str =
    "pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> { todo() }";

fn read(source: &str) -> (Option<Signatures>, Vec<Mistake>) {
    find_node(&syn::parse_file(source).expect("the file is written well"))
}

fn found(source: &str) -> Signatures {
    let (signatures, mistakes) = read(source);
    signatures.unwrap_or_else(|| panic!("{source}: {mistakes:?}"))
}

fn bounds(signature: &grammar::Signature) -> Vec<String> {
    signature
        .bounds
        .iter()
        .map(|path| path.to_token_stream().to_string().replace(' ', ""))
        .collect()
}

#[test]
fn the_plain_form_is_found() {
    let source = format!("{NO_HARDWARE} impl Node {{ {NEW} {CYCLE} }}");
    let node = found(&source);
    assert_eq!(node.node, "Node");
    assert!(node.new.bounds.is_empty() && node.cycle.bounds.is_empty() && node.restore.is_none());
    assert_eq!(&source[node.new.span.byte_range()], "new");
    assert_eq!(&source[node.cycle.span.byte_range()], "cycle");
}

#[test]
fn any_result_and_any_way_to_name_a_type_will_do() {
    for implementation in [
        "impl Node { pub fn new(_: CreationContext) -> anyhow::Result<Node> { x } pub fn cycle(&mut self, _: CycleContext) -> framework::Result<self::MainOutputs> { x } }",
        "impl Node { pub fn new(_: self::CreationContext) -> std::result::Result<Self, Wrong> { x } pub fn cycle(self: &mut Self, _: CycleContext) -> LoadResult<MainOutputs> { x } }",
        "impl Node { pub fn cycle<'a>(&'a mut self, _: CycleContext<'a>) -> Result<MainOutputs> { x } } impl Node { pub const fn new(_: CreationContext<'_>) -> Result<Self> { x } }",
        "impl self::Node { pub fn new(CreationContext {}: CreationContext) -> Result<Self, String> { x } pub fn cycle(&mut self, _: CycleContext) -> Result<MainOutputs> { x } }",
    ] {
        assert_eq!(
            found(&format!("{NO_HARDWARE} {implementation}")).node,
            "Node"
        );
    }
}

#[test]
fn traits_are_read_from_every_form() {
    for (cycle, expected) in [
        ("cycle(&mut self, c: CycleContext<impl A>)", &["A"][..]),
        (
            "cycle(&mut self, c: CycleContext<impl A + hardware::B>)",
            &["A", "hardware::B"],
        ),
        (
            "cycle(&mut self, c: CycleContext<'_, impl A + ?Sized + 'static + A>)",
            &["A"],
        ),
        (
            "cycle<H: A + B>(&mut self, c: CycleContext<H>)",
            &["A", "B"],
        ),
        ("cycle<'a, H>(&mut self, c: CycleContext<'a, H>)", &[]),
        ("cycle<H: A>(&mut self, c: CycleContext<'_, H>)", &["A"]),
        (
            "cycle<H: h::H + B<'static>>(&mut self, c: CycleContext<H>)",
            &["h::H", "B<'static>"],
        ),
        (
            "cycle(&mut self, c: CycleContext<impl A<dyn for<'a> F<'a>>>)",
            &["A<dynfor<'a>F<'a>>"],
        ),
    ] {
        let source = format!(
            "{CONTEXTS} impl Node {{ pub fn new(c: CreationContext<impl N>) -> Result<Self> {{ x }} pub fn {cycle} -> Result<MainOutputs> {{ x }} }}"
        );
        let node = found(&source);
        assert_eq!(bounds(&node.cycle), expected, "{cycle}");
        assert_eq!(bounds(&node.new), ["N"]);
    }
    for (cycle, is_static) in [
        ("cycle(&mut self, c: CycleContext<'static, impl A>)", false),
        (
            "cycle<'a>(&mut self, c: CycleContext<'a, impl A + 'a>)",
            false,
        ),
        ("cycle(&mut self, c: CycleContext<impl A + 'static>)", true),
        ("cycle<H: 'static>(&mut self, c: CycleContext<H>)", true),
    ] {
        let source = format!(
            "{CONTEXTS} impl Node {{ pub fn new(c: CreationContext<impl N>) -> Result<Self> {{ x }} pub fn {cycle} -> Result<MainOutputs> {{ x }} }}"
        );
        assert_eq!(found(&source).cycle.is_static, is_static, "{cycle}");
    }
    let source = format!("{CONTEXTS} impl Node {{
        pub fn new<T>(c: CreationContext<T>) -> Result<Self> where T: N, T: M + N {{ x }}
        pub fn cycle<H: A>(&mut self, c: CycleContext<H>) -> Result<MainOutputs> where H: B + A, Vec<u8>: Sized {{ x }}
        pub fn restore(&mut self, c: CreationContext<impl R>) -> Result<()> {{ x }}
    }}");
    let node = found(&source);
    assert_eq!(bounds(&node.new), ["N", "M"]);
    assert_eq!(bounds(&node.cycle), ["A", "B"]);
    assert_eq!(bounds(&node.restore.expect("it is there")), ["R"]);
}

#[test]
fn other_types_and_functions_do_not_disturb() {
    let source = format!("{NO_HARDWARE}
        struct Helper;
        impl Helper {{ fn new() -> Self {{ Self }} fn cycle(&self) {{}} fn restore(&mut self) {{}} }}
        struct Prepared<'a>(&'a f32);
        impl<'a> Prepared<'a> {{ fn new(context: &'a CreationContext) -> Self {{ x }} }}
        impl Default for Node {{ fn default() -> Self {{ x }} }}
        impl Step for Helper {{ fn new(context: CreationContext) {{}} fn cycle(&mut self, context: CycleContext) {{}} }}
        impl Node {{ {NEW} {CYCLE} fn restore(&mut self, x: f32) {{}} fn helper(&self) {{}} }}
        #[cfg(test)] mod tests {{ struct Other; impl Other {{ {NEW} {CYCLE} }} }}
    ");
    let node = found(&source);
    assert_eq!(node.node, "Node");
    assert!(node.restore.is_none());
}

#[test]
fn a_node_has_no_arguments() {
    for (node, part) in [
        ("Node<f32>", "parameters"),
        ("Node<4>", "parameters"),
        ("Node<'static>", "parameters"),
        ("Node<'_>", "parameters"),
    ] {
        let source = format!("{NO_HARDWARE} impl {node} {{ {NEW} {CYCLE} }}");
        let (found, mistakes) = read(&source);
        assert!(found.is_none() && mistakes.len() == 1, "{mistakes:?}");
        assert_eq!(mistakes[0].rule, Rule::InvalidSignature);
        assert!(mistakes[0].message.contains(part), "{mistakes:?}");
        let place = &source[mistakes[0].span.byte_range()];
        assert_eq!(format!("Node<{place}>"), node);
        let help = mistakes[0].help.as_deref().unwrap_or_default();
        assert!(help.contains("give its struct no parameters"), "{help}");
    }
    found(&format!("{NO_HARDWARE} impl Node<> {{ {NEW} {CYCLE} }}"));
}

/// The one mistake of a node whose `new`, `cycle` and `restore` are these.
fn mistake(contexts: &str, functions: &str) -> (Rule, String, String, String) {
    let source = format!("{contexts} impl Node {{ {functions} }}");
    let (signatures, mistakes) = read(&source);
    assert!(signatures.is_none(), "{functions}");
    let [mistake] = &mistakes[..] else {
        panic!("{functions}: {mistakes:?}")
    };
    let marked = source[mistake.span.byte_range()].to_owned();
    (
        mistake.rule,
        marked,
        mistake.message.clone(),
        mistake.help.clone().unwrap_or_default(),
    )
}

#[test]
fn a_wrong_new_is_told_with_the_expected_form() {
    for (new, marked, message) in [
        (
            "fn new(c: CreationContext) -> Result<Self> { x }",
            "new",
            "`new` is not public",
        ),
        (
            "pub async fn new(c: CreationContext) -> Result<Self> { x }",
            "async",
            "`new` is `async`",
        ),
        (
            "pub unsafe fn new(c: CreationContext) -> Result<Self> { x }",
            "unsafe",
            "`new` is `unsafe`",
        ),
        (
            "pub fn new(&self, c: CreationContext) -> Result<Self> { x }",
            "&self",
            "`new` takes `self`",
        ),
        (
            "pub fn new() -> Result<Self> { x }",
            "new",
            "`new` does not take a `CreationContext`",
        ),
        (
            "pub fn new(c: &CreationContext) -> Result<Self> { x }",
            "&CreationContext",
            "`new` does not take a `CreationContext` by value",
        ),
        (
            "pub fn new(c: CycleContext) -> Result<Self> { x }",
            "CycleContext",
            "`new` does not take a `CreationContext` by value",
        ),
        (
            "pub fn new(c: CreationContext, d: f32) -> Result<Self> { x }",
            "d: f32",
            "`new` takes more than a `CreationContext`",
        ),
        (
            "pub fn new(c: CreationContext) -> Self { x }",
            "Self",
            "`new` does not return a `Result<Self>`",
        ),
        (
            "pub fn new(c: CreationContext) { x }",
            "new",
            "`new` does not return a `Result<Self>`",
        ),
        (
            "pub fn new(c: CreationContext) -> Option<Self> { x }",
            "Option<Self>",
            "`new` does not return a `Result<Self>`",
        ),
        (
            "pub fn new(c: CreationContext) -> Result<f32> { x }",
            "Result<f32>",
            "`new` does not return a `Result<Self>`",
        ),
        (
            "pub fn new(c: CreationContext) -> Result { x }",
            "Result",
            "`new` does not return a `Result<Self>`",
        ),
        (
            "pub fn new<T: Default>(c: CreationContext) -> Result<Self> { x }",
            "T",
            "nothing tells what `T` of `new` is",
        ),
        (
            "pub fn new<const N: usize>(c: CreationContext) -> Result<Self> { x }",
            "N",
            "nothing tells what `N` of `new` is",
        ),
        (
            "pub fn new(c: CreationContext<impl A>) -> Result<Self> { x }",
            "impl A",
            "`CreationContext` has no field `HardwareInterface`",
        ),
    ] {
        let (rule, found, told, help) = mistake(NO_HARDWARE, &format!("{new} {CYCLE}"));
        assert_eq!(
            (rule, &*found, &*told),
            (Rule::InvalidSignature, marked, message),
            "{new}"
        );
        assert_eq!(
            help,
            "expected `pub fn new(context: CreationContext) -> Result<Self>`"
        );
    }
}

#[test]
fn a_wrong_cycle_is_told_with_the_expected_form() {
    for (cycle, marked, message) in [
        (
            "pub fn cycle(&self, c: CycleContext<impl A>) -> Result<MainOutputs> { x }",
            "&self",
            "`cycle` does not take `&mut self`",
        ),
        (
            "pub fn cycle(mut self, c: CycleContext<impl A>) -> Result<MainOutputs> { x }",
            "mut self",
            "`cycle` does not take `&mut self`",
        ),
        (
            "pub fn cycle(c: CycleContext<impl A>) -> Result<MainOutputs> { x }",
            "cycle",
            "`cycle` lacks `&mut self`",
        ),
        (
            "pub fn cycle(&mut self) -> Result<MainOutputs> { x }",
            "cycle",
            "`cycle` does not take a `CycleContext`",
        ),
        (
            "pub fn cycle(&mut self, c: CycleContext<impl A>) -> Result<()> { x }",
            "Result<()>",
            "`cycle` does not return a `Result<MainOutputs>`",
        ),
        (
            "pub fn cycle(&mut self, c: CycleContext<impl A>) -> MainOutputs { x }",
            "MainOutputs",
            "`cycle` does not return a `Result<MainOutputs>`",
        ),
        (
            "pub fn cycle(&mut self, c: CycleContext) -> Result<MainOutputs> { x }",
            "CycleContext",
            "`cycle` does not name the hardware traits of the `HardwareInterface` in `CycleContext`",
        ),
        (
            "pub fn cycle(&mut self, c: CycleContext<nao::Hardware>) -> Result<MainOutputs> { x }",
            "nao::Hardware",
            "`cycle` asks for the hardware `nao::Hardware`: a node works with any that has the traits it names",
        ),
    ] {
        let new = "pub fn new(c: CreationContext<impl A>) -> Result<Self> { x }";
        let (rule, found, told, help) = mistake(CONTEXTS, &format!("{new} {cycle}"));
        assert_eq!(
            (rule, &*found, &*told),
            (Rule::InvalidSignature, marked, message),
            "{cycle}"
        );
        assert_eq!(
            help,
            "expected `pub fn cycle(&mut self, context: CycleContext<impl Trait>) -> Result<MainOutputs>`"
        );
    }
}

#[test]
fn what_generated_code_cannot_ask_of_the_hardware_is_refused() {
    for (cycle, marked, message) in [
        (
            "cycle(&mut self, c: CycleContext<impl for<'a> A<'a>>) -> Result<MainOutputs>",
            "'a",
            "`cycle` asks for a trait with every `'a`, which generated code cannot do: declare it at methods of the trait",
        ),
        (
            "cycle<'b>(&mut self, c: CycleContext<impl A<&'b u8>>) -> Result<MainOutputs>",
            "'b",
            "`cycle` asks for a trait with `'b`, which only its signature knows",
        ),
        (
            "cycle<H>(&mut self, c: CycleContext<H>) -> Result<MainOutputs> where for<'a> H: A<'a>",
            "'a",
            "`cycle` asks for a trait with every `'a`, which generated code cannot do: declare it at methods of the trait",
        ),
        (
            "cycle<H: A<H::Speed>>(&mut self, c: CycleContext<H>) -> Result<MainOutputs>",
            "A<H::Speed>",
            "`cycle` asks for a trait with `H`, which only its signature knows",
        ),
        (
            "cycle<H>(&mut self, c: CycleContext<H>) -> Result<MainOutputs> where H: A, H::Speed: B",
            "H::Speed",
            "`cycle` asks for traits of `H::Speed`: only those of `H` itself can be asked for",
        ),
        (
            "cycle<H: A>(&mut self, c: CycleContext<H>) -> Result<MainOutputs> where <H as A>::Speed: B",
            "<H as A>::Speed",
            "`cycle` asks for traits of `<H as A>::Speed`: only those of `H` itself can be asked for",
        ),
        (
            "cycle<H: A>(&mut self, c: CycleContext<H>) -> Result<MainOutputs> where Vec<H>: B",
            "Vec<H>",
            "`cycle` asks for traits of `Vec<H>`: only those of `H` itself can be asked for",
        ),
    ] {
        let new = "pub fn new(c: CreationContext<impl A>) -> Result<Self> { x }";
        let (rule, found, told, _) = mistake(CONTEXTS, &format!("{new} pub fn {cycle} {{ x }}"));
        assert_eq!(
            (rule, &*found, &*told),
            (Rule::InvalidSignature, marked, message),
            "{cycle}"
        );
    }
}

#[test]
fn a_wrong_restore_is_told_with_the_expected_form() {
    for (restore, marked, message) in [
        (
            "pub fn restore(&mut self) -> Result<()> { x }",
            "restore",
            "`restore` does not take a `CreationContext`",
        ),
        (
            "fn restore(&mut self, c: CreationContext) -> Result<()> { x }",
            "restore",
            "`restore` is not public",
        ),
        (
            "pub fn restore(&mut self, c: CreationContext) -> Result<Self> { x }",
            "Result<Self>",
            "`restore` does not return a `Result<()>`",
        ),
        (
            "pub fn restore(&mut self, c: CreationContext) { x }",
            "restore",
            "`restore` does not return a `Result<()>`",
        ),
    ] {
        let (rule, found, told, help) = mistake(NO_HARDWARE, &format!("{NEW} {CYCLE} {restore}"));
        assert_eq!(
            (rule, &*found, &*told),
            (Rule::InvalidSignature, marked, message),
            "{restore}"
        );
        assert_eq!(
            help,
            "expected `pub fn restore(&mut self, context: CreationContext) -> Result<()>`"
        );
    }
}

#[test]
fn a_missing_function_is_told_at_the_node() {
    let (rule, marked, message, help) = mistake(NO_HARDWARE, CYCLE);
    assert_eq!(
        (rule, &*marked, &*message),
        (Rule::InvalidSignature, "Node", "`Node` has no `new`")
    );
    assert_eq!(
        help,
        "expected `pub fn new(context: CreationContext) -> Result<Self>`"
    );
    let (_, _, message, _) = mistake(NO_HARDWARE, NEW);
    assert_eq!(message, "`Node` has no `cycle`");
}

#[test]
fn a_node_is_public_and_has_no_parameters() {
    let source = format!("struct Node; impl Node {{ {NEW} {CYCLE} }}");
    let (signatures, mistakes) = read(&source);
    assert!(signatures.is_none());
    assert_eq!(mistakes[0].message, "the node `Node` is not public");
    for (parameters, message) in [
        ("T", "the node `Node` has type parameters"),
        ("'a", "the node `Node` has lifetimes"),
        ("const N: usize", "the node `Node` has const parameters"),
    ] {
        let source = format!("impl<{parameters}> Node<X> {{ {NEW} {CYCLE} }}");
        let (signatures, mistakes) = read(&source);
        assert!(signatures.is_none());
        assert_eq!((mistakes.len(), &*mistakes[0].message), (1, message));
    }
}

#[test]
fn two_nodes_in_one_file_are_ambiguous() {
    let source =
        format!("{NO_HARDWARE} impl Node {{ {NEW} {CYCLE} }} impl Other {{ {NEW} {CYCLE} }}");
    let (signatures, mistakes) = read(&source);
    assert!(signatures.is_none());
    assert_eq!(mistakes.len(), 1);
    assert_eq!(mistakes[0].rule, Rule::AmbiguousNode);
    assert_eq!(
        mistakes[0].message,
        "`Node`, `Other` could all be the node of this file"
    );
    assert_eq!(&source[mistakes[0].span.byte_range()], "Other");
}

#[test]
fn a_file_without_a_node_is_told_at_its_cycle_context() {
    for (source, marked) in [
        (NO_HARDWARE, "CycleContext"),
        (
            "struct Helper; impl Helper { fn new() -> Self { Self } }",
            "struct Helper;",
        ),
        ("", ""),
    ] {
        let (signatures, mistakes) = read(source);
        assert!(signatures.is_none());
        assert_eq!(mistakes.len(), 1, "{source}");
        assert_eq!(mistakes[0].rule, Rule::MissingNode);
        assert_eq!(&source[mistakes[0].span.byte_range()], marked);
    }
}
