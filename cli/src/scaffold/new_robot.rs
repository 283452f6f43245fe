//! A whole new workspace: a small robot of its own, or the NAO for a team to own.

use camino::{Utf8Path, Utf8PathBuf};
use serde::Serialize;
use toml_edit::{DocumentMut, Item, Table, TableLike};

use super::{Changes, Framework, document, read};
use crate::outcome::Refusal;
use crate::render::render_template;
use crate::workspace::{MANIFEST, Workspace};

/// What a new robot begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Template {
    /// A perception and a real-time cycler on a simulated vehicle.
    Blank,
    /// The NAO of a checkout of hulkgen.
    Nao,
}

/// What is asked for.
#[derive(Clone, Debug)]
pub struct NewRobot<'a> {
    /// Of the robot, in snake_case.
    pub name: &'a str,
    pub template: Template,
    pub framework: &'a Framework,
    /// The checkout that files are copied from.
    pub checkout: Option<&'a Utf8Path>,
}

/// Files that a team owns from then on, and licences that say so.
const COPIED: [&str; 4] = [MANIFEST, "Cargo.lock", "LICENSE-APACHE", "LICENSE-MIT"];
/// The folder with the NAO's crates and parameters.
const ROBOTICS: &str = "robotics";
/// Tables of a Cargo.toml that name dependencies.
const DEPENDENCY_TABLES: [&str; 3] = ["dependencies", "dev-dependencies", "build-dependencies"];

#[derive(Serialize)]
struct Values<'a> {
    name: &'a str,
    /// Lines of the framework in `[workspace.dependencies]`.
    framework: String,
    blank: bool,
}

/// Every file but the generated ones, by path from the new workspace's root.
pub fn new_robot(robot: &NewRobot<'_>) -> Result<Changes, Refusal> {
    let values = Values {
        name: robot.name,
        framework: lines(robot.framework),
        blank: robot.template == Template::Blank,
    };
    let render = |(path, template): &(&str, &str)| {
        let text = render_template(path, template, &values);
        (Utf8PathBuf::from(*path), Some(text))
    };
    let mut files: Changes = templates::robot::SHARED.iter().map(render).collect();
    match (robot.template, robot.checkout) {
        (Template::Blank, checkout) => {
            files.extend(templates::robot::BLANK.iter().map(render));
            if let Some(checkout) = checkout {
                // The versions that the framework is tested with.
                files.extend(
                    copied(&Workspace::at_root(checkout), Utf8Path::new("Cargo.lock")).ok(),
                );
            }
        }
        (Template::Nao, Some(checkout)) => files.extend(nao(checkout, robot.framework)?),
        (Template::Nao, None) => {
            return Err(Refusal::wrong_usage(
                "the template `nao` is copied from a checkout of hulkgen, and there is none",
            )
            .help(
                "give `--framework PATH` of a checkout of hulkgen, or take the template `blank`",
            ));
        }
    }
    Ok(files)
}

/// The NAO's own files, and the part of the checkout's Cargo.toml that is about them.
fn nao(checkout: &Utf8Path, framework: &Framework) -> Result<Changes, Refusal> {
    let source = Workspace::at_root(checkout);
    let mut paths: Vec<Utf8PathBuf> = COPIED.iter().map(Utf8PathBuf::from).collect();
    paths.extend(source.files_below(Utf8Path::new(ROBOTICS)));
    let copies = paths.iter().map(|path| copied(&source, path));
    let mut files: Changes = copies.collect::<Result<_, Refusal>>()?;
    let file = Utf8Path::new("Cargo.toml");
    let mut root = document::parse(file, &read(&source, file)?)?;
    reduce(&source, &mut root, framework, &files)?;
    files.insert(file.to_owned(), Some(root.to_string()));
    Ok(files)
}

fn copied(source: &Workspace, path: &Utf8Path) -> Result<(Utf8PathBuf, Option<String>), Refusal> {
    Ok((path.to_owned(), Some(read(source, path)?.to_string())))
}

/// Leaves of the checkout's Cargo.toml what the robot needs.
fn reduce(
    source: &Workspace,
    root: &mut DocumentMut,
    framework: &Framework,
    files: &Changes,
) -> Result<(), Refusal> {
    let broken = || {
        Refusal::bad(format!(
            "the Cargo.toml of `{}` is no workspace",
            source.root()
        ))
    };
    let used = used_dependencies(files)?;
    let workspace = root
        .get_mut("workspace")
        .and_then(Item::as_table_mut)
        .ok_or_else(broken)?;
    workspace.remove("default-members");
    let is_own = |path: &str| path == "generated" || path.starts_with(ROBOTICS);
    let members = workspace
        .get_mut("members")
        .and_then(Item::as_array_mut)
        .ok_or_else(broken)?;
    members.retain(|member| member.as_str().is_some_and(is_own));
    let dependencies = workspace
        .get_mut("dependencies")
        .and_then(Item::as_table_mut)
        .ok_or_else(broken)?;
    let keys: Vec<String> = dependencies.iter().map(|(key, _)| key.to_owned()).collect();
    for key in keys {
        let path = dependencies
            .get(&key)
            .and_then(|item| item.get("path")?.as_str());
        let stays = path.map_or_else(|| used.contains(&key), is_own);
        let is_framework = framework.dependencies().iter().any(|(own, _)| *own == key);
        if !is_framework && !stays {
            dependencies.remove(&key);
        }
    }
    for (key, line) in framework.dependencies() {
        let mut dependency = line
            .parse::<toml_edit::Value>()
            .map_err(|error| Refusal::bad(error.to_string()))?;
        dependency.decor_mut().set_prefix(" ");
        dependencies.insert(key, Item::Value(dependency));
    }
    forget_packages(root);
    Ok(())
}

/// Of the profiles what is about single packages: most of them are the checkout's, and cargo warns of those that are not there.
/// The framework is among a team's dependencies, and its assertions are wanted.
fn forget_packages(root: &mut DocumentMut) {
    let profiles = root.get_mut("profile").and_then(Item::as_table_mut);
    let profiles = profiles.into_iter().flat_map(Table::iter_mut);
    for (_, profile) in profiles {
        let Some(profile) = profile.as_table_mut() else {
            continue;
        };
        if let Some(packages) = profile.get_mut("package").and_then(Item::as_table_mut) {
            packages.retain(|package, _| package == "*");
            if let Some(all) = packages.get_mut("*").and_then(Item::as_table_like_mut) {
                all.remove("debug-assertions");
                all.remove("overflow-checks");
            }
            if packages.is_empty() {
                profile.remove("package");
            }
        }
    }
}

fn lines(framework: &Framework) -> String {
    let lines = framework.dependencies();
    let lines = lines.map(|(key, line)| format!("{key} = {line}"));
    lines.join("\n")
}

/// Keys that the packages take from the workspace; generated code needs serde and what its types name.
fn used_dependencies(files: &Changes) -> Result<Vec<String>, Refusal> {
    let mut used = vec!["serde".to_owned()];
    let packages = files
        .iter()
        .filter(|(path, _)| path.file_name() == Some("Cargo.toml"));
    for (path, text) in packages {
        let package = document::parse(path, text.as_deref().unwrap_or_default())?;
        for table in DEPENDENCY_TABLES {
            let table = package.get(table).and_then(Item::as_table_like);
            used.extend(
                table
                    .into_iter()
                    .flat_map(TableLike::iter)
                    .map(|(key, _)| key.to_owned()),
            );
        }
    }
    Ok(used)
}
