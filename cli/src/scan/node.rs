//! One node file: its three structs, its functions, its state.

use std::rc::Rc;

use grammar::{
    AnyContext, Context, ContextKind, CreationField, CycleField, Mistake, OutputField, Rule,
};
use syn::{Attribute, Item, ItemStruct, Type};

use super::library::Library;
use super::module::{Module, only_for_tests};
use super::state::{self, StateSource};
use super::{doc, range};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};

/// A node as its file describes it.
#[derive(Clone, Debug)]
pub struct NodeSource {
    /// As in the manifest; also the path by which generated code names its module.
    pub path: String,
    pub module: Rc<Module>,
    /// First sentence of the file's documentation, if any.
    pub summary: Option<String>,
    pub creation: Context<CreationField>,
    pub cycle: Context<CycleField>,
    pub outputs: Context<OutputField>,
    pub signatures: grammar::Signatures,
    /// The node's struct; `None` if only a macro of this file can have written it.
    pub state: Option<StateSource>,
}

/// Reads a node file; `None` if a part of it is missing, which is then reported.
pub(super) fn scan(
    library: &Library<'_>,
    path: &str,
    module: Rc<Module>,
    diagnostics: &mut Diagnostics,
) -> Option<NodeSource> {
    let meaning = |data: &Type| library.meaning_of_result(&module, data);
    let (signatures, mistakes) = grammar::find_node_with(&module.syntax, &meaning);
    report(&module, mistakes, diagnostics);
    let contexts = read_contexts(&module, diagnostics);
    let signatures = signatures?;
    let state = state::find(library, &module, &signatures.node);
    if state.is_none() && !state::may_be_made(library, &module, &signatures.node) {
        diagnostics.add(elsewhere(&module, &signatures.node));
    }
    check_derives(&module, &signatures, state.as_ref(), diagnostics);
    let Contexts {
        creation: Some(creation),
        cycle: Some(cycle),
        outputs: Some(outputs),
    } = contexts
    else {
        return None;
    };
    Some(NodeSource {
        path: path.to_owned(),
        summary: summary(&module.syntax.attrs),
        module,
        creation,
        cycle,
        outputs,
        signatures,
        state,
    })
}

impl NodeSource {
    /// Whether a condition decides about its functions or its struct, or what that derives cannot be seen.
    pub fn is_uncertain(&self) -> bool {
        let state = self.state.as_ref();
        self.signatures.is_conditional || state.is_some_and(|state| state.is_uncertain)
    }
}

#[derive(Default)]
struct Contexts {
    creation: Option<Context<CreationField>>,
    cycle: Option<Context<CycleField>>,
    outputs: Option<Context<OutputField>>,
}

fn read_contexts(module: &Module, diagnostics: &mut Diagnostics) -> Contexts {
    let mut contexts = Contexts::default();
    for kind in [
        ContextKind::Creation,
        ContextKind::Cycle,
        ContextKind::MainOutputs,
    ] {
        let Some(item) = find_struct(module, kind) else {
            diagnostics.add(missing_context(module, kind));
            continue;
        };
        if !item.attrs.iter().any(grammar::is_context_attribute) {
            let name = kind.name();
            let message = format!("`{name}` lacks the attribute `#[context]`");
            let error = Diagnostic::new(Code::MissingContext, message)
                .at(&module.file, range(item.ident.span()), "")
                .help(format!("write `#[context]` above `pub struct {name}`"));
            diagnostics.add(error);
        }
        let Some((context, mistakes)) = grammar::parse_context(item) else {
            continue;
        };
        report(module, mistakes, diagnostics);
        match context {
            AnyContext::Creation(creation) => contexts.creation = Some(creation),
            AnyContext::Cycle(cycle) => contexts.cycle = Some(cycle),
            AnyContext::MainOutputs(outputs) => contexts.outputs = Some(outputs),
        }
    }
    contexts
}

