//! What clients may know of a simulated world and do to it: `framework.procedures.truth` and `.disturb`.
//!
//! The hardware answers on the thread that asks, in no cycle: nodes see of it what their senses tell them.

use std::sync::Arc;
use std::time::Duration;

use serde_json::Value;

use crate::error::{Error, Result};
use crate::guarded::contain;
use crate::hardware::Hardware;
use crate::parameters::Given;
use crate::procedure::{Answer, CallAny, PendingAny, Refused};

/// A procedure with its name.
pub type Named = (&'static str, Box<dyn CallAny>);

/// Those of a world; of hardware that tells no truth: none.
pub(crate) fn procedures<H: Hardware + 'static>(hardware: &Arc<H>) -> Vec<Named> {
    if !hardware.is_simulated() || hardware.truth().is_null() {
        return Vec::new();
    }
    let hardware: Arc<dyn Hardware> = hardware.clone();
    vec![
        ("truth", Box::new(Truth(hardware.clone()))),
        ("disturb", Box::new(Disturb(hardware))),
    ]
}

/// What is really the case.
struct Truth(Arc<dyn Hardware>);

/// Something happens.
struct Disturb(Arc<dyn Hardware>);

/// An answer that is there at once.
struct Answered(Answer<Value>);

impl CallAny for Truth {
    fn types(&self) -> (&'static str, &'static str) {
        ("()", "serde_json::value::Value")
    }

    fn call_any(&self, request: &Given<'_>) -> Result<Box<dyn PendingAny>> {
        request.read::<()>()?;
        let truth = contain("Hardware::truth", || Ok(self.0.truth()));
        Ok(Box::new(Answered(truth.map_err(refused))))
    }
}

impl CallAny for Disturb {
    fn types(&self) -> (&'static str, &'static str) {
        ("toml::table::Table", "()")
    }

    fn call_any(&self, request: &Given<'_>) -> Result<Box<dyn PendingAny>> {
        let deed: toml::Table = request.read()?;
        let done = match deed.is_empty() {
            true => Err(Error::new(
                "it does not say what happens: add a key that the hardware understands",
            )),
            false => contain("Hardware::disturb", || self.0.disturb(&deed)),
        };
        let answer = done.map(|()| Value::Null);
        Ok(Box::new(Answered(answer.map_err(refused))))
    }
}

impl PendingAny for Answered {
    fn wait_any(&self, _timeout: Duration) -> Option<Answer<Box<dyn erased_serde::Serialize>>> {
        Some(match &self.0 {
            Ok(value) => Ok(Box::new(value.clone())),
            Err(refused) => Err(refused.clone()),
        })
    }
}

/// Readers of TOML say in several lines what clients have one for.
fn refused(error: Error) -> Refused {
    let lines: Vec<_> = error.to_string().lines().map(str::to_owned).collect();
    Refused(lines.join(" ").into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hardware::HardwareContext;

    /// Whatever it is told happens.
    struct Obedient;

    impl Hardware for Obedient {
        fn new(_context: HardwareContext) -> Result<Self> {
            Ok(Self)
        }

        fn stop(&self) {}

        fn enter_safe_state(&self) {}

        fn disturb(&self, _deed: &toml::Table) -> Result<()> {
            Ok(())
        }
    }

    #[test]
    fn who_does_not_say_what_happens_is_told_so() {
        let answer = |asked: &str| {
            let asked: Value = serde_json::from_str(asked).expect("it is JSON");
            let disturb = Disturb(Arc::new(Obedient));
            let pending = disturb
                .call_any(&Given::from(&asked))
                .expect("it is a table");
            let answer = pending.wait_any(Duration::ZERO).expect("it is there");
            answer.map(drop).map_err(|refused| refused.0.to_string())
        };
        assert_eq!(answer(r#"{ "push": [1] }"#), Ok(()));
        let refused = answer("{}").expect_err("nothing is to happen");
        assert!(refused.contains("does not say what happens"), "{refused}");
    }
}
