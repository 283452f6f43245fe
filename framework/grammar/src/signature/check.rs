//! Whether a function of a node has the form that generated code calls.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{
    FnArg, GenericArgument, Ident, ImplItemFn, PathArguments, PathSegment, Receiver, ReturnType,
    Type, Visibility,
};

use super::bounds::{Bounds, read_bounds};
use super::{Meaning, Meanings, Signature, asks_for_hardware};
use crate::context::ContextKind;
use crate::field::peel;
use crate::mistake::{Mistake, Rule};

/// The form of one function.
pub(super) struct Expected<'file> {
    pub(super) function: &'static str,
    pub(super) context: ContextKind,
    /// Whether the context has a hardware interface; `None` if the file has no such context.
    pub(super) hardware: Option<bool>,
    /// `&mut self`.
    has_receiver: bool,
    returns: Returns<'file>,
}

/// What stands in the `Result`.
enum Returns<'file> {
    Node(&'file Ident),
    MainOutputs,
    Nothing,
}

impl<'file> Expected<'file> {
    pub(super) fn new(node: &'file Ident, file: &syn::File) -> Self {
        Self::with("new", ContextKind::Creation, Returns::Node(node), file)
    }

    pub(super) fn cycle(file: &syn::File) -> Self {
        Self::with("cycle", ContextKind::Cycle, Returns::MainOutputs, file)
    }

    pub(super) fn restore(file: &syn::File) -> Self {
        Self::with("restore", ContextKind::Creation, Returns::Nothing, file)
    }

    fn with(
        function: &'static str,
        context: ContextKind,
        returns: Returns<'file>,
        file: &syn::File,
    ) -> Self {
        Self {
            function,
            context,
            hardware: asks_for_hardware(file, context),
            has_receiver: function != "new",
            returns,
        }
    }

    /// The whole signature as it should be written.
    fn form(&self) -> String {
        let receiver = if self.has_receiver { "&mut self, " } else { "" };
        let interface = if self.hardware == Some(true) {
            "<impl Trait>"
        } else {
            ""
        };
        format!(
            "pub fn {}({receiver}context: {}{interface}) -> Result<{}>",
            self.function,
            self.context.name(),
            self.returns.text()
        )
    }

    pub(super) fn mistake(&self, span: Span, message: impl Into<String>) -> Mistake {
        Mistake::new(Rule::InvalidSignature, span, message)
            .help(format!("expected `{}`", self.form()))
    }
}

impl Returns<'_> {
    fn text(&self) -> &'static str {
        match self {
            Self::Node(_) => "Self",
            Self::MainOutputs => "MainOutputs",
            Self::Nothing => "()",
        }
    }

    fn accepts(&self, data: &Type) -> bool {
        let named = |name: &str| last_segment(data).is_some_and(|last| last.ident == name);
        match self {
            Self::Node(node) => named("Self") || named(&node.to_string()),
            Self::MainOutputs => named(ContextKind::MainOutputs.name()),
            Self::Nothing => matches!(peel(data), Type::Tuple(tuple) if tuple.elems.is_empty()),
        }
    }
}

/// Reads a function; `None` if it has a mistake.
pub(super) fn check(
    expected: &Expected<'_>,
    method: &ImplItemFn,
    meanings: &Meanings<'_>,
    mistakes: &mut Vec<Mistake>,
) -> Option<Signature> {
    let before = mistakes.len();
    mistakes.extend(qualifier_mistake(expected, method));
    mistakes.extend(receiver_mistake(expected, method));
    let returns = match returned(expected, method, meanings) {
        Ok(returns) => Some(returns.clone()),
        Err(mistake) => {
            mistakes.push(mistake);
            None
        }
    };
    let bounds = match context_argument(expected, method) {
        Ok(context) => read_bounds(expected, method, context, mistakes),
        Err(mistake) => {
            mistakes.push(mistake);
            Bounds::default()
        }
    };
    let returns = returns.filter(|_| mistakes.len() == before)?;
    Some(Signature {
        span: method.sig.ident.span(),
        bounds: bounds.traits,
        is_static: bounds.is_static,
        returns,
    })
}

/// The last segment of a type that is a path.
pub(super) fn last_segment(data: &Type) -> Option<&PathSegment> {
    match peel(data) {
        Type::Path(path) if path.qself.is_none() => path.path.segments.last(),
        _ => None,
    }
}

