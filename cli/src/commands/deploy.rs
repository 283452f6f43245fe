//! `deploy`: the program of a target onto robots, all at once; and what the other commands for robots share.

mod logs;
mod one;
mod pull;
mod reached;
mod robots;

use std::env;
use std::sync::mpsc;
use std::thread;

use camino::{Utf8Path, Utf8PathBuf};
use serde_json::json;

use super::Failure;
use super::cargo::OWN_PROFILE;
use super::session::Session;
use crate::arguments::{self, TextOrJson};
use crate::deploy::{Contents, Package};
use crate::manifest::absent_files;
use crate::outcome::{Outcome, Refusal};
use one::{Deed, Done};
use reached::{Reached, Robot};

pub(super) use logs::logs;
pub(super) use pull::pull;
pub(super) use reached::remote;
pub(super) use robots::robots;

/// Where cargo builds, if not in the workspace.
const TARGET_FOLDER: &str = "CARGO_TARGET_DIR";

pub(super) fn deploy(
    session: &mut Session<'_>,
    deploy: &arguments::Deploy,
) -> Result<Outcome, Failure> {
    let reached = Reached::read(session, &deploy.reached)?;
    let robots = reached.different_robots(&deploy.hosts)?;
    if deploy.wlan.is_some() && reached.deploy.wlan.is_none() {
        return Err(Refusal::wrong_usage("the manifest does not say how a robot joins a network")
            .help("add `wlan = \"nmcli connection up {name}\"`, or what your robot's system has, to `[target.deploy]`")
            .into());
    }
    let package = match deploy.rollback {
        true => None,
        false => Some(collect(session, &reached, deploy)?),
    };
    let deeds = (robots.iter())
        .map(|robot| {
            let options = options(&robots, robot, deploy)?;
            let for_robot = package
                .as_ref()
                .map(|package| package.for_robot(&options))
                .transpose()?;
            Ok(Deed {
                remote: &robot.remote,
                deploy: &reached.deploy,
                package: package.as_ref().zip(for_robot),
                discards_changes: deploy.discard_changes,
                wlan: deploy.wlan.as_deref(),
            })
        })
        .collect::<Result<Vec<_>, Refusal>>()?;
    let results = side_by_side(session, &robots, &deeds, |deed, say| deed.execute(say));
    let is_good = results.iter().all(Result::is_ok);
    session.terminal.data(&match deploy.format {
        TextOrJson::Text => text(&robots, &results),
        TextOrJson::Json => {
            let robots: Vec<_> = robots
                .iter()
                .zip(&results)
                .map(|(robot, result)| told(robot, result))
                .collect();
            format!("{}\n", json!({ "version": 1, "robots": robots }))
        }
    })?;
    Ok(if is_good { Outcome::Good } else { Outcome::Bad })
}

fn collect(
    session: &Session<'_>,
    reached: &Reached,
    deploy: &arguments::Deploy,
) -> Result<Package, Refusal> {
    let root = session.workspace.root();
    let program = match &deploy.program {
        Some(program) => program.clone(),
        None => built(target_folder(session)?, reached),
    };
    if let Some((key, file)) = absent_files(&session.workspace, &reached.deploy).first() {
        return Err(
            Refusal::bad(format!("`{file}` is to be sent and is not there")).help(format!(
                "look at `{key}` in `[target.deploy]` of hulk.toml: `hulkgen check` shows the line"
            )),
        );
    }
    let mut files = vec![reached.parameters.as_str()];
    files.extend(reached.deploy.files.iter().map(String::as_str));
    Package::collect(&Contents {
        root,
        program: &program,
        name: reached.target.name.as_str(),
        files,
        unit: reached.deploy.unit.as_deref(),
    })
}

/// Where cargo builds: the folder that the environment names, as it does for cargo, else that of the workspace.
fn target_folder(session: &Session<'_>) -> Result<Utf8PathBuf, Refusal> {
    match env::var(TARGET_FOLDER) {
        Ok(folder) if !folder.is_empty() => camino::absolute_utf8(&folder)
            .map_err(|error| Refusal::bad(format!("cannot use {TARGET_FOLDER}={folder}: {error}"))),
        _ => {
            let below = session.workspace.below_cargo_root(Utf8Path::new("target"));
            Ok(session.workspace.root().join(below))
        }
    }
}

