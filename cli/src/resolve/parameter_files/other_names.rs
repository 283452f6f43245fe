//! Fields that have several names (`#[serde(alias)]`) and are given by two of them: serde takes that for two values.

use std::ops::Range;

use toml::de::DeTable;

use super::expected::Expected;
use super::layer::Layer;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::resolve::robot::Robot;
use crate::scan::Sources;

/// A table of a layer.
type Table<'a> = (&'a Layer<'a>, &'a DeTable<'a>);

/// A key of a layer.
struct Given<'a> {
    layer: &'a Layer<'a>,
    name: String,
    place: Range<usize>,
}

/// Reports every field that layers of one robot give by different names.
pub(super) fn check(
    layers: &[Layer<'_>],
    robot: &Robot,
    sources: &Sources<'_>,
    diagnostics: &mut Diagnostics,
) {
    let tables: Vec<Table<'_>> = layers.iter().map(|layer| (layer, &layer.table)).collect();
    let root = Expected::Tree(&robot.parameter_tree);
    check_tables(&tables, &root, sources, &mut Vec::new(), diagnostics);
}

fn check_tables(
    tables: &[Table<'_>],
    expected: &Expected<'_>,
    sources: &Sources<'_>,
    path: &mut Vec<String>,
    diagnostics: &mut Diagnostics,
) {
    let Some(children) = expected.children(sources) else {
        return;
    };
    let only: Vec<&DeTable<'_>> = tables.iter().map(|(_, table)| *table).collect();
    for (name, child) in children.of_tables(only.iter().copied()) {
        if child.alias_of.is_some() {
            continue;
        }
        let (mut given, mut below) = (Vec::new(), Vec::new());
        for (layer, table) in tables {
            for (key, value) in child
                .names(&name)
                .filter_map(|name| table.get_key_value(name))
            {
                given.push(Given {
                    layer,
                    name: key.get_ref().to_string(),
                    place: key.span(),
                });
                below.extend(value.get_ref().as_table().map(|table| (*layer, table)));
            }
        }
        path.push(name);
        report(&given, path, diagnostics);
        if !below.is_empty() {
            check_tables(&below, &child.expected, sources, path, diagnostics);
        }
        path.pop();
    }
}

fn report(given: &[Given<'_>], path: &[String], diagnostics: &mut Diagnostics) {
    for (index, one) in given.iter().enumerate() {
        let clashes = |other: &&Given<'_>| {
            other.name != one.name && other.layer.robots.overlap(&one.layer.robots)
        };
        let Some(other) = given[..index].iter().find(clashes) else {
            continue;
        };
        let message = format!("`{}` is given by two names", path.join("."));
        let error = Diagnostic::new(Code::DuplicateParameter, message)
            .at(one.layer.file, one.place.clone(), "another name of it")
            .at(other.layer.file, other.place.clone(), "given here")
            .help(format!(
                "write `{}` at both places, or remove one",
                other.name
            ));
        diagnostics.add(error);
    }
}
