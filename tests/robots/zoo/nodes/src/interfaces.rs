//! What the zoo's nodes ask of the hardware.

use framework::{Result, Timestamp};

use crate::types::{Camera, Image};

pub trait EyeInterface {
    /// Waits for the next image of this camera; gives the time at which it was taken.
    fn read_image(&self, camera: Camera, image: &mut Image) -> Result<Timestamp>;
}

pub trait EarInterface {
    /// Waits for the next piece of sound; gives its loudness and the time at which it was taken.
    fn read_sound(&self) -> Result<(Timestamp, f32)>;
}

pub trait BodyInterface {
    /// Waits for the next angles of the joints, in radians.
    fn read_joints(&self) -> Result<(Timestamp, [f32; 3])>;
    /// How long the legs are, in metres.
    fn leg_length(&self) -> f32;
}

pub trait BumperInterface {
    /// Waits until the bumper was looked at again; whether it is pressed.
    fn read_bumper(&self) -> Result<bool>;
}

pub trait MetronomeInterface {
    /// Waits for the next beat; gives its number.
    fn read_beat(&self) -> Result<u64>;
}

pub trait LegInterface {
    /// Moves the legs.
    fn write_angles(&self, angles: &[f32]) -> Result<()>;
}

pub trait LampInterface {
    /// Lights the lamp.
    fn write_brightness(&self, brightness: f32);
}
