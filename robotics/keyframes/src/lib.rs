//! Motions as data: poses and how long the way to each takes, in the parameter files.
//!
//! ```toml
//! [[motions.kick_left.frames]]
//! duration = 0.4            # s
//! stiffness = 1.0           # of full torque
//! head = [0.0, 0.0]         # rad: yaw, pitch
//! left_arm = [1.57, 0.2, -1.57, -0.04, 0.0]   # rad: shoulder pitch and roll, elbow yaw and roll, wrist yaw
//! right_arm = [1.57, -0.2, 1.57, 0.04, 0.0]
//! hip_yaw_pitch = 0.0       # rad
//! left_leg = [0.0, -0.3, 0.93, -0.6, 0.0]     # rad: hip roll and pitch, knee pitch, ankle pitch and roll
//! right_leg = [0.0, -0.3, 0.93, -0.6, 0.0]
//! ```
//!
//! A limb may be a table of its joints as well. What no joint can do is an error of `hulkgen check`.
//!
//! Invariant: a [`Motion`] that was read moves no joint out of its limits or, from frame to frame, faster than it can: anything
//! else is an error where the robot starts, in `check --cargo`, and in a live change.

mod limbs;
mod motion;
mod motions;

pub use limbs::{Head, LeftArm, LeftLeg, RightArm, RightLeg};
pub use motion::{Keyframe, Motion};
pub use motions::Motions;
