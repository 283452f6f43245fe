//! `diff`: what changed in the graph since a git revision.

use serde_json::{Value, json};

use super::session::Session;
use super::{Failure, plural};
use crate::arguments::{Diff, TextOrJson};
use crate::diagnostics::{Diagnostics, Severity};
use crate::graph::difference::{Both, Changes, Difference, Move};
use crate::graph::{self, Graph, listed};
use crate::manifest;
use crate::outcome::{Outcome, Refusal};
use crate::pipeline;
use crate::workspace::{Missing, RevisionError, Workspace};

/// One of the two robots.
struct Side {
    /// None: there are errors.
    whole: Option<Graph>,
    /// What can be said of it even then.
    listed: Graph,
    errors: usize,
}

pub(super) fn run(session: &mut Session<'_>, diff: &Diff) -> Result<Outcome, Failure> {
    let revision = diff.revision.as_str();
    let earlier = session.workspace.at_revision(revision).map_err(refusal)?;
    let before = Side::of(&earlier);
    if let Some(link) = earlier.broken_link() {
        let message = format!("the robot of `{revision}` cannot be read: {link}");
        let help = "name a revision that has the file itself, or a link to one of its own";
        return Err(Refusal::wrong_usage(message).help(help).into());
    }
    let Some(before) = before else {
        let message = format!("the hulk.toml of `{revision}` cannot be read, or there is none");
        return Err(Refusal::wrong_usage(message).into());
    };
    let Some(after) = Side::of(&session.workspace) else {
        let message = "hulk.toml cannot be read";
        let refusal = Refusal::bad(message).help("`hulkgen check` says what is wrong with it");
        return Err(refusal.into());
    };
    let difference = match (&before.whole, &after.whole) {
        (Some(before), Some(after)) => Difference::between(before, after),
        _ => Difference::of_manifests(&before.listed, &after.listed),
    };
    for (side, name) in [(&before, format!("`{revision}`")), (&after, "now".into())] {
        if side.errors > 0 {
            let errors = plural(side.errors, "error");
            let note = format!(
                "the robot of {name} has {errors}: only targets, cyclers and nodes are compared\n"
            );
            session.terminal.note(&note);
        }
    }
    session.terminal.data(&match diff.format {
        TextOrJson::Text => {
            let is_whole = before.whole.is_some() && after.whole.is_some();
            text(revision, &difference, is_whole)
        }
        TextOrJson::Json => format!("{}\n", to_json(revision, &before, &after, &difference)),
    })?;
    Ok(Outcome::Good)
}

impl Side {
    /// As much of the robot as can be understood; None without a manifest.
    fn of(workspace: &Workspace) -> Option<Self> {
        let manifest = manifest::load(workspace, &mut Diagnostics::new()).ok()?;
        let mut diagnostics = Diagnostics::new();
        let understood = pipeline::understand(workspace, &mut diagnostics).ok();
        let whole = understood.map(|it| graph::describe(&it.robot, &it.schedule));
        let errors = diagnostics.sorted().into_iter();
        let errors = errors.filter(|one| one.severity() == Severity::Error);
        Some(Self {
            // Mistakes in parameter files are none of the graph.
            errors: if whole.is_some() { 0 } else { errors.count() },
            listed: listed::describe(&manifest),
            whole,
        })
    }
}

fn refusal(error: RevisionError) -> Failure {
    let refusal = Refusal::wrong_usage(error.to_string());
    Failure::Refused(match error {
        RevisionError::NoGit { .. } => refusal.help("install git"),
        RevisionError::Unreadable { missing, .. } => refusal.help(match missing {
            Missing::Repository => {
                "put the robot into git: `git init && git add --all && git commit`"
            }
            Missing::Commits => "nothing is committed yet: `git add --all && git commit`",
            Missing::Revision => "name a commit, branch or tag of this repository",
        }),
    })
}

/// What changed; `is_whole`: both robots are without errors, so everything was compared.
fn text(revision: &str, difference: &Difference, is_whole: bool) -> String {
    if difference.is_empty() && is_whole {
        return format!("the graph is that of `{revision}`\n");
    }
    if difference.is_empty() {
        return format!(
            "name, targets, cyclers and nodes are those of `{revision}`; the rest is not compared\n"
        );
    }
    let mut text = String::new();
    if let Some(Both { before, after }) = &difference.robot {
        text.push_str(&format!("robot\n  ~ {after}\n      was {before}\n"));
    }
    for (aspect, order) in [
        ("order of targets", &difference.target_order),
        ("order of cyclers", &difference.cycler_order),
    ] {
        if let Some(Both { before, after }) = order {
            let (before, after) = (before.join(", "), after.join(", "));
            text.push_str(&format!("{aspect}\n  ~ {after}\n      was {before}\n"));
        }
    }
    for (aspect, changes) in difference.aspects() {
        if !changes.is_empty() {
            text.push_str(&format!("{aspect}\n{}", lines(changes)));
        }
    }
    if !difference.order.is_empty() {
        text.push_str("order\n");
    }
    text.extend(difference.order.iter().map(move_line));
    text
}

fn lines(changes: &Changes) -> String {
    let mut text = String::new();
    for item in &changes.added {
        text.push_str(&format!("  + {}: {}\n", item.name, item.text));
    }
    for item in &changes.removed {
        text.push_str(&format!("  - {}: {}\n", item.name, item.text));
    }
    for changed in &changes.changed {
        let (before, after) = (&changed.before, &changed.after);
        text.push_str(&format!(
            "  ~ {}: {}\n      was {}\n",
            after.name, after.text, before.text
        ));
    }
    text
}

fn move_line(moved: &Move) -> String {
    let Move { cycler, node, .. } = moved;
    let (before, after) = (moved.before, moved.after);
    let behind = moved.behind.as_ref();
    let behind = behind.map_or("first".to_owned(), |node| format!("behind {node}"));
    format!("  ~ {node} of {cycler} runs {behind}, as {after}, was {before}\n")
}

fn to_json(revision: &str, before: &Side, after: &Side, difference: &Difference) -> Value {
    let mut answer = json!({
        "version": 1,
        "revision": revision,
        "before": side_to_json(before),
        "after": side_to_json(after),
    });
    let difference = serde_json::to_value(difference).expect("a difference has only string keys");
    if let (Value::Object(answer), Value::Object(difference)) = (&mut answer, difference) {
        answer.extend(difference);
    }
    answer
}

fn side_to_json(side: &Side) -> Value {
    let hash = side.whole.as_ref().map(|graph| graph.hash.as_str());
    json!({ "hash": hash, "errors": side.errors })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_compared_is_not_said_to_be_the_same() {
        let same = Difference::default();
        assert_eq!(text("main", &same, true), "the graph is that of `main`\n");
        assert_eq!(
            text("main", &same, false),
            "name, targets, cyclers and nodes are those of `main`; the rest is not compared\n"
        );
        let order = |first: &str, second: &str| vec![first.to_owned(), second.to_owned()];
        let other = Difference {
            robot: Some(Both {
                before: "a".to_owned(),
                after: "b".to_owned(),
            }),
            cycler_order: Some(Both {
                before: order("A", "B"),
                after: order("B", "A"),
            }),
            ..same
        };
        assert_eq!(
            text("main", &other, true),
            "robot\n  ~ b\n      was a\norder of cyclers\n  ~ B, A\n      was A, B\n"
        );
    }
}
