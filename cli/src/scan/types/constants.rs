//! Constants in types: lengths of arrays, and arguments that are numbers.

use std::rc::Rc;

use syn::{Expr, Item};

use super::{Resolved, Substitutions, written};
use crate::scan::library::Library;
use crate::scan::lookup::{Found, ItemId};
use crate::scan::module::Module;

impl Library<'_> {
    /// A number between `<` and `>` or behind the `;` of an array.
    pub(super) fn constant(
        &self,
        module: &Rc<Module>,
        value: &Expr,
        generics: &Substitutions,
    ) -> Resolved {
        let value = match value {
            Expr::Block(block) => match block.block.stmts.as_slice() {
                [syn::Stmt::Expr(value, None)] => value,
                _ => value,
            },
            value => value,
        };
        if let Some(number) = number(value) {
            return Resolved::constant(number.clone(), number);
        }
        if let Expr::Path(path) = value
            && path.qself.is_none()
        {
            let name = path.path.get_ident().map(ToString::to_string);
            if let Some(argument) = name.and_then(|name| generics.get(&name)) {
                return argument.clone();
            }
            if let Some(Found::Item(item)) = self.find(module, &path.path)
                && matches!(item.item(), Item::Const(_))
            {
                return self.constant_item(&item);
            }
        }
        self.absolute_constant(module, value, generics)
    }

    /// A constant by its number, where its definition is one.
    pub(super) fn constant_item(&self, item: &ItemId) -> Resolved {
        let Item::Const(constant) = item.item() else {
            return Resolved::unknown(item.path());
        };
        let public = self.public_path(item);
        match (number(&constant.expr), public) {
            (Some(number), Some(text)) => Resolved::constant(text, number),
            (Some(number), None) => Resolved::constant(number.clone(), number),
            (None, Some(text)) => Resolved::unknown(text),
            (None, None) => Resolved {
                private: vec![item.clone()],
                ..Resolved::unknown(item.path())
            },
        }
    }
}

/// An integer without its suffix, a bool, or a character.
fn number(value: &Expr) -> Option<String> {
    let Expr::Lit(literal) = value else {
        return None;
    };
    match &literal.lit {
        syn::Lit::Int(number) => Some(number.base10_digits().to_owned()),
        syn::Lit::Bool(_) | syn::Lit::Char(_) => Some(written(literal)),
        _ => None,
    }
}
