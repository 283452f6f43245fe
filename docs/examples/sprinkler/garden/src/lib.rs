//! The hardware of the target `bed`: soil that dries, and rain now and then; a minute of it lasts a second.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use framework::{Clock, Event, HardwareContext, Result, Stop, Timestamp};
use sprinkler_nodes::{RainGauge, SoilProbe, Valve};

/// Of both sensors.
const PERIOD: Duration = Duration::from_millis(100);
/// Of the moisture each second: what dries, what the open valve gives, and what each mm/h of rain gives.
const DRIES: f32 = 0.02;
const WATERS: f32 = 0.08;
const RAINS: f32 = 0.005;

/// A bed.
pub struct Hardware {
    clock: Clock,
    stop: Stop,
    bed: Mutex<Bed>,
}

struct Bed {
    at: Timestamp,
    moisture: f32,
    is_open: bool,
    /// In safe state the valve is closed.
    is_safe: bool,
    /// When the next rain and moisture are read, and how many of both lockstep was told about.
    rain: Timestamp,
    soil: Timestamp,
    told: u32,
}

impl Hardware {
    /// Waits for the sample at `next`, and brings the world there.
    fn sample(
        &self,
        next: fn(&mut Bed) -> &mut Timestamp,
    ) -> Result<(Timestamp, MutexGuard<'_, Bed>)> {
        let at = *next(&mut self.lock());
        self.clock.wait_until(at, &self.stop)?;
        let mut bed = self.lock();
        // What nobody read in time is gone.
        let at = at.max(self.clock.now());
        *next(&mut bed) = at + PERIOD;
        bed.advance_to(at);
        Ok((at, bed))
    }

    /// Nothing behind the lock can be half done.
    fn lock(&self) -> MutexGuard<'_, Bed> {
        self.bed.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Bed {
    /// mm/h: a shower in the third of three quarters of a minute.
    fn rain(at: Timestamp) -> f32 {
        let seconds = (at - Timestamp::ZERO).as_secs() % 45;
        if seconds >= 30 { 6.0 } else { 0.0 }
    }

    /// A time that has passed changes nothing.
    fn advance_to(&mut self, at: Timestamp) {
        let seconds = (at - self.at).as_secs_f32();
        self.at = self.at.max(at);
        let water = if self.is_open { WATERS } else { 0.0 } + RAINS * Self::rain(at);
        self.moisture = (self.moisture + (water - DRIES) * seconds).clamp(0.0, 1.0);
    }
}

impl framework::Hardware for Hardware {
    fn new(context: HardwareContext) -> Result<Self> {
        let first = Timestamp::ZERO + PERIOD;
        Ok(Self {
            clock: context.clock,
            stop: context.stop,
            bed: Mutex::new(Bed {
                at: Timestamp::ZERO,
                moisture: 0.3,
                is_open: false,
                is_safe: false,
                rain: first,
                soil: first,
                told: 0,
            }),
        })
    }

    fn stop(&self) {
        self.stop.request();
    }

    fn enter_safe_state(&self) {
        let mut bed = self.lock();
        bed.is_safe = true;
        bed.is_open = false;
    }

    fn rearm(&self) {
        self.lock().is_safe = false;
    }

    fn is_simulated(&self) -> bool {
        true
    }

    fn next_event(&self) -> Result<Option<Event>> {
        self.stop.check()?;
        let mut bed = self.lock();
        let (turn, is_soil) = (bed.told / 2 + 1, bed.told % 2 == 1);
        bed.told += 1;
        Ok(Some(Event {
            at: Timestamp::ZERO + PERIOD * turn,
            instance: if is_soil { "Garden" } else { "Weather" },
        }))
    }

    /// `moisture` (0 to 1) and `is_open`.
    fn truth(&self) -> serde_json::Value {
        let bed = self.lock();
        serde_json::json!({ "moisture": bed.moisture, "is_open": bed.is_open })
    }
}

impl RainGauge for Hardware {
    fn read_rain(&self) -> Result<(Timestamp, f32)> {
        let (at, bed) = self.sample(|bed| &mut bed.rain)?;
        drop(bed);
        Ok((at, Bed::rain(at)))
    }
}

impl SoilProbe for Hardware {
    fn read_moisture(&self) -> Result<(Timestamp, f32)> {
        let (at, bed) = self.sample(|bed| &mut bed.soil)?;
        Ok((at, bed.moisture))
    }
}

impl Valve for Hardware {
    fn write_valve(&self, is_open: bool) -> Result<()> {
        let mut bed = self.lock();
        bed.is_open = is_open && !bed.is_safe;
        Ok(())
    }
}
