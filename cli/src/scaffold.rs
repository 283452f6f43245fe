//! What people would otherwise type: a new robot, nodes, cyclers, and renames that every reader follows.
//!
//! Everything here looks at a workspace and answers with [`Changes`] to it: texts of files, in memory. Whether the robot is
//! still right after them is found out by the stages, as for changes that people make; then the door out writes all of
//! them or none.
//!
//! Invariant: nothing is written, printed or compiled. Comments and order of the files that are changed survive.

mod capture;
mod cycler;
mod document;
mod files;
mod framework;
mod leftovers;
mod module;
mod new_robot;
mod node;
mod parameters;
mod removal;
mod rename;
mod uses;

use camino::Utf8PathBuf;

use crate::diagnostics::{listed, nearest};
use crate::outcome::Refusal;
use crate::resolve::robot::Robot;
use crate::workspace::{MANIFEST, Member, Workspace};

pub use crate::workspace::Changes;
pub use capture::{Capture, capture, check_capturable};
pub use cycler::{NewCycler, add_cycler};
pub use framework::Framework;
pub use leftovers::{Leftovers, still_named};
pub use new_robot::{NewRobot, Template, new_robot};
pub use node::{NewNode, add_node};
pub use parameters::without_unread;
pub use removal::{Removal, remove_node};
pub use rename::{Rename, Renamed, rename_output};
pub use schema::CyclerKind;

/// The text of a file of the workspace.
fn read(workspace: &Workspace, file: &camino::Utf8Path) -> Result<std::sync::Arc<str>, Refusal> {
    workspace
        .read(file)
        .map_err(|error| Refusal::bad(error.to_string()))
}

/// The manifest as a document that keeps its comments.
fn read_manifest(workspace: &Workspace) -> Result<toml_edit::DocumentMut, Refusal> {
    let text = read(workspace, MANIFEST.as_ref())?;
    document::parse(MANIFEST.as_ref(), &text)
}

/// The manifest's new text.
fn manifest_change(
    workspace: &Workspace,
    manifest: &toml_edit::DocumentMut,
) -> Result<(Utf8PathBuf, Option<String>), Refusal> {
    let before = read(workspace, MANIFEST.as_ref())?;
    Ok((MANIFEST.into(), Some(document::written(manifest, &before))))
}

/// The package with this library, if people write it: never the generated one.
fn own_member<'w>(
    workspace: &'w Workspace,
    robot: &Robot,
    library: &str,
) -> Result<&'w Member, Refusal> {
    let own = || {
        let members = workspace.members().libraries();
        members.filter(|member| member.folder != robot.generated)
    };
    let found = own().find(|member| member.library == library);
    found.ok_or_else(|| {
        // In a workspace of many crates most have no nodes, and are of no help.
        let nodes = robot.cyclers.iter().flat_map(|cycler| &cycler.nodes);
        let crates = nodes.filter_map(|node| node.path.split("::").next());
        let mut crates = crates.peekable();
        let names = || own().map(|member| member.library.as_str());
        let list = if crates.peek().is_some() {
            format!("the robot's nodes stand in {}", listed(crates))
        } else {
            format!("the workspace has {}", listed(names()))
        };
        let message = format!("no crate of the workspace is called `{library}`");
        corrected(&message, nearest(library, names()), list)
    })
}

/// A name that means nothing, with the nearest that does.
fn unknown<'a, N: IntoIterator<Item = &'a str>>(
    message: &str,
    wrong: &str,
    names: impl Fn() -> N,
    introduction: &str,
) -> Refusal {
    let list = format!("{introduction} {}", listed(names()));
    corrected(message, nearest(wrong, names()), list)
}

/// Something that means nothing, with the nearest that does and a list of all.
fn corrected(message: &str, near: Option<&str>, list: String) -> Refusal {
    Refusal::wrong_usage(message).help(match near {
        Some(near) => format!("did you mean `{near}`? {list}"),
        None => list,
    })
}
