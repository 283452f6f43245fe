//! Context literals: what each field of a node's context is filled with.

use proc_macro2::TokenStream;
use quote::quote;

use super::spelling::{ident, path, place, quote_accessor};
use crate::model::node::{ContextField, NodeModel, Value};

/// `ball_detection::CycleContext { … }`; `base` is the variable that everything comes from.
pub(super) fn quote_context(
    node: &NodeModel,
    context: &str,
    base: &str,
    fields: &[ContextField],
) -> TokenStream {
    let context = path(&format!("{}::{context}", node.path));
    let fields = fields.iter().map(|field| quote_field(field, base));
    quote!(#context { #(#fields)* })
}

fn quote_field(field: &ContextField, base: &str) -> TokenStream {
    let name = ident(&field.name);
    match &field.value {
        Value::Variable(variable) if *variable == field.name => quote!(#name,),
        value => {
            let value = quote_value(value, base);
            quote!(#name: #value,)
        }
    }
}

/// What some fields refer to and must therefore live longer than the context.
pub(super) fn quote_before(fields: &[ContextField]) -> TokenStream {
    fields
        .iter()
        .filter_map(|field| quote_variable(&field.value))
        .collect()
}

fn quote_variable(value: &Value) -> Option<TokenStream> {
    Some(match value {
        Value::Historic {
            variable,
            output,
            path,
            ..
        } => {
            let (variable, output) = (ident(variable), ident(output));
            let path = quote_accessor(path);
            quote!(let #variable = frame.historic.#output.project(|#output| #path);)
        }
        Value::Perception {
            variable,
            lane,
            path,
        } => {
            let (variable, lane, path) = (ident(variable), ident(lane), quote_accessor(path));
            quote!(let #variable = frame.perception.#lane.project(|outputs| #path);)
        }
        Value::Interleaved {
            variable,
            order,
            lanes,
            path,
        } => {
            let (variable, order) = (ident(variable), ident(order));
            let (lanes, path) = (lanes.iter().map(|lane| ident(lane)), quote_accessor(path));
            quote! {
                let #variable = ::framework::Interleaved {
                    order: &frame.perception.#order,
                    instances: [#(&frame.perception.#lanes.project(|outputs| #path)),*],
                };
            }
        }
        _ => return None,
    })
}

fn quote_value(value: &Value, base: &str) -> TokenStream {
    let base = ident(base);
    match value {
        Value::Read(accessor) => quote_accessor(accessor),
        Value::Write(names) => {
            let names = place(names);
            quote!(&mut #names)
        }
        Value::Variable(name) => {
            let name = ident(name);
            quote!(#name)
        }
        Value::Latest { latest, path } => {
            let (latest, path) = (ident(latest), quote_accessor(path));
            quote!(#base.latest.#latest.latest(#base.cycle.time.start, |outputs| #path))
        }
        Value::Historic {
            variable, current, ..
        } => {
            let (variable, current) = (ident(variable), quote_accessor(current));
            quote!(::framework::HistoricInput::new(&#variable, #base.cycle.time.start, #current))
        }
        Value::Perception { variable, .. } | Value::Interleaved { variable, .. } => {
            let variable = ident(variable);
            quote!(::framework::PerceptionInput::new(&#variable))
        }
        Value::CycleTime => quote!(#base.cycle.time),
        Value::AdditionalOutput { flag, place: names } => {
            let (flag, names) = (ident(flag), place(names));
            quote! {
                ::framework::AdditionalOutput::new(
                    #base.subscribed.#flag,
                    #base.cycle.number,
                    &mut #names,
                )
            }
        }
        Value::Procedure(name) => {
            let name = ident(name);
            quote!(#base.procedures.#name.call())
        }
        Value::HardwareInterface => quote!(#base.hardware_interface),
    }
}
