//! What can be wrong on the machine beside the robot.

use std::fmt::{Display, Formatter};
use std::time::SystemTime;

/// Why something was not sent, or not read.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// Zenoh's own words: an endpoint that is none, a key that is none, a session that is closed.
    Zenoh(String),
    /// Not between 1970 and 2554: nothing was taken then.
    Time(SystemTime),
    /// What a cycle wrote is no struct that can be JSON, or is longer than the bridge reads; the cycle was abandoned.
    Outputs(String),
    /// Nobody answers for this key: neither robot nor bridge is there, or the manifest does not map it.
    Unanswered(String),
    /// The robot refuses, or the bridge does.
    Refused {
        /// That was asked.
        key: String,
        /// In its words.
        message: String,
    },
    /// The value of this key is of another type.
    Unreadable {
        /// That was read.
        key: String,
        /// Where and why.
        message: String,
    },
}

impl Display for Error {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Zenoh(message) => formatter.write_str(message),
            Self::Time(time) => write!(
                formatter,
                "{time:?} is no time at which data were taken: set the clock of this machine"
            ),
            Self::Outputs(message) => write!(formatter, "the outputs: {message}"),
            Self::Unanswered(key) => write!(
                formatter,
                "nobody answers for `{key}`: start the robot and its bridge, and look for the key under `[[bridge]]` of the manifest"
            ),
            Self::Refused { key, message } => write!(formatter, "`{key}`: {message}"),
            Self::Unreadable { key, message } => {
                write!(
                    formatter,
                    "the value of `{key}` is of another type: {message}"
                )
            }
        }
    }
}

impl std::error::Error for Error {}
