//! Why something did not go through.

use std::fmt;

use protocol::{Failure, VERSION};

/// A robot that is not there, went away, or does not do what it is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    /// Where the robot is, or should be.
    pub address: String,
    /// What is wrong.
    pub why: Why,
}

/// Kinds of [`Error`].
#[derive(Clone, Debug, PartialEq)]
pub enum Why {
    /// Nobody answers there, for this reason.
    Absent(String),
    /// It speaks this version of the protocol.
    Foreign(u32),
    /// It says what makes no sense.
    Confused,
    /// The connection has ended, for this reason.
    Gone(String),
    /// It does not answer in time.
    Silent,
    /// It does not do it, in its own words.
    Refused(Failure),
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let address = &self.address;
        match &self.why {
            Why::Absent(reason) => write!(formatter, "no robot answers at {address}: {reason}"),
            Why::Foreign(version) => write!(
                formatter,
                "the robot at {address} speaks version {version} of the protocol, this program {VERSION}"
            ),
            Why::Confused => write!(
                formatter,
                "what answers at {address} is no robot that this program understands"
            ),
            Why::Gone(reason) => write!(formatter, "the robot at {address} went away: {reason}"),
            Why::Silent => write!(formatter, "the robot at {address} does not answer"),
            Why::Refused(failure) => write!(formatter, "{}", failure.message),
        }
    }
}

impl Why {
    /// What mends it, where that is known.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            Self::Absent(_) => {
                Some("start one with `hulkgen run`, or say where it is with `--host ADDRESS`")
            }
            Self::Foreign(_) | Self::Confused => {
                Some("use programs of the revision that the robot was generated with")
            }
            Self::Gone(_) | Self::Silent | Self::Refused(_) => None,
        }
    }
}

impl std::error::Error for Error {}

/// For programs that tell people alone.
impl From<Error> for String {
    fn from(error: Error) -> Self {
        match error.why.help() {
            Some(help) => format!("{error}; {help}"),
            None => error.to_string(),
        }
    }
}
