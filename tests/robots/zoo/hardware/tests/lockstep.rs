//! The generated zoo at work: what each kind of field, policy and client promises, in lockstep.

#[path = "lockstep/chaos.rs"]
mod chaos;
#[path = "lockstep/determinism.rs"]
mod determinism;

use std::sync::Arc;

use framework::parameters::Layers;
use framework::testing::created;
use framework::{Clock, Given, Instance, Lockstep, Paused, Robot, Stop, Timestamp};
use serde_json::{Value, json};
use zoo_hardware::Hardware;
use zoo_runtime::parameters::Parameters;
use zoo_runtime::runtime;

struct Zoo {
    hardware: Arc<Hardware>,
    robot: Robot<Parameters>,
    /// Where the last run ended.
    paused: Option<Paused>,
}

impl Zoo {
    fn new() -> Self {
        let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/../parameters").into();
        let layers = Layers {
            directory,
            ..Layers::default()
        };
        let (clock, stop) = (Clock::stepped(), Stop::default());
        let (hardware, robot) = created(&layers, "loud", &[], &clock, &stop, runtime::create);
        Self {
            hardware,
            robot,
            paused: None,
        }
    }

    /// Runs up to a virtual time; `observe` sees every instance after each finished cycle.
    fn run(&mut self, seconds: f64, observe: impl FnMut(&dyn Instance)) {
        let end = Timestamp::from_nanos((seconds * 1e9) as u64);
        let mut lockstep = Lockstep::new(&mut self.robot, &*self.hardware);
        if let Some(paused) = self.paused.take() {
            lockstep = lockstep.after(paused);
        }
        lockstep
            .run_until(end, observe)
            .expect("the zoo does not stop");
        self.paused = Some(lockstep.pause());
    }

    fn read(&self, path: &str) -> Value {
        self.robot
            .read(path)
            .unwrap_or_else(|error| panic!("{error}"))
    }

    /// Cycles, failures and skips of a node in an instance.
    fn node(&self, instance: &str, node: &str) -> (u64, u64, u64) {
        let report = self
            .robot
            .instance(instance)
            .expect("it is an instance")
            .report();
        let node = report
            .nodes
            .into_iter()
            .find(|known| known.node == node)
            .expect("it is a node");
        (node.calls, node.failures, node.skipped)
    }
}

fn output(instance: &dyn Instance, name: &str) -> Value {
    let output = instance
        .main_output(name)
        .expect("it is one of its main outputs");
    serde_json::to_value(output.as_serialize()).expect("outputs serialise")
}

#[test]
fn a_node_that_fails_under_skip_leaves_its_defaults() {
    let mut zoo = Zoo::new();
    let mut dark = 0;
    zoo.run(2.0, |instance| {
        if instance.description().name == "VisionTop" && instance.cycle().number % 10 == 0 {
            dark += 1;
            assert_eq!(output(instance, "spots"), json!([]));
            assert_eq!(output(instance, "best"), Value::Null);
        }
    });
    let (_, failures, _) = zoo.node("VisionTop", "zoo_nodes::vision::spot_finder");
    assert_eq!((dark, failures), (6, 6));
}

#[test]
fn a_node_that_panics_under_hold_keeps_what_it_said() {
    let mut zoo = Zoo::new();
    let mut last = Value::Null;
    zoo.run(2.0, |instance| {
        if instance.description().name == "Hearing" {
            let whistle = output(instance, "whistle");
            if instance.cycle().number % 25 == 0 {
                assert_eq!(output(instance, "loudness"), json!(1.0));
                assert_eq!(whistle, last);
            }
            last = whistle;
        }
    });
    let (calls, failures, _) = zoo.node("Hearing", "zoo_nodes::hearing::whistle");
    assert_eq!((calls, failures), (100, 4));
}

