//! Constants in types: lengths of arrays, and arguments that are numbers.

use std::rc::Rc;

use syn::{Expr, Item};

use super::{Resolved, Shape, written};
use crate::scan::library::Library;
use crate::scan::lookup::{Found, ItemId};
use crate::scan::module::Module;

impl Library<'_> {
    /// A number between `<` and `>` or behind the `;` of an array.
    pub(super) fn constant(&self, module: &Rc<Module>, value: &Expr) -> Resolved {
        if let Some(number) = number(value) {
            return Resolved {
                shape: Shape::Constant(number.clone()),
                text: number,
                private: Vec::new(),
            };
        }
        let value = match value {
            Expr::Block(block) => match block.block.stmts.as_slice() {
                [syn::Stmt::Expr(value, None)] => value,
                _ => value,
            },
            value => value,
        };
        if let Expr::Path(path) = value
            && let Some(Found::Item(item)) = self.find(module, &path.path)
        {
            return self.constant_item(&item);
        }
        Resolved::unknown(written(value))
    }

    /// A constant by its number, where its definition is one.
    pub(super) fn constant_item(&self, item: &ItemId) -> Resolved {
        let Item::Const(constant) = item.item() else {
            return Resolved::unknown(item.path());
        };
        let public = self.public_path(item);
        match (number(&constant.expr), public) {
            (Some(number), Some(text)) => Resolved {
                text,
                shape: Shape::Constant(number),
                private: Vec::new(),
            },
            (Some(number), None) => Resolved {
                text: number.clone(),
                shape: Shape::Constant(number),
                private: Vec::new(),
            },
            (None, Some(text)) => Resolved::unknown(text),
            (None, None) => Resolved {
                text: item.path(),
                shape: Shape::Unknown,
                private: vec![item.clone()],
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
