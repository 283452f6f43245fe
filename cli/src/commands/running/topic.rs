//! `topic`: outputs of a running robot.

use std::time::{Duration, Instant};

use client::Heard;
use protocol::{Ask, Encoding, Entry, EntryKind, Good, Lost, Message};
use serde_json::{Value, json};

use super::connection::Connection;
use super::{NAMED, again, images, text};
use crate::arguments::{TextOrJson, Topic, TopicCommand};
use crate::commands::plural;
use crate::commands::terminal::Terminal;
use crate::outcome::{Outcome, Refusal};

const OUTPUTS: &[EntryKind] = &[EntryKind::MainOutput, EntryKind::AdditionalOutput];

pub(in crate::commands) fn topic(terminal: &Terminal, topic: &Topic) -> Result<Outcome, Refusal> {
    match &topic.command {
        TopicCommand::List {
            path,
            depth,
            running,
        } => {
            let mut connection = Connection::open(running)?;
            match (path, depth) {
                (None, None) => list_kinds(terminal, &mut connection, running.format, OUTPUTS),
                _ => {
                    let below = path.clone().unwrap_or_default();
                    let entries = paths(&mut connection, below, *depth)?;
                    print_entries(terminal, running.format, &entries)
                }
            }
        }
        TopicCommand::Echo {
            path,
            rate,
            count,
            images,
            running,
        } => {
            let mut connection = Connection::open(running)?;
            if let Some(folder) = images {
                let wanted = images::Wanted {
                    path,
                    rate: *rate,
                    count: *count,
                    folder,
                    format: running.format,
                };
                return images::save(terminal, &mut connection, &wanted);
            }
            echo(
                terminal,
                &mut connection,
                path,
                *rate,
                *count,
                running.format,
            )
        }
        TopicCommand::Hz {
            path,
            count,
            running,
        } => {
            let mut connection = Connection::open(running)?;
            hz(terminal, &mut connection, path, *count, running.format)
        }
        TopicCommand::Info { path, running } => {
            let mut connection = Connection::open(running)?;
            info(terminal, &mut connection, path, running.format)
        }
    }
}

/// Everything of these kinds that has a name of its own, without its parts.
pub(super) fn list_kinds(
    terminal: &Terminal,
    connection: &mut Connection,
    format: TextOrJson,
    kinds: &[EntryKind],
) -> Result<Outcome, Refusal> {
    let mut entries = paths(connection, String::new(), Some(NAMED))?;
    let depth = usize::from(NAMED) - 1;
    entries.retain(|entry| kinds.contains(&entry.kind) && entry.path.matches('.').count() == depth);
    print_entries(terminal, format, &entries)
}

fn paths(
    connection: &mut Connection,
    below: String,
    depth: Option<u8>,
) -> Result<Vec<Entry>, Refusal> {
    match connection.ask(Ask::Paths { below, depth })? {
        Good::Paths(entries) => Ok(entries),
        _ => Err(connection.confused()),
    }
}

fn print_entries(
    terminal: &Terminal,
    format: TextOrJson,
    entries: &[Entry],
) -> Result<Outcome, Refusal> {
    let shown = match format {
        TextOrJson::Text => {
            let row = |entry: &Entry| {
                let unit = entry.unit.as_deref().unwrap_or_default();
                let type_name = entry.type_name.as_deref().unwrap_or_default();
                vec![
                    entry.path.clone(),
                    format!("{type_name} {unit}").trim().to_owned(),
                ]
            };
            text::columns(&entries.iter().map(row).collect::<Vec<_>>(), false)
        }
        TextOrJson::Json => entries
            .iter()
            .map(|entry| format!("{}\n", json!(entry)))
            .collect(),
    };
    terminal.data(&shown)?;
    Ok(Outcome::Good)
}

