//! How many instances take every cycle of another: a slot has room for the marks of so many and no more.

use std::collections::BTreeMap;

use camino::Utf8Path;

use super::robot::{CycleBinding, Cycler, InstanceId};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::manifest::Manifest;
use crate::workspace::MANIFEST;

/// `CONSUMERS` of `framework/src/buffer/word.rs`, which rustc would tell of in generated code.
const MOST: usize = 20;

/// Every instance that more instances consume than can be told apart.
pub(super) fn check(manifest: &Manifest, cyclers: &[Cycler], diagnostics: &mut Diagnostics) {
    let mut consumers: BTreeMap<InstanceId, usize> = BTreeMap::new();
    for cycler in cyclers {
        for consumed in consumed(cycler) {
            *consumers.entry(consumed).or_default() += cycler.instances.len();
        }
    }
    for (id, count) in consumers.into_iter().filter(|(_, count)| *count > MOST) {
        let declared = &manifest.cyclers[id.cycler];
        let name = &cyclers[id.cycler].instances[id.instance].name;
        let message =
            format!("{count} instances take every cycle of `{name}`, and at most {MOST} can");
        let error = Diagnostic::new(Code::InvalidValue, message)
            .at(Utf8Path::new(MANIFEST), declared.name_range.clone(), "read by `PerceptionInput`")
            .help("write `LatestInput` where the newest cycle is enough, or let one cycler take them and hand on what it makes of them");
        diagnostics.add(error);
    }
}

/// The instances that a cycler consumes, each once.
fn consumed(cycler: &Cycler) -> Vec<InstanceId> {
    let fields = cycler.nodes.iter().flat_map(|node| &node.cycle);
    let read = fields.filter_map(|field| match &field.binding {
        CycleBinding::Perception { instances, .. } => Some(instances),
        _ => None,
    });
    let mut consumed: Vec<InstanceId> = read.flatten().copied().collect();
    consumed.sort();
    consumed.dedup();
    consumed
}
