//! Which scenario is played: who watches one may choose another that lies beside it, or the same once more:
//! `framework.procedures.scenario`.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::file::Scenario;
use super::pace::ANSWERS;
use crate::Reflect;
use crate::error::{Error, Result};
use crate::procedure::{Answerer, Caller, procedure};

/// Asked with a name, that scenario is played from its beginning in place of this one; with nothing, this one goes on.
pub(super) type ChoiceCaller = Caller<Option<String>, Programme>;

/// What is played, and what might be.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub(super) struct Programme {
    /// The name of the scenario: that of its file without `.toml`.
    playing: String,
    /// Those that lie beside it, itself among them, by name.
    choices: Vec<String>,
}

/// Answers for one scenario while it is played.
pub(super) struct Choice {
    asked: Answerer<Option<String>, Programme>,
    file: PathBuf,
}

/// For the scenario that stands in this file.
pub(super) fn choice(file: &Path) -> (ChoiceCaller, Choice) {
    let (caller, asked) = procedure();
    let file = file.to_owned();
    (caller, Choice { asked, file })
}

impl Choice {
    /// Answers those who ask; the file that somebody chose, once somebody did. Who comes later hears that this one has ended.
    pub(super) fn answer(&mut self) -> Option<PathBuf> {
        for _ in 0..ANSWERS {
            self.asked.take();
            let call = self.asked.call()?;
            let wished = call.request().clone();
            let found = file_of(&self.file, wished.as_deref()).and_then(|file| {
                let programme = programme(&file)?;
                Ok((file, programme))
            });
            match found {
                Err(error) => call.refuse(error.to_string()),
                Ok((file, programme)) => {
                    call.answer(programme);
                    if wished.is_some() {
                        return Some(file);
                    }
                }
            }
        }
        None
    }
}

/// Where the scenario of this name stands, beside this one.
///
/// # Errors
/// Where there is none of this name, or it cannot be read: then this one had better go on.
fn file_of(playing: &Path, wished: Option<&str>) -> Result<PathBuf> {
    let Some(wished) = wished else {
        return Ok(playing.to_owned());
    };
    let file = playing.with_file_name(format!("{wished}.toml"));
    if name(&file) != Some(wished) || !file.is_file() {
        return Err(Error::new(format!(
            "there is no scenario `{wished}` beside {}; there are: {}",
            playing.display(),
            names(playing)?.join(", ")
        )));
    }
    Scenario::load(&file)?;
    Ok(file)
}

fn programme(file: &Path) -> Result<Programme> {
    Ok(Programme {
        playing: name(file).unwrap_or_default().to_owned(),
        choices: names(file)?,
    })
}

/// `None`: it has none that can be said.
fn name(file: &Path) -> Option<&str> {
    file.file_stem()?.to_str()
}

/// Of all files in the folder of this one that are scenarios.
fn names(file: &Path) -> Result<Vec<String>> {
    let folder = match file.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let entries = folder.read_dir().map_err(|error| {
        Error::from(error).context(format!("cannot look into {}", folder.display()))
    })?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let scenarios = paths.filter(|path| {
        path.extension()
            .is_some_and(|extension| extension == "toml")
            && Scenario::load(path).is_ok()
    });
    let mut names: Vec<_> = scenarios
        .filter_map(|path| name(&path).map(str::to_owned))
        .collect();
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedure::{Pending, Refused};

    const PLAYABLE: &str = "ends = 1.0\n[[assertion]]\nwhat = \"it is upright\"\nvalue = \"truth.tilt\"\nbelow = 1.0\n";

    /// A folder with two scenarios and something else.
    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| {
            std::fs::write(folder.path().join(name), text).expect("it is written");
        };
        write("push.toml", PLAYABLE);
        write("lean.toml", PLAYABLE);
        write("broken.toml", "ends = \"never\"\n");
        write("README.md", "none\n");
        folder
    }

    fn heard(pending: &Pending<Programme>) -> Result<Programme, Refused> {
        pending.try_answer().expect("it was answered")
    }

    #[test]
    fn who_asks_hears_what_is_played_and_what_might_be() {
        let folder = folder();
        let (caller, mut choice) = choice(&folder.path().join("push.toml"));
        assert_eq!(choice.answer(), None);
        let asked = caller.call(None);
        assert_eq!(choice.answer(), None);
        let programme = heard(&asked).expect("it is no secret");
        assert_eq!(programme.playing, "push");
        assert_eq!(programme.choices, ["lean", "push"]);
    }

    #[test]
    fn another_scenario_or_the_same_once_more_is_chosen_and_the_rest_waits_for_it() {
        let folder = folder();
        for name in ["lean", "push"] {
            let (caller, mut choice) = choice(&folder.path().join("push.toml"));
            let asked = caller.call(Some(name.to_owned()));
            let late = caller.call(None);
            let file = folder.path().join(name).with_extension("toml");
            assert_eq!(choice.answer(), Some(file));
            assert_eq!(heard(&asked).expect("it can be played").playing, name);
            drop(choice);
            assert!(heard(&late).is_err());
        }
    }

    #[test]
    fn what_cannot_be_played_is_refused_and_this_one_goes_on() {
        let folder = folder();
        let (caller, mut choice) = choice(&folder.path().join("push.toml"));
        for (wrong, why) in [
            ("pull", "there are: lean, push"),
            ("../push", "there is no scenario `../push`"),
            ("", "there is no scenario ``"),
            ("README", "there is no scenario `README`"),
            ("broken", "broken.toml"),
        ] {
            let asked = caller.call(Some(wrong.to_owned()));
            assert_eq!(choice.answer(), None);
            let refused = heard(&asked).expect_err("it cannot be played").to_string();
            assert!(refused.contains(why), "{refused}");
        }
    }
}
