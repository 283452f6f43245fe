//! The robot: whether it is found, right, generated, and can be built for its targets.

use camino::Utf8Path;

use super::machine::answer;
use super::{Finding, State};
use crate::commands::session::Session;
use crate::commands::{Failure, generate, plural};
use crate::outcome::Refusal;
use crate::pipeline::Understood;
use crate::resolve::robot::Target;
use crate::workspace::Workspace;

/// What can be looked at; after something bad there may be nothing more to see.
pub(super) fn look(session: &mut Result<Session<'_>, Refusal>) -> Vec<Finding> {
    let session = match session {
        Ok(session) => session,
        Err(refusal) => {
            let help = "go to the folder of a robot, or name it with `--manifest PATH`";
            let help = refusal.help.as_deref().unwrap_or(help);
            return vec![Finding::bad("workspace", &refusal.message, help)];
        }
    };
    let root = session.workspace.root().to_string();
    let mut findings = vec![Finding::ok("workspace", root)];
    let understood = session.understand();
    let has_errors = session.diagnostics.has_errors();
    findings.push(if has_errors {
        let number = session.diagnostics.sorted().len();
        let message = plural(number, "diagnostic");
        Finding::bad("robot", message, "`hulkgen check` shows them")
    } else {
        Finding::ok("robot", "manifest, nodes and parameter files are right")
    });
    if let Ok(understood) = understood {
        findings.push(generated(&session.workspace, &understood));
        findings.extend(
            (understood.robot.targets.iter()).filter_map(|it| target(session.workspace.root(), it)),
        );
    }
    findings
}

fn generated(workspace: &Workspace, understood: &Understood) -> Finding {
    let about = "generated";
    let folder = &understood.robot.generated;
    let files = generate::render(workspace, understood);
    match generate::compare(workspace.root(), understood, &files) {
        Ok(drift) if drift.is_empty() => Finding::ok(about, format!("`{folder}` is current")),
        Ok(_) => {
            let message = format!("`{folder}` is not what would be generated now");
            Finding::bad(about, message, "run `hulkgen generate`")
        }
        Err(Failure::Refused(refusal)) => Finding {
            state: State::Bad,
            help: refusal.help,
            ..Finding::ok(about, refusal.message)
        },
        Err(Failure::Reported) => Finding::bad(about, "has errors", "run `hulkgen check`"),
    }
}

/// Whether Rust's libraries for the target's triple are installed; None: it runs on this machine.
fn target(root: &Utf8Path, target: &Target) -> Option<Finding> {
    let about = "target";
    let name = &target.name;
    // Behind the triple may stand a version of glibc.
    let triple = target.triple.as_deref()?.split('.').next()?;
    let folder = answer(
        "rustc",
        &["--print", "target-libdir", "--target", triple],
        root,
    );
    let is_there = folder.is_some_and(|folder| {
        let files = Workspace::at_root(folder.as_str().into()).list("".into());
        !files.is_empty()
    });
    Some(if is_there {
        Finding::ok(about, format!("`{name}`: {triple} is installed"))
    } else {
        let message = format!("`{name}`: {triple} is not installed");
        let help = format!("run `rustup target add {triple}`");
        Finding::warning(about, message, help)
    })
}
