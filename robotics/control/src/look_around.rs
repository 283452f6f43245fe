//! Says where the head looks next while nobody knows where the ball is: one way-point after the other.

use framework::{Input, MainOutput, Parameter, PreviousInput, Result, context, math};
use kinematics::limits;
use serde::{Deserialize, Serialize};
use types::head::{HeadAngles, HeadCommand};
use types::motion::{HeadMotion, MotionCommand};

/// A head nearer to its way-point than this, in rad, has reached it.
const REACHED: f32 = 1e-3;

/// Where the head goes.
#[derive(Debug, Deserialize, Serialize)]
pub struct LookAround {
    next_way_point: usize,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    motion_command: Input<MotionCommand, "motion_command">,
    previous: PreviousInput<Option<HeadCommand>, "head_command?">,

    /// In rad: where the head looks, one after the other.
    way_points: Parameter<Vec<HeadAngles>, "look_around.way_points">,
}

#[context]
pub struct MainOutputs {
    /// Where the head shall get; `None` while it shall not look around, or has no way-points.
    look_around: MainOutput<Option<HeadAngles>>,
}

impl LookAround {
    /// Begins with the first way-point.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { next_way_point: 0 })
    }

    /// The next way-point once the last one is reached.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let look_around = match context.motion_command.head {
            HeadMotion::LookAround => self.next(context.way_points, context.previous),
            _ => None,
        };
        Ok(MainOutputs {
            look_around: look_around.into(),
        })
    }

    fn next(
        &mut self,
        way_points: &[HeadAngles],
        previous: Option<&HeadCommand>,
    ) -> Option<HeadAngles> {
        let goal = self.goal(way_points)?;
        if previous.is_some_and(|previous| is_reached(goal, previous.angles)) {
            self.next_way_point = self.next_way_point.wrapping_add(1);
        }
        self.goal(way_points)
    }

    fn goal(&self, way_points: &[HeadAngles]) -> Option<HeadAngles> {
        let next = self.next_way_point.checked_rem(way_points.len())?;
        Some(limits::clamp_head(way_points[next]))
    }
}

fn is_reached(goal: HeadAngles, angles: HeadAngles) -> bool {
    math::hypot(goal.yaw - angles.yaw, goal.pitch - angles.pitch) < REACHED
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEFT: HeadAngles = HeadAngles {
        yaw: 0.6,
        pitch: 0.2,
    };
    const RIGHT: HeadAngles = HeadAngles {
        yaw: -0.6,
        pitch: 0.2,
    };

    fn goal(
        node: &mut LookAround,
        head: HeadMotion,
        previous: Option<HeadAngles>,
        way_points: &[HeadAngles],
    ) -> Option<HeadAngles> {
        let motion_command = MotionCommand {
            head,
            ..MotionCommand::default()
        };
        let previous = previous.map(|angles| HeadCommand {
            angles,
            stiffness: 0.6,
        });
        let context = CycleContext {
            motion_command: &motion_command,
            previous: previous.as_ref(),
            way_points: &way_points.to_vec(),
        };
        node.cycle(context).unwrap().look_around.value
    }

    fn node() -> LookAround {
        LookAround::new(CreationContext {}).unwrap()
    }

    #[test]
    fn the_next_way_point_comes_when_the_last_is_reached() {
        let mut node = node();
        let mut next = |previous| goal(&mut node, HeadMotion::LookAround, previous, &[LEFT, RIGHT]);
        assert_eq!(next(None), Some(LEFT));
        assert_eq!(next(Some(HeadAngles::default())), Some(LEFT));
        assert_eq!(next(Some(LEFT)), Some(RIGHT));
        assert_eq!(next(Some(LEFT)), Some(RIGHT));
        assert_eq!(next(Some(RIGHT)), Some(LEFT));
    }

    #[test]
    fn way_points_out_of_reach_count_where_the_head_can_get() {
        let too_low = HeadAngles {
            yaw: 0.0,
            pitch: 2.0,
        };
        let reachable = limits::clamp_head(too_low);
        let mut node = node();
        let mut next = |previous| {
            goal(
                &mut node,
                HeadMotion::LookAround,
                previous,
                &[too_low, LEFT],
            )
        };
        assert_eq!(next(None), Some(reachable));
        assert_eq!(next(Some(reachable)), Some(LEFT));
    }

    #[test]
    fn without_way_points_or_while_the_head_is_elsewhere_there_is_no_goal() {
        assert_eq!(goal(&mut node(), HeadMotion::LookAround, None, &[]), None);
        assert_eq!(goal(&mut node(), HeadMotion::Ahead, None, &[LEFT]), None);
    }
}
