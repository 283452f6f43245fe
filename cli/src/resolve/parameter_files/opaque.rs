//! Parameters whose values cannot be checked without rustc: serde alone knows what their types take.

use std::collections::BTreeMap;

use super::expected::{Child, Children, Expected};
use super::form::{Form, bare, may_refuse};
use super::variants::Content;
use crate::scan::Sources;
use crate::scan::types::Resolved;

/// Types may contain themselves; no honest parameter is deeper.
const DEEPEST: usize = 32;

/// Types may lead to ever new ones; what is still to be judged after so many is opaque.
const MOST: usize = 2_000;

/// The paths of all of them, as files write them, sorted.
pub(super) fn opaque(root: &Expected<'_>, sources: &Sources<'_>) -> Vec<String> {
    let mut search = Search {
        sources,
        found: Vec::new(),
        judged: BTreeMap::new(),
        left: MOST,
        met_itself: false,
        is_endless: false,
    };
    search.below(root, &mut Vec::new(), &mut Vec::new());
    search.found
}

struct Search<'a> {
    sources: &'a Sources<'a>,
    found: Vec<String>,
    /// Types by their texts, as far as nothing around them decides: whether they are visible, and whether they are endless.
    judged: BTreeMap<String, (bool, bool)>,
    /// How many types are still looked at.
    left: usize,
    /// A type was met within itself.
    met_itself: bool,
    /// A type led further than any honest one does.
    is_endless: bool,
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
            self.is_endless = false;
            match data {
                Some(data) if self.is_visible(data, &[]) => {}
                // What is opaque in it was named where it stands for the first time.
                _ if text.as_ref().is_some_and(|text| around.contains(text)) => {}
                // It has more names than anybody would read.
                _ if self.is_endless => self.found.push(path.join(".")),
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
    fn is_visible(&mut self, data: &Resolved, around: &[&str]) -> bool {
        let text = bare(data).text.as_str();
        // A type in itself hides nothing that it does not hide elsewhere.
        if around.contains(&text) {
            self.met_itself = true;
            return true;
        }
        if let Some((judged, is_endless)) = self.judged.get(&data.text) {
            self.is_endless |= is_endless;
            return *judged;
        }
        self.left = self.left.saturating_sub(1);
        if self.left == 0 || data.is_huge() || around.len() > DEEPEST {
            self.is_endless = true;
            return false;
        }
        if may_refuse(data, self.sources) {
            return false;
        }
        let inside: Vec<&str> = around.iter().copied().chain([text]).collect();
        let before = (self.met_itself, self.is_endless);
        (self.met_itself, self.is_endless) = (false, false);
        let answer = self.is_visible_within(data, &inside);
        if !answer || !self.met_itself {
            let judged = (answer, self.is_endless);
            self.judged.insert(data.text.clone(), judged);
        }
        self.met_itself |= before.0;
        self.is_endless |= before.1;
        answer
    }

    fn is_visible_within(&mut self, data: &Resolved, around: &[&str]) -> bool {
        match Form::of(data, self.sources) {
            Form::Boolean
            | Form::Number { .. }
            | Form::Whole { .. }
            | Form::Text
            | Form::Letter
            | Form::Address(_) => true,
            Form::List(inner) | Form::Map(inner) | Form::Repeated { element: inner, .. } => {
                self.is_visible(&inner, around)
            }
            Form::Several(parts) => parts.iter().all(|part| self.is_visible(part, around)),
            Form::Fields { children, .. } => self.are_visible(&children, around),
            Form::Variants(variants) => variants.iter().all(|variant| match &variant.content {
                Content::Nothing => true,
                Content::One(data) => self.is_visible(data, around),
                Content::Several(parts) => parts.iter().all(|part| self.is_visible(part, around)),
                Content::Fields(children) => self.are_visible(children, around),
                Content::Unknown => false,
            }),
            Form::Unknown => false,
        }
    }

    fn are_visible(&mut self, children: &Children<'_>, around: &[&str]) -> bool {
        match children {
            Children::Any(data) => self.is_visible(data, around),
            Children::Named(children) => children.values().all(|child| match &child.expected {
                Expected::Value(data) => self.is_visible(data, around),
                Expected::Tree(_) => false,
            }),
        }
    }
}
