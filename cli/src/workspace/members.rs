//! Packages of a workspace, read from Cargo.toml files without cargo.

mod dependencies;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use camino::{Utf8Path, Utf8PathBuf};

use super::{Workspace, glob};
use dependencies::{Dependencies, read_dependencies};

pub use dependencies::{OF_GENERATED, Origin};

/// The packages of a workspace, and what the root says about dependencies.
#[derive(Debug, Default)]
pub struct Members {
    /// Packages with a library, by its name as written in `use`.
    libraries: BTreeMap<String, Member>,
    /// `[workspace.dependencies]` of the root.
    shared: Dependencies,
    /// Packages outside of the workspace that lie in a folder, by the names that they have here.
    beside: BTreeSet<String>,
    /// The robot's root, relative to that of cargo's workspace.
    pub(super) own: Utf8PathBuf,
    /// Folders of all packages, also of those without a library, relative to the robot's root; `.` for a package there.
    pub folders: Vec<Utf8PathBuf>,
    /// Keys of the root's `[workspace.package]`, sorted: packages may inherit them.
    pub inherited: Vec<String>,
    /// The edition among them.
    edition: Option<String>,
    /// Cargo.toml files that cannot be read or parsed; the generated crate's may be among them.
    pub broken: Vec<BrokenPackage>,
}

/// A package of the workspace that has a library.
#[derive(Clone, Debug)]
pub struct Member {
    /// Name in `[package]`.
    pub package: String,
    /// Name as written in `use`.
    pub library: String,
    /// The package's folder; empty for a package at the root.
    pub folder: Utf8PathBuf,
    /// The library's first file, usually `src/lib.rs`.
    pub root_file: Utf8PathBuf,
    /// The package's folder from cargo's root.
    of_cargo: Utf8PathBuf,
    dependencies: Dependencies,
}

/// A Cargo.toml that hulkgen cannot use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BrokenPackage {
    pub file: Utf8PathBuf,
    pub range: Range<usize>,
    pub message: String,
}

impl Members {
    pub(super) fn read(workspace: &Workspace) -> Self {
        let mut members = Self::default();
        let (way, own) = cargo_root(workspace);
        let Some(root) = members.parse(workspace, &way.join("Cargo.toml")) else {
            return members;
        };
        let mut folders: Vec<Utf8PathBuf> = Vec::new();
        let mut excluded = Vec::new();
        if package_table(&root).is_some() {
            folders.push(Utf8PathBuf::new());
        }
        if let Some(table) = root.get("workspace").and_then(toml::Value::as_table) {
            excluded = patterns(workspace, table, "exclude", &way);
            folders.extend(patterns(workspace, table, "members", &way));
            folders.retain(|folder| !excluded.contains(folder));
            members.shared = read_dependencies(table);
            let inherited = table.get("package").and_then(toml::Value::as_table);
            let edition = inherited.and_then(|inherited| inherited.get("edition")?.as_str());
            members.edition = edition.map(str::to_owned);
            members.inherited = inherited
                .into_iter()
                .flatten()
                .map(|(key, _)| key.clone())
                .collect();
            members.inherited.sort();
        }
        // Behind them come those that they depend on by a path, as cargo has it.
        let mut next = 0;
        while let Some(of_cargo) = folders.get(next).map(|folder| normalized(folder)) {
            next += 1;
            let folder = relative(&own, &of_cargo);
            members.folders.push(folder.clone());
            for neighbour in members.add(workspace, folder, &of_cargo) {
                let is_new = folders.iter().all(|known| normalized(known) != neighbour);
                let is_package = || workspace.is_file(&way.join(&neighbour).join("Cargo.toml"));
                let is_excluded = excluded.iter().any(|folder| neighbour.starts_with(folder));
                if is_new && !is_excluded && is_package() {
                    folders.push(neighbour);
                }
            }
        }
        members.bind_dependencies();
        members.own = own;
        members
    }

    /// The package whose library has this name.
    pub fn library(&self, name: &str) -> Option<&Member> {
        self.libraries.get(name)
    }

    /// Every package with a library, sorted by the library's name.
    pub fn libraries(&self) -> impl Iterator<Item = &Member> {
        self.libraries.values()
    }

    /// A folder of the robot as the root's Cargo.toml names it.
    pub fn below_own(&self, folder: &Utf8Path) -> Utf8PathBuf {
        self.own.join(folder)
    }

    fn parse(&mut self, workspace: &Workspace, file: &Utf8Path) -> Option<toml::Table> {
        let broken = |range, message: String| BrokenPackage {
            file: file.to_owned(),
            range,
            message,
        };
        let text = match workspace.read(file) {
            Ok(text) => text,
            Err(error) => {
                self.broken.push(broken(0..0, error.to_string()));
                return None;
            }
        };
        match toml::from_str(&text) {
            Ok(table) => Some(table),
            Err(error) => {
                let range = error.span().unwrap_or(0..0);
                self.broken.push(broken(range, error.message().to_owned()));
                None
            }
        }
    }

