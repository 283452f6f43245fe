//! `param`: parameters of a running robot.

use protocol::{Ask, Change, Entry, Good, Provenance, Reading, Unstored};
use serde_json::{Value, json};

use super::connection::Connection;
use super::text;
use crate::arguments::{Param, ParamCommand, TextOrJson};
use crate::commands::terminal::Terminal;
use crate::outcome::{Outcome, Refusal};
use crate::recording::part;

/// Parameters do not lie deeper in each other.
const WHOLE: u8 = 32;

pub(in crate::commands) fn param(terminal: &Terminal, param: &Param) -> Result<Outcome, Refusal> {
    let shown = match &param.command {
        ParamCommand::Get { path, running } => {
            let reading = read(&mut Connection::open(running)?, path.as_deref())?;
            match running.format {
                TextOrJson::Text => text::tree(&reading.value),
                TextOrJson::Json => {
                    let (value, version) = (&reading.value, reading.version);
                    format!("{}\n", json!({ "value": value, "version": version }))
                }
            }
        }
        ParamCommand::Set { changes, running } => {
            let changes: Vec<Change> = changes
                .iter()
                .map(|change| parse(change))
                .collect::<Result<_, _>>()?;
            let mut connection = Connection::open(running)?;
            let ask = Ask::Write {
                changes: changes.clone(),
            };
            let Good::Written { version } = connection.ask(ask)? else {
                return Err(connection.confused());
            };
            match running.format {
                TextOrJson::Text => {
                    // What is done is done, also where the robot cannot be asked any more.
                    let known = unstored(&mut connection);
                    let creation_only = known.map(|known| known.creation_only);
                    for path in waiting(&changes, &creation_only.unwrap_or_default()) {
                        terminal.note(&format!(
                            "`{path}` is read only when nodes are created: store it and start the robot again\n"
                        ));
                    }
                    written(&changes, version)
                }
                TextOrJson::Json => format!("{}\n", json!({ "version": version })),
            }
        }
        ParamCommand::List { path, running } => {
            let mut connection = Connection::open(running)?;
            let path = path.as_deref().map(without_root);
            let reading = read(&mut connection, path)?;
            let unstored = unstored(&mut connection)?;
            let entries = entries(&mut connection)?;
            let list = list(&reading, path.unwrap_or_default(), &unstored, &entries);
            match running.format {
                TextOrJson::Text => {
                    text::columns(&list.iter().map(Listed::row).collect::<Vec<_>>(), false)
                }
                TextOrJson::Json => list
                    .iter()
                    .map(|listed| format!("{}\n", listed.json()))
                    .collect(),
            }
        }
        ParamCommand::Store {
            layer,
            paths,
            running,
        } => {
            let mut connection = Connection::open(running)?;
            match layer {
                None => show_unstored(&unstored(&mut connection)?, running.format),
                Some(layer) => store(terminal, &mut connection, layer, paths, running.format)?,
            }
        }
    };
    terminal.data(&shown)?;
    Ok(Outcome::Good)
}

/// `PATH=VALUE`: JSON, or else a text.
fn parse(change: &str) -> Result<Change, Refusal> {
    let Some((path, value)) = change.split_once('=') else {
        return Err(
            Refusal::wrong_usage(format!("`{change}` is not PATH=VALUE"))
                .help("for example `ball_filter.gate=2.5`"),
        );
    };
    Ok(Change {
        path: without_root(path.trim()).to_owned(),
        value: serde_json::from_str(value).unwrap_or_else(|_| Value::String(value.to_owned())),
    })
}

/// A line for each change, and how long they last.
fn written(changes: &[Change], version: u64) -> String {
    let line = |change: &Change| format!("{} = {}\n", change.path, change.value);
    let lines: String = changes.iter().map(line).collect();
    format!(
        "{lines}version {version} of the parameters, until the robot ends; `hulkgen param store` tells how to keep them\n"
    )
}

/// Which of the parameters that nodes read only when they are created were changed, in part or as a part of more.
fn waiting<'a>(changes: &[Change], creation_only: &'a [String]) -> Vec<&'a str> {
    let is_in = |inner: &str, outer: &str| {
        let rest = inner.strip_prefix(outer);
        outer.is_empty() || rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    let is_changed = |path: &&str| {
        let mut changed = changes.iter().map(|change| change.path.as_str());
        changed.any(|changed| is_in(changed, path) || is_in(path, changed))
    };
    creation_only
        .iter()
        .map(String::as_str)
        .filter(is_changed)
        .collect()
}

