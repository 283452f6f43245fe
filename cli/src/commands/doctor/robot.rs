//! The robot: whether it is found, right, generated, and can be built for its targets.

use camino::Utf8Path;

use super::Finding;
use super::machine::{self, answer};
use crate::commands::session::Session;
use crate::commands::{generate, plural};
use crate::cross;
use crate::diagnostics::{Diagnostics, Severity};
use crate::drift::Drift;
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
    findings.push(robot(&session.diagnostics));
    findings.push(lock(&session.workspace));
    if let Ok(understood) = understood {
        findings.push(generated(&session.workspace, &understood));
        let targets = &understood.robot.targets;
        if targets.iter().any(|target| target.triple.is_some()) {
            findings.push(machine::pip(&cross::python(), session.workspace.root()));
        }
        findings.extend(
            (understood.robot.targets.iter()).filter_map(|it| target(session.workspace.root(), it)),
        );
    }
    findings
}

fn robot(found: &Diagnostics) -> Finding {
    let about = "robot";
    let count = |severity| {
        let all = found.sorted().into_iter();
        all.filter(|one| one.severity() == severity).count()
    };
    let help = "`hulkgen check` shows what and where";
    match (count(Severity::Error), count(Severity::Warning)) {
        (0, 0) => Finding::ok(about, "manifest, nodes and parameter files are right"),
        (0, warnings) => Finding::warning(about, plural(warnings, "warning"), help),
        (errors, _) => Finding::bad(about, plural(errors, "error"), help),
    }
}

/// Without it every machine builds with whatever versions it finds that day.
fn lock(workspace: &Workspace) -> Finding {
    let about = "lock";
    let file = workspace.below_cargo_root(Utf8Path::new("Cargo.lock"));
    if workspace.is_file(&file) {
        return Finding::ok(about, format!("`{file}` is there"));
    }
    let message = format!("`{file}` is missing: two builds may use different crates");
    let help = "run `cargo generate-lockfile` and commit the file";
    Finding::warning(about, message, help)
}

fn generated(workspace: &Workspace, understood: &Understood) -> Finding {
    let about = "generated";
    let folder = &understood.robot.generated;
    let files = generate::render(workspace, understood);
    match Drift::compare(workspace.root(), folder, &files) {
        Ok(drift) if drift.is_empty() => Finding::ok(about, format!("`{folder}` is current")),
        Ok(_) if workspace.list(folder).is_empty() => {
            let message = format!("`{folder}` is missing");
            Finding::bad(about, message, "run `hulkgen generate`")
        }
        Ok(_) => {
            let message = format!("`{folder}` is not what would be generated now");
            Finding::bad(about, message, "run `hulkgen generate`")
        }
        Err(error) => {
            let refusal = generate::refusal(&error);
            let help = refusal.help.as_deref().unwrap_or("run `hulkgen generate`");
            Finding::bad(about, refusal.message, help)
        }
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
