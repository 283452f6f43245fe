//! Owns decoding a state key by key.

use nalgebra::Vector3;
use types::feet::Feet;
use types::identifier::Identifier;
use types::joints::{JOINT_COUNT, Joints};
use types::sensor_data::{RobotConfiguration, SensorData, Sonar};

use super::arrays;
use crate::error::DecodeError;
use crate::messagepack::Reader;

/// All keys; a state must have each of them once.
const KEYS: [&str; 13] = [
    "RobotConfig",
    "Accelerometer",
    "Angles",
    "Battery",
    "Current",
    "FSR",
    "Gyroscope",
    "Position",
    "Sonar",
    "Stiffness",
    "Temperature",
    "Touch",
    "Status",
];

/// Fills one state from the bytes of a message.
pub(super) struct Decoder<'a> {
    reader: Reader<'a>,
    seen: [bool; KEYS.len()],
    state: SensorData,
}

impl<'a> Decoder<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            reader: Reader::new(bytes),
            seen: [false; KEYS.len()],
            state: SensorData::default(),
        }
    }

    pub(super) fn decode(mut self) -> Result<SensorData, DecodeError> {
        for _ in 0..self.reader.map()? {
            let key = self.reader.text()?;
            match KEYS.iter().position(|known| *known == key) {
                Some(place) => self.entry(place)?,
                None => self.reader.skip()?,
            }
        }
        self.reader.finish()?;
        match self.seen.iter().position(|seen| !seen) {
            Some(place) => Err(DecodeError::Missing { key: KEYS[place] }),
            None => Ok(self.state),
        }
    }

    fn entry(&mut self, place: usize) -> Result<(), DecodeError> {
        let key = KEYS[place];
        if std::mem::replace(&mut self.seen[place], true) {
            return Err(DecodeError::Duplicate { key });
        }
        match key {
            "RobotConfig" => self.state.configuration = self.configuration(key)?,
            "Accelerometer" => self.state.inertial.accelerometer = -self.vector(key)?,
            "Angles" => {
                let [roll, pitch] = self.floats(key)?;
                self.state.inertial.roll = roll;
                self.state.inertial.pitch = pitch;
            }
            "Battery" => self.state.battery = arrays::to_battery(self.floats(key)?),
            "Current" => self.state.currents = self.joints(key)?,
            "FSR" => self.state.force_sensitive_resistors = self.feet(key)?,
            "Gyroscope" => self.state.inertial.gyroscope = self.vector(key)?,
            "Position" => self.state.positions = self.joints(key)?,
            "Sonar" => {
                let [left, right] = self.floats(key)?;
                self.state.sonar = Sonar { left, right };
            }
            "Stiffness" => self.state.stiffnesses = self.joints(key)?,
            "Temperature" => self.state.temperatures = self.joints(key)?,
            "Touch" => self.state.touch = arrays::to_touch(self.floats(key)?),
            _ => self.state.status = self.status(key)?,
        }
        Ok(())
    }

    fn floats<const VALUES: usize>(
        &mut self,
        key: &'static str,
    ) -> Result<[f32; VALUES], DecodeError> {
        self.reader.array(key, VALUES)?;
        let mut values = [0.0; VALUES];
        for value in &mut values {
            *value = self.reader.float(key)?;
        }
        Ok(values)
    }

    fn vector(&mut self, key: &'static str) -> Result<Vector3<f32>, DecodeError> {
        Ok(Vector3::from(self.floats::<3>(key)?))
    }

    fn joints(&mut self, key: &'static str) -> Result<Joints<f32>, DecodeError> {
        Ok(Joints::from_array(self.floats(key)?))
    }

    fn feet(&mut self, key: &'static str) -> Result<Feet<[f32; 4]>, DecodeError> {
        let [a, b, c, d, e, f, g, h] = self.floats(key)?;
        Ok(Feet {
            left: [a, b, c, d],
            right: [e, f, g, h],
        })
    }

    fn status(&mut self, key: &'static str) -> Result<Joints<u8>, DecodeError> {
        self.reader.array(key, JOINT_COUNT)?;
        let mut status = Joints::filled(0);
        for value in status.each_mut() {
            *value = self.reader.byte(key)?;
        }
        Ok(status)
    }

    fn configuration(&mut self, key: &'static str) -> Result<RobotConfiguration, DecodeError> {
        self.reader.array(key, 4)?;
        Ok(RobotConfiguration {
            body_id: self.identifier(key)?,
            body_version: self.identifier(key)?,
            head_id: self.identifier(key)?,
            head_version: self.identifier(key)?,
        })
    }

    fn identifier(&mut self, key: &'static str) -> Result<Identifier, DecodeError> {
        let text = self.reader.text()?;
        text.parse().map_err(|_| DecodeError::OutOfRange { key })
    }
}
