//! What a node sees of each kind.

use grammar::{AnyField, ContextKind, CycleField, DataPath, option_argument};
use quote::{ToTokens, quote};
use syn::{Path, Type, parse_quote};

/// A field's type behind the macro.
pub(super) struct Seen {
    pub(super) data: Type,
    /// It borrows from the cycle.
    pub(super) lifetime: bool,
    /// It names the hardware interface.
    pub(super) interface: bool,
    pub(super) requirements: Vec<(Requirement, Type)>,
}

/// The trait that a type must have.
#[derive(Clone, Copy)]
pub(super) enum Requirement {
    Data,
    DataInPlace,
    ParameterData,
}

/// The type that a node sees; `kind` are the author's tokens, so that an editor finds the kind's documentation.
pub(super) fn see(field: &AnyField, kind: &Path, context: ContextKind) -> Seen {
    let AnyField::Cycle(field) = field else {
        return Seen::plain(parse_quote!(#kind));
    };
    match field {
        CycleField::CycleTime => Seen::plain(parse_quote!(#kind)),
        CycleField::HardwareInterface => Seen {
            interface: true,
            ..Seen::borrowed(parse_quote!(#kind<'context, Interface>))
        },
        CycleField::Input(input) => Seen::value_or_option(kind, &input.data, &input.path),
        CycleField::PreviousInput(input) => Seen::value_or_option(kind, &input.data, &input.path),
        CycleField::Parameter(parameter) => {
            Seen::value_or_option(kind, &parameter.data, &parameter.path)
                .require(Requirement::ParameterData, &parameter.data)
        }
        CycleField::RequiredInput(input) => {
            let optional = input.path.is_optional() || input.instance.is_none();
            let data = option_argument(&input.data)
                .filter(|_| optional)
                .unwrap_or(&input.data);
            Seen::borrowed(parse_quote!(#kind<'context, #data>))
        }
        CycleField::LatestInput(input) => {
            let value = reference(&input.data, &input.path);
            Seen::borrowed(parse_quote!(#kind<#value>))
        }
        CycleField::HistoricInput(input) => Seen::series(kind, &input.data, &input.path),
        CycleField::PerceptionInput(input) => Seen::series(kind, &input.data, &input.path),
        CycleField::CyclerState(state) => Seen::state(kind, &state.data, state.shared),
        CycleField::AdditionalOutput(output) => {
            let data = &output.data;
            Seen::borrowed(parse_quote!(#kind<'context, #data>)).require(Requirement::Data, data)
        }
        CycleField::Procedure(procedure) => {
            let (request, response) = (&procedure.request, &procedure.response);
            Seen::borrowed(parse_quote!(#kind<'context, #request, #response>))
                .require(Requirement::ParameterData, request)
                .require(Requirement::ParameterData, response)
        }
        CycleField::MainOutput(data) if context == ContextKind::MainOutputs => {
            Seen::plain(parse_quote!(#kind<#data>)).require(Requirement::Data, data)
        }
        CycleField::MainOutput(data) => {
            let slot = parse_quote!(<#kind<#data> as ::framework::InPlace<'context>>::Slot);
            Seen::borrowed(slot).require(Requirement::DataInPlace, data)
        }
    }
}

impl Seen {
    fn plain(data: Type) -> Self {
        Self {
            data,
            lifetime: false,
            interface: false,
            requirements: Vec::new(),
        }
    }

    fn borrowed(data: Type) -> Self {
        Self {
            lifetime: true,
            ..Self::plain(data)
        }
    }

    /// `&T`, or `Option<&U>` where something on the path may be absent.
    fn value_or_option(kind: &Path, data: &Type, path: &DataPath) -> Self {
        Self::borrowed(match option_argument(data) {
            Some(inner) if path.is_optional() => {
                parse_quote!(::core::option::Option<#kind<'context, #inner>>)
            }
            _ => parse_quote!(#kind<'context, #data>),
        })
    }

    /// References by time.
    fn series(kind: &Path, data: &Type, path: &DataPath) -> Self {
        let value = reference(data, path);
        Self::borrowed(parse_quote!(#kind<'context, #value>))
    }

    fn state(kind: &Path, data: &Type, shared: bool) -> Self {
        let state = quote!(#kind<'context, #data>);
        let seen = match shared {
            true => quote!(<#state as ::framework::ReadState>::Read),
            false => state.into_token_stream(),
        };
        Self::borrowed(parse_quote!(#seen)).require(Requirement::Data, data)
    }

    fn require(mut self, requirement: Requirement, data: &Type) -> Self {
        self.requirements.push((requirement, data.clone()));
        self
    }
}

/// `&T`, or `Option<&U>` where something on the path may be absent.
fn reference(data: &Type, path: &DataPath) -> Type {
    match option_argument(data) {
        Some(inner) if path.is_optional() => {
            parse_quote!(::core::option::Option<&'context #inner>)
        }
        _ => parse_quote!(&'context #data),
    }
}
