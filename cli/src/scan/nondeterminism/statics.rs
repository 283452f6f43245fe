//! Statics whose value can change while the robot runs.

use std::rc::Rc;

use syn::{ItemStatic, StaticMutability};

use crate::scan::library::Library;
use crate::scan::module::Module;
use crate::scan::types::{Definition, Resolved, Shape};

/// Types may hold themselves; no honest static is deeper.
const DEEPEST: usize = 8;

/// Types below `std` that change behind a shared reference.
const CHANGING: &[&str] = &[
    "cell::Cell",
    "cell::OnceCell",
    "cell::RefCell",
    "cell::UnsafeCell",
    "sync::Mutex",
    "sync::Once",
    "sync::OnceLock",
    "sync::RwLock",
];

/// The same in crates that everybody uses.
const CHANGING_ELSEWHERE: &[&str] = &[
    "once_cell::sync::OnceCell",
    "parking_lot::Mutex",
    "parking_lot::RwLock",
];

impl Library<'_> {
    /// `static mut`, or a type with interior mutability; where that cannot be told, not.
    pub(super) fn can_change(&self, module: &Rc<Module>, item: &ItemStatic) -> bool {
        let is_mutable = matches!(item.mutability, StaticMutability::Mut(_));
        is_mutable || self.has_interior(&self.resolve(module, &item.ty), 0)
    }

    fn has_interior(&self, data: &Resolved, depth: usize) -> bool {
        let mut inner = |data: &Resolved| depth < DEEPEST && self.has_interior(data, depth + 1);
        match &data.shape {
            Shape::Named {
                definition,
                arguments,
            } => {
                is_changing(definition)
                    || arguments.iter().any(&mut inner)
                    || (self.fields(data).iter().flat_map(|one| &one.fields))
                        .any(|field| inner(&field.data))
            }
            Shape::Tuple(parts) => parts.iter().any(inner),
            Shape::Array(part, _) | Shape::Slice(part) | Shape::Reference(part) => inner(part),
            Shape::Constant(_) | Shape::Unknown => false,
        }
    }
}

fn is_changing(definition: &Definition) -> bool {
    match definition {
        Definition::Standard(path) => {
            path.starts_with("sync::atomic::") || CHANGING.contains(&path.as_str())
        }
        Definition::Foreign { path, .. } => CHANGING_ELSEWHERE.contains(&path.as_str()),
        Definition::Prelude(_) | Definition::Workspace(_) => false,
    }
}
