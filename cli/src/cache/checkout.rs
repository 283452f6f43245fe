//! Copies of other revisions of a repository, to be built: nothing in the repository knows of them.

use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, SystemTime};

use camino::{Utf8Component, Utf8Path, Utf8PathBuf};
use toml_edit::{DocumentMut, Item};

use super::user_folder;
use crate::digest::Digest;
use crate::outcome::Refusal;

/// How many revisions stay besides the one that is asked for.
const KEPT: usize = 4;

/// A revision that was asked for less than so long ago stays, too: another process may build it.
const IN_USE: Duration = Duration::from_secs(3600);

/// A revision whose files lie in the user's cache folder.
#[derive(Clone, Debug)]
pub struct Checkout {
    /// Of all that belongs to the revision.
    folder: Utf8PathBuf,
    /// Of the robot in it.
    pub root: Utf8PathBuf,
}

/// The revision of the repository around `root`; what was copied before is taken as it is.
///
/// # Errors
/// If git does not know it, or there is no place for it.
pub fn of(root: &Utf8Path, revision: &str) -> Result<Checkout, Refusal> {
    let commit = format!("{revision}^{{commit}}");
    let commit = git(
        root,
        &["rev-parse", "--verify", "--end-of-options", &commit],
        None,
    )?;
    let prefix = git(root, &["rev-parse", "--show-prefix"], None)?;
    let caches = user_folder().ok_or_else(|| {
        Refusal::bad("there is no cache folder for another revision").help("set XDG_CACHE_HOME")
    })?;
    let revisions = caches.join("revisions");
    let folder = revisions.join(&commit);
    let files = folder.join("files");
    let whole = folder.join("whole");
    if !whole.is_file() {
        fs::create_dir_all(&files).map_err(|error| impossible(&files, &error))?;
        // An index of its own: that of the repository stays as it is.
        let index = folder.join("index");
        git(root, &["read-tree", &commit], Some(&index))?;
        let top = git(root, &["rev-parse", "--show-toplevel"], None)?;
        let prefix = format!("--prefix={files}/");
        git(
            Utf8Path::new(&top),
            &["checkout-index", "--all", "--force", &prefix],
            Some(&index),
        )?;
        let manifests = ["ls-files", "--", "Cargo.toml", "*/Cargo.toml"];
        for manifest in git(Utf8Path::new(&top), &manifests, Some(&index))?.lines() {
            lead_out(&files, Utf8Path::new(&top), Utf8Path::new(manifest))?;
        }
    }
    // Also says when it was asked for last.
    fs::write(&whole, &commit).map_err(|error| impossible(&whole, &error))?;
    forget(&revisions, &folder);
    Ok(Checkout {
        root: files.join(prefix.trim_end_matches('/')),
        folder,
    })
}

impl Checkout {
    /// Where a program of the revision's robot is kept; the repository may have several robots.
    pub fn program(&self, target: &str, profile: &str) -> Utf8PathBuf {
        let place = self.root.strip_prefix(&self.folder).unwrap_or(&self.root);
        let place = Digest::of(place.as_str().as_bytes());
        self.folder.join(format!("{target}-{profile}-{place}"))
    }

    /// Keeps a program that was built of it.
    ///
    /// # Errors
    /// If there is no room.
    pub fn keep(&self, executable: &Utf8Path, kept: &Utf8Path) -> Result<(), Refusal> {
        // Whole or not at all: another process may look for it.
        let half = kept.with_extension("half");
        fs::copy(executable, &half)
            .and_then(|_| fs::rename(&half, kept))
            .map_err(|error| impossible(kept, &error))
    }
}

/// Lets path dependencies that lead out of the repository lead to where they do from the repository itself.
fn lead_out(files: &Utf8Path, top: &Utf8Path, manifest: &Utf8Path) -> Result<(), Refusal> {
    let path = files.join(manifest);
    let Ok(text) = fs::read_to_string(&path) else {
        return Ok(());
    };
    // What cargo cannot read, cargo says.
    let Ok(mut document) = text.parse::<DocumentMut>() else {
        return Ok(());
    };
    let folder = manifest.parent().unwrap_or(Utf8Path::new(""));
    let outside = |path: &str| {
        let inside = folder.join(path);
        let mut depth = 0_usize;
        for component in inside.components() {
            depth = match component {
                Utf8Component::ParentDir => match depth.checked_sub(1) {
                    Some(above) => above,
                    None => return Some(top.join(&inside).into_string()),
                },
                Utf8Component::Normal(_) => depth + 1,
                _ => depth,
            };
        }
        None
    };
    let mut changed = false;
    lead_each(document.as_item_mut(), &outside, &mut changed);
    match changed {
        true => fs::write(&path, document.to_string()).map_err(|error| impossible(&path, &error)),
        false => Ok(()),
    }
}

