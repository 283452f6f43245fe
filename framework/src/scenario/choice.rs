//! Which scenario is played: who watches one may choose another that lies beside it, or the same once more:
//! `framework.procedures.scenario`.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::file::Scenario;
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
        loop {
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
    }
}

/// Where the scenario of this name stands, beside this one.
///
/// # Errors
/// Where there is none of this name, or it cannot be read: then this one had better go on.
fn file_of(playing: &Path, name: Option<&str>) -> Result<PathBuf> {
    let Some(name) = name else {
        return Ok(playing.to_owned());
    };
    let names = names(playing)?;
    if !names.iter().any(|known| known == name) {
        return Err(Error::new(format!(
            "there is no scenario `{name}` beside {}; there are: {}",
            playing.display(),
            names.join(", ")
        )));
    }
    let file = playing.with_file_name(format!("{name}.toml"));
    Scenario::load(&file)?;
    Ok(file)
}

fn programme(file: &Path) -> Result<Programme> {
    Ok(Programme {
        playing: name(file),
        choices: names(file)?,
    })
}

fn name(file: &Path) -> String {
    file.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

/// Of all scenarios in the folder of this one; whether they can be played is not looked at.
fn names(file: &Path) -> Result<Vec<String>> {
    let folder = match file.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let unreadable = |error: std::io::Error| {
        Error::from(error).context(format!("cannot look into {}", folder.display()))
    };
    let mut names = Vec::new();
    for entry in folder.read_dir().map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            names.push(name(&path));
        }
    }
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
        write("ball.toml", PLAYABLE);
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
        assert_eq!(programme.choices, ["ball", "broken", "push"]);
    }

    #[test]
    fn another_scenario_or_the_same_once_more_is_chosen_and_the_rest_waits_for_it() {
        let folder = folder();
        for name in ["ball", "push"] {
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
            ("pull", "there are: ball, broken, push"),
            ("../push", "there is no scenario `../push`"),
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
