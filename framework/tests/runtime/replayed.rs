//! Recorded cycles of a hand-written body run again, each for itself and on a timeline.

use std::path::Path;
use std::time::Duration;

use framework::recorded::{About, Recording, Settings, describe};
use framework::replay::{Alone, Move, Players, Ran, Replay, Replayable, Shelf, Timeline};
use framework::{
    AdditionalSlot, Clock, Cycler, Guarded, Lockstep, OnFailure, Stop, Subscriptions, Swap,
    Timestamp, buffer, buffer_of, procedure,
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

#[test]
fn a_recording_is_never_written_over() {
    let folder = tempfile::tempdir().expect("a temporary directory");
    let path = folder.path().join("run.mcap");
    std::fs::write(&path, "a game").expect("the folder is ours");
    let hardware = ScriptedHardware::lockstep([]);
    let robot = robot(&hardware, &Setting::default());
    let recording = Recording::start(&path, &robot, About::default(), Settings::default());
    let error = recording.err().expect("it is there").to_string();
    assert!(
        error.contains("it is there, and nothing is written over; name another file"),
        "{error}"
    );
    assert_eq!(std::fs::read_to_string(&path).expect("it stays"), "a game");
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

const SLOW: Replayable = Replayable {
    create: |_, _| Ok(legs(Act::Take(5))),
    ..FAILING
};

const QUICK: Replayable = Replayable {
    create: |_, _| Ok(legs(Act::Work)),
    ..FAILING
};

fn timeline(shelf: &Shelf, one: Replayable) -> Timeline<'_> {
    let players = Players::new(shelf, &[one]).expect("it is of this version");
    let made = Timeline::new("test", players, Parameters { gain: 1 }, &Stop::new());
    let (mut timeline, _) = made.expect("it has cycles");
    let fast = Move {
        speed: Some(1000.0),
        ..Move::default()
    };
    timeline.go(&fast).expect("it is a speed");
    timeline
}

#[test]
fn the_fifth_cycle_that_fails_does_so_for_its_own_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = recorded(folder.path());
    let shelf = Shelf::of(&file).expect("it is of this version");
    let mut players = Players::new(&shelf, &[FAILING]).expect("it is of this version");
    let (player, chunks) = players.of("Legs").expect("it is an instance");
    let reasons = (0..8).map(|position| player.play(position, chunks));
    let reasons: Vec<_> = reasons
        .map(|ran| ran.expect("the frame is whole"))
        .collect();
    let own = (1..=8)
        .map(|cycle| Ran::Failed(format!("node `test::worker` in cycle {cycle}: as scripted")));
    assert_eq!(reasons, own.collect::<Vec<_>>());
}

#[test]
fn time_waits_for_cycles_that_are_slower_than_it_and_drops_what_it_has_too_much() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = recorded(folder.path());
    let shelf = Shelf::of(&file).expect("it is of this version");
    let mut timeline = timeline(&shelf, QUICK);
    let mut left = 3;
    let mut three = || {
        left -= 1;
        left > 0
    };
    let second = Duration::from_secs(1);
    timeline.advance_while(second, &mut three);
    let place = timeline.place();
    assert_eq!(
        (place.instances[0].cycle, place.is_playing),
        (Some(3), true)
    );
    // They were captured 5 ms before they came.
    assert!((place.time - 0.015).abs() < 1e-9, "{place:?}");
    // Nothing of the second is left: not even the next cycle is due.
    timeline.advance(Duration::from_micros(9));
    assert_eq!(timeline.place().instances[0].cycle, Some(3));
    timeline.advance_while(second, &mut || false);
    assert_eq!(timeline.place().instances[0].cycle, Some(4));

    let back = Move {
        speed: Some(-1000.0),
        ..Move::default()
    };
    timeline.go(&back).expect("it is a speed");
    timeline.advance_while(second, &mut || false);
    let place = timeline.place();
    assert_eq!(
        (place.instances[0].cycle, place.is_playing),
        (Some(3), true)
    );
    timeline.advance(second);
    let place = timeline.place();
    assert_eq!(
        (place.instances[0].cycle, place.is_playing),
        (Some(1), false)
    );
}

#[test]
fn a_replay_that_is_slower_than_its_speed_looks_up_meanwhile() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = recorded(folder.path());
    let shelf = Shelf::of(&file).expect("it is of this version");
    let mut timeline = timeline(&shelf, SLOW);
    // All cycles would take half a second at least, and are due after one of its thousandths.
    timeline.run(&Stop::new(), Some(Duration::from_millis(100)));
    let place = timeline.place();
    assert!(place.is_playing && place.time < place.ends, "{place:?}");
}
