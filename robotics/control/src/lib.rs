//! The nodes of cycler `Control`: from the body's sensors to its next command, every 12 ms.
//!
//! In the order of a cycle.

pub mod sensor_data_receiver;

pub mod foot_pressure;
pub mod forward_kinematics;
pub mod orientation_filter;

pub mod camera_matrices;

pub mod ball_memory;

pub mod head_scan;
pub mod ready_pose;

pub mod led_status;
pub mod motor_commands_collector;

pub mod command_sender;
