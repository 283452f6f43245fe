//! Owns the geometry of the soles: their outline and where they feel pressure.

use nalgebra::{Point3, RealField, convert};
use types::feet::{Feet, Side};

/// From the axis of the ankle down to the sole, in m (NAO V6 URDF).
pub const SOLE_BELOW_ANKLE: f64 = 0.04519;

/// Where the force-sensitive resistors are in the frame of each foot (after `AnkleRoll`), in m: front
/// left, front right, rear left, rear right; all at the height of the sole (NAO V6 URDF).
pub const FORCE_SENSITIVE_RESISTORS: Feet<[[f64; 2]; 4]> = Feet {
    left: [
        [0.07025, 0.0299],
        [0.07025, -0.0231],
        [-0.03025, 0.0299],
        [-0.02965, -0.0191],
    ],
    right: [
        [0.07025, 0.0231],
        [0.07025, -0.0299],
        [-0.03025, 0.0191],
        [-0.02965, -0.0299],
    ],
};

/// Convex outline of the left sole in the frame of the left foot, counter-clockwise, in m (measured on
/// the manufacturer's mesh of the V6); the right sole has y negated.
pub const LEFT_SOLE: [[f64; 2]; 14] = [
    [-0.0507, -0.0214],
    [-0.0426, -0.0306],
    [-0.033, -0.0343],
    [0.0577, -0.0388],
    [0.074, -0.0373],
    [0.0918, -0.0277],
    [0.0969, -0.0188],
    [0.1001, -0.0016],
    [0.094, 0.0242],
    [0.0845, 0.0361],
    [0.0657, 0.0461],
    [0.0499, 0.0482],
    [-0.0312, 0.0517],
    [-0.0491, 0.0376],
];

/// The outline of a sole in its own frame (below the ankle, on the ground), in m.
pub fn sole_outline<T: RealField + Copy>(side: Side) -> [Point3<T>; LEFT_SOLE.len()] {
    let outward = match side {
        Side::Left => 1.0,
        Side::Right => -1.0,
    };
    LEFT_SOLE.map(|[x, y]| Point3::new(convert(x), convert(outward * y), T::zero()))
}