#[test]
fn a_node_is_skipped_while_a_required_input_is_absent() {
    let mut zoo = Zoo::new();
    zoo.run(0.5, |_| {});
    let (calls, failures, skipped) = zoo.node("Control", "zoo_nodes::control::legs");
    assert!(calls > 0 && skipped > 0, "{calls} calls, {skipped} skipped");
    assert_eq!((calls + skipped, failures), (41, 0));
    assert!(zoo.hardware.commands() > 0);
}

#[test]
fn every_form_of_a_path_sees_the_same_value() {
    let mut zoo = Zoo::new();
    let mut seen = Vec::new();
    zoo.run(1.0, |instance| {
        if instance.description().name == "Control" {
            seen.push(output(instance, "seen"));
        }
    });
    assert_eq!(seen, vec![json!(5); 83]);
}

#[test]
fn what_a_client_injects_stands_until_it_is_released() {
    let mut zoo = Zoo::new();
    zoo.run(0.5, |_| {});
    let spot = json!({ "x": 7.0, "brightness": 1.0 });
    for (instance, output, value) in [
        ("Control", "target", &spot),
        ("Control", "joints", &json!([0.1, 0.2, 0.3])),
    ] {
        let access = zoo.robot.access(instance).expect("it is an instance");
        access
            .injector
            .inject(output, &Given::from(value))
            .expect("the value fits");
    }
    zoo.run(0.6, |_| {});
    assert_eq!(zoo.read("Control.main_outputs.target"), spot);
    assert_eq!(zoo.read("Control.main_outputs.joints.0"), json!(0.1f32));
    assert_eq!(zoo.read("Control.main_outputs.pose.heading"), json!(0.3f32));
    zoo.robot
        .access("Control")
        .expect("it is an instance")
        .injector
        .release_all();
    zoo.run(0.7, |_| {});
    assert_ne!(zoo.read("Control.main_outputs.joints.0"), json!(0.1f32));
}

#[test]
fn what_a_client_injected_is_not_held_when_the_node_fails() {
    let mut zoo = Zoo::new();
    let injected = json!({ "loudness": 0.75 });
    let mut said = Vec::new();
    for millis in (5..600).step_by(5) {
        zoo.run(f64::from(millis) / 1000.0, |instance| {
            if instance.description().name == "Hearing" {
                said.push(output(instance, "whistle"));
            }
        });
        let access = zoo.robot.access("Hearing").expect("it is an instance");
        match said.len() {
            20 => access.injector.inject("whistle", &Given::from(&injected)),
            24 => access.injector.release("whistle").or(Ok(())),
            _ => Ok(()),
        }
        .expect("the value fits");
    }
    assert_eq!(said[23], injected);
    assert_ne!(
        said[24], injected,
        "the 25th cycle is too loud for the node"
    );
}

#[test]
fn additional_outputs_are_there_while_somebody_listens() {
    let mut zoo = Zoo::new();
    assert!(
        zoo.robot
            .read("Control.additional_outputs.debug.watcher.seen")
            .is_err()
    );
    for (instance, name) in [
        ("Control", "debug.watcher.seen"),
        ("VisionTop", "vision_top.width"),
        ("VisionTop", "candidates"),
    ] {
        let access = zoo.robot.access(instance).expect("it is an instance");
        assert!(
            access.subscriptions.subscribe(name),
            "{name} is no additional output"
        );
    }
    let mut filled = Vec::new();
    zoo.run(0.2, |instance| {
        for name in [
            "debug.watcher.seen",
            "vision_top.width",
            "vision_bottom.width",
            "candidates",
        ] {
            if let Some(value) = instance.additional_output(name) {
                let value = serde_json::to_value(value.as_serialize()).expect("outputs serialise");
                filled.push((instance.description().name, name, value));
            }
        }
    });
    let last = |instance: &str, name: &str| {
        filled
            .iter()
            .rfind(|(by, what, _)| *by == instance && *what == name)
            .map(|(.., value)| value)
    };
    assert_eq!(
        last("Control", "debug.watcher.seen").and_then(|seen| seen.get(0)),
        Some(&json!(5.0))
    );
    assert_eq!(last("VisionTop", "vision_top.width"), Some(&json!(16)));
    assert!(last("VisionTop", "candidates").is_some_and(Value::is_array));
    assert_eq!(last("VisionBottom", "vision_bottom.width"), None);
}

