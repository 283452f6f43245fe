//! Lets the head look around for the ball, slowly enough for sharp and well-placed images.
//!
//! The head visits way-points one after the other; a client may ask it to look somewhere instead.

use framework::{CycleTime, CyclerState, Input, MainOutput, Parameter, Procedure, Result, context};
use kinematics::limits;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use types::head::{HeadAngles, HeadCommand, HeadRequest};
use types::joints::Joints;
use types::motor_commands::MotionPhase;

/// Where the head was sent last, and where it goes.
#[derive(Debug, Deserialize, Serialize)]
pub struct HeadScan {
    angles: Option<HeadAngles>,
    next_way_point: usize,
    looking_at: Option<HeadAngles>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    positions: Input<Joints<f32>, "sensor_data.positions">,
    cycle_time: CycleTime,
    motion_phase: CyclerState<&MotionPhase, "motion_phase">,

    /// In rad: where the head looks, one after the other.
    way_points: Parameter<Vec<HeadAngles>, "head_scan.way_points">,
    /// In rad/s: the faster, the less do images fit the measured angles.
    velocity: Parameter<f32, "head_scan.velocity">,
    /// Stiffness of the head, 0 (limp) to 1.
    stiffness: Parameter<f32, "head_scan.stiffness">,

    /// Answered with the angles that the head can reach.
    look_at: Procedure<HeadRequest, HeadAngles, "look_at">,
}

#[context]
pub struct MainOutputs {
    /// `None` until the robot is in its ready pose.
    head_command: MainOutput<Option<HeadCommand>>,
}

impl HeadScan {
    /// Begins with the first way-point.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            angles: None,
            next_way_point: 0,
            looking_at: None,
        })
    }

    /// One step towards the next way-point.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        if let Some(call) = context.look_at {
            let (looking_at, answer) = match *call.request() {
                HeadRequest::Scan => (None, self.angles.unwrap_or_default()),
                HeadRequest::LookAt(angles) => {
                    let reachable = limits::clamp_head(angles);
                    (Some(reachable), reachable)
                }
            };
            self.looking_at = looking_at;
            call.answer(answer);
        }
        if *context.motion_phase != MotionPhase::Ready {
            self.angles = None;
            return Ok(MainOutputs {
                head_command: None.into(),
            });
        }

        let measured = HeadAngles {
            yaw: context.positions.head_yaw,
            pitch: context.positions.head_pitch,
        };
        let reach = *context.velocity * context.cycle_time.since_last.as_secs_f32();
        let angles = self.step(self.angles.unwrap_or(measured), context.way_points, reach);
        self.angles = Some(angles);
        Ok(MainOutputs {
            head_command: Some(HeadCommand {
                angles,
                stiffness: *context.stiffness,
            })
            .into(),
        })
    }

    fn step(&mut self, from: HeadAngles, way_points: &[HeadAngles], reach: f32) -> HeadAngles {
        let Some(goal) = self.goal(way_points) else {
            return from;
        };
        let goal = limits::clamp_head(goal);
        let way = Vector2::new(goal.yaw - from.yaw, goal.pitch - from.pitch);
        // A parameter that is no number reaches nothing.
        let reach = reach.max(0.0);
        if way.norm() <= reach {
            if self.looking_at.is_none() {
                self.next_way_point += 1;
            }
            return goal;
        }
        let step = way.normalize() * reach;
        limits::clamp_head(HeadAngles {
            yaw: from.yaw + step.x,
            pitch: from.pitch + step.y,
        })
    }

    fn goal(&self, way_points: &[HeadAngles]) -> Option<HeadAngles> {
        let next = || self.next_way_point.checked_rem(way_points.len());
        self.looking_at.or_else(|| Some(way_points[next()?]))
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use framework::Timestamp;
    use framework::procedure::procedure;

    use super::*;

    const LEFT: HeadAngles = HeadAngles {
        yaw: 0.6,
        pitch: 0.2,
    };
    const RIGHT: HeadAngles = HeadAngles {
        yaw: -0.6,
        pitch: 0.2,
    };

    fn context<'context>(
        positions: &'context Joints<f32>,
        motion_phase: &'context MotionPhase,
        way_points: &'context Vec<HeadAngles>,
    ) -> CycleContext<'context> {
        CycleContext {
            positions,
            cycle_time: CycleTime {
                start: Timestamp::ZERO,
                since_last: Duration::from_millis(12),
            },
            motion_phase,
            way_points,
            velocity: &0.3,
            stiffness: &0.6,
            look_at: None,
        }
    }

    fn node() -> HeadScan {
        HeadScan::new(CreationContext {}).unwrap()
    }

    #[test]
    fn the_head_visits_all_way_points_at_its_velocity() {
        let mut node = node();
        let positions = Joints::filled(0.0);
        let way_points = vec![LEFT, RIGHT];
        let mut last = HeadAngles::default();
        let mut yaws = Vec::new();
        for _ in 0..1000 {
            let context = context(&positions, &MotionPhase::Ready, &way_points);
            let command = node.cycle(context).unwrap().head_command.value.unwrap();
            let way = (command.angles.yaw - last.yaw).hypot(command.angles.pitch - last.pitch);
            assert!(way <= 0.3 * 0.012 * 1.001, "{way}");
            last = command.angles;
            yaws.push(last.yaw);
        }
        assert!(yaws.contains(&LEFT.yaw) && yaws.contains(&RIGHT.yaw));
    }

    #[test]
    fn the_head_is_left_alone_until_the_robot_is_ready() {
        let positions = Joints::filled(0.0);
        let context = context(&positions, &MotionPhase::Rising, const { &Vec::new() });
        assert_eq!(node().cycle(context).unwrap().head_command.value, None);
    }

    #[test]
    fn a_velocity_that_is_no_number_moves_nothing_and_is_forgotten() {
        let mut node = node();
        let positions = Joints::filled(0.0);
        let way_points = vec![LEFT];
        let mut angles = |velocity: &f32| {
            let mut context = context(&positions, &MotionPhase::Ready, &way_points);
            context.velocity = velocity;
            let command = node.cycle(context).unwrap().head_command.value.unwrap();
            command.angles
        };
        assert_eq!(angles(&f32::NAN), HeadAngles::default());
        assert!(angles(&0.3).yaw > 0.0);
    }

    #[test]
    fn without_way_points_the_head_stays() {
        let mut positions = Joints::filled(0.0);
        positions.head_yaw = 0.1;
        let context = context(&positions, &MotionPhase::Ready, const { &Vec::new() });
        let command = node().cycle(context).unwrap().head_command.value.unwrap();
        assert_eq!(command.angles.yaw, 0.1);
    }

    #[test]
    fn a_client_may_ask_the_head_to_look_somewhere() {
        let mut node = node();
        let positions = Joints::filled(0.0);
        let way_points = vec![LEFT];
        let (caller, mut answerer) = procedure();
        let asked = HeadAngles {
            yaw: -0.5,
            pitch: 2.0,
        };
        let pending = caller.call(HeadRequest::LookAt(asked));
        answerer.take();
        let mut with_call = context(&positions, &MotionPhase::Ready, &way_points);
        with_call.look_at = answerer.call();
        node.cycle(with_call).unwrap();
        let answer = pending.try_answer().unwrap().unwrap();
        assert_eq!(answer, limits::clamp_head(asked));
        for _ in 0..500 {
            node.cycle(context(&positions, &MotionPhase::Ready, &way_points))
                .unwrap();
        }
        assert_eq!(node.angles, Some(answer));
    }
}
