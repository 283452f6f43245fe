//! Values that are handed on by handle: who has one keeps its value, whatever else is filled.

use std::time::Duration;

use framework::recorded::{Loading, SaveError, Saving};
use framework::testing::at_millis;
use framework::{
    AdditionalOutput, AdditionalSlot, Clear, CountingAllocator, Given, History, Leased, Pool,
    buffer,
};
use hulkgen_recording::{
    Channel, ChannelId, Description, Recorded, Recorder, Recording, Settings, Track,
};
use proptest::prelude::*;
use serde::{Deserialize, Serialize};

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

#[derive(Clone, Debug)]
enum Step {
    Fill,
    Clone(usize),
    Drop(usize),
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        3 => Just(Step::Fill),
        1 => any::<usize>().prop_map(Step::Clone),
        3 => any::<usize>().prop_map(Step::Drop),
    ]
}

proptest! {
    /// Against a list of what each handle was leased with.
    #[test]
    fn a_value_is_free_exactly_when_it_has_no_handle(
        count in 0_usize..5,
        steps in prop::collection::vec(step(), 0..60),
    ) {
        let mut pool = Pool::new(count, || 0);
        let mut handles: Vec<(usize, Leased<usize>)> = Vec::new();
        let mut most_leased = 0;
        for (number, step) in steps.into_iter().enumerate() {
            match step {
                Step::Fill => {
                    let mut leased: Vec<usize> = handles.iter().map(|(number, _)| *number).collect();
                    leased.dedup();
                    leased.sort_unstable();
                    leased.dedup();
                    let free = pool.free();
                    prop_assert_eq!(free.is_ok(), leased.len() < count);
                    if let Ok(mut free) = free {
                        *free = number;
                        handles.push((number, free.lease()));
                        most_leased = most_leased.max(leased.len() + 1);
                    }
                    prop_assert_eq!(pool.made(), most_leased, "no more than had handles at once");
                }
                Step::Clone(index) if !handles.is_empty() => {
                    handles.push(handles[index % handles.len()].clone());
                }
                Step::Drop(index) if !handles.is_empty() => {
                    handles.swap_remove(index % handles.len());
                }
                Step::Clone(_) | Step::Drop(_) => {}
            }
            for (number, handle) in &handles {
                prop_assert_eq!(number, &**handle);
            }
        }
    }
}

/// An image goes through a slot to another instance and through a history, and is written and copied nowhere.
#[test]
fn images_pass_slots_and_histories_by_handle() {
    // Three slots, the history's last second and the one before, and the cycle's own.
    let mut pool = Pool::new(3 + 32 + 1, || vec![0_u8; 640 * 480 * 2]);
    let (mut writer, [mut reader], []) = buffer::<Option<Leased<Vec<u8>>>, 1, 0>([]);
    let mut history = History::new(Duration::from_secs(1));
    let mut allocated = None;
    for cycle in 1..200_u64 {
        let before = CountingAllocator::of_this_thread().expect("it is installed");
        let output = writer.slots().0;
        output.clear();
        let mut image = pool.free().expect("there are enough");
        image[0] = cycle as u8;
        *output = Some(image.lease());
        history.push(at_millis(cycle * 33), output);
        let written = output.clone().expect("it was leased");
        writer.complete(cycle, at_millis(cycle * 33));
        reader.take();
        let read = reader.view().value().as_ref().expect("it was written");
        assert!(read.is_same(&written), "cycle {cycle}");
        assert_eq!(read[0], cycle as u8);
        let after = CountingAllocator::of_this_thread().expect("it is installed");
        // The history has its room by then.
        if cycle > 100 {
            allocated = Some(allocated.unwrap_or(0) + after - before);
        }
    }
    assert_eq!(allocated, Some(0));
}

#[test]
fn a_pool_without_a_free_value_says_so() {
    let mut pool = Pool::new(1, || 7);
    let leased = pool.free().map(|free| free.lease());
    assert_eq!(leased.as_deref(), Ok(&7));
    let error = framework::Error::from(pool.free().map(|_| ()).unwrap_err());
    assert!(error.is_no_event(), "a setup node starts over: {error}");
    drop(leased);
    assert!(pool.free().is_ok());
}

