//! What stands in angle brackets behind a trait and a type, by which one `impl` of a trait is another one than the one asked for.

use std::rc::Rc;

use syn::{GenericArgument, GenericParam, ItemImpl, PathArguments, Type};

use super::super::library::Library;
use super::super::module::Module;
use super::super::types::{Resolved, Shape};

/// Arguments without lifetimes as absolute text, empty without any; `None`: rustc alone knows which they are.
pub type Arguments = Option<String>;

impl Library<'_> {
    /// The arguments that a path to a trait gives.
    pub fn trait_arguments(&self, module: &Rc<Module>, path: &syn::Path) -> Arguments {
        let mut given = Vec::new();
        for segment in &path.segments {
            let arguments = match &segment.arguments {
                PathArguments::None => continue,
                PathArguments::AngleBracketed(arguments) => &arguments.args,
                PathArguments::Parenthesized(_) => return None,
            };
            for argument in arguments {
                match argument {
                    GenericArgument::Lifetime(_) => {}
                    GenericArgument::Type(data) => given.push(self.resolve(module, data)),
                    _ => return None,
                }
            }
        }
        text(&given)
    }

    /// The arguments that a type gives to its definition.
    fn type_arguments(&self, module: &Rc<Module>, data: &Type) -> Arguments {
        match self.resolve(module, data).shape {
            Shape::Named { arguments, .. } => text(&arguments),
            _ => None,
        }
    }

    /// Whether an `impl` is for just these arguments of its trait and of its type.
    pub(super) fn has_arguments(
        &self,
        module: &Rc<Module>,
        item: &ItemImpl,
        of_trait: &Arguments,
        of_type: &Arguments,
    ) -> bool {
        let Some((None, written, _)) = &item.trait_ else {
            return false;
        };
        let none = Some(String::new());
        let mut parameters = item.generics.params.iter();
        let is_for_many =
            parameters.any(|parameter| !matches!(parameter, GenericParam::Lifetime(_)));
        of_trait.is_some()
            && of_type.is_some()
            && self.trait_arguments(module, written) == *of_trait
            && self.type_arguments(module, &item.self_ty) == *of_type
            && (!is_for_many || (*of_trait == none && *of_type == none))
    }
}

/// Several arguments as one text.
pub(super) fn text(arguments: &[Resolved]) -> Arguments {
    let is_lifetime =
        |one: &Resolved| matches!(&one.shape, Shape::Constant(text) if text.starts_with('\''));
    let mut arguments = arguments.iter().filter(|one| !is_lifetime(one));
    let texts: Option<Vec<&str>> = arguments.try_fold(Vec::new(), |mut texts, one| {
        texts.push(one.is_known().then_some(one.text.as_str())?);
        Some(texts)
    });
    texts.map(|texts| texts.join(", "))
}
