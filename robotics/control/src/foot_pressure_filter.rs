//! Smooths how heavily the robot stands on each sole: the resistors below it are noisy.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::feet::Feet;

use crate::low_pass::LowPass;

/// The pressures so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct FootPressureFilter {
    pressures: Feet<LowPass<f32>>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    resistors: Input<Feet<[f32; 4]>, "sensor_data.force_sensitive_resistors">,
    cycle_time: CycleTime,

    /// How slowly the smoothed pressure follows.
    #[reflect(unit = "s", range = 0.0..)]
    smoothing_time: Parameter<f32, "foot_pressure_filter.smoothing_time">,
}

#[context]
pub struct MainOutputs {
    /// The load on each sole, roughly in kg.
    sole_pressures: MainOutput<Feet<f32>>,
}

impl FootPressureFilter {
    /// In the air until the soles say something else.
    pub fn new(_context: CreationContext) -> Result<Self> {
        let in_the_air = LowPass::starting_at(0.0);
        Ok(Self {
            pressures: Feet {
                left: in_the_air,
                right: in_the_air,
            },
        })
    }

    /// Sums the resistors of each sole, then smooths.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let step = context.cycle_time.since_last.as_secs_f32();
        let time = *context.smoothing_time;
        let measured = context.resistors.map(|loads| loads.iter().sum::<f32>());
        let sole_pressures = Feet {
            left: self.pressures.left.update(measured.left, step, time),
            right: self.pressures.right.update(measured.right, step, time),
        };
        Ok(MainOutputs {
            sole_pressures: sole_pressures.into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use framework::math;
    use framework::testing::cycle_time;

    use super::*;

    /// Cycles of 12 ms with such loads on the left sole and 1 kg on the right.
    fn cycles(node: &mut FootPressureFilter, count: u64, left: [f32; 4]) -> Feet<f32> {
        let mut pressures = Feet::default();
        for cycle in 0..count {
            let context = CycleContext {
                resistors: &Feet {
                    left,
                    right: [0.25; 4],
                },
                cycle_time: cycle_time(12 * cycle, 12),
                smoothing_time: &0.02,
            };
            pressures = node.cycle(context).unwrap().sole_pressures.value;
        }
        pressures
    }

    fn node() -> FootPressureFilter {
        FootPressureFilter::new(CreationContext {}).unwrap()
    }

    #[test]
    fn the_load_on_a_sole_is_that_of_all_its_resistors() {
        let pressures = cycles(&mut node(), 50, [0.1, 0.2, 0.3, 0.4]);
        assert!((pressures.left - 1.0).abs() < 1e-3, "{pressures:?}");
        assert!((pressures.right - 1.0).abs() < 1e-3, "{pressures:?}");
    }

    #[test]
    fn the_pressure_follows_within_the_smoothing_time() {
        let pressures = cycles(&mut node(), 2, [0.25; 4]);
        let expected = 1.0 - math::exp(-0.024_f32 / 0.02);
        assert!((pressures.left - expected).abs() < 1e-4, "{pressures:?}");
    }

    #[test]
    fn a_resistor_that_sends_no_number_is_survived() {
        let mut node = node();
        let before = cycles(&mut node, 50, [0.25; 4]);
        let pressures = cycles(&mut node, 1, [0.25, f32::NAN, 0.25, 0.25]);
        assert_eq!(pressures.left, before.left);
        assert!(cycles(&mut node, 50, [0.5; 4]).left > 1.9);
    }
}
