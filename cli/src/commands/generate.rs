//! `generate`: the generated crate on disk, or what would change.

mod partial;

use camino::Utf8Path;
use camino::Utf8PathBuf;
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::session::Session;
use super::{Failure, plural};
use crate::arguments::{Generate, TextOrJson};
use crate::drift::{Content, Drift, DriftError, Turn, write_all_in};
use crate::model;
use crate::outcome::{Outcome, Refusal};
use crate::pipeline::Understood;
use crate::render::{self, GeneratedFiles};
use crate::workspace::{Changes, MANIFEST, Workspace};

/// Where a manifest that begins with `#:schema` and this path finds its schema.
const SCHEMA: &str = ".hulk/hulk.schema.json";

/// What writes the robot's own crate.
const WHOLE: &str = "hulkgen generate";

/// A generated crate that needs nothing to be done, and what there is to say.
#[derive(Serialize, Deserialize)]
struct Current {
    /// Diagnostics for people.
    notes: String,
    /// There are errors in parameter files.
    has_errors: bool,
    folder: Utf8PathBuf,
    content: Content,
}

pub(super) fn run(session: &mut Session<'_>, generate: &Generate) -> Result<Outcome, Failure> {
    // Before anything is read: what another hulkgen changes meanwhile would be generated as it was.
    let turn = turn(session)?;
    if generate.only.is_empty() {
        whole(session, turn, generate)
    } else {
        part(session, turn, generate)
    }
}

/// Waits until no other hulkgen writes in the workspace.
pub(super) fn turn(session: &Session<'_>) -> Result<Turn, Refusal> {
    Turn::wait_for(session.workspace.root()).map_err(|error| refusal(&error))
}

fn whole(session: &mut Session<'_>, turn: Turn, generate: &Generate) -> Result<Outcome, Failure> {
    let question = format!("generate: color {}", session.terminal.colors_notes());
    let kept: Option<Current> = session.cache.recall(&session.workspace, &question);
    if let Some(current) = kept
        && current.content.is_there(&turn, &current.folder)
    {
        drop(turn);
        session.terminal.note(&current.notes);
        if !generate.check {
            note_current(session, &current.folder);
        }
        answer(session, generate, &Drift::default(), WHOLE)?;
        return Ok(outcome(generate, &Drift::default(), current.has_errors));
    }
    let understood = session.understand()?;
    let notes = session.rendered_diagnostics();
    session.terminal.note(&notes);
    let files = render(&session.workspace, &understood);
    let drift = compare(&turn, &understood, &files)?;
    // What is said to be written is there.
    if !generate.check {
        apply(session, &turn, &understood, &files, &drift)?;
    }
    // Whoever reads the answer may take as long as they like.
    drop(turn);
    let has_errors = session.diagnostics.has_errors();
    if !generate.check || drift.is_empty() {
        let current = Current {
            notes,
            has_errors,
            folder: understood.robot.generated,
            content: Content::of(&files),
        };
        session.cache.keep(&session.workspace, &question, &current);
    }
    answer(session, generate, &drift, WHOLE)?;
    Ok(outcome(generate, &drift, has_errors))
}

/// The robot of some cyclers. It is asked for too seldom to be kept.
fn part(session: &mut Session<'_>, turn: Turn, generate: &Generate) -> Result<Outcome, Failure> {
    let mut understood = session.understand()?;
    session.note_diagnostics();
    understood.robot = partial::restrict(session, &understood.robot, generate)?;
    let files = render(&session.workspace, &understood);
    let drift = compare(&turn, &understood, &files)?;
    if !generate.check {
        apply(session, &turn, &understood, &files, &drift)?;
    }
    drop(turn);
    answer(session, generate, &drift, &understood.robot.command())?;
    if !generate.check {
        partial::note_membership(session, &understood.robot);
    }
    let has_errors = session.diagnostics.has_errors();
    Ok(outcome(generate, &drift, has_errors))
}

/// What differs, for whoever asked; `command` mends it.
fn answer(
    session: &Session<'_>,
    generate: &Generate,
    drift: &Drift,
    command: &str,
) -> Result<(), Failure> {
    if generate.format == TextOrJson::Json {
        session.terminal.data(&to_json(drift))?;
    } else if generate.check {
        session.terminal.data(&drift.diff())?;
    }
    if generate.check {
        note_drift(session, drift, command);
    }
    Ok(())
}

