//! Nodes of cycler `Drive`: from where there is room to the speeds of the wheels.

pub mod motor_sender;
pub mod odometry;
pub mod steering;
pub mod wheel_receiver;
