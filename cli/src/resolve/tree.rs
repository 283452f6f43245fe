//! Declarations of one tree (parameters, cycler states, additional outputs): merged, and compared with each other.

use std::collections::BTreeMap;
use std::ops::Range;

use super::paths::{self, Agreement};
use super::robot::{Branch, Content, DataType, Segment, Tree};
use super::scene::written_within;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::scan::compare::{Comparison, compare};
use crate::scan::types::Resolved;
use crate::scan::{Library, NodeSource};

/// A field that declares a path of a tree.
#[derive(Clone)]
pub(super) struct Declaration<'a, U> {
    /// With names of instances in place of `$cycler_instance`.
    pub(super) segments: Vec<Segment>,
    /// As written.
    pub(super) data: Resolved,
    pub(super) user: U,
    /// Whether its node changes the value in place.
    pub(super) writes: bool,
    /// Whether the graph draws an edge from who writes it to who reads it.
    pub(super) drawn: bool,
    /// Where `$cycler_instance` stood, and the cycler whose instance stands there now.
    pub(super) instance: Option<(usize, usize)>,
    pub(super) source: &'a NodeSource,
    /// Of the field's type.
    pub(super) range: Range<usize>,
}

/// How declarations of one tree disagree.
pub(super) struct Rules {
    /// `parameter-conflict` or `state-conflict`.
    pub(super) conflict: Code,
    /// What a leaf is called in messages: "parameter", "cycler state".
    pub(super) what: &'static str,
}

/// The tree and how many paths below a leaf could not be compared.
pub(super) struct Merged<U> {
    pub(super) tree: Tree<U>,
    pub(super) unchecked: usize,
    /// Those of them that no edge of the graph tells.
    pub(super) hidden: usize,
}

impl<U> Declaration<'_, U> {
    fn names(&self) -> Vec<&str> {
        self.segments
            .iter()
            .map(|segment| segment.name.as_str())
            .collect()
    }

    pub(super) fn path(&self) -> String {
        self.names().join(".")
    }

    /// The type at the end of the path: without the `Option` that a `?` before the last segment adds.
    fn leaf(&self) -> Resolved {
        let marked_before = self.segments.iter().any(|segment| segment.optional);
        let marked_last = self.segments.last().is_some_and(|segment| segment.optional);
        match self.data.option_argument() {
            Some(inner) if marked_before && !marked_last => inner.clone(),
            _ => self.data.clone(),
        }
    }
}

