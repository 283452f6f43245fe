//! What cycles took is what a replay gives back, whichever frames there are.

use std::time::Duration;

use framework::recorded::{Foreign, Loading, SaveError, Saving};
use framework::{
    Consumer, HistoricInput, History, Horizon, Interleaving, Reader, Series, Timestamp, Writer,
    buffer_of,
};
use hulkgen_recording::{
    Channel, ChannelId, Description, Recorded, Recorder, Recording, Settings, Writing,
};
use proptest::prelude::*;

const FRAMES: ChannelId = ChannelId(0);
const WINDOW: usize = 4;

/// What happens between two cycles, and in one.
#[derive(Clone, Copy, Debug)]
enum Step {
    Announce(usize),
    Complete(usize),
    Abandon(usize),
    Write(u8),
    /// Where it does not finish it leaves nothing behind.
    Cycle {
        recorded: bool,
        finishes: bool,
    },
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        3 => (0..2_usize).prop_map(Step::Announce),
        3 => (0..2_usize).prop_map(Step::Complete),
        1 => (0..2_usize).prop_map(Step::Abandon),
        2 => any::<u8>().prop_map(Step::Write),
        3 => (any::<bool>(), prop::bool::weighted(0.7))
            .prop_map(|(recorded, finishes)| Step::Cycle { recorded, finishes }),
    ]
}

/// The ends of one consuming instance.
struct Inputs {
    consumers: [Consumer<String>; 2],
    horizon: Horizon,
    merged: Interleaving,
    newest: Reader<u8>,
    history: History<Option<u8>>,
}

/// Buffers, and who writes them.
struct Outside {
    writers: [Writer<String>; 2],
    announced: [Option<Timestamp>; 2],
    numbers: Writer<u8>,
    written: u64,
    cycles: [u64; 2],
}

fn connected() -> (Outside, Inputs) {
    let [first, second] = [(); 2].map(|()| {
        let (writer, [], [queue]) = buffer_of(String::new, [WINDOW]);
        (writer, Consumer::new(queue, Duration::from_nanos(5)))
    });
    let (numbers, [newest], []) = buffer_of(u8::default, []);
    let outside = Outside {
        writers: [first.0, second.0],
        announced: [None; 2],
        numbers,
        written: 0,
        cycles: [0; 2],
    };
    let inputs = Inputs {
        consumers: [first.1, second.1],
        horizon: Horizon::new(),
        merged: Interleaving::new(),
        newest,
        history: History::new(Duration::from_nanos(7)),
    };
    (outside, inputs)
}

impl Outside {
    fn apply(&mut self, step: Step, now: Timestamp) {
        match step {
            Step::Announce(instance) => {
                self.announced[instance] = Some(now);
                self.writers[instance].announce(now);
            }
            Step::Complete(instance) => {
                if let Some(timestamp) = self.announced[instance].take() {
                    self.cycles[instance] += 1;
                    let cycle = self.cycles[instance];
                    let text = self.writers[instance].slots().0;
                    text.clear();
                    text.push_str(&format!("{instance}: {cycle}"));
                    self.writers[instance].complete(cycle, timestamp);
                }
            }
            Step::Abandon(instance) => {
                self.announced[instance] = None;
                self.writers[instance].abandon();
            }
            Step::Write(value) => {
                self.written += 1;
                *self.numbers.slots().0 = value;
                self.numbers.complete(self.written, now);
            }
            Step::Cycle { .. } => {}
        }
    }
}

impl Inputs {
    fn take(&mut self, now: Timestamp) {
        let [first, second] = &mut self.consumers;
        self.horizon.consume(now, [first, second]);
        self.newest.take();
        self.merge();
    }

    fn merge(&mut self) {
        let [first, second] = &self.consumers;
        self.merged.merge([first, second]);
    }

    /// Everything that a node could see.
    fn seen(&self, now: Timestamp) -> String {
        let lanes = self.consumers.each_ref().map(|consumer| {
            let values = consumer.project(String::as_str);
            let items: Vec<_> = (0..values.len())
                .map(|index| {
                    let item = values.item(index);
                    (item.timestamp, item.order, item.cycle, item.value)
                })
                .collect();
            format!("{:?} {items:?}", values.persistent())
        });
        let newest = self.newest.view().latest(now, |value| *value);
        let past = self.history.project(|value| value);
        let history = HistoricInput::new(&past, now, &None);
        format!("{lanes:?} {:?} {newest:?} {history:?}", self.merged)
    }

    fn save(&self, since: Option<Timestamp>, out: &mut Saving<'_, '_>) {
        self.consumers.iter().for_each(|one| one.save(out));
        self.newest.save(out);
        self.history.save(since, out);
    }
}

/// Values by the place of their instance and their cycle, as frames refer to them.
fn value_channel(place: usize) -> ChannelId {
    ChannelId(1 + place as u16)
}

fn description() -> Description {
    let topics = ["/frames", "/values/0", "/values/1", "/values/2"];
    let channels = topics.map(|topic| Channel {
        topic: topic.to_owned(),
        schema: None,
        encoding: "test".to_owned(),
        metadata: Vec::new(),
        once_per_chunk: topic != "/frames",
    });
    Description {
        channels: channels.into(),
        ..Description::default()
    }
}

fn saved(
    writing: &mut Writing<'_>,
    save: impl FnOnce(&mut Saving<'_, '_>),
) -> Result<(), SaveError> {
    let mut saving = Saving::new(writing);
    save(&mut saving);
    saving.end()
}

