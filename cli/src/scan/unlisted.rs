//! Node files that the manifest does not name: only looked at to say which of them would help.

use std::collections::BTreeSet;
use std::rc::Rc;

use grammar::{AnyContext, CycleField, OutputField};
use syn::Item;

use super::Sources;
use super::module::Module;

impl Sources<'_> {
    /// Path of a node that writes this main output and stands in no cycler; searched in the crates of the robot's
    /// nodes.
    pub fn unlisted_writer(&self, output: &str) -> Option<String> {
        let libraries: BTreeSet<&str> = self
            .nodes
            .values()
            .map(|node| node.module.library())
            .collect();
        let mut waiting: Vec<Rc<Module>> = libraries
            .into_iter()
            .filter_map(|library| self.library.root(library))
            .collect();
        while let Some(module) = waiting.pop() {
            if !self.nodes.contains_key(&module.path) && writes(&module, output) {
                return Some(module.path.clone());
            }
            let names = module
                .module_names()
                .filter_map(|name| self.library.declared(&module, name));
            waiting.extend(names);
        }
        None
    }
}

fn writes(module: &Module, output: &str) -> bool {
    module.syntax.items.iter().any(|item| {
        let Item::Struct(item) = item else {
            return false;
        };
        match grammar::parse_context(item) {
            Some((AnyContext::MainOutputs(outputs), _)) => outputs.fields.iter().any(|field| {
                matches!(field.kind, OutputField::MainOutput(_)) && field.name == output
            }),
            Some((AnyContext::Cycle(cycle), _)) => cycle.fields.iter().any(|field| {
                matches!(field.kind, CycleField::MainOutput(_)) && field.name == output
            }),
            _ => false,
        }
    })
}
