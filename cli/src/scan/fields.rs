//! Fields of the workspace's structs, as far as they can be trusted to be what they seem.

use std::ops::Range;

use camino::Utf8PathBuf;
use syn::ext::IdentExt;
use syn::{Attribute, Fields, Item, Meta};

use super::library::Library;
use super::lookup::ItemId;
use super::range;
use super::state::{derives, has_any_serde};
use super::types::{Definition, Resolved, Shape, substitutions};

/// Fields of a struct, with generic parameters filled in.
#[derive(Clone, Debug)]
pub struct StructFields {
    /// Where it is defined: `types::ball::Ball`.
    pub path: String,
    pub file: Utf8PathBuf,
    /// Of its name.
    pub range: Range<usize>,
    /// Attributes of the struct.
    pub attributes: Vec<Attribute>,
    pub fields: Vec<StructField>,
    /// It stands for another value by `Deref`, which may have more fields.
    pub dereferences: bool,
}

/// A named field.
#[derive(Clone, Debug)]
pub struct StructField {
    /// Without `r#`, as serde and paths write it.
    pub name: String,
    pub data: Resolved,
    /// Of its name.
    pub range: Range<usize>,
    pub public: bool,
    pub attributes: Vec<Attribute>,
}

/// Attributes that leave a struct as it is written.
const HARMLESS: &[&str] = &[
    "allow",
    "cfg_attr",
    "deprecated",
    "derive",
    "diagnostic",
    "doc",
    "expect",
    "must_use",
    "non_exhaustive",
    "repr",
    "serde",
    "warn",
];

impl Library<'_> {
    /// The fields of a struct of the workspace; `None` for everything else, and where a macro may have changed it.
    pub fn fields(&self, data: &Resolved) -> Option<StructFields> {
        let Shape::Named {
            definition: Definition::Workspace(item),
            arguments,
        } = &data.shape
        else {
            return None;
        };
        let Item::Struct(definition) = item.item() else {
            return None;
        };
        let Fields::Named(fields) = &definition.fields else {
            return None;
        };
        if !definition.attrs.iter().all(is_harmless) {
            return None;
        }
        let generics = substitutions(&definition.generics, arguments.clone())?;
        let fields = fields
            .named
            .iter()
            .filter_map(|field| {
                let name = field.ident.as_ref()?;
                Some(StructField {
                    name: name.unraw().to_string(),
                    data: self.resolve_with(&item.module, &field.ty, &generics, 0),
                    range: range(name.span()),
                    public: matches!(field.vis, syn::Visibility::Public(_)),
                    attributes: field.attrs.clone(),
                })
            })
            .collect();
        Some(StructFields {
            path: item.path(),
            file: item.module.file.clone(),
            range: range(definition.ident.span()),
            attributes: definition.attrs.clone(),
            fields,
            dereferences: dereferences(&item.module.syntax, &definition.ident),
        })
    }

    /// The names that derived serde reads for an enum of unit variants; `None` where that cannot be seen.
    pub fn unit_variants(&self, data: &Resolved) -> Option<Vec<String>> {
        let Shape::Named {
            definition: Definition::Workspace(item),
            ..
        } = &data.shape
        else {
            return None;
        };
        let Item::Enum(definition) = item.item() else {
            return None;
        };
        let plain = derives(&definition.attrs, "Deserialize")
            && !has_any_serde(&definition.attrs)
            && definition.attrs.iter().all(is_harmless);
        let variants = definition.variants.iter();
        let unit = variants.clone().all(|variant| {
            matches!(variant.fields, Fields::Unit) && !has_any_serde(&variant.attrs)
        });
        let names = variants.map(|variant| variant.ident.unraw().to_string());
        (plain && unit).then(|| names.collect())
    }

    /// The place of an item's name in its file.
    pub fn name_range(&self, item: &ItemId) -> Range<usize> {
        match item.item() {
            Item::Struct(item) => range(item.ident.span()),
            Item::Enum(item) => range(item.ident.span()),
            Item::Union(item) => range(item.ident.span()),
            Item::Type(item) => range(item.ident.span()),
            Item::Trait(item) => range(item.ident.span()),
            Item::Const(item) => range(item.ident.span()),
            _ => 0..0,
        }
    }
}

fn dereferences(file: &syn::File, name: &syn::Ident) -> bool {
    file.items.iter().any(|item| match item {
        Item::Impl(block) => {
            let is_deref = block.trait_.as_ref().is_some_and(|(_, path, _)| {
                path.segments
                    .last()
                    .is_some_and(|last| last.ident == "Deref")
            });
            let of_name = match &*block.self_ty {
                syn::Type::Path(path) => path
                    .path
                    .segments
                    .last()
                    .is_some_and(|last| last.ident == *name),
                _ => false,
            };
            is_deref && of_name
        }
        _ => false,
    })
}

pub(super) fn is_harmless(attribute: &Attribute) -> bool {
    let name = attribute.path().get_ident();
    let harmless = |name: &str| HARMLESS.contains(&name);
    match &attribute.meta {
        Meta::List(list) if list.path.is_ident("cfg_attr") => {
            !list.tokens.to_string().contains("context")
        }
        _ => name.is_some_and(|name| harmless(&name.to_string())),
    }
}
