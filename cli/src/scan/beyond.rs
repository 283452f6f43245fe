//! Names that come by a glob out of the workspace: `use nalgebra::*`.
//!
//! Invariant: a name is only said to come from a place that is the one possible; between two, nobody but rustc can tell.

use std::collections::BTreeSet;
use std::rc::Rc;

use proc_macro2::{TokenStream, TokenTree};
use syn::Item;

use super::library::Library;
use super::lookup::{Found, is_prelude};
use super::module::{Entry, Module};

/// `use` may lead in circles; no honest path is longer.
const DEEPEST: usize = 32;

/// What the framework offers at its root, where it is no member of the workspace.
pub(super) const OF_FRAMEWORK: &str = "\
    Access AdditionalOutput AdditionalSlot Answerer Body Call CallAny Caller CaptureTime Clear Clock Condition \
    Consumer CountingAllocator Cycle CycleTime Cycler CyclerState Data Digest Entry Error Event Feed FeedCounts \
    Finished Free Given Granted Guarded Hardware HardwareContext HardwareInterface Held Histogram HistoricInput History \
    Horizon InNode InPlace Inject Injected Injection InjectionCell InjectionTable Injector Input Instance \
    InstanceDescription InstanceLink InstanceReport Interleaved Interleaving Item Kind Lane Latest LatestInput \
    Leased Link LiveParameters Lockstep MainOutput NoEvent NodeReport NodeState OnFailure OutputKind OutputVisitor \
    Parameter ParameterData Past Paused Pending PendingAny PerceptionInput Policy Pool PreviousInput Procedure \
    Projection Queue QueueCounts QueueReport ReadState Reader Rearm Record Reference ReferenceKind Reflect Refused \
    Remote RequiredInput Restarted Result Robot RobotReport RollBack SafeState Scheduling Series Slots Start State \
    Stop Stopped Stored Stub Subscriptions Swap Tap Tapped Target Threads Timeline Timestamp Together View Waited \
    Writer blocking buffer buffer_of bytes clear clock context cycler data digest driver error foxglove guarded \
    hardware history injection interleave launch link logs math numerics parameters pool procedure rearm recorded \
    reflect remote replay report robot scenario scheduling stop stub subscriptions tap temporal testing time \
    timing tool world \
";

impl Library<'_> {
    /// What a path stands for that leads nowhere in the workspace.
    pub(super) fn beyond(
        &self,
        module: &Rc<Module>,
        segments: &[String],
        absolute: bool,
        depth: usize,
    ) -> Option<Found> {
        if depth > DEEPEST {
            return None;
        }
        let ends = (1..segments.len()).rev();
        let front = ends
            .filter_map(
                |end| match self.follow(module, &segments[..end], absolute, 0)? {
                    Found::Module(front) => Some((front, &segments[end..])),
                    _ => None,
                },
            )
            .next();
        let (front, rest) = match front {
            Some(front) => front,
            None if absolute => return None,
            None => (module.clone(), segments),
        };
        let (name, behind) = rest.split_first()?;
        if is_prelude(name) || matches!(name.as_str(), "Self" | "crate" | "self" | "super") {
            return None;
        }
        let mut path = match front.entries.get(name) {
            Some(Entry::Import(import)) => {
                let mut whole = import.segments.clone();
                whole.extend_from_slice(behind);
                let itself = import.segments.first() == Some(name);
                return self.beyond(&front, &whole, import.absolute || itself, depth + 1);
            }
            Some(_) => return None,
            None => self.only_source(&front, module, name)?,
        };
        let rest = rest.iter().cloned();
        match &mut path {
            Found::Standard(path) | Found::Foreign(path) => path.extend(rest),
            _ => return None,
        }
        Some(path)
    }

    /// The one place outside of the workspace from which the globs of a module can bring the name in.
    fn only_source(&self, module: &Rc<Module>, from: &Module, name: &str) -> Option<Found> {
        let mut sources = Vec::new();
        let mut seen = BTreeSet::new();
        self.sources(module, (from, name), &mut seen, &mut sources)?;
        sources.retain(|source| match source {
            Found::Foreign(path) if path.len() == 1 && path[0] == "framework" => {
                OF_FRAMEWORK.split_whitespace().any(|one| one == name)
            }
            _ => true,
        });
        let first = sources.pop()?;
        sources
            .iter()
            .all(|other| other.is(&first))
            .then_some(first)
    }

    /// `None`: the name is in the workspace, or a macro may define it there.
    fn sources(
        &self,
        module: &Rc<Module>,
        (from, name): (&Module, &str),
        seen: &mut BTreeSet<String>,
        found: &mut Vec<Found>,
    ) -> Option<()> {
        if !seen.insert(module.path.clone()) {
            return Some(());
        }
        let is_there = module.entries.contains_key(name) || self.unlisted(module, name).is_some();
        if is_there || may_make(module, name) {
            return None;
        }
        let globs = module.globs.iter();
        for glob in globs.filter(|glob| glob.visible.reaches(from, module)) {
            match self.follow_import(module, glob) {
                Some(Found::Module(target)) => {
                    self.sources(&target, (module, name), seen, found)?;
                }
                Some(source @ (Found::Standard(_) | Found::Foreign(_))) => found.push(source),
                _ => {}
            }
        }
        Some(())
    }
}

/// Whether a macro of the module may define the name: it stands in its call, or what is included is not to be seen.
pub(super) fn may_make(module: &Module, name: &str) -> bool {
    module.syntax.items.iter().any(|item| makes(item, name))
}

/// Whether this is a call of a macro that may define the name.
pub(super) fn makes(item: &Item, name: &str) -> bool {
    match item {
        Item::Macro(call) if call.ident.is_none() => {
            call.mac.path.is_ident("include") || stands_in(call.mac.tokens.clone(), name)
        }
        _ => false,
    }
}

pub(super) fn stands_in(tokens: TokenStream, name: &str) -> bool {
    tokens.into_iter().any(|token| match token {
        TokenTree::Ident(ident) => ident == name,
        TokenTree::Group(group) => stands_in(group.stream(), name),
        _ => false,
    })
}

#[cfg(test)]
mod tests;
