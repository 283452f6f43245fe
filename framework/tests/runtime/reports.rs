//! Numbers that fit each other.

use std::time::Duration;

use framework::report::RobotReport;
use framework::{Lockstep, OnFailure, Timestamp, timing};

use crate::body::{Plan, Setting, SharedOutputs, robot};
use crate::scripted::{Act, Script, ScriptedHardware};

fn report() -> RobotReport {
    timing::set(timing::Timing::Complete);
    let eye = Plan {
        work: Script::new([Act::Work, Act::Fail, Act::Take(3), Act::Panic]),
        ..Plan::default()
    };
    let legs = Plan {
        receive: Script::new([Act::NoEvent, Act::Fail]),
        ..Plan::default()
    };
    let eye_takes = Some(Duration::from_millis(20));
    let setting = Setting {
        eye,
        legs,
        eye_takes,
        on_failure: OnFailure::Skip,
        ..Setting::default()
    };
    let mut events: Vec<_> = (0..30).map(|number| (number * 33, "Eye")).collect();
    events.extend((0..90).map(|number| (number * 12, "Legs")));
    events.sort_unstable();
    let hardware = ScriptedHardware::lockstep(events);
    let mut robot = robot(&hardware, &setting);
    Lockstep::new(&mut robot, hardware.as_ref())
        .run_until(Timestamp::NEVER, |_| ())
        .expect("nothing stops the robot");
    RobotReport::new("test", Duration::from_secs(2), &robot)
}

#[test]
fn counts_of_instances_nodes_and_queues_agree() {
    let report = report();
    let [eye, legs] = &report.instances[..] else {
        panic!("two instances")
    };
    for instance in [eye, legs] {
        let sum = |count: fn(&framework::NodeReport) -> u64| {
            instance.nodes.iter().map(count).sum::<u64>()
        };
        assert_eq!(sum(|node| node.failures), instance.counts.failures);
        assert_eq!(sum(|node| node.skipped), instance.counts.skipped);
        let worker = &instance.nodes[1];
        assert_eq!(
            worker.calls + worker.skipped,
            instance.counts.cycles + instance.counts.abandoned
        );
        let [receiver, ..] = &instance.nodes[..] else {
            panic!("two nodes")
        };
        let starts_over = instance.counts.no_events + receiver.failures;
        assert_eq!(
            receiver.calls,
            instance.counts.cycles + instance.counts.abandoned + starts_over
        );
    }
    assert_eq!((eye.counts.cycles, eye.counts.failures), (30, 2));
    assert_eq!(
        (
            legs.counts.cycles,
            legs.counts.no_events,
            legs.counts.failures
        ),
        (88, 1, 1)
    );
    let queue = legs.queues[0].counts;
    assert_eq!(
        queue.delivered + queue.dropped,
        eye.counts.cycles,
        "all were delivered in the end"
    );
}

#[test]
fn while_somebody_listens_every_cycle_is_timed() {
    let report = report();
    let eye = &report.instances[0];
    let durations = &eye.durations;
    for histogram in [
        &durations.cycle,
        &durations.lateness,
        &durations.wait,
        &durations.setup,
        &durations.framework,
    ] {
        assert_eq!(histogram.count(), eye.counts.cycles);
    }
    assert_eq!(eye.nodes[1].histogram.count(), eye.nodes[1].calls);
}

#[test]
fn a_cycle_is_what_its_nodes_and_the_framework_take() {
    timing::set(timing::Timing::Complete);
    // Just above the lower end of a bucket of the histogram, so that rounding makes nothing shorter.
    let slow = Duration::from_millis(5);
    let eye = Plan {
        work: Script::new([Act::Take(5); 30]),
        ..Plan::default()
    };
    let setting = Setting {
        eye,
        ..Setting::default()
    };
    let hardware = ScriptedHardware::lockstep((0..30).map(|number| (number * 33, "Eye")));
    let mut robot = robot(&hardware, &setting);
    Lockstep::new(&mut robot, hardware.as_ref())
        .run_until(Timestamp::NEVER, |_| ())
        .expect("nothing stops the robot");
    let report = RobotReport::new("test", Duration::from_secs(1), &robot);
    let durations = &report.instances[0].durations;
    // From capture to arrival, on the stepped clock.
    let late = durations.lateness.longest();
    assert!(
        late >= hardware.latency && late < 2 * hardware.latency,
        "{late:?}"
    );
    let [cycle, framework] = [&durations.cycle, &durations.framework].map(|it| it.quantile(0.5));
    assert!(
        cycle >= slow,
        "the node takes 5 ms in every cycle: {cycle:?}"
    );
    assert!(framework > Duration::ZERO, "{framework:?}");
    let most = cycle - Duration::from_micros(4900);
    assert!(framework <= most, "{framework:?} of {cycle:?}");
}

#[test]
fn the_json_has_the_keys_of_the_contract() {
    let json = report().to_json();
    let keys = |value: &serde_json::Value| -> Vec<String> {
        value
            .as_object()
            .expect("an object")
            .keys()
            .cloned()
            .collect()
    };
    assert_eq!(
        keys(&json),
        [
            "version",
            "target",
            "duration_s",
            "instances",
            "recording",
            "recording_state",
            "recording_error",
            "recorded"
        ]
    );
    let instance = &json["instances"][1];
    assert_eq!(
        keys(instance),
        [
            "instance",
            "cycler",
            "kind",
            "cycles",
            "rate_hz",
            "overruns",
            "failures",
            "skipped",
            "cycle_us",
            "lateness_us",
            "wait_us",
            "setup_us",
            "framework_us",
            "allocations",
            "framework_allocations",
            "slots",
            "scheduling",
            "nodes",
            "queues"
        ]
    );
    assert_eq!(keys(&instance["cycle_us"]), ["p50", "p99", "max"]);
    for part in ["lateness_us", "wait_us", "setup_us", "framework_us"] {
        assert_eq!(keys(&instance[part]), ["p50", "p99"]);
    }
    assert_eq!(
        keys(&instance["nodes"][0]),
        [
            "node",
            "p50",
            "p99",
            "max",
            "calls",
            "skipped",
            "failures",
            "allocations"
        ]
    );
    // Nobody counts in this program.
    assert!(instance["allocations"].is_null() && instance["nodes"][0]["allocations"].is_null());
    assert_eq!(
        keys(&instance["queues"][0]),
        [
            "from",
            "delivered",
            "late",
            "expired",
            "abandoned",
            "dropped"
        ]
    );
    // Nobody reads what `Legs` write: one is written, one is the newest. `Eye` has a consumer with a window of eight.
    let bytes = size_of::<framework::Entry<SharedOutputs>>();
    for (instance, slots) in [(0, 2 + 8), (1, 2)] {
        let expected = serde_json::json!({ "number": slots, "bytes": slots * bytes });
        assert_eq!(json["instances"][instance]["slots"], expected);
    }
    assert_eq!(instance["kind"], "real-time");
    assert_eq!(instance["rate_hz"], 44.0);
    assert!(json["recording"].is_null());
}

#[test]
fn the_text_names_what_went_wrong() {
    let text = report().to_string();
    for part in [
        "Eye",
        "Legs",
        "`test::worker` failed in 2 of 30 calls",
        "1 wait without an event",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}
