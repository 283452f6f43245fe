//! The real clock: counts and order, never rates.

use std::sync::Arc;
use std::time::Duration;

use framework::driver::Threads;
use framework::{Given, Hardware, OnFailure, Robot, Stop};
use serde_json::json;

use crate::body::{Parameters, Plan, Setting, robot};
use crate::scripted::{Act, Script, ScriptedHardware};

/// Runs until both instances have finished so many cycles.
fn run_until(
    cycles: u64,
    setting: &Setting,
) -> (
    Arc<ScriptedHardware>,
    Robot<Parameters>,
    framework::Result<()>,
) {
    let hardware = ScriptedHardware::threads();
    let mut robot = robot(&hardware, setting);
    let counters: Vec<_> = robot
        .instances
        .iter()
        .map(|instance| instance.counters().clone())
        .collect();
    let stop = Stop::new();
    let result = std::thread::scope(|scope| {
        scope.spawn(|| {
            let enough = || {
                counters
                    .iter()
                    .all(|counters| counters.cycles.get() >= cycles)
            };
            while !enough() && stop.wait(Duration::from_millis(1)).is_ok() {}
            stop.request();
        });
        Threads::new(&robot.clock, hardware.as_ref(), &stop).run(&mut robot.instances)
    });
    (hardware, robot, result)
}

#[test]
fn instances_run_side_by_side_and_stop_in_order() {
    let plan = Plan::default();
    let setting = Setting {
        eye: plan.clone(),
        ..Setting::default()
    };
    let (hardware, robot, result) = run_until(20, &setting);
    result.expect("nothing stopped the robot");
    assert_eq!(hardware.log.lines(), ["safe state", "stop"]);
    for instance in &robot.instances {
        let counts = instance.counters().read();
        assert!(counts.cycles >= 20);
        assert_eq!(
            (counts.failures, counts.abandoned, counts.corrected),
            (0, 0, 0)
        );
    }
    // Cycle after cycle; the last wait was stopped.
    let lines = plan.log.lines();
    let (cycles, last) = lines.split_at(lines.len() / 4 * 4);
    for cycle in cycles.chunks(4) {
        assert_eq!(cycle, ["Eye wait", "Eye begin", "Eye run", "Eye finish"]);
    }
    assert!(last.len() <= 1, "{last:?}");
    let eye = robot.instances[0].counters().read();
    let queue = robot.instances[1].report().queues[0].counts;
    assert!(
        queue.delivered <= eye.cycles && queue.abandoned == 0,
        "{queue:?}"
    );
    assert!(queue.delivered > 0);
}

#[test]
fn a_failure_for_good_stops_all_and_is_the_error() {
    let legs = Plan {
        work: Script::new([Act::Work, Act::Panic]),
        ..Plan::default()
    };
    let (hardware, robot, result) = run_until(
        u64::MAX,
        &Setting {
            legs,
            ..Setting::default()
        },
    );
    let error = result.expect_err("a node panicked").to_string();
    assert!(
        error.contains("Legs failed") && error.contains("test::worker"),
        "{error}"
    );
    assert_eq!(hardware.log.lines(), ["safe state", "stop"]);
    assert_eq!(robot.instances[1].counters().cycles.get(), 1);
}

#[test]
fn a_panic_outside_of_every_node_stops_the_robot_with_an_error() {
    let legs = Plan {
        work: Script::new([Act::Work, Act::Fail]),
        nodes_panic: true,
        ..Plan::default()
    };
    let setting = Setting {
        legs,
        on_failure: OnFailure::Restart,
        ..Setting::default()
    };
    let hardware = ScriptedHardware::threads();
    let mut robot = robot(&hardware, &setting);
    let stop = Stop::new();
    let (result, stopped_itself) = std::thread::scope(|scope| {
        let rescue = scope.spawn(|| {
            let stopped = stop.wait(Duration::from_secs(5)).is_err();
            stop.request();
            stopped
        });
        let result = Threads::new(&robot.clock, hardware.as_ref(), &stop).run(&mut robot.instances);
        (result, rescue.join().expect("it only waits"))
    });
    let error = result.expect_err("an instance panicked").to_string();
    assert!(
        error.contains("Legs failed") && error.contains("nodes cannot be told"),
        "{error}"
    );
    assert!(stopped_itself);
    let lines = hardware.log.lines();
    assert_eq!(lines.last().map(String::as_str), Some("stop"), "{lines:?}");
}

