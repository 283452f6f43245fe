//! Tells from the pressure on the soles whether the robot stands, and on which foot more.

use framework::{AdditionalOutput, CycleTime, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::feet::{Feet, Side};

/// What was felt so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct FootPressure {
    /// Smoothed, in kg.
    pressures: Feet<f32>,
    has_contact: bool,
    /// For how long the pressure has contradicted `has_contact`, in s.
    contradicted: f32,
    heavier: Side,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    resistors: Input<Feet<[f32; 4]>, "sensor_data.force_sensitive_resistors">,
    cycle_time: CycleTime,

    /// In s: how slowly the smoothed pressure follows.
    smoothing_time: Parameter<f32, "foot_pressure.smoothing_time">,
    /// In kg on both soles: more is contact with the ground.
    contact_pressure: Parameter<f32, "foot_pressure.contact_pressure">,
    /// In kg: how much less than `contact_pressure` is no contact any more.
    contact_hysteresis: Parameter<f32, "foot_pressure.contact_hysteresis">,
    /// In s: contact is gained or lost after so long.
    contact_delay: Parameter<f32, "foot_pressure.contact_delay">,
    /// In kg: by how much the other sole must be heavier to become the supporting one.
    side_hysteresis: Parameter<f32, "foot_pressure.side_hysteresis">,

    sole_pressures: AdditionalOutput<Feet<f32>, "foot_pressure.sole_pressures">,
}

#[context]
pub struct MainOutputs {
    /// Whether the robot stands on the ground.
    ground_contact: MainOutput<bool>,
    /// The foot that carries more; `None` without contact with the ground.
    support_side: MainOutput<Option<Side>>,
}

impl FootPressure {
    /// In the air until the soles say something else.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            pressures: Feet::default(),
            has_contact: false,
            contradicted: 0.0,
            heavier: Side::Left,
        })
    }

    /// Smooths, then decides.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let step = context.cycle_time.since_last.as_secs_f32();
        self.smooth(context.resistors, step, *context.smoothing_time);
        context.sole_pressures.fill_if_subscribed(|| self.pressures);

        let threshold = if self.has_contact {
            *context.contact_pressure - *context.contact_hysteresis
        } else {
            *context.contact_pressure
        };
        self.decide_contact(threshold, step, *context.contact_delay);
        self.decide_side(*context.side_hysteresis);
        Ok(MainOutputs {
            ground_contact: self.has_contact.into(),
            support_side: self.has_contact.then_some(self.heavier).into(),
        })
    }

    fn smooth(&mut self, resistors: &Feet<[f32; 4]>, step: f32, time: f32) {
        let share = 1.0 - (-step / time.max(f32::EPSILON)).exp();
        let measured = resistors.map(|loads| loads.iter().sum::<f32>());
        self.pressures.left += (measured.left - self.pressures.left) * share;
        self.pressures.right += (measured.right - self.pressures.right) * share;
    }

    fn decide_contact(&mut self, threshold: f32, step: f32, delay: f32) {
        let feels_contact = self.pressures.left + self.pressures.right > threshold;
        if feels_contact == self.has_contact {
            self.contradicted = 0.0;
            return;
        }
        self.contradicted += step;
        if self.contradicted >= delay {
            self.has_contact = feels_contact;
            self.contradicted = 0.0;
        }
    }

    fn decide_side(&mut self, hysteresis: f32) {
        let difference = self.pressures.left - self.pressures.right;
        if difference > hysteresis {
            self.heavier = Side::Left;
        } else if difference < -hysteresis {
            self.heavier = Side::Right;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use framework::{AdditionalSlot, Timestamp};

    use super::*;

    /// Cycles of 12 ms with so many kg on each sole.
    fn cycles(node: &mut FootPressure, count: usize, left: f32, right: f32) -> MainOutputs {
        let mut outputs = None;
        for _ in 0..count {
            let mut slot = AdditionalSlot::default();
            let context = CycleContext {
                resistors: &Feet {
                    left: [left / 4.0; 4],
                    right: [right / 4.0; 4],
                },
                cycle_time: CycleTime {
                    start: Timestamp::ZERO,
                    since_last: Duration::from_millis(12),
                },
                smoothing_time: &0.02,
                contact_pressure: &0.6,
                contact_hysteresis: &0.3,
                contact_delay: &0.1,
                side_hysteresis: &0.2,
                sole_pressures: AdditionalOutput::new(false, 1, &mut slot),
            };
            outputs = Some(node.cycle(context).unwrap());
        }
        outputs.unwrap()
    }

    fn node() -> FootPressure {
        FootPressure::new(CreationContext {}).unwrap()
    }

    #[test]
    fn contact_is_gained_after_the_delay_and_not_before() {
        let mut node = node();
        assert_eq!(cycles(&mut node, 4, 2.5, 2.5).support_side.value, None);
        let outputs = cycles(&mut node, 10, 2.5, 2.5);
        assert!(outputs.ground_contact.value);
        assert_eq!(outputs.support_side.value, Some(Side::Left));
    }

    #[test]
    fn the_supporting_side_changes_only_beyond_the_hysteresis() {
        let mut node = node();
        cycles(&mut node, 30, 3.0, 2.0);
        let slightly = cycles(&mut node, 100, 2.45, 2.55);
        assert_eq!(slightly.support_side.value, Some(Side::Left));
        let clearly = cycles(&mut node, 100, 2.2, 2.8);
        assert_eq!(clearly.support_side.value, Some(Side::Right));
    }

    #[test]
    fn contact_is_lost_when_the_robot_is_picked_up() {
        let mut node = node();
        cycles(&mut node, 30, 2.5, 2.5);
        let light = cycles(&mut node, 100, 0.2, 0.2);
        assert!(
            light.ground_contact.value,
            "0.4 kg is within the hysteresis"
        );
        let outputs = cycles(&mut node, 30, 0.0, 0.0);
        assert!(!outputs.ground_contact.value);
        assert_eq!(outputs.support_side.value, None);
    }
}