/// Where cargo puts the target's program; what stands behind the triple's second dot is a version of glibc.
fn built(target_folder: Utf8PathBuf, reached: &Reached) -> Utf8PathBuf {
    let target = &reached.target;
    let mut folder = target_folder;
    if let Some(triple) = &target.triple {
        folder.push(triple.split('.').next().unwrap_or(triple));
    }
    let profile = target.profile.as_deref().unwrap_or(match target.triple {
        Some(_) => "release",
        None => OWN_PROFILE,
    });
    folder.push(if profile == "dev" { "debug" } else { profile });
    folder.join(target.name.as_str())
}

/// What the program is started with on one robot: `--set` without a robot's name is for all.
fn options(
    robots: &[Robot],
    robot: &Robot,
    deploy: &arguments::Deploy,
) -> Result<Vec<String>, Refusal> {
    let mut options = Vec::new();
    if let Some(location) = &deploy.location {
        options.extend(["--location".to_owned(), location.clone()]);
    }
    for setting in &deploy.set {
        let (path, _) = setting.split_once('=').ok_or_else(|| {
            Refusal::wrong_usage(format!("`--set {setting}` gives no value"))
                .help("write PATH=VALUE, or HOST:PATH=VALUE for one robot")
        })?;
        let setting = match path.rsplit_once(':') {
            None => setting.as_str(),
            Some((host, _)) if host == robot.remote.name => &setting[host.len() + 1..],
            Some((host, _)) if robots.iter().any(|other| other.remote.name == host) => continue,
            Some((host, _)) => {
                return Err(Refusal::wrong_usage(format!(
                    "`--set {setting}` is for `{host}`, which is not served"
                ))
                .help("name it as it is among the robots of this command"));
            }
        };
        options.extend(["--set".to_owned(), setting.to_owned()]);
    }
    options.extend(deploy.option.iter().cloned());
    Ok(options)
}

/// Does something for every robot at once and shows how far each is; answers in the order of the robots.
fn side_by_side<D: Sync, A: Send>(
    session: &Session<'_>,
    robots: &[Robot],
    deeds: &[D],
    execute: impl Fn(&D, &mut dyn FnMut(String)) -> A + Sync,
) -> Vec<A> {
    let (sender, receiver) = mpsc::channel::<(usize, String)>();
    let execute = &execute;
    thread::scope(|scope| {
        let workers: Vec<_> = deeds
            .iter()
            .enumerate()
            .map(|(index, deed)| {
                let sender = sender.clone();
                scope.spawn(move || {
                    // Nobody is told once the terminal is gone.
                    execute(deed, &mut |said| drop(sender.send((index, said))))
                })
            })
            .collect();
        drop(sender);
        for (index, said) in receiver {
            session
                .terminal
                .note(&format!("{}: {said}\n", robots[index].remote.name));
        }
        let answers = workers
            .into_iter()
            .map(|worker| worker.join().expect("a worker does not panic"));
        answers.collect()
    })
}

fn text(robots: &[Robot], results: &[Result<Done, Refusal>]) -> String {
    let lines = robots.iter().zip(results).map(|(robot, result)| {
        let name = &robot.remote.name;
        match result {
            Ok(Done {
                version,
                before,
                state,
            }) => {
                let before = before
                    .as_deref()
                    .map(|it| format!(", before {it}"))
                    .unwrap_or_default();
                format!("{name}: {version} {state}{before}\n")
            }
            Err(refusal) => {
                let help = refusal
                    .help
                    .as_deref()
                    .map(|it| format!("  help: {it}\n"))
                    .unwrap_or_default();
                format!("{name}: failed: {}\n{help}", refusal.message)
            }
        }
    });
    lines.collect()
}

fn told(robot: &Robot, result: &Result<Done, Refusal>) -> serde_json::Value {
    let name = &robot.remote.name;
    match result {
        Ok(Done {
            version,
            before,
            state,
        }) => json!({
            "host": name, "is_done": true, "version": version, "before": before, "state": state,
        }),
        Err(refusal) => json!({
            "host": name, "is_done": false, "message": refusal.message, "help": refusal.help,
        }),
    }
}
