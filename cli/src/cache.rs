//! The third door: answers of earlier runs, kept in the user's cache folder and never in the robot's.
//!
//! An answer is kept with every question that the workspace asked the disk for it, and the digest of what the disk said.
//! It is taken for the answer of now if this hulkgen, asked for the same, would be told the same by the disk: contents are
//! read and compared by digest, times of change are not trusted. So a kept answer saves the work, and nothing else.
//!
//! Invariants: whatever is wrong with the folder or a file in it, there is no kept answer, and no error either. The folder
//! can be deleted at any time, also while hulkgen runs.

pub mod checkout;
mod folder;
mod identity;
mod sealed;

use camino::{Utf8Path, Utf8PathBuf};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::digest::Digest;
use crate::workspace::{Answers, Workspace};
use folder::Folder;

/// Where answers are kept, and whose they are.
#[derive(Clone, Debug, Default)]
pub struct Cache(Option<Place>);

#[derive(Clone, Debug)]
struct Place {
    folder: Folder,
    /// Of the running program.
    hulkgen: Digest,
}

/// An answer as it is read.
#[derive(Deserialize)]
struct Kept<T> {
    answers: Answers,
    answer: T,
}

/// The same as it is written.
#[derive(Serialize)]
struct Keep<'a, T> {
    answers: &'a Answers,
    answer: &'a T,
}

impl Cache {
    /// Keeps nothing and knows nothing.
    pub fn none() -> Self {
        Self(None)
    }

    /// `hulkgen` in the user's cache folder: `$XDG_CACHE_HOME`, else `~/.cache`. None where there is no such folder outside
    /// of the robot's, or the running program cannot be told from others.
    pub fn of_user(robot: &Utf8Path) -> Self {
        let place = || {
            let folder = user_folder().filter(|folder| !is_inside(folder, robot))?;
            Some(Place {
                folder: Folder::new(folder),
                hulkgen: identity::of_this_program()?,
            })
        };
        Self(place())
    }

    /// What was answered to this question, if it would be answered again now.
    pub fn recall<T: DeserializeOwned>(&self, workspace: &Workspace, question: &str) -> Option<T> {
        let place = self.0.as_ref()?;
        let text = place.folder.read(&place.name(workspace, question))?;
        let kept: Kept<T> = serde_json::from_str(sealed::open(&text)?).ok()?;
        workspace
            .still_answers(&kept.answers)
            .then_some(kept.answer)
    }

    /// Keeps an answer that was made of everything this workspace was asked for, of the question, and of nothing else.
    pub fn keep<T: Serialize>(&self, workspace: &Workspace, question: &str, answer: &T) {
        let Some((place, answers)) = self.0.as_ref().zip(workspace.answers()) else {
            return;
        };
        let answers = &answers;
        let keep = Keep { answers, answer };
        if let Ok(text) = serde_json::to_string(&keep) {
            let name = place.name(workspace, question);
            place.folder.write(&name, &sealed::seal(&text));
        }
    }
}

impl Place {
    /// The file of an answer: another for every hulkgen, robot and question.
    fn name(&self, workspace: &Workspace, question: &str) -> String {
        let hulkgen = self.hulkgen.to_string();
        let parts = [&hulkgen, workspace.root().as_str(), question];
        Digest::of_parts(parts.map(str::as_bytes)).to_string()
    }
}

pub(crate) fn user_folder() -> Option<Utf8PathBuf> {
    let folder = |variable: &str| {
        let folder = Utf8PathBuf::try_from(std::path::PathBuf::from(std::env::var_os(variable)?));
        // Relative ones are to be ignored, says the XDG Base Directory Specification.
        folder.ok().filter(|folder| folder.is_absolute())
    };
    let caches = folder("XDG_CACHE_HOME").or_else(|| Some(folder("HOME")?.join(".cache")));
    Some(caches?.join("hulkgen"))
}

/// Whether a folder, which may not exist yet, lies in another one, also through links.
fn is_inside(folder: &Utf8Path, other: &Utf8Path) -> bool {
    let mut ways = folder.ancestors();
    let there = ways.find_map(|way| way.canonicalize_utf8().ok());
    let other = other
        .canonicalize_utf8()
        .unwrap_or_else(|_| other.to_owned());
    folder.starts_with(&other) || there.is_none_or(|there| there.starts_with(&other))
}
