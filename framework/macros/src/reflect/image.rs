//! `#[reflect(image = "…")]` of a struct: its values are images.

use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::{Data, DeriveInput, LitStr};

/// What every image has, by the names that clients see.
const FIELDS: [&str; 3] = ["width", "height", "data"];

/// Of which pixels values of the type are images, as the framework names them.
pub(super) fn read(item: &DeriveInput) -> syn::Result<Option<Tokens>> {
    let mut pixels = None;
    for attribute in &item.attrs {
        if !attribute.path().is_ident("reflect") {
            continue;
        }
        attribute.parse_nested_meta(|meta| {
            if !meta.path.is_ident("image") {
                return Err(meta.error("expected `image = \"yuyv\"`; all else is said on fields"));
            }
            let name: LitStr = meta.value()?.parse()?;
            pixels = Some(match name.value().as_str() {
                "gray" => quote!(framework_reflect::Pixels::Gray),
                "rgb" => quote!(framework_reflect::Pixels::Rgb),
                "yuyv" => quote!(framework_reflect::Pixels::Yuyv),
                _ => {
                    let message = "expected \"gray\", \"rgb\" or \"yuyv\"";
                    return Err(syn::Error::new(name.span(), message));
                }
            });
            Ok(())
        })?;
    }
    if pixels.is_some() && !has_fields(&item.data) {
        let message = "an image is a struct with the fields `width`, `height` and `data`";
        return Err(syn::Error::new(item.ident.span(), message));
    }
    Ok(pixels)
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
