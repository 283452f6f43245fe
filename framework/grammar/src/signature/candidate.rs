//! Which type of a file is its node.

use syn::spanned::Spanned;
use syn::{
    FnArg, GenericArgument, GenericParam, Ident, ImplItem, ImplItemFn, Item, ItemImpl,
    PathArguments, Type, Visibility,
};

use super::check::last_segment;
use crate::condition::{is_conditional, only_for_tests};
use crate::context::ContextKind;
use crate::field::peel;
use crate::mistake::{Mistake, Rule};

/// A type with an `impl` of its own, with all functions of all its `impl`s.
pub(super) struct Candidate<'file> {
    pub(super) name: Ident,
    methods: Vec<Method<'file>>,
    impls: Vec<&'file ItemImpl>,
}

/// A function, and whether it or its `impl` stands under a `#[cfg(…)]`.
struct Method<'file> {
    item: &'file ImplItemFn,
    is_conditional: bool,
}

/// How clearly a function takes a context.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Takes {
    Nothing,
    /// Somewhere in its arguments, for example by reference.
    Somehow,
    ByValue,
}

/// All types of a file that have an `impl`, in the order of the file. What is there for tests alone is none of them.
pub(super) fn candidates(file: &syn::File) -> Vec<Candidate<'_>> {
    let mut candidates: Vec<Candidate<'_>> = Vec::new();
    for item in &file.items {
        let Item::Impl(block) = item else { continue };
        if only_for_tests(&block.attrs) {
            continue;
        }
        let always = !is_conditional(&block.attrs);
        let Some(name) = last_segment(&block.self_ty).filter(|_| block.trait_.is_none()) else {
            continue;
        };
        let methods = block.items.iter().filter_map(|item| match item {
            ImplItem::Fn(item) if !only_for_tests(&item.attrs) => Some(Method {
                item,
                is_conditional: !always || is_conditional(&item.attrs),
            }),
            _ => None,
        });
        match candidates
            .iter_mut()
            .find(|candidate| candidate.name == name.ident)
        {
            Some(candidate) => {
                candidate.methods.extend(methods);
                candidate.impls.push(block);
            }
            None => candidates.push(Candidate {
                name: name.ident.clone(),
                methods: methods.collect(),
                impls: vec![block],
            }),
        }
    }
    candidates
}

/// The one candidate that is the node; else those between which nothing decides, perhaps none.
pub(super) fn choose(all: Vec<Candidate<'_>>) -> Result<Candidate<'_>, Vec<Candidate<'_>>> {
    // From the clear case to a node whose functions are written wrongly: the first that anybody fits decides.
    let fits: [fn(&Candidate<'_>) -> bool; 4] = [
        |node| node.takes_creation() == Takes::ByValue && node.takes_cycle() == Takes::ByValue,
        |node| node.takes_creation() > Takes::Nothing && node.takes_cycle() > Takes::Nothing,
        |node| node.takes_cycle() > Takes::Nothing,
        |node| {
            node.takes_creation() > Takes::Nothing
                || (node.method("new").is_some() && node.method("cycle").is_some())
        },
    ];
    let mut left = all;
    for fit in fits {
        let (mut fitting, others): (Vec<_>, Vec<_>) = left.into_iter().partition(fit);
        match (fitting.len(), fitting.pop()) {
            (1, Some(node)) => return Ok(node),
            (_, Some(last)) => {
                fitting.push(last);
                return Err(fitting);
            }
            (_, None) => left = others,
        }
    }
    Err(Vec::new())
}

impl<'file> Candidate<'file> {
    pub(super) fn method(&self, name: &str) -> Option<&'file ImplItemFn> {
        let mut methods = self.methods.iter().map(|method| method.item);
        methods.find(|method| method.sig.ident == name)
    }

    /// Whether a condition decides if one of the functions is there that generated code calls.
    pub(super) fn is_conditional(&self) -> bool {
        let called = [self.method("new"), self.method("cycle"), self.restore()];
        let mut conditional = self.methods.iter().filter(|method| method.is_conditional);
        conditional.any(|method| {
            let mut called = called.iter().flatten();
            called.any(|called| called.sig.ident == method.item.sig.ident)
        })
    }

    /// `restore`, if it is meant for the framework: public or taking a context.
    pub(super) fn restore(&self) -> Option<&'file ImplItemFn> {
        let public = |method: &&ImplItemFn| matches!(method.vis, Visibility::Public(_));
        self.method("restore").filter(|method| {
            public(method) || takes(method, ContextKind::Creation) > Takes::Nothing
        })
    }

    /// A node is one type for all of the robot, which generated code writes by its name alone: it has no parameters.
    pub(super) fn generics_mistake(&self) -> Option<Mistake> {
        let mut parameters = self.impls.iter().flat_map(|block| &block.generics.params);
        let mut arguments = self.impls.iter().filter_map(|block| argument(block));
        const ASKS: &str = "write what it asks of the hardware at `new` and `cycle`";
        let (sort, span, help) = match (parameters.next(), arguments.next()) {
            (Some(GenericParam::Lifetime(parameter)), _) => {
                ("lifetimes", parameter.lifetime.ident.span(), ASKS)
            }
            (Some(GenericParam::Type(parameter)), _) => {
                ("type parameters", parameter.ident.span(), ASKS)
            }
            (Some(GenericParam::Const(parameter)), _) => {
                ("const parameters", parameter.ident.span(), ASKS)
            }
            (None, Some(argument)) => {
                let help = "give its struct no parameters: write in their place what stands here";
                ("parameters", argument.span(), help)
            }
            (None, None) => return None,
        };
        let message = format!("the node `{}` has {sort}", self.name);
        Some(Mistake::new(Rule::InvalidSignature, span, message).help(help))
    }

    fn takes_creation(&self) -> Takes {
        self.method("new").map_or(Takes::Nothing, |method| {
            takes(method, ContextKind::Creation)
        })
    }

    fn takes_cycle(&self) -> Takes {
        self.method("cycle")
            .map_or(Takes::Nothing, |method| takes(method, ContextKind::Cycle))
    }
}

/// The first of what stands between `<` and `>` of the type that an `impl` is for.
fn argument(block: &ItemImpl) -> Option<&GenericArgument> {
    match &last_segment(&block.self_ty)?.arguments {
        PathArguments::AngleBracketed(arguments) => arguments.args.first(),
        _ => None,
    }
}

fn takes(method: &ImplItemFn, context: ContextKind) -> Takes {
    let arguments = method
        .sig
        .inputs
        .iter()
        .filter_map(|argument| match argument {
            FnArg::Typed(argument) => Some(peel(&argument.ty)),
            FnArg::Receiver(_) => None,
        });
    let how = arguments.map(|argument| match argument {
        Type::Reference(reference) if names(&reference.elem, context) => Takes::Somehow,
        argument if names(argument, context) => Takes::ByValue,
        _ => Takes::Nothing,
    });
    how.max().unwrap_or(Takes::Nothing)
}

fn names(data: &Type, context: ContextKind) -> bool {
    last_segment(data).is_some_and(|last| last.ident == context.name())
}
