//! Values that no file gives, target by target: what another location's files say is not there for it.

use std::collections::{BTreeMap, BTreeSet};

use camino::Utf8PathBuf;

use super::Checker;
use super::expected::Expected;
use super::given::Robots;
use super::layer::Layer;
use super::unset::{self, Left, Part};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, listed};
use crate::resolve::robot::{CreationBinding, CycleBinding, Robot};

/// More files of others say nothing more.
const MOST_OTHERS: usize = 3;

/// A location where targets run.
struct Place<'a> {
    targets: Vec<&'a str>,
    /// What its robots may have, in the order in which it is merged.
    layers: Vec<&'a Layer<'a>>,
}

/// Reports declared paths that no file of a target gives.
pub(super) fn check(checker: &Checker<'_>, layers: &[Layer<'_>], diagnostics: &mut Diagnostics) {
    let robot = checker.robot;
    let default = robot.parameters.join("default.toml");
    if robot.parameter_tree.branches.is_empty() {
        return;
    }
    let Some(first) = layers.iter().find(|layer| layer.file == default) else {
        // It does not exist or cannot be parsed; both are told.
        return;
    };
    let places = places(checker, layers);
    let root = Expected::Tree(&robot.parameter_tree);
    let mut missing: BTreeMap<Vec<String>, Vec<&Place<'_>>> = BTreeMap::new();
    for place in &places {
        let parts: Vec<Part<'_>> = (place.layers.iter())
            .map(|layer| Part {
                table: &layer.table,
                is_certain: layer.robots.identity.is_none(),
            })
            .collect();
        let mut paths = BTreeSet::new();
        gather(checker, &parts, &root, &mut Vec::new(), &mut paths);
        for path in paths {
            missing.entry(path).or_default().push(place);
        }
    }
    let count = checker.locations().len();
    for (path, lacking) in &missing {
        let told = Missing {
            path,
            lacking,
            is_everywhere: lacking.len() == count,
        };
        diagnostics.add(told.diagnostic(checker, first, layers));
    }
}

/// Every location whose default can be read: the others are told, and what they would give is not known.
fn places<'a>(checker: &Checker<'a>, layers: &'a [Layer<'a>]) -> Vec<Place<'a>> {
    let of_location = |location: Option<String>| {
        let targets = checker.robot.targets.iter();
        let mut of_place: Vec<&Layer<'_>> = layers
            .iter()
            .filter(|layer| layer.robots.location.is_none() || layer.robots.location == location)
            .collect();
        let is_readable = location.is_none()
            || of_place
                .iter()
                .any(|layer| layer.robots.location.is_some() && layer.robots.identity.is_none());
        // As they are merged: the default of all, that of the location, those of identities.
        of_place.sort_by_key(|layer| layer.robots.identity.is_some());
        is_readable.then(|| Place {
            targets: targets
                .filter(|target| checker.location(target) == location)
                .map(|target| target.name.as_str())
                .collect(),
            layers: of_place,
        })
    };
    checker
        .locations()
        .into_iter()
        .filter_map(of_location)
        .collect()
}

fn gather(
    checker: &Checker<'_>,
    parts: &[Part<'_>],
    expected: &Expected<'_>,
    path: &mut Vec<String>,
    missing: &mut BTreeSet<Vec<String>>,
) {
    let Some(children) = expected.children(checker.sources) else {
        return;
    };
    for (name, child) in children.of_tables(parts.iter().map(|part| part.table)) {
        let names: Vec<&str> = child.names(&name).collect();
        let left = unset::left(parts, &names);
        let below: Vec<Part<'_>> = left.iter().filter_map(Left::part).collect();
        path.push(name.clone());
        let is_tree = matches!(child.expected, Expected::Tree(_));
        if is_tree || !below.is_empty() && below.len() == left.len() {
            gather(checker, &below, &child.expected, path, missing);
        } else if left.is_empty() && child.required {
            missing.insert(path.clone());
        }
        path.pop();
    }
}

/// A path and where no file gives it.
struct Missing<'a> {
    path: &'a [String],
    lacking: &'a [&'a Place<'a>],
    /// Whether no target has it.
    is_everywhere: bool,
}

impl Missing<'_> {
    fn diagnostic(
        &self,
        checker: &Checker<'_>,
        first: &Layer<'_>,
        layers: &[Layer<'_>],
    ) -> Diagnostic {
        let path = self.path;
        let written = path.join(".");
        let message = format!("no file gives the parameter `{written}`");
        let targets: Vec<&str> = (self.lacking.iter())
            .flat_map(|place| &place.targets)
            .copied()
            .collect();
        let message = match targets.as_slice() {
            _ if self.is_everywhere => message,
            [only] => format!("{message} for target `{only}`"),
            _ => format!("{message} for targets {}", listed(targets)),
        };
        let looked_at: BTreeSet<&str> = (self.lacking.iter())
            .flat_map(|place| &place.layers)
            .map(|layer| layer.file.as_str())
            .collect();
        let help = match looked_at.len() {
            1 => format!("add `{written} = …`"),
            _ => format!(
                "add `{written} = …`; looked at {}",
                listed(looked_at.iter().copied())
            ),
        };
        let mut error = Diagnostic::new(Code::MissingParameter, message)
            .at(first.file, first.nearest(path), "")
            .help(help);
        if let Some((file, range)) = declaration(checker.robot, path) {
            error = error.at(&file, range, "read here");
        }
        let others = layers
            .iter()
            .filter(|layer| !looked_at.contains(layer.file.as_str()))
            .filter_map(|layer| Some((layer, layer.given(path)?)));
        for (layer, place) in others.take(MOST_OTHERS) {
            error = error.at(layer.file, place, given_for(&layer.robots));
        }
        error
    }
}

/// Whose robots a value at another location is for.
fn given_for(robots: &Robots) -> String {
    let location = robots.location.as_deref().unwrap_or_default();
    match &robots.identity {
        None => format!("given for location `{location}`"),
        Some(one) => format!(
            "given for {} `{}` at location `{location}`",
            one.name, one.id
        ),
    }
}

/// The first field that declares the path or what it lies below.
fn declaration(robot: &Robot, path: &[String]) -> Option<(Utf8PathBuf, std::ops::Range<usize>)> {
    robot.cyclers.iter().find_map(|cycler| {
        let instances: Vec<String> = cycler
            .instances
            .iter()
            .map(|one| schema::snake_case(&one.name))
            .collect();
        cycler.nodes.iter().find_map(|node| {
            let creation = node
                .creation
                .iter()
                .filter_map(|field| match &field.binding {
                    CreationBinding::Parameter { access, .. } => Some((access, &field.range)),
                    _ => None,
                });
            let cycle = node.cycle.iter().filter_map(|field| match &field.binding {
                CycleBinding::Parameter { access, .. } => Some((access, &field.range)),
                _ => None,
            });
            let mut fields = creation.chain(cycle);
            let (_, range) = fields.find(|(access, _)| {
                access.segments.len() <= path.len()
                    && access.segments.iter().zip(path).all(|(segment, name)| {
                        match segment.instance {
                            true => instances.contains(name),
                            false => segment.name == *name,
                        }
                    })
            })?;
            Some((node.file.clone(), range.clone()))
        })
    })
}
