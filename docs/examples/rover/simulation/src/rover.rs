//! What moves: two wheels that change their speed slowly, and a round body on them.

use framework::Timestamp;
use rover_nodes::types::{Rolled, Speeds};

use crate::room::Room;

/// From wheel to wheel, m.
const TRACK: f64 = 0.3;
/// Of the body, m.
const RADIUS: f64 = 0.15;
/// That the wheels can do, m/s².
const ACCELERATION: f64 = 1.5;
/// Of the physics, ns.
const STEP: u64 = 2_000_000;

/// Where it is, how it moves, and what it is told.
pub(crate) struct Rover {
    /// Steps of the physics since the start.
    steps: u64,
    place: [f64; 2],
    heading: f64,
    /// Left and right, m/s.
    wheels: [f64; 2],
    commanded: [f64; 2],
    /// What the encoders counted and nobody read, m.
    rolled: [f64; 2],
    slip: f64,
    touches: bool,
    collisions: u32,
}

impl Rover {
    pub(crate) fn new(slip: f64) -> Self {
        Self {
            steps: 0,
            place: [0.0; 2],
            heading: 0.0,
            wheels: [0.0; 2],
            commanded: [0.0; 2],
            rolled: [0.0; 2],
            slip,
            touches: false,
            collisions: 0,
        }
    }

    pub(crate) fn place(&self) -> [f64; 2] {
        self.place
    }

    pub(crate) fn heading(&self) -> f64 {
        self.heading
    }

    /// How often it ran into something.
    pub(crate) fn collisions(&self) -> u32 {
        self.collisions
    }

    /// Metres between the body and what is nearest.
    pub(crate) fn clearance(&self, room: &Room) -> f64 {
        room.nearest(self.place) - RADIUS
    }

    /// What is no number is no command.
    pub(crate) fn command(&mut self, Speeds { forward, turn }: Speeds) {
        if forward.is_finite() && turn.is_finite() {
            let (forward, aside) = (f64::from(forward), f64::from(turn) * TRACK / 2.0);
            self.commanded = [forward - aside, forward + aside];
        }
    }

    pub(crate) fn take_rolled(&mut self) -> Rolled {
        let [left, right] = std::mem::take(&mut self.rolled).map(|rolled| rolled as f32);
        Rolled { left, right }
    }

    /// Lets time pass; a time that has passed changes nothing.
    pub(crate) fn advance_to(&mut self, at: Timestamp, room: &Room) {
        while (self.steps + 1) * STEP <= at.as_nanos() {
            self.steps += 1;
            self.step(STEP as f64 / 1e9, room);
        }
    }

    fn step(&mut self, seconds: f64, room: &Room) {
        let most = ACCELERATION * seconds;
        for wheel in 0..2 {
            self.wheels[wheel] += (self.commanded[wheel] - self.wheels[wheel]).clamp(-most, most);
            self.rolled[wheel] += self.wheels[wheel] * seconds;
        }
        let [left, right] = self.wheels;
        let left = left * (1.0 + self.slip);
        let (forward, turn) = ((left + right) / 2.0, (right - left) / TRACK);
        self.heading += turn * seconds;
        let (sine, cosine) = self.heading.sin_cos();
        let next = [
            self.place[0] + forward * cosine * seconds,
            self.place[1] + forward * sine * seconds,
        ];
        // Wheels slip on the floor where the body cannot go on; away from it, it can.
        let (is, was) = (room.nearest(next), room.nearest(self.place));
        let touches = is < RADIUS && is < was;
        if touches && !self.touches {
            self.collisions += 1;
        }
        self.touches = touches;
        if !touches {
            self.place = next;
        }
    }
}