fn outcome(generate: &Generate, drift: &Drift, has_errors: bool) -> Outcome {
    // Parameter files do not change the generated code, so their errors keep nothing from it.
    match () {
        () if has_errors => Outcome::Bad,
        () if generate.check && !drift.is_empty() => Outcome::Drift,
        () => Outcome::Good,
    }
}

/// Writes the generated crate and says on stderr what changed.
pub(super) fn write(session: &Session<'_>, understood: &Understood) -> Result<(), Failure> {
    let files = render(&session.workspace, understood);
    let turn = turn(session)?;
    let drift = compare(&turn, understood, &files)?;
    apply(session, &turn, understood, &files, &drift)
}

/// The files of the generated crate, and, of a whole robot, the schema that the manifest names.
pub(super) fn render(workspace: &Workspace, understood: &Understood) -> GeneratedFiles {
    let mut files = render::render(&model::describe(&understood.robot, &understood.schedule));
    if understood.robot.partial.is_none() && names_schema(workspace) {
        files.insert(SCHEMA.into(), schema::json_schema());
    }
    files
}

/// Whether the manifest tells editors to look for the schema where hulkgen keeps it.
fn names_schema(workspace: &Workspace) -> bool {
    let manifest = workspace.text(Utf8Path::new(MANIFEST)).unwrap_or_default();
    let schema = manifest
        .lines()
        .find_map(|line| line.strip_prefix("#:schema"));
    schema.is_some_and(|path| path.trim().trim_start_matches("./") == SCHEMA)
}

/// How the disk differs from these files.
pub(super) fn compare(
    turn: &Turn,
    understood: &Understood,
    files: &GeneratedFiles,
) -> Result<Drift, Failure> {
    let drift = Drift::compare_in(turn, &understood.robot.generated, files);
    drift.map_err(|error| refusal(&error).into())
}

fn apply(
    session: &Session<'_>,
    turn: &Turn,
    understood: &Understood,
    files: &GeneratedFiles,
    drift: &Drift,
) -> Result<(), Failure> {
    // Nobody else writes what is generated: whatever it says is replaced.
    let written = write_all_in(turn, &drift.changes(files), &Changes::new());
    written.map_err(|error| refusal(&error))?;
    if drift.is_empty() {
        note_current(session, &understood.robot.generated);
    } else {
        session.terminal.note(&drift.summary());
    }
    Ok(())
}

fn note_current(session: &Session<'_>, folder: &Utf8Path) {
    session.terminal.note(&format!("`{folder}` is current\n"));
}

fn note_drift(session: &Session<'_>, drift: &Drift, command: &str) {
    if drift.is_empty() {
        return;
    }
    let differing = drift.added.len() + drift.changed.len() + drift.orphaned.len();
    session.terminal.note(&format!(
        "\n{} {} not what would be generated now; run `{command}`\n",
        plural(differing, "file"),
        if differing == 1 { "is" } else { "are" },
    ));
}

fn to_json(drift: &Drift) -> String {
    let answer = json!({
        "version": 1,
        "added": texts(&drift.added),
        "changed": texts(drift.changed.iter().map(|changed| &changed.path)),
        "orphaned": texts(&drift.orphaned),
    });
    format!("{answer}\n")
}

fn texts<'paths>(paths: impl IntoIterator<Item = &'paths Utf8PathBuf>) -> Vec<&'paths str> {
    paths.into_iter().map(|path| path.as_str()).collect()
}

/// Why the disk could not be read or written, for a person.
pub(super) fn refusal(error: &DriftError) -> Refusal {
    let refusal = Refusal::bad(error.to_string());
    match error {
        DriftError::NotOwned { .. } => refusal
            .help("name another folder as `generated` in hulk.toml, or remove what is in this one"),
        DriftError::Io { .. } => {
            refusal.help("look at the permissions of the folder and at the free space")
        }
        DriftError::Meanwhile { .. } => refusal.help("run it again"),
        DriftError::NotUndone { .. } => {
            refusal.help("look at what has changed, with `git diff` for example, before you go on")
        }
    }
}
