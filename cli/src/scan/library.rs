//! Crates of the workspace: their modules, parsed when a name leads there.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use syn::ext::IdentExt;
use syn::{Item, ItemMod};

use super::brackets::unbalanced;
use super::conditional::{conditional_path, has_conditional_path, named_path};
use super::depth::too_deep;
use super::module::{Entry, Module, Visible, attributes, folder_of, is_conditional};
use super::range;
use super::syntax;
use super::types::Resolved;
use crate::diagnostics::{Code, Diagnostic, Diagnostics, listed, nearest};
use crate::workspace::{Member, Workspace};

/// Modules of the workspace's crates, by absolute path.
#[derive(Debug)]
pub struct Library<'workspace> {
    workspace: &'workspace Workspace,
    /// Folder of the generated crate, which is never read.
    generated: Utf8PathBuf,
    modules: RefCell<BTreeMap<String, Option<Rc<Module>>>>,
    /// Files that cannot be read or parsed.
    problems: RefCell<Vec<Diagnostic>>,
    /// Public paths of items whose definition is not public, and whether a condition decides about them.
    pub(super) public_paths: RefCell<BTreeMap<String, Option<(String, bool)>>>,
    /// What aliases without parameters stand for.
    pub(super) aliases: RefCell<BTreeMap<String, Resolved>>,
    /// Where the globs of a module lead.
    pub(super) glob_targets: RefCell<BTreeMap<String, Globs>>,
    /// Names that are being looked for right now, with their modules: globs may lead in circles.
    pub(super) searching: RefCell<BTreeSet<(String, String)>>,
}

/// The modules of the workspace that a module's globs name, and who sees what comes by them.
pub(super) type Globs = Rc<Vec<(Rc<Module>, Visible)>>;

/// Why a node path leads nowhere.
#[derive(Debug)]
pub(super) enum NotFound {
    Library {
        libraries: Vec<String>,
    },
    /// A module is not declared in its parent; `file`: a file is there all the same.
    Module {
        parent: Rc<Module>,
        name: String,
        file: Option<Utf8PathBuf>,
    },
    Private {
        parent: Rc<Module>,
        name: String,
        range: Range<usize>,
        /// A `use` brings it in.
        imported: bool,
    },
    /// What stands there is no module.
    Item {
        parent: Rc<Module>,
        name: String,
    },
    /// Several items have this name, and conditions choose from them.
    Several {
        parent: Rc<Module>,
        name: String,
    },
    /// The declaration is there, the file is not, or it cannot be parsed, or a Cargo.toml cannot be read, which may be
    /// that of the node's crate: that is told as a problem.
    Told,
}

impl<'workspace> Library<'workspace> {
    pub(super) fn new(workspace: &'workspace Workspace, generated: &Utf8Path) -> Self {
        Self {
            workspace,
            generated: generated.to_owned(),
            modules: RefCell::default(),
            problems: RefCell::default(),
            public_paths: RefCell::default(),
            aliases: RefCell::default(),
            glob_targets: RefCell::default(),
            searching: RefCell::default(),
        }
    }

