//! Shows people what the robot believes: the left eye about the ball, the right eye about the ground.

use framework::{Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::ball::Ball;
use types::leds::{Color, Leds};

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct LedStatus {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    ball: Input<Option<Ball>, "ball">,
    ground_contact: Input<bool, "ground_contact">,

    /// The left eye while the ball is known.
    ball_known: Parameter<Color, "led_status.ball_known">,
    /// The left eye while it is not.
    ball_unknown: Parameter<Color, "led_status.ball_unknown">,
    /// The right eye while the robot stands.
    on_ground: Parameter<Color, "led_status.on_ground">,
    /// The right eye while it does not.
    in_the_air: Parameter<Color, "led_status.in_the_air">,
}

#[context]
pub struct MainOutputs {
    /// `None` only where this node failed: the lights stay as they are.
    leds: MainOutput<Option<Leds>>,
}

impl LedStatus {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Chooses the colours.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let left_eye = match context.ball {
            Some(_) => context.ball_known,
            None => context.ball_unknown,
        };
        let right_eye = match context.ground_contact {
            true => context.on_ground,
            false => context.in_the_air,
        };
        Ok(MainOutputs {
            leds: Some(Leds {
                left_eye: [*left_eye; 8],
                right_eye: [*right_eye; 8],
                ..Leds::default()
            })
            .into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GREEN: Color = Color::new(0.0, 1.0, 0.0);
    const RED: Color = Color::new(1.0, 0.0, 0.0);

    fn leds(ball: Option<Ball>, ground_contact: bool) -> Leds {
        let mut node = LedStatus::new(CreationContext {}).unwrap();
        let context = CycleContext {
            ball: &ball,
            ground_contact: &ground_contact,
            ball_known: &GREEN,
            ball_unknown: &Color::OFF,
            on_ground: &GREEN,
            in_the_air: &RED,
        };
        node.cycle(context).unwrap().leds.value.unwrap()
    }

    #[test]
    fn the_left_eye_tells_whether_the_ball_is_known() {
        assert_eq!(leds(Some(Ball::default()), true).left_eye, [GREEN; 8]);
        assert_eq!(leds(None, true).left_eye, [Color::OFF; 8]);
    }

    #[test]
    fn the_right_eye_tells_whether_the_robot_stands() {
        assert_eq!(leds(None, true).right_eye, [GREEN; 8]);
        assert_eq!(leds(None, false).right_eye, [RED; 8]);
    }
}
