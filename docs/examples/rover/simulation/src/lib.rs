//! The hardware of the target `room`: a rover in a room, driven by timers.
//!
//! The framework asks for [`framework::Hardware`] alone; [`Lidar`], [`Encoders`] and [`Motors`] are this robot's own. On a
//! wall clock a read waits for the next sample; in lockstep `next_event` says whose sample is next, and nothing waits.

mod room;
mod rover;
mod timer;

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use framework::{Clock, Event, HardwareContext, Result, Stop, Timestamp};
use rover_nodes::interfaces::{Encoders, Lidar, Motors};
use rover_nodes::types::{Rolled, Scan, Speeds};
use serde::Deserialize;

pub use room::{Post, Room, Walls};
use rover::Rover;
use timer::Timer;

/// Of the lidar.
const SCAN_PERIOD: Duration = Duration::from_millis(100);
/// Rays of a turn.
const RAYS: usize = 120;
/// Of the encoders.
const WHEEL_PERIOD: Duration = Duration::from_millis(20);

/// A rover in a room.
pub struct Hardware {
    clock: Clock,
    stop: Stop,
    world: Mutex<World>,
    scans: Timer,
    wheels: Timer,
}

/// `[hardware.room]` of the parameter files.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    walls: Walls,
    posts: Vec<Post>,
    /// The left wheel rolls so much farther than its encoder says.
    slip: f64,
}

struct World {
    room: Room,
    rover: Rover,
    /// In safe state nobody may command it.
    is_safe: bool,
}

impl Hardware {
    /// Waits for the next sample of a sense and brings the world there.
    fn sample(&self, timer: &Timer) -> Result<(Timestamp, MutexGuard<'_, World>)> {
        let at = timer.read(self.clock.now());
        self.clock.wait_until(at, &self.stop)?;
        let mut world = self.lock();
        let World { room, rover, .. } = &mut *world;
        rover.advance_to(at, room);
        Ok((at, world))
    }

    /// Nothing behind the lock can be half done.
    fn lock(&self) -> MutexGuard<'_, World> {
        self.world.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl framework::Hardware for Hardware {
    fn new(context: HardwareContext) -> Result<Self> {
        let Settings { walls, posts, slip } = context.parameters()?;
        Ok(Self {
            clock: context.clock,
            stop: context.stop,
            world: Mutex::new(World {
                room: Room { walls, posts },
                rover: Rover::new(slip),
                is_safe: false,
            }),
            scans: Timer::new(SCAN_PERIOD),
            wheels: Timer::new(WHEEL_PERIOD),
        })
    }

    fn check_parameters(context: &HardwareContext) -> Result<()> {
        context.parameters::<Settings>().map(drop)
    }

    fn stop(&self) {
        self.stop.request();
    }

    fn enter_safe_state(&self) {
        let mut world = self.lock();
        world.is_safe = true;
        world.rover.command(Speeds::default());
    }

    fn rearm(&self) {
        self.lock().is_safe = false;
    }

    fn is_simulated(&self) -> bool {
        true
    }

    fn next_event(&self) -> Result<Option<Event>> {
        self.stop.check()?;
        let (timer, instance) = if self.scans.next_event() <= self.wheels.next_event() {
            (&self.scans, "Lidar")
        } else {
            (&self.wheels, "Drive")
        };
        let at = timer.tell_event();
        Ok(Some(Event { at, instance }))
    }

    /// `place` (x and y, m), `heading` (rad), `clearance` (m between the rover and what is nearest) and `collisions`.
    fn truth(&self) -> serde_json::Value {
        let world = self.lock();
        let rover = &world.rover;
        serde_json::json!({
            "place": rover.place(),
            "heading": rover.heading(),
            "clearance": rover.clearance(&world.room),
            "collisions": rover.collisions(),
        })
    }

    /// `post = [x, y, radius]`: somebody puts a post there.
    fn disturb(&self, deed: &toml::Table) -> Result<()> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Deed {
            post: Post,
        }
        let deed: Deed = deed.clone().try_into()?;
        self.lock().room.posts.push(deed.post);
        Ok(())
    }
}

impl Lidar for Hardware {
    fn read_scan(&self, scan: &mut Scan) -> Result<Timestamp> {
        let (at, world) = self.sample(&self.scans)?;
        let rays = (0..RAYS).map(|ray| {
            let angle = std::f64::consts::TAU * ray as f64 / RAYS as f64;
            let range = world
                .room
                .range(world.rover.place(), world.rover.heading() + angle);
            range as f32
        });
        scan.ranges.extend(rays);
        Ok(at)
    }
}

impl Encoders for Hardware {
    fn read_wheels(&self) -> Result<(Timestamp, Rolled)> {
        let (at, mut world) = self.sample(&self.wheels)?;
        Ok((at, world.rover.take_rolled()))
    }
}

impl Motors for Hardware {
    fn write_speeds(&self, speeds: Speeds) -> Result<()> {
        let mut world = self.lock();
        if !world.is_safe {
            world.rover.command(speeds);
        }
        Ok(())
    }
}
