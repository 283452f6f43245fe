//! What nodes tell the hardware while there is none: noted on the thread that listens, so that a test can compare it.
//!
//! Arguments need not be [`Serialize`]; of those that are not, nothing is noted but that there was a command.

use std::cell::RefCell;

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// One call of a hardware's method that gives nothing back.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Command {
    /// `ActuatorInterface::write_command`
    pub command: String,
    /// `None`: it cannot be serialised.
    pub arguments: Vec<Option<Argument>>,
}

/// What was told.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Argument {
    /// As JSON, where JSON can say it.
    pub value: Value,
    /// Of its bits, as 16 hexadecimal digits.
    pub digest: String,
}

/// The same bits, whatever JSON makes of them.
impl PartialEq for Argument {
    fn eq(&self, other: &Self) -> bool {
        self.digest == other.digest
    }
}

/// Notes a command where somebody listens: `commanded!("ActuatorInterface::write_command", motors, leds)`.
///
/// The stand-ins for hardware that hulkgen writes call it.
#[macro_export]
macro_rules! commanded {
    ($command:literal) => {
        if $crate::replay::is_listening() {
            $crate::replay::note($command, ::std::vec::Vec::new());
        }
    };
    ($command:literal, $($argument:expr),+ $(,)?) => {
        if $crate::replay::is_listening() {
            use $crate::replay::telling::*;
            $crate::replay::note($command, ::std::vec![$((&Told(&$argument)).told()),+]);
        }
    };
}

thread_local! {
    static NOTED: RefCell<Option<Vec<Command>>> = const { RefCell::new(None) };
}

/// From here on commands of this thread are noted; what was noted before is forgotten.
pub(crate) fn listen() {
    NOTED.set(Some(Vec::new()));
}

/// What was noted; from here on nothing is.
pub(crate) fn noted() -> Vec<Command> {
    NOTED.take().unwrap_or_default()
}

/// Whether commands of this thread are noted.
pub fn is_listening() -> bool {
    NOTED.with_borrow(Option::is_some)
}

/// Notes one; for [`commanded!`](crate::commanded).
pub fn note(command: &str, arguments: Vec<Option<Argument>>) {
    NOTED.with_borrow_mut(|noted| {
        if let Some(noted) = noted {
            noted.push(Command {
                command: command.to_owned(),
                arguments,
            });
        }
    });
}

/// How [`commanded!`](crate::commanded) finds out whether an argument can be serialised.
pub mod telling {
    use serde::Serialize;

    use super::Argument;
    use crate::recorded::digest;
    use crate::replay::as_json;

    /// An argument.
    #[derive(Debug)]
    pub struct Told<'a, T: ?Sized>(pub &'a T);

    /// Of arguments that can be serialised: Rust finds it before [`TellAnything`], which needs one reference more.
    pub trait TellSerialized {
        /// The argument's bits.
        fn told(&self) -> Option<Argument>;
    }

    /// Of all others.
    pub trait TellAnything {
        /// Nothing.
        fn told(&self) -> Option<Argument>;
    }

    impl<T: Serialize + ?Sized> TellSerialized for Told<'_, T> {
        fn told(&self) -> Option<Argument> {
            Some(Argument {
                value: as_json(&self.0).unwrap_or_default(),
                digest: format!("{:016x}", digest(&self.0).ok()?),
            })
        }
    }

    impl<T: ?Sized> TellAnything for &Told<'_, T> {
        fn told(&self) -> Option<Argument> {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{listen, noted};

    struct Opaque;

    fn act(number: f32, bytes: &[u8], opaque: &Opaque) {
        commanded!("Actor::act", number, bytes, opaque);
    }

    #[test]
    fn commands_are_noted_while_somebody_listens_as_far_as_they_can_be_serialised() {
        act(1.0, &[1], &Opaque);
        assert_eq!(noted(), []);
        listen();
        act(f32::NAN, &[1, 2], &Opaque);
        commanded!("Actor::rest");
        let all = noted();
        assert_eq!(all.len(), 2, "{all:?}");
        let [Some(number), Some(bytes), None] = &all[0].arguments[..] else {
            panic!("{all:?}");
        };
        // JSON has no such number; its bits are told apart all the same.
        assert_eq!(number.value, serde_json::Value::Null);
        assert_eq!(bytes.value, serde_json::json!([1, 2]));
        listen();
        act(-f32::NAN, &[1, 2], &Opaque);
        assert_ne!(noted()[0], all[0]);
        act(1.0, &[1], &Opaque);
        assert_eq!(noted(), []);
    }
}
