//! `robots`: which robots answer, and what they run.

use serde_json::{Value, json};

use super::reached::Reached;
use super::side_by_side;
use crate::arguments::{self, TextOrJson};
use crate::commands::Failure;
use crate::commands::session::Session;
use crate::deploy::script;
use crate::outcome::{Outcome, Refusal};

/// Words of a robot's answer, as they stand in the JSON.
const WORDS: &[(&str, &str)] = &[
    ("state", "state"),
    ("current", "version"),
    ("previous", "before"),
    ("machine", "machine"),
    ("up", "up_seconds"),
    ("free", "free_kibibytes"),
];

pub(in crate::commands) fn robots(
    session: &mut Session<'_>,
    asked: &arguments::Robots,
) -> Result<Outcome, Failure> {
    let reached = Reached::read(session, &asked.reached)?;
    let all: Vec<String> = reached.deploy.hosts.keys().cloned().collect();
    let hosts = if asked.hosts.is_empty() {
        &all
    } else {
        &asked.hosts
    };
    if hosts.is_empty() {
        return Err(Refusal::wrong_usage("hulk.toml names no robots")
            .help("add `hosts = { name = \"user@address\" }` to `[target.deploy]`")
            .into());
    }
    let robots = reached.robots(hosts)?;
    let script = script::look(&reached.deploy.folder, reached.service());
    let answers = side_by_side(session, &robots, &robots, |robot, _| {
        robot.remote.shell(&script)
    });
    let is_good = answers.iter().all(Result::is_ok);
    let told: Vec<Value> = (robots.iter().zip(answers))
        .map(|(robot, answer)| {
            let (name, destination) = (&robot.remote.name, robot.remote.destination.to_string());
            let mut told = json!({ "host": name, "destination": destination });
            match answer {
                Ok(said) => WORDS
                    .iter()
                    .for_each(|(word, key)| told[key] = value(&said, word)),
                Err(failed) => told["error"] = failed.message.into(),
            }
            told
        })
        .collect();
    session.terminal.data(&match asked.format {
        TextOrJson::Text => told.iter().map(line).collect(),
        TextOrJson::Json => format!("{}\n", json!({ "version": 1, "robots": told })),
    })?;
    Ok(if is_good { Outcome::Good } else { Outcome::Bad })
}

/// Behind a word at the beginning of a line: a number where it is one.
fn value(said: &str, word: &str) -> Value {
    let value = said
        .lines()
        .find_map(|line| line.strip_prefix(word)?.strip_prefix(' '));
    value.map_or(Value::Null, |value| {
        let value = value.trim();
        value
            .parse::<u64>()
            .map_or_else(|_| value.into(), Value::from)
    })
}

fn line(robot: &Value) -> String {
    let word = |key: &str| robot[key].as_str().unwrap_or_default();
    let name = word("host");
    if robot["error"].is_string() {
        return format!("{name}: does not answer: {}\n", word("error"));
    }
    let version = robot["version"].as_str().unwrap_or("no version");
    let state = robot["state"]
        .as_str()
        .map(|it| format!(" {it}"))
        .unwrap_or_default();
    let free = robot["free_kibibytes"]
        .as_u64()
        .map(|it| format!(", {} MiB free", it >> 10));
    let up = robot["up_seconds"]
        .as_u64()
        .map(|it| format!(", up {} min", it / 60));
    format!(
        "{name}: {version}{state}{}{}, {}\n",
        free.unwrap_or_default(),
        up.unwrap_or_default(),
        word("machine")
    )
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{line, value};

    #[test]
    fn words_are_found_at_the_beginning_of_lines() {
        let said = "no machine\nmachine x86_64\nup 120\n";
        assert_eq!(value(said, "machine"), json!("x86_64"));
        assert_eq!(value(said, "up"), json!(120));
        assert_eq!(value(said, "current"), json!(null));
    }

    #[test]
    fn a_robot_is_one_line() {
        let robot = json!({
            "host": "a", "version": "v1", "state": "active", "machine": "x86_64", "up_seconds": 120, "free_kibibytes": 2048,
        });
        assert_eq!(line(&robot), "a: v1 active, 2 MiB free, up 2 min, x86_64\n");
        assert_eq!(
            line(&json!({ "host": "b", "error": "no route" })),
            "b: does not answer: no route\n"
        );
    }
}
