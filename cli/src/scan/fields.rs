//! Fields of the workspace's structs, as far as they can be trusted to be what they seem.

use std::ops::Range;
use std::rc::Rc;

use camino::Utf8PathBuf;
use syn::ext::IdentExt;
use syn::{Attribute, Fields, Generics, Item, Meta};

use super::library::Library;
use super::lookup::ItemId;
use super::module::Module;
use super::range;
use super::state::derives;
use super::types::{Definition, Resolved, Shape, Substitutions, substitutions};

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

/// The variants of an enum, with generic parameters filled in.
#[derive(Clone, Debug)]
pub struct Variants {
    /// Attributes of the enum.
    pub attributes: Vec<Attribute>,
    pub variants: Vec<Variant>,
}

/// One variant of an enum.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Without `r#`.
    pub name: String,
    pub attributes: Vec<Attribute>,
    /// Its fields have names; else they are called `0`, `1`, ….
    pub has_names: bool,
    pub fields: Vec<StructField>,
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
    "reflect",
    "repr",
    "serde",
    "warn",
];

/// A struct or an enum of the workspace that no macro may have changed.
struct Plain<'a> {
    item: &'a ItemId,
    arguments: &'a [Resolved],
    attributes: &'a [Attribute],
    generics: &'a Generics,
}

impl<'a> Plain<'a> {
    fn of(data: &'a Resolved) -> Option<Self> {
        let Shape::Named {
            definition: Definition::Workspace(item),
            arguments,
        } = &data.shape
        else {
            return None;
        };
        let (attributes, generics) = match item.item() {
            Item::Struct(item) => (&item.attrs, &item.generics),
            Item::Enum(item) => (&item.attrs, &item.generics),
            _ => return None,
        };
        attributes.iter().all(is_harmless).then_some(Self {
            item,
            arguments,
            attributes,
            generics,
        })
    }

    /// What its parameters stand for: what is given, else their defaults.
    fn substitutions(&self, library: &Library<'_>) -> Option<Substitutions> {
        let given = self.arguments.to_vec();
        let all = library.with_defaults(&self.item.module, self.generics, given, 0);
        substitutions(self.generics, all)
    }
}

impl Library<'_> {
    /// The fields of a struct of the workspace; `None` for everything else, and where a macro may have changed it.
    pub fn fields(&self, data: &Resolved) -> Option<StructFields> {
        let plain = Plain::of(data)?;
        let item = plain.item;
        let Item::Struct(definition) = item.item() else {
            return None;
        };
        let Fields::Named(fields) = &definition.fields else {
            return None;
        };
        let generics = plain.substitutions(self)?;
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
            dereferences: dereferences(&item.module.syntax, &definition.ident, &definition.attrs),
        })
    }

    /// The variants of an enum of the workspace; `None` for everything else, and where a macro may have changed it.
    pub fn variants(&self, data: &Resolved) -> Option<Variants> {
        let plain = Plain::of(data)?;
        let item = plain.item;
        let Item::Enum(definition) = item.item() else {
            return None;
        };
        let generics = plain.substitutions(self)?;
        let variants = definition.variants.iter().map(|variant| Variant {
            name: variant.ident.unraw().to_string(),
            attributes: variant.attrs.clone(),
            has_names: matches!(variant.fields, Fields::Named(_)),
            fields: self.variant_fields(&item.module, &variant.fields, &generics),
        });
        Some(Variants {
            attributes: definition.attrs.clone(),
            variants: variants.collect(),
        })
    }

    /// The attributes of a struct or an enum of the workspace; `None` for everything else, and where a macro may have
    /// changed it.
    pub fn attributes<'a>(&self, data: &'a Resolved) -> Option<&'a [Attribute]> {
        Plain::of(data).map(|plain| plain.attributes)
    }

    /// What a type means that stands where such a struct or enum is defined.
    pub fn resolve_beside(&self, data: &Resolved, written: &syn::Type) -> Option<Resolved> {
        let plain = Plain::of(data)?;
        let generics = plain.substitutions(self)?;
        Some(self.resolve_with(&plain.item.module, written, &generics, 0))
    }

    /// Whether a type of the workspace certainly has no field with a name.
    pub fn is_without_fields(&self, data: &Resolved) -> bool {
        let Some(plain) = Plain::of(data) else {
            return false;
        };
        let name = match plain.item.item() {
            Item::Enum(item) => &item.ident,
            Item::Struct(item) if !matches!(item.fields, Fields::Named(_)) => &item.ident,
            _ => return false,
        };
        !dereferences(&plain.item.module.syntax, name, plain.attributes)
    }

    fn variant_fields(
        &self,
        module: &Rc<Module>,
        fields: &Fields,
        generics: &Substitutions,
    ) -> Vec<StructField> {
        let fields = fields.iter().enumerate().map(|(index, field)| {
            let name = field.ident.as_ref().map(|name| name.unraw().to_string());
            StructField {
                name: name.unwrap_or_else(|| index.to_string()),
                data: self.resolve_with(module, &field.ty, generics, 0),
                range: range(syn::spanned::Spanned::span(&field.ty)),
                public: true,
                attributes: field.attrs.clone(),
            }
        });
        fields.collect()
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
            Item::Macro(call) => range(syn::spanned::Spanned::span(&call.mac.path)),
            _ => 0..0,
        }
    }
}

/// Whether a type stands for another value, by `impl Deref` beside it or by a derive.
fn dereferences(file: &syn::File, name: &syn::Ident, attributes: &[Attribute]) -> bool {
    let by_hand = file.items.iter().any(|item| match item {
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
    });
    by_hand || derives(attributes, "Deref")
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
