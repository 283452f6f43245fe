//! `add-node`, `add-cycler`, `remove-node`, `rename-output`: changes to what people write, then the generated crate.
//!
//! The robot is looked at before and after the change. Nothing is written unless both are free of errors, and then
//! everything is written or nothing. Several of them at once wait for each other before they read; where an editor has
//! saved a file meanwhile, nothing is written.

use camino::Utf8PathBuf;
use serde_json::json;

use super::session::Session;
use super::{Failure, generate};
use crate::arguments::{AddCycler, AddNode, CyclerKind, RemoveNode, RenameOutput, TextOrJson};
use crate::diagnostics::{self, Code, Diagnostic, Diagnostics};
use crate::drift::{self, DriftError, Turn};
use crate::outcome::{Outcome, Refusal};
use crate::pipeline;
use crate::resolve::robot::Robot;
use crate::scaffold::{self, Changes, Leftovers};
use crate::workspace::Workspace;

/// What every answer ends with where there is none.
const UNTOUCHED: &str = "nothing was changed";

pub(super) fn add_node(session: &mut Session<'_>, add: &AddNode) -> Result<Outcome, Failure> {
    let turn = generate::turn(session)?;
    let robot = sound_robot(session)?;
    let node = scaffold::NewNode {
        path: &add.node,
        cycler: &add.cycler,
        setup: add.setup,
    };
    let changes = scaffold::add_node(&session.workspace, &robot, &node)?;
    let name = add.node.rsplit("::").next();
    let is_its = |file: &&Utf8PathBuf| file.extension() == Some("rs") && file.file_stem() == name;
    let written = changes.keys().find(is_its).cloned();
    let outcome = apply(session, &turn, changes, add.format)?;
    if let Some(file) = written
        && add.format == TextOrJson::Text
    {
        session.terminal.note(&format!(
            "next: write what it does into {file}, then `hulkgen generate`; `hulkgen diff` tells what changed\n"
        ));
    }
    Ok(outcome)
}

pub(super) fn add_cycler(session: &mut Session<'_>, add: &AddCycler) -> Result<Outcome, Failure> {
    let turn = generate::turn(session)?;
    let robot = sound_robot(session)?;
    let cycler = scaffold::NewCycler {
        name: &add.name,
        kind: match add.kind {
            CyclerKind::Perception => schema::CyclerKind::Perception,
            CyclerKind::RealTime => schema::CyclerKind::RealTime,
        },
        instances: &add.instances,
        setup_node: &add.setup_node,
    };
    let changes = scaffold::add_cycler(&session.workspace, &robot, &cycler)?;
    apply(session, &turn, changes, add.format)
}

pub(super) fn remove_node(
    session: &mut Session<'_>,
    remove: &RemoveNode,
) -> Result<Outcome, Failure> {
    let turn = generate::turn(session)?;
    let robot = sound_robot(session)?;
    let removal = scaffold::Removal {
        path: &remove.node,
        cycler: remove.cycler.as_deref(),
        delete: remove.delete,
    };
    let mut changes = scaffold::remove_node(&session.workspace, &robot, &removal)?;
    // What only this node read would be a mistake in the parameter files.
    let after = session.workspace.after(&changes);
    let mut found = Diagnostics::new();
    if pipeline::understand(&after, &mut found).is_ok() {
        changes.extend(scaffold::without_unread(&after, &found)?);
    }
    let after = session.workspace.after(&changes);
    let outcome = apply(session, &turn, changes, remove.format)?;
    if remove.delete {
        let leftovers = scaffold::still_named(&after, &robot.generated, &remove.node);
        session.terminal.note(&words(&leftovers, &remove.node));
    }
    let all = robot.cyclers.iter().flat_map(|cycler| &cycler.nodes);
    let entries: Vec<_> = all.filter(|node| node.path == remove.node).collect();
    if let [node] = entries[..]
        && !remove.delete
        && remove.format == TextOrJson::Text
    {
        session.terminal.note(&format!(
            "{} and its `mod` line stay: delete them when nobody wants the node back (`--delete` does so at once)\n",
            node.file
        ));
    }
    Ok(outcome)
}

/// What to do about all that names a module which is gone, one line each.
fn words(leftovers: &Leftovers, module: &str) -> String {
    let lines = leftovers.lines.iter().map(|(file, line)| {
        format!("{file}:{line}: this names `{module}`, which is gone; change it\n")
    });
    let generated = leftovers.generated.iter().map(|(folder, command)| {
        let way_out = match command {
            Some(command) if folder.starts_with("..") => {
                format!("`{command}` in the folder of its robot writes it anew")
            }
            Some(command) => format!("`{command}` writes it anew"),
            None => "write it anew or delete it".to_owned(),
        };
        format!("{folder}: this generated crate names `{module}`, which is gone; {way_out}\n")
    });
    lines.chain(generated).collect()
}

