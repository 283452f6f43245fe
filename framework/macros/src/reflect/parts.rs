//! The fields of a struct or of one variant, as serde shows them.

use proc_macro2::TokenStream as Tokens;
use quote::{ToTokens, format_ident, quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Attribute, Expr, ExprLit, Fields, Ident, Index, Lit, LitStr, Meta, Type};

use crate::serde_names::{Container, Member};

/// One field that stands in the serde form.
pub(super) struct Part {
    pub(super) key: Key,
    /// What the field is called in Rust: a name or an index.
    member: Tokens,
    /// The variable that a pattern gives it.
    pub(super) binding: Ident,
    pub(super) data: Type,
    docs: String,
    unit: Option<LitStr>,
}

/// How a part is found.
pub(super) enum Key {
    Name(String),
    Index(usize),
    /// Its own parts are found instead.
    Flattened,
}

/// `#[reflect(…)]` of a field.
#[derive(Default)]
struct FieldAttributes {
    unit: Option<LitStr>,
    skip: bool,
}

/// The fields that stand in the serde form, in the order of the source.
pub(super) fn read_parts(fields: &Fields, container: &Container) -> syn::Result<Vec<Part>> {
    let mut parts: Vec<Part> = Vec::new();
    for (position, field) in fields.iter().enumerate() {
        let member = Member::read(&field.attrs)?;
        let own = FieldAttributes::read(&field.attrs)?;
        if member.skip || own.skip {
            continue;
        }
        let key = match &field.ident {
            _ if member.flatten => Key::Flattened,
            Some(name) => Key::Name(container.field_name(name, &member)),
            // serde counts only what it writes.
            None => Key::Index(parts.len()),
        };
        parts.push(Part {
            key,
            member: match &field.ident {
                Some(name) => name.to_token_stream(),
                None => Index::from(position).to_token_stream(),
            },
            binding: format_ident!("part_{position}", span = field.ty.span()),
            data: field.ty.clone(),
            docs: documentation(&field.attrs),
            unit: own.unit,
        });
    }
    Ok(parts)
}

/// `{ a: part_0, .. }`, for structs and variants with or without names.
pub(super) fn quote_pattern(parts: &[Part]) -> Tokens {
    let bindings = parts.iter().map(
        |Part {
             member, binding, ..
         }| quote!(#member: #binding),
    );
    quote!({ #(#bindings,)* .. })
}

/// The part that `segment` names, of those that a pattern has bound.
pub(super) fn quote_lookup(parts: &[Part], function: &str) -> Tokens {
    let function = format_ident!("{function}");
    let mut flattened = Tokens::new();
    let mut names = Tokens::new();
    let mut indices = Tokens::new();
    for Part { key, binding, .. } in parts {
        match key {
            Key::Name(name) => {
                names.extend(quote!(::core::option::Option::Some(#name) => ::core::option::Option::Some(#binding),));
            }
            Key::Index(index) => {
                indices.extend(quote!(::core::option::Option::Some(#index) => ::core::option::Option::Some(#binding),));
            }
            Key::Flattened => flattened.extend(quote! {
                if let ::core::option::Option::Some(part) =
                    framework_reflect::Reflect::#function(#binding, segment)
                {
                    return ::core::option::Option::Some(part);
                }
            }),
        }
    }
    let otherwise = quote!({ #flattened ::core::option::Option::None });
    match (names.is_empty(), indices.is_empty()) {
        (false, _) => quote!(match segment.name() { #names _ => #otherwise }),
        (true, false) => quote!(match segment.index() { #indices _ => #otherwise }),
        (true, true) => otherwise,
    }
}

/// What `segment` can name of the bound parts; `more` are further names.
pub(super) fn quote_children(parts: &[Part], more: Option<&str>) -> Tokens {
    let names = parts.iter().filter_map(|part| match &part.key {
        Key::Name(name) => Some(name.as_str()),
        Key::Index(_) | Key::Flattened => None,
    });
    let names: Vec<_> = names.chain(more).collect();
    let indices = parts
        .iter()
        .filter(|part| matches!(part.key, Key::Index(_)))
        .count();
    let flattened = parts
        .iter()
        .filter(|part| matches!(part.key, Key::Flattened));
    let flattened = flattened.map(|Part { binding, .. }| binding);
    let named = match names.is_empty() {
        true => quote!(framework_reflect::Children::indexed(#indices)),
        false if indices == 0 => quote!(framework_reflect::Children::named([#(#names),*])),
        false => quote! {
            framework_reflect::Children::named([#(#names),*]).and(framework_reflect::Children::indexed(#indices))
        },
    };
    quote!(#named #(.and(framework_reflect::Reflect::children(#flattened)))*)
}

/// The same parts as a type shows them.
pub(super) fn quote_content(parts: &[Part], named: bool) -> Tokens {
    if !named {
        let items = parts.iter().map(|part| quote_shape(&part.data));
        return quote!(framework_reflect::Content::Tuple(::std::vec![#(#items),*]));
    }
    let fields = parts.iter().map(|part| {
        let shape = quote_shape(&part.data);
        let Key::Name(name) = &part.key else {
            return quote!(framework_reflect::Fields::Flattened(#shape));
        };
        let docs = &part.docs;
        let unit = match &part.unit {
            Some(unit) => quote!(::core::option::Option::Some(#unit)),
            None => quote!(::core::option::Option::None),
        };
        quote! {
            framework_reflect::Fields::One(framework_reflect::FieldShape {
                name: #name,
                docs: #docs,
                unit: #unit,
                shape: #shape,
            })
        }
    });
    quote!(framework_reflect::fields([#(#fields),*]))
}

/// The shape of a type; what it lacks is told at its place.
pub(super) fn quote_shape(data: &Type) -> Tokens {
    quote_spanned!(data.span()=> <#data as framework_reflect::Reflect>::shape())
}

/// All lines of documentation.
pub(super) fn documentation(attributes: &[Attribute]) -> String {
    let lines = attributes
        .iter()
        .filter_map(|attribute| match &attribute.meta {
            Meta::NameValue(meta) if meta.path.is_ident("doc") => match &meta.value {
                Expr::Lit(ExprLit {
                    lit: Lit::Str(text),
                    ..
                }) => Some(text.value()),
                _ => None,
            },
            _ => None,
        });
    let lines: Vec<_> = lines.map(|line| line.trim().to_owned()).collect();
    lines.join("\n")
}

impl FieldAttributes {
    fn read(attributes: &[Attribute]) -> syn::Result<Self> {
        let mut read = Self::default();
        for attribute in attributes {
            if !attribute.path().is_ident("reflect") {
                continue;
            }
            attribute.parse_nested_meta(|meta| {
                if meta.path.is_ident("unit") {
                    read.unit = Some(meta.value()?.parse()?);
                } else if meta.path.is_ident("skip") {
                    read.skip = true;
                } else {
                    return Err(meta.error("expected `unit = \"…\"` or `skip`"));
                }
                Ok(())
            })?;
        }
        Ok(read)
    }
}
