//! Walks: keeps the body in balance on one foot while the other one goes where the behaviour wants it.
//!
//! What it computes stands in the crate `walking`; the node gives it the robot's senses and says when the walk can be left.

use framework::{
    CycleTime, CyclerState, Input, MainOutput, Parameter, Reflect, Result, context, math,
};
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use types::feet::Feet;
use types::joints::Joints;
use types::motion::{BodyMotion, MotionCommand, MotionSelection, Step};
use types::motor_commands::MotorCommands;
use walking::{Engine, Parameters, Senses};

/// Where the walk is.
#[derive(Debug, Deserialize, Serialize)]
pub struct WalkingEngine {
    engine: Engine,
}

/// From which heat on motors of the legs are spared.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Heat {
    /// In °C, of the hottest motor of the legs: from here on steps become shorter.
    #[reflect(unit = "°C", range = 0.0..)]
    pub shorter_from: f32,
    /// In °C: from here on the robot stands still.
    #[reflect(unit = "°C", range = 0.0..)]
    pub stops_at: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    motion_command: Input<MotionCommand, "motion_command">,
    motion_selection: Input<MotionSelection, "motion_selection">,
    gyroscope: Input<Vector3<f32>, "sensor_data.inertial.gyroscope">,
    orientation: Input<UnitQuaternion<f32>, "orientation">,
    // Not the smoothed ones: they would feel the floor later.
    resistors: Input<Feet<[f32; 4]>, "sensor_data.force_sensitive_resistors">,
    temperatures: Input<Joints<f32>, "sensor_data.temperatures">,
    cycle_time: CycleTime,
    /// Whether both feet stand side by side.
    safe_exit: CyclerState<bool, "safe_exits.walk">,

    /// Everything about the walk that can be tuned.
    parameters: Parameter<Parameters, "walking_engine">,
    /// How hot motors may become.
    heat: Parameter<Heat, "walking_heat">,
    /// A robot that weighs less on its soles is in the air: no foot carries it.
    #[reflect(unit = "kg", range = 0.0..)]
    least_weight: Parameter<f32, "walking_feet.least_weight">,
}

#[context]
pub struct MainOutputs {
    /// For all joints; `None` while another motion has the body.
    walk_commands: MainOutput<Option<MotorCommands>>,
}

impl WalkingEngine {
    /// Standing.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            engine: Engine::new(),
        })
    }

    /// Goes on with the stride; comes to a stop where something else is wanted.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        if !context.motion_selection.is_at(BodyMotion::Walk) {
            self.engine = Engine::new();
            *context.safe_exit = false;
            return Ok(MainOutputs {
                walk_commands: None.into(),
            });
        }
        let command = context.motion_command;
        let left = context.heat.left(context.temperatures);
        let walks = command.body == BodyMotion::Walk && left > 0.0;
        let wanted = walks.then_some(Step {
            forward: left * command.step.forward,
            left: left * command.step.left,
            turn: left * command.step.turn,
        });
        let senses = Senses {
            since_last: context.cycle_time.since_last.as_secs_f32(),
            angular_velocity: [context.gyroscope.x, context.gyroscope.y],
            heading: heading(context.orientation),
            pressures: shares(context.resistors, *context.least_weight),
        };
        let commands = self.engine.cycle(wanted, &senses, context.parameters);
        *context.safe_exit = command.body != BodyMotion::Walk && self.engine.is_standing();
        Ok(MainOutputs {
            walk_commands: Some(commands).into(),
        })
    }
}

impl Heat {
    /// Share of every step that is left at these temperatures (°C), 0 to 1. A sensor that says no number says nothing.
    fn left(&self, temperatures: &Joints<f32>) -> f32 {
        let legs = temperatures.iter().filter(|(joint, _)| joint.is_of_leg());
        let hottest = legs.map(|(_, celsius)| *celsius).fold(0.0, f32::max);
        let left = (self.stops_at - hottest) / (self.stops_at - self.shorter_from);
        if left.is_nan() {
            0.0
        } else {
            left.clamp(0.0, 1.0)
        }
    }
}

/// Where the torso's x axis points on the ground, in rad.
fn heading(torso_to_world: &UnitQuaternion<f32>) -> f32 {
    let ahead = torso_to_world * Vector3::x();
    math::atan2(ahead.y, ahead.x)
}

