//! Partial zoos: what is left out is fed through stubs, and what remains does as it does in the whole robot.

use std::collections::BTreeMap;
use std::sync::Arc;

use framework::driver::lockstep::Step;
use framework::parameters::Layers;
use framework::{
    Clock, Finished, Hardware as _, HardwareContext, Instance, Lockstep, Reflect, Robot, Start,
    Stop, Stub, Timestamp,
};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use zoo_control_runtime::databases::{hearing, vision};
use zoo_hardware::Hardware;
use zoo_nodes::types::{Point, Pose, Spot, Whistle};
use zoo_vision_reflexes_lights_runtime::databases::control;

/// For how long the whole robot is watched.
const END: Timestamp = Timestamp::from_nanos(3_000_000_000);

/// The parameters of the whole zoo, with a few more, as those of one of its robots.
fn parameters<P: DeserializeOwned + Reflect>(settings: &[(&str, &str)]) -> framework::Result<P> {
    let own = |(path, value): &(&str, &str)| ((*path).to_owned(), (*value).to_owned());
    let layers = Layers {
        directory: concat!(env!("CARGO_MANIFEST_DIR"), "/../parameters").into(),
        settings: settings.iter().map(own).collect(),
        ..Layers::default()
    };
    layers.load().expect("the files are there").deserialize()
}

/// One of the zoo's robots on hardware of its own, which has events for all instances.
fn created<P: DeserializeOwned + Reflect, R>(
    create: impl FnOnce(&Arc<Hardware>, Start<P>) -> framework::Result<R>,
) -> (Arc<Hardware>, R) {
    let (clock, stop) = (Clock::stepped(), Stop::default());
    let settings = toml::Table::from_iter([("sees_spots".to_owned(), true.into())]);
    let hardware = Hardware::new(HardwareContext {
        options: Vec::new(),
        table: settings,
        run_folder: std::env::temp_dir(),
        clock: clock.clone(),
        stop: stop.clone(),
    });
    let hardware = Arc::new(hardware.expect("the zoo needs nothing"));
    let start = Start {
        clock,
        stop,
        parameters: parameters(&[]).expect("the parameters fit the nodes"),
    };
    let robot = create(&hardware, start).expect("every node can be created");
    (hardware, robot)
}

/// Main outputs by name.
type Outputs = serde_json::Map<String, Value>;

fn outputs(instance: &dyn Instance) -> Outputs {
    let output = |name: &&str| {
        let output = instance.main_output(name).expect("it is one of its own");
        let value = serde_json::to_value(output.as_serialize()).expect("outputs serialise");
        ((*name).to_owned(), value)
    };
    instance.main_outputs().iter().map(output).collect()
}

/// What an instance of the whole robot did.
#[derive(Clone, Debug)]
enum Deed {
    Begin,
    Finish(Outputs),
}

/// One of them.
#[derive(Clone, Debug)]
struct Done {
    at: Timestamp,
    instance: &'static str,
    /// The cycle's.
    timestamp: Timestamp,
    deed: Deed,
}

/// What the whole robot does, in order.
fn whole() -> Vec<Done> {
    let (hardware, mut robot) = created(zoo_runtime::runtime::create);
    let mut lockstep = Lockstep::new(&mut robot, &*hardware);
    let mut done = Vec::new();
    while let Some(stepped) = lockstep.step().expect("the zoo does not stop")
        && stepped.at <= END
    {
        let instance = lockstep.robot().instance(stepped.instance);
        let instance = instance.expect("it was just turned");
        let deed = match stepped.step {
            Step::Began => Deed::Begin,
            Step::Finished(Finished::Completed) => Deed::Finish(outputs(instance)),
            other => panic!("{other:?} is not expected of the zoo"),
        };
        done.push(Done {
            at: stepped.at,
            instance: stepped.instance,
            timestamp: instance.cycle().time.start,
            deed,
        });
    }
    done
}

/// The finished cycles of some instances of the whole robot.
fn cycles(whole: &[Done], instances: &[&str]) -> Vec<(&'static str, Timestamp, Outputs)> {
    let own = whole
        .iter()
        .filter(|done| instances.contains(&done.instance));
    let finished = own.filter_map(|done| match &done.deed {
        Deed::Begin => None,
        Deed::Finish(outputs) => Some((done.instance, done.timestamp, outputs.clone())),
    });
    finished.collect()
}

