//! `log`: what a running robot says.

use client::Heard;
use protocol::{Ask, Level, Message};
use serde_json::json;

use super::connection::Connection;
use super::{again, text};
use crate::arguments::{Log, LogLevel, TextOrJson};
use crate::commands::terminal::Terminal;
use crate::outcome::{Outcome, Refusal};

pub(in crate::commands) fn log(terminal: &Terminal, log: &Log) -> Result<Outcome, Refusal> {
    let mut connection = Connection::open(&log.running)?;
    let level = Some(level(log.level));
    connection.ask(Ask::Logs { level })?;
    again(log.count, None, || {
        loop {
            match connection.hear()? {
                Heard::Message(Message::Log(said)) => {
                    return terminal.more_data(&match log.running.format {
                        TextOrJson::Text => line(&said),
                        TextOrJson::Json => format!("{}\n", json!(said)),
                    });
                }
                Heard::Message(Message::Lost(lost)) if lost.subscription.is_none() => {
                    terminal.note(&format!("{} messages lost: too slow\n", lost.updates));
                }
                _ => {}
            }
        }
    })
}

fn level(level: LogLevel) -> Level {
    match level {
        LogLevel::Trace => Level::Trace,
        LogLevel::Debug => Level::Debug,
        LogLevel::Info => Level::Info,
        LogLevel::Warn => Level::Warn,
        LogLevel::Error => Level::Error,
    }
}

fn line(log: &protocol::Log) -> String {
    let level = text::leaf(&json!(log.level));
    let mut line = format!("{:>11}  {level:5}  ", text::seconds(log.time));
    let from = [
        log.instance.clone(),
        log.node.clone(),
        log.cycle.map(|cycle| format!("#{cycle}")),
    ];
    let from: Vec<String> = from.into_iter().flatten().collect();
    if !from.is_empty() {
        line.push_str(&format!("{}: ", from.join(" ")));
    }
    line.push_str(&log.message);
    for (name, value) in &log.fields {
        line.push_str(&format!(" {name}={}", text::leaf(value)));
    }
    line.push('\n');
    line
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::line;

    #[test]
    fn a_message_says_who_said_it_and_when() {
        let log = json!({
            "number": 1, "time": 9_744_000_000_u64, "level": "warn", "instance": "Control",
            "node": "control::walk", "cycle": 812, "message": "stumbled", "fields": { "angle": 0.5 },
        });
        let log = serde_json::from_value(log).expect("it is a message");
        let expected = "    9.744 s  warn   Control control::walk #812: stumbled angle=0.5\n";
        assert_eq!(line(&log), expected);
    }
}
