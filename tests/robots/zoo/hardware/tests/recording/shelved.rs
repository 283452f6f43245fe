//! A recording of which few chunks are in memory, and one that changes while it is replayed.

use std::fs;
use std::time::Duration;

use framework::Stop;
use framework::recorded::Loading;
use framework::replay::{
    Comparison, How, Move, OtherParameters, Players, Shelf, Timeline, compare, first_parameters,
    verify_how, with_settings,
};
use zoo_runtime::parameters::Parameters;
use zoo_runtime::recording;

use super::asked::GRAPH;
use super::{SMALL, Tape, as_it_is, on, record_in_lockstep};

fn recorded() -> Tape {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, SMALL, on, &as_it_is);
    tape
}

/// What another speed changes, cycle after cycle.
fn under(shelf: &Shelf) -> Comparison {
    let settings = [("walking_speed".to_owned(), "0.9".to_owned())];
    let other = OtherParameters::new(shelf, &mut |recorded| {
        with_settings::<Parameters>(recorded, &settings)
    });
    let other = other.expect("it is a parameter");
    let players = || Players::new(shelf, recording::INSTANCES).expect("it fits");
    let after = players().under(&other).carrying(GRAPH);
    let mut after = after.expect("it is a graph");
    compare(&mut players(), &mut after, None).expect("both answer")
}

/// From its first cycle to its last, and back.
fn play(shelf: &Shelf) {
    let players = Players::new(shelf, recording::INSTANCES).expect("it fits");
    let first = first_parameters(shelf).expect("it can be read");
    let first = first.expect("they were recorded");
    let parameters: Parameters = Loading::new(&first).take().expect("they are of this robot");
    let made = Timeline::new("zoo", players, parameters, &Stop::default());
    let (mut timeline, _link) = made.expect("it has cycles");
    timeline.follow_parameters();
    timeline.say_again();
    timeline.advance(Duration::from_secs(3600));
    let there = timeline.place();
    assert!(there.time == there.ends && !there.is_playing, "{there:?}");
    let back = Move {
        play: Some(true),
        speed: Some(-1.0),
        ..Move::default()
    };
    timeline.go(&back).expect("it is a speed");
    timeline.advance(Duration::from_secs(3600));
    let back = timeline.place();
    assert!(back.time == back.begins, "{back:?}");
}

#[test]
fn with_room_for_few_chunks_a_recording_gives_the_same_answers() {
    let tape = recorded();
    let file = tape.read();
    let sizes = file.chunks.iter().map(|chunk| chunk.bytes().len());
    let largest = sizes.clone().max().expect("it has chunks");
    let (room, all) = (2 * largest, sizes.sum::<usize>());
    assert!(all > room, "{all} bytes fit into {room}");
    let open = |room| {
        let shelf = Shelf::open(&tape.path).expect("it is a recording");
        shelf.keeping(room)
    };
    let shelf = open(room);
    let verified = verify_how(&shelf, recording::INSTANCES, &How::default());
    let verified = verified.expect("it is of this robot");
    assert!(verified.is_good(), "{verified}");
    assert_eq!(verified, tape.verify());
    // However many instances have cycles in a chunk, it is read once for all of them.
    assert_eq!(shelf.reads(), file.chunks.len() as u64);
    let compared = under(&shelf);
    assert!(
        compared.is_good() && !compared.changes.is_empty(),
        "{compared}"
    );
    assert_eq!(
        compared,
        under(&Shelf::of(&file).expect("it is a recording"))
    );
    play(&shelf);
    let most = shelf.most_held();
    assert!(most > 0 && most <= room, "{most} bytes were kept");

    // The count sees a shelf that lets nothing go.
    let roomy = open(usize::MAX);
    play(&roomy);
    assert_eq!(roomy.most_held(), all);
}

#[test]
fn a_file_that_changes_while_it_is_replayed_is_told_by_the_cycle_that_it_lacks() {
    let tape = recorded();
    let shelf = Shelf::open(&tape.path).expect("it is a recording");
    let shelf = shelf.keeping(0);
    let place = shelf.contents().chunks[1];
    let mut bytes = fs::read(&tape.path).expect("it is there");
    bytes[(place.offset + place.length) as usize - 1] ^= 1;
    fs::write(&tape.path, &bytes).expect("it can be written");
    let verified = verify_how(&shelf, recording::INSTANCES, &How::default());
    let verified = verified.expect("it is of this robot");
    assert!(!verified.is_good());
    let control = verified.instances.iter();
    let control = control.clone().find(|one| one.instance == "Control");
    let control = control.expect("it is an instance");
    let reason = control.unreadable.as_deref().unwrap_or_default();
    let wanted = format!(
        ": the chunk at byte {} could be read when the recording was opened, and no longer can be",
        place.offset
    );
    assert!(
        reason.starts_with("cycle ") && reason.contains(&wanted),
        "{reason}"
    );
    // What lies before it was verified, and a timeline passes over what it lacks.
    assert!(control.verified > 0, "{verified}");
    play(&shelf);
}
