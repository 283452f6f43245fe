//! Owns where the inertial measurement unit sits and how the world pulls at it.

/// The gyroscope in the torso frame, in m (NAO V6 URDF).
pub const GYROSCOPE: [f64; 3] = [-0.008, 0.006, 0.029];

/// The accelerometer in the torso frame, in m (NAO V6 URDF).
pub const ACCELEROMETER: [f64; 3] = [-0.008, 0.00606, 0.027];

/// Standard gravity in m/s² (CGPM 1901).
pub const GRAVITY: f64 = 9.80665;
