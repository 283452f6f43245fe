//! Owns everything that the body reports every 12 ms.
//!
//! What each number means follows the Aldebaran documentation of the NAO V6; signs are those of
//! REP-103, whatever the wire says.

use framework::foxglove::{JointState, JointStates};
use framework::{Clear, Reflect, Timestamp};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::feet::Feet;
use crate::identifier::Identifier;
use crate::joints::Joints;

/// One sample of all sensors of the body.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[reflect(foxglove = Self::joint_states)]
pub struct SensorData {
    /// Measured angles in rad; hands from 0 (closed) to 1 (open).
    pub positions: Joints<f32>,
    /// Stiffnesses as applied, 0 (limp) to 1.
    pub stiffnesses: Joints<f32>,
    /// Motor currents in A.
    pub currents: Joints<f32>,
    /// Motor temperatures in °C, some of them estimated by the body.
    pub temperatures: Joints<f32>,
    /// Heat of the motors: 0 normal, 1 hot, 2 very hot, 3 critical (stiffness is forced to 0).
    pub status: Joints<u8>,
    /// The inertial measurement unit in the torso.
    pub inertial: InertialMeasurement,
    /// Loads of the sensors front left, front right, rear left, rear right of each sole, roughly in kg.
    pub force_sensitive_resistors: Feet<[f32; 4]>,
    /// Buttons, bumpers, and touch-sensitive plates.
    pub touch: Touch,
    /// Echoes in front of the robot.
    pub sonar: Sonar,
    /// State of the battery.
    pub battery: Battery,
    /// Who this body and this head are.
    pub configuration: RobotConfiguration,
    /// Whether the hardware lets the robot down and drops what nodes command, now or at any time since the last sample: the body
    /// is where gravity took it.
    pub is_in_safe_state: bool,
}

impl SensorData {
    /// As tools draw it: the measured angles under the names of the joints.
    fn joint_states(&self, timestamp: Timestamp) -> JointStates {
        let joints = self.positions.iter().map(|(name, position)| JointState {
            name: format!("{name:?}"),
            position: Some(f64::from(*position)),
            ..JointState::default()
        });
        JointStates {
            timestamp: timestamp.into(),
            joints: joints.collect(),
        }
    }
}

/// What the inertial measurement unit reports, in the torso frame.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct InertialMeasurement {
    /// Angular velocity in rad/s.
    pub gyroscope: Vector3<f32>,
    /// Proper acceleration in m/s²: (0, 0, +9.81) when upright and at rest.
    pub accelerometer: Vector3<f32>,
    /// The body's own estimate of the torso's roll in rad, positive leans to the right.
    pub roll: f32,
    /// The body's own estimate of the torso's pitch in rad, positive leans forward.
    pub pitch: f32,
}

/// What is pressed or touched.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct Touch {
    /// The button on the chest.
    pub chest_button: bool,
    /// The front plate of the head.
    pub head_front: bool,
    /// The middle plate of the head.
    pub head_middle: bool,
    /// The rear plate of the head.
    pub head_rear: bool,
    /// The left bumper of the left foot.
    pub left_foot_left: bool,
    /// The right bumper of the left foot.
    pub left_foot_right: bool,
    /// The back of the left hand.
    pub left_hand_back: bool,
    /// The left of the left hand.
    pub left_hand_left: bool,
    /// The right of the left hand.
    pub left_hand_right: bool,
    /// The left bumper of the right foot.
    pub right_foot_left: bool,
    /// The right bumper of the right foot.
    pub right_foot_right: bool,
    /// The back of the right hand.
    pub right_hand_back: bool,
    /// The left of the right hand.
    pub right_hand_left: bool,
    /// The right of the right hand.
    pub right_hand_right: bool,
}

/// Distances to the nearest echo in m; 0 or 5 where there is none.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Sonar {
    /// Left receiver.
    pub left: f32,
    /// Right receiver.
    pub right: f32,
}

/// State of the battery.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Battery {
    /// Charge from 0 (empty) to 1 (full).
    pub charge: f32,
    /// Status bits of the battery's controller, as LoLA sends them: a 16-bit integer as a float.
    pub status: f32,
    /// Current in A, positive while charging.
    pub current: f32,
    /// Temperature in °C.
    pub temperature: f32,
}

/// Who this robot is.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct RobotConfiguration {
    /// Serial number of the body, 20 characters.
    pub body_id: Identifier,
    /// Version of the body, for example `6.0.0`.
    pub body_version: Identifier,
    /// Serial number of the head, 20 characters.
    pub head_id: Identifier,
    /// Version of the head, for example `6.0.0`.
    pub head_version: Identifier,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joints::{JOINT_COUNT, JointName};

    #[test]
    fn tools_draw_every_joint_under_its_name() {
        let mut sensors = SensorData::default();
        sensors.positions[JointName::RightKneePitch] = 0.5;
        let form = SensorData::foxglove().expect("its type says so");
        assert_eq!(form.schema.name, "foxglove.JointStates");
        let drawn = sensors.joint_states(Timestamp::from_nanos(1_000_000_005));
        assert_eq!((drawn.timestamp.sec, drawn.timestamp.nsec), (1, 5));
        assert_eq!(drawn.joints.len(), JOINT_COUNT);
        let mut knees = drawn
            .joints
            .iter()
            .filter(|joint| joint.name == "RightKneePitch");
        assert_eq!(knees.next().and_then(|knee| knee.position), Some(0.5));
    }
}