/// People may write paths of parameters as subscriptions have them.
fn without_root(path: &str) -> &str {
    match path.strip_prefix("parameters") {
        Some("") => "",
        Some(rest) => rest.strip_prefix('.').unwrap_or(path),
        None => path,
    }
}

fn read(connection: &mut Connection, path: Option<&str>) -> Result<Reading, Refusal> {
    let path = path.map(without_root).unwrap_or_default().to_owned();
    match connection.ask(Ask::Parameters { path })? {
        Good::Parameters(reading) => Ok(reading),
        _ => Err(connection.confused()),
    }
}

fn unstored(connection: &mut Connection) -> Result<Unstored, Refusal> {
    match connection.ask(Ask::Unstored {})? {
        Good::Unstored(unstored) => Ok(unstored),
        _ => Err(connection.confused()),
    }
}

fn entries(connection: &mut Connection) -> Result<Vec<Entry>, Refusal> {
    let below = "parameters".to_owned();
    match connection.ask(Ask::Paths {
        below,
        depth: Some(WHOLE),
    })? {
        Good::Paths(entries) => Ok(entries),
        _ => Err(connection.confused()),
    }
}

/// One parameter with all that is known of it.
struct Listed<'a> {
    path: &'a str,
    value: &'a Value,
    provenance: &'a Provenance,
    entry: Option<&'a Entry>,
    is_unstored: bool,
}

fn list<'a>(
    reading: &'a Reading,
    root: &str,
    unstored: &'a Unstored,
    entries: &'a [Entry],
) -> Vec<Listed<'a>> {
    let listed = |leaf: &'a protocol::Leaf| {
        let path = leaf.path.as_str();
        let rest = path.strip_prefix(root).unwrap_or(path);
        let changed = |change: &protocol::UnstoredChange| {
            change.path == path
                || change
                    .path
                    .strip_prefix(path)
                    .is_some_and(|below| below.starts_with('.'))
        };
        Listed {
            path,
            // What is not there is null.
            value: part(&reading.value, rest.trim_start_matches('.')).unwrap_or(&Value::Null),
            provenance: &leaf.provenance,
            entry: entries
                .iter()
                .find(|entry| without_root(&entry.path) == path),
            is_unstored: unstored.changes.iter().any(changed),
        }
    };
    reading.leaves.iter().map(listed).collect()
}

impl Listed<'_> {
    fn row(&self) -> Vec<String> {
        let unit = self.entry.and_then(|entry| entry.unit.as_deref());
        let range = self.entry.and_then(|entry| entry.range);
        let about = [
            unit.map(str::to_owned),
            range.map(|range| text::range(&range)),
        ];
        let about: Vec<String> = about.into_iter().flatten().collect();
        let mark = if self.is_unstored {
            "  (in no file)"
        } else {
            ""
        };
        vec![
            format!("{} = {}", self.path, self.value),
            about.join(" "),
            format!("{}{mark}", origin(self.provenance)),
        ]
    }

    fn json(&self) -> Value {
        json!({
            "path": self.path,
            "value": self.value,
            "provenance": self.provenance,
            "unit": self.entry.and_then(|entry| entry.unit.as_deref()),
            "range": self.entry.and_then(|entry| entry.range),
            "unstored": self.is_unstored,
        })
    }
}

fn origin(provenance: &Provenance) -> String {
    match provenance {
        Provenance::File { file, line } => format!("{file}:{line}"),
        Provenance::Environment { variable } => format!("${variable}"),
        Provenance::Setting { setting } => format!("--set {setting}"),
        Provenance::Live { version } => format!("live, version {version}"),
        Provenance::Nowhere => "default".to_owned(),
    }
}

fn show_unstored(unstored: &Unstored, format: TextOrJson) -> String {
    if format == TextOrJson::Json {
        return format!("{}\n", json!(unstored));
    }
    let row = |change: &protocol::UnstoredChange| {
        vec![
            format!("{} = {}", change.path, change.value),
            format!("files say {}", text::leaf(&change.stored)),
        ]
    };
    let rows: Vec<_> = unstored.changes.iter().map(row).collect();
    let deed = match rows.as_slice() {
        [] => "the files say all that is so",
        _ => "`hulkgen param store LAYER` writes this into the file of a layer",
    };
    let layers = unstored.layers.join(", ");
    format!(
        "{}{deed}; layers, later ones win: {layers}\n",
        text::columns(&rows, false)
    )
}

