//! What tests that call cargo have from the repository's own build.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::{root, target_folder};

/// The repository's profile for a workspace of robots: they and the framework are not optimised and assert what they assert here,
/// what they have of the registry is as here, so that most of that is compiled already.
pub fn unoptimised() -> toml::Table {
    let text = fs::read_to_string(root().join("Cargo.toml")).expect("the root has it");
    let manifest: toml::Table = text.parse().expect("cargo reads it, too");
    let profile = manifest["profile"]["dev"].as_table();
    let mut profile = profile.expect("a table").clone();
    let unoptimised = toml::Table::from_iter([("opt-level".to_owned(), 0.into())]);
    profile.extend(unoptimised.clone());
    let packages = profile["package"].as_table_mut().expect("a table");
    let own = manifest["workspace"]["dependencies"].as_table();
    let own = own.expect("a table").keys();
    let own = own.filter(|name| name.starts_with("hulkgen-"));
    let mut asserting = unoptimised;
    asserting.insert("debug-assertions".to_owned(), true.into());
    asserting.insert("overflow-checks".to_owned(), true.into());
    packages.extend(own.map(|name| (name.clone(), asserting.clone().into())));
    profile
}

/// Gives a new robot [`unoptimised`] as its profile.
pub fn compile_unoptimised(robot: &Path) {
    let profiles = toml::Table::from_iter([("dev".to_owned(), unoptimised().into())]);
    let config = toml::Table::from_iter([("profile".to_owned(), profiles.into())]);
    let folder = robot.join(".cargo");
    fs::create_dir_all(&folder)
        .and_then(|()| fs::write(folder.join("config.toml"), config.to_string()))
        .expect("the folder is the test's");
}

/// Gives a new target folder all that was compiled here of the registry.
///
/// Libraries are links, which cargo replaces and does not write into; what it writes into is a copy. While somebody else compiles
/// here a file may vanish: that unit is compiled anew.
pub fn hand_over_registry(target: &Path) -> io::Result<()> {
    let from = target_folder();
    let to = target.join(from.file_name().expect("target/<profile>"));
    if to.exists() {
        return Ok(());
    }
    let begun = to.with_extension("begun");
    if begun.exists() {
        fs::remove_dir_all(&begun)?;
    }
    let registry = of_registry();
    let mut compiled: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
    for entry in fs::read_dir(from.join("deps"))? {
        let path = entry?.path();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        if let Some((_, hash)) = stem.rsplit_once('-') {
            compiled.entry(hash.to_owned()).or_default().push(path);
        }
    }
    fs::create_dir_all(begun.join("deps"))?;
    for entry in fs::read_dir(from.join(".fingerprint"))? {
        let unit = entry?.file_name();
        let name = unit.to_string_lossy();
        let Some((package, hash)) = name.rsplit_once('-') else {
            continue;
        };
        if !registry.contains(package) {
            continue;
        }
        let files = compiled.get(hash).into_iter().flatten();
        let handed_over = files
            .map(|file| hand_over(file, &begun.join("deps")))
            .chain([".fingerprint", "build"].map(|folder| {
                let folder = Path::new(folder).join(&unit);
                copy_with_times(&from.join(&folder), &begun.join(&folder))
            }))
            .collect::<io::Result<()>>();
        if handed_over.is_err() {
            for folder in [".fingerprint", "build"] {
                let _ = fs::remove_dir_all(begun.join(folder).join(&unit));
            }
        }
    }
    fs::rename(begun, to)
}

fn hand_over(file: &Path, folder: &Path) -> io::Result<()> {
    let to = folder.join(file.file_name().unwrap_or_default());
    match file.extension() {
        Some(extension) if extension == "d" => copy_with_times(file, &to),
        _ => fs::hard_link(file, to),
    }
}

/// Names of packages that are not of this repository.
fn of_registry() -> BTreeSet<String> {
    let text = fs::read_to_string(root().join("Cargo.lock")).expect("it is checked in");
    let lock: toml::Table = text.parse().expect("cargo wrote it");
    let packages = lock["package"].as_array().expect("a list").iter();
    let foreign = packages.filter(|package| package.get("source").is_some());
    let names = foreign.filter_map(|package| package["name"].as_str());
    names.map(str::to_owned).collect()
}

/// With their times, by which cargo knows what is old; of what is not there: nothing.
fn copy_with_times(from: &Path, to: &Path) -> io::Result<()> {
    if from.is_dir() {
        fs::create_dir_all(to)?;
        for entry in fs::read_dir(from)? {
            let name = entry?.file_name();
            copy_with_times(&from.join(&name), &to.join(&name))?;
        }
    } else if from.is_file() {
        fs::copy(from, to)?;
        let modified = fs::metadata(from)?.modified()?;
        fs::File::options()
            .append(true)
            .open(to)?
            .set_modified(modified)?;
    }
    Ok(())
}
