//! What the robot's manifest maps, as the robot's graph tells it.

use client::Robot;
use protocol::{Ask, Good};
use serde::Deserialize;

use crate::trouble::Trouble;

/// A `[[bridge]]` of the manifest. Keys that a later hulkgen adds are left alone.
#[derive(Clone, Debug, Deserialize, PartialEq)]
pub(crate) struct Edge {
    /// As clients write it.
    pub(crate) path: String,
    pub(crate) kind: Kind,
    pub(crate) key: String,
    /// `None` for procedures.
    pub(crate) direction: Option<Direction>,
    pub(crate) encoding: Encoding,
    /// Values in a second, at most.
    pub(crate) rate: Option<f64>,
}

#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Kind {
    MainOutput,
    AdditionalOutput,
    Parameter,
    Procedure,
    /// An instance that another machine runs.
    Remote,
}

#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Direction {
    Out,
    In,
    Both,
}

#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Encoding {
    Json,
    Cdr,
}

impl Edge {
    /// Whether values of it are published.
    pub(crate) fn goes_out(&self) -> bool {
        matches!(self.direction, Some(Direction::Out | Direction::Both))
    }

    /// Whether values come from the key.
    pub(crate) fn comes_in(&self) -> bool {
        matches!(self.direction, Some(Direction::In | Direction::Both))
    }

    /// Whether the key answers queries: outputs are published alone.
    pub(crate) fn answers(&self) -> bool {
        matches!(self.kind, Kind::Parameter | Kind::Procedure | Kind::Remote)
    }
}

/// Everything that the robot's manifest maps.
///
/// # Errors
/// If the robot does not tell, or what it tells cannot be read.
pub(crate) fn of_robot(robot: &mut Robot) -> Result<Vec<Edge>, Trouble> {
    let Good::Graph(mut graph) = robot.ask(Ask::Graph {})? else {
        return Err("the robot does not tell its graph".to_owned().into());
    };
    match graph.get_mut("bridges").map(serde_json::Value::take) {
        None => Ok(Vec::new()),
        Some(bridges) => serde_json::from_value(bridges).map_err(|error| {
            format!("the robot's graph has other bridges than this one: {error}").into()
        }),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{Direction, Edge, Encoding, Kind};

    #[test]
    fn an_edge_is_what_hulkgen_writes() {
        let written = json!({
            "path": "parameters.speed", "kind": "parameter", "type": "f32", "key": "robot/speed",
            "direction": "both", "encoding": "json", "rate": null, "since": "later"
        });
        let edge: Edge = serde_json::from_value(written).expect("it is an edge");
        assert_eq!(edge.kind, Kind::Parameter);
        assert_eq!(edge.direction, Some(Direction::Both));
        assert_eq!(edge.encoding, Encoding::Json);
        assert!(edge.goes_out() && edge.comes_in() && edge.answers());
    }
}
