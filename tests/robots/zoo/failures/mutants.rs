//! One bit of each output of every node is flipped in one cycle, and the verification of a recording names exactly that.
//!
//! Run by `tests/tests/failures.rs`, which generates the robot and says which outputs there are, and in which instances.
//! Prints a line for each bit that was named: instance, node, output, and the place in it where the recording has the value.

use std::path::Path;
use std::sync::Arc;

use framework::parameters::Layers;
use framework::recorded::{About, Recording, Settings};
use framework::replay::{Players, verify, Shelf};
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

/// Calls of the node in each instance while all of its cycles run that a verification runs, too; in the order of their runs.
fn calls(file: &File, flip: &Flip) -> Vec<(&'static str, u64)> {
    let shelf = Shelf::of(file).expect("it is of this version");
    let mut players = Players::new(&shelf, INSTANCES).expect("it is of this robot");
    let mut calls = Vec::new();
    for (player, chunks) in players.each() {
        let never = u64::MAX;
        flip::arm(Flip { after: never, ..flip.clone() });
        for position in 0..player.frames.len() {
            if player.frames[position].is_finished() {
                player.play(position, chunks).expect("it is of this robot");
            }
        }
        let left = flip::left().expect("it was left as it is");
        calls.push((player.instance, never - left));
    }
    calls
}

/// The instance and the cycle in which the bit is flipped.
fn flipped_in(file: &File) -> (&'static str, u64) {
    let shelf = Shelf::of(file).expect("it is of this version");
    let mut players = Players::new(&shelf, INSTANCES).expect("it is of this robot");
    for (player, chunks) in players.each() {
        for position in 0..player.frames.len() {
            if !player.frames[position].is_finished() {
                continue;
            }
            player.play(position, chunks).expect("it is of this robot");
            if flip::left().is_none() {
                return (player.instance, player.frames[position].head.number);
            }
        }
    }
    panic!("no cycle has a bit of it to flip");
}

/// Flips a bit of an output in one instance; gives the place in it, where the verification tells that.
fn mutate(file: &File, [instance, node, output]: [&str; 3]) -> Option<String> {
    let mut flip = Flip {
        node: node.to_owned(),
        output: output.to_owned(),
        after: 0,
    };
    let calls = calls(file, &flip);
    let before = calls.iter().take_while(|(name, _)| *name != instance);
    flip.after = before.map(|(_, calls)| calls).sum::<u64>() + AFTER;
    flip::arm(flip.clone());
    let (whose, cycle) = flipped_in(file);
    assert_eq!(whose, instance, "its cycles have no bit of `{output}` to flip");
    flip::arm(flip);
    let verification = verify(file, INSTANCES).expect("it is of this robot");
    let diverged: u64 = verification.instances.iter().map(|one| one.diverged).sum();
    assert_eq!(diverged, 1, "{verification}");
    assert!(!verification.is_good(), "{verification}");
    let found = verification.divergence.as_ref().expect("a bit differs");
    assert_eq!(
        (found.instance, found.cycle, &*found.node, &*found.output),
        (instance, cycle, node, output),
        "{verification}"
    );
    assert!(found.recomputed.is_some(), "{verification}");
    // Where the recording has the value, too, the place in it is known.
    let (recorded, recomputed) = (found.recorded.as_ref()?, found.recomputed.as_ref()?);
    let place = |value: &Value| {
        let parts = found.path.split('.').filter(|part| !part.is_empty());
        let pointer: String = parts.map(|part| format!("/{part}")).collect();
        value.pointer(&pointer).cloned()
    };
    let places = (place(recorded), place(recomputed));
    assert!(places.0.is_some() && places.1.is_some(), "{verification}");
    assert_ne!(places.0, places.1, "{verification}");
    Some(found.path.clone())
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
    for mutant in plan.as_array().expect("a list of mutants") {
        let mutant = [0, 1, 2].map(|part| mutant[part].as_str().expect("a name"));
        let name = mutant.join(" ");
        eprintln!("{name}");
        match mutate(&file, mutant) {
            Some(place) => println!("{name} at `{place}`"),
            None => println!("{name}"),
        }
    }
}