#[test]
fn clients_inject_and_change_parameters_while_the_threads_run() {
    let hardware = ScriptedHardware::threads();
    let mut robot = robot(&hardware, &Setting::default());
    let Robot {
        instances,
        access,
        parameters,
        clock,
        ..
    } = &mut robot;
    let legs = instances[1].counters().clone();
    let stop = Stop::new();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let wait_for = |cycles| {
                while legs.cycles.get() < cycles && stop.wait(Duration::from_millis(1)).is_ok() {}
            };
            wait_for(3);
            let value = Given::from(&json!(4711));
            let injected = access[1].injector.inject("value", &value);
            parameters
                .change(&[("gain", json!(9))])
                .expect("it is a number");
            // The cycle that runs meanwhile may have begun before.
            wait_for(legs.cycles.get() + 2);
            stop.request();
            injected.expect("a valid value");
        });
        Threads::new(clock, hardware.as_ref(), &stop)
            .run(instances)
            .expect("nothing stopped the robot");
    });
    let read = |path| robot.read(path).expect("an output");
    assert_eq!(read("Legs.main_outputs.value"), json!(4711));
    assert_eq!(read("Legs.main_outputs.gain"), json!(9));
}

#[test]
fn a_restarting_instance_holds_up_no_other() {
    let eye = Plan {
        work: Script::new([Act::Fail]),
        ..Plan::default()
    };
    let setting = Setting {
        eye,
        on_failure: OnFailure::Restart,
        ..Setting::default()
    };
    let (hardware, robot, result) = run_until(5, &setting);
    result.expect("nothing stopped the robot");
    let [eye, legs] = [0, 1].map(|index| robot.instances[index].counters().read());
    assert_eq!((eye.restarts, eye.abandoned), (1, 1));
    // 0.1 s of waits of 2 ms: far more than one would be if it had been held up.
    assert!(legs.cycles > 5, "{legs:?}");
    assert_eq!(
        hardware.log.lines(),
        ["safe state", "stop"],
        "perception commands no actuators"
    );
}

#[test]
fn a_real_time_instance_is_in_safe_state_while_it_restarts() {
    let legs = Plan {
        work: Script::new([Act::Fail]),
        ..Plan::default()
    };
    let setting = Setting {
        legs,
        on_failure: OnFailure::Restart,
        ..Setting::default()
    };
    let (hardware, _, result) = run_until(5, &setting);
    result.expect("nothing stopped the robot");
    assert_eq!(
        hardware.log.lines(),
        ["safe state", "rearm", "safe state", "stop"]
    );
}

#[test]
fn the_watchdog_brings_a_hanging_real_time_cycle_to_safe_state_once() {
    let legs = Plan {
        work: Script::new([Act::Work, Act::Take(400)]),
        ..Plan::default()
    };
    let eye = Plan {
        work: Script::new([Act::Take(400)]),
        ..Plan::default()
    };
    let (hardware, _, result) = run_until(
        4,
        &Setting {
            legs,
            eye,
            ..Setting::default()
        },
    );
    result.expect("a hanging cycle is no error");
    // It was never re-armed, so the stop found it in safe state.
    assert_eq!(hardware.log.lines(), ["safe state", "stop"]);
}

