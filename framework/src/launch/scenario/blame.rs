//! Which line of a scenario's file a wrong value of a hardware's table comes from: whoever merged it does not know.

use std::path::Path;

use crate::error::Error;
use crate::parameters::{self, Origin, ParameterError};

/// Gives an error of what the scenario says about a robot's hardware, counted from 0, its place in the file. Parameters have
/// theirs.
pub(super) fn blame(file: &Path, robot: usize, error: Error) -> Error {
    let Some(found) = error.find::<ParameterError>() else {
        return error;
    };
    if found.origin != Origin::Unknown {
        return error;
    }
    let mut located = found.clone();
    let own = format!("robot.{robot}");
    // Later ones win.
    let places = match found.key.strip_prefix("robot.") {
        Some(key) => vec![format!("{own}.{key}"), own],
        None => {
            located.key = format!("world.{}", found.key);
            vec![located.key.clone()]
        }
    };
    let mut places = places.iter();
    match places.find_map(|path| place(file, path)) {
        Some(origin) => ParameterError { origin, ..located }.into(),
        None => error,
    }
}

/// Where the file says this; who edits it meanwhile gets no line.
pub(super) fn place(file: &Path, path: &str) -> Option<Origin> {
    let text = std::fs::read_to_string(file).unwrap_or_default();
    parameters::place(&file.display().to_string(), &text, path)
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    const SCENARIO: &str = "\
ends = 1.0
parameters = { filter.gian = 2.5 }
[world]
lamp = [inf, 0.0]
[[robot]]
parameters = { filter.step = 3 }
pose = 'here'
";

    #[derive(Debug, Deserialize)]
    #[expect(dead_code, reason = "it is only read")]
    struct Table {
        lamp: Option<Lamp>,
        robot: Option<Robot>,
    }

    #[derive(Debug, Deserialize)]
    #[expect(dead_code, reason = "it is only read")]
    struct Lamp {
        is_on: bool,
        place: f64,
    }

    #[derive(Debug, Deserialize)]
    #[expect(dead_code, reason = "it is only read")]
    struct Robot {
        pose: f64,
    }

    /// What is told of a wrong value in the hardware's table.
    fn of_table(text: &str) -> Error {
        let table = toml::from_str(text).expect("it is TOML");
        let read = parameters::from_table::<Table>(&table);
        read.expect_err("it is wrong").into()
    }

    #[test]
    fn the_line_of_the_scenario_is_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.toml");
        std::fs::write(&file, SCENARIO).expect("it is written");
        let told = |error| {
            let text = blame(&file, 0, error).to_string();
            text.replace(&file.display().to_string(), "a.toml")
        };
        assert_eq!(
            told(of_table("lamp = [inf, 0.0]")),
            "a.toml:4: `world.lamp`: expected a table of is_on, place; found an array"
        );
        let robot = told(of_table("robot = { pose = 'here' }"));
        assert!(robot.starts_with("a.toml:7: `robot.pose`: "), "{robot}");
    }

    #[test]
    fn a_key_of_one_of_several_tables_has_its_line() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.toml");
        let text = "[[assertion]]\nis_not = 1\n\n[[assertion]]\nwhat = 'it'\nis_not = 'a'\n";
        std::fs::write(&file, text).expect("it is written");
        let line = |path| match place(&file, path) {
            Some(Origin::File { line, .. }) => Some(line),
            _ => None,
        };
        assert_eq!(line("assertion.1.is_not"), Some(6));
        assert_eq!(line("assertion.2.is_not"), None);
    }
}
