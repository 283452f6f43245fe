//! A recording that clients watch: at any speed, in both directions, from any cycle.

use std::ffi::OsStr;
use std::fs;
use std::sync::Mutex;
use std::time::Duration;

use framework::recorded::{Loading, Settings};
use framework::replay::{
    Move, PROCEDURE, Players, Ran, Shelf, TIMELINE, Timeline, What, first_parameters,
};
use framework::{InstanceDescription, Record, Reflect, Stop, Target, Timestamp, launch};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use zoo_hardware::Hardware;
use zoo_runtime::parameters::Parameters;
use zoo_runtime::recording;

use super::asked::GRAPH;
use super::types::with_another_node;
use super::{INSTANCES, Tape, as_it_is, on, record_in_lockstep};

/// The cycles of Control whose output a client got since it last looked.
fn seen(link: &mut framework::link::Link) -> Vec<u64> {
    let mut instances = link.instances.iter_mut();
    let control = instances.find(|one| one.description.name == "Control");
    let mut taps = control.expect("it is an instance").taps.iter_mut();
    let tap = taps
        .find(|tap| tap.name() == "cycles")
        .expect("it is an output");
    let mut cycles = Vec::new();
    while tap.take(|tapped| cycles.push(tapped.cycle)) {}
    cycles
}

#[test]
fn time_goes_where_clients_want_it() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    let file = tape.read();
    let shelf = Shelf::of(&file).expect("it is of this version");
    let players = Players::new(&shelf, recording::INSTANCES).expect("it fits");
    let first = first_parameters(&shelf)
        .expect("it can be read")
        .expect("they were recorded");
    let parameters: Parameters = Loading::new(&first).take().expect("they are of this robot");
    let (mut timeline, mut link) =
        Timeline::new("zoo", players, parameters, &Stop::default()).expect("it has cycles");
    let names = link.instances.iter().map(|one| one.description.name);
    assert!(names.eq(INSTANCES.into_iter().chain([TIMELINE])));
    let last = link.instances.last().expect("it is there");
    assert_eq!(last.access.procedures[0].0, PROCEDURE);
    let control = link
        .instances
        .iter_mut()
        .find(|one| one.description.name == "Control");
    let mut taps = control.expect("it is an instance").taps.iter_mut();
    let tap = taps.find(|tap| tap.name() == "cycles");
    tap.expect("it is an output").open();

    let place = timeline.place();
    assert!(place.is_playing && place.time == place.begins);
    assert!(
        place.instances.iter().all(|one| one.missing == 0),
        "{place:?}"
    );
    let cycle = |timeline: &Timeline<'_>| timeline.place().instances[3].cycle;

    // A client has a window of the newest values; so much at once that all of them fit.
    timeline.advance(Duration::from_millis(30));
    let forwards = seen(&mut link);
    let count = forwards.len() as u64;
    assert!(
        count > 0 && forwards.iter().copied().eq(1..=count),
        "{forwards:?}"
    );
    timeline
        .go(&Move {
            instance: Some("Control".to_owned()),
            cycle: Some(80),
            ..Move::default()
        })
        .expect("it was recorded");
    assert_eq!(cycle(&timeline), Some(80));
    timeline
        .go(&Move {
            speed: Some(-2.0),
            ..Move::default()
        })
        .expect("it is a speed");
    timeline.advance(Duration::from_millis(12));
    let backwards = seen(&mut link);
    assert!(backwards.starts_with(&[79]), "{backwards:?}");
    assert!(
        backwards.is_sorted_by(|later, earlier| later > earlier),
        "{backwards:?}"
    );
    let shown = cycle(&timeline);
    assert_eq!(shown, backwards.last().copied());
    timeline
        .go(&Move {
            instance: Some("Control".to_owned()),
            step: Some(-4),
            ..Move::default()
        })
        .expect("it is a step");
    let stepped = shown.map(|cycle| cycle - 4);
    assert_eq!(
        (cycle(&timeline), timeline.place().is_playing),
        (stepped, false)
    );
    timeline
        .go(&Move {
            time: Some(1.0),
            ..Move::default()
        })
        .expect("it is a time");
    assert_eq!(timeline.place().time, 1.0);
    timeline
        .go(&Move {
            speed: Some(1000.0),
            play: Some(true),
            ..Move::default()
        })
        .expect("it is a speed");
    timeline.advance(Duration::from_secs(1));
    let place = timeline.place();
    assert!(!place.is_playing && place.time == place.ends, "{place:?}");
    assert!(Timestamp::from_nanos((place.ends * 1e9) as u64) > Timestamp::ZERO);

    for (wrong, message) in [
        (
            Move {
                speed: Some(f64::NAN),
                ..Move::default()
            },
            "no speed",
        ),
        (
            Move {
                cycle: Some(3),
                ..Move::default()
            },
            "whose",
        ),
        (
            Move {
                instance: Some("Nobody".to_owned()),
                ..Move::default()
            },
            "the recording has no instance `Nobody`",
        ),
        (
            Move {
                instance: Some("Control".to_owned()),
                cycle: Some(100_000),
                ..Move::default()
            },
            "was not recorded",
        ),
        (
            Move {
                time: Some(1.0),
                step: Some(1),
                ..Move::default()
            },
            "name one",
        ),
    ] {
        let error = timeline.go(&wrong).expect_err("it is not there");
        assert!(error.to_string().contains(message), "{error}");
    }
}

