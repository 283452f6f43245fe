//! One bit of each output of every node is flipped in one cycle, and the verification of a recording names exactly that.
//!
//! Run by `tests/tests/failures.rs`, which generates the robot and says which outputs there are. Prints a line for each bit.

use std::path::Path;
use std::sync::Arc;

use framework::parameters::Layers;
use framework::recorded::{About, Recording, Settings};
use framework::replay::{Players, Source, value_channels, verify};
use framework::testing::created;
use framework::{Clock, Lockstep, ParameterData, Record, Robot, Start, Stop, Timestamp};
use hulkgen_recording::Recording as File;
use serde_json::Value;
use stop_runtime::recording::INSTANCES;
use zoo_hardware::Hardware;
use zoo_nodes::flip::{self, Flip};

/// Seconds.
const LENGTH: f64 = 2.0;

/// Calls of a node that leave its output as it is.
const AFTER: u64 = 7;

fn record<P: ParameterData>(
    path: &Path,
    create: impl Fn(&Arc<Hardware>, Start<P>) -> framework::Result<Robot<P>>,
) {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/../parameters").into();
    let layers = Layers {
        directory,
        ..Layers::default()
    };
    let (clock, stop) = (Clock::stepped(), Stop::default());
    let (hardware, mut robot) = created(&layers, "loud", &[], &clock, &stop, create);
    let settings = Settings {
        blocks: 256,
        ..Settings::default()
    };
    let mut recording =
        Recording::start_with(path, &robot, About::default(), settings, |_| Record::On)
            .expect("the folder is empty");
    let mut lockstep =
        Lockstep::new(&mut robot, &*hardware).observed(|instance| recording.observer(instance));
    let end = Timestamp::from_nanos((LENGTH * 1e9) as u64);
    lockstep.run_until(end, |_| {}).expect("no node fails");
    drop(lockstep);
    assert!(recording.end().ended.is_complete, "something was dropped");
}

/// The instance and the cycle in which the bit is flipped.
fn flipped_in(file: &File) -> (&'static str, u64) {
    let values = value_channels(file).expect("it is of this version");
    let mut players = Players::new(file, &values, INSTANCES).expect("it is of this robot");
    let all: Vec<_> = (players.players.iter())
        .map(|player| {
            let cycles = player.frames.iter().map(|frame| frame.head.number);
            (player.instance, cycles.collect::<Vec<_>>())
        })
        .collect();
    for (instance, cycles) in all {
        for (position, cycle) in cycles.into_iter().enumerate() {
            players.play(instance, position).expect("it is of this robot");
            if !flip::is_armed() {
                return (instance, cycle);
            }
        }
    }
    panic!("no cycle has a bit of it to flip");
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().expect("where to record");
    let plan: Value = serde_json::from_str(&arguments.next().expect("the plan")).expect("JSON");
    let path = Path::new(&path);
    record(path, stop_runtime::runtime::create);
    let file = File::open(path).expect("it was written");
    let verification = verify(&file, INSTANCES).expect("it is of this robot");
    assert!(verification.is_good(), "without a mutant: {verification}");
    for node in plan.as_array().expect("a list of nodes") {
        let name = node["path"].as_str().expect("a path");
        // What setup nodes write stands in the frames; they are not called.
        if node["setup"] == true {
            continue;
        }
        for output in node["outputs"].as_array().expect("a list of outputs") {
            let output = output.as_str().expect("a name");
            let flip = Flip {
                node: name.to_owned(),
                output: output.to_owned(),
                after: AFTER,
            };
            println!("{name} {output}");
            flip::arm(flip.clone());
            let (instance, cycle) = flipped_in(&file);
            flip::arm(flip);
            let verification = verify(&file, INSTANCES).expect("it is of this robot");
            let diverged: u64 = verification.instances.iter().map(|one| one.diverged).sum();
            assert_eq!(diverged, 1, "{verification}");
            assert!(!verification.is_good(), "{verification}");
            let found = verification.divergence.as_ref().expect("a bit differs");
            assert_eq!(
                (found.instance, found.cycle, &*found.node, &*found.output),
                (instance, cycle, name, output),
                "{verification}"
            );
            assert!(found.recomputed.is_some(), "{verification}");
            // Where the recording has the value, too, the place in it is known.
            if let (Some(recorded), Some(recomputed)) = (&found.recorded, &found.recomputed) {
                let place = |value: &Value| {
                    let parts = found.path.split('.').filter(|part| !part.is_empty());
                    let pointer: String = parts.map(|part| format!("/{part}")).collect();
                    value.pointer(&pointer).cloned()
                };
                let places = (place(recorded), place(recomputed));
                assert!(places.0.is_some() && places.1.is_some(), "{verification}");
                assert_ne!(places.0, places.1, "{verification}");
                println!("{name} {output} at `{}`", found.path);
            }
        }
    }
}