#[test]
fn a_value_that_was_not_leased_comes_again_as_it_was_left() {
    let mut pool = Pool::new(3, || 0);
    let first = pool.free().map(|free| free.lease());
    *pool.free().expect("there are three") = 5;
    assert_eq!(*pool.free().expect("there are three"), 5);
    drop(first);
    assert_eq!(*pool.free().expect("there are three"), 5);
    assert_eq!(pool.made(), 2);
}

#[test]
fn serde_sees_the_value_and_not_the_handle() {
    let leased = Leased::of(vec![1, 2]);
    let text = serde_json::to_string(&leased).expect("a list is JSON");
    assert_eq!(text, "[1,2]");
    let read: Leased<Vec<i32>> = serde_json::from_str(&text).expect("it was written so");
    assert_eq!(read, leased);
    assert!(!read.is_same(&leased));
}

type Image = Option<Leased<Vec<u8>>>;

fn start(path: &std::path::Path) -> (Recorder, Track) {
    let description = Description {
        channels: vec![Channel {
            topic: "frames".to_owned(),
            schema: None,
            encoding: "test".to_owned(),
            metadata: Vec::new(),
            once_per_chunk: false,
        }],
        ..Description::default()
    };
    // So long that no block goes to the writer by its age.
    let settings = Settings {
        longest: Duration::from_secs(600),
        ..Settings::default()
    };
    let started = Recorder::start(path, description, &["Camera"], settings);
    let (recorder, mut tracks) = started.expect("it is new");
    (recorder, tracks.pop().expect("one was asked for"))
}

fn record<T: framework::Data>(track: &mut Track, cycle: u32, output: &T) -> Recorded<SaveError> {
    record_as(track, cycle, |saving| saving.output(output))
}

fn record_as(
    track: &mut Track,
    cycle: u32,
    save: impl Fn(&mut Saving<'_, '_>),
) -> Recorded<SaveError> {
    let time = u64::from(cycle);
    track.frame(time, 0, |frame| {
        frame.message(ChannelId(0), cycle, time, |writing| {
            let mut saving = Saving::new(writing);
            save(&mut saving);
            saving.put(&cycle);
            saving.end()
        })
    })
}

/// The data of all messages.
fn recorded(path: &std::path::Path) -> Vec<Vec<u8>> {
    let recording = Recording::open(path).expect("it can be read");
    let messages = recording.chunks.iter().flat_map(|chunk| chunk.messages());
    messages.map(|message| message.data.to_vec()).collect()
}

/// It holds handles until the file has the values, and nobody who fills values waits for that.
#[test]
fn a_recording_takes_no_value_from_a_pool() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track) = start(&path);
    let mut pool = Pool::new(1, || vec![0_u8; 3]);
    let mut expected = Vec::new();
    // As many as one block has.
    for cycle in 0..4_u8 {
        let mut image = pool.free().expect("a recording alone has the others");
        image.fill(cycle);
        let output: Image = Some(image.lease());
        let allocations = CountingAllocator::of_this_thread();
        assert_eq!(record(&mut track, cycle.into(), &output), Recorded::Whole);
        assert_eq!(CountingAllocator::of_this_thread(), allocations);
        expected.push(vec![1, 3, cycle, cycle, cycle, cycle]);
    }
    assert_eq!(pool.made(), 4);
    let held = pool.free().expect("four are the recording's").lease();
    assert!(pool.free().is_err(), "somebody else has the pool's own");
    // What has no handle is written as ever.
    let plain = [None, Some(Leased::of(vec![9_u8]))];
    assert_eq!(record(&mut track, 4, &plain[0]), Recorded::Whole);
    assert_eq!(record(&mut track, 5, &vec![7_u8]), Recorded::Whole);
    expected.extend([vec![0, 4], vec![1, 7, 5]]);
    // However many options there are.
    let two = Some(plain[1].clone());
    assert_eq!(record(&mut track, 6, &two), Recorded::Whole);
    assert_eq!(record(&mut track, 7, &Some(two)), Recorded::Whole);
    expected.extend([vec![1, 1, 1, 9, 6], vec![1, 1, 1, 1, 9, 7]]);
    // A copy of the values that a client changes meanwhile.
    let mut changed = plain[1].clone();
    assert_eq!(record(&mut track, 8, &plain[1]), Recorded::Whole);
    let first = "0".parse().expect("a path");
    let part = framework::reflect::at_mut(&mut changed, &first).expect("there is one");
    part.deserialize_from(&Given::from(&serde_json::Value::from(8)))
        .expect("it is a number");
    assert_eq!(changed.as_deref(), Some(&vec![8]));
    expected.push(vec![1, 1, 9, 8]);
    drop(track);
    assert!(recorder.end().is_complete);
    assert_eq!(recorded(&path), expected);
    drop(held);
    let all: Vec<_> = std::iter::from_fn(|| Some(pool.free().ok()?.lease())).collect();
    assert_eq!(all.len(), 5, "none is held any more");
}

