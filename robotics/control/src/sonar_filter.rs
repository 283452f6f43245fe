//! Tells how far ahead something stands, from echoes that come and go.
//!
//! The sensor says 0 or 5 m where nothing reflects. What is nearer than it can measure is no
//! distance either: the pulse is still leaving when its echo arrives.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::sensor_data::Sonar;
use types::sonar::SonarDistances;

use crate::hysteresis::Debounced;
use crate::low_pass::LowPass;

/// What was heard so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct SonarFilter {
    left: Receiver,
    right: Receiver,
}

/// What one receiver heard.
#[derive(Debug, Default, Deserialize, Serialize)]
struct Receiver {
    has_echo: Debounced,
    distance: LowPass<f32>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    sonar: Input<Sonar, "sensor_data.sonar">,
    cycle_time: CycleTime,

    /// A nearer echo is none.
    #[reflect(unit = "m", range = 0.0..)]
    least_distance: Parameter<f32, "sonar_filter.least_distance">,
    /// A farther echo is none.
    #[reflect(unit = "m", range = 0.0..)]
    largest_distance: Parameter<f32, "sonar_filter.largest_distance">,
    /// An echo is believed, or believed to be gone, after so long.
    #[reflect(unit = "s", range = 0.0..)]
    echo_delay: Parameter<f32, "sonar_filter.echo_delay">,
    /// How slowly the smoothed distance follows.
    #[reflect(unit = "s", range = 0.0..)]
    smoothing_time: Parameter<f32, "sonar_filter.smoothing_time">,
}

#[context]
pub struct MainOutputs {
    /// From the receivers to what reflects.
    sonar_distances: MainOutput<SonarDistances>,
}

impl SonarFilter {
    /// Nothing was heard.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            left: Receiver::default(),
            right: Receiver::default(),
        })
    }

    /// Sorts out what is no echo, then smooths each receiver for itself.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let sonar_distances = SonarDistances {
            left: self.left.listen(context.sonar.left, &context),
            right: self.right.listen(context.sonar.right, &context),
        };
        Ok(MainOutputs {
            sonar_distances: sonar_distances.into(),
        })
    }
}

impl Receiver {
    fn listen(&mut self, measured: f32, context: &CycleContext) -> Option<f32> {
        let step = context.cycle_time.since_last.as_secs_f32();
        let hears = measured >= *context.least_distance && measured <= *context.largest_distance;
        let had_echo = self.has_echo.value();
        let has_echo = self.has_echo.update(hears, step, *context.echo_delay);
        if has_echo && !had_echo {
            // Whatever was there before is another thing.
            self.distance = LowPass::default();
        }
        // Until the echo is believed to be gone, a gap in it is no distance.
        let distance = if hears { measured } else { f32::NAN };
        let smoothed = self
            .distance
            .update(distance, step, *context.smoothing_time);
        has_echo.then_some(smoothed)
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::cycle_time;

    use super::*;

    fn node() -> SonarFilter {
        SonarFilter::new(CreationContext {}).unwrap()
    }

    /// Cycles of 12 ms that hear so much on the left, and nothing on the right.
    fn cycles(node: &mut SonarFilter, count: usize, left: f32) -> Option<f32> {
        let mut distances = SonarDistances::default();
        for _ in 0..count {
            let context = CycleContext {
                sonar: &Sonar { left, right: 5.0 },
                cycle_time: cycle_time(12, 12),
                least_distance: &0.2,
                largest_distance: &0.8,
                echo_delay: &0.1,
                smoothing_time: &0.1,
            };
            distances = node.cycle(context).unwrap().sonar_distances.value;
        }
        assert_eq!(distances.right, None);
        distances.left
    }

    #[test]
    fn silence_is_no_distance() {
        for silence in [0.0, 5.0, 0.1, f32::NAN, f32::INFINITY] {
            assert_eq!(cycles(&mut node(), 100, silence), None, "{silence} m");
        }
    }

    #[test]
    fn an_echo_that_lasts_is_believed() {
        let mut node = node();
        assert_eq!(cycles(&mut node, 9, 0.5), None);
        assert_eq!(cycles(&mut node, 1, 0.5), Some(0.5));
    }

    #[test]
    fn a_gap_in_the_echo_changes_nothing() {
        let mut node = node();
        cycles(&mut node, 20, 0.5);
        assert_eq!(cycles(&mut node, 5, 5.0), Some(0.5));
        assert_eq!(cycles(&mut node, 20, 5.0), None);
    }

    #[test]
    fn the_distance_follows_smoothly() {
        let mut node = node();
        cycles(&mut node, 20, 0.5);
        let nearer = cycles(&mut node, 1, 0.3).unwrap();
        assert!(nearer > 0.45 && nearer < 0.5, "{nearer} m");
        let settled = cycles(&mut node, 100, 0.3).unwrap();
        assert!((settled - 0.3).abs() < 1e-3, "{settled} m");
    }

    #[test]
    fn what_stood_there_before_is_forgotten() {
        let mut node = node();
        cycles(&mut node, 50, 0.3);
        cycles(&mut node, 50, 5.0);
        assert_eq!(cycles(&mut node, 10, 0.7), Some(0.7));
    }
}
