//! The motors of the joints: position servos whose torque has an end.

use kinematics::{limits, motors};
use types::joints::JointName;

/// What is left of the motor's torque behind the gear; not published, 0.6 to 0.8 is usual for such gears.
const GEAR_EFFICIENCY: f64 = 0.7;
/// Moments of inertia of the rotors, kg m²: an estimate of 4 g cm² for the motors of the legs (a RE-Max
/// 24 has as much), a fifth for the smaller ones of head and arms.
const LEG_ROTOR: f64 = 4e-7;
const UPPER_ROTOR: f64 = 0.8e-7;

/// How one joint is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Servo {
    /// N m for every rad that it is away from its target.
    pub(crate) proportional: f64,
    /// N m for every rad/s.
    pub(crate) derivative: f64,
    /// The most torque at rest and at full stiffness, N m.
    pub(crate) torque: f64,
    /// The joint's speed at which the motor has no torque left, rad/s.
    pub(crate) no_load_speed: f64,
    /// What the rotor adds to the inertia of the joint through its gear, kg m².
    pub(crate) armature: f64,
    /// Dry friction of the gear, N m.
    pub(crate) friction: f64,
}

impl Servo {
    /// How a joint is driven. Gains, rotors and friction are estimates: the manufacturer has not
    /// published them. Other simulators of the NAO have gains from 20 to 80 N m/rad; with the friction of
    /// the legs a limp robot keeps sitting, as a real one does, and does not keep standing.
    pub(crate) const fn of(joint: JointName) -> Self {
        let (proportional, derivative, rotor, friction) = if joint.is_of_leg() {
            (100.0, 2.0, LEG_ROTOR, 0.5)
        } else {
            match joint {
                JointName::LeftWristYaw | JointName::RightWristYaw => (5.0, 0.1, UPPER_ROTOR, 0.02),
                _ => (20.0, 0.5, UPPER_ROTOR, 0.1),
            }
        };
        let motor = motors::of(joint);
        Self {
            proportional,
            derivative,
            torque: motor.stall_torque * GEAR_EFFICIENCY,
            no_load_speed: limits::of(joint).velocity,
            armature: rotor * motor.gear_ratio * motor.gear_ratio,
            friction,
        }
    }

    /// The most torque in N m with this share of the current while the joint turns at `speed` (rad/s) and
    /// its target is `error` (rad) ahead. A motor that is turned against its will brakes with all it has.
    pub(crate) fn limit(&self, stiffness: f64, speed: f64, error: f64) -> f64 {
        let helps = speed * error > 0.0;
        let left = if helps {
            (1.0 - speed.abs() / self.no_load_speed).max(0.0)
        } else {
            1.0
        };
        stiffness.clamp(0.0, 1.0) * self.torque * left
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motor_has_torque_at_rest_and_none_at_its_greatest_speed() {
        let knee = Servo::of(JointName::LeftKneePitch);
        assert!((knee.limit(1.0, 0.0, 1.0) - 5.953_675).abs() < 1e-9);
        assert_eq!(knee.limit(0.5, 0.0, 1.0), knee.torque / 2.0);
        assert_eq!(knee.limit(1.0, 7.0, 1.0), 0.0);
        assert_eq!(knee.limit(1.0, 7.0, -1.0), knee.torque);
        assert_eq!(knee.limit(0.0, 0.0, 1.0), 0.0);
    }

    #[test]
    fn legs_are_driven_as_legs() {
        let legs = JointName::ALL.into_iter().filter(|joint| joint.is_of_leg());
        assert_eq!(legs.count(), 11);
        // The rotor of the hip: 4 g cm² through a gear of 201.3.
        let hip = Servo::of(JointName::LeftHipRoll);
        assert!((hip.armature - 0.0162).abs() < 1e-4);
    }
}
