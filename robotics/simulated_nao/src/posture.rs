//! Joint angles of poses that everybody knows.

use types::joints::Joints;

/// Sitting on the heels, where a robot waits with limp joints (sitting pose of B-Human's robots).
pub fn sitting() -> Joints<f64> {
    symmetric(&[41.0, 9.0, 5.0, -3.0, -90.0], &[-50.0, 121.0, -67.8])
}

/// Upright with slightly bent knees: the pose of published test vectors.
pub fn standing() -> Joints<f64> {
    symmetric(&[90.0, 11.5, -90.0, -2.0, 0.0], &[-17.2, 53.3, -34.4])
}

/// From angles of the left side in degrees: shoulder pitch and roll, elbow yaw and roll, wrist yaw;
/// hip, knee and ankle pitch.
fn symmetric(arm: &[f64; 5], leg: &[f64; 3]) -> Joints<f64> {
    let [
        shoulder_pitch,
        shoulder_roll,
        elbow_yaw,
        elbow_roll,
        wrist_yaw,
    ] = arm.map(f64::to_radians);
    let [hip, knee, ankle] = leg.map(f64::to_radians);
    Joints {
        left_shoulder_pitch: shoulder_pitch,
        left_shoulder_roll: shoulder_roll,
        left_elbow_yaw: elbow_yaw,
        left_elbow_roll: elbow_roll,
        left_wrist_yaw: wrist_yaw,
        left_hip_pitch: hip,
        left_knee_pitch: knee,
        left_ankle_pitch: ankle,
        right_hip_pitch: hip,
        right_knee_pitch: knee,
        right_ankle_pitch: ankle,
        right_shoulder_pitch: shoulder_pitch,
        right_shoulder_roll: -shoulder_roll,
        right_elbow_yaw: -elbow_yaw,
        right_elbow_roll: -elbow_roll,
        right_wrist_yaw: -wrist_yaw,
        ..Joints::default()
    }
}
