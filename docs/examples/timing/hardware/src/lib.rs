//! The hardware of the target `rail`: a vehicle that rolls evenly along a rail, on wheels that slip.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use framework::{Clock, Event, HardwareContext, Result, Stop, Timestamp};
use timing_nodes::interfaces::{Camera, Console, Effort, Odometer, Pace, Radio};

/// Metres per second, forward.
const SPEED: f64 = 0.25;
/// The wheels roll so many times as far as the vehicle comes.
const SLIP: f64 = 1.1;
/// Metres from the start, where the mark is that the camera sees.
const MARK: f64 = 10.0;

/// The vehicle, as four senses of their own pace.
pub struct Hardware {
    clock: Clock,
    stop: Stop,
    images: Timer,
    wheels: Timer,
    messages: Timer,
    pace: Timer,
    /// What was printed.
    lines: Mutex<Vec<String>>,
}

/// A sense with a fixed period.
struct Timer {
    instance: &'static str,
    period: Duration,
    /// When the next sample is read, and when lockstep is told about the next.
    next: Mutex<(Timestamp, Timestamp)>,
}

impl Timer {
    const fn new(instance: &'static str, first: u64, period: u64) -> Self {
        let first = Timestamp::from_nanos(first * 1_000_000);
        Self {
            instance,
            period: Duration::from_millis(period),
            next: Mutex::new((first, first)),
        }
    }

    /// The time of the newest sample that is ready and was not read, else of the next; and how many it stands for.
    fn read(&self, now: Timestamp) -> (Timestamp, u32) {
        let mut next = locked(&self.next);
        let (mut at, mut samples) = (next.0, 1);
        while at + self.period <= now {
            at = at + self.period;
            samples += 1;
        }
        next.0 = at + self.period;
        (at, samples)
    }
}

impl Hardware {
    /// Where the vehicle really is, metres from the start.
    pub fn position(at: Timestamp) -> f64 {
        SPEED * (at - Timestamp::ZERO).as_secs_f64()
    }

    /// Every line that was printed.
    pub fn printed(&self) -> Vec<String> {
        locked(&self.lines).clone()
    }

    /// Waits for the next sample of a sense.
    fn sample(&self, timer: &Timer) -> Result<(Timestamp, u32)> {
        let (at, samples) = timer.read(self.clock.now());
        self.clock.wait_until(at, &self.stop)?;
        Ok((at, samples))
    }
}

impl framework::Hardware for Hardware {
    fn new(context: HardwareContext) -> Result<Self> {
        Ok(Self {
            clock: context.clock,
            stop: context.stop,
            images: Timer::new("Vision", 205, 2000),
            wheels: Timer::new("Odometry", 10, 10),
            messages: Timer::new("Radio", 352, 700),
            pace: Timer::new("Localization", 500, 500),
            lines: Mutex::default(),
        })
    }

    fn stop(&self) {
        self.stop.request();
    }

    /// Nobody commands the vehicle.
    fn enter_safe_state(&self) {}

    fn is_simulated(&self) -> bool {
        true
    }

    fn next_event(&self) -> Result<Option<Event>> {
        self.stop.check()?;
        // The first of equals: in the order of the manifest.
        let timers = [&self.images, &self.wheels, &self.messages, &self.pace];
        let next = timers.into_iter().min_by_key(|timer| locked(&timer.next).1);
        Ok(next.map(|timer| {
            let mut next = locked(&timer.next);
            let at = next.1;
            next.1 = at + timer.period;
            Event {
                at,
                instance: timer.instance,
            }
        }))
    }
}

impl Camera for Hardware {
    fn read_image(&self) -> Result<(Timestamp, f32)> {
        let (at, _) = self.sample(&self.images)?;
        Ok((at, (MARK - Self::position(at)) as f32))
    }
}

impl Odometer for Hardware {
    fn read_wheels(&self) -> Result<(Timestamp, f32)> {
        let (at, samples) = self.sample(&self.wheels)?;
        let elapsed = self.wheels.period.as_secs_f64() * f64::from(samples);
        Ok((at, (SPEED * SLIP * elapsed) as f32))
    }
}

impl Radio for Hardware {
    fn read_message(&self) -> Result<(Timestamp, f32)> {
        let (at, _) = self.sample(&self.messages)?;
        // A team mate far away sees it to the decimetre.
        let decimetres = (Self::position(at) * 10.0).round();
        Ok((at, (decimetres / 10.0) as f32))
    }
}

impl Pace for Hardware {
    fn read_pace(&self) -> Result<Timestamp> {
        let (at, _) = self.sample(&self.pace)?;
        Ok(at)
    }
}

impl Effort for Hardware {
    fn take(&self, seconds: f32) -> Result<()> {
        if self.clock.is_stepped() {
            return Ok(());
        }
        let end = self.clock.now() + Duration::from_secs_f32(seconds.max(0.0));
        self.clock.wait_until(end, &self.stop)
    }
}

impl Console for Hardware {
    fn print(&self, line: &str) -> Result<()> {
        println!("{line}");
        locked(&self.lines).push(line.to_owned());
        Ok(())
    }
}

/// Nothing behind a lock can be half done.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