fn qualifier_mistake(expected: &Expected<'_>, method: &ImplItemFn) -> Option<Mistake> {
    let signature = &method.sig;
    let name = expected.function;
    if !matches!(method.vis, Visibility::Public(_)) {
        return Some(expected.mistake(signature.ident.span(), format!("`{name}` is not public")));
    }
    let qualifiers = [
        signature.asyncness.map(|token| ("async", token.span)),
        signature.unsafety.map(|token| ("unsafe", token.span)),
        signature
            .abi
            .as_ref()
            .map(|abi| ("extern", abi.extern_token.span)),
    ];
    let (qualifier, span) = qualifiers.into_iter().flatten().next()?;
    Some(expected.mistake(span, format!("`{name}` is `{qualifier}`")))
}

fn receiver_mistake(expected: &Expected<'_>, method: &ImplItemFn) -> Option<Mistake> {
    let name = expected.function;
    match (method.sig.receiver(), expected.has_receiver) {
        (None, false) => None,
        (Some(receiver), true) if is_mutable_reference(receiver) => None,
        (Some(receiver), true) => Some(expected.mistake(
            receiver.span(),
            format!("`{name}` does not take `&mut self`"),
        )),
        (Some(receiver), false) => {
            Some(expected.mistake(receiver.span(), format!("`{name}` takes `self`")))
        }
        (None, true) => Some(expected.mistake(
            method.sig.ident.span(),
            format!("`{name}` lacks `&mut self`"),
        )),
    }
}

fn is_mutable_reference(receiver: &Receiver) -> bool {
    match (&receiver.reference, &*receiver.ty) {
        (Some(_), _) => receiver.mutability.is_some(),
        (None, Type::Reference(reference)) => {
            reference.mutability.is_some()
                && last_segment(&reference.elem).is_some_and(|last| last.ident == "Self")
        }
        _ => false,
    }
}

/// The type of the one argument behind the receiver.
fn context_argument<'method>(
    expected: &Expected<'_>,
    method: &'method ImplItemFn,
) -> Result<&'method PathSegment, Mistake> {
    let (name, context) = (expected.function, expected.context.name());
    let mut arguments = method
        .sig
        .inputs
        .iter()
        .filter_map(|argument| match argument {
            FnArg::Typed(argument) => Some(argument),
            FnArg::Receiver(_) => None,
        });
    let Some(argument) = arguments.next() else {
        let message = format!("`{name}` does not take a `{context}`");
        return Err(expected.mistake(method.sig.ident.span(), message));
    };
    if let Some(second) = arguments.next() {
        let message = format!("`{name}` takes more than a `{context}`");
        return Err(expected.mistake(second.span(), message));
    }
    match last_segment(&argument.ty) {
        Some(last) if last.ident == context => Ok(last),
        _ => {
            let message = format!("`{name}` does not take a `{context}` by value");
            Err(expected.mistake(argument.ty.span(), message))
        }
    }
}

fn returned<'method>(
    expected: &Expected<'_>,
    method: &'method ImplItemFn,
    meanings: &Meanings<'_>,
) -> Result<&'method Type, Mistake> {
    let message = || {
        format!(
            "`{}` does not return a `Result<{}>`",
            expected.function,
            expected.returns.text()
        )
    };
    let ReturnType::Type(_, data) = &method.sig.output else {
        return Err(expected.mistake(method.sig.ident.span(), message()));
    };
    let accepts = |inner: &Type| expected.returns.accepts(inner);
    let is_plain = last_segment(data)
        .filter(|last| last.ident.to_string().ends_with("Result"))
        .and_then(|last| match &last.arguments {
            PathArguments::AngleBracketed(arguments) => {
                arguments.args.iter().find_map(|argument| match argument {
                    GenericArgument::Type(inner) => Some(inner),
                    _ => None,
                })
            }
            _ => None,
        })
        .is_some_and(accepts);
    // An alias may be called and written otherwise.
    let is_alias = || {
        last_segment(data).is_some_and(|last| last.ident != "Self")
            && match meanings(data) {
                Meaning::Result(inner) => accepts(&inner),
                Meaning::Hidden => true,
                Meaning::Other => false,
            }
    };
    if is_plain || is_alias() {
        Ok(data)
    } else {
        Err(expected.mistake(data.span(), message()))
    }
}