/// A stub that takes what its instance wrote in the whole robot.
trait Feed {
    fn announce(&mut self, timestamp: Timestamp);
    fn complete(&mut self, outputs: &Outputs);
}

impl<T: DeserializeOwned> Feed for Stub<T> {
    fn announce(&mut self, timestamp: Timestamp) {
        Stub::announce(self, timestamp).expect("it is what happened");
    }

    fn complete(&mut self, outputs: &Outputs) {
        let outputs = serde_json::from_value(Value::Object(outputs.clone()));
        let outputs = outputs.expect("the stub has the outputs of its instance");
        Stub::complete(self, outputs).expect("it is announced");
    }
}

/// Runs a partial robot whose stubs are fed with what happened in the whole one; gives what its own instances did.
fn fed<P>(
    whole: &[Done],
    hardware: &Hardware,
    mut robot: Robot<P>,
    mut stubs: BTreeMap<&str, &mut dyn Feed>,
) -> Vec<(&'static str, Timestamp, Outputs)> {
    let mut lockstep = Lockstep::new(&mut robot, hardware);
    let mut finished = Vec::new();
    let mut note = |instance: &dyn Instance| {
        let name = instance.description().name;
        finished.push((name, instance.cycle().time.start, outputs(instance)));
    };
    for done in whole {
        let Some(stub) = stubs.get_mut(done.instance) else {
            continue;
        };
        // Whatever finishes does so before anything of that time begins.
        let before = Timestamp::from_nanos(done.at.as_nanos() - 1);
        lockstep
            .run_until(before, &mut note)
            .expect("the zoo does not stop");
        match &done.deed {
            Deed::Begin => {
                run_to_event_of(done.instance, &mut lockstep, &mut note);
                assert_eq!(lockstep.robot().clock.now(), done.at);
                stub.announce(done.timestamp);
            }
            Deed::Finish(outputs) => stub.complete(outputs),
        }
    }
    lockstep
        .run_until(END, &mut note)
        .expect("the zoo does not stop");
    finished
}

/// Steps until the hardware has an event of an instance that is left out.
fn run_to_event_of<P>(
    left_out: &str,
    lockstep: &mut Lockstep<'_, P>,
    note: &mut dyn FnMut(&dyn Instance),
) {
    while let Some(stepped) = lockstep.step().expect("the zoo does not stop") {
        match stepped.step {
            Step::LeftOut if stepped.instance == left_out => return,
            Step::Finished(Finished::Completed) => {
                let instance = lockstep.robot().instance(stepped.instance);
                note(instance.expect("it was just turned"));
            }
            _ => {}
        }
    }
    panic!("the hardware has no event of {left_out}");
}

#[test]
fn fed_with_what_happened_in_the_whole_robot_a_partial_one_does_the_same() {
    let whole = whole();
    let (hardware, (robot, mut stubs)) = created(zoo_control_runtime::runtime::create);
    let feeds: BTreeMap<&str, &mut dyn Feed> = BTreeMap::from([
        (stubs.vision_top.instance(), &mut stubs.vision_top as _),
        (
            stubs.vision_bottom.instance(),
            &mut stubs.vision_bottom as _,
        ),
        (stubs.hearing.instance(), &mut stubs.hearing as _),
    ]);
    let control = fed(&whole, &hardware, robot, feeds);
    assert_eq!(control.len(), 250);
    assert_eq!(control, cycles(&whole, &["Control"]));

    let (hardware, (robot, mut stubs)) =
        created(zoo_vision_reflexes_lights_runtime::runtime::create);
    let feeds = BTreeMap::from([("Control", &mut stubs.control as &mut dyn Feed)]);
    let others = fed(&whole, &hardware, robot, feeds);
    let names = ["VisionTop", "VisionBottom", "Reflexes", "Lights"];
    assert!(others.len() > 480, "only {} cycles", others.len());
    assert_eq!(others, cycles(&whole, &names));
}

fn millis(millis: u64) -> Timestamp {
    Timestamp::from_nanos(millis * 1_000_000)
}