/// How the weight is spread over the feet, 0 to 1: resistors measure shares better than weights.
fn shares(resistors: &Feet<[f32; 4]>, least_weight: f32) -> Feet<f32> {
    let Feet { left, right } = resistors.map(|loads| loads.iter().sum::<f32>());
    let weight = left + right;
    if weight.is_finite() && weight > least_weight {
        Feet {
            left: left / weight,
            right: right / weight,
        }
    } else {
        Feet::default()
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{self, ParameterFile};
    use kinematics::limits;
    use walking::standing_pose;

    use super::*;

    const FORWARD: MotionCommand = MotionCommand {
        body: BodyMotion::Walk,
        head: types::motion::HeadMotion::WithBody,
        step: Step {
            forward: 0.05,
            ..Step::ZERO
        },
    };
    const STAND: MotionCommand = MotionCommand {
        body: BodyMotion::Stand,
        ..FORWARD
    };

    fn parameters() -> Parameters {
        ParameterFile::new(include_str!("../../parameters/default.toml")).get("walking_engine")
    }

    const LEAST_WEIGHT: f32 = 1.0;
    const HEAT: Heat = Heat {
        shorter_from: 70.0,
        stops_at: 75.0,
    };

    #[test]
    fn hot_legs_take_shorter_steps_and_then_none() {
        let mut temperatures = Joints::filled(40.0);
        temperatures.head_yaw = 99.0;
        for (celsius, left) in [
            (40.0, 1.0),
            (70.0, 1.0),
            (72.5, 0.5),
            (75.0, 0.0),
            (99.0, 0.0),
            (f32::INFINITY, 0.0),
            (f32::NAN, 1.0),
        ] {
            temperatures.right_ankle_pitch = celsius;
            assert_eq!(HEAT.left(&temperatures), left, "at {celsius} °C");
        }
        let nonsense = Heat {
            shorter_from: f32::NAN,
            ..HEAT
        };
        assert_eq!(nonsense.left(&temperatures), 0.0);
    }

    fn node() -> WalkingEngine {
        WalkingEngine::new(CreationContext {}).unwrap()
    }

    /// With both soles on the floor, which ends each stride as early as it may.
    fn cycle(
        node: &mut WalkingEngine,
        motion_command: &MotionCommand,
        is_dispatching: bool,
        gyroscope: f32,
        load: f32,
    ) -> (Option<MotorCommands>, bool) {
        let mut safe_exit = true;
        let motion_selection = MotionSelection {
            current: BodyMotion::Walk,
            is_dispatching,
        };
        let context = CycleContext {
            motion_command,
            motion_selection: &motion_selection,
            gyroscope: &Vector3::repeat(gyroscope),
            orientation: &UnitQuaternion::identity(),
            resistors: &Feet {
                left: [load; 4],
                right: [load; 4],
            },
            temperatures: &Joints::filled(40.0),
            cycle_time: testing::cycle_time(0, 12),
            safe_exit: &mut safe_exit,
            parameters: &parameters(),
            heat: &HEAT,
            least_weight: &LEAST_WEIGHT,
        };
        let commands = node.cycle(context).unwrap().walk_commands.value;
        (commands, safe_exit)
    }

    #[test]
    fn it_begins_in_its_pose_and_only_once_it_has_the_body() {
        let mut node = node();
        assert_eq!(cycle(&mut node, &FORWARD, true, 0.0, 0.7), (None, false));
        let (commands, safe_exit) = cycle(&mut node, &FORWARD, false, 0.0, 0.7);
        assert_eq!(commands.unwrap().positions, standing_pose(&parameters()));
        assert!(!safe_exit);
    }

    #[test]
    fn it_stops_before_another_motion_gets_the_body() {
        let mut node = node();
        for _ in 0..100 {
            let (_, safe_exit) = cycle(&mut node, &FORWARD, false, 0.0, 0.7);
            assert!(!safe_exit);
        }
        let stops = |_| cycle(&mut node, &STAND, false, 0.0, 0.7);
        let stopped = (0..100).map(stops).find(|(_, safe_exit)| *safe_exit);
        let (commands, _) = stopped.expect("two steps take less than 1.2 s");
        assert_eq!(commands.unwrap().positions, standing_pose(&parameters()));
    }

    #[test]
    fn whatever_the_sensors_say_the_legs_stay_where_they_can_be() {
        for (gyroscope, load) in [
            (f32::NAN, f32::NAN),
            (f32::INFINITY, 0.0),
            (1e30, -3.0),
            (0.0, 1e30),
        ] {
            let mut node = node();
            for _ in 0..100 {
                let (commands, _) = cycle(&mut node, &FORWARD, false, gyroscope, load);
                let positions = commands.unwrap().positions;
                for (joint, angle) in positions.iter() {
                    let nearest = limits::clamp(joint, *angle);
                    assert!(angle.is_finite(), "{joint:?}");
                    // The balance turns ankles, which the collector limits.
                    let is_ankle = format!("{joint:?}").contains("Ankle");
                    assert!(
                        is_ankle || (angle - nearest).abs() < 0.05,
                        "{joint:?} {angle}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_robot_in_the_air_stands_on_no_foot() {
        let feet = |left, right| Feet {
            left: [left; 4],
            right: [right; 4],
        };
        let shares = |feet: &Feet<[f32; 4]>| shares(feet, LEAST_WEIGHT);
        assert_eq!(shares(&feet(0.1, 0.1)), Feet::default());
        assert_eq!(shares(&feet(f32::NAN, 1.0)), Feet::default());
        let shares = shares(&feet(0.3, 0.9));
        assert!((shares.left - 0.25).abs() < 1e-6 && (shares.right - 0.75).abs() < 1e-6);
    }
}
