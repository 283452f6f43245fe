//! `new`: a workspace that generates, builds, tests and runs at once.

use camino::{Utf8Path, Utf8PathBuf};
use serde_json::json;

use super::terminal::Terminal;
use super::{Failure, generate, plural};
use crate::arguments::{New, Template, TextOrJson};
use crate::deploy::script::as_a_word;
use crate::diagnostics::{self, Diagnostics};
use crate::drift;
use crate::outcome::{Outcome, Refusal};
use crate::pipeline;
use crate::scaffold::{self, Changes, Framework, NewRobot};
use crate::workspace::Workspace;

/// Where hulkgen was built; a framework stands beside it as long as that checkout does.
const BUILT_IN: &str = env!("CARGO_MANIFEST_DIR");

/// What the robot of the template `nao` is called; its tests use `nao_runtime`.
const NAO: &str = "nao";

pub(super) fn run(terminal: &Terminal, new: &New) -> Result<Outcome, Failure> {
    let current = current_folder()?;
    let folder = current.join(&new.path);
    refuse_occupied(&folder, &new.path)?;
    let built_in = Utf8Path::new(BUILT_IN);
    let built_from = built_in.parent().unwrap_or(built_in);
    let framework = Framework::choose(new.framework.as_deref(), built_from, &current, &folder)?;
    let beside = Framework::choose(None, built_from, &current, &folder).ok();
    let checkout = [Some(&framework), beside.as_ref()];
    let checkout = checkout.into_iter().flatten().find_map(|one| match one {
        Framework::Checkout { root, .. } => Some(root.as_path()),
        Framework::Version(_) => None,
    });
    let name = name(new, &folder)?;
    let robot = NewRobot {
        name: &name,
        template: match new.template {
            Template::Blank => scaffold::Template::Blank,
            Template::Nao => scaffold::Template::Nao,
        },
        framework: &framework,
        checkout,
    };
    let files = with_generated(terminal, scaffold::new_robot(&robot)?)?;
    drift::write_all(&folder, &files).map_err(|error| generate::refusal(&error))?;
    match new.format {
        TextOrJson::Json => terminal.data(&to_json(&name, &folder, &files))?,
        TextOrJson::Text => terminal.note(&format!(
            "`{}` has {}; next: cd {} && hulkgen run\n",
            new.path,
            plural(files.len(), "file"),
            as_a_word(new.path.as_str())
        )),
    }
    Ok(Outcome::Good)
}

/// The files with those of the generated crate, whose robot is seen through all stages in memory.
fn with_generated(terminal: &Terminal, mut files: Changes) -> Result<Changes, Failure> {
    let texts = files
        .iter()
        .filter_map(|(path, text)| Some((path.clone(), text.clone()?)));
    let workspace = Workspace::in_memory(texts);
    let mut found = Diagnostics::new();
    let understood = pipeline::understand(&workspace, &mut found);
    match understood {
        Ok(understood) if !found.has_errors() => {
            let generated = generate::render(&workspace, &understood);
            files.extend(generated.into_iter().map(|(path, text)| (path, Some(text))));
            Ok(files)
        }
        _ => {
            let color = terminal.colors_notes();
            terminal.note(&diagnostics::render(&found, &workspace, color));
            let message = "nothing was written: the template has errors";
            Err(Refusal::bad(message)
                .help("mend them in the checkout that it is copied from")
                .into())
        }
    }
}

fn current_folder() -> Result<Utf8PathBuf, Refusal> {
    let current = std::env::current_dir()
        .map_err(|error| Refusal::bad(format!("cannot tell the current folder: {error}")))?;
    Utf8PathBuf::try_from(current)
        .map_err(|error| Refusal::bad(format!("the current folder's name is no UTF-8: {error}")))
}

fn refuse_occupied(folder: &Utf8Path, asked: &Utf8Path) -> Result<(), Refusal> {
    let is_file = folder
        .parent()
        .zip(folder.file_name())
        .is_some_and(|(above, name)| Workspace::at_root(above).is_file(Utf8Path::new(name)));
    let inside = Workspace::at_root(folder).list(Utf8Path::new(""));
    let refusal = if is_file {
        format!("`{asked}` is a file")
    } else if let Some(first) = inside.first() {
        format!("the folder `{asked}` is not empty: there is `{first}`")
    } else {
        return Ok(());
    };
    Err(Refusal::wrong_usage(refusal).help("name a folder that does not exist or is empty"))
}

/// The robot's name: what is asked for, else that of the folder.
fn name(new: &New, folder: &Utf8Path) -> Result<String, Refusal> {
    let name = match (new.name.as_deref(), new.template) {
        (None | Some(NAO), Template::Nao) => return Ok(NAO.to_owned()),
        (Some(other), Template::Nao) => {
            let message = format!(
                "the robot of the template `nao` is called `{NAO}`, not `{other}`: its own crates name it so"
            );
            return Err(Refusal::wrong_usage(message)
                .help("leave out `--name`; the folder may have any name"));
        }
        (Some(name), Template::Blank) => name.to_owned(),
        (None, Template::Blank) => {
            let name = folder.file_name().unwrap_or_default().to_lowercase();
            name.replace(['-', ' ', '.'], "_")
        }
    };
    name.parse::<schema::RobotName>()
        .map_err(|error| Refusal::wrong_usage(error.to_string()).help("give `--name NAME`"))?;
    Ok(name)
}

fn to_json(name: &str, folder: &Utf8Path, files: &Changes) -> String {
    let files: Vec<&str> = files.keys().map(|path| path.as_str()).collect();
    let answer = json!({ "version": 1, "robot": name, "folder": folder.as_str(), "files": files });
    format!("{answer}\n")
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::*;
    use crate::arguments::{Arguments, Command};

    #[test]
    fn the_nao_has_its_name_whether_it_is_said_or_not() {
        let named = |words: &[&str]| {
            let line = ["hulkgen", "new", "team", "--template"];
            let line = line.iter().chain(words);
            let parsed = Arguments::try_parse_from(line).expect("it is right usage");
            let Command::New(new) = parsed.command else {
                panic!("it is `new`")
            };
            name(&new, Utf8Path::new("/teams/team"))
        };
        assert_eq!(named(&["nao"]), Ok("nao".to_owned()));
        assert_eq!(named(&["nao", "--name", "nao"]), Ok("nao".to_owned()));
        let refusal = named(&["nao", "--name", "other"]).expect_err("it has a name");
        assert!(refusal.message.contains("not `other`"), "{refusal:?}");
        assert!(refusal.help.is_some_and(|help| help.contains("any name")));
        assert_eq!(named(&["blank"]), Ok("team".to_owned()));
        assert_eq!(named(&["blank", "--name", "nao"]), Ok("nao".to_owned()));
    }

    #[test]
    fn a_path_with_spaces_can_be_copied_into_a_shell() {
        assert_eq!(as_a_word("../my_robot"), "../my_robot");
        assert_eq!(as_a_word("my robot"), "'my robot'");
    }
}
