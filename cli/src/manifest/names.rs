//! Names that stand twice, and keys without effect.

use std::collections::BTreeMap;
use std::ops::Range;

use camino::Utf8Path;

use super::{Cycler, Manifest};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::workspace::MANIFEST;

pub(super) fn check(manifest: &Manifest, diagnostics: &mut Diagnostics) {
    check_cyclers(manifest, diagnostics);
    check_targets(manifest, diagnostics);
    check_bridges(manifest, diagnostics);
    for cycler in &manifest.cyclers {
        let mut nodes = Seen::new("node");
        for node in &cycler.nodes {
            nodes.see(
                node.path.as_str(),
                node.path.as_str(),
                &node.range,
                diagnostics,
            );
        }
        check_counts(cycler, diagnostics);
        check_keys(cycler, diagnostics);
    }
}

/// Instances are unique in the robot and share their names with cyclers only where a cycler is its own instance.
fn check_cyclers(manifest: &Manifest, diagnostics: &mut Diagnostics) {
    let mut cyclers = Seen::new("cycler");
    for cycler in &manifest.cyclers {
        cyclers.see(
            cycler.name(),
            &file_name(cycler.name()),
            &cycler.name_range,
            diagnostics,
        );
    }
    let mut instances = Seen::new("instance");
    for cycler in &manifest.cyclers {
        for instance in &cycler.instances {
            let name = instance.name.as_str();
            if cycler.declared.instances.is_none() && cyclers.count(&file_name(name)) > 1 {
                continue;
            }
            instances.see(name, &file_name(name), &instance.range, diagnostics);
        }
    }
    for cycler in manifest
        .cyclers
        .iter()
        .filter(|one| one.declared.instances.is_some())
    {
        instances.see(
            cycler.name(),
            &file_name(cycler.name()),
            &cycler.name_range,
            diagnostics,
        );
    }
}

fn check_targets(manifest: &Manifest, diagnostics: &mut Diagnostics) {
    let mut targets = Seen::new("target");
    for target in &manifest.targets {
        let name = target.declared.name.as_str();
        targets.see(
            name,
            &name.replace('-', "_"),
            &target.name_range,
            diagnostics,
        );
    }
    let mut identities = Seen::new("identity");
    let places = manifest.identity_ranges.iter();
    for (identity, place) in manifest.robot.identities.iter().zip(places) {
        let name = identity.as_str();
        identities.see(name, name, place, diagnostics);
    }
}

/// Of two things under one key nobody could tell which one came.
fn check_bridges(manifest: &Manifest, diagnostics: &mut Diagnostics) {
    let mut keys = Seen::new("key");
    for bridge in &manifest.bridges {
        let key = bridge.declared.key.as_str();
        keys.see(key, key, &bridge.key_range, diagnostics);
    }
}

/// Numbers and lists that may not be empty or out of range.
fn check_counts(cycler: &Cycler, diagnostics: &mut Diagnostics) {
    let name = cycler.name();
    let mut wrong = |message: String, help: &str| {
        let range = cycler.name_range.clone();
        let place = Utf8Path::new(MANIFEST);
        diagnostics.add(
            Diagnostic::new(Code::InvalidValue, message)
                .at(place, range, "")
                .help(help),
        );
    };
    if cycler.instances.is_empty() {
        wrong(
            format!("cycler `{name}` has an empty list of instances"),
            "leave `instances` out for one instance named like the cycler",
        );
    }
    if cycler.declared.remote && cycler.declared.kind == schema::CyclerKind::RealTime {
        wrong(
            format!("cycler `{name}` is real-time, and only perception cyclers can be remote"),
            "remove `remote`: what runs at the pace of the body runs beside it",
        );
    }
    if cycler.nodes.is_empty() {
        wrong(
            format!("cycler `{name}` has no nodes"),
            "add a node or remove the cycler",
        );
    }
    if !(1..=4096).contains(&cycler.declared.queue.unwrap_or(1)) {
        wrong(
            format!("the queue of cycler `{name}` has no usable length"),
            "write a `queue` from 1 to 4096",
        );
    }
}

/// Keys that only mean something in the other kind of cycler.
fn check_keys(cycler: &Cycler, diagnostics: &mut Diagnostics) {
    let declared = &cycler.declared;
    let (other, keys) = match declared.kind {
        schema::CyclerKind::Perception => (
            "real-time",
            [
                ("watchdog", declared.watchdog.is_some()),
                ("history", declared.history.is_some()),
            ],
        ),
        schema::CyclerKind::RealTime => (
            "perception",
            [
                ("pending_timeout", declared.pending_timeout.is_some()),
                ("queue", declared.queue.is_some()),
            ],
        ),
    };
    for (key, _) in keys.into_iter().filter(|(_, present)| *present) {
        let message = format!("`{key}` has no effect: it belongs to {other} cyclers");
        let place = Utf8Path::new(MANIFEST);
        let warning = Diagnostic::new(Code::UnusedKey, message)
            .at(
                place,
                cycler.name_range.clone(),
                format!("this cycler is not {other}"),
            )
            .help(format!("remove `{key}`"));
        diagnostics.add(warning);
    }
}

/// What a name becomes in the generated crate, without the marks between words: names that are equal but for them clash.
fn file_name(name: &str) -> String {
    schema::snake_case(name)
}

/// Names of one sort and where they stood first.
struct Seen {
    sort: &'static str,
    first: BTreeMap<String, Vec<(String, Range<usize>)>>,
}

impl Seen {
    fn new(sort: &'static str) -> Self {
        Self {
            sort,
            first: BTreeMap::new(),
        }
    }

    fn count(&self, key: &str) -> usize {
        self.first.get(key).map_or(0, Vec::len)
    }

    /// `key` is what may not be equal.
    fn see(&mut self, name: &str, key: &str, range: &Range<usize>, diagnostics: &mut Diagnostics) {
        let sort = self.sort;
        let seen = self.first.entry(key.to_owned()).or_default();
        seen.push((name.to_owned(), range.clone()));
        let [(first, first_range), .., _] = seen.as_slice() else {
            return;
        };
        let message = if first == name {
            format!("{sort} `{name}` stands twice")
        } else {
            format!("{sort} `{name}` and `{first}` would both be called `{key}`")
        };
        let file = Utf8Path::new(MANIFEST);
        let error = Diagnostic::new(Code::DuplicateName, message)
            .at(file, range.clone(), "again here")
            .at(file, first_range.clone(), "first here")
            .help("rename or remove one of the two");
        diagnostics.add(error);
    }
}
