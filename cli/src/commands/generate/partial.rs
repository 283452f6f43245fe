//! `generate --only`: the robot of these cyclers, and how its crate joins the workspace.

use camino::Utf8Path;

use crate::arguments::Generate;
use crate::commands::session::Session;
use crate::diagnostics::suggestion;
use crate::manifest;
use crate::model::package;
use crate::outcome::Refusal;
use crate::partial::{self, UnknownCycler};
use crate::resolve::robot::Robot;

/// The robot of the cyclers that are asked for, with a folder that its crate may have.
pub(super) fn restrict(
    session: &Session<'_>,
    robot: &Robot,
    generate: &Generate,
) -> Result<Robot, Refusal> {
    let workspace = &session.workspace;
    let output = generate.output.as_deref().map(manifest::without_dots);
    let restricted = partial::restrict(workspace, robot, &generate.only, output.as_deref())
        .map_err(|unknown| unknown_cycler(robot, &unknown))?;
    let folder = &restricted.generated;
    if overlaps(folder, &robot.generated) {
        let message = format!("`{folder}` overlaps the folder of the whole robot's crate");
        return Err(Refusal::wrong_usage(message).help("name another folder with `--output`"));
    }
    let library = package::library(&restricted);
    let mistake =
        manifest::mistake_of_generated_folder(workspace, folder, &robot.parameters, &library);
    match mistake {
        Some(mistake) => {
            Err(Refusal::wrong_usage(mistake).help("name another folder with `--output`"))
        }
        None => Ok(restricted),
    }
}

/// Says what Cargo.toml lacks for cargo to build the crate and for others to name it.
pub(super) fn note_membership(session: &Session<'_>, robot: &Robot) {
    let members = session.workspace.members();
    if members.folders.contains(&robot.generated) {
        return;
    }
    let folder = members.below_own(&robot.generated);
    let library = package::library(robot);
    session.terminal.note(&format!(
        "`{folder}` is no member of the workspace yet; add to Cargo.toml\n  \
         \"{folder}\"  to `members` of [workspace]\n  \
         {library} = {{ path = \"{folder}\" }}  to [workspace.dependencies], for those who use it\n"
    ));
}

fn overlaps(one: &Utf8Path, other: &Utf8Path) -> bool {
    one.starts_with(other) || other.starts_with(one)
}

fn unknown_cycler(robot: &Robot, unknown: &UnknownCycler) -> Refusal {
    let refusal = Refusal::wrong_usage(format!("there is no cycler `{}`", unknown.name));
    if let Some(cycler) = &unknown.of_instance {
        let help = format!("it is an instance of `{cycler}`, which is taken whole: name that");
        return refusal.help(help);
    }
    let names = robot.cyclers.iter().map(|cycler| cycler.name.as_str());
    refusal.help(suggestion(&unknown.name, names, "the robot has"))
}