#[test]
fn whoever_listens_to_additional_outputs_changes_nothing_else() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    let file = tape.read();
    let shelf = Shelf::of(&file).expect("it is of this version");
    let mut players = Players::new(&shelf, recording::INSTANCES).expect("it fits");
    let (mut compared, mut filled) = (0, 0);
    for (player, chunks) in players.each() {
        for position in 0..player.frames.len() {
            let recorded = player.digests(position, chunks);
            let Some(recorded) = recorded.expect("it can be read") else {
                continue;
            };
            let ran = player.play(position, chunks).expect("the frame is whole");
            let replay = player.replay().expect("it was loaded");
            let subscriptions = replay.subscriptions();
            let names = subscriptions.names().iter();
            // From the second cycle on.
            if position == 0 {
                assert!(names.clone().all(|name| subscriptions.subscribe(name)));
            }
            if ran != Ran::Finished {
                continue;
            }
            let instance = replay.instance();
            filled += names
                .filter(|name| instance.additional_output(name).is_some())
                .count();
            let mut digests = Vec::new();
            let visited = instance.digests(&mut |_, _, digest| digests.push(digest));
            visited.expect("every output serialises");
            assert!(recorded == digests, "{} {position}", player.instance);
            compared += 1;
        }
    }
    // Of two outputs of Control and one of each eye, where their nodes run.
    assert!(compared > 300 && filled > 300, "{compared} {filled}");
}

#[test]
fn what_a_setup_node_filled_is_there_again_in_the_cycles_in_which_it_did() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    let file = tape.read();
    let shelf = Shelf::of(&file).expect("it is of this version");
    let mut players = Players::new(&shelf, recording::INSTANCES).expect("it fits");
    let mut filled = Vec::new();
    for (player, chunks) in players.each() {
        let name = match player.instance {
            "VisionTop" => "vision_top.width",
            "VisionBottom" => "vision_bottom.width",
            _ => continue,
        };
        let count = player.frames.len();
        let mut seen = vec![Vec::new(); count];
        // To the end and back again: whoever asks now changes nothing.
        for position in (0..count).chain((0..count).rev()) {
            player.play(position, chunks).expect("the frame is whole");
            let replay = player.replay().expect("it was loaded");
            replay.subscriptions().subscribe(name);
            let instance = replay.instance();
            let json = |value: &dyn Reflect| {
                serde_json::to_value(value.as_serialize()).expect("it is written as JSON")
            };
            let width = instance.additional_output(name).map(json);
            if let Some(width) = &width {
                let image = instance
                    .main_output("image")
                    .map(json)
                    .expect("it is there");
                assert_eq!(*width, image["width"], "{position}");
            }
            seen[position].push(width.is_some());
        }
        assert!(seen.iter().all(|twice| twice[0] == twice[1]), "{seen:?}");
        let first = seen.iter().position(|twice| twice[0]).unwrap_or(count);
        assert!(seen[first..].iter().all(|twice| twice[0]), "{seen:?}");
        filled.push((name, first, count - first));
    }
    // A client listens to one of both eyes from 0.2 s of 2 s on.
    let [(_, before, since), (_, never, none)] = filled[..] else {
        panic!("{filled:?}");
    };
    assert!(before > 0 && since > before, "{filled:?}");
    assert!(never == before + since && none == 0, "{filled:?}");
}

