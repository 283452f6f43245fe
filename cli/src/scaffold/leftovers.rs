//! Lines that still name a module which is deleted.

use std::collections::{BTreeMap, BTreeSet};

use camino::{Utf8Path, Utf8PathBuf};
use syn::UseTree;
use syn::spanned::Spanned as _;
use syn::visit::{self, Visit};

use crate::diagnostics::position;
use crate::manifest::without_dots;
use crate::scan::range;
use crate::workspace::{Member, Origin, Workspace, says_generated};

/// How the header of a generated Cargo.toml names the command that writes the crate, where that is not the usual one.
const COMMAND: (&str, &str) = ("# The command is `", "`.");

/// What names the module although it is gone; nothing of the robot's own generated crate, which was written anew.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Leftovers {
    /// Files and lines that people wrote.
    pub lines: BTreeSet<(Utf8PathBuf, usize)>,
    /// Folders of other generated crates, with the command that writes each if its header says one.
    pub generated: BTreeMap<Utf8PathBuf, Option<String>>,
}

/// Finds in the workspace where a `use` or a path leads to the module.
pub fn still_named(workspace: &Workspace, generated: &Utf8Path, module: &str) -> Leftovers {
    let target: Vec<&str> = module.split("::").collect();
    let mut leftovers = Leftovers::default();
    for member in workspace.members().libraries() {
        if member.folder == generated {
            continue;
        }
        for file in workspace.files_below(&without_dots(&member.folder)) {
            if file.extension() != Some("rs") || file.starts_with(generated) {
                continue;
            }
            let Ok(text) = workspace.read(&file) else {
                continue;
            };
            let Ok(syntax) = syn::parse_file(&text) else {
                continue;
            };
            let mut search = Search {
                member,
                module: module_of(member, &file),
                target: &target,
                found: Vec::new(),
            };
            search.visit_file(&syntax);
            let found = search.found;
            if found.is_empty() {
                continue;
            }
            if let Some((folder, command)) = generated_crate(workspace, &file) {
                leftovers.generated.insert(folder, command);
                continue;
            }
            let lines = found.into_iter();
            let lines = lines.map(|byte| (file.clone(), position(&text, byte).line));
            leftovers.lines.extend(lines);
        }
    }
    leftovers
}

/// Whether a `use` or a path of a file leads to the module.
pub(super) fn names(
    workspace: &Workspace,
    file: &Utf8Path,
    syntax: &syn::File,
    module: &str,
) -> bool {
    let target: Vec<&str> = module.split("::").collect();
    let members = workspace.members().libraries();
    let around = members.filter(|member| file.starts_with(without_dots(&member.folder)));
    // A crate may lie in another one's folder.
    let Some(member) = around.max_by_key(|member| member.folder.components().count()) else {
        return false;
    };
    let mut search = Search {
        member,
        module: module_of(member, file),
        target: &target,
        found: Vec::new(),
    };
    search.visit_file(syntax);
    !search.found.is_empty()
}

/// The folder of the generated crate that a file is of, such as a partial robot's, and the command in its header.
fn generated_crate(
    workspace: &Workspace,
    file: &Utf8Path,
) -> Option<(Utf8PathBuf, Option<String>)> {
    let mut above = file.ancestors().skip(1);
    let folder = above.find(|folder| workspace.is_file(&folder.join("Cargo.toml")))?;
    let text = workspace.read(&folder.join("Cargo.toml")).ok()?;
    let (before, behind) = COMMAND;
    let command = |line: &str| Some(line.strip_prefix(before)?.strip_suffix(behind)?.to_owned());
    says_generated(&text).then(|| (folder.to_owned(), text.lines().find_map(command)))
}

/// The module that a file of the library usually is; `None` for programs, tests and examples, which name it by the library.
fn module_of(member: &Member, file: &Utf8Path) -> Option<Vec<String>> {
    let root_file = without_dots(&member.root_file);
    let inside = file.strip_prefix(root_file.parent()?).ok()?;
    let mut names = vec![member.library.clone()];
    if file != root_file {
        let parts = inside.with_extension("");
        names.extend(parts.components().map(|part| part.as_str().to_owned()));
        names.pop_if(|last| last == "mod");
    }
    Some(names)
}

struct Search<'a> {
    member: &'a Member,
    module: Option<Vec<String>>,
    target: &'a [&'a str],
    /// First bytes of what names it.
    found: Vec<usize>,
}

impl Search<'_> {
    /// Whether a path leads to the module or below it.
    fn leads_there(&self, names: &[String], is_absolute: bool) -> bool {
        let Some((first, rest)) = names.split_first() else {
            return false;
        };
        let inside = |depth: usize, rest: &[String]| {
            let module = self.module.as_deref().unwrap_or_default();
            let front = module.get(..depth).filter(|front| !front.is_empty());
            front.is_some_and(|front| self.is_target(front.iter().chain(rest)))
        };
        let depth = self.module.as_ref().map_or(0, Vec::len);
        let ups = names.iter().take_while(|name| *name == "super").count();
        match first.as_str() {
            "crate" => inside(1, rest),
            "super" => inside(depth.saturating_sub(ups), &names[ups..]),
            "self" => inside(depth, rest),
            _ if !is_absolute && inside(depth, names) => true,
            _ => {
                let library = match self.member.dependency(first) {
                    Some(Origin::Member(library)) => library,
                    _ => first,
                };
                self.is_target([library.to_owned()].iter().chain(rest))
            }
        }
    }

    fn is_target<'n>(&self, names: impl Iterator<Item = &'n String>) -> bool {
        let names: Vec<&str> = names.map(String::as_str).collect();
        names.starts_with(self.target)
    }

    fn tree(&mut self, before: &[String], is_absolute: bool, tree: &UseTree) {
        let (name, below) = match tree {
            UseTree::Path(path) => (&path.ident, Some(&*path.tree)),
            UseTree::Name(name) => (&name.ident, None),
            UseTree::Rename(rename) => (&rename.ident, None),
            UseTree::Glob(_) => return,
            UseTree::Group(group) => {
                for tree in &group.items {
                    self.tree(before, is_absolute, tree);
                }
                return;
            }
        };
        let names: Vec<String> = before.iter().cloned().chain([name.to_string()]).collect();
        if self.leads_there(&names, is_absolute) {
            self.found.push(range(name.span()).start);
        } else if let Some(below) = below {
            self.tree(&names, is_absolute, below);
        }
    }
}

impl<'ast> Visit<'ast> for Search<'_> {
    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        self.tree(&[], item.leading_colon.is_some(), &item.tree);
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        let outer = self.module.clone();
        self.module
            .iter_mut()
            .for_each(|module| module.push(item.ident.to_string()));
        visit::visit_item_mod(self, item);
        self.module = outer;
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names = path.segments.iter().map(|one| one.ident.to_string());
        let names: Vec<String> = names.collect();
        // One name alone is no module.
        if names.len() > 1 && self.leads_there(&names, path.leading_colon.is_some()) {
            self.found.push(range(path.span()).start);
        }
        visit::visit_path(self, path);
    }
}

#[cfg(test)]
mod tests;