pub(super) fn rename_output(
    session: &mut Session<'_>,
    rename: &RenameOutput,
) -> Result<Outcome, Failure> {
    let turn = generate::turn(session)?;
    let robot = sound_robot(session)?;
    let Some((cycler, old)) = rename.output.split_once('.') else {
        let message = format!("`{}` is no output of a cycler", rename.output);
        return Err(Refusal::wrong_usage(message)
            .help("write `Cycler.output`")
            .into());
    };
    let asked = scaffold::Rename {
        cycler,
        old,
        new: &rename.new,
    };
    let renamed = scaffold::rename_output(&session.workspace, &robot, &asked)?;
    let outcome = apply(session, &turn, renamed.changes, rename.format)?;
    for (file, line) in renamed.unclear {
        session.terminal.note(&format!(
            "{file}:{line}: `.{old}` may be this output or something else; look at it\n"
        ));
    }
    Ok(outcome)
}

/// The robot before the change, which has no errors.
fn sound_robot(session: &mut Session<'_>) -> Result<Robot, Failure> {
    let understood = session.understand();
    match understood {
        Ok(understood) if !session.diagnostics.has_errors() => Ok(understood.robot),
        _ => {
            session.note_diagnostics();
            let message = format!("{UNTOUCHED}: the robot has errors");
            Err(Refusal::bad(message).help("mend them first").into())
        }
    }
}

/// Looks at the robot as it would be, and writes the changes with the generated crate.
fn apply(
    session: &mut Session<'_>,
    turn: &Turn,
    mut changes: Changes,
    format: TextOrJson,
) -> Result<Outcome, Failure> {
    let after = session.workspace.after(&changes);
    let mut found = Diagnostics::new();
    let understood = pipeline::understand(&after, &mut found);
    note_new(session, &found, &after);
    let understood = match understood {
        Ok(understood) if !found.has_errors() => understood,
        _ => {
            let message = format!("{UNTOUCHED}: the robot would have the errors above");
            let refusal = Refusal::bad(message);
            let reads = [Code::UnknownOutput, Code::UnknownInstance];
            let is_read = found.sorted().iter().any(|one| reads.contains(&one.code));
            return Err(match is_read {
                true => refusal.help("change what reads it first").into(),
                false => refusal.into(),
            });
        }
    };
    let files = generate::render(&after, &understood);
    let drift = generate::compare(turn, &understood, &files)?;
    let read = session.workspace.as_read(&changes);
    for (file, text) in &mut changes {
        *text = text.take().map(|text| session.workspace.marked(file, text));
    }
    changes.extend(drift.changes(&files));
    let answer = Answer::new(session, &changes);
    drift::write_all_in(turn, &changes, &read).map_err(|error| not_written(&error))?;
    match format {
        TextOrJson::Json => session.terminal.data(&answer.to_json())?,
        TextOrJson::Text => session.terminal.note(&answer.text()),
    }
    Ok(Outcome::Good)
}

fn not_written(error: &DriftError) -> Refusal {
    let refusal = generate::refusal(error);
    match error {
        DriftError::NotUndone { .. } => refusal,
        _ => Refusal {
            message: format!("{UNTOUCHED}: {}", refusal.message),
            ..refusal
        },
    }
}

/// Prints what the change brings; what was known before is no news.
fn note_new(session: &Session<'_>, found: &Diagnostics, after: &Workspace) {
    let known = session.diagnostics.sorted();
    let is_known = |one: &Diagnostic| {
        let same = |other: &Diagnostic| other.code == one.code && other.message == one.message;
        known.iter().any(|other| same(other))
    };
    let mut news = Diagnostics::new();
    for one in found.sorted().into_iter().filter(|one| !is_known(one)) {
        news.add(one.clone());
    }
    let color = session.terminal.colors_notes();
    let text = diagnostics::render(&news, after, color);
    session.terminal.note(&text);
}

/// Names of the files that were written, sorted.
struct Answer {
    added: Vec<String>,
    changed: Vec<String>,
    removed: Vec<String>,
}

impl Answer {
    fn new(session: &Session<'_>, changes: &Changes) -> Self {
        let mut answer = Self {
            added: Vec::new(),
            changed: Vec::new(),
            removed: Vec::new(),
        };
        for (path, text) in changes {
            let list = match (text, session.workspace.is_file(path)) {
                (None, _) => &mut answer.removed,
                (Some(_), true) => &mut answer.changed,
                (Some(_), false) => &mut answer.added,
            };
            list.push(path.to_string());
        }
        answer
    }

    /// One file a line: `+` new, `~` changed, `-` removed.
    fn text(&self) -> String {
        let mut lines: Vec<(&String, char)> = Vec::new();
        lines.extend(self.added.iter().map(|path| (path, '+')));
        lines.extend(self.changed.iter().map(|path| (path, '~')));
        lines.extend(self.removed.iter().map(|path| (path, '-')));
        lines.sort();
        lines
            .into_iter()
            .map(|(path, mark)| format!("{mark} {path}\n"))
            .collect()
    }

    fn to_json(&self) -> String {
        let answer = json!({
            "version": 1,
            "added": self.added,
            "changed": self.changed,
            "removed": self.removed,
        });
        format!("{answer}\n")
    }
}

#[cfg(test)]
mod tests;
