//! Tells from the pressure on each sole which foot carries the robot.

use framework::{Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::feet::{Feet, Side};

/// What was decided so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct SupportFootFilter {
    heavier: Side,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    sole_pressures: Input<Feet<f32>, "sole_pressures">,
    has_ground_contact: Input<bool, "has_ground_contact">,

    /// By how much the other sole must be heavier to become the supporting one.
    #[reflect(unit = "kg", range = 0.0..)]
    hysteresis: Parameter<f32, "support_foot_filter.hysteresis">,
}

#[context]
pub struct MainOutputs {
    /// The foot that carries more; `None` without contact with the ground.
    support_side: MainOutput<Option<Side>>,
}

impl SupportFootFilter {
    /// On the left foot as soon as it stands.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            heavier: Side::Left,
        })
    }

    /// Changes sides only beyond the hysteresis.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let difference = context.sole_pressures.left - context.sole_pressures.right;
        if difference > *context.hysteresis {
            self.heavier = Side::Left;
        } else if difference < -*context.hysteresis {
            self.heavier = Side::Right;
        }
        Ok(MainOutputs {
            support_side: context.has_ground_contact.then_some(self.heavier).into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cycle with so many kg on each sole.
    fn cycle(
        node: &mut SupportFootFilter,
        left: f32,
        right: f32,
        has_ground_contact: bool,
    ) -> Option<Side> {
        let context = CycleContext {
            sole_pressures: &Feet { left, right },
            has_ground_contact: &has_ground_contact,
            hysteresis: &0.2,
        };
        node.cycle(context).unwrap().support_side.value
    }

    fn node() -> SupportFootFilter {
        SupportFootFilter::new(CreationContext {}).unwrap()
    }

    #[test]
    fn the_supporting_side_changes_only_beyond_the_hysteresis() {
        let mut node = node();
        assert_eq!(cycle(&mut node, 3.0, 2.0, true), Some(Side::Left));
        assert_eq!(cycle(&mut node, 2.45, 2.55, true), Some(Side::Left));
        assert_eq!(cycle(&mut node, 2.2, 2.8, true), Some(Side::Right));
        assert_eq!(cycle(&mut node, 2.55, 2.45, true), Some(Side::Right));
    }

    #[test]
    fn in_the_air_no_foot_supports() {
        let mut node = node();
        assert_eq!(cycle(&mut node, 0.1, 0.0, false), None);
        assert_eq!(cycle(&mut node, 0.0, 2.5, false), None);
        assert_eq!(cycle(&mut node, 2.5, 2.5, true), Some(Side::Right));
    }

    #[test]
    fn pressures_that_are_no_numbers_change_nothing() {
        let mut node = node();
        cycle(&mut node, 1.0, 3.0, true);
        assert_eq!(cycle(&mut node, f32::NAN, 1.0, true), Some(Side::Right));
    }
}