    /// Why cargo refuses the old name of `[package]`.
    fn outdated(&self, package: &toml::Table) -> Option<&'static str> {
        let is_old = package.contains_key("project");
        let edition = package_table(package)?.get("edition")?;
        // A table says that the workspace's is inherited.
        let edition = edition.as_str().or(self.edition.as_deref())?;
        let is_refused = is_old && edition.parse::<u32>().is_ok_and(|year| year >= 2024);
        is_refused.then_some("since edition 2024 `[project]` has to be called `[package]`")
    }

    /// Answers with the folders that the package depends on, relative to cargo's root as its own is then.
    fn add(
        &mut self,
        workspace: &Workspace,
        folder: Utf8PathBuf,
        of_cargo: &Utf8Path,
    ) -> Vec<Utf8PathBuf> {
        let Some(package) = self.parse(workspace, &folder.join("Cargo.toml")) else {
            return Vec::new();
        };
        if let Some(message) = nameless(&package).or_else(|| self.outdated(&package)) {
            self.broken.push(BrokenPackage {
                file: folder.join("Cargo.toml"),
                range: 0..0,
                message: message.to_owned(),
            });
        }
        let dependencies = read_dependencies(&package);
        let needed = dependencies.iter().filter_map(|(name, entry)| {
            let folder = match entry.workspace {
                true => self.shared.get(name)?.folder(Utf8Path::new("")),
                false => entry.folder(of_cargo),
            };
            folder.filter(|folder| !folder.is_absolute() && !folder.starts_with(".."))
        });
        let needed = needed.collect();
        if let Some(member) = Member::new(workspace, folder, of_cargo, &package, dependencies) {
            self.libraries.insert(member.library.clone(), member);
        }
        needed
    }
}

impl Member {
    /// `None`: the package has no library.
    fn new(
        workspace: &Workspace,
        folder: Utf8PathBuf,
        of_cargo: &Utf8Path,
        package: &toml::Table,
        dependencies: Dependencies,
    ) -> Option<Self> {
        let name = package_table(package)?.get("name")?.as_str()?.to_owned();
        let library = package.get("lib");
        let library_name = library
            .and_then(|library| library.get("name")?.as_str())
            .map_or_else(|| name.replace('-', "_"), str::to_owned);
        let path = library.and_then(|library| library.get("path")?.as_str());
        let root_file = folder.join(path.unwrap_or("src/lib.rs"));
        workspace.is_file(&root_file).then(|| Self {
            package: name,
            library: library_name,
            root_file,
            dependencies,
            of_cargo: of_cargo.to_owned(),
            folder,
        })
    }
}

/// The table `[package]`, which cargo takes by its old name `[project]`, too.
pub(crate) fn package_table(table: &toml::Table) -> Option<&toml::Value> {
    table.get("package").or_else(|| table.get("project"))
}

/// Why cargo refuses the Cargo.toml of a package that has no name.
fn nameless(package: &toml::Table) -> Option<&'static str> {
    match package_table(package).map(|package| package.get("name")) {
        None => Some("a package needs a table `[package]`"),
        Some(Some(toml::Value::String(_))) => None,
        Some(_) => Some("`[package]` needs a `name`"),
    }
}

/// The folders that `members` or `exclude` names, in the order of the list.
fn patterns(
    workspace: &Workspace,
    table: &toml::Table,
    name: &str,
    way: &Utf8Path,
) -> Vec<Utf8PathBuf> {
    let list = table.get(name).and_then(toml::Value::as_array);
    let strings = list.into_iter().flatten().filter_map(toml::Value::as_str);
    strings
        .flat_map(|pattern| glob::expand(workspace, way, pattern))
        .collect()
}

/// The folder whose Cargo.toml has `[workspace]`: the manifest's or the nearest above it, as a robot may be one of
/// several in a workspace of cargo. First the way up there (`../..`), then the way from there back (`robots/zoo`).
fn cargo_root(workspace: &Workspace) -> (Utf8PathBuf, Utf8PathBuf) {
    let mut way = Utf8PathBuf::new();
    for above in workspace.root().ancestors() {
        let text = workspace.read(&way.join("Cargo.toml"));
        let table = text
            .ok()
            .and_then(|text| toml::from_str::<toml::Table>(&text).ok());
        if table.is_some_and(|table| table.contains_key("workspace")) {
            let own = workspace
                .root()
                .strip_prefix(above)
                .unwrap_or(Utf8Path::new(""));
            return (way, own.to_owned());
        }
        way.push("..");
    }
    Default::default()
}

/// The way from one folder to another, both relative to the workspace root.
pub(crate) fn relative(from: &Utf8Path, to: &Utf8Path) -> Utf8PathBuf {
    let from: Vec<&str> = from.components().map(|part| part.as_str()).collect();
    let to: Vec<&str> = to.components().map(|part| part.as_str()).collect();
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = from[shared..].iter().map(|_| "..");
    let way: Utf8PathBuf = up.chain(to[shared..].iter().copied()).collect();
    if way.as_str().is_empty() {
        ".".into()
    } else {
        way
    }
}

/// The empty way as Cargo.toml writes it.
fn dotted(way: Utf8PathBuf) -> Utf8PathBuf {
    if way.as_str().is_empty() {
        ".".into()
    } else {
        way
    }
}

/// Without `.` and with every `..` taken back.
pub(crate) fn normalized(path: &Utf8Path) -> Utf8PathBuf {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.components().map(|part| part.as_str()) {
        match part {
            "." => {}
            ".." => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.into_iter().collect()
}