    /// The package whose library has this name; never the generated one.
    pub fn member(&self, library: &str) -> Option<&'workspace Member> {
        let member = self.workspace.members().library(library);
        member.filter(|member| member.folder != self.generated)
    }

    /// The hardware of a target with its crate called by the name of its library.
    pub fn by_library(&self, path: &str) -> String {
        self.workspace.members().by_library(path)
    }

    /// Whether a path outside of the workspace is of a crate that may depend on members.
    pub(super) fn may_know_members(&self, path: &str) -> bool {
        let library = path.split("::").next().unwrap_or_default();
        self.workspace.members().lies_beside(library)
    }

    /// Adds what could not be read or parsed since the last call.
    pub fn report_problems(&self, diagnostics: &mut Diagnostics) {
        for problem in self.problems.take() {
            diagnostics.add(problem);
        }
    }

    /// Reads on without telling what cannot be read or parsed: what does not matter for the robot is left to rustc.
    pub(super) fn quietly<T>(&self, look: impl FnOnce() -> T) -> T {
        let told = self.problems.take();
        let known: BTreeSet<String> = self.modules.borrow().keys().cloned().collect();
        let answer = look();
        self.problems.replace(told);
        // Who asks again for what could not be read shall hear why.
        let mut modules = self.modules.borrow_mut();
        let before = modules.len();
        modules.retain(|path, module| module.is_some() || known.contains(path));
        if modules.len() < before {
            self.public_paths.take();
            self.aliases.take();
            self.glob_targets.take();
        }
        drop(modules);
        answer
    }

    /// The module of a node, as public as generated code needs it.
    pub(super) fn find_module(&self, path: &str) -> Result<Rc<Module>, NotFound> {
        let mut names = path.split("::");
        let library = names.next().unwrap_or_default();
        if self.member(library).is_none() {
            let members = self.workspace.members().libraries();
            let libraries = members.map(|member| member.library.clone()).collect();
            return Err(NotFound::Library { libraries });
        }
        let mut module = self.root(library).ok_or(NotFound::Told)?;
        for name in names {
            module = self.find_child(&module, name)?;
        }
        Ok(module)
    }

    fn find_child(&self, parent: &Rc<Module>, name: &str) -> Result<Rc<Module>, NotFound> {
        let Some(entry) = parent.entries.get(name) else {
            if let Some(module) = self.module_in(parent, name)
                && !self.is_hidden(parent, name)
            {
                return Ok(module);
            }
            let file = candidates(&parent.folder, name);
            let file = file.into_iter().find(|file| self.workspace.is_file(file));
            let name = name.to_owned();
            return Err(NotFound::Module {
                parent: parent.clone(),
                name,
                file,
            });
        };
        let private = match entry {
            Entry::Item { index, .. } if !entry.is_public() => match parent.item(*index) {
                Item::Mod(item) => Some(item.ident.span()),
                _ => None,
            },
            // The name alone may be that of a function or macro.
            Entry::Import(_) if self.is_hidden(parent, name) => {
                let is_module = self.module_in(parent, name).is_some();
                is_module.then(|| parent.import_span(name)).flatten()
            }
            _ => None,
        };
        if let Some(span) = private {
            return Err(NotFound::Private {
                parent: parent.clone(),
                name: name.to_owned(),
                range: range(span),
                imported: matches!(entry, Entry::Import(_)),
            });
        }
        if matches!(entry, Entry::Ambiguous) {
            return Err(NotFound::Several {
                parent: parent.clone(),
                name: name.to_owned(),
            });
        }
        match self.item_in(parent, name) {
            Some(_) => Err(NotFound::Item {
                parent: parent.clone(),
                name: name.to_owned(),
            }),
            None => self.module_in(parent, name).ok_or(NotFound::Told),
        }
    }

    /// The root module of a member.
    pub(super) fn root(&self, library: &str) -> Option<Rc<Module>> {
        let member = self.member(library)?;
        self.cached(library, || {
            let folder = folder_of(&member.root_file, true);
            self.parse(library.to_owned(), member.root_file.clone(), folder)
        })
    }

    /// Whether a `#[cfg(…)]` stands at a module or at one around it.
    pub fn is_conditional(&self, module: &Module) -> bool {
        let Some((parent, name)) = module.path.rsplit_once("::") else {
            return is_conditional(&module.syntax.attrs);
        };
        let Some(parent) = self.module(parent) else {
            return false;
        };
        let declaration = match parent.entries.get(name) {
            Some(Entry::Item { index, .. }) => attributes(parent.item(*index)),
            _ => &[],
        };
        is_conditional(declaration)
            || has_conditional_path(declaration)
            || is_conditional(&module.syntax.attrs)
            || self.is_conditional(&parent)
    }

    /// A module of a member by its absolute path.
    pub(super) fn module(&self, path: &str) -> Option<Rc<Module>> {
        match path.rsplit_once("::") {
            None => self.root(path),
            Some((parent, name)) => self.declared(&*self.module(parent)?, name),
        }
    }

    /// A module that is declared right in another.
    pub(super) fn declared(&self, parent: &Module, name: &str) -> Option<Rc<Module>> {
        let Entry::Item { index, .. } = parent.entries.get(name)? else {
            return None;
        };
        let Item::Mod(item) = parent.item(*index) else {
            return None;
        };
        let path = format!("{}::{name}", parent.path);
        self.cached(&path, || self.load(parent, item, path.clone()))
    }

    fn cached(&self, path: &str, load: impl FnOnce() -> Option<Rc<Module>>) -> Option<Rc<Module>> {
        if let Some(module) = self.modules.borrow().get(path) {
            return module.clone();
        }
        let module = load();
        self.modules
            .borrow_mut()
            .insert(path.to_owned(), module.clone());
        module
    }

    fn load(&self, parent: &Module, item: &ItemMod, path: String) -> Option<Rc<Module>> {
        if let Some((_, items)) = &item.content {
            let syntax = syn::File {
                shebang: None,
                attrs: item.attrs.clone(),
                items: items.clone(),
            };
            let folder = match path_attribute(item) {
                Some(named) => base(parent).join(named),
                None => parent.folder.join(item.ident.unraw().to_string()),
            };
            let mut module = Module::new(path, parent.file.clone(), folder, Rc::new(syntax));
            module.inline = true;
            return Some(Rc::new(module));
        }
        let files = places(base(parent), &parent.folder, item);
        let Some(file) = files.iter().find(|file| self.workspace.is_file(file)) else {
            let message = format!("the file of module `{path}` does not exist");
            let places: Vec<&str> = files.iter().map(|file| file.as_str()).collect();
            let problem = Diagnostic::new(Code::UnknownNode, message)
                .at(&parent.file, range(item.ident.span()), "declared here")
                .help(format!(
                    "create `{}` or remove this line",
                    places.join("` or `")
                ));
            self.problems.borrow_mut().push(problem);
            return None;
        };
        if self.is_inside(&parent.path, file) {
            let message = format!("the module `{path}` would contain itself");
            let problem = Diagnostic::new(Code::Syntax, message)
                .at(
                    &parent.file,
                    range(item.ident.span()),
                    format!("`{file}` is read already"),
                )
                .help("remove this line, or let it name another file");
            self.problems.borrow_mut().push(problem);
            return None;
        }
        let folder = folder_of(file, path_attribute(item).is_some());
        self.parse(path, file.clone(), folder)
    }

    /// What the file of a declared module says, without parsing it.
    pub(super) fn text(&self, parent: &Module, item: &ItemMod) -> Option<Arc<str>> {
        let mut files = places(base(parent), &parent.folder, item).into_iter();
        let file = files.find(|file| self.workspace.is_file(file))?;
        self.workspace.read(&file).ok()
    }

    /// Whether a module or one around it is read from this file.
    fn is_inside(&self, module: &str, file: &Utf8Path) -> bool {
        let ways = std::iter::successors(Some(module), |path| {
            path.rsplit_once("::").map(|(parent, _)| parent)
        });
        let modules = self.modules.borrow();
        let around = ways.filter_map(|path| modules.get(path)?.as_ref());
        around
            .map(|module| &module.file)
            .any(|other| self.workspace.is_same_file(other, file))
    }

    fn parse(&self, path: String, file: Utf8PathBuf, folder: Utf8PathBuf) -> Option<Rc<Module>> {
        let problem = |message: String| Diagnostic::new(Code::Syntax, message);
        let text = match self.workspace.read(&file) {
            Ok(text) => text,
            Err(error) => {
                let problem = problem(error.to_string()).at(&file, 0..0, "");
                self.problems.borrow_mut().push(problem);
                return None;
            }
        };
        if let Some(syntax) = self.workspace.parsed(&file, &text) {
            return Some(Rc::new(Module::new(path, file, folder, syntax)));
        }
        if let Some(place) = too_deep(&text) {
            let problem = problem("this is nested too deeply".to_owned())
                .at(&file, range(place), "from here on")
                .help("split it: hulkgen reads at most 500 brackets, operators and generics around one another");
            self.problems.borrow_mut().push(problem);
            return None;
        }
        match syntax::parse(&text) {
            Ok(syntax) => {
                let syntax = Rc::new(syntax);
                self.workspace.keep_parsed(&file, &text, &syntax);
                Some(Rc::new(Module::new(path, file, folder, syntax)))
            }
            Err(error) => {
                let problem = match unbalanced(&text) {
                    Some(found) => found.describe(&file, &text),
                    None => problem(error.to_string()).at(&file, range(error.span()), ""),
                };
                self.problems.borrow_mut().push(problem);
                None
            }
        }
    }
}

