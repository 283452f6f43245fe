//! Recordings that do not have everything: the rest is recomputed all the same.

use std::time::{Duration, Instant};

use framework::recorded::{About, Recording, Settings};
use framework::replay::verify;
use framework::{Clock, Lockstep, Record, Timestamp};
use hulkgen_recording::{Recording as File, RecordingFile};
use zoo_runtime::recording;

use super::{INSTANCES, SMALL, Tape, Zoo, as_it_is, on, record_in_lockstep};

#[test]
fn an_instance_that_is_off_is_not_missed_and_not_needed() {
    let tape = Tape::new();
    let record_of = |instance: &framework::InstanceDescription| match instance.name {
        "VisionTop" | "Hearing" => Record::Off,
        _ => Record::On,
    };
    record_in_lockstep(&tape.path, SMALL, record_of, &as_it_is);
    let verification = tape.verify();
    assert!(verification.is_good(), "{verification}");
    for one in &verification.instances {
        let is_off = matches!(&*one.instance, "VisionTop" | "Hearing");
        assert_eq!(
            (one.is_off(), one.verified == 0),
            (is_off, is_off),
            "{verification}"
        );
    }
}

#[test]
fn every_fifth_cycle_is_enough() {
    let tape = Tape::new();
    let report = record_in_lockstep(&tape.path, SMALL, |_| Record::Every(5), &as_it_is);
    assert!(report.ended.is_complete, "{report}");
    let verification = tape.verify();
    assert!(verification.is_good(), "{verification}");
    let control = &verification.instances[3];
    assert!((30..50).contains(&control.frames), "{verification}");
}

#[test]
fn only_what_an_output_asks_for_is_recorded() {
    let tape = Tape::new();
    let record_of = |instance: &framework::InstanceDescription| match instance.name {
        "Reflexes" | "Control" => Record::While {
            instance: "Reflexes",
            path: "pressed",
        },
        _ => Record::On,
    };
    let report = record_in_lockstep(&tape.path, SMALL, record_of, &as_it_is);
    let verification = tape.verify();
    // The hundredth cycle says so, for the one that begins next; the next one to say so is the last.
    let reflexes = &verification.instances[4];
    assert_eq!(
        (reflexes.frames, reflexes.verified),
        (1, 1),
        "{verification}"
    );
    for one in &verification.instances[3..5] {
        assert_eq!(one.record, "while Reflexes.pressed");
        assert!(one.frames <= 1, "{verification}");
        assert_eq!(one.is_off(), one.frames == 0, "{verification}");
    }
    assert_eq!(report.instances[4].wanted, 1);
    assert!(verification.is_good(), "{verification}");
}

#[test]
fn what_a_damaged_chunk_had_is_not_taken_for_verified() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, SMALL, on, &as_it_is);
    let file = RecordingFile::open(&tape.path).expect("it can be read");
    let chunks = &file.contents().chunks;
    assert!(chunks.len() > 2, "the others can be verified");
    let place = chunks[1].offset;
    let mut bytes = std::fs::read(&tape.path).expect("it was written");
    bytes[place as usize + 100] ^= 1;
    let damaged = File::read(&bytes).expect("the others can be read");
    let verification = verify(&damaged, recording::INSTANCES).expect("it is of this robot");
    assert!(
        verification.instances.iter().all(|one| one.is_good()),
        "{verification}"
    );
    assert!(!verification.is_good() && !verification.is_complete);
    let said = verification.to_json();
    assert_eq!(
        (&said["good"], &said["complete"]),
        (&false.into(), &false.into())
    );
    assert_eq!(said["damaged"], serde_json::json!([place]));
}

#[test]
fn what_an_output_asked_for_is_in_the_file_while_it_asks_for_nothing_more() {
    let tape = Tape::new();
    let mut zoo = Zoo::new(Clock::stepped());
    let settings = Settings {
        longest: Duration::from_millis(200),
        ..SMALL
    };
    let record_of = |instance: &framework::InstanceDescription| match instance.name {
        "Reflexes" => Record::While {
            instance: "Reflexes",
            path: "pressed",
        },
        _ => Record::Off,
    };
    let about = About::default();
    let recording = Recording::start_with(&tape.path, &zoo.robot, about, settings, record_of);
    let mut recording = recording.expect("the folder is empty");
    let hardware = zoo.hardware.clone();
    let mut lockstep =
        Lockstep::new(&mut zoo.robot, &*hardware).observed(|instance| recording.observer(instance));
    // A second after it began, one cycle is asked for; the next one a second later.
    lockstep
        .run_until(Timestamp::from_nanos(1_500_000_000), |_| {})
        .expect("the zoo goes on");
    let begun = Instant::now();
    while frames_of_reflexes(&tape) == 0 {
        let is_late = begun.elapsed() > Duration::from_secs(20);
        assert!(!is_late, "the frame waits for a next one");
        std::thread::sleep(Duration::from_millis(5));
    }
    drop(lockstep);
    let report = recording.end();
    assert!(report.ended.is_complete, "{report}");
    assert_eq!(frames_of_reflexes(&tape), 1);
}

