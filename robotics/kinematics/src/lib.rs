//! The NAO's body in numbers, and where its parts are.
//!
//! Everything here comes from the manufacturer's URDF of the NAO V6 (H25) and the Aldebaran
//! documentation; the same numbers stand in `nao.toml`, and a test holds the two against each other.
//! Frames: x forward, y left, z up. The torso frame's origin is 0.085 m above the hip axis. With all
//! joints at zero every frame is parallel to the torso's: arms forward, legs straight.

pub mod chains;
pub mod inverse;
pub mod links;

pub mod limits;
pub mod motors;
pub mod shells;

pub mod cameras;
pub mod feet;
pub mod inertial;

pub use chains::{Poses, forward_kinematics};
pub use inverse::{LegAngles, LegsAngles, leg_angles};
