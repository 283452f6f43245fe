//! How a real body differs from an ideal one; an ideal one unless it is said.

use framework::{Error, Result};
use serde::Deserialize;

/// What is wrong with the body; every key may be left out, zero is nothing.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct Imperfections {
    /// Chooses the noise and the biases: the same seed gives the same of both.
    pub seed: u64,
    /// LoLA's cycles of 12 ms that a command waits before the motors hear of it. Without any, a command has its effect in
    /// the second state after the one that it answers.
    pub command_delay: usize,
    /// Of joints of the legs: how far a motor turns before its joint does, rad.
    pub backlash: f64,
    /// One standard deviation, in each sample.
    pub noise: SensorErrors,
    /// One standard deviation; stays as it is for the whole run.
    pub bias: SensorErrors,
}

/// How wrong sensors are, one standard deviation.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct SensorErrors {
    /// x, y, z in rad/s.
    pub gyroscope: [f32; 3],
    /// x, y, z in m/s².
    pub accelerometer: [f32; 3],
    /// Of each resistor below the soles, kg.
    pub force: f32,
    /// Of each joint, rad.
    pub joints: f32,
}

impl Imperfections {
    /// Those of a NAO.
    ///
    /// - Three samples pass from a command to its effect (B-Human's walk of 2024, HULKs' trained walk of 2025).
    /// - Play of hip and knee: B-Human's reference joint play, 1.4°.
    /// - Noise of the inertial unit: standing robots, HULKs' MuJoCo model; of joints and resistors: Nao Devils' simulator.
    /// - Biases: estimated; an inertial unit that is mounted 0.5° askew, joints calibrated to 0.3°.
    pub fn of_a_nao(seed: u64) -> Self {
        Self {
            seed,
            command_delay: 1,
            backlash: 1.4_f64.to_radians(),
            noise: SensorErrors {
                gyroscope: [0.003_889, 0.005_522, 0.002_381],
                accelerometer: [0.063_137, 0.029_709, 0.087_581],
                force: 0.005,
                joints: 0.000_5,
            },
            bias: SensorErrors {
                gyroscope: [0.01; 3],
                accelerometer: [0.09; 3],
                force: 0.0,
                joints: 0.005,
            },
        }
    }

    pub(super) fn check(&self) -> Result<()> {
        let errors = [("noise", &self.noise), ("bias", &self.bias)];
        let of_sensors = errors.iter().flat_map(|(table, errors)| {
            let SensorErrors {
                gyroscope,
                accelerometer,
                force,
                joints,
            } = errors;
            let scalars = [("force", *force), ("joints", *joints)];
            let vectors = [("gyroscope", gyroscope), ("accelerometer", accelerometer)];
            let parts = vectors
                .into_iter()
                .flat_map(|(key, parts)| parts.map(|part| (key, part)));
            parts
                .chain(scalars)
                .map(move |(key, number)| (format!("{table}.{key}"), f64::from(number)))
        });
        let own = [("backlash".to_owned(), self.backlash)];
        for (key, number) in own.into_iter().chain(of_sensors) {
            if !(number.is_finite() && number >= 0.0) {
                return Err(Error::new(format!(
                    "hardware.simulated.imperfections.{key}: {number} is no deviation: expected 0 or more"
                )));
            }
        }
        if self.command_delay > LONGEST_DELAY {
            return Err(Error::new(format!(
                "hardware.simulated.imperfections.command_delay: {} cycles are more than {LONGEST_DELAY}",
                self.command_delay
            )));
        }
        Ok(())
    }
}

/// More than a second is no delay but a broken robot.
const LONGEST_DELAY: usize = 83;
