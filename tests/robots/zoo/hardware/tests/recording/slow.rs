//! Cycles that take longer than frames stay in memory: nothing of them is lost.

use std::time::Duration;

use framework::driver::Observer;
use framework::recorded::Settings;
use framework::replay::verify;
use framework::{Instance, InstanceDescription};
use hulkgen_recording::Recording as File;
use zoo_runtime::recording;

use super::{SMALL, Tape, on, record_in_lockstep};

/// The first bytes of messages that begin and end a frame.
const BEGUN: u8 = 0;
const FINISHED: u8 = 1;

/// Every twentieth cycle of Control hangs for a while behind what was recorded of its beginning.
struct Hanging(Box<dyn Observer>);

impl Observer for Hanging {
    fn begun(&mut self, instance: &mut dyn Instance) {
        self.0.begun(instance);
        if instance.cycle().number.is_multiple_of(20) {
            std::thread::sleep(Duration::from_millis(60));
        }
    }

    fn finished(&mut self, instance: &dyn Instance) {
        self.0.finished(instance);
    }
}

fn hanging(instance: &InstanceDescription, observer: Box<dyn Observer>) -> Box<dyn Observer> {
    match instance.name {
        "Control" => Box::new(Hanging(observer)),
        _ => observer,
    }
}

/// The first message of Control's frames in each chunk.
fn firsts(file: &File) -> Vec<Option<u8>> {
    let mut channels = file.channels.iter();
    let channel = channels.find(|(_, channel)| channel.topic == "frames/Control");
    let (number, _) = channel.expect("it has a channel");
    let chunks = file.chunks.iter().map(|chunk| {
        let mut messages = chunk.messages();
        let first = messages.find(|message| message.channel == *number);
        first.and_then(|message| message.data.first().copied())
    });
    chunks.collect()
}

#[test]
fn the_end_of_a_slow_cycle_is_found_behind_the_chunk_of_its_beginning() {
    let tape = Tape::new();
    let settings = Settings {
        longest: Duration::from_millis(1),
        // Lockstep is faster than the writer, and nearly each frame has a block of its own.
        blocks: 2048,
        ..SMALL
    };
    let report = record_in_lockstep(&tape.path, settings, on, &hanging);
    assert!(report.ended.is_complete, "{report}");
    let verification = tape.verify();
    assert!(verification.is_good(), "{verification}");
    let control = &verification.instances[3];
    assert_eq!(control.frames, report.instances[3].wanted);
    assert_eq!((control.unfinished, control.dropped), (0, 0));

    let file = tape.read();
    let firsts = firsts(&file);
    let alone = (0..firsts.len()).filter(|chunk| firsts[*chunk] == Some(FINISHED));
    let alone: Vec<usize> = alone.collect();
    assert!(!alone.is_empty(), "{firsts:?}");
    assert!(firsts.contains(&Some(BEGUN)));
    // Where a ring has closed over its beginning.
    for chunk in alone {
        let mut rest = tape.read();
        rest.chunks.drain(..chunk);
        let verification = verify(&rest, recording::INSTANCES).expect("it is of this robot");
        assert_eq!(verification.divergence, None, "{verification}");
        for one in &verification.instances {
            assert_eq!(one.unreadable, None, "{verification}");
        }
    }
}
