//! Cycler states and additional outputs: trees of one cycler.

use std::collections::BTreeMap;

use grammar::{CreationField, CycleField};

use super::paths;
use super::robot::{Access, Segment, StateUse, Tree, Writer};
use super::scene::{Scene, SceneCycler};
use super::tree::{Declaration, Rules, merge};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::scan::{Library, range};

/// States of a cycler, and how many paths could not be compared: all, and those that no edge tells.
pub(super) fn states(
    scene: &Scene<'_>,
    cycler: &SceneCycler<'_>,
    diagnostics: &mut Diagnostics,
) -> (Tree<StateUse>, usize, usize) {
    let library = &scene.sources.library;
    let mut declarations = Vec::new();
    // Where the fields of each context begin and end.
    let mut contexts = Vec::new();
    for node in &cycler.nodes {
        let source = node.source;
        let creation = source
            .creation
            .fields
            .iter()
            .filter_map(|field| match &field.kind {
                CreationField::CyclerState(state) => Some((state, range(field.span))),
                _ => None,
            });
        let cycle = source
            .cycle
            .fields
            .iter()
            .filter_map(|field| match &field.kind {
                CycleField::CyclerState(state) => Some((state, range(field.span))),
                _ => None,
            });
        for (context, drawn) in [
            (creation.collect::<Vec<_>>(), false),
            (cycle.collect(), true),
        ] {
            let begin = declarations.len();
            declarations.extend(context.iter().map(|(state, range)| Declaration {
                segments: Access::of(&state.path).segments,
                data: library.resolve(&source.module, &state.data),
                user: StateUse {
                    node: source.path.clone(),
                    shared: state.shared,
                },
                writes: !state.shared,
                drawn,
                instance: None,
                source,
                range: range.clone(),
            }));
            contexts.push(begin..declarations.len());
        }
    }
    for context in contexts {
        report_overlaps(library, &declarations[context], &declarations, diagnostics);
    }
    report_unwritten(cycler, &declarations, diagnostics);
    let rules = Rules {
        conflict: Code::StateConflict,
        what: "cycler state",
    };
    let mut merged = merge(library, declarations, &rules, diagnostics);
    merged
        .tree
        .for_each_leaf(&mut |users| one_use_per_node(users));
    (merged.tree, merged.unchecked, merged.hidden)
}

/// A node that writes a state in one field and reads it in another is a writer.
fn one_use_per_node(users: &mut Vec<StateUse>) {
    let mut by_node: BTreeMap<String, bool> = BTreeMap::new();
    for user in users.drain(..) {
        let shared = by_node.entry(user.node).or_insert(true);
        *shared &= user.shared;
    }
    users.extend(
        by_node
            .into_iter()
            .map(|(node, shared)| StateUse { node, shared }),
    );
}

