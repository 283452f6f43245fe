//! `run`: generate, build, and become the robot's program.

mod program;
mod watched;

use camino::{Utf8Path, Utf8PathBuf};

pub(super) use program::{absolute, become_robot, end_of_robot};

use super::cargo::{ForProcessor, OWN_PROFILE, Request};
use super::session::Session;
use super::{Failure, generate};
use crate::arguments;
use crate::diagnostics::{listed, nearest};
use crate::outcome::{Outcome, Refusal};
use crate::pipeline::Understood;
use crate::resolve::robot::{Robot, Target};

pub(super) fn run(session: &mut Session<'_>, run: &arguments::Run) -> Result<Outcome, Failure> {
    if run.watch {
        return watched::run(session, run);
    }
    let arguments = program::arguments(run)?;
    let wanted = Wanted::of(run);
    let Some(executable) = build(session, &wanted)? else {
        return Ok(Outcome::Bad);
    };
    let root = session.workspace.root();
    Err(become_robot(&executable, &arguments, root).into())
}

/// Which program.
pub(super) struct Wanted<'a> {
    /// `None`: the first.
    pub(super) target: Option<&'a str>,
    pub(super) build: &'a arguments::Build,
}

impl<'a> Wanted<'a> {
    fn of(run: &'a arguments::Run) -> Self {
        Self {
            target: run.target.as_deref(),
            build: &run.build,
        }
    }
}

/// A program that was built.
pub(super) struct Built {
    pub(super) executable: Utf8PathBuf,
    pub(super) target: String,
    /// `None`: the one of hulkgen itself.
    pub(super) profile: Option<String>,
    processor: ForProcessor,
    understood: Understood,
}

impl Built {
    /// Builds the program of the same name in another folder, but where this one was built.
    pub(super) fn request_elsewhere(&self) -> Result<Request<'_>, Refusal> {
        let robot = &self.understood.robot;
        let target = choose_target(robot, Some(&self.target))?;
        let profile = self.profile.as_deref().unwrap_or(OWN_PROFILE);
        let target_dir = target_dir(&self.executable).map(|folder| folder.as_str().into());
        let mut request = Request::build(robot, target, profile, target_dir);
        self.processor.apply(&mut request);
        Ok(request)
    }
}

/// The folder of what cargo builds, of a program in it: `target/release/program`.
fn target_dir(executable: &Utf8Path) -> Option<&Utf8Path> {
    executable.parent()?.parent()
}

/// Generates the robot's crate and builds a program that this machine can start; `None`: what is wrong was said.
pub(super) fn build(
    session: &mut Session<'_>,
    wanted: &Wanted<'_>,
) -> Result<Option<Utf8PathBuf>, Failure> {
    Ok(build_with(session, wanted)?.map(|built| built.executable))
}

/// As [`build`], with what it was built of.
pub(super) fn build_with(
    session: &mut Session<'_>,
    wanted: &Wanted<'_>,
) -> Result<Option<Built>, Failure> {
    let understood = session.understand()?;
    let target = choose_target(&understood.robot, wanted.target)?;
    refuse_other_machines(target)?;
    session.note_diagnostics();
    if session.diagnostics.has_errors() {
        return Ok(None);
    }
    let root = session.workspace.root();
    let processor = ForProcessor::of(root, None, target.cpu.as_deref())?;
    generate::write(session, &understood)?;
    let (name, profile) = (
        target.name.clone(),
        profile(wanted.build.profile.as_deref(), target),
    );
    let own = profile.map(str::to_owned);
    let profile = profile.unwrap_or(OWN_PROFILE);
    let target_dir = wanted.build.target_dir.as_deref().map(program::absolute);
    let mut request = Request::build(&understood.robot, target, profile, target_dir.transpose()?);
    processor.apply(&mut request);
    let said = request.said(session, session.terminal.colors_notes())?;
    session.diagnostics = said.diagnostics(session, &understood)?;
    session.note_diagnostics();
    if !said.success {
        return Ok(None);
    }
    let executable = said
        .executable
        .ok_or_else(|| Refusal::bad("cargo did not say where the program is"))?;
    Ok(Some(Built {
        executable,
        target: name,
        profile: own,
        processor,
        understood,
    }))
}

/// The target of this name, or the first.
pub(super) fn choose_target<'r>(
    robot: &'r Robot,
    name: Option<&str>,
) -> Result<&'r Target, Refusal> {
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
            let list = match robot.targets.as_slice() {
                [only] => format!("the only target is `{}`", only.name),
                _ => format!("the targets are {}", listed(names())),
            };
            Refusal::wrong_usage(format!("there is no target `{name}`")).help(
                match nearest(name, names()) {
                    Some(nearest) => format!("did you mean `{nearest}`? {list}"),
                    None => list,
                },
            )
        })
}

/// A target with a triple is built for another machine, so that its program cannot be started here.
fn refuse_other_machines(target: &Target) -> Result<(), Refusal> {
    let Some(triple) = &target.triple else {
        return Ok(());
    };
    let name = &target.name;
    Err(Refusal::bad(format!(
        "target `{name}` is for `{triple}`: `run` builds for this machine only"
    ))
    .help(format!(
        "run a target without a `triple`; `hulkgen build {name}` builds its program"
    )))
}

/// What is asked for, else what the target asks for.
pub(super) fn profile<'a>(asked: Option<&'a str>, target: &'a Target) -> Option<&'a str> {
    asked.or(target.profile.as_deref())
}

#[cfg(test)]
mod tests {
    use camino::Utf8Path;

    use super::{choose_target, profile, refuse_other_machines, target_dir};
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
    fn one_target_is_no_list() {
        let mut robot = fixture::robot();
        robot.targets.truncate(1);
        let refusal = choose_target(&robot, Some("moon")).expect_err("there is none");
        assert_eq!(
            refusal.help.as_deref(),
            Some("the only target is `simulated`")
        );
    }

    #[test]
    fn a_target_of_another_machine_is_not_run() {
        let mut target = fixture::robot().targets.remove(0);
        target.triple = None;
        assert_eq!(refuse_other_machines(&target), Ok(()));
        target.triple = Some("aarch64-unknown-linux-gnu".to_owned());
        let refusal = refuse_other_machines(&target).expect_err("it is for another machine");
        assert_eq!(refusal.outcome, Outcome::Bad);
        let message = "`run` builds for this machine only";
        assert!(refusal.message.ends_with(message), "{}", refusal.message);
    }

    #[test]
    fn the_profile_is_what_is_asked_for_or_the_targets() {
        let mut target = fixture::robot().targets.remove(0);
        target.profile = Some("nao".to_owned());
        assert_eq!(profile(None, &target), Some("nao"));
        assert_eq!(profile(Some("dev"), &target), Some("dev"));
        target.profile = None;
        assert_eq!(profile(None, &target), None);
    }

    #[test]
    fn the_folder_of_builds_is_that_of_the_profile_and_up() {
        let program = Utf8Path::new("/robot/target/release/simulated");
        assert_eq!(target_dir(program), Some(Utf8Path::new("/robot/target")));
    }

    #[test]
    fn a_robot_without_targets_cannot_run() {
        let mut robot = fixture::robot();
        robot.targets.clear();
        let refusal = choose_target(&robot, None).expect_err("there is none");
        assert_eq!(refusal.outcome, Outcome::Bad);
    }
}
