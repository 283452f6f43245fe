//! What `#[reflect(…)]` says on a type itself: `image = "…"`, its values are images; `foxglove = …`, how they are drawn.

use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::{Data, DeriveInput, ExprPath, LitStr};

/// What every image has, by the names that clients see.
const FIELDS: [&str; 3] = ["width", "height", "data"];

/// What a type says of itself.
#[derive(Default)]
pub(super) struct OnType {
    /// Of which pixels its values are images, as the framework names them.
    pub(super) pixels: Option<Tokens>,
    /// The function that writes a value in a form that viewers know.
    pub(super) foxglove: Option<ExprPath>,
}

impl OnType {
    pub(super) fn read(item: &DeriveInput) -> syn::Result<Self> {
        let mut said = Self::default();
        for attribute in &item.attrs {
            if !attribute.path().is_ident("reflect") {
                continue;
            }
            attribute.parse_nested_meta(|meta| {
                if meta.path.is_ident("image") {
                    said.pixels = Some(pixels(&meta.value()?.parse()?)?);
                } else if meta.path.is_ident("foxglove") {
                    said.foxglove = Some(meta.value()?.parse()?);
                } else {
                    let message = "expected `image = \"yuyv\"` or `foxglove = FUNCTION`; all else is said on fields";
                    return Err(meta.error(message));
                }
                Ok(())
            })?;
        }
        if said.pixels.is_some() && !has_fields(&item.data) {
            let message = "an image is a struct with the fields `width`, `height` and `data`";
            return Err(syn::Error::new(item.ident.span(), message));
        }
        Ok(said)
    }
}

fn pixels(name: &LitStr) -> syn::Result<Tokens> {
    Ok(match name.value().as_str() {
        "gray" => quote!(framework_reflect::Pixels::Gray),
        "rgb" => quote!(framework_reflect::Pixels::Rgb),
        "yuyv" => quote!(framework_reflect::Pixels::Yuyv),
        _ => {
            let message = "expected \"gray\", \"rgb\" or \"yuyv\"";
            return Err(syn::Error::new(name.span(), message));
        }
    })
}

fn has_fields(data: &Data) -> bool {
    let Data::Struct(data) = data else {
        return false;
    };
    let has = |name: &&str| {
        let mut fields = data.fields.iter();
        fields.any(|field| field.ident.as_ref().is_some_and(|known| known == name))
    };
    FIELDS.iter().all(has)
}
