//! Node files that the manifest does not name: only looked at to say which of them would help.

use std::collections::BTreeSet;
use std::rc::Rc;

use grammar::{AnyContext, CycleField, OutputField};
use syn::Item;

use super::module::Module;
use super::traits::Bound;
use super::{Sources, node};
use crate::diagnostics::Diagnostics;

/// A node that stands in no cycler.
#[derive(Debug)]
pub struct Unlisted {
    /// As the manifest would name it.
    pub path: String,
    /// It gives the capture time or reads from the hardware in its cycle, as setup nodes do.
    pub is_setup: bool,
}

impl Sources<'_> {
    /// A node that writes this main output and stands in no cycler; searched in the crates of the robot's nodes.
    pub fn unlisted_writer(&self, output: &str) -> Option<Unlisted> {
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
                return Some(Unlisted {
                    path: module.path.clone(),
                    is_setup: self.is_setup(&module),
                });
            }
            let names = module
                .module_names()
                .filter_map(|name| self.library.declared(&module, name));
            waiting.extend(names);
        }
        None
    }

    fn is_setup(&self, module: &Rc<Module>) -> bool {
        let library = &self.library;
        let scan = || {
            node::scan(
                library,
                &module.path,
                module.clone(),
                &mut Diagnostics::new(),
            )
        };
        let Some(source) = library.quietly(scan) else {
            return false;
        };
        let mut outputs = source.outputs.fields.iter();
        let mut bounds = source.signatures.cycle.bounds.iter();
        let is_reading = |bound| match library.hardware_trait(module, bound) {
            Bound::Trait(found) => found.interface.reading == Some(true),
            _ => false,
        };
        outputs.any(|field| matches!(field.kind, OutputField::CaptureTime))
            || library.quietly(|| bounds.any(is_reading))
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
