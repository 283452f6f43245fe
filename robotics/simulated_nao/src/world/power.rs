//! What runs the robot down: the battery's charge, and the heat of the motors.

use std::time::Duration;

use types::joints::Joints;
use types::motor_commands::MotorCommands;
use types::sensor_data::Battery;

/// Charge of a full battery of the V6, A·s: 2.9 A·h (published tear-down).
const CAPACITY: f64 = 2.9 * 3600.0;
/// What the head and the boards need, A.
const IDLE_CURRENT: f32 = 0.8;
/// What all motors need at full stiffness, A: with the above a battery lasts 75 min, as published.
const STIFF_CURRENT: f32 = 1.5;
/// What one motor needs to hold its angle at full stiffness, A.
const HOLDING_CURRENT: f32 = 0.05;
/// What it needs for every rad that it is away from its target, A (an estimate).
const CURRENT_PER_RADIAN: f32 = 2.0;
/// The most that one motor gets, A (an estimate).
const GREATEST_CURRENT: f32 = 2.0;
/// Temperature of limp motors, °C.
const LEAST_TEMPERATURE: f32 = 38.0;
/// How much warmer a stiff motor becomes in the end, °C (an estimate).
const HEATING: f32 = 45.0;
/// How fast, s (an estimate).
const HEATING_TIME: f32 = 900.0;
/// From these temperatures on motors are hot, very hot, critical, °C.
const STATUS_TEMPERATURES: [f32; 3] = [70.0, 75.0, 80.0];

/// The state of battery and motors.
pub(super) struct Power {
    charge: f64,
    temperatures: Joints<f32>,
}

impl Power {
    /// A battery that was full a while ago, and cool motors.
    pub(super) fn new() -> Self {
        Self {
            charge: 0.99,
            temperatures: Joints::filled(LEAST_TEMPERATURE),
        }
    }

    /// Lets time pass with these stiffnesses.
    pub(super) fn advance(&mut self, duration: Duration, stiffnesses: &Joints<f32>) {
        let used = f64::from(total_current(stiffnesses)) * duration.as_secs_f64();
        self.charge = (self.charge - used / CAPACITY).max(0.0);
        let part = (duration.as_secs_f32() / HEATING_TIME).min(1.0);
        for (joint, temperature) in self.temperatures.iter_mut() {
            let target = LEAST_TEMPERATURE + HEATING * stiffnesses[joint].clamp(0.0, 1.0);
            *temperature += (target - *temperature) * part;
        }
    }

    /// What the battery's controller reports.
    pub(super) fn battery(&self, stiffnesses: &Joints<f32>) -> Battery {
        Battery {
            charge: self.charge as f32,
            // As the published recording of a V6 has it.
            status: -32_552.0,
            current: -total_current(stiffnesses),
            temperature: 36.0,
        }
    }

    pub(super) fn temperatures(&self) -> Joints<f32> {
        self.temperatures
    }

    /// Heat as LoLA's status.
    pub(super) fn status(&self) -> Joints<u8> {
        self.temperatures.map(|temperature| {
            STATUS_TEMPERATURES
                .iter()
                .filter(|limit| temperature >= **limit)
                .count() as u8
        })
    }
}

/// What each motor takes at these angles: limp ones nothing.
pub(super) fn currents(joints: &Joints<f64>, commands: &MotorCommands) -> Joints<f32> {
    Joints::from_fn(|joint| {
        let error = (commands.positions[joint] - joints[joint] as f32).abs();
        let current = HOLDING_CURRENT + CURRENT_PER_RADIAN * error;
        (commands.stiffnesses[joint].clamp(0.0, 1.0) * current).min(GREATEST_CURRENT)
    })
}

fn total_current(stiffnesses: &Joints<f32>) -> f32 {
    let sum: f32 = stiffnesses
        .iter()
        .map(|(_, stiffness)| stiffness.clamp(0.0, 1.0))
        .sum();
    IDLE_CURRENT + STIFF_CURRENT * sum / types::joints::JOINT_COUNT as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOUR: Duration = Duration::from_secs(3600);

    #[test]
    fn a_stiff_robot_empties_its_battery_in_75_minutes_and_never_below_nothing() {
        let stiff = Joints::filled(1.0);
        let mut power = Power::new();
        power.advance(HOUR, &stiff);
        let battery = power.battery(&stiff);
        assert!((battery.charge - 0.197).abs() < 0.01, "{}", battery.charge);
        assert!((battery.current + 2.3).abs() < 1e-5);
        power.advance(HOUR, &stiff);
        assert_eq!(power.battery(&stiff).charge, 0.0);
        let limp = Joints::filled(0.0);
        assert!(power.battery(&limp).current > battery.current);
    }

    #[test]
    fn stiff_motors_become_hot_and_say_so() {
        let mut stiffnesses = Joints::filled(0.0);
        stiffnesses.left_knee_pitch = 1.0;
        let mut power = Power::new();
        for _ in 0..3600 {
            power.advance(Duration::from_secs(1), &stiffnesses);
        }
        assert!(power.temperatures().left_knee_pitch > 80.0);
        assert_eq!(power.status().left_knee_pitch, 3);
        assert_eq!(power.temperatures().right_knee_pitch, LEAST_TEMPERATURE);
        assert_eq!(power.status().right_knee_pitch, 0);
    }

    #[test]
    fn a_motor_far_from_its_target_takes_more_current_and_a_limp_one_none() {
        let joints = Joints::filled(0.0);
        let command = |angle, stiffness| MotorCommands {
            positions: Joints::filled(angle),
            stiffnesses: Joints::filled(stiffness),
        };
        let current = |commands| currents(&joints, &commands).head_yaw;
        assert!(current(command(0.5, 1.0)) > current(command(0.1, 1.0)));
        assert_eq!(current(command(0.5, 0.0)), 0.0);
        assert_eq!(current(command(5.0, 1.0)), GREATEST_CURRENT);
    }
}
