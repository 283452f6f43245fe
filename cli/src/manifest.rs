//! Stage ①: the manifest as its author wrote it, every name with its place in `hulk.toml`.
//!
//! Reports syntax, keys, spelling and names that stand twice; whether nodes exist is the matter of [`crate::scan`].

mod folders;
mod names;
mod places;
mod scheduling;
mod targets;
mod tolerant;

use std::collections::BTreeMap;
use std::ops::Range;

use camino::Utf8Path;
use toml::de::DeTable;

use crate::diagnostics::{Code, Diagnostic, Diagnostics, Reported};
use crate::workspace::{MANIFEST, Workspace};

pub use folders::{mistake as mistake_of_generated_folder, without_dots};
pub use targets::absent_files;

/// The manifest without mistakes of its own.
#[derive(Clone, Debug)]
pub struct Manifest {
    pub robot: schema::Robot,
    /// Of the folder of the generated crate, or of `[robot]` where the manifest does not name it.
    pub generated_range: Range<usize>,
    /// The same of the folder of the parameter files.
    pub parameters_range: Range<usize>,
    /// Of each of the robot's identities.
    pub identity_ranges: Vec<Range<usize>>,
    /// In manifest order.
    pub cyclers: Vec<Cycler>,
    /// In manifest order; the first is the default.
    pub targets: Vec<Target>,
    /// In manifest order.
    pub bridges: Vec<Bridge>,
}

/// A cycler and where its parts stand.
#[derive(Clone, Debug)]
pub struct Cycler {
    pub declared: schema::Cycler,
    /// Of its name.
    pub name_range: Range<usize>,
    /// Of `record`, if it has one.
    pub record_range: Option<Range<usize>>,
    pub scheduling_ranges: SchedulingRanges,
    /// In manifest order; at least one.
    pub instances: Vec<Instance>,
    /// Setup nodes first, then nodes, both in manifest order.
    pub nodes: Vec<NodeEntry>,
}

/// An instance and where it stands.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Cycler name and suffix.
    pub name: schema::InstanceName,
    /// Its own settings, if it has any.
    pub table: Option<schema::InstanceTable>,
    /// Of its suffix, or of the cycler's name.
    pub range: Range<usize>,
    /// Of `record` in its table, if it has one.
    pub record_range: Option<Range<usize>>,
    /// Of its own `scheduling`.
    pub scheduling_ranges: SchedulingRanges,
}

/// Where the values of a `scheduling` stand; empty without one.
#[derive(Clone, Debug, Default)]
pub struct SchedulingRanges {
    pub policy: Option<Range<usize>>,
    pub priority: Option<Range<usize>>,
}

/// A line of `setup_nodes` or `nodes`.
#[derive(Clone, Debug)]
pub struct NodeEntry {
    pub path: schema::NodePath,
    pub setup: bool,
    /// What it says itself; else the cycler's.
    pub on_failure: Option<schema::OnFailure>,
    /// Of its path.
    pub range: Range<usize>,
}

/// A target and where it stands.
#[derive(Clone, Debug)]
pub struct Target {
    pub declared: schema::Target,
    /// Of its name.
    pub name_range: Range<usize>,
    /// Of its hardware type.
    pub hardware_range: Range<usize>,
    /// Of its location, if it has one.
    pub location_range: Option<Range<usize>>,
    /// Of its triple, if it has one.
    pub triple_range: Option<Range<usize>>,
    /// Of its profile, if it has one.
    pub profile_range: Option<Range<usize>>,
    pub deploy_ranges: DeployRanges,
}

/// Where the values of `[target.deploy]` stand; empty without one.
#[derive(Clone, Debug, Default)]
pub struct DeployRanges {
    /// By their keys.
    pub values: BTreeMap<String, Range<usize>>,
    /// Of each of `files`.
    pub files: Vec<Range<usize>>,
    /// Of the destinations in `hosts`, by the robots' names.
    pub hosts: BTreeMap<String, Range<usize>>,
}

/// What a bridge maps, and where it stands.
#[derive(Clone, Debug)]
pub struct Bridge {
    pub declared: schema::Bridge,
    /// Of its path.
    pub path_range: Range<usize>,
    /// Of its key.
    pub key_range: Range<usize>,
}

impl Cycler {
    /// Its name.
    pub fn name(&self) -> &str {
        self.declared.name.as_str()
    }
}

/// Reads the manifest.
///
/// # Errors
/// `syntax`, `unknown-key`, `missing-key`, `invalid-value`, `invalid-name`, `duplicate-name`.
pub fn load(workspace: &Workspace, diagnostics: &mut Diagnostics) -> Result<Manifest, Reported> {
    let file = Utf8Path::new(MANIFEST);
    let text = match workspace.read(file) {
        Ok(text) => text,
        Err(error) => {
            let error = Diagnostic::new(Code::Syntax, error.to_string());
            return Err(diagnostics.fail(error));
        }
    };
    let (table, errors) = DeTable::parse_recoverable(&text);
    let mut reported = None;
    for error in errors {
        let range = error.span().unwrap_or(0..0);
        let error = Diagnostic::new(Code::Syntax, error.message()).at(file, range, "");
        reported = Some(diagnostics.fail(error));
    }
    if let Some(reported) = reported {
        return Err(reported);
    }
    let declared = tolerant::read(&table, file, diagnostics)?;
    let manifest = places::locate(declared, table.get_ref());
    names::check(&manifest, diagnostics);
    for cycler in &manifest.cyclers {
        scheduling::check(cycler, diagnostics);
    }
    targets::check(workspace, &manifest, diagnostics);
    folders::check(workspace, &manifest, diagnostics);
    diagnostics.stop_at_errors()?;
    Ok(manifest)
}

#[cfg(test)]
mod tests;
