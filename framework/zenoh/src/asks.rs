//! What samples and queries of a key ask of the robot.

use protocol::{Ask, Change};
use serde_json::Value;
use zenoh::query::Query;

use crate::Result;
use crate::edges::{Direction, Edge, Encoding, Kind};
use crate::feed;
use crate::forms::Form;
use crate::keys::LONGEST;

/// Lists and objects within each other: a robot refuses deeper requests without saying which it refuses.
const DEEPEST: usize = 48;

/// The word before the paths of parameters, which changes do without.
const PARAMETERS: &str = "parameters.";

/// What a query of a key means; `of_robot` gives the robot's time for one since 1970.
///
/// # Errors
/// If its payload cannot be read, or nothing comes in there.
pub(crate) fn of_query(
    edge: &Edge,
    form: Option<&Form>,
    query: &Query,
    of_robot: impl Fn(u64) -> Option<u64>,
) -> Result<Ask> {
    let payload = query.payload();
    if payload.is_some_and(|payload| payload.len() > LONGEST) {
        return Err(format!("a payload has at most {LONGEST} bytes"));
    }
    // An empty one is none to those whose library has no other.
    let payload = payload.filter(|payload| edge.encoding == Encoding::Json || !payload.is_empty());
    let argument = payload.map(|payload| read(edge, form, &payload.to_bytes()));
    let argument = argument.transpose()?;
    let path = edge.path.clone();
    match (edge.kind, edge.direction, argument) {
        (Kind::Procedure, _, None) if edge.encoding == Encoding::Cdr => Err(format!(
            "`{path}` is asked with CDR: send the request as the payload of the query"
        )),
        (Kind::Procedure, _, argument) => Ok(Ask::Call {
            path,
            argument: argument.unwrap_or(Value::Null),
            timeout: None,
        }),
        (Kind::Remote, _, said) => feed::ask(&path, said.unwrap_or(Value::Null), of_robot),
        (_, Some(Direction::Out), Some(_)) => Err(format!(
            "`{path}` goes out alone: write `direction = \"both\"` at its `[[bridge]]`"
        )),
        (_, _, Some(value)) => Ok(write(&path, value)),
        (_, _, None) => Ok(Ask::Read { path }),
    }
}

/// Changes a parameter.
pub(crate) fn write(path: &str, value: Value) -> Ask {
    let path = path.strip_prefix(PARAMETERS).unwrap_or(path).to_owned();
    Ask::Write {
        changes: vec![Change { path, value }],
    }
}

/// The value that came in.
///
/// # Errors
/// If it is of another form than the edge says, or no robot reads it.
pub(crate) fn read(edge: &Edge, form: Option<&Form>, bytes: &[u8]) -> Result<Value> {
    let value = match (edge.encoding, form) {
        (Encoding::Json, _) => serde_json::from_slice(bytes)
            .map_err(|error| format!("the payload is no JSON: {error}"))?,
        (Encoding::Cdr, Some(form)) => form.input().read_cdr(bytes)?,
        (Encoding::Cdr, None) => {
            return Err("the bridge has no form in CDR for it, as its log told".to_owned());
        }
    };
    match depth(&value) {
        depth if depth > DEEPEST => Err(format!(
            "lists and objects of the payload nest {depth} deep: send at most {DEEPEST}"
        )),
        _ => Ok(value),
    }
}

/// Lists and objects within each other at the deepest place; the reader's own limit bounds it.
fn depth(value: &Value) -> usize {
    match value {
        Value::Array(items) => 1 + items.iter().map(depth).max().unwrap_or(0),
        Value::Object(entries) => 1 + entries.values().map(depth).max().unwrap_or(0),
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::{DEEPEST, read};
    use crate::Result;
    use crate::edges::{Edge, Encoding, Kind};

    fn read_json(text: &str) -> Result<serde_json::Value> {
        let edge = Edge {
            path: "parameters.a".to_owned(),
            kind: Kind::Parameter,
            key: "a".to_owned(),
            direction: None,
            encoding: Encoding::Json,
            rate: None,
        };
        read(&edge, None, text.as_bytes())
    }

    #[test]
    fn what_nests_deeper_than_a_robot_reads_is_refused() {
        for (open, close) in [("[", "]"), (r#"{"a":"#, "}")] {
            let nested = |depth| format!("{}1{}", open.repeat(depth), close.repeat(depth));
            assert!(read_json(&nested(DEEPEST)).is_ok());
            for depth in [DEEPEST + 1, 61, 127] {
                let refused = read_json(&nested(depth)).expect_err("it is too deep");
                assert!(refused.contains(&format!("nest {depth} deep")), "{refused}");
            }
            let refused = read_json(&nested(5000)).expect_err("nobody reads that");
            assert!(refused.contains("no JSON"), "{refused}");
        }
    }
}