fn store(
    terminal: &Terminal,
    connection: &mut Connection,
    layer: &str,
    paths: &[String],
    format: TextOrJson,
) -> Result<String, Refusal> {
    let paths = paths.iter().map(|path| without_root(path).to_owned());
    let good = connection.ask(Ask::Store {
        layer: layer.to_owned(),
        paths: paths.collect(),
    });
    let good = good.map_err(|refusal| of_location(refusal, layer))?;
    let Good::Stored(stored) = good else {
        return Err(connection.confused());
    };
    if format == TextOrJson::Json {
        return Ok(format!("{}\n", json!(stored)));
    }
    for warning in &stored.warnings {
        terminal.note(&format!("warning: {warning}\n"));
    }
    let paths = match stored.paths.as_slice() {
        [] => "nothing was to be stored".to_owned(),
        paths => paths.join(", "),
    };
    Ok(format!("{}: {paths}\n", stored.file))
}

/// Says when the layers of a location are there.
fn of_location(refusal: Refusal, layer: &str) -> Refusal {
    match layer.split_once('/') {
        Some((location, _)) if refusal.message.starts_with("no layer ") => refusal.help(format!(
            "layers of `{location}` are there while the robot runs at it: start it with `--location {location}`"
        )),
        _ => refusal,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{of_location, parse, show_unstored, waiting, without_root, written};
    use crate::arguments::TextOrJson;
    use crate::outcome::Refusal;

    #[test]
    fn whose_location_is_another_is_told_how_to_get_there() {
        let refused = |message: &str, layer: &str| of_location(Refusal::bad(message), layer).help;
        let message = "no layer `hall_3/default`: this robot has `default`";
        let help = refused(message, "hall_3/default").unwrap_or_default();
        assert!(help.contains("`--location hall_3`"), "{help}");
        assert_eq!(refused(message, "hall_3"), None);
        assert_eq!(refused("it is full", "hall_3/default"), None);
    }

    #[test]
    fn a_change_says_what_is_so_now() {
        let changes = ["walk.speed=0.2", "parameters.name=Max"];
        let changes = changes.map(|change| parse(change).expect("it has an equals sign"));
        let text = written(&changes, 3);
        let lines = "walk.speed = 0.2\nname = \"Max\"\nversion 3 of the parameters";
        assert!(text.starts_with(lines), "{text}");
        let creation_only = ["name", "walk", "walker.name", "nam", "walk.speed.x"];
        let creation_only = creation_only.map(str::to_owned);
        assert_eq!(
            waiting(&changes, &creation_only),
            ["name", "walk", "walk.speed.x"]
        );
    }

    #[test]
    fn what_is_in_no_file_is_shown_with_the_command_that_stores_it() {
        let mut unstored = protocol::Unstored {
            version: 2,
            creation_only: Vec::new(),
            changes: vec![protocol::UnstoredChange {
                path: "walk.speed".to_owned(),
                value: json!(0.2),
                stored: json!(0.1),
                version: 2,
            }],
            layers: vec!["default".to_owned(), "lab/default".to_owned()],
        };
        let text = show_unstored(&unstored, TextOrJson::Text);
        let lines: Vec<&str> = text.lines().collect();
        let [change, deed] = lines[..] else {
            panic!("{text}")
        };
        assert!(change.ends_with("files say 0.1"), "{text}");
        assert!(deed.starts_with("`hulkgen param store LAYER`"), "{text}");
        assert!(deed.ends_with(": default, lab/default"), "{text}");
        unstored.changes.clear();
        let text = show_unstored(&unstored, TextOrJson::Text);
        assert!(!text.contains("LAYER"), "{text}");
    }

    #[test]
    fn values_are_json_or_texts() {
        for (text, path, value) in [
            ("walk.speed=0.2", "walk.speed", json!(0.2)),
            ("parameters.name=Max", "name", json!("Max")),
            ("equation=a=b", "equation", json!("a=b")),
            ("list=[1,2]", "list", json!([1, 2])),
            ("empty=", "empty", json!("")),
        ] {
            let change = parse(text).expect("it has an equals sign");
            assert_eq!((change.path.as_str(), change.value), (path, value));
        }
        assert!(parse("walk.speed").is_err());
    }

    #[test]
    fn the_root_may_stand_in_front() {
        assert_eq!(without_root("parameters"), "");
        assert_eq!(without_root("parameters.walk"), "walk");
        assert_eq!(without_root("parametersets.walk"), "parametersets.walk");
    }
}
