//! `run`: generate, build, and become the robot's program.

mod cargo;
mod program;

use super::session::Session;
use super::{Failure, generate};
use crate::arguments;
use crate::diagnostics::{listed, nearest};
use crate::model::package;
use crate::outcome::{Outcome, Refusal};
use crate::resolve::robot::{Robot, Target};

pub(super) fn run(session: &mut Session<'_>, run: &arguments::Run) -> Result<Outcome, Failure> {
    let understood = session.understand()?;
    let target = choose_target(&understood.robot, run.target.as_deref())?;
    session.note_diagnostics();
    if session.diagnostics.has_errors() {
        return Ok(Outcome::Bad);
    }
    generate::write(session, &understood)?;
    let build = cargo::Build {
        root: session.workspace.root(),
        package: &package::library(&understood.robot),
        target: &target.name,
        profile: run.profile.as_deref(),
        target_dir: run.target_dir.as_deref(),
    };
    let Some(executable) = build.executable(session.terminal)? else {
        return Ok(Outcome::Bad);
    };
    let root = session.workspace.root();
    Err(program::become_robot(&executable, run, root).into())
}

/// The target of this name, or the first.
fn choose_target<'r>(robot: &'r Robot, name: Option<&str>) -> Result<&'r Target, Refusal> {
    let Some(name) = name else {
        return robot.targets.first().ok_or_else(|| {
            Refusal::bad("the robot has no target").help("add a `[[target]]` to hulk.toml")
        });
    };
    let names = || robot.targets.iter().map(|target| target.name.as_str());
    robot
        .targets
        .iter()
        .find(|target| target.name == name)
        .ok_or_else(|| {
            let list = format!("the targets are {}", listed(names()));
            Refusal::wrong_usage(format!("there is no target `{name}`")).help(
                match nearest(name, names()) {
                    Some(nearest) => format!("did you mean `{nearest}`? {list}"),
                    None => list,
                },
            )
        })
}

#[cfg(test)]
mod tests {
    use super::choose_target;
    use crate::graph::fixture;
    use crate::outcome::Outcome;

    #[test]
    fn the_first_target_is_the_default() {
        let robot = fixture::robot();
        assert_eq!(
            choose_target(&robot, None).map(|target| &*target.name),
            Ok("simulated")
        );
        assert_eq!(
            choose_target(&robot, Some("nao")).map(|target| &*target.name),
            Ok("nao")
        );
    }

    #[test]
    fn an_unknown_target_is_wrong_usage_and_lists_the_targets() {
        let robot = fixture::robot();
        let refusal = choose_target(&robot, Some("noa")).expect_err("there is none");
        assert_eq!(refusal.outcome, Outcome::WrongUsage);
        assert_eq!(
            refusal.help.as_deref(),
            Some("did you mean `nao`? the targets are `nao` and `simulated`")
        );
    }

    #[test]
    fn a_robot_without_targets_cannot_run() {
        let mut robot = fixture::robot();
        robot.targets.clear();
        let refusal = choose_target(&robot, None).expect_err("there is none");
        assert_eq!(refusal.outcome, Outcome::Bad);
    }
}