fn echo(
    terminal: &Terminal,
    connection: &mut Connection,
    path: &str,
    rate: Option<f64>,
    count: Option<u64>,
    format: TextOrJson,
) -> Result<Outcome, Refusal> {
    let subscription = subscribe(connection, path, rate, Encoding::Json)?;
    again(count, None, || {
        loop {
            match connection.hear()? {
                Heard::Message(Message::Update(update)) if update.subscription == subscription => {
                    return terminal.more_data(&match format {
                        TextOrJson::Text => {
                            let value = text::tree(&update.value);
                            let space = if value.lines().count() > 1 {
                                "\n"
                            } else {
                                "  "
                            };
                            let time = text::seconds(update.time);
                            format!("cycle {}, {time}{space}{value}", update.cycle)
                        }
                        TextOrJson::Json => {
                            let (cycle, time) = (update.cycle, update.time);
                            let value = &update.value;
                            format!(
                                "{}\n",
                                json!({ "cycle": cycle, "time": time, "value": value })
                            )
                        }
                    });
                }
                Heard::Message(Message::Lost(lost)) => tell_lost(terminal, lost),
                _ => {}
            }
        }
    })
}

pub(super) fn tell_lost(terminal: &Terminal, lost: Lost) {
    let number = usize::try_from(lost.updates).unwrap_or(usize::MAX);
    terminal.note(&format!("{} lost: too slow\n", plural(number, "update")));
}

pub(super) fn subscribe(
    connection: &mut Connection,
    path: &str,
    rate: Option<f64>,
    encoding: Encoding,
) -> Result<u32, Refusal> {
    let path = path.to_owned();
    match connection.ask(Ask::Subscribe {
        path,
        rate,
        encoding,
    })? {
        Good::Subscribed(subscribed) => Ok(subscribed.subscription),
        _ => Err(connection.confused()),
    }
}

/// What came within a second.
#[derive(Debug, Default, PartialEq)]
struct Second {
    updates: u64,
    lost: u64,
    /// Between two updates, in nanoseconds of the robot's clock.
    longest_gap: u64,
    first: Option<u64>,
    last: Option<u64>,
}

impl Second {
    /// `before`: the time of the last update of the second before.
    fn add(&mut self, time: u64, before: Option<u64>) {
        let last = self.last.or(before);
        let gap = last.map_or(0, |last| time.saturating_sub(last));
        self.longest_gap = self.longest_gap.max(gap);
        self.first = self.first.or(before).or(Some(time));
        self.last = Some(time);
        self.updates += 1;
    }

    /// Updates per second of the robot's clock, if there were two.
    fn rate(&self, before: Option<u64>) -> Option<f64> {
        let (first, last) = (self.first?, self.last?);
        let gaps = self.updates - u64::from(before.is_none());
        (last > first && gaps > 0).then(|| gaps as f64 / ((last - first) as f64 / 1e9))
    }
}

fn hz(
    terminal: &Terminal,
    connection: &mut Connection,
    path: &str,
    count: Option<u64>,
    format: TextOrJson,
) -> Result<Outcome, Refusal> {
    // Bytes: an image as JSON would come slower than the robot makes it.
    let subscription = subscribe(connection, path, None, Encoding::Binary)?;
    let mut before = None;
    again(count, None, || {
        let end = Instant::now() + Duration::from_secs(1);
        let mut second = Second::default();
        while let Some(heard) = connection.hear_before(end)? {
            match heard {
                Heard::Frame(frame) if frame.subscription == subscription => {
                    second.add(frame.time, before);
                }
                Heard::Message(Message::Lost(lost)) => second.lost += lost.updates,
                _ => {}
            }
        }
        let rate = second.rate(before);
        before = second.last.or(before);
        let gap = second.longest_gap as f64 / 1e6;
        terminal.more_data(&match (format, rate) {
            (TextOrJson::Json, _) => {
                let (updates, lost) = (second.updates, second.lost);
                format!(
                    "{}\n",
                    json!({ "rate": rate, "updates": updates, "longest_gap_ms": gap, "lost": lost })
                )
            }
            (TextOrJson::Text, None) => "no rate: fewer than two values came\n".to_owned(),
            (TextOrJson::Text, Some(rate)) => {
                let lost = match second.lost {
                    0 => String::new(),
                    lost => format!(", {lost} lost on the way"),
                };
                format!("{rate:.2} Hz, longest gap {gap:.2} ms{lost}\n")
            }
        })
    })
}