#[test]
fn cycles_that_were_not_recorded_are_told_with_their_place() {
    let tape = Tape::new();
    let record = |instance: &InstanceDescription| match instance.name {
        "Control" => Record::Every(5),
        _ => Record::On,
    };
    record_in_lockstep(&tape.path, Settings::default(), record, &as_it_is);
    let file = tape.read();
    let shelf = Shelf::of(&file).expect("it is of this version");
    let players = Players::new(&shelf, recording::INSTANCES).expect("it fits");
    let first = first_parameters(&shelf)
        .expect("it can be read")
        .expect("they were recorded");
    let parameters: Parameters = Loading::new(&first).take().expect("they are of this robot");
    let (timeline, _link) =
        Timeline::new("zoo", players, parameters, &Stop::default()).expect("it has cycles");
    let place = timeline.place();
    let control = place.instances.iter().find(|it| it.instance == "Control");
    let control = control.expect("it was recorded");
    let events = timeline.events();
    let missing: Vec<_> = events
        .iter()
        .filter(|event| event.what == What::Missing)
        .collect();
    // Between every two of them four are missing.
    assert_eq!(missing.len() + 1, control.frames, "{events:?}");
    assert_eq!(control.missing, 4 * missing.len() as u64, "{place:?}");
    for event in missing {
        assert_eq!(event.instance, "Control", "{events:?}");
        assert!(
            place.begins <= event.from && event.from < event.to && event.to <= place.ends,
            "{event:?}"
        );
    }
    // `disturb` changes them once, after a second.
    let changes = events.iter().filter(|event| event.what == What::Parameters);
    let changes: Vec<_> = changes.map(|event| event.from).collect();
    assert!(
        matches!(changes[..], [at] if (1.0..1.1).contains(&at)),
        "{events:?}"
    );
    assert!(events.is_sorted_by(|one, next| one.from <= next.from));
}

#[test]
fn a_frame_that_does_not_fit_is_passed_over() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    let file = tape.read();
    let shelf = Shelf::of(&file).expect("it is of this version");
    let mut players = Players::new(&shelf, recording::INSTANCES).expect("it fits");
    let first = first_parameters(&shelf)
        .expect("it can be read")
        .expect("they were recorded");
    let parameters: Parameters = Loading::new(&first).take().expect("they are of this robot");
    let mut foreign = players.players[0].frames[0];
    let mut control = players.players[3].frames.to_vec();
    let last = control.len() - 1;
    let (before, number) = (control[last - 1].head.number, control[last].head.number);
    foreign.head = control[last].head;
    control[last] = foreign;
    players.players[3].frames = &control;
    let (mut timeline, mut link) =
        Timeline::new("zoo", players, parameters, &Stop::default()).expect("it has cycles");
    let control = link
        .instances
        .iter_mut()
        .find(|one| one.description.name == "Control");
    let mut taps = control.expect("it is an instance").taps.iter_mut();
    let tap = taps.find(|tap| tap.name() == "cycles");
    tap.expect("it is an output").open();

    let to = |cycle| Move {
        instance: Some("Control".to_owned()),
        cycle: Some(cycle),
        play: Some(true),
        ..Move::default()
    };
    timeline.go(&to(before - 2)).expect("it was recorded");
    timeline.advance(Duration::from_secs(3600));
    assert_eq!(timeline.place().instances[3].cycle, Some(number));
    assert_eq!(seen(&mut link), [before - 1, before]);
    // It plays on.
    timeline.go(&to(before - 1)).expect("it was recorded");
    timeline.advance(Duration::from_secs(3600));
    assert_eq!(seen(&mut link), [before]);
}

