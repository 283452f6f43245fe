//! Finds out how far the rover could drive in each direction, as broad as it is.

use std::f32::consts::TAU;

use framework::{Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Freeway, Scan, wrapped};

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct FreewayDetection {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    scan: Input<Scan, "scan">,
    freeways: MainOutput<Vec<Freeway>>,

    /// What has to be free to each side.
    #[reflect(unit = "m", range = 0.0..)]
    half_width: Parameter<f32, "freeway_detection.half_width">,
    /// How many directions are looked into, all around.
    #[reflect(range = 1..=720)]
    directions: Parameter<u32, "freeway_detection.directions">,
}

#[context]
pub struct MainOutputs {}

impl FreewayDetection {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Looks at one scan from every direction.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let count = *context.directions;
        context.freeways.extend((0..count).map(|index| {
            let direction = wrapped(TAU * index as f32 / count as f32);
            let distance = free_distance(&context.scan.ranges, direction, *context.half_width);
            Freeway {
                direction,
                distance,
            }
        }));
        Ok(MainOutputs {})
    }
}

/// Metres to the first thing in a corridor.
fn free_distance(ranges: &[f32], direction: f32, half_width: f32) -> f32 {
    let step = TAU / ranges.len() as f32;
    let ahead = ranges.iter().enumerate().filter_map(|(ray, range)| {
        let (sine, cosine) = (step * ray as f32 - direction).sin_cos();
        let is_inside = cosine > 0.0 && (range * sine).abs() < half_width;
        is_inside.then_some(range * cosine)
    });
    ahead.fold(f32::INFINITY, f32::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_post_on_the_left_closes_the_left() {
        let mut ranges = vec![4.0; 120];
        // 90 degrees to the left.
        ranges[30] = 1.0;
        let (scan, mut freeways) = (Scan { ranges }, Vec::new());
        let mut node = FreewayDetection::new(CreationContext {}).unwrap();
        let context = CycleContext {
            scan: &scan,
            freeways: &mut freeways,
            half_width: &0.2,
            directions: &4,
        };
        node.cycle(context).unwrap();
        let free: Vec<bool> = freeways.iter().map(|one| one.distance > 1.1).collect();
        assert_eq!(free, [true, false, true, true], "{freeways:?}");
        assert!((freeways[1].distance - 1.0).abs() < 1e-3, "{freeways:?}");
    }
}