/// Merges declarations: what lies below another's path is a field of that one's type.
pub(super) fn merge<U: Clone + Ord>(
    library: &Library<'_>,
    mut declarations: Vec<Declaration<'_, U>>,
    rules: &Rules,
    diagnostics: &mut Diagnostics,
) -> Merged<U> {
    // Shorter paths first; the manifest's order decides which of two equals is the first.
    declarations.sort_by_key(|one| one.segments.len());
    let mut leaves: Vec<(Declaration<'_, U>, Vec<U>)> = Vec::new();
    let (mut unchecked, mut hidden) = (0, 0);
    for declaration in declarations {
        let above = leaves
            .iter_mut()
            .find(|(leaf, _)| declaration.names().starts_with(&leaf.names()));
        match above {
            Some((leaf, users)) => {
                let is_told = check_marks(&declaration, Some(leaf), rules, diagnostics)
                    || agree(library, leaf, &declaration, rules, diagnostics);
                if !is_told {
                    unchecked += 1;
                    hidden += usize::from(!is_told_by_edge(leaf, &declaration));
                }
                users.push(declaration.user);
            }
            None => {
                check_marks(&declaration, None, rules, diagnostics);
                let user = declaration.user.clone();
                leaves.push((declaration, vec![user]));
            }
        }
    }
    let mut root = Growing::default();
    for (leaf, mut users) in leaves {
        users.sort();
        users.dedup();
        root.insert(&leaf, users);
    }
    Merged {
        tree: root.into_tree(),
        unchecked,
        hidden,
    }
}

/// Whether the graph has an edge between the two that says that their types were not compared.
fn is_told_by_edge<U>(one: &Declaration<'_, U>, other: &Declaration<'_, U>) -> bool {
    let is_known = one.data.is_known() && other.data.is_known();
    let is_drawn = one.drawn && other.drawn && one.writes != other.writes;
    is_drawn && !is_known && one.source.path != other.source.path
}

/// Compares a declaration with the one at or above its path; `false`: left to rustc.
fn agree<U>(
    library: &Library<'_>,
    leaf: &Declaration<'_, U>,
    declaration: &Declaration<'_, U>,
    rules: &Rules,
    diagnostics: &mut Diagnostics,
) -> bool {
    let depth = leaf.segments.len();
    let (path, what) = (leaf.path(), rules.what);
    let agreement = if declaration.segments.len() == depth {
        match compare(&declaration.leaf(), &leaf.leaf()) {
            Comparison::Same => Agreement::Same,
            Comparison::Unknown => Agreement::Unknown,
            Comparison::Different => Agreement::Type {
                expected: leaf.leaf().text,
            },
        }
    } else {
        let below = &declaration.segments[depth - 1..];
        paths::check(library, &leaf.leaf(), below, &declaration.data)
    };
    let (code, message, help) = match agreement.clone() {
        Agreement::Same => match only_whole(library, leaf, declaration) {
            Some((message, help)) => (rules.conflict, message, Some(help)),
            None => return true,
        },
        Agreement::Unknown => return false,
        Agreement::Type { expected } => {
            let is_of_one_crate =
                leaf.source.module.library() == declaration.source.module.library();
            let expected = match is_of_one_crate {
                true => written_within(leaf.source, &expected),
                false => expected,
            };
            (
                rules.conflict,
                format!("{what} `{}` is declared with two types", declaration.path()),
                Some(format!(
                    "write `{expected}` at both places, or rename one of the two"
                )),
            )
        }
        Agreement::Option { message, help } => (Code::OptionMismatch, message, Some(help)),
        Agreement::Field {
            message,
            names,
            wrong,
        } => {
            let near = crate::diagnostics::nearest(&wrong, names.iter().map(String::as_str));
            let help = near.map(|near| format!("did you mean `{near}`?"));
            (
                rules.conflict,
                format!("{message}, which {what} `{path}` is"),
                help,
            )
        }
        Agreement::Private {
            structure, field, ..
        } => (
            Code::NotPublic,
            format!("field `{field}` of `{structure}` is private"),
            Some(format!("write `pub {field}`")),
        ),
    };
    let text = |one: &Declaration<'_, U>| format!("`{}` as `{}`", one.path(), one.data.text);
    let error = agreement
        .begin(Diagnostic::new(code, message))
        .at(
            declaration.source.file(),
            declaration.range.clone(),
            text(declaration),
        )
        .at(leaf.source.file(), leaf.range.clone(), text(leaf))
        .help_if(help);
    diagnostics.add(error);
    true
}

/// What is wrong with a node that changes a part of what must stay consistent, and what to do.
fn only_whole<U>(
    library: &Library<'_>,
    leaf: &Declaration<'_, U>,
    declaration: &Declaration<'_, U>,
) -> Option<(String, String)> {
    let below = &declaration.segments[leaf.segments.len() - 1..];
    let (owner, kind) = paths::only_whole(library, &leaf.leaf(), below)?;
    declaration.writes.then(|| {
        (
            format!("`{}` cannot be changed alone", declaration.path()),
            format!("change `{owner}` as a whole: a `{kind}` keeps its length"),
        )
    })
}

/// A `?` before the end of the leaf at or above a path needs somebody who declares that part as an `Option`; whether it was
/// reported.
fn check_marks<U>(
    declaration: &Declaration<'_, U>,
    leaf: Option<&Declaration<'_, U>>,
    rules: &Rules,
    diagnostics: &mut Diagnostics,
) -> bool {
    let end = leaf.unwrap_or(declaration).segments.len() - 1;
    let mut before_end = declaration.segments[..end].iter().enumerate();
    // What the leaf marks, too, was reported there.
    let is_known = |index: usize| leaf.is_some_and(|leaf| leaf.segments[index].optional);
    let Some((_, marked)) = before_end.find(|(index, one)| one.optional && !is_known(*index))
    else {
        return false;
    };
    let message = format!(
        "nobody declares {} `{}` as an `Option`",
        rules.what, marked.name
    );
    let error = Diagnostic::new(Code::OptionMismatch, message)
        .at(declaration.source.file(), declaration.range.clone(), "")
        .help(format!(
            "remove the `?` behind `{}`, or declare `{}` itself",
            marked.name, marked.name
        ));
    diagnostics.add(error);
    true
}

impl<U> Tree<U> {
    /// Visits the users of every leaf.
    pub(super) fn for_each_leaf(&mut self, visit: &mut impl FnMut(&mut Vec<U>)) {
        for branch in &mut self.branches {
            match &mut branch.content {
                Content::Leaf { users, .. } => visit(users),
                Content::Inner(tree) | Content::Instance { tree, .. } => tree.for_each_leaf(visit),
            }
        }
    }
}

/// A tree while leaves are added.
struct Growing<U> {
    branches: BTreeMap<String, GrowingBranch<U>>,
}

enum GrowingBranch<U> {
    Leaf(DataType, Vec<U>),
    Inner(Growing<U>, Option<usize>),
}

impl<U> Default for Growing<U> {
    fn default() -> Self {
        Self {
            branches: BTreeMap::new(),
        }
    }
}

impl<U> Growing<U> {
    fn insert(&mut self, leaf: &Declaration<'_, U>, users: Vec<U>) {
        let data = DataType::from(&leaf.leaf());
        let Some((last, inner)) = leaf.segments.split_last() else {
            return;
        };
        let mut tree = self;
        for (index, segment) in inner.iter().enumerate() {
            let cycler = leaf
                .instance
                .filter(|(at, _)| *at == index)
                .map(|(_, cycler)| cycler);
            let branch = tree
                .branches
                .entry(segment.name.clone())
                .or_insert_with(|| GrowingBranch::Inner(Self::default(), cycler));
            match branch {
                GrowingBranch::Inner(below, instance) => {
                    *instance = instance.or(cycler);
                    tree = below;
                }
                // A leaf above was found before and has taken its users.
                GrowingBranch::Leaf(..) => return,
            }
        }
        tree.branches
            .insert(last.name.clone(), GrowingBranch::Leaf(data, users));
    }

    fn into_tree(self) -> Tree<U> {
        let branches = self.branches.into_iter().map(|(name, branch)| Branch {
            name,
            content: match branch {
                GrowingBranch::Leaf(data, users) => Content::Leaf { data, users },
                GrowingBranch::Inner(tree, None) => Content::Inner(tree.into_tree()),
                GrowingBranch::Inner(tree, Some(cycler)) => Content::Instance {
                    cycler,
                    tree: tree.into_tree(),
                },
            },
        });
        Tree {
            branches: branches.collect(),
            open: false,
        }
    }
}
