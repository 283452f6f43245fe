//! The three structs of a node file.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Attribute, Fields, ItemStruct, Visibility};

use crate::field::{CreationField, CycleField, Field, OutputField, Place, read_field};
use crate::mistake::{Mistake, Rule};

/// Which of the three structs it is, from its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ContextKind {
    /// `CreationContext`: what `new` and `restore` receive.
    Creation,
    /// `CycleContext`: what `cycle` receives.
    Cycle,
    /// `MainOutputs`: what `cycle` returns.
    MainOutputs,
}

/// A struct with `#[context]`.
#[derive(Clone, Debug)]
pub struct Context<K> {
    /// The struct's name.
    pub name_span: Span,
    /// In the order of the file; a field with a mistake is left out.
    pub fields: Vec<Field<K>>,
}

/// One of the three.
#[derive(Clone, Debug)]
pub enum AnyContext {
    Creation(Context<CreationField>),
    Cycle(Context<CycleField>),
    MainOutputs(Context<OutputField>),
}

impl ContextKind {
    /// The kind that a struct of this name is.
    pub fn from_name(name: &str) -> Option<Self> {
        let kinds = [Self::Creation, Self::Cycle, Self::MainOutputs];
        kinds.into_iter().find(|kind| kind.name() == name)
    }

    /// The name that a struct of this kind has.
    pub fn name(self) -> &'static str {
        match self {
            Self::Creation => "CreationContext",
            Self::Cycle => "CycleContext",
            Self::MainOutputs => "MainOutputs",
        }
    }
}

impl AnyContext {
    /// Which of the three it is.
    pub fn kind(&self) -> ContextKind {
        match self {
            Self::Creation(_) => ContextKind::Creation,
            Self::Cycle(_) => ContextKind::Cycle,
            Self::MainOutputs(_) => ContextKind::MainOutputs,
        }
    }
}

/// Reads a struct; `None` if it has none of the three names. Fields with a mistake are left out of the context.
pub fn parse_context(item: &ItemStruct) -> Option<(AnyContext, Vec<Mistake>)> {
    let kind = ContextKind::from_name(&item.ident.to_string())?;
    let mut mistakes = structural_mistakes(item);
    let context = match kind {
        ContextKind::Creation => AnyContext::Creation(read_context(item, &mut mistakes)),
        ContextKind::Cycle => AnyContext::Cycle(read_context(item, &mut mistakes)),
        ContextKind::MainOutputs => {
            let outputs = read_context(item, &mut mistakes);
            mistakes.extend(second_capture_time(&outputs));
            AnyContext::MainOutputs(outputs)
        }
    };
    Some((context, mistakes))
}

/// Whether an attribute is `#[context]`, by the last segment of its path.
pub fn is_context_attribute(attribute: &Attribute) -> bool {
    let last = attribute.path().segments.last();
    last.is_some_and(|segment| segment.ident == "context")
}

/// What is wrong with the struct itself, whatever its fields are.
pub fn structural_mistakes(item: &ItemStruct) -> Vec<Mistake> {
    let name = &item.ident;
    let mistake = |span, message| Mistake::new(Rule::InvalidContext, span, message);
    let mut mistakes = Vec::new();
    if !matches!(item.vis, Visibility::Public(_)) {
        mistakes.push(
            mistake(name.span(), format!("`{name}` is not public")).help(format!(
                "write `pub struct {name}`: generated code makes its values"
            )),
        );
    }
    if let Some(parameter) = item.generics.params.first() {
        let message = format!("`{name}` has parameters of its own");
        let help = "leave them out: `#[context]` adds the lifetime and the hardware interface";
        mistakes.push(mistake(parameter.span(), message).help(help));
    } else if let Some(clause) = &item.generics.where_clause {
        let message = format!("`{name}` has a `where` clause");
        let help = "write what the node asks of the hardware at `new` or `cycle`";
        mistakes.push(mistake(clause.where_token.span, message).help(help));
    }
    let mut attributes = item.attrs.iter();
    if let Some(condition) = attributes.find(|one| one.path().is_ident("cfg")) {
        let message =
            format!("`{name}` cannot be conditional: generated code knows one of each node");
        let help = "remove `#[cfg(…)]`, and what is there in place of this struct";
        mistakes.push(mistake(condition.span(), message).help(help));
    }
    let is_made = name != ContextKind::MainOutputs.name();
    let closed = item
        .attrs
        .iter()
        .find(|one| one.path().is_ident("non_exhaustive"));
    if let Some(closed) = closed.filter(|_| is_made) {
        let message =
            format!("`{name}` is `#[non_exhaustive]`, so that no other crate can make one");
        let help = "remove the attribute: generated code makes its values";
        mistakes.push(mistake(closed.span(), message).help(help));
    }
    if !matches!(item.fields, Fields::Named(_)) {
        mistakes.push(
            mistake(name.span(), format!("`{name}` has no named fields")).help(format!(
                "write `pub struct {name} {{ … }}`, also if it is empty"
            )),
        );
    }
    mistakes
}

fn read_context<K: Place>(item: &ItemStruct, mistakes: &mut Vec<Mistake>) -> Context<K> {
    let mut context = Context {
        name_span: item.ident.span(),
        fields: Vec::new(),
    };
    let Fields::Named(fields) = &item.fields else {
        return context;
    };
    for field in &fields.named {
        let read = read_field(field, K::CONTEXT);
        mistakes.extend(read.mistakes.iter().cloned());
        if let (Some(name), Some((placed, path))) = (&field.ident, read.place::<K>()) {
            context
                .fields
                .push(Field::new(name.clone(), field, placed, path));
        }
    }
    context
}

fn second_capture_time(outputs: &Context<OutputField>) -> Option<Mistake> {
    let mut times = outputs
        .fields
        .iter()
        .filter(|field| matches!(field.kind, OutputField::CaptureTime));
    let first = times.next()?;
    let second = times.next()?;
    let message = format!(
        "`{}` and `{}` are both the capture time: a cycle has one",
        first.name, second.name
    );
    Some(Mistake::new(Rule::InvalidField, second.span, message))
}