#[test]
fn a_handle_in_an_additional_output_is_left_to_the_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track) = start(&path);
    let mut pool = Pool::new(1, || vec![7_u8; 3]);
    let mut slot = AdditionalSlot::<Image>::default();
    let mut output = AdditionalOutput::new(true, 1, &mut slot);
    let image = pool.free().expect("nobody has one yet").lease();
    output.fill_if_subscribed(|| Some(image));
    // In the second cycle nobody fills it.
    for cycle in 1..=2_u32 {
        let recorded = record_as(&mut track, cycle, |saving| slot.save(cycle.into(), saving));
        assert_eq!(recorded, Recorded::Whole);
    }
    drop(slot);
    pool.free().expect("the recording has the first");
    assert_eq!(pool.made(), 2);
    drop(track);
    assert!(recorder.end().is_complete);
    let frames = recorded(&path);
    assert_eq!(frames, [vec![1, 1, 3, 7, 7, 7, 1], vec![0, 2]]);
    let mut again = AdditionalSlot::<Image>::default();
    let mut from = Loading::new(&frames[0]);
    again.load(5, &mut from).expect("it was saved");
    assert_eq!(again.get(5), Some(&Some(Leased::of(vec![7; 3]))));
    assert_eq!(again.get(6), None);
}

#[test]
fn a_history_of_handles_is_left_to_the_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let paths = ["left.mcap", "copied.mcap"].map(|name| folder.path().join(name));
    let mut pool = Pool::new(8, || vec![0_u8; 3]);
    let mut history = History::<Image>::new(Duration::from_secs(1));
    // More than a block has of several frames.
    for cycle in 1..=8 {
        let mut image = pool.free().expect("there are enough");
        image.fill(cycle);
        history.push(at_millis(u64::from(cycle) * 33), &Some(image.lease()));
    }
    let values: Vec<(_, Image)> = (1..=8)
        .map(|cycle: u8| {
            let at = at_millis(u64::from(cycle) * 33);
            (at, Some(Leased::of(vec![cycle; 3])))
        })
        .collect();

    let (recorder, mut track) = start(&paths[0]);
    let left = record_as(&mut track, 1, |saving| history.save(None, saving));
    assert_eq!(left, Recorded::Whole);
    drop(history);
    let mut again: Vec<_> = (0..8)
        .map(|_| pool.free().map(|free| free.lease()))
        .collect();
    assert!(again.iter().all(Result::is_ok) && pool.made() == 16);
    again.clear();
    drop(track);
    assert!(recorder.end().is_complete);

    let (recorder, mut track) = start(&paths[1]);
    let copied = record_as(&mut track, 1, |saving| {
        saving.put(&true);
        saving.put(&8_u32);
        values.iter().for_each(|value| saving.put(value));
    });
    assert_eq!(copied, Recorded::Whole);
    drop(track);
    assert!(recorder.end().is_complete);
    assert_eq!(recorded(&paths[0]), recorded(&paths[1]));
}

/// Has no form, and says so in one of two ways.
#[derive(Clone, Debug, Default, Deserialize, framework::Reflect)]
struct Formless {
    panics: bool,
}

impl Serialize for Formless {
    fn serialize<S: serde::Serializer>(&self, _: S) -> Result<S::Ok, S::Error> {
        assert!(!self.panics, "not with me");
        Err(serde::ser::Error::custom("not today"))
    }
}

#[test]
fn a_value_without_bytes_costs_its_frames_and_not_the_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (recorder, mut track) = start(&path);
    for cycle in 0..4 {
        let panics = cycle == 2;
        let formless = (cycle == 1 || panics).then(|| Leased::of(Formless { panics }));
        assert_eq!(record(&mut track, cycle, &formless), Recorded::Whole);
        track.hand_over();
    }
    let counts = track.counts().clone();
    drop(track);
    assert!(!recorder.end().is_complete);
    assert_eq!((counts.recorded(), counts.lost()), (4, 2));
    assert_eq!(recorded(&path), [[0, 0], [0, 3]]);
}
