//! The messages as another MessagePack library sees them.

use lola::Command;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use types::feet::Feet;
use types::joints::Joints;
use types::leds::{Color, Leds};
use types::motor_commands::MotorCommands;
use types::sensor_data::{
    Battery, InertialMeasurement, RobotConfiguration, SensorData, Sonar, Touch,
};

/// A state as it stands on the wire.
#[derive(Debug, Deserialize, Serialize)]
#[serde(rename_all = "PascalCase")]
pub(crate) struct WireState {
    pub(crate) robot_config: [String; 4],
    pub(crate) accelerometer: [f32; 3],
    pub(crate) angles: [f32; 2],
    pub(crate) battery: [f32; 4],
    pub(crate) current: [f32; 25],
    #[serde(rename = "FSR")]
    pub(crate) fsr: [f32; 8],
    pub(crate) gyroscope: [f32; 3],
    pub(crate) position: [f32; 25],
    pub(crate) sonar: [f32; 2],
    pub(crate) stiffness: [f32; 25],
    pub(crate) temperature: [f32; 25],
    pub(crate) touch: [f32; 14],
    pub(crate) status: [u8; 25],
}

/// A command as it stands on the wire.
#[derive(Debug, Deserialize, Serialize)]
#[serde(rename_all = "PascalCase")]
pub(crate) struct WireCommand {
    pub(crate) position: [f32; 25],
    pub(crate) stiffness: [f32; 25],
    pub(crate) chest: [f32; 3],
    #[serde(rename = "LEar")]
    pub(crate) l_ear: [f32; 10],
    #[serde(rename = "REar")]
    pub(crate) r_ear: [f32; 10],
    #[serde(rename = "LEye")]
    pub(crate) l_eye: [f32; 24],
    #[serde(rename = "REye")]
    pub(crate) r_eye: [f32; 24],
    #[serde(rename = "LFoot")]
    pub(crate) l_foot: [f32; 3],
    #[serde(rename = "RFoot")]
    pub(crate) r_foot: [f32; 3],
    pub(crate) skull: [f32; 12],
    pub(crate) sonar: [bool; 2],
}

impl WireState {
    /// Keys and encoded values, in the order of the wire.
    pub(crate) fn entries(&self) -> Vec<(String, Vec<u8>)> {
        let entry = |key: &str, value: Vec<u8>| (key.to_owned(), value);
        let floats = |values: &[f32]| rmp_serde::to_vec(values).unwrap();
        vec![
            entry(
                "RobotConfig",
                rmp_serde::to_vec(&self.robot_config).unwrap(),
            ),
            entry("Accelerometer", floats(&self.accelerometer)),
            entry("Angles", floats(&self.angles)),
            entry("Battery", floats(&self.battery)),
            entry("Current", floats(&self.current)),
            entry("FSR", floats(&self.fsr)),
            entry("Gyroscope", floats(&self.gyroscope)),
            entry("Position", floats(&self.position)),
            entry("Sonar", floats(&self.sonar)),
            entry("Stiffness", floats(&self.stiffness)),
            entry("Temperature", floats(&self.temperature)),
            entry("Touch", floats(&self.touch)),
            entry("Status", rmp_serde::to_vec(&self.status).unwrap()),
        ]
    }
}

impl From<&SensorData> for WireState {
    fn from(state: &SensorData) -> Self {
        let Battery {
            charge,
            status,
            current,
            temperature,
        } = state.battery;
        let touch = &state.touch;
        let configuration = &state.configuration;
        let acceleration = -state.inertial.accelerometer;
        let feet = [
            state.force_sensitive_resistors.left,
            state.force_sensitive_resistors.right,
        ];
        Self {
            robot_config: [
                configuration.body_id.to_string(),
                configuration.body_version.to_string(),
                configuration.head_id.to_string(),
                configuration.head_version.to_string(),
            ],
            accelerometer: acceleration.into(),
            angles: [state.inertial.roll, state.inertial.pitch],
            battery: [charge, status, current, temperature],
            current: state.currents.to_array(),
            fsr: std::array::from_fn(|place| feet[place / 4][place % 4]),
            gyroscope: state.inertial.gyroscope.into(),
            position: state.positions.to_array(),
            sonar: [state.sonar.left, state.sonar.right],
            stiffness: state.stiffnesses.to_array(),
            temperature: state.temperatures.to_array(),
            touch: [
                touch.chest_button,
                touch.head_front,
                touch.head_middle,
                touch.head_rear,
                touch.left_foot_left,
                touch.left_foot_right,
                touch.left_hand_back,
                touch.left_hand_left,
                touch.left_hand_right,
                touch.right_foot_left,
                touch.right_foot_right,
                touch.right_hand_back,
                touch.right_hand_left,
                touch.right_hand_right,
            ]
            .map(|touched| f32::from(u8::from(touched))),
            status: state.status.to_array(),
        }
    }
}

