//! What is there only under a `#[cfg(…)]`, so that rustc alone knows whether it is.

use std::rc::Rc;

use super::library::Library;
use super::lookup::Found;
use super::module::{Entry, Module, attributes, is_conditional};

/// `use` may lead in circles; no honest path is longer.
const DEEPEST: usize = 32;

impl Library<'_> {
    /// Whether a condition decides about one of the names of an absolute path, or of those that lead there by `use`.
    pub(super) fn is_path_conditional(&self, path: &str) -> bool {
        let names: Vec<String> = path.split("::").map(str::to_owned).collect();
        let Some((library, rest)) = names.split_first() else {
            return false;
        };
        self.root(library)
            .is_some_and(|root| self.is_way_conditional(&root, rest, false, 0))
    }

    /// The same for names that are written in a module.
    pub(super) fn is_way_conditional(
        &self,
        module: &Rc<Module>,
        names: &[String],
        absolute: bool,
        depth: usize,
    ) -> bool {
        let conditional = |(index, name): (usize, &String)| {
            let place = match index {
                0 if absolute => return false,
                0 => module.clone(),
                _ => match self.follow(module, &names[..index], absolute, 0) {
                    Some(Found::Module(place)) => place,
                    _ => return false,
                },
            };
            match place.entries.get(name) {
                Some(Entry::Ambiguous) => true,
                Some(Entry::Item { index, .. }) => is_conditional(attributes(place.item(*index))),
                Some(Entry::Import(import)) => {
                    let itself = import.segments.first() == Some(name);
                    let absolute = import.absolute || itself;
                    import.is_conditional
                        || depth < DEEPEST
                            && self.is_way_conditional(
                                &place,
                                &import.segments,
                                absolute,
                                depth + 1,
                            )
                }
                // A glob under a condition may be what brings it in.
                None => {
                    let is_special = matches!(name.as_str(), "crate" | "self" | "super");
                    !is_special && place.globs.iter().any(|glob| glob.is_conditional)
                }
            }
        };
        names.iter().enumerate().any(conditional)
    }
}
