//! The oracle's rules about parameters: every declared one has a value of its type, and nothing else has one.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::oracle::{Breach, Oracle, Path, path};
use crate::reading::{Definition, Field, argument};
use crate::robot::{Node, PARAMETERS, Robot, snake_case};

/// A parameter that a field declares, for one instance.
struct Parameter<'r> {
    path: Path,
    data: &'r str,
    node: &'r Node,
    field: &'r Field,
}

/// A value and where it stands.
type Value<'t> = Spanned<DeValue<'t>>;

/// Compares what nodes declare with each other and with the files.
pub(crate) fn check(oracle: &mut Oracle<'_>) {
    let robot = oracle.robot;
    let mut fields = Vec::new();
    let mut declared = Vec::new();
    for cycler in oracle.cyclers {
        for (node, field) in oracle.fields(cycler, &["Parameter"]) {
            let [literal] = &field.literals[..] else {
                continue;
            };
            let (Some(path), Some(data)) = (path(&literal.text), field.types.first()) else {
                continue;
            };
            fields.push((node, field));
            let is_instance = |name: &str| name == "$cycler_instance";
            let count = if path.iter().any(|one| is_instance(&one.name)) {
                cycler.instances.len()
            } else {
                1
            };
            for instance in &cycler.instances[..count] {
                let mut path = path.clone();
                for segment in path.iter_mut().filter(|one| is_instance(&one.name)) {
                    segment.name = snake_case(instance);
                }
                let data = &data.text;
                declared.push(Parameter {
                    path,
                    data,
                    node,
                    field,
                });
            }
        }
    }
    oracle.check_tree("parameters agree", &fields);
    let layers: Vec<_> = robot
        .layers
        .iter()
        .filter_map(|(file, text)| Some((file.as_str(), DeTable::parse(text).ok()?.into_inner())))
        .collect();
    for (file, table) in &layers {
        check_keys(oracle, file, table, &mut Vec::new(), &declared);
    }
    let locations = robot.locations();
    for one in &declared {
        let has_value = |location: &String| {
            let values: Vec<&Value<'_>> = layers
                .iter()
                .filter(|(file, _)| is_for_all(file) || file.starts_with(location))
                .filter_map(|(_, table)| at(table, &one.path))
                .collect();
            is_complete(robot, &one.node.file, one.data, &values)
        };
        if !locations.iter().all(has_value) {
            oracle.add("parameter has a value", &one.node.file, &one.field.bytes);
        }
    }
}

/// Whether every target has this layer.
fn is_for_all(file: &str) -> bool {
    !file[PARAMETERS.len()..].contains('/')
}

fn at<'t>(table: &'t DeTable<'t>, path: &Path) -> Option<&'t Value<'t>> {
    let (last, above) = path.split_last()?;
    let mut table = table;
    for segment in above {
        table = table.get(segment.name.as_str())?.get_ref().as_table()?;
    }
    table.get(last.name.as_str())
}

