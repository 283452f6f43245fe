//! What the nodes of the NAO exchange: plain data, no behaviour beyond geometry.
//!
//! SI units and radians everywhere. Frames follow REP-103: x forward, y left, z up, right-handed;
//! only optical frames differ (z forward, x right, y down). In reading order: the body
//! ([`joints`], [`feet`], [`sensor_data`], [`robot_kinematics`]), its commands
//! ([`motor_commands`], [`head`], [`leds`]), the cameras ([`image`], [`camera`]), the world
//! ([`ball`]).

pub mod joints;

pub mod feet;
pub mod identifier;
pub mod robot_kinematics;
pub mod sensor_data;

pub mod head;
pub mod leds;
pub mod motor_commands;

pub mod camera;
pub mod image;

pub mod ball;
