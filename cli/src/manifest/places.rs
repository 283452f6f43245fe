//! Where every name of the manifest stands.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{
    Bridge, Cycler, DeployRanges, Instance, Manifest, NodeEntry, SchedulingRanges, Target,
};

/// Joins the manifest with its places. Both come from one text, so what the one has, the other has.
pub(super) fn locate(declared: schema::Manifest, table: &DeTable<'_>) -> Manifest {
    let cyclers = elements(table, "cycler");
    let targets = elements(table, "target");
    let bridges = elements(table, "bridge");
    let robot = table.get("robot");
    let generated = robot.and_then(|robot| range_of(robot, "generated").or(Some(robot.span())));
    let parameters = robot.and_then(|robot| range_of(robot, "parameters").or(Some(robot.span())));
    let identities = robot.map_or(&[][..], |robot| list(robot, "identities"));
    Manifest {
        identity_ranges: identities.iter().map(Spanned::span).collect(),
        robot: declared.robot,
        generated_range: generated.unwrap_or(0..0),
        parameters_range: parameters.unwrap_or(0..0),
        cyclers: zip(declared.cycler, cyclers, locate_cycler),
        targets: zip(declared.target, targets, locate_target),
        bridges: zip(declared.bridge, bridges, locate_bridge),
    }
}

fn zip<D, T>(
    declared: Vec<D>,
    places: &[Spanned<DeValue<'_>>],
    locate: impl Fn(D, &Spanned<DeValue<'_>>) -> T,
) -> Vec<T> {
    let pairs = declared.into_iter().zip(places);
    pairs
        .map(|(declared, place)| locate(declared, place))
        .collect()
}

fn locate_cycler(declared: schema::Cycler, place: &Spanned<DeValue<'_>>) -> Cycler {
    let name_range = range_of(place, "name").unwrap_or_else(|| place.span());
    let mut nodes = Vec::new();
    for (key, entries, setup) in [
        ("setup_nodes", &declared.setup_nodes, true),
        ("nodes", &declared.nodes, false),
    ] {
        let places = list(place, key);
        nodes.extend(entries.iter().zip(places).map(|(entry, place)| NodeEntry {
            path: entry.path().clone(),
            setup,
            on_failure: entry.on_failure(),
            range: range_of(place, "node").unwrap_or_else(|| place.span()),
        }));
    }
    let mut places = list(place, "instances").iter();
    let tables = declared
        .instances
        .iter()
        .flatten()
        .map(|one| one.table().cloned());
    let mut tables = tables.chain(std::iter::repeat(None));
    let instances = declared
        .instance_names()
        .into_iter()
        .map(|name| {
            let place = places.next();
            Instance {
                name,
                table: tables.next().flatten(),
                range: place.map_or_else(
                    || name_range.clone(),
                    |place| range_of(place, "name").unwrap_or_else(|| place.span()),
                ),
                record_range: place.and_then(|place| range_of(place, "record")),
                scheduling_ranges: place.map(locate_scheduling).unwrap_or_default(),
            }
        })
        .collect();
    Cycler {
        record_range: range_of(place, "record"),
        scheduling_ranges: locate_scheduling(place),
        declared,
        name_range,
        instances,
        nodes,
    }
}

fn locate_target(declared: schema::Target, place: &Spanned<DeValue<'_>>) -> Target {
    let range = |key| range_of(place, key).unwrap_or_else(|| place.span());
    Target {
        name_range: range("name"),
        hardware_range: range("hardware"),
        location_range: range_of(place, "location"),
        triple_range: range_of(place, "triple"),
        profile_range: range_of(place, "profile"),
        deploy_ranges: below(place, "deploy")
            .map(locate_deploy)
            .unwrap_or_default(),
        declared,
    }
}

fn locate_deploy(place: &Spanned<DeValue<'_>>) -> DeployRanges {
    DeployRanges {
        values: ranges(place),
        files: list(place, "files").iter().map(Spanned::span).collect(),
        hosts: below(place, "hosts").map(ranges).unwrap_or_default(),
    }
}

/// Of a cycler, or of an instance's table.
fn locate_scheduling(place: &Spanned<DeValue<'_>>) -> SchedulingRanges {
    let range = |key| range_of(below(place, "scheduling")?, key);
    SchedulingRanges {
        policy: range("policy"),
        priority: range("priority"),
    }
}

fn locate_bridge(declared: schema::Bridge, place: &Spanned<DeValue<'_>>) -> Bridge {
    let range = |key| range_of(place, key).unwrap_or_else(|| place.span());
    Bridge {
        path_range: range("path"),
        key_range: range("key"),
        declared,
    }
}

/// The range of a value in a table; `None` where the place is no table or lacks the key.
pub(super) fn range_of(place: &Spanned<DeValue<'_>>, key: &str) -> Option<Range<usize>> {
    Some(below(place, key)?.span())
}

/// A value in a table; `None` where the place is no table or lacks the key.
fn below<'a, 'i>(place: &'a Spanned<DeValue<'i>>, key: &str) -> Option<&'a Spanned<DeValue<'i>>> {
    place.get_ref().as_table()?.get(key)
}

/// Of all values in a table.
fn ranges(place: &Spanned<DeValue<'_>>) -> BTreeMap<String, Range<usize>> {
    let values = place.get_ref().as_table().into_iter().flatten();
    values
        .map(|(key, value)| (key.get_ref().to_string(), value.span()))
        .collect()
}

fn elements<'a, 'i>(table: &'a DeTable<'i>, key: &str) -> &'a [Spanned<DeValue<'i>>] {
    table.get(key).map_or(&[], array)
}

fn list<'a, 'i>(place: &'a Spanned<DeValue<'i>>, key: &str) -> &'a [Spanned<DeValue<'i>>] {
    below(place, key).map_or(&[], array)
}

fn array<'a, 'i>(value: &'a Spanned<DeValue<'i>>) -> &'a [Spanned<DeValue<'i>>] {
    value.get_ref().as_array().map_or(&[], |array| array)
}
