//! A cycler's thread asks for itself: what it gets holds for it alone, and is what the system says of it.

use std::fs;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use framework::driver::Observer;
use framework::{Granted, Instance, Policy, Scheduling, Stop, Threads};

use crate::body::{Setting, robot};
use crate::scripted::ScriptedHardware;

/// What Linux says of the calling thread in /proc.
#[derive(Clone, Debug, PartialEq, Eq)]
struct OfSystem {
    policy: u64,
    priority: u64,
    cores: String,
}

impl OfSystem {
    fn of_this_thread() -> Self {
        let stat = fs::read_to_string("/proc/thread-self/stat").expect("Linux has it");
        // The name, in brackets, may hold anything; proc(5) counts from 1, and the third field follows it.
        let after_name = stat.rsplit_once(") ").expect("the name is in brackets").1;
        let field = |number: usize| {
            let field = after_name.split(' ').nth(number - 3);
            field
                .and_then(|field| field.parse().ok())
                .expect("stat has it")
        };
        let status = fs::read_to_string("/proc/thread-self/status").expect("Linux has it");
        let cores = status
            .lines()
            .find_map(|line| line.strip_prefix("Cpus_allowed_list:"));
        Self {
            priority: field(40),
            policy: field(41),
            cores: cores.expect("status has it").trim().to_owned(),
        }
    }
}

struct Looking(Arc<Mutex<Option<OfSystem>>>);

impl Observer for Looking {
    fn begun(&mut self, _: &mut dyn Instance) {
        *self.0.lock().expect("not poisoned") = Some(OfSystem::of_this_thread());
    }
}

/// What Legs was told, and what the system says of the threads of Eye and Legs after a run.
fn run(scheduling: Scheduling, is_real_time: bool) -> (Option<Granted>, OfSystem, OfSystem) {
    let hardware = ScriptedHardware::threads();
    let setting = Setting {
        legs_scheduling: scheduling,
        ..Setting::default()
    };
    let mut robot = robot(&hardware, &setting);
    let counters: Vec<_> = robot
        .instances
        .iter()
        .map(|instance| instance.counters().clone())
        .collect();
    let seen = [Arc::default(), Arc::default()];
    let stop = Stop::new();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let all_turned = || counters.iter().all(|counters| counters.cycles.get() > 0);
            while !all_turned() && stop.wait(Duration::from_millis(1)).is_ok() {}
            stop.request();
        });
        Threads::new(&robot.clock, hardware.as_ref(), &stop)
            .real_time(is_real_time)
            .run_observed(&mut robot.instances, |description| {
                let place = usize::from(description.name == "Legs");
                Some(Box::new(Looking(Arc::clone(&seen[place]))))
            })
    })
    .expect("nothing stopped the robot");
    let [eye, legs] = seen.map(|seen| {
        seen.lock()
            .expect("not poisoned")
            .clone()
            .expect("it turned")
    });
    (counters[1].granted().cloned(), eye, legs)
}

fn first_core(of_system: &OfSystem) -> usize {
    let end = of_system
        .cores
        .find(|character: char| !character.is_ascii_digit());
    of_system.cores[..end.unwrap_or(of_system.cores.len())]
        .parse()
        .expect("a list of cores")
}

#[test]
fn a_thread_gets_what_its_instance_asks_for_and_no_other_does() {
    let before = OfSystem::of_this_thread();
    let core = first_core(&before);
    let scheduling = Scheduling {
        policy: Some(Policy::Fifo),
        priority: Some(7),
        cores: Box::leak(Box::new([core])),
    };
    let (granted, eye, legs) = run(scheduling, true);
    let granted = granted.expect("Legs asked");
    assert_eq!((granted.cores, legs.cores), (vec![core], core.to_string()));
    // SCHED_FIFO is 1; without permission the thread stays as it was, and is told so.
    if legs.policy == 1 {
        assert_eq!((granted.policy, granted.priority), (Some(Policy::Fifo), 7));
        assert_eq!(legs.priority, 7);
    } else {
        assert_eq!((granted.policy, granted.priority), (Some(Policy::Other), 0));
    }
    assert_eq!((&eye, &OfSystem::of_this_thread()), (&before, &before));
}

#[test]
fn without_real_time_nobody_asks() {
    let before = OfSystem::of_this_thread();
    let scheduling = Scheduling {
        policy: Some(Policy::Fifo),
        priority: Some(7),
        cores: &[0],
    };
    assert_eq!(run(scheduling, false), (None, before.clone(), before));
}

#[test]
fn a_core_that_is_not_there_is_refused_and_the_robot_runs() {
    let scheduling = Scheduling {
        cores: &[1023],
        ..Scheduling::default()
    };
    let (granted, eye, legs) = run(scheduling, true);
    assert_eq!(legs, eye);
    assert!(!granted.expect("Legs asked").cores.contains(&1023));
}
