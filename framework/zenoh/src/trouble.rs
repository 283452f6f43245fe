//! Why something of a robot is not bridged, and what becomes of the rest.

use client::Why;

/// What goes wrong with a robot.
#[derive(Debug, PartialEq)]
pub(crate) enum Trouble {
    /// The robot or CDR does not do this, and goes on with everything else.
    Refused(String),
    /// The robot does not answer or went away: nothing is known of it until it is connected to anew.
    Away(String),
}

impl From<client::Error> for Trouble {
    fn from(error: client::Error) -> Self {
        match error.why {
            Why::Refused(_) => Self::Refused(error.into()),
            _ => Self::Away(error.into()),
        }
    }
}

impl From<String> for Trouble {
    fn from(message: String) -> Self {
        Self::Refused(message)
    }
}

/// For what ends with either.
impl From<Trouble> for String {
    fn from(trouble: Trouble) -> Self {
        match trouble {
            Trouble::Refused(message) | Trouble::Away(message) => message,
        }
    }
}

#[cfg(test)]
mod tests {
    use client::{Error, Why};
    use protocol::Failure;

    use super::Trouble;

    #[test]
    fn a_robot_that_does_not_answer_has_refused_nothing() {
        let trouble = |why| {
            Trouble::from(Error {
                address: "lamp:4857".to_owned(),
                why,
            })
        };
        let refused = Failure {
            message: "no `a`".to_owned(),
            refusals: Vec::new(),
        };
        assert_eq!(
            trouble(Why::Refused(refused)),
            Trouble::Refused("no `a`".to_owned())
        );
        for why in [Why::Silent, Why::Confused, Why::Gone("reset".to_owned())] {
            let trouble = trouble(why);
            assert!(matches!(trouble, Trouble::Away(_)), "{trouble:?}");
        }
    }
}