impl From<&Command> for WireCommand {
    fn from(command: &Command) -> Self {
        let leds = &command.leds;
        let color = |color: Color| [color.red, color.green, color.blue];
        let eye = |eye: [Color; 8]| {
            let red = eye.map(|segment| segment.red);
            let green = eye.map(|segment| segment.green);
            let blue = eye.map(|segment| segment.blue);
            [red, green, blue].concat().try_into().unwrap()
        };
        Self {
            position: command.motors.positions.to_array(),
            stiffness: command.motors.stiffnesses.to_array(),
            chest: color(leds.chest),
            l_ear: leds.left_ear,
            r_ear: leds.right_ear,
            l_eye: eye(leds.left_eye),
            r_eye: eye(leds.right_eye),
            l_foot: color(leds.left_foot),
            r_foot: color(leds.right_foot),
            skull: leds.skull,
            sonar: command.sonars,
        }
    }
}

/// A state in which every value differs from its neighbours.
pub(crate) fn sample_state() -> SensorData {
    SensorData {
        positions: Joints::from_fn(|joint| joint as usize as f32 * 0.01),
        stiffnesses: Joints::from_fn(|joint| 1.0 - joint as usize as f32 * 0.01),
        currents: Joints::from_fn(|joint| joint as usize as f32 * 0.1),
        temperatures: Joints::from_fn(|joint| 30.0 + joint as usize as f32),
        status: Joints::from_fn(|joint| joint as u8 % 4),
        inertial: InertialMeasurement {
            gyroscope: Vector3::new(0.1, 0.2, 0.3),
            accelerometer: Vector3::new(0.5, -0.25, 9.75),
            roll: 0.02,
            pitch: -0.04,
        },
        force_sensitive_resistors: Feet {
            left: [0.5, 0.6, 0.7, 0.8],
            right: [0.9, 1.0, 1.1, 1.2],
        },
        touch: Touch {
            chest_button: true,
            right_hand_right: true,
            left_foot_right: true,
            ..Touch::default()
        },
        sonar: Sonar {
            left: 0.7,
            right: 5.0,
        },
        battery: Battery {
            charge: 0.99,
            status: -32552.0,
            current: 0.016,
            temperature: 36.0,
        },
        configuration: RobotConfiguration {
            body_id: "P0000073A03S83I00011".parse().unwrap(),
            body_version: "6.0.0".parse().unwrap(),
            head_id: "P0000074A04S86H00022".parse().unwrap(),
            head_version: "6.0.1".parse().unwrap(),
        },
        // No state says so: the hardware does.
        is_in_safe_state: false,
    }
}

/// A command in which every value differs from its neighbours.
pub(crate) fn sample_command() -> Command {
    let shade = |place: usize| Color::new(place as f32, place as f32 + 0.25, place as f32 + 0.5);
    Command {
        motors: MotorCommands {
            positions: Joints::from_fn(|joint| joint as usize as f32 * -0.01),
            stiffnesses: Joints::from_fn(|joint| joint as usize as f32 * 0.04),
        },
        leds: Leds {
            left_eye: std::array::from_fn(shade),
            right_eye: std::array::from_fn(|place| shade(place + 10)),
            left_ear: std::array::from_fn(|place| place as f32 * 0.1),
            right_ear: std::array::from_fn(|place| place as f32 * 0.2),
            skull: std::array::from_fn(|place| place as f32 * 0.3),
            chest: shade(20),
            left_foot: shade(21),
            right_foot: shade(22),
        },
        sonars: [true, false],
    }
}
