//! The inertial measurement unit: what it has felt since it was read.

use nalgebra::Vector3;

use crate::physics::Body;

/// Means over the steps since the last reading, as the board's own filter makes them.
#[derive(Debug, Default)]
pub(super) struct InertialUnit {
    angular_velocity: Vector3<f64>,
    proper_acceleration: Vector3<f64>,
    count: u32,
}

/// One reading, in the torso frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Inertial {
    /// rad/s.
    pub(super) angular_velocity: Vector3<f64>,
    /// m/s², +9.81 upwards at rest.
    pub(super) proper_acceleration: Vector3<f64>,
}

impl InertialUnit {
    /// Feels one step.
    pub(super) fn measure(&mut self, body: &Body) {
        self.angular_velocity += body.angular_velocity;
        self.proper_acceleration += body.proper_acceleration;
        self.count += 1;
    }

    /// What was felt since the last reading; without any step what the body feels.
    pub(super) fn take(&mut self, body: &Body) -> Inertial {
        if self.count == 0 {
            return Inertial {
                angular_velocity: body.angular_velocity,
                proper_acceleration: body.proper_acceleration,
            };
        }
        let count = f64::from(self.count);
        let felt = std::mem::take(self);
        Inertial {
            angular_velocity: felt.angular_velocity / count,
            proper_acceleration: felt.proper_acceleration / count,
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;
    use types::joints::Joints;

    use super::*;

    #[test]
    fn a_reading_is_the_mean_since_the_one_before() {
        let mut unit = InertialUnit::default();
        let mut body = Body::new(Joints::default(), Isometry3::identity());
        for turn in [1.0, 3.0] {
            body.angular_velocity.z = turn;
            unit.measure(&body);
        }
        assert_eq!(unit.take(&body).angular_velocity.z, 2.0);
        assert_eq!(unit.take(&body).angular_velocity.z, 3.0, "no step since");
    }
}
