//! Fields of the three structs: one enum per struct, so that no impossible field can be asked about.

mod arguments;
mod read;
mod rules;

use proc_macro2::Span;
use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{Expr, ExprLit, GenericArgument, Lit, PathArguments, Type};

use crate::context::ContextKind;
use crate::hints::Hints;
use crate::path::{DataPath, Name};

pub use read::{AnyField, ReadField, read_field};

/// A field without mistakes.
#[derive(Clone, Debug)]
pub struct Field<K> {
    pub name: syn::Ident,
    pub kind: K,
    /// As the author wrote it, without arguments: `framework::Input`.
    pub kind_path: syn::Path,
    /// The whole type.
    pub span: Span,
    /// Lines of documentation, as written behind `///`.
    pub docs: Vec<String>,
    /// Of a parameter: what `#[reflect(…)]` says.
    pub hints: Hints,
}

/// A field of `CreationContext`.
#[derive(Clone, Debug)]
pub enum CreationField {
    Parameter(Pathed),
    CyclerState(StatePath),
    HardwareInterface,
}

/// A field of `CycleContext`.
#[derive(Clone, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "a file has a handful; boxes would be in every match"
)]
pub enum CycleField {
    Input(FromOutput),
    RequiredInput(FromOutput),
    LatestInput(FromInstance),
    PreviousInput(Pathed),
    HistoricInput(Pathed),
    PerceptionInput(FromInstance),
    Parameter(Pathed),
    CyclerState(StatePath),
    CycleTime,
    AdditionalOutput(Pathed),
    Procedure(ProcedureName),
    HardwareInterface,
    /// Written in place.
    MainOutput(Type),
}

/// A field of `MainOutputs`.
#[derive(Clone, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "a file has a handful; boxes would be in every match"
)]
pub enum OutputField {
    /// Returned by value.
    MainOutput(Type),
    CaptureTime,
}

/// A value of the own cycler or of the parameters.
#[derive(Clone, Debug)]
pub struct Pathed {
    /// As written: with `Option` where the path has a `?`.
    pub data: Type,
    pub path: DataPath,
}

/// An output of the own cycler, or of the instance that is named.
#[derive(Clone, Debug)]
pub struct FromOutput {
    /// As written: with `Option` where the path has a `?`.
    pub data: Type,
    pub instance: Option<Name>,
    pub path: DataPath,
}

/// An output of another instance; for `PerceptionInput` perhaps of all instances of a cycler.
#[derive(Clone, Debug)]
pub struct FromInstance {
    /// As written: with `Option` where the path has a `?`.
    pub data: Type,
    pub instance: Name,
    pub path: DataPath,
}

/// A cycler state.
#[derive(Clone, Debug)]
pub struct StatePath {
    /// Without `&`.
    pub data: Type,
    /// Written `CyclerState<&T, …>`: the node only reads it.
    pub shared: bool,
    pub path: DataPath,
}

/// A procedure that the node answers.
#[derive(Clone, Debug)]
pub struct ProcedureName {
    pub request: Type,
    pub response: Type,
    pub name: Name,
}

/// `U` of `Option<U>`, by the last segment of its path.
pub fn option_argument(data: &Type) -> Option<&Type> {
    let Type::Path(path) = peel(data) else {
        return None;
    };
    let last = path.path.segments.last()?;
    match &last.arguments {
        PathArguments::AngleBracketed(arguments)
            if last.ident == "Option" && arguments.args.len() == 1 =>
        {
            match arguments.args.first() {
                Some(GenericArgument::Type(inner)) => Some(inner),
                _ => None,
            }
        }
        _ => None,
    }
}

/// A field kind that knows the struct it stands in.
pub(crate) trait Place: Sized {
    const CONTEXT: ContextKind;

    /// `None` where the kind has no meaning in that struct.
    fn place(field: AnyField) -> Option<Self>;
}

impl<K> Field<K> {
    pub(crate) fn new(name: syn::Ident, field: &syn::Field, kind: K, kind_path: syn::Path) -> Self {
        Self {
            name,
            kind,
            kind_path,
            span: field.ty.span(),
            docs: field.attrs.iter().filter_map(documentation).collect(),
            // What cannot be read is a mistake of the field.
            hints: Hints::read(&field.attrs).unwrap_or_default(),
        }
    }
}

impl Place for CreationField {
    const CONTEXT: ContextKind = ContextKind::Creation;

    fn place(field: AnyField) -> Option<Self> {
        match field {
            AnyField::Cycle(CycleField::Parameter(parameter)) => Some(Self::Parameter(parameter)),
            AnyField::Cycle(CycleField::CyclerState(state)) => Some(Self::CyclerState(state)),
            AnyField::Cycle(CycleField::HardwareInterface) => Some(Self::HardwareInterface),
            _ => None,
        }
    }
}

impl Place for CycleField {
    const CONTEXT: ContextKind = ContextKind::Cycle;

    fn place(field: AnyField) -> Option<Self> {
        match field {
            AnyField::Cycle(field) => Some(field),
            AnyField::CaptureTime => None,
        }
    }
}

impl Place for OutputField {
    const CONTEXT: ContextKind = ContextKind::MainOutputs;

    fn place(field: AnyField) -> Option<Self> {
        match field {
            AnyField::Cycle(CycleField::MainOutput(data)) => Some(Self::MainOutput(data)),
            AnyField::CaptureTime => Some(Self::CaptureTime),
            AnyField::Cycle(_) => None,
        }
    }
}

/// The type inside of groups that only a macro can see.
pub(crate) fn peel(data: &Type) -> &Type {
    match data {
        Type::Group(group) => peel(&group.elem),
        Type::Paren(paren) => peel(&paren.elem),
        _ => data,
    }
}

/// A type as an author would write it, for messages.
pub(crate) fn written(data: &impl ToTokens) -> String {
    let mut text = data.to_token_stream().to_string();
    for (spaced, tight) in [
        (" :: ", "::"),
        (":: ", "::"),
        (" < ", "<"),
        ("< ", "<"),
        (" >", ">"),
        (" ,", ","),
        ("& ", "&"),
        (" ;", ";"),
    ] {
        text = text.replace(spaced, tight);
    }
    text
}

fn documentation(attribute: &syn::Attribute) -> Option<String> {
    let syn::Meta::NameValue(meta) = &attribute.meta else {
        return None;
    };
    match &meta.value {
        Expr::Lit(ExprLit {
            lit: Lit::Str(text),
            ..
        }) if meta.path.is_ident("doc") => {
            let text = text.value();
            Some(text.strip_prefix(' ').unwrap_or(&text).to_owned())
        }
        _ => None,
    }
}
