//! The fields of a struct or of one variant, as serde shows them.

use grammar::{Hints, Range, documentation};
use proc_macro2::TokenStream as Tokens;
use quote::{ToTokens, format_ident, quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{ExprPath, Fields, Ident, Index, Type};

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
    hints: Hints,
    /// The function that tells whether it is left out of the serde form.
    is_left_out: Option<ExprPath>,
    /// It is not written by the implementation of its type.
    pub(super) own_form: bool,
}

/// The fields of a struct or a variant.
pub(super) struct Parts {
    pub(super) parts: Vec<Part>,
    /// Whether the serde form has others, or has these in another way.
    pub(super) is_open: bool,
}

/// How a part is found.
pub(super) enum Key {
    Name(String),
    Index(usize),
    /// Its own parts are found instead.
    Flattened,
    /// It has an index, but nobody finds it: `#[reflect(skip)]`.
    Hidden,
}

impl Part {
    /// Whether it, or anything of it, can be found.
    pub(super) fn is_seen(&self) -> bool {
        !matches!(self.key, Key::Hidden)
    }
}

/// The fields that stand in the serde form, in the order of the source.
pub(super) fn read_parts(fields: &Fields, container: &Container) -> syn::Result<Parts> {
    let mut parts: Vec<Part> = Vec::new();
    let mut is_open = false;
    for (position, field) in fields.iter().enumerate() {
        let member = Member::read(&field.attrs)?;
        let hints = Hints::read(&field.attrs)?;
        if member.skip {
            continue;
        }
        is_open |= hints.skip || member.flatten || member.own_form;
        // What is left out of a tuple moves all behind it.
        is_open |= member.is_left_out.is_some() && field.ident.is_none();
        let key = match &field.ident {
            Some(_) if hints.skip => continue,
            None if hints.skip => Key::Hidden,
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
            hints,
            is_left_out: member.is_left_out,
            own_form: member.own_form,
        });
    }
    Ok(Parts { parts, is_open })
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
            Key::Hidden => {}
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
        (false, _) => {
            let by_name = quote!(match segment.name() { #names _ => #otherwise });
            let are_fields = parts.iter().all(|part| matches!(part.key, Key::Name(_)));
            match are_fields {
                true => quote_positions(parts, &by_name),
                false => by_name,
            }
        }
        (true, false) => quote!(match segment.index() { #indices _ => #otherwise }),
        (true, true) => otherwise,
    }
}

/// The fields by their place first: what is looked up again and again is looked up so.
fn quote_positions(parts: &[Part], by_name: &Tokens) -> Tokens {
    let bindings = parts.iter().map(|part| &part.binding);
    let positions = 0..parts.len();
    quote! {
        match segment {
            #(framework_reflect::Segment::Position(#positions) => ::core::option::Option::Some(#bindings),)*
            _ => #by_name,
        }
    }
}

/// What `segment` can name of the bound parts; `more` are further names.
pub(super) fn quote_children(parts: &[Part], more: Option<&str>) -> Tokens {
    let names = parts.iter().filter_map(|part| match &part.key {
        Key::Name(name) => Some(name.as_str()),
        Key::Index(_) | Key::Flattened | Key::Hidden => None,
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
        let items = parts.iter().map(quote_part_shape);
        return quote!(framework_reflect::Content::Tuple(::std::vec![#(#items),*]));
    }
    let fields = parts.iter().map(|part| {
        let shape = quote_part_shape(part);
        let Key::Name(name) = &part.key else {
            return quote!(framework_reflect::Fields::Flattened(#shape));
        };
        let docs = &part.docs;
        let Hints {
            unit,
            range,
            creation_only,
            ..
        } = &part.hints;
        let unit = quote_option(unit.as_ref());
        let range = quote_option(range.as_ref().map(quote_range));
        let optional = part.is_left_out.is_some();
        quote! {
            framework_reflect::Fields::One(framework_reflect::FieldShape {
                docs: #docs,
                unit: #unit,
                range: #range,
                optional: #optional,
                creation_only: #creation_only,
                ..framework_reflect::FieldShape::new(#name, #shape)
            })
        }
    });
    quote!(framework_reflect::fields([#(#fields),*]))
}

/// All parts that a pattern has bound, one after the other, into `bytes`.
pub(super) fn quote_encode(parts: &[Part]) -> Tokens {
    let encode = parts.iter().map(|part| {
        let binding = &part.binding;
        match &part.is_left_out {
            None => quote!(framework_reflect::Reflect::encode(#binding, bytes)?;),
            Some(is_left_out) => quote! {
                framework_reflect::encode_unless(#is_left_out(#binding), #binding, bytes)?;
            },
        }
    });
    quote!(#(#encode)* ::core::result::Result::Ok(()))
}

fn quote_range(range: &Range) -> Tokens {
    let minimum = quote_option(range.minimum);
    let maximum = quote_option(range.maximum);
    let is_half_open = range.is_half_open;
    quote! {
        framework_reflect::Limits {
            minimum: #minimum,
            maximum: #maximum,
            is_half_open: #is_half_open,
        }
    }
}

fn quote_option(value: Option<impl ToTokens>) -> Tokens {
    match value {
        Some(value) => quote!(::core::option::Option::Some(#value)),
        None => quote!(::core::option::Option::None),
    }
}

/// Of a part whose serde form is not known nothing is said.
pub(super) fn quote_part_shape(part: &Part) -> Tokens {
    if part.is_seen() && !part.own_form {
        return quote_shape(&part.data);
    }
    let data = &part.data;
    quote!(framework_reflect::Shape::leaf::<#data>(framework_reflect::Leaf::Opaque))
}

/// The shape of a type; what it lacks is told at its place.
pub(super) fn quote_shape(data: &Type) -> Tokens {
    quote_spanned!(data.span()=> <#data as framework_reflect::Reflect>::shape())
}
