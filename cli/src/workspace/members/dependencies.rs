//! What packages depend on, and which package stands behind a name: cargo lets every package call a dependency as it
//! likes.
//!
//! Invariant: one package has one name, whatever its users call it: members the name of their library, others what the
//! root calls them, else most plainly one of their users. So types can be compared, and the generated crate never
//! depends on a package by two names, which cargo refuses.

use std::collections::{BTreeMap, BTreeSet};

use camino::{Utf8Component, Utf8Path, Utf8PathBuf};

use super::{Member, Members, dotted, normalized, relative};

/// What generated code calls so, whatever its robot does: a package that anybody calls so has this name.
pub const OF_GENERATED: [&str; 3] = ["framework", "serde", "hulkgen_communication"];

/// A dependency table: crate name as written in `use` → what stands there.
pub(super) type Dependencies = BTreeMap<String, Entry>;

/// One line of a dependency table.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    key: String,
    /// `package`: the key is a name of the author's own.
    package: Option<String>,
    /// The right side; it is never optional for who needs it.
    requirement: toml::Value,
    /// `path`, relative to the package's folder.
    path: Option<String>,
    pub(super) workspace: bool,
    /// Known when all packages are.
    origin: Option<Known>,
}

/// Where the name of a dependency leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin<'m> {
    /// The library of a member.
    Member(&'m str),
    /// A package outside of the workspace, by the one name that it has here.
    Outside(&'m str),
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Known {
    Member(String),
    Outside(String),
}

/// A package outside of the workspace.
struct Outside {
    package: String,
    source: Source,
    name: String,
}

/// Which of the packages of one name it is.
#[derive(PartialEq, Eq)]
enum Source {
    /// The part of a version that tells what does not fit each other; `None`: any.
    Registry(Option<String>),
    Folder(Utf8PathBuf),
    Git(String),
}

impl Members {
    /// Whether the root's `[workspace.dependencies]` has a crate of this name.
    pub fn is_shared(&self, library: &str) -> bool {
        self.shared.contains_key(library)
    }

    /// A path that begins with a name of the root's `[workspace.dependencies]`, by the name of the member's library.
    pub fn by_library(&self, path: &str) -> String {
        let (first, rest) = path.split_once("::").unwrap_or((path, ""));
        let entry = self.shared.get(first);
        match entry.and_then(|entry| entry.origin.as_ref()) {
            Some(Known::Member(library)) if !self.libraries.contains_key(first) => {
                format!("{library}::{rest}")
            }
            _ => path.to_owned(),
        }
    }

    /// Whether a package outside of the workspace, by its name here, lies in a folder, from where a path may lead back to
    /// members; crates of a registry know none, and those of generated code none of a robot.
    pub fn lies_beside(&self, name: &str) -> bool {
        self.beside.contains(name)
    }

    fn all_beside(&self) -> BTreeSet<String> {
        let own = self.libraries.values();
        let own = own.flat_map(|member| member.dependencies.values());
        let in_folders = self.shared.values().chain(own);
        let in_folders = in_folders.filter(|entry| entry.path.is_some());
        let names = in_folders.filter_map(|entry| match &entry.origin {
            Some(Known::Outside(name)) if !OF_GENERATED.contains(&name.as_str()) => {
                Some(name.clone())
            }
            _ => None,
        });
        names.collect()
    }

    /// The line for `[dependencies]` of a package in `from` that makes a crate known as `library`: key and right side.
    ///
    /// The root's `[workspace.dependencies]` come first, then the path of a member, then what one of the packages
    /// `users` (libraries' names) asks for, then what any other does. `None`: nobody says where the crate comes from.
    pub fn requirement(
        &self,
        library: &str,
        from: &Utf8Path,
        users: &[&str],
    ) -> Option<(String, String)> {
        let member = self.libraries.get(library);
        let wanted = match member {
            Some(_) => Known::Member(library.to_owned()),
            None => Known::Outside(library.to_owned()),
        };
        if let Some(entry) = self.shared.get(library)
            && entry.origin.as_ref() == Some(&wanted)
        {
            return Some((entry.key.clone(), "{ workspace = true }".to_owned()));
        }
        if let Some(member) = member {
            let path = dotted(relative(from, &member.folder));
            return Some((member.package.clone(), format!("{{ path = \"{path}\" }}")));
        }
        let users = users.iter().filter_map(|user| self.libraries.get(*user));
        users.chain(self.libraries.values()).find_map(|user| {
            let mut entries = user.dependencies.values();
            let entry =
                entries.find(|entry| !entry.workspace && entry.origin.as_ref() == Some(&wanted))?;
            let folder = entry.folder(&user.of_cargo);
            let moved = folder.map(|folder| relative(&normalized(&self.own.join(from)), &folder));
            Some(entry.line(library, moved))
        })
    }

    /// Finds out what each dependency is, and gives it its name.
    pub(super) fn bind_dependencies(&mut self) {
        let outside = self.outside();
        let known = |entry: &Entry, base: &Utf8Path| match self.member_of(entry, base) {
            Some(member) => Some(Known::Member(member.library.clone())),
            None => {
                let found = outside.iter().find(|one| one.is(entry, base))?;
                Some(Known::Outside(found.name.clone()))
            }
        };
        let mut raw = self.shared.clone();
        for entry in raw.values_mut() {
            entry.origin = known(entry, Utf8Path::new(""));
        }
        let bound = self.libraries.iter().map(|(library, member)| {
            let entries = member.dependencies.iter().map(|(name, entry)| {
                let mut entry = entry.clone();
                let shared = raw.get(name).filter(|_| entry.workspace);
                entry.origin = match shared {
                    Some(shared) => shared.origin.clone(),
                    None => known(&entry, &member.of_cargo),
                };
                (entry.name(shared.unwrap_or(&entry)), entry)
            });
            (library.clone(), entries.collect::<Dependencies>())
        });
        let bound: Vec<_> = bound.collect();
        for (library, dependencies) in bound {
            if let Some(member) = self.libraries.get_mut(&library) {
                member.dependencies = dependencies;
            }
        }
        self.shared = by_name(raw);
        self.beside = self.all_beside();
    }

    /// The member that an entry of a package in `base` means.
    fn member_of(&self, entry: &Entry, base: &Utf8Path) -> Option<&Member> {
        let mut members = self.libraries.values();
        match entry.folder(base) {
            Some(folder) => members.find(|member| member.of_cargo == folder),
            None => members.find(|member| member.package == entry.package()),
        }
    }

    /// Packages outside of the workspace, each with the name that the generated crate gives it.
    fn outside(&self) -> Vec<Outside> {
        let root = Utf8Path::new("");
        let shared = self.shared.values().map(|entry| (entry, root));
        let own = self.libraries.values().flat_map(|member| {
            let entries = member.dependencies.values();
            let entries = entries.filter(|entry| !entry.workspace);
            entries.map(|entry| (entry, member.of_cargo.as_path()))
        });
        let (mut shared, mut own): (Vec<_>, Vec<_>) = (shared.collect(), own.collect());
        // That of generated code first, then the plainest: the package's own, then the shortest.
        for entries in [&mut shared, &mut own] {
            entries.sort_by_key(|(entry, _)| {
                let is_generated = OF_GENERATED.contains(&&*underscored(&entry.key));
                (!is_generated, entry.package.is_some(), entry.key.len())
            });
        }
        let mut taken: BTreeSet<String> = self.libraries.keys().cloned().collect();
        let mut found: Vec<Outside> = Vec::new();
        for (entry, base) in shared.into_iter().chain(own) {
            if self.member_of(entry, base).is_some() || found.iter().any(|one| one.is(entry, base))
            {
                continue;
            }
            let name = free_name(entry, &taken);
            taken.insert(name.clone());
            found.push(Outside {
                package: entry.package().to_owned(),
                source: entry.source(base),
                name,
            });
        }
        found
    }
}

impl Member {
    /// Crates that the package names in `[dependencies]`, as written in `use`.
    pub fn dependencies(&self) -> impl Iterator<Item = &str> {
        self.dependencies.keys().map(String::as_str)
    }

    /// What the package calls `name` in its code, if that is a dependency.
    pub fn dependency(&self, name: &str) -> Option<Origin<'_>> {
        match self.dependencies.get(name)?.origin.as_ref()? {
            Known::Member(library) => Some(Origin::Member(library)),
            Known::Outside(name) => Some(Origin::Outside(name)),
        }
    }
}

impl Outside {
    fn is(&self, entry: &Entry, base: &Utf8Path) -> bool {
        let any = Source::Registry(None);
        let source = entry.source(base);
        let fits = self.source == source
            || matches!(
                (&self.source, &source),
                (Source::Registry(_), Source::Registry(_))
            ) && (self.source == any || source == any);
        self.package == entry.package() && fits
    }
}

impl Entry {
    fn new(key: &str, value: &toml::Value) -> Self {
        let text = |name: &str| value.get(name).and_then(toml::Value::as_str);
        let workspace = value.get("workspace").and_then(toml::Value::as_bool);
        let mut requirement = value.clone();
        if let Some(table) = requirement.as_table_mut() {
            table.remove("optional");
        }
        Self {
            key: key.to_owned(),
            package: text("package").map(str::to_owned),
            path: text("path").map(str::to_owned),
            workspace: workspace.unwrap_or(false),
            origin: None,
            requirement,
        }
    }

    fn package(&self) -> &str {
        self.package.as_deref().unwrap_or(&self.key)
    }

    /// Its name in code; what the root says about it may be elsewhere.
    fn name(&self, said: &Self) -> String {
        match &self.origin {
            Some(Known::Member(library)) if said.package.is_none() => library.clone(),
            _ => underscored(&self.key),
        }
    }

    /// Where its `path` leads from a package's folder, both from cargo's root; it may begin with `..`.
    pub(super) fn folder(&self, base: &Utf8Path) -> Option<Utf8PathBuf> {
        let mut parts: Vec<&str> = Vec::new();
        let way = base.join(self.path.as_deref()?);
        for part in way.components() {
            match part {
                Utf8Component::CurDir => {}
                Utf8Component::ParentDir if parts.last().is_some_and(|last| *last != "..") => {
                    parts.pop();
                }
                part => parts.push(part.as_str()),
            }
        }
        Some(parts.iter().collect())
    }

    fn source(&self, base: &Utf8Path) -> Source {
        let text = |name: &str| self.requirement.get(name).and_then(toml::Value::as_str);
        if let Some(folder) = self.folder(base) {
            return Source::Folder(folder);
        }
        if let Some(place) = text("git") {
            let parts = ["branch", "tag", "rev"].map(|name| text(name).unwrap_or_default());
            return Source::Git(format!("{place} {}", parts.join(" ")));
        }
        let version = self.requirement.as_str().or_else(|| text("version"));
        Source::Registry(version.and_then(major))
    }

    /// The line that makes it known as `name` in the folder to which its path is moved.
    fn line(&self, name: &str, moved: Option<Utf8PathBuf>) -> (String, String) {
        let is_named_so = underscored(&self.key) == name;
        if is_named_so && moved.is_none() {
            return (self.key.clone(), self.requirement.to_string());
        }
        let mut table = match &self.requirement {
            toml::Value::Table(table) => table.clone(),
            version => toml::Table::from_iter([("version".to_owned(), version.clone())]),
        };
        if let Some(moved) = moved {
            table.insert("path".to_owned(), moved.into_string().into());
        }
        let key = if is_named_so {
            self.key.clone()
        } else {
            table.insert("package".to_owned(), self.package().into());
            name.to_owned()
        };
        (key, toml::Value::Table(table).to_string())
    }
}

/// `[dependencies]` of a package or of a workspace, then what stands under `[target.'cfg(…)']`, which only some machines
/// have: where they do not, its names mean nothing to the package's own code either.
pub(super) fn read_dependencies(table: &toml::Table) -> Dependencies {
    let targets = table.get("target").and_then(toml::Value::as_table);
    let targets = targets.into_iter().flatten();
    let of_targets = targets.filter_map(|(_, target)| target.as_table());
    let mut found = Dependencies::new();
    for table in std::iter::once(table).chain(of_targets) {
        let entries = table.get("dependencies").and_then(toml::Value::as_table);
        for (key, value) in entries.into_iter().flatten() {
            let entry = || Entry::new(key, value);
            found.entry(underscored(key)).or_insert_with(entry);
        }
    }
    found
}

/// Shared dependencies by their names in code.
fn by_name(raw: Dependencies) -> Dependencies {
    let mut shared = Dependencies::new();
    for entry in raw.into_values() {
        let name = entry.name(&entry);
        // A package may stand there twice, once by its own name and once renamed: the shorter key is kept.
        match shared.get(&name) {
            Some(other) if other.key.len() <= entry.key.len() => {}
            _ => {
                shared.insert(name, entry);
            }
        }
    }
    shared
}

/// What an author calls the package, unless another is called so.
fn free_name(entry: &Entry, taken: &BTreeSet<String>) -> String {
    let names = [underscored(&entry.key), underscored(entry.package())];
    let numbered = (2..).map(|number| format!("{}_{number}", names[1]));
    let mut all = names.clone().into_iter().chain(numbered);
    all.find(|name| !taken.contains(name))
        .expect("there are more numbers than packages")
}

fn underscored(key: &str) -> String {
    key.replace('-', "_")
}

/// `0.35` of `^0.35.1`, `1` of `1.2`: versions that agree in it are of one package for cargo.
fn major(version: &str) -> Option<String> {
    let mut leading = Vec::new();
    for part in version.split('.') {
        let digits = part.trim_matches(|letter: char| !letter.is_ascii_digit());
        leading.push(digits);
        if digits != "0" {
            break;
        }
    }
    let major = leading.join(".");
    (!major.is_empty()).then_some(major)
}
