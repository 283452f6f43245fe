//! Arms that swing against the legs.

use std::f32::consts::FRAC_PI_2;

use types::feet::Feet;
use types::joints::Joints;

use crate::parameters::ArmParameters;
use crate::stride::Sole;

/// Puts the arms beside the body, each in front while the opposite foot is.
pub(crate) fn write(soles: &Feet<Sole>, parameters: &ArmParameters, joints: &mut Joints<f32>) {
    let swing = |opposite: &Sole| FRAC_PI_2 - parameters.swing * opposite.forward;
    joints.left_shoulder_pitch = swing(&soles.right);
    joints.right_shoulder_pitch = swing(&soles.left);
    joints.left_shoulder_roll = parameters.roll;
    joints.right_shoulder_roll = -parameters.roll;
    (joints.left_elbow_yaw, joints.right_elbow_yaw) = (-FRAC_PI_2, FRAC_PI_2);
    (joints.left_elbow_roll, joints.right_elbow_roll) = (0.0, 0.0);
    (joints.left_wrist_yaw, joints.right_wrist_yaw) = (0.0, 0.0);
}
