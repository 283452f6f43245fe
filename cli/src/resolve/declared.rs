//! Types that nodes declare, of which nobody but rustc can tell whether the generated crate can write them.

use std::collections::BTreeSet;

use grammar::{CreationField, CycleField, OutputField};
use syn::Type;

use crate::scan::{Library, NodeSource};

/// How many paths a macro or a condition decides about, each once.
pub(super) fn unsure<'a>(
    nodes: impl Iterator<Item = &'a NodeSource>,
    library: &Library<'_>,
) -> usize {
    let mut unsure = BTreeSet::new();
    for node in nodes {
        for data in declared(node) {
            unsure.extend(library.resolve(&node.module, data).unsure);
        }
    }
    unsure.len()
}

fn declared(node: &NodeSource) -> impl Iterator<Item = &Type> {
    let creation = node.creation.fields.iter().map(|field| match &field.kind {
        CreationField::Parameter(parameter) => vec![&parameter.data],
        CreationField::CyclerState(state) => vec![&state.data],
        CreationField::HardwareInterface => Vec::new(),
    });
    let cycle = node.cycle.fields.iter().map(|field| match &field.kind {
        CycleField::Parameter(parameter) => vec![&parameter.data],
        CycleField::CyclerState(state) => vec![&state.data],
        CycleField::AdditionalOutput(output) => vec![&output.data],
        CycleField::Procedure(procedure) => vec![&procedure.request, &procedure.response],
        CycleField::MainOutput(data) => vec![data],
        // What is read is compared with what is written.
        _ => Vec::new(),
    });
    let outputs = node.outputs.fields.iter().map(|field| match &field.kind {
        OutputField::MainOutput(data) => vec![data],
        OutputField::CaptureTime => Vec::new(),
    });
    creation.chain(cycle).chain(outputs).flatten()
}