/// The timeline of a recording, in which some instances are of other types.
fn timeline_of(shelf: &Shelf) -> framework::Result<(Timeline<'_>, framework::link::Link)> {
    let players = Players::new(shelf, recording::INSTANCES).expect("it is of this version");
    let first = first_parameters(shelf)
        .expect("it can be read")
        .expect("they were recorded");
    let parameters: Parameters = Loading::new(&first).take().expect("they are of this robot");
    Timeline::new("zoo", players, parameters, &Stop::default())
}

#[test]
fn an_instance_that_does_not_fit_is_left_out_and_the_others_are_shown() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    let mut file = tape.read();
    let node = with_another_node(&mut file, "Control");
    let shelf = Shelf::of(&file).expect("it is of this version");
    let (mut timeline, link) = timeline_of(&shelf).expect("the others fit");
    let names = link.instances.iter().map(|one| one.description.name);
    let fitting = INSTANCES.into_iter().filter(|name| *name != "Control");
    assert!(names.eq(fitting.clone().chain([TIMELINE])));
    timeline.advance(Duration::from_secs(3600));
    let place = timeline.place();
    assert!(!place.is_playing && place.ends > place.begins, "{place:?}");
    let shown = place.instances.iter();
    assert!(shown.clone().all(|one| one.cycle.is_some()), "{place:?}");
    assert!(shown.map(|one| &*one.instance).eq(fitting.clone()));
    let whose = Move {
        instance: Some("Control".to_owned()),
        step: Some(1),
        ..Move::default()
    };
    let error = timeline.go(&whose).expect_err("it is left out").to_string();
    assert!(error.contains("has no instance `Control`"), "{error}");

    for name in fitting {
        with_another_node(&mut file, name);
    }
    let shelf = Shelf::of(&file).expect("it is of this version");
    let Err(error) = timeline_of(&shelf) else {
        panic!("nothing fits");
    };
    let error = error.to_string();
    assert!(
        error.contains("no cycle that this robot can replay"),
        "{error}"
    );
    for name in INSTANCES {
        assert!(
            error.contains(&format!("`{name}` is not shown: ")),
            "{error}"
        );
    }
    assert!(error.contains(&node), "{error}");
}

/// What the zoo once had in place of its parameters.
#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
struct Others {
    walking_speed: f64,
}

#[test]
fn parameters_of_another_type_are_those_of_the_files() {
    const TARGET: Target = Target {
        robot: "zoo",
        name: "loud",
        parameters: "parameters",
        location: None,
        identities: &[],
        graph: GRAPH,
        recording_budget: 0,
        manifest: "",
        dataflow: "",
        replayables: recording::INSTANCES,
    };
    /// What a client sees: instances, and the parameter.
    static SEEN: Mutex<Option<(usize, Value)>> = Mutex::new(None);
    let tape = Tape::new();
    record_in_lockstep(&tape.path, Settings::default(), on, &as_it_is);
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let file = folder.path().join("default.toml");
    fs::write(file, "walking_speed = 0.75\n").expect("the folder is ours");
    let words = [
        "--replay".as_ref(),
        tape.path.as_os_str(),
        "--for=1ms".as_ref(),
        "--parameters".as_ref(),
        folder.path().as_os_str(),
    ];
    let status = launch::run::<Hardware, Others>(
        TARGET,
        words.map(OsStr::to_owned),
        &mut Vec::new(),
        |_, _| unreachable!("a replay has no robot"),
        |link, _| {
            let speed = link.parameters.read("walking_speed").expect("it is one");
            let seen = (link.instances.len(), speed.value);
            *SEEN.lock().expect("one test looks") = Some(seen);
            Ok(None)
        },
    );
    assert_eq!(status, 0);
    let seen = SEEN.lock().expect("one test looks").take();
    assert_eq!(seen, Some((INSTANCES.len() + 1, 0.75.into())));
}
