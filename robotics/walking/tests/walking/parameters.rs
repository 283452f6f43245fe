//! The numbers that the walk is tested with, in its own tests and on the simulator's physics.

use walking::{ArmParameters, BalanceParameters, Limits, Parameters, StrideParameters};

/// As teams of the league published theirs.
pub(crate) fn parameters() -> Parameters {
    Parameters {
        limits: Limits {
            forward: 0.065,
            backward: 0.04,
            sideways: 0.08,
            turn: 0.6,
            acceleration: 0.01,
            turn_acceleration: 0.2,
        },
        stride: StrideParameters {
            duration: 0.25,
            duration_per_meter: 0.1,
            apex: 0.012,
            apex_per_meter: 0.1,
            earliest_contact: 0.15,
            contact_threshold: 0.3,
            timeout: 0.6,
        },
        balance: BalanceParameters {
            pitch_gain: 0.05,
            roll_gain: 0.0,
            newest: 0.4,
            greatest_speed: 4.0,
        },
        arms: ArmParameters {
            roll: 0.13,
            swing: 6.0,
            stiffness: 0.5,
        },
        hip_height: 0.22,
        torso_offset: 0.0,
        torso_tilt: 0.05,
        foot_offset: 0.05,
        leg_stiffness: 1.0,
    }
}
