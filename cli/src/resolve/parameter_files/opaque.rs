//! Parameters whose values cannot be checked without rustc: serde alone knows what their types take.

use super::expected::{Child, Expected};
use super::values;
use crate::scan::Sources;
use crate::scan::types::{Definition, Resolved, Shape};

/// Types may contain themselves; no honest parameter is deeper.
const DEEPEST: usize = 32;

/// The paths of all of them, as files write them, sorted.
pub(super) fn opaque(root: &Expected<'_>, sources: &Sources<'_>) -> Vec<String> {
    let mut search = Search {
        sources,
        found: Vec::new(),
    };
    search.below(root, &mut Vec::new());
    search.found
}

struct Search<'a> {
    sources: &'a Sources<'a>,
    found: Vec<String>,
}

impl Search<'_> {
    fn below(&mut self, expected: &Expected<'_>, path: &mut Vec<String>) {
        let children = expected.children(self.sources);
        for (name, child) in children.unwrap_or_default() {
            let Child { expected, .. } = child;
            path.push(name);
            match &expected {
                Expected::Value(data) if self.is_visible(data, 0) => {}
                // What is opaque in it has a name of its own.
                _ if path.len() < DEEPEST && expected.children(self.sources).is_some() => {
                    self.below(&expected, path);
                }
                _ => self.found.push(path.join(".")),
            }
            path.pop();
        }
    }

    /// Whether every mistake that a value of this type may have is found without rustc.
    fn is_visible(&self, data: &Resolved, depth: usize) -> bool {
        let is_visible = |data: &Resolved| depth < DEEPEST && self.is_visible(data, depth + 1);
        match &data.shape {
            Shape::Named {
                definition: Definition::Prelude(name),
                arguments,
            } => match arguments.as_slice() {
                [] => values::is_checked(name),
                [inner] => matches!(name.as_str(), "Option" | "Box" | "Vec") && is_visible(inner),
                _ => false,
            },
            Shape::Named {
                definition: Definition::Workspace(_),
                ..
            } => {
                let has_plain_variants = self.sources.library.unit_variants(data).is_some();
                let children = Expected::Value(data.clone()).children(self.sources);
                has_plain_variants
                    || children.is_some_and(|children| {
                        children.values().all(|child| match &child.expected {
                            Expected::Value(data) => is_visible(data),
                            Expected::Tree(_) => false,
                        })
                    })
            }
            Shape::Array(element, length) => {
                matches!(length.shape, Shape::Constant(_)) && is_visible(element)
            }
            Shape::Tuple(parts) => parts.iter().all(is_visible),
            _ => false,
        }
    }
}
