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

/// What Control's messages are in each chunk.
fn kinds(file: &File) -> Vec<Vec<u8>> {
    let mut channels = file.channels.iter();
    let channel = channels.find(|(_, channel)| channel.topic == "frames/Control");
    let (number, _) = channel.expect("it has a channel");
    let chunks = file.chunks.iter().map(|chunk| {
        let own = chunk.messages();
        let own = own.filter(|message| message.channel == *number);
        own.filter_map(|message| message.data.first().copied())
            .collect()
    });
    chunks.collect()
}

/// What is left of a file is shown as far as it goes.
fn assert_readable(rest: &File) {
    let verification = verify(rest, recording::INSTANCES).expect("it is of this robot");
    assert_eq!(verification.divergence, None, "{verification}");
    for one in &verification.instances {
        assert_eq!(one.unreadable, None, "{verification}");
    }
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
    let kinds = kinds(&file);
    let alone = (0..kinds.len()).filter(|chunk| kinds[*chunk].first() == Some(&FINISHED));
    let alone: Vec<usize> = alone.collect();
    assert!(!alone.is_empty(), "{kinds:?}");
    let mut behind_others = 0;
    for chunk in alone {
        // Where a ring has closed over its beginning.
        let mut rest = tape.read();
        rest.chunks.drain(..chunk);
        assert_readable(&rest);
        // Where the disk did not take the chunk of its beginning, and the cycles before are there.
        let begins = (0..chunk).rfind(|begins| kinds[*begins].last() == Some(&BEGUN));
        let begins = begins.expect("its beginning is in the file");
        let mut rest = tape.read();
        rest.chunks.remove(begins);
        assert_readable(&rest);
        behind_others += usize::from(kinds[..begins].iter().any(|kinds| !kinds.is_empty()));
    }
    assert!(behind_others > 0, "{kinds:?}");
}
