//! `#[context]`: string literals out, lifetimes in.
//!
//! `hulkgen` reads the literals from the source; rustc sees plain types.

mod seen;
#[cfg(test)]
mod tests;

use grammar::{ContextKind, Mistake, Rule, is_hint_attribute, parse_context, read_field};
use proc_macro2::TokenStream as Tokens;
use quote::{ToTokens, quote};
use syn::visit::Visit;
use syn::{Expr, ExprLit, Fields, GenericArgument, ItemStruct, Lit, Type, parse_quote};

use seen::{Requirement, Seen, see};

pub(crate) fn expand(attribute: &Tokens, item: Tokens) -> Tokens {
    let mut errors = Tokens::new();
    if !attribute.is_empty() {
        let message = "`#[context]` takes no arguments";
        errors.extend(syn::Error::new_spanned(attribute, message).to_compile_error());
    }
    match syn::parse2::<ItemStruct>(item.clone()) {
        Ok(item) => {
            let item = rewrite(item, &mut errors);
            quote!(#item #errors)
        }
        Err(error) => {
            errors.extend(error.to_compile_error());
            quote!(#item #errors)
        }
    }
}

/// The struct that nodes see, with what is required of its types.
fn rewrite(mut item: ItemStruct, errors: &mut Tokens) -> Tokens {
    let Some((context, mistakes)) = parse_context(&item) else {
        let message =
            "`#[context]` marks `CreationContext`, `CycleContext` or `MainOutputs` of a node";
        errors.extend(syn::Error::new(item.ident.span(), message).to_compile_error());
        return item.into_token_stream();
    };
    errors.extend(mistakes.iter().map(quote_error));
    let mut uses = Uses::default();
    if let Fields::Named(fields) = &mut item.fields {
        for field in &mut fields.named {
            rewrite_field(field, context.kind(), &mut uses);
        }
    }
    if uses.lifetime {
        item.generics.params.insert(0, parse_quote!('context));
    }
    if uses.interface {
        item.generics.params.push(parse_quote!(Interface));
    }
    let has_fields = matches!(&item.fields, Fields::Named(fields) if !fields.named.is_empty());
    if context.kind() == ContextKind::MainOutputs && has_fields {
        // Keeps the value clear of the error's place in `Result<MainOutputs>`: copied in one piece, not in fragments.
        item.attrs.push(parse_quote!(#[repr(align(16))]));
    }
    let requirements = uses.requirements;
    quote!(#item #requirements)
}

/// What the fields ask of their struct.
#[derive(Default)]
struct Uses {
    lifetime: bool,
    interface: bool,
    requirements: Tokens,
}

fn rewrite_field(field: &mut syn::Field, context: ContextKind, uses: &mut Uses) {
    field.vis = parse_quote!(pub);
    let read = read_field(field, context);
    // For hulkgen, which writes it where the parameter is kept.
    field
        .attrs
        .retain(|attribute| !is_hint_attribute(attribute));
    let is_kind = read
        .mistakes
        .iter()
        .all(|mistake| mistake.rule != Rule::UnknownKind);
    match read.kind {
        Some((kind, path)) => {
            let Seen {
                data,
                lifetime,
                interface,
                requirements,
            } = see(&kind, &path, context);
            uses.lifetime |= lifetime;
            uses.interface |= interface;
            let requirements = requirements
                .iter()
                .map(|(requirement, data)| quote_requirement(*requirement, data));
            uses.requirements.extend(requirements);
            field.ty = data;
        }
        // Told already; what is left of a kind would only bring a second message.
        None if is_kind || has_literal(&field.ty) => field.ty = parse_quote!(()),
        None => {}
    }
}

/// A missing derive is told at the place of the type.
fn quote_requirement(requirement: Requirement, data: &Type) -> Tokens {
    let function = match requirement {
        Requirement::Data => quote!(data),
        Requirement::DataInPlace => quote!(data_in_place),
        Requirement::ParameterData => quote!(parameter_data),
    };
    quote!(const _: () = ::framework::data::require::#function::<#data>();)
}

fn quote_error(mistake: &Mistake) -> Tokens {
    let message = match &mistake.help {
        Some(help) => format!("{}\nhelp: {help}", mistake.message),
        None => mistake.message.clone(),
    };
    syn::Error::new(mistake.span, message).to_compile_error()
}

/// Whether a string stands among a type's arguments.
fn has_literal(data: &Type) -> bool {
    struct Literals(bool);
    impl Visit<'_> for Literals {
        fn visit_generic_argument(&mut self, argument: &GenericArgument) {
            self.0 |= matches!(
                argument,
                GenericArgument::Const(Expr::Lit(ExprLit {
                    lit: Lit::Str(_),
                    ..
                }))
            );
            syn::visit::visit_generic_argument(self, argument);
        }
    }
    let mut literals = Literals(false);
    literals.visit_type(data);
    literals.0
}