/// A cycle hangs once; then somebody asks for the actuators, and the robot stops a while later.
fn rearmed(ask: impl FnOnce(&ScriptedHardware, &framework::Rearm) + Send) -> Vec<String> {
    let legs = Plan {
        work: Script::new([Act::Work, Act::Take(400)]),
        ..Plan::default()
    };
    let setting = Setting {
        legs,
        ..Setting::default()
    };
    let hardware = ScriptedHardware::threads();
    let mut robot = robot(&hardware, &setting);
    let stop = Stop::new();
    let threads = Threads::new(&robot.clock, hardware.as_ref(), &stop);
    let rearm = threads.rearming();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let until = |lines: usize| {
                while hardware.log.lines().len() < lines
                    && stop.wait(Duration::from_millis(1)).is_ok()
                {}
            };
            // Nobody has taken them away yet, so this changes nothing.
            rearm.request();
            until(1);
            ask(&hardware, &rearm);
            until(2);
            stop.request();
        });
        threads.run(&mut robot.instances)
    })
    .expect("a hanging cycle is no error");
    hardware.log.lines()
}

#[test]
fn a_client_or_the_own_button_gives_the_actuators_back() {
    let expected = ["safe state", "rearm", "safe state", "stop"];
    assert_eq!(rearmed(|_, rearm| rearm.request()), expected);
    let pressed = |hardware: &ScriptedHardware, _: &framework::Rearm| {
        hardware
            .button
            .store(true, std::sync::atomic::Ordering::Relaxed);
    };
    assert_eq!(rearmed(pressed), expected);
}

#[test]
fn a_silent_hardware_is_no_hanging_cycle() {
    let receive = Script::new([Act::Work, Act::Take(250)]);
    let legs = Plan {
        receive,
        ..Plan::default()
    };
    let hardware = ScriptedHardware::threads();
    let mut robot = robot(
        &hardware,
        &Setting {
            legs,
            ..Setting::default()
        },
    );
    let stop = Stop::new();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(Duration::from_millis(200));
            hardware.log.add("not in safe state yet");
            stop.request();
        });
        Threads::new(&robot.clock, hardware.as_ref(), &stop)
            .run(&mut robot.instances)
            .expect("nothing stopped the robot");
    });
    assert_eq!(
        hardware.log.lines(),
        ["not in safe state yet", "safe state", "stop"]
    );
}

#[test]
fn setup_that_fails_under_skip_starts_over_after_a_pause() {
    let receive = Script::new([Act::Fail; 5]);
    let legs = Plan {
        receive,
        ..Plan::default()
    };
    let setting = Setting {
        legs,
        on_failure: OnFailure::Skip,
        ..Setting::default()
    };
    let started = std::time::Instant::now();
    let (_, robot, result) = run_until(1, &setting);
    result.expect("nothing stopped the robot");
    assert!(started.elapsed() >= Duration::from_millis(50));
    assert_eq!(robot.instances[1].counters().failures.get(), 5);
}

#[test]
fn overruns_are_counted_with_the_node_that_took_longest() {
    let legs = Plan {
        work: Script::new([Act::Take(30); 3]),
        ..Plan::default()
    };
    let deadline = Some(Duration::from_millis(20));
    let (_, robot, result) = run_until(
        4,
        &Setting {
            legs,
            deadline,
            ..Setting::default()
        },
    );
    result.expect("an overrun is no error");
    let report = robot.instances[1].report();
    assert!(report.counts.overruns >= 3);
    let blamed: Vec<_> = report.slowest.iter().map(|(node, _)| *node).collect();
    assert!(blamed.contains(&"test::worker"), "{blamed:?}");
}

#[test]
fn hardware_that_says_stopped_ends_the_run() {
    let receive = Script::new([Act::Work, Act::Stopped]);
    let eye = Plan {
        receive,
        ..Plan::default()
    };
    let (hardware, _, result) = run_until(
        u64::MAX,
        &Setting {
            eye,
            ..Setting::default()
        },
    );
    result.expect("a stop is no error");
    assert_eq!(hardware.log.lines(), ["safe state", "stop"]);
    hardware.stop();
}