/// Beginnings of cycles that the file has by now; it is still being written.
fn frames_of_reflexes(tape: &Tape) -> usize {
    let file = tape.read();
    let mut channels = file.channels.iter();
    let (number, _) = channels
        .find(|(_, channel)| channel.topic == "frames/Reflexes")
        .expect("it has a channel");
    let messages = file.chunks.iter().flat_map(|chunk| chunk.messages());
    let own = messages.filter(|message| message.channel == *number);
    own.filter(|message| message.data.first() == Some(&0))
        .count()
}

#[test]
fn what_no_cycle_can_ask_for_is_told_before_there_is_a_file() {
    let tape = Tape::new();
    let zoo = Zoo::new(Clock::stepped());
    let told = |asked: Record| {
        let about = About::default();
        let recording = Recording::start_with(&tape.path, &zoo.robot, about, SMALL, |_| asked);
        let error = recording.err().map(|error| error.to_string());
        assert!(!tape.path.exists(), "{error:?}");
        error.unwrap_or_default()
    };
    let asks = |path| Record::While {
        instance: "Control",
        path,
    };
    assert!(told(asks("passed")).contains("it writes no such output; there are joints, seen"));
    assert!(told(asks("report.bast")).contains("no `bast`"));
    assert!(told(asks("report.best.x")).contains("that is `f32` and no `bool`"));
    assert!(told(asks("target")).contains("and no `bool`"));
    assert!(told(asks("plan..x")).contains("plan..x"));
}

/// Says so in its hundredth cycle for the first time.
const WHEN_PRESSED: Record = Record::While {
    instance: "Reflexes",
    path: "pressed",
};

/// The bytes of a file that ends before the hundredth cycle.
fn record_before_it_is_pressed(tape: &Tape, record_of: impl Fn(&str) -> Record) -> Vec<u8> {
    let mut zoo = Zoo::new(Clock::stepped());
    let record_of = |instance: &framework::InstanceDescription| record_of(instance.name);
    let _ = std::fs::remove_file(&tape.path);
    let about = About::default();
    // Each instance is in many chunks.
    let settings = Settings {
        blocks: 2048,
        block_bytes: 4 << 10,
        chunk_bytes: 4 << 10,
        longest: Duration::from_millis(100),
        ..SMALL
    };
    let recording = Recording::start_with(&tape.path, &zoo.robot, about, settings, record_of);
    let mut recording = recording.expect("the folder is empty");
    let hardware = zoo.hardware.clone();
    let mut lockstep =
        Lockstep::new(&mut zoo.robot, &*hardware).observed(|instance| recording.observer(instance));
    let end = Timestamp::from_nanos(900_000_000);
    lockstep.run_until(end, |_| {}).expect("the zoo goes on");
    drop(lockstep);
    recording.end();
    std::fs::read(&tape.path).expect("it was written")
}

fn lights_when_pressed(name: &str) -> Record {
    match name {
        "Lights" => WHEN_PRESSED,
        _ => Record::On,
    }
}

/// Where the first record of what the end says begins; all chunks stand before it.
fn end_of_chunks(bytes: &[u8]) -> usize {
    let mut places = bytes.windows(10);
    let name = places.position(|place| place == b"\x06\0\0\0wanted");
    name.expect("the end says it")
}

/// That nothing is wrong with `Lights`, which has no frame.
fn assert_never_asked_for(file: &File, wanted: Option<u64>) {
    let verification = verify(file, recording::INSTANCES).expect("it is of this robot");
    assert!(verification.is_good(), "{verification}");
    let lights = &verification.instances[5];
    assert_eq!((lights.wanted, lights.frames), (wanted, 0));
    let text = verification.to_string();
    let said = "not recorded: never asked for (while Reflexes.pressed)";
    assert!(text.contains(said), "{text}");
    assert!(!text.contains("nothing verified"), "{text}");
}

#[test]
fn what_was_never_asked_for_is_no_failure_where_the_file_breaks_off_either() {
    let tape = Tape::new();
    let bytes = record_before_it_is_pressed(&tape, lights_when_pressed);
    for (kept, wanted) in [(bytes.len(), Some(0)), (end_of_chunks(&bytes), None)] {
        let file = File::read(&bytes[..kept]).expect("it begins as a recording");
        assert_never_asked_for(&file, wanted);
    }
    // Nobody says that something was verified, or of one that is always recorded that it had no cycle.
    let bytes = record_before_it_is_pressed(&tape, |_| WHEN_PRESSED);
    let file = File::read(&bytes[..bytes.len() - 1]).expect("it begins as a recording");
    let verification = verify(&file, recording::INSTANCES).expect("it is of this robot");
    assert!(!verification.is_good(), "{verification}");
    let mut one = verification.instances[5].clone();
    assert!(one.was_never_asked_for() && one.is_good());
    (one.record, one.wanted) = ("on".to_owned(), None);
    assert!(!one.is_good());
}

