//! A simulated K1: 22 motors with inertia and limited torque, on a trunk that stands on its lower foot and does not fall.
//!
//! Torque limits and lengths are those of Booster's model of the K1. What a motor turns counts as one inertia per kind of joint: enough to
//! see whether gains and commands fit the motors, and nothing about balance.

use std::sync::{Mutex, MutexGuard, PoisonError};

use framework::{Clock, Event, HardwareContext, NoEvent, Result, Stop, Timestamp};
use k1_nodes::interfaces::{BodyInterface, MotorInterface};
use k1_nodes::joints::{ANKLE_PITCH, COUNT, KNEE, LEFT_LEG, Part, RIGHT_LEG, part};
use k1_nodes::types::{Body, MotorCommands};

/// From one sample to the next: 500 a second.
const PERIOD: u64 = 2_000_000;
/// So many steps of the physics between two samples.
const STEPS: u32 = 4;
/// Greatest torques of hip pitch, roll, yaw, knee, ankle pitch and roll, Nm.
const LEG_TORQUES: [f32; 6] = [30.0, 35.0, 20.0, 40.0, 20.0, 20.0];
const ARM_TORQUE: f32 = 14.0;
const HEAD_TORQUE: f32 = 6.0;
/// Hip to knee and knee to ankle, m.
const THIGH: f32 = 0.191_5;
const SHIN: f32 = 0.245_2;

/// A K1 in a world without anything else.
pub struct Hardware {
    clock: Clock,
    stop: Stop,
    world: Mutex<World>,
}

/// What is really the case.
#[derive(Clone, Copy, Debug, Default)]
pub struct Truth {
    /// As the motors are.
    pub body: Body,
    /// Height of the hips over the lower sole's ankle, m.
    pub hip_height: f32,
    /// Pitch of both soles against the floor while the trunk is upright, rad.
    pub sole_pitches: [f32; 2],
    /// How often a command wanted a position that is no number.
    pub harmful: u32,
}

#[derive(Default)]
struct World {
    samples: u64,
    is_unread: bool,
    is_safe: bool,
    commands: MotorCommands,
    body: Body,
    harmful: u32,
}

impl Hardware {
    /// What is really the case.
    pub fn truth(&self) -> Truth {
        let world = self.lock();
        let pitches = |leg: usize| {
            let hip = world.body.positions[leg];
            let knee = hip + world.body.positions[leg + KNEE];
            [hip, knee, knee + world.body.positions[leg + ANKLE_PITCH]]
        };
        let legs = [LEFT_LEG, RIGHT_LEG].map(pitches);
        let heights = legs.map(|[hip, knee, _]| THIGH * hip.cos() + SHIN * knee.cos());
        Truth {
            body: world.body,
            hip_height: heights[0].max(heights[1]),
            sole_pitches: legs.map(|[_, _, sole]| sole),
            harmful: world.harmful,
        }
    }

    fn lock(&self) -> MutexGuard<'_, World> {
        // A step that panicked left a body before or after it; both are bodies.
        self.world.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl framework::Hardware for Hardware {
    fn new(context: HardwareContext) -> Result<Self> {
        Ok(Self {
            clock: context.clock,
            stop: context.stop,
            world: Mutex::default(),
        })
    }

    fn stop(&self) {
        self.stop.request();
    }

    fn enter_safe_state(&self) {
        self.lock().is_safe = true;
    }

    fn rearm(&self) {
        self.lock().is_safe = false;
    }

    fn is_simulated(&self) -> bool {
        true
    }

    fn next_event(&self) -> Result<Option<Event>> {
        self.stop.check()?;
        let mut world = self.lock();
        world.sample();
        Ok(Some(Event {
            at: world.now(),
            instance: "Control",
        }))
    }
}

impl BodyInterface for Hardware {
    fn read_body(&self) -> Result<(Timestamp, Body)> {
        self.stop.check()?;
        if !self.clock.is_stepped() {
            let next = Timestamp::from_nanos((self.lock().samples + 1) * PERIOD);
            self.clock.wait_until(next, &self.stop)?;
            self.lock().sample();
        }
        let mut world = self.lock();
        if !std::mem::take(&mut world.is_unread) {
            return Err(
                NoEvent("the motors have said nothing since the last sample".to_owned()).into(),
            );
        }
        Ok((world.now(), world.body))
    }
}

impl MotorInterface for Hardware {
    fn write_motors(&self, commands: &MotorCommands) -> Result<()> {
        let mut world = self.lock();
        if commands.positions.iter().all(|angle| angle.is_finite()) {
            world.commands = *commands;
        } else {
            world.harmful += 1;
        }
        Ok(())
    }
}

impl World {
    fn now(&self) -> Timestamp {
        Timestamp::from_nanos(self.samples * PERIOD)
    }

    fn sample(&mut self) {
        for _ in 0..STEPS {
            for joint in 0..COUNT {
                self.turn(joint, PERIOD as f32 / 1e9 / STEPS as f32);
            }
        }
        self.samples += 1;
        self.is_unread = true;
    }

    /// Semi-implicit Euler for one joint.
    fn turn(&mut self, joint: usize, seconds: f32) {
        let body = &mut self.body;
        let away = self.commands.positions[joint] - body.positions[joint];
        let wanted = if self.is_safe {
            // Released: only friction is left.
            -body.velocities[joint]
        } else {
            self.commands.stiffnesses[joint] * away
                - self.commands.dampings[joint] * body.velocities[joint]
        };
        let (inertia, most) = motor(joint);
        let torque = wanted.clamp(-most, most);
        body.torques[joint] = torque;
        body.velocities[joint] += torque / inertia * seconds;
        body.positions[joint] += body.velocities[joint] * seconds;
    }
}

/// What a motor turns, kg m², and its greatest torque, Nm.
fn motor(joint: usize) -> (f32, f32) {
    match part(joint) {
        Part::Head => (0.01, HEAD_TORQUE),
        Part::Arm => (0.02, ARM_TORQUE),
        Part::Leg => (0.3, LEG_TORQUES[(joint - LEFT_LEG) % 6]),
        Part::Ankle => (0.02, LEG_TORQUES[(joint - LEFT_LEG) % 6]),
    }
}