fn info(
    terminal: &Terminal,
    connection: &mut Connection,
    path: &str,
    format: TextOrJson,
) -> Result<Outcome, Refusal> {
    let (above, _) = path.rsplit_once('.').unwrap_or_default();
    let siblings = paths(connection, above.to_owned(), None);
    let found = siblings.as_ref().ok().and_then(|siblings| {
        let mut siblings = siblings.iter();
        siblings.find(|entry| entry.path == path).cloned()
    });
    let Some(entry) = found else {
        // The robot knows what would have been right.
        let path = path.to_owned();
        connection.ask(Ask::Schema { path: path.clone() })?;
        siblings?;
        return Err(Refusal::bad(format!("there is nothing at `{path}`")));
    };
    let children = if entry.has_children {
        paths(connection, path.to_owned(), None)?
    } else {
        Vec::new()
    };
    let has_value = !matches!(entry.kind, EntryKind::Folder | EntryKind::Procedure);
    let schema = match format {
        TextOrJson::Json if has_value => {
            match connection.ask(Ask::Schema {
                path: path.to_owned(),
            })? {
                Good::Schema(schema) => schema,
                _ => return Err(connection.confused()),
            }
        }
        _ => Value::Null,
    };
    let shown = match format {
        TextOrJson::Json => format!("{}\n", json!({ "entry": entry, "schema": schema })),
        TextOrJson::Text => describe(&entry, &children),
    };
    terminal.data(&shown)?;
    Ok(Outcome::Good)
}

fn describe(entry: &Entry, children: &[Entry]) -> String {
    let mut rows = vec![
        vec!["path".to_owned(), entry.path.clone()],
        vec![
            "kind".to_owned(),
            text::leaf(&json!(entry.kind)).replace('_', " "),
        ],
    ];
    let mut row = |name: &str, value: Option<String>| {
        if let Some(value) = value {
            rows.push(vec![name.to_owned(), value]);
        }
    };
    row("type", entry.type_name.clone());
    row("request", entry.request.clone());
    row("response", entry.response.clone());
    row("unit", entry.unit.clone());
    row("range", entry.range.map(|range| text::range(&range)));
    row(
        "about",
        entry
            .documentation
            .as_deref()
            .map(|text| text.replace('\n', " ")),
    );
    row(
        "choices",
        (!entry.choices.is_empty()).then(|| entry.choices.join(", ")),
    );
    row("length", entry.length.map(|length| length.to_string()));
    let mut said = text::columns(&rows, false);
    if !children.is_empty() {
        said.push_str("parts\n");
        let parts: Vec<_> = children
            .iter()
            .map(|child| {
                let name = child.path.rsplit('.').next().unwrap_or_default();
                vec![
                    format!("  {name}"),
                    child.type_name.clone().unwrap_or_default(),
                ]
            })
            .collect();
        said.push_str(&text::columns(&parts, false));
    }
    said
}

#[cfg(test)]
mod tests {
    use super::Second;

    #[test]
    fn a_rate_is_that_of_the_robots_clock() {
        let mut second = Second::default();
        for cycle in 0..84_u64 {
            second.add(cycle * 12_000_000, None);
        }
        let rate = second.rate(None).expect("there are two");
        assert!((rate - 1000.0 / 12.0).abs() < 1e-6, "{rate}");
        assert_eq!(second.longest_gap, 12_000_000);
    }

    #[test]
    fn gaps_between_two_seconds_count() {
        let mut second = Second::default();
        second.add(30_000_000, Some(0));
        assert_eq!(second.longest_gap, 30_000_000);
        let rate = second
            .rate(Some(0))
            .expect("with the one before there are two");
        assert!((rate - 1.0 / 0.03).abs() < 1e-6, "{rate}");
        assert_eq!(Second::default().rate(None), None);
    }
}
