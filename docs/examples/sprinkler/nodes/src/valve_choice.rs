//! Opens when the bed is thirsty, closes when it is not, and does not waver between.

use framework::{Input, MainOutput, Parameter, PreviousInput, Result, context};
use serde::{Deserialize, Serialize};

/// Keeps nothing between cycles: what it decided before is an input.
#[derive(Debug, Deserialize, Serialize)]
pub struct ValveChoice {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    thirst: Input<f32, "thirst">,
    was_open: PreviousInput<Option<bool>, "valve">,
    /// Of thirst.
    opens: Parameter<f32, "valve_choice.opens">,
    /// Of thirst.
    closes: Parameter<f32, "valve_choice.closes">,
}

#[context]
pub struct MainOutputs {
    /// Whether it is to be open; `None` only where this node failed.
    valve: MainOutput<Option<bool>>,
}

impl ValveChoice {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Between the two limits it stays as it was.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let was_open = context.was_open.unwrap_or_default();
        let limit = if was_open {
            context.closes
        } else {
            context.opens
        };
        Ok(MainOutputs {
            valve: Some(context.thirst > limit).into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_the_limits_it_stays_as_it_was() {
        let mut node = ValveChoice::new(CreationContext {}).unwrap();
        let mut valve = |thirst: f32, was_open: Option<bool>| {
            let context = CycleContext {
                thirst: &thirst,
                was_open: &was_open,
                opens: &0.1,
                closes: &0.0,
            };
            node.cycle(context).unwrap().valve.value.unwrap()
        };
        assert!(valve(0.2, None) && valve(0.05, Some(true)));
        assert!(!valve(0.05, Some(false)) && !valve(-0.1, Some(true)));
    }
}
