//! How late a real-time cycler wakes up beside the bare system call `clock_nanosleep`, while every core is busy.
//!
//! Both sleep in turns, on the cycler's own thread: two threads of one priority on one core would wait for each other.
//!
//! `HULKGEN_WAKE_UP=60 cargo test -p hulkgen-framework --test runtime wake_up -- --nocapture` measures for a minute and prints
//! both; without the variable it is a moment, in which both have to wake up and are asked for what the system granted them.

use std::hint::black_box;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, ThreadId};
use std::time::Duration;

use framework::driver::Observer;
use framework::{Instance, Policy, Scheduling, Stop, Threads};
use rustix::thread::{ClockId, CpuSet, Timespec, clock_nanosleep_absolute, sched_setaffinity};
use rustix::time::clock_gettime;

use crate::body::{Setting, robot};
use crate::scripted::ScriptedHardware;

const PERIOD: Duration = Duration::from_millis(12);
const PRIORITY: u8 = 80;
const CORE: usize = 0;

/// Sleeps once in every cycle of Legs; which thread that is, and how late it woke up.
#[derive(Clone, Default)]
struct Bare(Arc<Mutex<Vec<(ThreadId, Duration)>>>);

impl Observer for Bare {
    fn begun(&mut self, _: &mut dyn Instance) {
        let late = sleep_bare();
        let mut all = self.0.lock().expect("not poisoned");
        all.push((thread::current().id(), late));
    }
}

#[test]
fn a_real_time_cycler_wakes_up_beside_the_bare_system_call_under_load() {
    let seconds = std::env::var("HULKGEN_WAKE_UP").ok();
    let seconds = seconds.map_or(0.3, |text| text.parse().expect("a number of seconds"));
    let mut hardware = ScriptedHardware::threads();
    Arc::get_mut(&mut hardware)
        .expect("nobody else has it yet")
        .period = PERIOD;
    let setting = Setting {
        legs_scheduling: Scheduling {
            policy: Some(Policy::Fifo),
            priority: Some(PRIORITY),
            cores: &[CORE],
        },
        ..Setting::default()
    };
    let mut robot = robot(&hardware, &setting);
    let counters = robot.instances[1].counters().clone();
    let (stop, bare, is_over) = (Stop::new(), Bare::default(), AtomicBool::new(false));
    thread::scope(|scope| {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        for core in 0..cores {
            let is_over = &is_over;
            scope.spawn(move || occupy(core, is_over));
        }
        scope.spawn(|| {
            let _ = stop.wait(Duration::from_secs_f64(seconds));
            while counters.cycles.get() < 2 && stop.wait(PERIOD).is_ok() {}
            is_over.store(true, Ordering::Relaxed);
            stop.request();
        });
        let run = Threads::new(&robot.clock, hardware.as_ref(), &stop)
            .real_time(true)
            .run_observed(&mut robot.instances, |description| {
                (description.name == "Legs").then(|| Box::new(bare.clone()) as Box<dyn Observer>)
            });
        run.expect("nothing stopped the robot");
    });
    let bare = bare.0.lock().expect("not poisoned");
    let legs = bare.first().expect("Legs turned").0;
    let ours = hardware.woken.lock().expect("not poisoned");
    let ours = ours.iter().filter(|(thread, _)| *thread == legs);
    let ours: Vec<Duration> = ours.map(|(_, late)| *late).collect();
    let bare: Vec<Duration> = bare.iter().map(|(_, late)| *late).collect();
    assert!(ours.len() >= 2 && ours.len().abs_diff(bare.len()) <= 1);
    let granted = counters.granted().expect("Legs asked");
    match granted.policy {
        Some(Policy::Fifo) => {
            let expected = (PRIORITY, &[CORE][..]);
            assert_eq!((granted.priority, granted.cores.as_slice()), expected);
        }
        // Who may not have it is told so.
        refused => assert_eq!((refused, granted.priority), (Some(Policy::Other), 0)),
    }
    let (ours, bare) = (quantiles(ours), quantiles(bare));
    println!("granted: {granted}\nours: {ours:?}\nbare: {bare:?}");
    for (name, ours, bare) in [("p50", ours.1, bare.1), ("p99", ours.2, bare.2)] {
        println!("{name}: {:.2} x", ours.as_secs_f64() / bare.as_secs_f64());
    }
}

/// Uses up one core until it is over.
fn occupy(core: usize, is_over: &AtomicBool) {
    pin(core);
    let mut number = 0_u64;
    while !is_over.load(Ordering::Relaxed) {
        number = black_box(number.wrapping_mul(3).wrapping_add(1));
    }
}

/// How late the calling thread woke up.
fn sleep_bare() -> Duration {
    let now = || {
        let time = clock_gettime(rustix::time::ClockId::Monotonic);
        Duration::try_from(time).expect("it counts from the start")
    };
    let due = now() + PERIOD;
    let request = Timespec::try_from(due).expect("it is soon");
    clock_nanosleep_absolute(ClockId::Monotonic, &request).expect("no signal comes");
    now() - due
}

fn pin(core: usize) {
    let mut cores = CpuSet::new();
    cores.set(core);
    // On a machine without this core everything runs where it may.
    let _ = sched_setaffinity(None, &cores);
}

/// How many, p50, p99, the longest.
fn quantiles(mut late: Vec<Duration>) -> (usize, Duration, Duration, Duration) {
    late.sort_unstable();
    let at = |part: usize| late[(late.len() - 1) * part / 100];
    (late.len(), at(50), at(99), at(100))
}
