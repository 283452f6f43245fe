//! `generate`: the generated crate on disk, or what would change.

mod partial;

use camino::Utf8Path;
use camino::Utf8PathBuf;
use serde_json::json;

use super::session::Session;
use super::{Failure, plural};
use crate::arguments::{Generate, TextOrJson};
use crate::drift::{Drift, DriftError};
use crate::model;
use crate::outcome::{Outcome, Refusal};
use crate::pipeline::Understood;
use crate::render::{self, GeneratedFiles};
use crate::workspace::{MANIFEST, Workspace};

/// Where a manifest that begins with `#:schema` and this path finds its schema.
const SCHEMA: &str = ".hulk/hulk.schema.json";

pub(super) fn run(session: &mut Session<'_>, generate: &Generate) -> Result<Outcome, Failure> {
    let mut understood = session.understand()?;
    session.note_diagnostics();
    if !generate.only.is_empty() {
        understood.robot = partial::restrict(session, &understood.robot, generate)?;
    }
    let files = render(&session.workspace, &understood);
    let drift = compare(session.workspace.root(), &understood, &files)?;
    // What is said to be written is there.
    if !generate.check {
        apply(session, &understood, &files, &drift)?;
    }
    if generate.format == TextOrJson::Json {
        session.terminal.data(&to_json(&drift))?;
    } else if generate.check {
        session.terminal.data(&drift.diff())?;
    }
    if generate.check {
        note_drift(session, &understood, &drift);
    } else if understood.robot.partial.is_some() {
        partial::note_membership(session, &understood.robot);
    }
    // Parameter files do not change the generated code, so their errors keep nothing from it.
    Ok(match () {
        () if session.diagnostics.has_errors() => Outcome::Bad,
        () if generate.check && !drift.is_empty() => Outcome::Drift,
        () => Outcome::Good,
    })
}

/// Writes the generated crate and says on stderr what changed.
pub(super) fn write(session: &Session<'_>, understood: &Understood) -> Result<(), Failure> {
    let files = render(&session.workspace, understood);
    let drift = compare(session.workspace.root(), understood, &files)?;
    apply(session, understood, &files, &drift)
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
    root: &Utf8Path,
    understood: &Understood,
    files: &GeneratedFiles,
) -> Result<Drift, Failure> {
    let drift = Drift::compare(root, &understood.robot.generated, files);
    drift.map_err(|error| refusal(&error).into())
}

fn apply(
    session: &Session<'_>,
    understood: &Understood,
    files: &GeneratedFiles,
    drift: &Drift,
) -> Result<(), Failure> {
    let root = session.workspace.root();
    drift.write(root, files).map_err(|error| refusal(&error))?;
    let note = if drift.is_empty() {
        format!("`{}` is current\n", understood.robot.generated)
    } else {
        drift.summary()
    };
    session.terminal.note(&note);
    Ok(())
}

fn note_drift(session: &Session<'_>, understood: &Understood, drift: &Drift) {
    if drift.is_empty() {
        return;
    }
    let differing = drift.added.len() + drift.changed.len() + drift.orphaned.len();
    session.terminal.note(&format!(
        "\n{} {} not what would be generated now; run `{}`\n",
        plural(differing, "file"),
        if differing == 1 { "is" } else { "are" },
        understood.robot.command()
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
        DriftError::NotUndone { .. } => {
            refusal.help("look at what has changed, with `git diff` for example, before you go on")
        }
    }
}
