//! The seam to physics: what moves robots and ball when motors are told to turn.
//!
//! [`Dynamic`] has masses, contacts and torques; [`Kinematic`] is the cheap choice, whose robots never
//! fall and whose ball stays where it is. Both know the same [`Situation`] and any number of robots.

mod body;
mod dynamic;
mod kinematic;

pub(crate) use body::heading;
pub use body::{Body, Start, weight};
pub use dynamic::{Dynamic, ROLLING_DECELERATION, empty_world, mjcf};
pub use kinematic::Kinematic;

use std::time::Duration;

use nalgebra::{Isometry3, Point3, Vector3};
use types::motor_commands::MotorCommands;

/// Time passes in steps of this length: short enough for feet on the floor, and a quarter of LoLA's
/// cycle.
pub const STEP: Duration = Duration::from_millis(3);

/// Moves the world through time. The same calls give the same bits.
pub trait Physics: Send {
    /// Lets [`STEP`] pass while the motors of each robot are driven to its commands. A robot without
    /// commands is limp.
    fn step(&mut self, commands: &[MotorCommands]);

    /// The robots' bodies as the last step left them.
    fn bodies(&self) -> &[Body];

    /// The ball, if there is one.
    fn ball(&self) -> Option<Ball>;

    /// From the torso frames of the bystanders to the field frame.
    fn bystanders(&self) -> &[Isometry3<f64>];

    /// Does to the world what no motor does. Who does not exist is not disturbed.
    fn disturb(&mut self, disturbance: &Disturbance);
}

/// How a world begins.
#[derive(Clone, Debug)]
pub struct Situation {
    /// Robots with motors.
    pub robots: Vec<Start>,
    /// Robots that keep their joints as they are; one can run into them and knock them over.
    pub bystanders: Vec<Start>,
    /// Where the ball lies in the field frame, m.
    pub ball: Option<[f64; 2]>,
    /// What friction on the carpet is, as a share of the usual.
    pub carpet_friction: f64,
}

impl Default for Situation {
    fn default() -> Self {
        Self {
            robots: Vec::new(),
            bystanders: Vec::new(),
            ball: None,
            carpet_friction: 1.0,
        }
    }
}

/// A ball in motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its centre in the field frame, m.
    pub position: Point3<f64>,
    /// In the field frame, m/s.
    pub velocity: Vector3<f64>,
}

/// What somebody does to the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Disturbance {
    /// Pushes a robot at the origin of its torso; [`Kinematic`] does not feel it.
    Push {
        /// Its place among the robots.
        robot: usize,
        /// In the field frame, N s.
        impulse: Vector3<f64>,
    },
    /// Puts the ball somewhere, if there is one, and lets it roll.
    MoveBall {
        /// Its centre in the field frame, m.
        position: Point3<f64>,
        /// In the field frame, m/s; [`Kinematic`] lets it lie.
        velocity: Vector3<f64>,
    },
    /// Takes a robot up, turns it upright, and puts it down elsewhere with its joints as they are.
    Kidnap {
        /// Its place among the robots.
        robot: usize,
        /// Of its ground frame in the field frame: x and y in m, heading in rad.
        pose: [f64; 3],
    },
    /// Keeps a robot upright at a place, its lower foot on the floor and its joints as they are; for as long as this comes
    /// again and again.
    Hold {
        /// Its place among the robots.
        robot: usize,
        /// Of its ground frame in the field frame: x and y in m, heading in rad.
        pose: [f64; 3],
    },
}