fn lead_each(item: &mut Item, outside: &dyn Fn(&str) -> Option<String>, changed: &mut bool) {
    let Some(table) = item.as_table_like_mut() else {
        return;
    };
    for (key, item) in table.iter_mut() {
        match item.as_str() {
            Some(path) if key.get() == "path" => {
                if let Some(path) = outside(path) {
                    *item = toml_edit::value(path);
                    *changed = true;
                }
            }
            _ => lead_each(item, outside, changed),
        }
    }
}

/// Takes away the revisions that were asked for longest ago.
fn forget(revisions: &Utf8Path, but: &Utf8Path) {
    let Ok(entries) = revisions.read_dir_utf8() else {
        return;
    };
    let asked = |folder: &Utf8Path| fs::metadata(folder.join("whole"))?.modified();
    let mut old: Vec<(SystemTime, Utf8PathBuf)> = entries
        .filter_map(|entry| Some(entry.ok()?.into_path()))
        .filter(|folder| folder != but)
        .filter_map(|folder| Some((asked(&folder).ok()?, folder)))
        .collect();
    old.sort();
    let now = SystemTime::now();
    for (asked, folder) in old.iter().rev().skip(KEPT) {
        if now.duration_since(*asked).is_ok_and(|age| age > IN_USE) {
            // Another process may do the same; what is left is taken away the next time.
            let _ = fs::remove_dir_all(folder);
        }
    }
}

fn impossible(path: &Utf8Path, error: &std::io::Error) -> Refusal {
    Refusal::bad(format!("cannot write {path}: {error}"))
}

/// What git answers, without the end of the line.
fn git(root: &Utf8Path, words: &[&str], index: Option<&Utf8Path>) -> Result<String, Refusal> {
    let mut command = Command::new("git");
    command.args(words).current_dir(root).stdin(Stdio::null());
    command.env("GIT_TERMINAL_PROMPT", "0");
    if let Some(index) = index {
        command.env("GIT_INDEX_FILE", index);
    }
    let output = command
        .output()
        .map_err(|error| Refusal::bad(format!("cannot start git: {error}")).help("install git"))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        let said = said.trim().trim_start_matches("fatal: ");
        return Err(Refusal::wrong_usage(format!("git says: {said}"))
            .help("name a commit, branch or tag of this repository"));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    Ok(text.trim_end_matches('\n').to_owned())
}

#[cfg(test)]
mod tests {
    use std::fs::File;

    use super::*;

    fn folder() -> (tempfile::TempDir, Utf8PathBuf) {
        let folder = tempfile::tempdir().expect("there is room");
        let path = folder.path().to_owned().try_into().expect("it is UTF-8");
        (folder, path)
    }

    #[test]
    fn dependencies_outside_of_the_repository_stay_where_they_are() {
        let (_keep, files) = folder();
        let (_kept, repository) = folder();
        let text = "[dependencies]\nnear = { path = \"../near\" }\nfar = { path = \"../../far\" } # far\n\n[dependencies.farther]\npath = \"../../../farther\"\n";
        fs::create_dir(files.join("robot")).expect("there is room");
        fs::write(files.join("robot/Cargo.toml"), text).expect("there is room");
        lead_out(&files, &repository, Utf8Path::new("robot/Cargo.toml"))
            .expect("it can be written");
        let outside = |path: &str| format!("\"{repository}/robot/{path}\"");
        assert_eq!(
            fs::read_to_string(files.join("robot/Cargo.toml")).expect("it is there"),
            text.replace("\"../../far\"", &outside("../../far"))
                .replace("\"../../../farther\"", &outside("../../../farther"))
        );
    }

    #[test]
    fn each_robot_of_a_repository_has_a_program_of_its_own() {
        let of = |robot: &str| {
            let checkout = Checkout {
                folder: "/caches/revisions/4b825dc".into(),
                root: Utf8Path::new("/caches/revisions/4b825dc/files").join(robot),
            };
            checkout.program("simulation", "dev")
        };
        assert_eq!(of("a"), of("a"));
        assert_ne!(of("a"), of("b"));
        assert_ne!(of("a"), of(""));
        assert_eq!(of("a/b").parent(), of("a").parent());
    }

    #[test]
    fn the_revisions_asked_for_longest_ago_are_forgotten() {
        let (_keep, revisions) = folder();
        let hour = IN_USE + Duration::from_secs(1);
        for age in 0..8_u32 {
            let folder = revisions.join(age.to_string());
            fs::create_dir(&folder).expect("there is room");
            let whole = File::create(folder.join("whole")).expect("there is room");
            let asked = SystemTime::now() - hour * age;
            whole.set_modified(asked).expect("it is ours");
        }
        // The oldest is the one that is asked for.
        forget(&revisions, &revisions.join("7"));
        let mut left: Vec<_> = revisions
            .read_dir_utf8()
            .expect("it is there")
            .map(|entry| entry.expect("it is there").file_name().to_owned())
            .collect();
        left.sort();
        assert_eq!(left, ["0", "1", "2", "3", "7"]);
        // Nothing that may be in use.
        forget(&revisions, &revisions.join("none"));
        assert!(revisions.join("0").exists());
    }
}