impl NotFound {
    /// The diagnostic at a line of the manifest.
    pub(super) fn describe(&self, path: &str, file: &Utf8Path, place: &Range<usize>) -> Diagnostic {
        let unknown = |message: String| Diagnostic::new(Code::UnknownNode, message);
        match self {
            Self::Library { libraries } => {
                let library = path.split("::").next().unwrap_or_default();
                let help = match nearest(library, libraries.iter().map(String::as_str)) {
                    Some(near) => format!("did you mean `{}`?", path.replacen(library, near, 1)),
                    None => format!("add a package with a library `{library}` to the workspace"),
                };
                unknown(format!("no crate of the workspace is called `{library}`"))
                    .at(file, place.clone(), "")
                    .help(help)
            }
            Self::Module {
                parent,
                name,
                file: Some(found),
            } => unknown(format!("module `{}::{name}` is not declared", parent.path))
                .at(file, place.clone(), format!("its file is `{found}`"))
                .help(format!("add `pub mod {name};` to `{}`", parent.file)),
            Self::Module {
                parent,
                name,
                file: None,
            } => {
                let help = match nearest(name, parent.module_names()) {
                    Some(near) => {
                        let parent = &parent.path;
                        let wrong = format!("{parent}::{name}");
                        format!(
                            "did you mean `{}`?",
                            path.replacen(&wrong, &format!("{parent}::{near}"), 1)
                        )
                    }
                    None => format!(
                        "`{}` declares {}",
                        parent.path,
                        listed(parent.module_names())
                    ),
                };
                unknown(format!("there is no module `{}::{name}`", parent.path))
                    .at(file, place.clone(), "")
                    .help(help)
            }
            Self::Private {
                parent,
                name,
                range,
                imported,
            } => private(parent, name, range, *imported).at(file, place.clone(), "a node in it"),
            Self::Item { parent, name } => {
                let parent_path = &parent.path;
                let help = match parent_path.contains("::") {
                    true => format!("write `{parent_path}`: a node is named by its module"),
                    false => format!(
                        "a node is named by its module; `{parent_path}` declares {}",
                        listed(parent.module_names())
                    ),
                };
                unknown(format!("`{parent_path}::{name}` is no module"))
                    .at(file, place.clone(), "")
                    .help(help)
            }
            Self::Several { parent, name } => {
                let (message, help) = several(parent, name);
                unknown(message).at(file, place.clone(), "").help(help)
            }
            Self::Told => unknown(format!("the file of node `{path}` cannot be read")).at(
                file,
                place.clone(),
                "",
            ),
        }
    }
}

