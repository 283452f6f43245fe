//! Procedures and capture times: what a cycler has at most once.

use std::collections::BTreeMap;
use std::ops::Range;

use grammar::{CycleField, OutputField};

use super::scene::SceneCycler;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::scan::{NodeSource, range};

/// Two nodes with one procedure, and two setup nodes with a capture time.
pub(super) fn check(cycler: &SceneCycler<'_>, diagnostics: &mut Diagnostics) {
    check_procedures(cycler, diagnostics);
    check_capture_times(cycler, diagnostics);
}

fn check_procedures(cycler: &SceneCycler<'_>, diagnostics: &mut Diagnostics) {
    let mut seen: BTreeMap<&str, (&NodeSource, Range<usize>)> = BTreeMap::new();
    for node in &cycler.nodes {
        for field in &node.source.cycle.fields {
            let CycleField::Procedure(procedure) = &field.kind else {
                continue;
            };
            let name = procedure.name.text.as_str();
            let place = range(procedure.name.span);
            let Some((first, first_place)) = seen.get(name) else {
                seen.insert(name, (node.source, place));
                continue;
            };
            let cycler = cycler.declared.name();
            let message = format!("two fields of cycler `{cycler}` answer the procedure `{name}`");
            let error = Diagnostic::new(Code::DuplicateProcedure, message)
                .at(
                    node.source.file(),
                    place,
                    format!("answered by `{}`", node.source.path),
                )
                .at(
                    first.file(),
                    first_place.clone(),
                    format!("and by `{}`", first.path),
                )
                .help("rename one of the two");
            diagnostics.add(error);
        }
    }
}

/// Capture times of nodes that are no setup nodes are reported where they are bound.
fn check_capture_times(cycler: &SceneCycler<'_>, diagnostics: &mut Diagnostics) {
    let times = cycler
        .nodes
        .iter()
        .filter(|node| node.entry.setup)
        .flat_map(|node| {
            let fields = node.source.outputs.fields.iter();
            let times = fields.filter(|field| matches!(field.kind, OutputField::CaptureTime));
            times.map(|field| (node.source, range(field.span)))
        });
    let times: Vec<(&NodeSource, Range<usize>)> = times.collect();
    let [(first, first_place), others @ ..] = times.as_slice() else {
        return;
    };
    for (source, place) in others {
        let message = format!("cycler `{}` has two capture times", cycler.declared.name());
        let error = Diagnostic::new(Code::CaptureTime, message)
            .at(
                source.file(),
                place.clone(),
                format!("given by `{}`", source.path),
            )
            .at(
                first.file(),
                first_place.clone(),
                format!("and by `{}`", first.path),
            )
            .help("keep the one of the node that waits longest");
        diagnostics.add(error);
    }
}
