//! Between an ideal body and what the robot gets of it: commands that come late, joints with play, sensors that are wrong.

use std::collections::VecDeque;

use types::joints::{JointName, Joints};
use types::motor_commands::MotorCommands;
use types::sensor_data::SensorData;

use crate::noise::{SENSOR_BIAS, SENSOR_NOISE, hash, normal};
use crate::settings::{Imperfections as Settings, SensorErrors};

/// One body's.
pub(super) struct Imperfections {
    settings: Settings,
    /// Commands that the motors do not know of, oldest first.
    waiting: VecDeque<MotorCommands>,
    samples: u64,
}

impl Imperfections {
    pub(super) fn new(settings: &Settings) -> Self {
        Self {
            settings: settings.clone(),
            waiting: VecDeque::new(),
            samples: 0,
        }
    }

    /// Takes the newest commands, gives those that the motors hear now; `None` while the first ones wait.
    pub(super) fn delay(&mut self, commands: MotorCommands) -> Option<MotorCommands> {
        self.waiting.push_back(commands);
        if self.waiting.len() > self.settings.command_delay {
            self.waiting.pop_front()
        } else {
            None
        }
    }

    /// Where motors push their joints: nowhere while they turn in the play.
    pub(super) fn push(&self, commands: &mut MotorCommands, joints: &Joints<f64>) {
        let half = self.settings.backlash / 2.0;
        if half == 0.0 {
            return;
        }
        for joint in JointName::ALL.into_iter().filter(|joint| joint.is_of_leg()) {
            let (target, is) = (f64::from(commands.positions[joint]), joints[joint]);
            let ahead = target - is;
            commands.positions[joint] = (is + ahead - ahead.clamp(-half, half)) as f32;
        }
    }

    /// Makes a sample as wrong as sensors are.
    pub(super) fn spoil(&mut self, sensors: &mut SensorData) {
        self.samples += 1;
        let Settings {
            seed, noise, bias, ..
        } = &self.settings;
        let sample = self.samples * SENSORS;
        add(sensors, noise, |sensor| {
            normal(hash(*seed, SENSOR_NOISE, sample + sensor))
        });
        add(sensors, bias, |sensor| {
            normal(hash(*seed, SENSOR_BIAS, sensor))
        });
    }
}

/// More than there are.
const SENSORS: u64 = 64;

/// Adds errors with these deviations; `normal` gives a number for each sensor.
fn add(sensors: &mut SensorData, deviations: &SensorErrors, normal: impl Fn(u64) -> f32) {
    if *deviations == SensorErrors::default() {
        return;
    }
    let mut sensor = 0;
    let mut error = |deviation: f32| {
        sensor += 1;
        deviation * normal(sensor)
    };
    for axis in 0..3 {
        sensors.inertial.gyroscope[axis] += error(deviations.gyroscope[axis]);
        sensors.inertial.accelerometer[axis] += error(deviations.accelerometer[axis]);
    }
    let resistors = &mut sensors.force_sensitive_resistors;
    for resistor in resistors.left.iter_mut().chain(&mut resistors.right) {
        *resistor = (*resistor + error(deviations.force)).max(0.0);
    }
    sensors.positions =
        Joints::from_fn(|joint| sensors.positions[joint] + error(deviations.joints));
}
