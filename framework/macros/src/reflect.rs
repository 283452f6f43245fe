//! `#[derive(Reflect)]`.

mod enums;
mod on_type;
mod parts;
mod structs;

use grammar::documentation;
use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::{Data, DeriveInput, ExprPath, parse_quote};

use self::on_type::OnType;
use crate::serde_names::Container;

/// The functions of the trait that depend on the parts of a type.
#[derive(Default)]
struct Functions {
    /// Body of `shape`.
    shape: Tokens,
    /// Bodies of `child`, `child_mut` and `children`; none where the trait's own will do.
    parts: Option<Walk>,
    /// Body of `encode`; none where the serde form is written as it comes.
    encode: Option<Tokens>,
}

/// How to find the parts of a value.
struct Walk {
    child: Tokens,
    child_mut: Tokens,
    children: Tokens,
}

pub(crate) fn expand(item: &DeriveInput) -> syn::Result<Tokens> {
    let container = Container::read(&item.attrs)?;
    let docs = documentation(&item.attrs);
    let said = OnType::read(item)?;
    let functions = match &item.data {
        _ if container.foreign => opaque(),
        Data::Struct(data) => structs::functions(&data.fields, &container, &docs, said.pixels)?,
        Data::Enum(data) => enums::functions(data, &container, &docs)?,
        Data::Union(data) => {
            let message = "`Reflect` is for structs and enums";
            return Err(syn::Error::new(data.union_token.span, message));
        }
    };
    Ok(quote_implementation(
        item,
        &functions,
        said.foxglove.as_ref(),
    ))
}

fn quote_foxglove(function: &ExprPath) -> Tokens {
    quote! {
        fn foxglove() -> ::core::option::Option<framework_reflect::WellKnownForm<Self>> {
            ::core::option::Option::Some(framework_reflect::WellKnownForm {
                schema: framework_reflect::schema_of::<Self, _>(#function),
                write: |value, timestamp| framework_reflect::written(&#function(value, timestamp)),
            })
        }
    }
}

/// A type whose serde form is not that of its parts: shown as a whole.
fn opaque() -> Functions {
    Functions {
        shape: quote!(framework_reflect::Shape::leaf::<Self>(
            framework_reflect::Leaf::Opaque
        )),
        parts: None,
        encode: None,
    }
}

/// The shape of a type with these parts.
fn quote_shape(content: &Tokens, form: &Tokens, docs: &str) -> Tokens {
    quote! {
        framework_reflect::Shape::of::<Self>(|| framework_reflect::Shape {
            docs: #docs,
            form: framework_reflect::Form::#form,
            ..framework_reflect::Shape::new::<Self>(#content)
        })
    }
}

fn quote_implementation(
    item: &DeriveInput,
    functions: &Functions,
    foxglove: Option<&ExprPath>,
) -> Tokens {
    let foxglove = foxglove.map(quote_foxglove);
    let name = &item.ident;
    let mut generics = item.generics.clone();
    for parameter in generics.type_params_mut() {
        parameter
            .bounds
            .push(parse_quote!(framework_reflect::DeserializeOwned));
        parameter
            .bounds
            .push(parse_quote!(framework_reflect::Reflect));
        parameter
            .bounds
            .push(parse_quote!(framework_reflect::Serialize));
    }
    let (parameters, arguments, clause) = generics.split_for_impl();
    let shape = &functions.shape;
    let walk = functions.parts.as_ref().map(quote_walk);
    let encode = match &functions.encode {
        Some(encode) => encode.clone(),
        None => quote!(framework_reflect::encode_any(self, bytes)),
    };
    quote! {
        const _: () = {
            use ::framework::reflect::derived as framework_reflect;

            #[automatically_derived]
            impl #parameters framework_reflect::Reflect for #name #arguments #clause {
                fn shape() -> framework_reflect::Shape {
                    #shape
                }

                #walk

                #foxglove

                fn encode(
                    &self,
                    bytes: &mut ::std::vec::Vec<u8>,
                ) -> ::core::result::Result<(), framework_reflect::EncodeError> {
                    #encode
                }

                fn as_serialize(&self) -> &dyn framework_reflect::erased_serde::Serialize {
                    self
                }

                fn deserialize_from(
                    &mut self,
                    given: &framework_reflect::Given<'_>,
                ) -> framework_reflect::Result<()> {
                    *self = given.read()?;
                    ::core::result::Result::Ok(())
                }
            }
        };
    }
}

fn quote_walk(walk: &Walk) -> Tokens {
    let Walk {
        child,
        child_mut,
        children,
    } = walk;
    quote! {
        fn child(
            &self,
            segment: &framework_reflect::Segment,
        ) -> ::core::option::Option<&dyn framework_reflect::Reflect> {
            #child
        }

        fn child_mut(
            &mut self,
            segment: &framework_reflect::Segment,
        ) -> ::core::option::Option<&mut dyn framework_reflect::Reflect> {
            #child_mut
        }

        fn children(&self) -> framework_reflect::Children {
            #children
        }
    }
}

#[cfg(test)]
mod tests {
    use super::expand;

    fn error(item: &str) -> String {
        let item = syn::parse_str(item).expect("the item is written well");
        expand(&item).expect_err("it has a mistake").to_string()
    }

    #[test]
    fn what_reflect_does_not_know_is_told() {
        for (item, message) in [
            (
                "union U { a: u8, b: f32 }",
                "`Reflect` is for structs and enums",
            ),
            (
                "struct S { #[reflect(units = \"m\")] a: u8 }",
                "expected `unit = \"…\"`, `range = 0.0..=1.0`, `skip` or `creation_only`",
            ),
            (
                "enum E { A { #[reflect(unit = 5)] a: u8 } }",
                "expected string literal",
            ),
            (
                "#[reflect(image = \"bayer\")] struct S { width: u32, height: u32, data: Vec<u8> }",
                "expected \"gray\", \"rgb\" or \"yuyv\"",
            ),
            (
                "#[reflect(image = \"rgb\")] struct S { width: u32, rows: u32, data: Vec<u8> }",
                "an image is a struct with the fields `width`, `height` and `data`",
            ),
            (
                "#[reflect(unit = \"m\")] struct S { a: u8 }",
                "expected `image = \"yuyv\"` or `foxglove = FUNCTION`; all else is said on fields",
            ),
        ] {
            assert_eq!(error(item), message, "{item}");
        }
    }

    #[test]
    fn a_type_parameter_must_be_reflected_too() {
        let item = syn::parse_str("struct Both<T> { left: T, right: T }").expect("it is a struct");
        let tokens = expand(&item)
            .expect("it has no mistake")
            .to_string()
            .replace(' ', "");
        let bounds = ["DeserializeOwned", "Reflect", "Serialize"]
            .map(|name| format!("framework_reflect::{name}"));
        assert!(
            tokens.contains(&format!("impl<T:{}>", bounds.join("+"))),
            "{tokens}"
        );
    }
}