#[test]
fn what_was_never_asked_for_is_no_failure_of_a_recovered_file_either() {
    let tape = Tape::new();
    let bytes = record_before_it_is_pressed(&tape, lights_when_pressed);
    let whole = File::read(&bytes).expect("it was written");
    let all = whole.chunks.len();
    assert!(all > 3, "{all} chunks");
    let last = whole.chunks[all - 1].offset as usize;
    // Nothing is lost; what the end says; all of that and half a chunk.
    for (kept, chunks, wanted) in [
        (bytes.len(), all, Some(0)),
        (end_of_chunks(&bytes), all, None),
        (last + 100, all - 1, None),
    ] {
        let (cut, into) = (
            tape.path.with_extension("cut"),
            tape.path.with_extension("new"),
        );
        std::fs::write(&cut, &bytes[..kept]).expect("the folder is ours");
        let file = RecordingFile::open(&cut).expect("it begins as a recording");
        hulkgen_mcap::recover(&file, &into).expect("there is room");
        let recovered = File::open(&into).expect("it was written");
        std::fs::remove_file(&into).expect("it was written");
        assert!(recovered.metadata("recovered").is_some());
        assert_eq!(recovered.chunks.len(), chunks);
        assert_never_asked_for(&recovered, wanted);
    }
}

#[test]
fn what_does_not_fit_is_dropped_and_counted() {
    let tape = Tape::new();
    let settings = Settings {
        blocks: 2,
        block_bytes: 2 << 10,
        ..SMALL
    };
    let report = record_in_lockstep(&tape.path, settings, on, &as_it_is);
    assert_eq!(report.state(), "INCOMPLETE");
    let verification = tape.verify();
    let dropped: u64 = verification.instances.iter().map(|one| one.dropped).sum();
    assert!(dropped > 0, "{verification}");
    for (one, told) in verification.instances.iter().zip(&report.instances) {
        assert_eq!(one.diverged, 0, "{verification}");
        assert_eq!(one.unreadable, None);
        assert_eq!(told.wanted, one.dropped + one.frames, "{verification}");
    }
}

#[test]
fn a_ring_keeps_whole_chunks() {
    let tape = Tape::new();
    let settings = Settings {
        // Three chunks, however badly the writer's time cuts and compresses them.
        budget: 48 << 10,
        block_bytes: 2 << 10,
        chunk_bytes: 12 << 10,
        // Lockstep is faster than the writer: room for all of it.
        blocks: 4096,
        ..SMALL
    };
    record_in_lockstep(&tape.path, settings, on, &as_it_is);
    let file = tape.read();
    assert!(
        file.gone > 0 && file.chunks.len() >= 3,
        "{} chunks",
        file.chunks.len()
    );
    let verification = tape.verify();
    assert_eq!(verification.divergence, None);
    let verified: u64 = verification.instances.iter().map(|one| one.verified).sum();
    assert!(verified > 50, "{verification}");
    for one in &verification.instances {
        assert_eq!(
            (one.verified + one.unfinished, &one.unreadable),
            (one.frames, &None),
            "{verification}"
        );
    }
}

#[test]
fn an_instance_without_a_single_frame_was_not_verified() {
    let tape = Tape::new();
    let settings = Settings {
        // No frame fits into it.
        block_bytes: 64,
        ..SMALL
    };
    record_in_lockstep(&tape.path, settings, on, &as_it_is);
    let verification = tape.verify();
    assert_eq!(verification.instances[3].frames, 0, "{verification}");
    assert!(!verification.is_good());
    let text = verification.to_string();
    assert!(text.contains("nothing verified"), "{text}");
}

#[test]
fn values_that_are_missing_beside_frames_are_named() {
    let tape = Tape::new();
    let mut zoo = Zoo::new(Clock::stepped());
    let about = About {
        outputs: vec!["Control.main_outputs.pose".to_owned()],
        ..About::default()
    };
    let settings = Settings {
        block_bytes: 40,
        ..SMALL
    };
    let off = |_: &framework::InstanceDescription| Record::Off;
    let recording = Recording::start_with(&tape.path, &zoo.robot, about, settings, off);
    let mut recording = recording.expect("the folder is empty");
    let hardware = zoo.hardware.clone();
    let mut lockstep =
        Lockstep::new(&mut zoo.robot, &*hardware).observed(|instance| recording.observer(instance));
    lockstep
        .run_until(Timestamp::from_nanos(500_000_000), |_| {})
        .expect("the zoo goes on");
    drop(lockstep);
    // What the status line says meanwhile.
    let counts = recording.shared_counts();
    let names = counts.iter().map(|(of, _)| &**of);
    assert!(names.eq(INSTANCES.into_iter().chain(["Control.outputs", "logs"])));
    let missing = counts.iter().filter(|(_, counts)| counts.missing() >= 30);
    assert!(missing.map(|(of, _)| of).eq(["Control.outputs"]));
    let report = recording.end();
    assert_eq!(report.state(), "INCOMPLETE");
    assert_eq!(report.missing[0].of, "Control.outputs");
    assert!(report.missing[0].dropped >= 30, "{report}");
    assert!(
        report.to_string().contains("larger than a block"),
        "{report}"
    );
}
