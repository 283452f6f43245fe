//! What fields say about parameters besides their types: `#[reflect(unit = "m", range = 0.0..)]`.

use std::collections::BTreeMap;

use super::robot::{Hints, Reader};
use super::tree::Declaration;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};

/// A declaration with what its field says.
pub(super) struct Hinted<'a> {
    pub(super) declaration: Declaration<'a, Reader>,
    pub(super) unit: Option<String>,
    pub(super) range: Option<String>,
    pub(super) at_creation: bool,
}

/// Hints of every declared path that has any; two nodes that say different things are a `parameter-conflict`.
pub(super) fn collect(
    hinted: &[Hinted<'_>],
    diagnostics: &mut Diagnostics,
) -> BTreeMap<String, Hints> {
    let mut known: BTreeMap<String, (Hints, &Hinted<'_>)> = BTreeMap::new();
    for one in hinted {
        if let Some(whole) = hinted.iter().find(|other| is_within(one, other)) {
            report_part(one, whole, diagnostics);
            continue;
        }
        let path = one.declaration.path();
        let (hints, first) = known.entry(path).or_insert_with(|| {
            let hints = Hints {
                creation_only: true,
                ..Hints::default()
            };
            (hints, one)
        });
        hints.creation_only &= one.at_creation;
        for (said, known) in [(&one.unit, &mut hints.unit), (&one.range, &mut hints.range)] {
            match (said, &known) {
                (Some(said), Some(known)) if said != known => {
                    report_two(one, first, (said, known), diagnostics);
                }
                (Some(_), None) => {
                    known.clone_from(said);
                    *first = one;
                }
                _ => {}
            }
        }
    }
    let hints = known.into_iter().map(|(path, (mut hints, first))| {
        let mut parts = hinted.iter().filter(|part| is_within(part, first));
        hints.creation_only &= parts.all(|part| part.at_creation);
        (path, hints)
    });
    hints
        .filter(|(_, hints)| *hints != Hints::default())
        .collect()
}

/// Whether it names a part of what another names whole.
fn is_within(part: &Hinted<'_>, whole: &Hinted<'_>) -> bool {
    let (part, whole) = (&part.declaration.segments, &whole.declaration.segments);
    let mut both = part.iter().zip(whole);
    part.len() > whole.len() && both.all(|(part, whole)| part.name == whole.name)
}

/// A part is described where its type is.
fn report_part(part: &Hinted<'_>, whole: &Hinted<'_>, diagnostics: &mut Diagnostics) {
    if part.unit.is_none() && part.range.is_none() {
        return;
    }
    let message = format!(
        "`{}` is a part of the parameter `{}`, whose type says units and ranges",
        part.declaration.path(),
        whole.declaration.path()
    );
    let error = Diagnostic::new(Code::ParameterConflict, message)
        .at(
            part.declaration.source.file(),
            part.declaration.range.clone(),
            "",
        )
        .at(
            whole.declaration.source.file(),
            whole.declaration.range.clone(),
            "read as a whole",
        )
        .help("move `#[reflect(…)]` to the field of that type");
    diagnostics.add(error);
}

fn report_two(
    one: &Hinted<'_>,
    other: &Hinted<'_>,
    (said, known): (&str, &str),
    diagnostics: &mut Diagnostics,
) {
    let path = one.declaration.path();
    let message = format!("two nodes say different things about the parameter `{path}`");
    let error = Diagnostic::new(Code::ParameterConflict, message)
        .at(
            one.declaration.source.file(),
            one.declaration.range.clone(),
            format!("`{said}`"),
        )
        .at(
            other.declaration.source.file(),
            other.declaration.range.clone(),
            format!("`{known}`"),
        )
        .help("say it once: the other field may have no `#[reflect(…)]`");
    diagnostics.add(error);
}
