//! What the nodes of the NAO exchange: plain data, no behaviour beyond geometry.
//!
//! SI units and radians everywhere. Frames follow REP-103: x forward, y left, z up, right-handed;
//! only optical frames differ (z forward, x right, y down). In reading order: the body
//! ([`joints`], [`feet`], [`sensor_data`], [`buttons`], [`sonar`], [`robot_kinematics`],
//! [`fall_state`], [`odometry`]), its commands ([`motion`], [`motor_commands`], [`head`], [`leds`]),
//! the cameras ([`image`], [`camera`], [`limbs`], [`projection_noise`],
//! [`field_features`], [`field_markings`]), sound ([`audio`]), the network
//! ([`network`], [`game`], [`team`]), the world ([`ball`], [`obstacles`], [`world_state`]),
//! and what to do in it ([`behavior`]).

pub mod joints;

pub mod buttons;
pub mod fall_state;
pub mod feet;
pub mod identifier;
pub mod odometry;
pub mod robot_kinematics;
pub mod sensor_data;
pub mod sonar;

pub mod head;
pub mod leds;
pub mod motion;
pub mod motor_commands;

pub mod camera;
pub mod field_features;
pub mod field_markings;
pub mod image;
pub mod limbs;
pub mod projection_noise;

pub mod audio;

pub mod game;
pub mod network;
pub mod team;

pub mod ball;
pub mod behavior;
pub mod obstacles;
pub mod world_state;
