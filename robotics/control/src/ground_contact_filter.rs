//! Tells from the pressure on both soles whether the robot stands on the ground.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::feet::Feet;

use crate::hysteresis::{Debounced, exceeds};

/// What was decided so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct GroundContactFilter {
    has_contact: Debounced,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    sole_pressures: Input<Feet<f32>, "sole_pressures">,
    cycle_time: CycleTime,

    /// In kg on both soles: more is contact with the ground.
    pressure: Parameter<f32, "ground_contact_filter.pressure">,
    /// How much less than `pressure` is no contact any more.
    #[reflect(unit = "kg", range = 0.0..)]
    hysteresis: Parameter<f32, "ground_contact_filter.hysteresis">,
    /// Contact is gained or lost after so long.
    #[reflect(unit = "s", range = 0.0..)]
    delay: Parameter<f32, "ground_contact_filter.delay">,
}

#[context]
pub struct MainOutputs {
    /// Whether the robot stands on the ground.
    has_ground_contact: MainOutput<bool>,
}

impl GroundContactFilter {
    /// In the air until the soles say something else.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            has_contact: Debounced::default(),
        })
    }

    /// Compares, then waits until it is sure.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let Feet { left, right } = context.sole_pressures;
        let feels_contact = exceeds(
            left + right,
            *context.pressure,
            *context.hysteresis,
            self.has_contact.value(),
        );
        let step = context.cycle_time.since_last.as_secs_f32();
        let has_contact = self.has_contact.update(feels_contact, step, *context.delay);
        Ok(MainOutputs {
            has_ground_contact: has_contact.into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::cycle_time;

    use super::*;

    /// Cycles of 12 ms with so many kg on each sole.
    fn cycles(node: &mut GroundContactFilter, count: u64, left: f32, right: f32) -> bool {
        let mut has_contact = false;
        for cycle in 0..count {
            let context = CycleContext {
                sole_pressures: &Feet { left, right },
                cycle_time: cycle_time(12 * cycle, 12),
                pressure: &0.6,
                hysteresis: &0.3,
                delay: &0.1,
            };
            has_contact = node.cycle(context).unwrap().has_ground_contact.value;
        }
        has_contact
    }

    fn node() -> GroundContactFilter {
        GroundContactFilter::new(CreationContext {}).unwrap()
    }

    #[test]
    fn contact_is_gained_after_the_delay_and_not_before() {
        let mut node = node();
        assert!(!cycles(&mut node, 9, 2.5, 2.5));
        assert!(cycles(&mut node, 1, 2.5, 2.5));
    }

    #[test]
    fn one_foot_is_enough() {
        assert!(cycles(&mut node(), 30, 0.0, 5.0));
    }

    #[test]
    fn contact_is_lost_when_the_robot_is_picked_up() {
        let mut node = node();
        cycles(&mut node, 30, 2.5, 2.5);
        let light = cycles(&mut node, 100, 0.2, 0.2);
        assert!(light, "0.4 kg is within the hysteresis");
        assert!(!cycles(&mut node, 30, 0.0, 0.0));
    }

    #[test]
    fn a_short_hop_is_no_loss_of_contact() {
        let mut node = node();
        cycles(&mut node, 30, 2.5, 2.5);
        assert!(cycles(&mut node, 5, 0.0, 0.0));
        assert!(cycles(&mut node, 5, 2.5, 2.5));
        assert!(cycles(&mut node, 5, 0.0, 0.0));
    }
}
