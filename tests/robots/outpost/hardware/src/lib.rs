//! The outpost's platform: a clock that strikes every 10 ms, on a wall clock as well as in lockstep.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use framework::{Clock, Event, HardwareContext, Result, Stop, Stopped, Timestamp};
use outpost_nodes::interfaces::ClockInterface;
use serde::Deserialize;

/// Between two strokes.
pub const PACE: Duration = Duration::from_millis(10);

/// A clock.
pub struct Hardware {
    clock: Clock,
    stop: Stop,
    /// Strokes that nodes have heard.
    heard: Mutex<u64>,
    /// Strokes of the world; lockstep only.
    struck: AtomicU64,
}

/// `[hardware.<target>]` of the parameter files: there is nothing to set.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {}

/// When the clock strikes for this time, from 1.
fn time(stroke: u64) -> Timestamp {
    let pace = u64::try_from(PACE.as_nanos()).unwrap_or(u64::MAX);
    Timestamp::from_nanos(stroke.saturating_mul(pace))
}

impl framework::Hardware for Hardware {
    fn new(context: HardwareContext) -> Result<Self> {
        let Settings {} = context.parameters()?;
        Ok(Self {
            clock: context.clock,
            stop: context.stop,
            heard: Mutex::new(0),
            struck: AtomicU64::new(0),
        })
    }

    fn check_parameters(context: &HardwareContext) -> Result<()> {
        context.parameters::<Settings>().map(drop)
    }

    fn identities(&self) -> Vec<(String, String)> {
        Vec::new()
    }

    fn stop(&self) {
        self.stop.request();
    }

    fn enter_safe_state(&self) {}

    fn is_simulated(&self) -> bool {
        true
    }

    fn next_event(&self) -> Result<Option<Event>> {
        if self.stop.is_requested() {
            return Err(Stopped.into());
        }
        let stroke = self.struck.fetch_add(1, Ordering::Relaxed) + 1;
        Ok(Some(Event {
            at: time(stroke),
            instance: "Keeper",
        }))
    }
}

impl ClockInterface for Hardware {
    fn read_stroke(&self) -> Result<Timestamp> {
        let pace = PACE.as_nanos();
        let struck = u128::from(self.clock.now().as_nanos()) / pace;
        let struck = u64::try_from(struck).unwrap_or(u64::MAX);
        // Those that nobody waited for are past.
        let next = {
            let heard = self
                .heard
                .lock()
                .unwrap_or_else(|poison| poison.into_inner());
            struck.max(*heard + 1)
        };
        self.clock.wait_until(time(next), &self.stop)?;
        *self
            .heard
            .lock()
            .unwrap_or_else(|poison| poison.into_inner()) = next;
        Ok(time(next))
    }
}
