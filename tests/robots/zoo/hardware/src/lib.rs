//! The zoo's platform: sources of data with fixed periods, and values that follow from their number alone.
//!
//! Runs on a wall clock as well as in lockstep, where it says whose data is ready next.

mod sources;

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use framework::{Clock, Event, HardwareContext, Result, Stop, Stopped, Timestamp};
use serde::Deserialize;
use zoo_nodes::interfaces::{
    BodyInterface, BumperInterface, EarInterface, EyeInterface, LampInterface, LegInterface,
    MetronomeInterface,
};
use zoo_nodes::types::{Camera, Image};

use sources::{Source, Sources};

/// The platform of one zoo.
pub struct Hardware {
    clock: Clock,
    stop: Stop,
    settings: Settings,
    /// What nodes have read so far.
    read: Mutex<Sources>,
    /// What the world has produced so far; lockstep only.
    world: Mutex<Sources>,
    commands: AtomicU64,
    /// How often the actuators were taken away, and given back.
    safe_states: AtomicU64,
    rearmed: AtomicU64,
}

/// `[hardware.<target>]` of the parameter files.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    sees_spots: bool,
    /// The world ends after so many seconds; never if left out.
    end: Option<f64>,
}

impl Hardware {
    /// How many commands nodes have written.
    pub fn commands(&self) -> u64 {
        self.commands.load(Ordering::Relaxed)
    }

    /// How often the actuators were taken away, and given back.
    pub fn safe_states(&self) -> (u64, u64) {
        let read = |count: &AtomicU64| count.load(Ordering::Relaxed);
        (read(&self.safe_states), read(&self.rearmed))
    }

    /// The newest data of a source that was not read yet: its number and time.
    fn next(&self, source: Source) -> Result<(u64, Timestamp)> {
        let number = sources::locked(&self.read).next_after(source, self.clock.now());
        let at = source.time(number);
        self.clock.wait_until(at, &self.stop)?;
        sources::locked(&self.read).advance(source, number);
        Ok((number, at))
    }

    fn command(&self) {
        self.commands.fetch_add(1, Ordering::Relaxed);
    }
}

impl framework::Hardware for Hardware {
    fn new(context: HardwareContext) -> Result<Self> {
        Ok(Self {
            settings: context.parameters()?,
            clock: context.clock,
            stop: context.stop,
            read: Mutex::default(),
            world: Mutex::default(),
            commands: AtomicU64::new(0),
            safe_states: AtomicU64::new(0),
            rearmed: AtomicU64::new(0),
        })
    }

    fn check_parameters(context: &HardwareContext) -> Result<()> {
        context.parameters::<Settings>().map(drop)
    }

    fn identities(&self) -> Vec<(String, String)> {
        vec![("body".to_owned(), "1".to_owned())]
    }

    fn stop(&self) {
        self.stop.request();
    }

    fn enter_safe_state(&self) {
        self.safe_states.fetch_add(1, Ordering::Relaxed);
    }

    fn rearm(&self) {
        self.rearmed.fetch_add(1, Ordering::Relaxed);
    }

    fn is_simulated(&self) -> bool {
        true
    }

    fn next_event(&self) -> Result<Option<Event>> {
        if self.stop.is_requested() {
            return Err(Stopped.into());
        }
        let mut world = sources::locked(&self.world);
        let (source, number) = world.next();
        let at = source.time(number);
        if self
            .settings
            .end
            .is_some_and(|end| (at - Timestamp::ZERO).as_secs_f64() > end)
        {
            return Ok(None);
        }
        world.advance(source, number);
        Ok(Some(Event {
            at,
            instance: source.instance(),
        }))
    }
}

impl EyeInterface for Hardware {
    fn read_image(&self, camera: Camera, image: &mut Image) -> Result<Timestamp> {
        let source = match camera {
            Camera::Top => Source::TopEye,
            Camera::Bottom => Source::BottomEye,
        };
        let (number, at) = self.next(source)?;
        // Every tenth image is dark.
        let light = if self.settings.sees_spots && number % 10 != 9 {
            255
        } else {
            0
        };
        image.width = 16;
        image.height = 1;
        image.data.extend((0..16).map(|x| {
            if (x + number) % 5 == 0 {
                light
            } else {
                light / 4
            }
        }));
        Ok(at)
    }
}

impl EarInterface for Hardware {
    fn read_sound(&self) -> Result<(Timestamp, f32)> {
        let (number, at) = self.next(Source::Ear)?;
        // Every 25th piece is deafening.
        let loudness = if number % 25 == 24 {
            1.0
        } else {
            (number % 10) as f32 / 10.0
        };
        Ok((at, loudness))
    }
}

impl BodyInterface for Hardware {
    fn read_joints(&self) -> Result<(Timestamp, [f32; 3])> {
        let (number, at) = self.next(Source::Body)?;
        let angle = number as f32 / 100.0;
        Ok((at, [angle.sin(), angle.cos(), angle.sin() / 2.0]))
    }

    fn leg_length(&self) -> f32 {
        0.3
    }
}

impl BumperInterface for Hardware {
    fn read_bumper(&self) -> Result<bool> {
        let (number, _) = self.next(Source::Bumper)?;
        Ok(number % 100 == 99)
    }
}

impl MetronomeInterface for Hardware {
    fn read_beat(&self) -> Result<u64> {
        let (number, _) = self.next(Source::Metronome)?;
        Ok(number)
    }
}

impl LegInterface for Hardware {
    fn write_angles(&self, _angles: &[f32]) -> Result<()> {
        self.command();
        Ok(())
    }
}

impl LampInterface for Hardware {
    fn write_brightness(&self, _brightness: f32) {
        self.command();
    }
}
