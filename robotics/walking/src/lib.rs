//! Walking: from a wish for steps to the angles of all joints, one cycle after the other.
//!
//! ```text
//! wish --- step::StepLimits ---> step --- stride::Stride ---> soles over time --- inverse kinematics ---> legs
//!                                        ^                                                             |
//!             pressure of the swing foot ends it                          gyroscope: balance::Balance --+
//! ```
//!
//! The walk frame lies on the floor below the body: x forward, y left, z up, in m; yaw in rad. Both feet move in it, the
//! support foot backwards as the body goes on, the swing foot through the air to where it will carry. A stride ends when
//! the swing foot feels the floor; then the feet change roles. Lift and swing are parabolas of time, as in the walk that
//! B. Hengst published with rUNSWift in 2014; the volume of steps is that of the same family of walks. Soles slip when the body
//! turns: course::Course compares its heading with what was asked, and lets the feet turn more.

mod arms;
mod balance;
mod course;
mod engine;
mod parameters;
mod step;
mod stride;

pub use balance::Balance;
pub use course::Course;
pub use engine::{Engine, Senses, standing_pose};
pub use parameters::{
    ArmParameters, BalanceParameters, CourseParameters, Parameters, StrideParameters,
};
pub use step::StepLimits;
pub use stride::{Sole, Stride};