/// Every key is declared, every value has its type.
fn check_keys(
    oracle: &mut Oracle<'_>,
    file: &str,
    table: &DeTable<'_>,
    above: &mut Vec<String>,
    declared: &[Parameter<'_>],
) {
    for (key, value) in table {
        if above.is_empty() && key.get_ref() == "hardware" {
            continue;
        }
        above.push(key.get_ref().to_string());
        let leads =
            |one: &&Parameter<'_>| one.path.iter().zip(above.iter()).all(|(a, b)| a.name == *b);
        let leaves: Vec<_> = declared
            .iter()
            .filter(leads)
            .filter(|one| one.path.len() <= above.len())
            .collect();
        let has_below = declared
            .iter()
            .filter(leads)
            .any(|one| one.path.len() > above.len());
        match (leaves.first(), value.get_ref().as_table()) {
            (Some(leaf), _) => {
                if let Some(place) = wrong_place(oracle.robot, &leaf.node.file, leaf.data, value) {
                    let field = (leaf.node.file.clone(), Some(leaf.field.bytes.clone()));
                    let places = vec![(file.to_owned(), Some(place)), field];
                    oracle.breaches.push(Breach {
                        rule: "value has its type",
                        places,
                    });
                }
            }
            (None, Some(inner)) if has_below => check_keys(oracle, file, inner, above, declared),
            (None, _) if has_below => oracle.add("table", file, &value.span()),
            _ => oracle.add("parameter is declared", file, &key.span()),
        }
        above.pop();
    }
}

/// Where a value is not of its type, or a table has a key that is no field.
fn wrong_place(
    robot: &Robot,
    file: &str,
    data: &str,
    value: &Value<'_>,
) -> Option<std::ops::Range<usize>> {
    let here = |right: bool| (!right).then(|| value.span());
    let inner = value.get_ref();
    if let Some(data) = argument(data, "Option") {
        return wrong_place(robot, file, data, value);
    }
    if let Some(data) = argument(data, "Vec") {
        return match inner.as_array() {
            Some(items) => items
                .iter()
                .find_map(|item| wrong_place(robot, file, data, item)),
            None => here(false),
        };
    }
    let whole = |least: i64, greatest: i64| {
        let number = inner
            .as_integer()
            .and_then(|number| number.as_str().parse::<i64>().ok());
        number.is_some_and(|number| (least..=greatest).contains(&number))
    };
    match data {
        "f32" | "f64" => return here(inner.is_float() || inner.is_integer()),
        "bool" => return here(inner.is_bool()),
        "String" => return here(inner.is_str()),
        "u8" => return here(whole(0, 255)),
        "u16" => return here(whole(0, 65535)),
        "u32" => return here(whole(0, i64::from(u32::MAX))),
        "u64" | "usize" => return here(whole(0, i64::MAX)),
        _ => {}
    }
    let head = data.split('<').next().unwrap_or(data);
    match robot.definition(file, head)? {
        Definition::Enum {
            variants: Some(names),
        } => here(
            inner
                .as_str()
                .is_some_and(|name| names.iter().any(|one| one == name)),
        ),
        Definition::Struct {
            fields,
            plain: true,
            ..
        } => {
            if let Some(items) = inner.as_array() {
                let mut pairs = items.iter().zip(fields);
                let wrong = pairs.find_map(|(item, (_, field, _))| {
                    wrong_place(robot, file, &filled(data, field), item)
                });
                return wrong.or_else(|| here(items.len() == fields.len()));
            }
            let Some(table) = inner.as_table() else {
                return here(false);
            };
            table.iter().find_map(|(key, value)| {
                let field = fields.iter().find(|(name, ..)| name == key.get_ref());
                match field {
                    Some((_, field, _)) => wrong_place(robot, file, &filled(data, field), value),
                    None => Some(key.span()),
                }
            })
        }
        _ => None,
    }
}

/// Whether files give all of a value; the later ones win, tables merge.
fn is_complete(robot: &Robot, file: &str, data: &str, values: &[&Value<'_>]) -> bool {
    if argument(data, "Option").is_some() {
        return true;
    }
    let Some(last) = values.last() else {
        return false;
    };
    if let (Some(data), Some(_)) = (argument(data, "Vec"), last.get_ref().as_array()) {
        // Layers do not mend each other's lists, and another target's robot may have the earlier one.
        return values
            .iter()
            .filter_map(|value| value.get_ref().as_array())
            .flatten()
            .all(|item| is_complete(robot, file, data, &[item]));
    }
    let head = data.split('<').next().unwrap_or(data);
    let Some(Definition::Struct {
        fields,
        plain: true,
        ..
    }) = robot.definition(file, head)
    else {
        return true;
    };
    if last.get_ref().is_array() {
        // One of another length is of the wrong type.
        return true;
    }
    let tables: Vec<_> = values
        .iter()
        .filter_map(|value| value.get_ref().as_table())
        .collect();
    fields.iter().all(|(name, field, _)| {
        let values: Vec<_> = tables
            .iter()
            .filter_map(|table| table.get(name.as_str()))
            .collect();
        is_complete(robot, file, &filled(data, field), &values)
    })
}

/// The type of a field of a type with one parameter at most, which is called `T`.
fn filled(data: &str, field: &str) -> String {
    match (field, data.split_once('<')) {
        ("T", Some((_, argument))) => argument.trim_end_matches('>').to_owned(),
        _ => field.to_owned(),
    }
}