fn find_struct(module: &Module, kind: ContextKind) -> Option<&ItemStruct> {
    module.syntax.items.iter().find_map(|item| match item {
        Item::Struct(item) if item.ident == kind.name() && !only_for_tests(&item.attrs) => {
            Some(item)
        }
        _ => None,
    })
}

fn missing_context(module: &Module, kind: ContextKind) -> Diagnostic {
    let name = kind.name();
    Diagnostic::new(
        Code::MissingContext,
        format!("node `{}` has no `{name}`", module.path),
    )
    .at(&module.file, 0..0, "")
    .help(format!("add `#[context] pub struct {name} {{}}`"))
}

fn elsewhere(module: &Module, node: &syn::Ident) -> Diagnostic {
    let message = format!("the struct of the node `{node}` does not stand beside its `impl`");
    let mut items = module.syntax.items.iter();
    let help = match items.any(|item| matches!(item, Item::Type(item) if item.ident == *node)) {
        true => format!("write the struct here, and its own name in place of `{node}`"),
        false => format!(
            "write `pub struct {node}` here, or put what stands elsewhere into a field of one"
        ),
    };
    Diagnostic::new(Code::InvalidSignature, message)
        .at(
            &module.file,
            range(node.span()),
            "generated code names it by this module",
        )
        .help(help)
}

fn check_derives(
    module: &Module,
    signatures: &grammar::Signatures,
    state: Option<&StateSource>,
    diagnostics: &mut Diagnostics,
) {
    let Some(state) = state else { return };
    for (data, place) in &state.borrowing {
        let message = format!(
            "the node `{}` cannot be restored: `{data}` is only read from text that lives forever",
            signatures.node
        );
        let error = Diagnostic::new(Code::MissingDerive, message)
            .at(&module.file, place.clone(), "its state is recorded and restored")
            .help("keep a `String`, a `Vec` or the like in its place, or write `#[serde(skip)]` at the field and rebuild it in `restore`");
        diagnostics.add(error);
    }
    if state.missing_derives.is_empty() {
        return;
    }
    let names: Vec<String> = state
        .missing_derives
        .iter()
        .map(|name| format!("`{name}`"))
        .collect();
    let message = format!(
        "the node `{}` does not derive {}",
        signatures.node,
        names.join(" and ")
    );
    let error = Diagnostic::new(Code::MissingDerive, message)
        .at(
            &module.file,
            state.range.clone(),
            "its state is recorded and restored",
        )
        .help(format!(
            "write `#[derive({})]` above it",
            state.missing_derives.join(", ")
        ));
    diagnostics.add(error);
}

fn report(module: &Module, mistakes: Vec<Mistake>, diagnostics: &mut Diagnostics) {
    for mistake in mistakes {
        let error = Diagnostic::new(code(mistake.rule), mistake.message)
            .at(&module.file, range(mistake.span), "")
            .help_if(mistake.help);
        diagnostics.add(error);
    }
}

fn code(rule: Rule) -> Code {
    match rule {
        Rule::AmbiguousNode | Rule::MissingNode => Code::MissingNode,
        Rule::InvalidContext => Code::InvalidContext,
        Rule::InvalidField | Rule::UnknownKind => Code::InvalidField,
        Rule::InvalidName => Code::InvalidName,
        Rule::InvalidPath => Code::InvalidPath,
        Rule::InvalidSignature => Code::InvalidSignature,
        Rule::MisplacedKind => Code::MisplacedKind,
        Rule::OptionMismatch => Code::OptionMismatch,
    }
}

/// The first sentence of `//!` lines.
fn summary(attributes: &[Attribute]) -> Option<String> {
    let lines = attributes.iter().filter_map(doc);
    let paragraph: Vec<String> = lines
        .map(|line| line.trim().to_owned())
        .take_while(|line| !line.is_empty())
        .collect();
    let text = paragraph.join(" ");
    let end = text.find(". ").map_or(text.len(), |end| end + 1);
    (!text.is_empty()).then(|| text[..end].to_owned())
}