/// Two fields of one context that reach one value, of which one may change it.
fn report_overlaps(
    library: &Library<'_>,
    context: &[Declaration<'_, StateUse>],
    all: &[Declaration<'_, StateUse>],
    diagnostics: &mut Diagnostics,
) {
    for (index, second) in context.iter().enumerate() {
        for first in &context[..index] {
            if first.user.shared && second.user.shared {
                continue;
            }
            let both = first.segments.iter().zip(&second.segments);
            let common = both.take_while(|(a, b)| a.name == b.name).count();
            let (a, b) = (first.path(), second.path());
            let shorter = first.segments.len().min(second.segments.len());
            let (message, deed) = if common == shorter {
                let message = format!("`{a}` and `{b}` are one cycler state");
                (message, "keep one of the two fields".to_owned())
            } else if let Some(whole) = [first, second]
                .into_iter()
                .find_map(|one| whole_of(library, one, common, all))
            {
                let message = format!("`{a}` and `{b}` both borrow `{whole}` as a whole");
                (message, format!("ask for `{whole}` in their place"))
            } else {
                continue;
            };
            let error = Diagnostic::new(Code::OverlappingStates, message)
                .at(
                    second.source.file(),
                    second.range.clone(),
                    "borrowed again here",
                )
                .at(first.source.file(), first.range.clone(), "borrowed here")
                .help(deed);
            diagnostics.add(error);
        }
    }
}

/// The path of what is borrowed whole by whoever borrows this one's state, if it is not longer than so many segments.
fn whole_of(
    library: &Library<'_>,
    one: &Declaration<'_, StateUse>,
    longest: usize,
    all: &[Declaration<'_, StateUse>],
) -> Option<String> {
    let starts = |names: &[Segment]| {
        let mut both = names.iter().zip(&one.segments);
        names.len() <= longest && both.all(|(a, b)| a.name == b.name)
    };
    let above = all.iter().filter(|other| starts(&other.segments));
    let leaf = above.min_by_key(|other| other.segments.len())?;
    let begin = leaf.segments.len() - 1;
    let length = begin + paths::borrowed_whole(library, &leaf.data, &one.segments[begin..])?;
    let names = one.segments.iter().map(|segment| segment.name.as_str());
    let whole = names.take(length).collect::<Vec<_>>().join(".");
    (length <= longest).then_some(whole)
}

/// A state that is only read, at, above or below its path.
fn report_unwritten(
    cycler: &SceneCycler<'_>,
    declarations: &[Declaration<'_, StateUse>],
    diagnostics: &mut Diagnostics,
) {
    let overlap = |a: &[Segment], b: &[Segment]| a.iter().zip(b).all(|(a, b)| a.name == b.name);
    for reader in declarations.iter().filter(|one| one.user.shared) {
        let mut writers = declarations.iter().filter(|one| !one.user.shared);
        if writers.any(|writer| overlap(&writer.segments, &reader.segments)) {
            continue;
        }
        let names: Vec<&str> = reader
            .segments
            .iter()
            .map(|one| one.name.as_str())
            .collect();
        let path = names.join(".");
        let written: Vec<String> = declarations
            .iter()
            .filter(|one| !one.user.shared)
            .map(|one| {
                one.segments
                    .iter()
                    .map(|one| one.name.clone())
                    .collect::<Vec<_>>()
                    .join(".")
            })
            .collect();
        let near = crate::diagnostics::nearest(&path, written.iter().map(String::as_str));
        let help = match near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("write it in a node of this cycler: `CyclerState<T, \"{path}\">`"),
        };
        let name = cycler.declared.name();
        let message = format!("no node of cycler `{name}` writes the cycler state `{path}`");
        let error = Diagnostic::new(Code::UnwrittenState, message)
            .at(reader.source.file(), reader.range.clone(), "only read here")
            .help(help);
        diagnostics.add(error);
    }
}

/// Additional outputs of a cycler; one path stands once, and not below another.
pub(super) fn additional_outputs(
    scene: &Scene<'_>,
    cycler: &SceneCycler<'_>,
    diagnostics: &mut Diagnostics,
) -> Tree<Writer> {
    let mut declarations: Vec<Declaration<'_, Writer>> = Vec::new();
    for node in &cycler.nodes {
        for field in &node.source.cycle.fields {
            let CycleField::AdditionalOutput(output) = &field.kind else {
                continue;
            };
            let declaration = Declaration {
                segments: Access::of(&output.path).segments,
                data: scene
                    .sources
                    .library
                    .resolve(&node.source.module, &output.data),
                user: Writer {
                    node: node.source.path.clone(),
                },
                writes: false,
                drawn: false,
                instance: None,
                source: node.source,
                range: range(field.span),
            };
            match declarations
                .iter()
                .find(|other| overlaps(cycler, other, &declaration))
            {
                Some(other) => diagnostics.add(duplicate(cycler, other, &declaration)),
                None => declarations.push(declaration),
            }
        }
    }
    let rules = Rules {
        conflict: Code::DuplicateOutput,
        what: "additional output",
    };
    merge(&scene.sources.library, declarations, &rules, diagnostics).tree
}

/// Whether one path leads through the other, for one instance at least.
fn overlaps<U>(cycler: &SceneCycler<'_>, a: &Declaration<'_, U>, b: &Declaration<'_, U>) -> bool {
    let names = cycler.declared.instances.iter();
    let mut names = names.map(|one| schema::snake_case(one.name.as_str()));
    let pairs = a.segments.iter().zip(&b.segments);
    // What is called like the field that stands for the instance is that field.
    pairs.clone().all(|(a, b)| a.name == b.name)
        || names.any(|name| pairs.clone().all(|(a, b)| a.named(&name) == b.named(&name)))
}

impl Segment {
    /// Its name in the instance that is called so.
    fn named<'n>(&'n self, instance: &'n str) -> &'n str {
        match self.instance {
            true => instance,
            false => &self.name,
        }
    }
}

fn duplicate(
    cycler: &SceneCycler<'_>,
    first: &Declaration<'_, Writer>,
    second: &Declaration<'_, Writer>,
) -> Diagnostic {
    let path = |one: &Declaration<'_, Writer>| {
        let name = |one: &Segment| match one.instance {
            true => "$cycler_instance".to_owned(),
            false => one.name.clone(),
        };
        one.segments.iter().map(name).collect::<Vec<_>>().join(".")
    };
    let (a, b, name) = (path(first), path(second), cycler.declared.name());
    let message = if a == b {
        format!("the additional output `{b}` of cycler `{name}` is written twice")
    } else if first.segments.len() == second.segments.len() {
        format!(
            "the additional outputs `{a}` and `{b}` of cycler `{name}` are one in one of its instances"
        )
    } else {
        format!(
            "of the additional outputs `{a}` and `{b}` of cycler `{name}` one lies below the other"
        )
    };
    Diagnostic::new(Code::DuplicateOutput, message)
        .at(
            second.source.file(),
            second.range.clone(),
            format!("written by `{}`", second.user.node),
        )
        .at(
            first.source.file(),
            first.range.clone(),
            format!("and by `{}`", first.user.node),
        )
        .help("rename one of the two")
}
