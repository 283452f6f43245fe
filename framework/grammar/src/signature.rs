//! How `new`, `cycle` and `restore` of a node are written.

mod bounds;
mod candidate;
mod check;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Fields, Item, ItemStruct};

use crate::condition::{is_conditional, only_for_tests};
use crate::context::ContextKind;
use crate::mistake::{Mistake, Rule};
use candidate::{Candidate, candidates, choose};
use check::{Expected, check};

/// The functions of the node in a file.
#[derive(Clone, Debug)]
pub struct Signatures {
    /// Name of the state struct.
    pub node: syn::Ident,
    pub new: Signature,
    pub cycle: Signature,
    /// Only where the node has one.
    pub restore: Option<Signature>,
    /// One of them, or an `impl` that has it, stands under a `#[cfg(…)]`.
    pub is_conditional: bool,
}

/// One function.
#[derive(Clone, Debug)]
pub struct Signature {
    /// Its name.
    pub span: Span,
    /// The traits that it asks of the hardware interface (`impl A + B`, generics, `where`), in the order of the file,
    /// each once.
    pub bounds: Vec<syn::Path>,
    /// Whether it asks for `'static`, too.
    pub is_static: bool,
    /// What it returns, as written.
    pub returns: syn::Type,
}

/// What a type stands for that is not written as a `Result`.
#[derive(Clone, Debug)]
pub enum Meaning {
    /// A result of this.
    Result(Box<syn::Type>),
    /// Nobody can tell.
    Hidden,
    /// No result.
    Other,
}

/// What a type that a function returns stands for, by the names of its file.
pub type Meanings<'a> = dyn Fn(&syn::Type) -> Meaning + 'a;

/// Finds the node of a file: the type with `new(CreationContext)` and `cycle(&mut self, CycleContext)`. Helper types
/// that have a `new` or a `cycle` of their own do not disturb. `None` if there is none or one of its functions has a
/// mistake.
pub fn find_node(file: &syn::File) -> (Option<Signatures>, Vec<Mistake>) {
    find_node_with(file, &|_| Meaning::Other)
}

/// The same where somebody knows what aliases stand for.
pub fn find_node_with(
    file: &syn::File,
    meanings: &Meanings<'_>,
) -> (Option<Signatures>, Vec<Mistake>) {
    match choose(candidates(file)) {
        Ok(candidate) => read_signatures(&candidate, file, meanings),
        Err(several) if !several.is_empty() => (None, vec![ambiguous(&several)]),
        Err(_) => (None, vec![missing(file)]),
    }
}

fn read_signatures(
    node: &Candidate,
    file: &syn::File,
    meanings: &Meanings<'_>,
) -> (Option<Signatures>, Vec<Mistake>) {
    let mut mistakes = Vec::new();
    let read = |expected: Expected<'_>, method, mistakes: &mut Vec<Mistake>| {
        check(&expected, method, meanings, mistakes)
    };
    mistakes.extend(private_type(node, file));
    mistakes.extend(node.generics_mistake());
    let new = match node.method("new") {
        Some(method) => read(Expected::new(&node.name, file), method, &mut mistakes),
        None => absent(node, "new", &mut mistakes),
    };
    let cycle = match node.method("cycle") {
        Some(method) => read(Expected::cycle(file), method, &mut mistakes),
        None => absent(node, "cycle", &mut mistakes),
    };
    let restore = node
        .restore()
        .and_then(|method| read(Expected::restore(file), method, &mut mistakes));
    let signatures = match (new, cycle) {
        (Some(new), Some(cycle)) if mistakes.is_empty() => Some(Signatures {
            node: node.name.clone(),
            new,
            cycle,
            restore,
            is_conditional: node.is_conditional(),
        }),
        _ => None,
    };
    (signatures, mistakes)
}

fn absent(node: &Candidate, function: &str, mistakes: &mut Vec<Mistake>) -> Option<Signature> {
    let message = format!("`{}` has no `{function}`", node.name);
    let expected = match function {
        "new" => "pub fn new(context: CreationContext) -> Result<Self>",
        _ => "pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs>",
    };
    mistakes.push(
        Mistake::new(Rule::InvalidSignature, node.name.span(), message)
            .help(format!("expected `{expected}`")),
    );
    None
}

fn private_type(node: &Candidate, file: &syn::File) -> Option<Mistake> {
    let types = file.items.iter().filter_map(|item| match item {
        Item::Struct(item) if !only_for_tests(&item.attrs) => {
            Some((&item.ident, &item.vis, "struct"))
        }
        Item::Enum(item) if !only_for_tests(&item.attrs) => Some((&item.ident, &item.vis, "enum")),
        _ => None,
    });
    let (name, visibility, keyword) = types.into_iter().find(|(name, ..)| **name == node.name)?;
    if matches!(visibility, syn::Visibility::Public(_)) {
        return None;
    }
    let message = format!("the node `{name}` is not public");
    let help = format!("write `pub {keyword} {name}`: generated code keeps it");
    Some(Mistake::new(Rule::InvalidSignature, name.span(), message).help(help))
}

fn ambiguous(nodes: &[Candidate]) -> Mistake {
    let names: Vec<_> = nodes
        .iter()
        .map(|node| format!("`{}`", node.name))
        .collect();
    let message = format!("{} could all be the node of this file", names.join(", "));
    let span = nodes
        .get(1)
        .map_or_else(Span::call_site, |node| node.name.span());
    Mistake::new(Rule::AmbiguousNode, span, message).help("give each node a file of its own")
}

fn missing(file: &syn::File) -> Mistake {
    let context = structs(file).find(|item| item.ident == ContextKind::Cycle.name());
    let span = match (context, file.items.first()) {
        (Some(context), _) => context.ident.span(),
        (None, Some(first)) => first.span(),
        (None, None) => Span::call_site(),
    };
    let message = "no type of this file has `new(context: CreationContext)` and `cycle(&mut self, context: CycleContext)`";
    Mistake::new(Rule::MissingNode, span, message)
        .help("write both in an `impl` of the node's struct")
}

fn structs(file: &syn::File) -> impl Iterator<Item = &ItemStruct> {
    file.items.iter().filter_map(|item| match item {
        Item::Struct(item) if !only_for_tests(&item.attrs) => Some(item),
        _ => None,
    })
}

/// Whether a context of the file has a field `HardwareInterface`; `None` if the file has no such context.
fn asks_for_hardware(file: &syn::File, context: ContextKind) -> Option<bool> {
    // One under a condition is told where contexts are read.
    let is_always = |item: &&ItemStruct| !is_conditional(&item.attrs);
    let mut items = structs(file).filter(is_always);
    let item = items.find(|item| item.ident == context.name())?;
    let Fields::Named(fields) = &item.fields else {
        return Some(false);
    };
    Some(fields.named.iter().any(|field| {
        check::last_segment(&field.ty).is_some_and(|last| last.ident == "HardwareInterface")
    }))
}