#[test]
fn a_procedure_is_answered_refused_or_left() {
    let mut zoo = Zoo::new();
    let control = zoo.robot.access("Control").expect("it is an instance");
    let call = |name: &str, request: Value| {
        let (_, caller) = control
            .procedures
            .iter()
            .find(|(known, _)| *known == name)
            .expect("it is one");
        let called = caller.call_any(&Given::from(&request));
        called.expect("the request fits")
    };
    let (walk, stop) = (
        call("walk", json!({ "speed": 0.25 })),
        call("stop", Value::Null),
    );
    zoo.run(0.1, |_| {});
    let answered = walk
        .wait_any(std::time::Duration::ZERO)
        .expect("it is answered");
    let response =
        serde_json::to_value(answered.expect("it is not refused")).expect("it serialises");
    assert_eq!(response, json!(0.25));
    let refused = stop
        .wait_any(std::time::Duration::ZERO)
        .expect("it is answered");
    assert_eq!(
        refused.err().map(|refused| refused.to_string()),
        Some("refused: it never stops".to_owned())
    );
    assert_eq!(zoo.read("Control.main_outputs.speed"), json!(0.25));
}

#[test]
fn instances_keep_states_of_their_own() {
    let mut zoo = Zoo::new();
    zoo.run(1.0, |_| {});
    // `new` sets the state to 100; every finished cycle adds one.
    for (instance, cycles) in [("VisionTop", 29), ("VisionBottom", 29), ("Control", 83)] {
        let count = zoo.read(&format!("{instance}.main_outputs.cycles"));
        assert_eq!(count, json!(100 + cycles), "{instance}");
    }
}

#[test]
fn states_can_be_saved_loaded_and_restored() {
    let mut zoo = Zoo::new();
    zoo.run(0.5, |_| {});
    let saved = save(&mut zoo);
    let names: Vec<&str> = saved.iter().map(|(name, _)| *name).collect();
    assert_eq!(names.first(), Some(&"zoo_nodes::control::body"));
    assert_eq!(names.last(), Some(&"cycler_state"));
    let mut other = Zoo::new();
    assert_ne!(save(&mut other), saved, "half a second changes states");
    let mut states = saved.iter();
    let control = control(&mut other);
    control.states(&mut |_, state| {
        let (_, buffer) = states.next().expect("the same states as before");
        let saved: Value = serde_json::from_slice(buffer).expect("it was saved so");
        let loaded = state.load(&Given::from(&saved));
        loaded.expect("states deserialise");
    });
    control.restore().expect("the gait rebuilds its table");
    assert_eq!(save(&mut other), saved);
    other.run(0.6, |_| {});
    let plan = other.read("Control.main_outputs.plan");
    assert_eq!(plan.as_array().map(Vec::len), Some(4));
}

fn control(zoo: &mut Zoo) -> &mut dyn Instance {
    let control = zoo
        .robot
        .instances
        .iter_mut()
        .find(|one| one.description().name == "Control");
    control.expect("it is an instance").as_mut()
}

/// Every state of Control as JSON, by name.
fn save(zoo: &mut Zoo) -> Vec<(&'static str, Vec<u8>)> {
    let mut saved = Vec::new();
    control(zoo).states(&mut |name, state| {
        let mut buffer = Vec::new();
        let mut json = serde_json::Serializer::new(&mut buffer);
        state
            .save(&mut <dyn erased_serde::Serializer>::erase(&mut json))
            .expect("states serialise");
        saved.push((name, buffer));
    });
    saved
}
