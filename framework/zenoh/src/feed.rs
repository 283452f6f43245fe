//! What another machine says about the cycles that it runs for the robot becomes what is asked of the robot.

use hulkgen_zenoh::Said;
use protocol::Ask;
use serde_json::Value;

use crate::Result;

/// What to ask of the robot; `of_robot` gives the robot's time for one since 1970.
///
/// # Errors
/// If the sample is none of the three, or is of a time before the robot's clock started.
pub(crate) fn ask(
    instance: &str,
    said: Value,
    of_robot: impl Fn(u64) -> Option<u64>,
) -> Result<Ask> {
    let said: Said = serde_json::from_value(said).map_err(|error| {
        format!("expected `announce`, `complete` or `abandon` with a `time`: {error}")
    })?;
    let of_robot = |time| {
        let early = || format!("{time} ns since 1970 is before the robot's clock started");
        of_robot(time).ok_or_else(early)
    };
    let instance = instance.to_owned();
    Ok(match said {
        Said::Announce { time } => Ask::Announce {
            instance,
            time: of_robot(time)?,
        },
        Said::Complete { time, outputs } => Ask::Complete {
            instance,
            time: of_robot(time)?,
            outputs,
        },
        Said::Abandon { time } => Ask::Abandon {
            instance,
            time: of_robot(time)?,
        },
    })
}

#[cfg(test)]
mod tests {
    use protocol::Ask;
    use serde_json::json;

    use super::ask;

    #[test]
    fn times_since_1970_become_the_robots() {
        let of_robot = |time: u64| time.checked_sub(1000);
        let outputs = json!({ "ship": { "number": 1 } });
        let said = json!({ "complete": { "time": 1007, "outputs": outputs } });
        let expected = Ask::Complete {
            instance: "Eye".to_owned(),
            time: 7,
            outputs,
        };
        assert_eq!(ask("Eye", said, of_robot), Ok(expected));
        let expected = Ask::Announce {
            instance: "Eye".to_owned(),
            time: 0,
        };
        let said = json!({ "announce": { "time": 1000 } });
        assert_eq!(ask("Eye", said, of_robot), Ok(expected));
        let early = ask("Eye", json!({ "abandon": { "time": 999 } }), of_robot);
        assert!(early.is_err_and(|message| message.contains("before the robot's clock")));
    }

    #[test]
    fn what_is_none_of_the_three_is_refused() {
        for said in [
            json!(null),
            json!({ "announce": {} }),
            json!({ "announce": { "time": -1 } }),
            json!({ "announce": { "time": 1.5 } }),
            json!({ "announce": { "time": 1, "more": 1 } }),
            json!({ "complete": { "time": 1 } }),
            json!({ "announce": { "time": 1 }, "abandon": { "time": 1 } }),
            json!({ "anounce": { "time": 1 } }),
        ] {
            let refused = ask("Eye", said.clone(), Some);
            let told = refused.expect_err("it is none");
            assert!(told.starts_with("expected `announce`"), "{said}: {told}");
        }
    }
}