/// Runs the steps; what each recorded cycle saw, in the order of their frames.
fn record(steps: &[Step], path: &std::path::Path) -> Vec<(Timestamp, String)> {
    let settings = Settings {
        blocks: 64,
        block_bytes: 300,
        chunk_bytes: 1,
        ..Settings::default()
    };
    let (recorder, mut tracks) =
        Recorder::start(path, description(), &["Control"], settings).expect("it is new");
    let mut track = tracks.pop().expect("one was asked for");
    let (mut outside, mut inputs) = connected();
    let mut expected = Vec::new();
    let mut since = None;
    for (step, now) in steps.iter().zip(1..) {
        let time = Timestamp::from_nanos(now);
        outside.apply(*step, time);
        let Step::Cycle { recorded, finishes } = *step else {
            continue;
        };
        inputs.take(time);
        let written = recorded.then(|| {
            track.frame::<SaveError>(now, 0, |frame| {
                for (place, consumer) in inputs.consumers.iter().enumerate() {
                    consumer.values(&mut |cycle, _, value| {
                        frame.message(value_channel(place), cycle as u32, now, |writing| {
                            saved(writing, |out| out.put(value))
                        })
                    })?;
                }
                inputs.newest.values(&mut |cycle, _, value| {
                    frame.message(value_channel(2), cycle as u32, now, |writing| {
                        saved(writing, |out| out.put(value))
                    })
                })?;
                let since = since.filter(|_| !frame.is_first());
                frame.message(FRAMES, now as u32, now, |writing| {
                    saved(writing, |out| inputs.save(since, out))
                })
            })
        });
        if let Some(Recorded::Whole) = written {
            expected.push((time, inputs.seen(time)));
            // The next frame adds what this cycle and later ones push.
            since = Some(time);
        }
        if finishes {
            inputs.history.push(time, &Some(now as u8));
        }
    }
    drop(track);
    recorder.end();
    expected
}

/// What the cycles of one chunk see again.
fn replay(chunk: &hulkgen_recording::Chunk) -> Vec<(Timestamp, String)> {
    let (mut outside, mut inputs) = connected();
    let find = |place: usize, cycle: u64| {
        let channel = value_channel(place).0 + 1;
        let found = chunk
            .messages()
            .find(|one| one.channel == channel && u64::from(one.sequence) == cycle);
        found.map(|one| one.data.to_vec()).ok_or_else(|| {
            framework::Error::new(format!("cycle {cycle} of {place} is not in the chunk"))
        })
    };
    let frames = chunk.messages().filter(|one| one.channel == 1);
    let seen = frames.map(|frame| {
        let time = Timestamp::from_nanos(frame.time);
        let mut from = Loading::new(frame.data);
        for (place, consumer) in inputs.consumers.iter_mut().enumerate() {
            let writer = &mut outside.writers[place];
            consumer
                .load(&mut from, writer, &mut |cycle| {
                    Loading::new(&find(place, cycle)?).take()
                })
                .expect("it was saved");
        }
        inputs
            .newest
            .load(&mut from, &mut outside.numbers, &mut |cycle| {
                Loading::new(&find(2, cycle)?).take()
            })
            .expect("it was saved");
        inputs.history.load(&mut from).expect("it was saved");
        assert!(from.is_empty());
        inputs.merge();
        let seen = inputs.seen(time);
        // In a replay every cycle finishes, and leaves something else.
        inputs.history.push(time, &None);
        (time, seen)
    });
    seen.collect()
}

/// What `save` writes.
fn bytes_of(save: impl FnOnce(&mut Saving<'_, '_>)) -> Vec<u8> {
    let mut bytes = vec![0; 100];
    let mut writing = Writing::new(&mut bytes);
    saved(&mut writing, save).expect("there is room");
    let length = writing.length();
    bytes.truncate(length);
    bytes
}

#[test]
fn before_the_first_cycle_of_an_instance_its_value_is_the_default_also_when_time_goes_back() {
    let (mut outside, mut inputs) = connected();
    let mut frames = Vec::new();
    for (step, now) in [Step::Abandon(0), Step::Write(7), Step::Write(9)]
        .into_iter()
        .zip(1..)
    {
        let now = Timestamp::from_nanos(now);
        outside.apply(step, now);
        inputs.take(now);
        frames.push(bytes_of(|out| inputs.newest.save(out)));
    }
    let (mut outside, mut inputs) = connected();
    // Often enough that each slot has had a value.
    for position in [0, 1, 2, 1, 2, 0, 1, 0, 0] {
        let mut find = |cycle| Ok([7, 9][cycle as usize - 1]);
        let mut from = Loading::new(&frames[position]);
        let loaded = inputs
            .newest
            .load(&mut from, &mut outside.numbers, &mut find);
        loaded.expect("it was saved");
        assert_eq!(*inputs.newest.view().value(), [0, 7, 9][position]);
        assert_eq!(inputs.newest.view().cycle(), position as u64);
    }
}

proptest! {
    #[test]
    fn every_chunk_gives_back_what_its_cycles_saw(steps in prop::collection::vec(step(), 0..200)) {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.mcap");
        let expected = record(&steps, &path);
        let recording = Recording::open(&path).expect("it can be read");
        // From the last chunk to the first: none needs another.
        let mut seen: Vec<_> = recording.chunks.iter().rev().map(replay).collect();
        seen.reverse();
        prop_assert_eq!(seen.concat(), expected);
    }

    #[test]
    fn damaged_frames_are_errors(bytes in prop::collection::vec(any::<u8>(), 0..60)) {
        let (mut outside, mut inputs) = connected();
        let mut from = Loading::new(&bytes);
        let _ = inputs.consumers[0].load(&mut from, &mut outside.writers[0], &mut |cycle| Ok(cycle.to_string()));
        let _ = inputs.newest.load(&mut from, &mut outside.numbers, &mut |_| Ok(7));
        let _ = inputs.history.load(&mut from);
        inputs.merge();
        inputs.seen(Timestamp::from_nanos(9));
    }
}
