//! The world as its robots share it: how far it may go, and what they say to each other.
//!
//! With one robot the events of that robot let the world go on. With several somebody lets it go on from beat to beat, once
//! all of them have come as far: what a robot does takes effect after the beat at which it was done, so that it does
//! not matter who of them is first.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use framework::{Error, Result, Timestamp};

use crate::scene::Team;
use crate::settings::Settings;
use crate::simulation::next_beat;
use crate::world::World;

/// From a robot's broadcast to its arrival at the others: within a Wi-Fi of its own a few milliseconds (an estimate).
const AIR_LATENCY: Duration = Duration::from_millis(5);

/// The world behind a lock.
pub(crate) struct Stage(Mutex<Scene>);

/// The world, and what is said in it.
pub(crate) struct Scene {
    pub(crate) world: World,
    /// How far the world has gone, where robots wait for each other.
    horizon: Option<Timestamp>,
    /// Since the last beat, in the order in which threads came.
    spoken: Vec<Broadcast>,
    /// Before, in an order that does not depend on threads.
    aired: Vec<Broadcast>,
}

/// What one robot has told its team.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Broadcast {
    pub(crate) at: Timestamp,
    /// Its place in the world.
    pub(crate) robot: usize,
    pub(crate) team: u8,
    pub(crate) side: Team,
    pub(crate) bytes: Vec<u8>,
}

impl Stage {
    pub(crate) fn new(settings: &Settings) -> Self {
        Self(Mutex::new(Scene {
            world: World::new(settings),
            horizon: None,
            spoken: Vec::new(),
            aired: Vec::new(),
        }))
    }

    pub(crate) fn lock(&self) -> MutexGuard<'_, Scene> {
        // A step that panicked left the world before or after it; both are worlds.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Scene {
    /// Takes one more robot in; its place.
    ///
    /// # Errors
    /// Where time has begun, or the field is full.
    pub(crate) fn join(&mut self, settings: &Settings) -> Result<usize> {
        if self.world.now() > Timestamp::ZERO {
            return Err(Error::new("nobody can join a world whose time has begun"));
        }
        self.horizon = Some(Timestamp::ZERO);
        self.world.join(settings)
    }

    /// Whether the world may be looked at as it is then.
    pub(crate) fn has_come_to(&self, time: Timestamp) -> bool {
        self.horizon.is_none_or(|horizon| time <= horizon)
    }

    /// Lets the world go on to its next beat.
    ///
    /// # Errors
    /// Where its one robot does that.
    pub(crate) fn advance(&mut self) -> Result<Timestamp> {
        let horizon = self.horizon.ok_or_else(|| {
            Error::new("the events of its one robot let the simulated NAO's world go on")
        })?;
        let next = next_beat(horizon);
        self.world.advance_to(next);
        self.horizon = Some(next);
        self.spoken
            .sort_by_key(|broadcast| (broadcast.at, broadcast.robot));
        for mut broadcast in self.spoken.drain(..) {
            // Nobody can hear it before the world has come there.
            broadcast.at = (broadcast.at + AIR_LATENCY).max(horizon);
            self.world.count_message(broadcast.side);
            self.aired.push(broadcast);
        }
        Ok(next)
    }

    /// A robot tells its team something; with several the referee's computer counts it after the beat.
    pub(crate) fn speak(&mut self, broadcast: Broadcast) {
        match self.horizon {
            Some(_) => self.spoken.push(broadcast),
            None => self.world.count_message(broadcast.side),
        }
    }

    /// What was said after the first `heard` broadcasts, and when it arrives.
    pub(crate) fn aired(&self, heard: usize) -> &[Broadcast] {
        &self.aired[heard.min(self.aired.len())..]
    }
}