#[test]
fn until_a_stub_is_fed_nobody_has_written_it() {
    let create = zoo_vision_reflexes_lights_runtime::runtime::create;
    let (hardware, (mut robot, mut stubs)) = created(create);
    let mut lockstep = Lockstep::new(&mut robot, &*hardware);
    let horizons = |lockstep: &mut Lockstep<'_, _>, end| {
        let mut horizons = Vec::new();
        let note = |instance: &dyn Instance| {
            if instance.description().name == "VisionTop" {
                horizons.push(outputs(instance)["horizon"].clone());
            }
        };
        lockstep
            .run_until(end, note)
            .expect("the zoo does not stop");
        horizons
    };
    // Of the newest cycle everything is required.
    assert_eq!(horizons(&mut lockstep, millis(200)), vec![Value::Null; 5]);
    let position = Some(Point { x: 1.5, y: 0.0 });
    let outputs = control::SharedOutputs {
        pose: Pose {
            position,
            heading: 0.25,
        },
        target: Some(Spot {
            x: 0.5,
            brightness: 1.0,
        }),
    };
    (stubs.control.feed(millis(200), outputs)).expect("it is 200 ms");
    let found = json!(2.25);
    let expected = [Value::Null, found.clone(), found];
    // The first had begun before.
    assert_eq!(horizons(&mut lockstep, millis(300)), expected);
}

#[test]
fn who_reads_stubs_in_order_of_time_waits_for_what_they_announce() {
    let (hardware, (mut robot, mut stubs)) = created(zoo_control_runtime::runtime::create);
    let mut lockstep = Lockstep::new(&mut robot, &*hardware);
    // Whistles that are certain to be heard in their turn, and the loudness of those that are not.
    let heard = |lockstep: &mut Lockstep<'_, _>, end| {
        let mut heard = Vec::new();
        let note = |instance: &dyn Instance| {
            let report = &outputs(instance)["report"];
            let read = |path| report.pointer(path).and_then(Value::as_f64);
            heard.push((read("/nested/plain"), read("/certainty")));
        };
        lockstep
            .run_until(end, note)
            .expect("the zoo does not stop");
        heard
    };
    assert_eq!(heard(&mut lockstep, millis(100)).len(), 8);
    stubs
        .vision_top
        .announce(millis(100))
        .expect("it is 100 ms");
    heard(&mut lockstep, millis(110));
    let whistle = Some(Whistle { loudness: 0.5 });
    let outputs = hearing::SharedOutputs {
        loudness: 0.5,
        whistle,
    };
    stubs
        .hearing
        .feed(millis(105), outputs)
        .expect("it is 110 ms");
    let waiting = (Some(0.0), Some(0.5));
    assert_eq!(heard(&mut lockstep, millis(144)), [waiting; 3]);
    let outputs = vision::SharedOutputs {
        spots: vec![Spot {
            x: 3.0,
            brightness: 1.0,
        }],
        ..vision::SharedOutputs::default()
    };
    stubs.vision_top.complete(outputs).expect("it is announced");
    let delivered = [(Some(1.0), Some(0.0)), (Some(0.0), Some(0.0))];
    assert_eq!(heard(&mut lockstep, millis(168)), delivered);
    let queues = lockstep.robot().instances[0].report().queues;
    let delivered = queues.iter().map(|one| (one.from, one.counts.delivered));
    let delivered: Vec<_> = delivered.collect();
    assert_eq!(
        delivered,
        [("VisionTop", 1), ("VisionBottom", 0), ("Hearing", 1)]
    );
}

#[test]
fn parameters_of_nodes_that_are_left_out_are_no_mistakes_and_others_are() {
    use zoo_control_runtime::parameters::Parameters as Control;
    use zoo_runtime::parameters::Parameters as Whole;

    let of_control = parameters::<Control>(&[]).expect("values of other nodes stand beside");
    assert_eq!(of_control.walking_speed, 0.2);
    let said = |result: framework::Result<()>| result.err().map(|error| format!("{error:#}"));
    // Where other nodes read nothing nothing else may stand.
    let misspelt = [("gait.perod", "1.0")];
    for result in [
        parameters::<Control>(&misspelt).map(drop),
        parameters::<Whole>(&misspelt).map(drop),
    ] {
        let said = said(result).expect("nobody reads it");
        assert!(said.contains("did you mean `period`?"), "{said}");
    }
    // Only the whole robot knows what others read.
    let misspelt = [("exposure.vision_topp", "1.0")];
    let result = parameters::<Control>(&misspelt).map(drop);
    assert_eq!(said(result), None);
    assert!(said(parameters::<Whole>(&misspelt).map(drop)).is_some());
}
