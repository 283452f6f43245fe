//! A robot of some of its cyclers: between stages ④ and ⑤, from [`Robot`] to [`Robot`].
//!
//! Invariant: with all cyclers named nothing of what runs differs from the whole robot.

use camino::{Utf8Path, Utf8PathBuf};
use schema::snake_case;

use crate::resolve;
use crate::resolve::robot::{Cycler, Partial, Robot};
use crate::workspace::Workspace;

/// The robot has no cycler of this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownCycler {
    pub name: String,
    /// The cycler that has an instance of this name.
    pub of_instance: Option<String>,
}

/// The robot with only the cyclers of these names, in whatever order and however often they are named.
///
/// `output` is the folder of its crate; without it the folder follows from the names.
///
/// # Errors
/// For the first name that is no cycler's.
pub fn restrict(
    workspace: &Workspace,
    robot: &Robot,
    names: &[String],
    output: Option<&Utf8Path>,
) -> Result<Robot, UnknownCycler> {
    let mut robot = robot.clone();
    let unknown = |name: &&String| robot.cyclers.iter().all(|cycler| cycler.name != **name);
    if let Some(name) = names.iter().find(unknown) {
        return Err(unknown_cycler(&robot, name));
    }
    // Which of its cyclers run where it runs is what was asked for, whatever other machine the manifest has them run on.
    let cyclers = robot.cyclers.iter_mut();
    cyclers.for_each(|cycler| cycler.remote = false);
    resolve::leave_out(&mut robot, |cycler| !names.contains(&cycler.name));
    let only: Vec<String> = robot
        .running()
        .map(|(_, cycler)| cycler.name.clone())
        .collect();
    let default = default_folder(&robot.generated, &only);
    let output = output.filter(|output| *output != default);
    robot.generated = output.map_or(default, Utf8Path::to_owned);
    robot.partial = Some(Partial {
        only,
        output: output.map(Utf8Path::to_owned),
    });
    // Whoever uses it brings the hardware.
    robot.targets.clear();
    robot.bridges.clear();
    robot.crates = resolve::dependencies(workspace, &robot);
    Ok(robot)
}

/// `generated-vision-control` beside `generated`.
fn default_folder(generated: &Utf8Path, only: &[String]) -> Utf8PathBuf {
    let names = only.iter().map(|name| format!("-{}", snake_case(name)));
    format!("{generated}{}", names.collect::<String>()).into()
}

fn unknown_cycler(robot: &Robot, name: &str) -> UnknownCycler {
    let has = |cycler: &&Cycler| cycler.instances.iter().any(|one| one.name == name);
    let of_instance = robot.cyclers.iter().find(has);
    UnknownCycler {
        name: name.to_owned(),
        of_instance: of_instance.map(|cycler| cycler.name.clone()),
    }
}
