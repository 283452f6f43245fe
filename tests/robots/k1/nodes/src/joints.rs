//! The joints of a K1 in the order of its motors (Booster SDK): head, arms, legs.

/// How many there are.
pub const COUNT: usize = 22;

/// Turns the head to the left.
pub const HEAD_YAW: usize = 0;
/// Bends the head down.
pub const HEAD_PITCH: usize = 1;
/// The first of the four joints of the left arm: shoulder pitch, shoulder roll, elbow pitch, elbow yaw.
pub const LEFT_ARM: usize = 2;
/// The first of the four joints of the right arm.
pub const RIGHT_ARM: usize = 6;
/// The first of the six joints of the left leg: hip pitch, hip roll, hip yaw, knee, ankle pitch, ankle roll.
pub const LEFT_LEG: usize = 10;
/// The first of the six joints of the right leg.
pub const RIGHT_LEG: usize = 16;

/// Places within an arm and a leg.
pub const SHOULDER_PITCH: usize = 0;
/// See [`LEFT_LEG`].
pub const KNEE: usize = 3;
/// See [`LEFT_LEG`].
pub const ANKLE_PITCH: usize = 4;

/// A kind of motor.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Part {
    /// Both joints of the head.
    Head,
    /// All joints of the arms.
    Arm,
    /// Hips and knees.
    Leg,
    /// The last two joints of a leg.
    Ankle,
}

/// To what a joint belongs.
pub fn part(joint: usize) -> Part {
    match joint {
        0..LEFT_ARM => Part::Head,
        LEFT_ARM..LEFT_LEG => Part::Arm,
        _ if (joint - LEFT_LEG) % 6 >= ANKLE_PITCH => Part::Ankle,
        _ => Part::Leg,
    }
}
