//! Lines that still name a module which is deleted.

use std::collections::BTreeSet;

use camino::{Utf8Path, Utf8PathBuf};
use syn::UseTree;
use syn::spanned::Spanned as _;
use syn::visit::{self, Visit};

use crate::diagnostics::position;
use crate::scan::range;
use crate::workspace::{Member, Origin, Workspace};

/// Files and lines of the workspace in which a `use` or a path leads to the module; generated files are none of them.
pub fn still_named(
    workspace: &Workspace,
    generated: &Utf8Path,
    module: &str,
) -> BTreeSet<(Utf8PathBuf, usize)> {
    let target: Vec<&str> = module.split("::").collect();
    let mut found = BTreeSet::new();
    for member in workspace.members().libraries() {
        if member.folder == generated {
            continue;
        }
        for file in workspace.files_below(&member.folder) {
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
            let lines = search.found.into_iter();
            found.extend(lines.map(|byte| (file.clone(), position(&text, byte).line)));
        }
    }
    found
}

/// The module that a file of the library usually is; `None` for programs, tests and examples, which name it by the library.
fn module_of(member: &Member, file: &Utf8Path) -> Option<Vec<String>> {
    let inside = file.strip_prefix(member.root_file.parent()?).ok()?;
    let mut names = vec![member.library.clone()];
    if file != member.root_file {
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
mod tests {
    use super::*;

    #[test]
    fn what_names_the_module_is_found_wherever_it_stands() {
        let package = |name: &str, needs: &str| {
            format!("[package]\nname = \"{name}\"\n[dependencies]\n{needs}")
        };
        let files = [
            (
                "Cargo.toml",
                "[workspace]\nmembers = [\"nodes\", \"tools\", \"generated\"]".to_owned(),
            ),
            ("nodes/Cargo.toml", package("nodes", "")),
            (
                "nodes/src/lib.rs",
                "pub mod control;\npub use control::gone::Gone;\nmod gone {}\n".to_owned(),
            ),
            (
                "nodes/src/control.rs",
                "pub mod other;\n\npub use gone::Gone;\nfn f() -> gone::Gone { g(gone) }\n"
                    .to_owned(),
            ),
            (
                "nodes/src/control/other.rs",
                "use super::{\n    gone::Gone,\n    other,\n};\nuse crate::gone::Gone;\n\
                 mod tests {\n    use super::super::gone;\n    use super::gone;\n}\n"
                    .to_owned(),
            ),
            (
                "nodes/tests/all.rs",
                "use crate::control::gone;\nuse nodes::control::gone as x;\n".to_owned(),
            ),
            (
                "tools/Cargo.toml",
                package(
                    "tools",
                    "brain = { package = \"nodes\", path = \"../nodes\" }",
                ),
            ),
            (
                "tools/src/lib.rs",
                "use brain::control::gone::*;\nuse brain::control::*;\n".to_owned(),
            ),
            ("generated/Cargo.toml", package("generated", "")),
            (
                "generated/src/lib.rs",
                "use nodes::control::gone;".to_owned(),
            ),
        ];
        let files = files.map(|(file, text)| (Utf8PathBuf::from(file), text));
        let workspace = Workspace::in_memory(files);
        let found = still_named(
            &workspace,
            Utf8Path::new("generated"),
            "nodes::control::gone",
        );
        let found: Vec<String> = found
            .iter()
            .map(|(file, line)| format!("{file}:{line}"))
            .collect();
        assert_eq!(
            found,
            [
                "nodes/src/control/other.rs:2",
                "nodes/src/control/other.rs:7",
                "nodes/src/control.rs:3",
                "nodes/src/control.rs:4",
                "nodes/src/lib.rs:2",
                "nodes/tests/all.rs:2",
                "tools/src/lib.rs:1",
            ]
        );
    }
}
