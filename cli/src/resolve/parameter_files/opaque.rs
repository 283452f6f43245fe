//! Parameters whose values cannot be checked without rustc: serde alone knows what their types take.

use super::expected::{Child, Children, Expected};
use super::form::{Form, bare, may_refuse};
use super::variants::Content;
use crate::scan::Sources;
use crate::scan::types::Resolved;

/// Types may contain themselves; no honest parameter is deeper.
const DEEPEST: usize = 32;

/// The paths of all of them, as files write them, sorted.
pub(super) fn opaque(root: &Expected<'_>, sources: &Sources<'_>) -> Vec<String> {
    let mut search = Search {
        sources,
        found: Vec::new(),
    };
    search.below(root, &mut Vec::new(), &mut Vec::new());
    search.found
}

struct Search<'a> {
    sources: &'a Sources<'a>,
    found: Vec<String>,
}

impl Search<'_> {
    /// `around` are the types that the place stands in.
    fn below(&mut self, expected: &Expected<'_>, path: &mut Vec<String>, around: &mut Vec<String>) {
        let Some(Children::Named(children)) = expected.children(self.sources) else {
            return;
        };
        for (name, child) in children {
            let Child { expected, .. } = child;
            path.push(name);
            let data = match &expected {
                Expected::Value(data) => Some(data),
                Expected::Tree(_) => None,
            };
            let text = data.map(|data| bare(data).text.clone());
            match data {
                Some(data) if self.is_visible(data, &[]) => {}
                // What is opaque in it was named where it stands for the first time.
                _ if text.as_ref().is_some_and(|text| around.contains(text)) => {}
                // What is opaque in it has a name of its own.
                _ if path.len() < DEEPEST && self.has_names(&expected) && !self.refuses(data) => {
                    let depth = around.len();
                    around.extend(text);
                    self.below(&expected, path, around);
                    around.truncate(depth);
                }
                _ => self.found.push(path.join(".")),
            }
            path.pop();
        }
    }

    fn refuses(&self, data: Option<&Resolved>) -> bool {
        data.is_some_and(|data| may_refuse(data, self.sources))
    }

    fn has_names(&self, expected: &Expected<'_>) -> bool {
        matches!(expected.children(self.sources), Some(Children::Named(_)))
    }

    /// Whether every mistake that a value of this type may have is found without rustc; `around` are the types that it
    /// stands in.
    fn is_visible(&self, data: &Resolved, around: &[&str]) -> bool {
        let text = bare(data).text.as_str();
        // A type in itself hides nothing that it does not hide elsewhere.
        if around.contains(&text) {
            return true;
        }
        if around.len() > DEEPEST || may_refuse(data, self.sources) {
            return false;
        }
        let inside: Vec<&str> = around.iter().copied().chain([text]).collect();
        let is_visible = |data: &Resolved| self.is_visible(data, &inside);
        let are_visible = |children: &Children<'_>| match children {
            Children::Any(data) => is_visible(data),
            Children::Named(children) => children.values().all(|child| match &child.expected {
                Expected::Value(data) => is_visible(data),
                Expected::Tree(_) => false,
            }),
        };
        match Form::of(data, self.sources) {
            Form::Boolean
            | Form::Number { .. }
            | Form::Whole { .. }
            | Form::Text
            | Form::Letter
            | Form::Address(_) => true,
            Form::List(inner) | Form::Map(inner) | Form::Repeated { element: inner, .. } => {
                is_visible(&inner)
            }
            Form::Several(parts) => parts.iter().all(is_visible),
            Form::Fields { children, .. } => are_visible(&children),
            Form::Variants(variants) => variants.iter().all(|variant| match &variant.content {
                Content::Nothing => true,
                Content::One(data) => is_visible(data),
                Content::Several(parts) => parts.iter().all(is_visible),
                Content::Fields(children) => are_visible(children),
                Content::Unknown => false,
            }),
            Form::Unknown => false,
        }
    }
}
