//! Recorded cycles of a hand-written body run again.

use std::path::Path;

use framework::recorded::{About, Recording, Settings, describe};
use framework::replay::{Alone, Players, Ran, Replay, Replayable, value_channels};
use framework::{
    AdditionalSlot, Clock, Cycler, Guarded, Lockstep, OnFailure, Subscriptions, Swap, Timestamp,
    buffer, buffer_of, procedure,
};
use hulkgen_recording::Recording as File;

use crate::body::{Parameters, Perception, Plan, Receiver, Setting, TestBody, Worker, robot};
use crate::scripted::{Act, Script, ScriptedHardware};

/// Recorded cycles of `Legs`, 10 ms apart.
const CYCLES: u64 = 100;

fn recorded(folder: &Path) -> File {
    let path = folder.join("run.mcap");
    let events = (0..CYCLES).map(|cycle| (cycle * 10, "Legs"));
    let hardware = ScriptedHardware::lockstep(events);
    let mut robot = robot(&hardware, &Setting::default());
    let recording = Recording::start(&path, &robot, About::default(), Settings::default());
    let mut recording = recording.expect("the folder is empty");
    let mut lockstep =
        Lockstep::new(&mut robot, &*hardware).observed(|instance| recording.observer(instance));
    let ran = lockstep.run_until(Timestamp::NEVER, |_| {});
    ran.expect("nothing stops the robot");
    drop(lockstep);
    assert!(recording.end().ended.is_complete);
    File::open(&path).expect("it was written")
}

/// `Legs` alone, whose worker does so in every cycle.
fn legs(act: Act) -> Box<dyn Replay> {
    let hardware = ScriptedHardware::lockstep([]);
    let on_failure = OnFailure::Restart;
    let (writer, [], []) = buffer([]);
    let (_, [parameters], []) = buffer_of(Parameters::default, []);
    let (_, [injections], []) = buffer([]);
    let (_, double) = procedure();
    let subscriptions = Subscriptions::new(&["debug.raw"]);
    let body = TestBody {
        name: "Legs",
        receiver: Guarded::new("test::receiver", on_failure, Receiver::default()),
        worker: Guarded::new("test::worker", on_failure, Worker::default()),
        own: Swap::default(),
        debug: AdditionalSlot::default(),
        subscribed: false,
        hardware: hardware.clone(),
        parameters,
        injections,
        subscriptions: subscriptions.clone(),
        double,
        perception: Perception::default(),
        on_failure,
        plan: Plan {
            work: Script::new((0..10 * CYCLES).map(|_| act)),
            ..Plan::default()
        },
    };
    let robot = robot(&hardware, &Setting::default());
    let description = *robot.instances[1].description();
    let cycler = Cycler::new(description, body, writer, Clock::stepped());
    Box::new(Alone::new(cycler, (), subscriptions))
}

const FAILING: Replayable = Replayable {
    instance: "Legs",
    create: |_, _| Ok(legs(Act::Fail)),
    types: describe::<TestBody>,
};

#[test]
fn the_fifth_cycle_that_fails_does_so_for_its_own_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = recorded(folder.path());
    let values = value_channels(&file).expect("it is of this version");
    let mut players = Players::new(&file, &values, &[FAILING]).expect("it is of this version");
    let (player, chunks) = players.of("Legs").expect("it is an instance");
    let reasons = (0..8).map(|position| player.play(position, chunks));
    let reasons: Vec<_> = reasons
        .map(|ran| ran.expect("the frame is whole"))
        .collect();
    let own = (1..=8)
        .map(|cycle| Ran::Failed(format!("node `test::worker` in cycle {cycle}: as scripted")));
    assert_eq!(reasons, own.collect::<Vec<_>>());
}