fn several(parent: &Module, name: &str) -> (String, String) {
    let (path, file) = (&parent.path, &parent.file);
    let message =
        format!("`{path}` declares `{name}` several times, and conditions choose from them");
    let help = format!(
        "declare one `pub mod {name};` in `{file}` without `#[cfg(…)]`, and write the conditions within it"
    );
    (message, help)
}

fn private(parent: &Module, name: &str, range: &Range<usize>, imported: bool) -> Diagnostic {
    let message = format!("module `{}::{name}` is private", parent.path);
    let help = match imported {
        true => {
            "write `pub use` there, or name the node by the path where it is declared".to_owned()
        }
        false => format!("write `pub mod {name};`"),
    };
    Diagnostic::new(Code::NotPublic, message)
        .at(
            &parent.file,
            range.clone(),
            "not visible for the generated crate",
        )
        .help(help)
}

/// Where the file of a module may lie; files are called without `r#`.
pub(crate) fn candidates(folder: &Utf8Path, name: &str) -> Vec<Utf8PathBuf> {
    let name = name.strip_prefix("r#").unwrap_or(name);
    vec![
        folder.join(format!("{name}.rs")),
        folder.join(name).join("mod.rs"),
    ]
}

/// Where `#[path]` begins in a module: beside its file, or in the folder of a module that is written within one.
fn base(module: &Module) -> &Utf8Path {
    if module.inline {
        return &module.folder;
    }
    module.file.parent().unwrap_or(Utf8Path::new(""))
}

/// Where the file of a module may lie; `#[path]` begins in `base`.
pub(crate) fn places(base: &Utf8Path, folder: &Utf8Path, item: &ItemMod) -> Vec<Utf8PathBuf> {
    match path_attribute(item) {
        Some(named) => vec![base.join(named)],
        None => candidates(folder, &item.ident.to_string()),
    }
}

/// The file that `#[path = "…"]` names, also under a condition that holds on this machine.
pub(crate) fn path_attribute(item: &ItemMod) -> Option<String> {
    let mut attributes = item.attrs.iter();
    attributes.find_map(|one| named_path(&one.meta).or_else(|| conditional_path(one)))
}

#[cfg(test)]
mod tests;
