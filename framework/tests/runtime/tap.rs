//! What a communication server sees of instances that run.

use framework::reflect::Content;
use framework::tap::WINDOW;
use framework::{InstanceLink, Link, Lockstep, OutputKind, Rearm, Stop, Tap};
use serde_json::Value;

use crate::body::{Setting, robot};
use crate::scripted::{ScriptedHardware, millis};

/// `Legs` run at 0, 10, 20 … ms; `between` is called before each of them.
fn run(events: u64, mut between: impl FnMut(u64, &mut Link)) {
    let hardware = ScriptedHardware::lockstep((0..events).map(|number| (number * 10, "Legs")));
    let mut robot = robot(&hardware, &Setting::default());
    let mut link = robot.link(&Stop::new(), Rearm::default());
    let mut lockstep = Lockstep::new(&mut robot, hardware.as_ref());
    for number in 0..events {
        between(number, &mut link);
        lockstep
            .run_until(millis(number * 10), |_| ())
            .expect("nothing stops the robot");
    }
}

fn legs(link: &mut Link) -> &mut InstanceLink {
    let mut instances = link.instances.iter_mut();
    instances
        .find(|instance| instance.description.name == "Legs")
        .expect("there are Legs")
}

fn tap<'link>(link: &'link mut Link, name: &str) -> &'link mut Tap {
    let mut taps = legs(link).taps.iter_mut();
    taps.find(|tap| tap.name() == name).expect("an output")
}

/// Cycle numbers and values of everything that waits.
fn taken(tap: &mut Tap) -> Vec<(u64, Value)> {
    let mut all = Vec::new();
    while tap.take(|tapped| {
        let value = serde_json::to_value(tapped.value.as_serialize()).expect("it has a serde form");
        // The data of `Legs` are 5 ms old.
        let captured = (tapped.cycle * 10 - 10).saturating_sub(5);
        assert_eq!(tapped.timestamp, millis(captured));
        all.push((tapped.cycle, value));
    }) {}
    all
}

#[test]
fn an_open_tap_has_every_cycle_and_a_closed_one_none() {
    let mut seen = Vec::new();
    run(10, |number, link| {
        let raw = tap(link, "raw");
        seen.extend(taken(raw).into_iter().map(|(cycle, _)| cycle));
        match number {
            2 | 7 => raw.open(),
            5 => raw.close(),
            _ => {}
        }
        assert_eq!(raw.is_open(), matches!(number, 2..5 | 7..));
    });
    // Cycles count from 1; what follows the last look stays where it is.
    assert_eq!(seen, [3, 4, 5, 8, 9]);
}

#[test]
fn a_server_that_is_late_has_no_gap_and_one_that_is_too_late_is_told() {
    let window = WINDOW as u64;
    run(4 * window, |number, link| {
        let raw = tap(link, "raw");
        if number == 0 {
            raw.open();
        }
        if number == window {
            let cycles: Vec<_> = taken(raw).into_iter().map(|(cycle, _)| cycle).collect();
            assert_eq!(cycles, (1..=window).collect::<Vec<_>>());
            assert_eq!(raw.dropped(), 0);
        }
        if number == 4 * window - 1 {
            let cycles: Vec<_> = taken(raw).into_iter().map(|(cycle, _)| cycle).collect();
            assert_eq!(cycles.last(), Some(&number), "the newest are kept");
            assert_eq!(raw.dropped() + cycles.len() as u64, 3 * window - 1);
            assert!(raw.dropped() > 0);
        }
    });
}

#[test]
fn an_additional_output_is_computed_while_its_tap_is_open() {
    let mut seen = Vec::new();
    run(8, |number, link| {
        let debug = tap(link, "debug.raw");
        assert_eq!(debug.kind(), OutputKind::Additional);
        seen.extend(taken(debug).into_iter().map(|(cycle, _)| cycle));
        match number {
            // Two want it; it counts until the last is gone.
            2 => {
                debug.open();
                debug.open();
            }
            3 | 5 => debug.close(),
            _ => {}
        }
    });
    assert_eq!(seen, [3, 4, 5]);
}

#[test]
fn a_tap_tells_what_its_values_look_like() {
    run(1, |_, link| {
        let names: Vec<_> = legs(link).taps.iter().map(Tap::name).collect();
        let all = "raw value persistent transient clock since_last gain phase debug.raw";
        assert_eq!(names.join(" "), all);
        assert!(matches!(tap(link, "raw").shape().content, Content::Leaf(_)));
        let transient = tap(link, "transient").shape().content;
        assert!(matches!(transient, Content::List { .. }));
    });
}

#[test]
fn an_instance_tells_what_it_did_when_it_is_asked() {
    run(6, |number, link| {
        let reports = &legs(link).reports;
        let report = reports.take();
        match number {
            2 => reports.ask(None),
            // It is written on again.
            3 => {
                let report = report.expect("it was asked");
                assert_eq!(report.counts.cycles, 3);
                reports.ask(Some(report));
            }
            4 => {
                let report = report.expect("it was asked again");
                assert_eq!(report.counts.cycles, 4);
                assert_eq!(report.nodes[0].calls, 4);
            }
            _ => assert!(report.is_none()),
        }
    });
}
