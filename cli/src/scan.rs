//! Stage ②: node files by themselves, and the names that they use.
//!
//! A node is found as rustc would find it: through the `mod` lines of its crate, beginning in `lib.rs`. What its file says
//! is read with the crate `grammar`, by which the macro `#[context]` reads it, too. Whether other nodes agree with it is
//! the matter of [`crate::resolve`].
//!
//! Invariant: a file is parsed once for each text that it has, and only if a node or one of its names leads there, or it belongs to the crate of a
//! target's hardware.

mod beyond;
mod brackets;
pub mod compare;
pub mod components;
mod conditional;
mod depth;
pub mod failure;
pub mod fields;
#[cfg(test)]
pub(crate) mod fixture;
pub mod library;
pub(crate) mod lookup;
pub mod module;
pub mod nalgebra;
mod node;
pub mod nondeterminism;
mod public;
pub mod sendable;
pub mod served;
mod state;
mod syntax;
pub mod traits;
pub mod types;
mod unlisted;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use camino::{Utf8Component, Utf8Path};
use proc_macro2::Span;
use syn::{Attribute, Expr, ExprLit, Lit, Meta};

use crate::diagnostics::{Code, Diagnostic, Diagnostics, Reported};
use crate::manifest::Manifest;
use crate::workspace::{BrokenPackage, MANIFEST, Workspace, says_generated};

pub use library::Library;
use library::NotFound;
pub use node::NodeSource;
pub use state::StateSource;
pub(crate) use state::derives;
pub(crate) use syntax::parse;

/// Every node of the manifest, and the crates of the workspace that names lead to.
#[derive(Debug)]
pub struct Sources<'workspace> {
    /// By node path; a node that stands in several cyclers is scanned once.
    pub nodes: BTreeMap<String, NodeSource>,
    pub library: Library<'workspace>,
}

/// Reads every node that the manifest names.
///
/// # Errors
/// `unknown-node`, `not-public`, `syntax`, `missing-context`, `missing-node`, `missing-derive` and everything that
/// `grammar` calls a mistake.
pub fn scan<'workspace>(
    workspace: &'workspace Workspace,
    manifest: &Manifest,
    diagnostics: &mut Diagnostics,
) -> Result<Sources<'workspace>, Reported> {
    workspace.begin_parsing();
    let library = Library::new(workspace, &manifest.robot.generated);
    let file = Utf8Path::new(MANIFEST);
    let (mut nodes, mut unread) = (BTreeMap::new(), Diagnostics::new());
    let mut private = BTreeSet::new();
    let is_broken = broken_packages(workspace, manifest).next().is_some();
    for entry in manifest.cyclers.iter().flat_map(|cycler| &cycler.nodes) {
        let path = entry.path.as_str();
        if nodes.contains_key(path) {
            continue;
        }
        let node = match library.find_module(path) {
            Ok(module) => node::scan(&library, path, module, diagnostics),
            Err(error) => {
                let is_told = match &error {
                    NotFound::Told => true,
                    // It may be the crate of a Cargo.toml that says nothing.
                    NotFound::Library { .. } => is_broken,
                    NotFound::Private { parent, name, .. } => {
                        !private.insert((parent.path.clone(), name.clone()))
                    }
                    NotFound::Item { .. } | NotFound::Module { .. } | NotFound::Several { .. } => {
                        false
                    }
                };
                let found = match is_told {
                    true => &mut unread,
                    false => &mut *diagnostics,
                };
                found.add(error.describe(path, file, &entry.range));
                None
            }
        };
        if let Some(node) = node {
            nodes.insert(path.to_owned(), node);
        }
    }
    report_broken_packages(workspace, manifest, diagnostics);
    library.report_problems(diagnostics);
    // What is wrong with a file is told once, where it is wrong, and not by each of its nodes.
    if !diagnostics.has_errors() {
        diagnostics.extend(unread);
    }
    diagnostics.stop_at_errors()?;
    Ok(Sources { nodes, library })
}

/// The bytes of a span in its file.
pub fn range(span: Span) -> Range<usize> {
    span.byte_range()
}

/// The text of a `///` or `//!`, if this attribute is one.
pub(crate) fn doc(attribute: &Attribute) -> Option<String> {
    match &attribute.meta {
        Meta::NameValue(meta) if meta.path.is_ident("doc") => match &meta.value {
            Expr::Lit(ExprLit {
                lit: Lit::Str(text),
                ..
            }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    }
}

/// A Cargo.toml that cannot be read hides the nodes of its package; only a generated crate's does not matter.
fn report_broken_packages(
    workspace: &Workspace,
    manifest: &Manifest,
    diagnostics: &mut Diagnostics,
) {
    for broken in broken_packages(workspace, manifest) {
        let error = Diagnostic::new(Code::Syntax, broken.message.clone());
        diagnostics.add(error.at(&broken.file, broken.range.clone(), ""));
    }
}

fn broken_packages<'w>(
    workspace: &'w Workspace,
    manifest: &Manifest,
) -> impl Iterator<Item = &'w BrokenPackage> {
    let all = workspace.members().broken.iter();
    all.filter(|broken| !is_generated(workspace, manifest, &broken.file))
}

/// Whether this is the Cargo.toml of the robot's crate, of a partial robot's or of a neighbour's in the same workspace,
/// which may be missing or say anything.
fn is_generated(workspace: &Workspace, manifest: &Manifest, file: &Utf8Path) -> bool {
    let generated = &manifest.robot.generated;
    let is_named_so = || file.as_str().starts_with(&format!("{generated}-"));
    file.starts_with(generated)
        || match workspace.read(file) {
            Ok(text) => says_generated(&text),
            Err(error) => error.missing && (is_named_so() || is_of_a_neighbour(workspace, file)),
        }
}

/// Whether a robot other than this one may write the file.
pub(crate) fn is_of_a_neighbour(workspace: &Workspace, file: &Utf8Path) -> bool {
    let mut above = file.ancestors().skip(2);
    above.any(|folder| {
        folder.components().next() == Some(Utf8Component::ParentDir)
            && workspace.is_file(&folder.join("hulk.toml"))
    })
}

#[cfg(test)]
mod tests;
