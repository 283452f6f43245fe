//! Recordings of a machine that computes other bits: compared within a tolerance, and said so.

use framework::driver::Observer;
use framework::recorded::{About, Recording, Settings};
use framework::replay::{How, Shelf, TOLERANCE, Verification, verify_how};
use framework::{Clock, Given, Instance, Lockstep, State, Timestamp};
use hulkgen_recording::Recording as File;
use serde_json::{Value, json};
use zoo_runtime::recording;

use super::divergence::record_flipping;
use super::{Tape, Zoo, on};

/// The first cycle that differs.
const FIRST: u64 = 40;

/// Changes something of what the nodes of an instance share, after it was saved: the replay computes something else.
struct Nudging {
    observer: Box<dyn Observer>,
    nudge: fn(&mut Value, u64),
}

impl Observer for Nudging {
    fn begun(&mut self, instance: &mut dyn Instance) {
        self.observer.begun(instance);
        let cycle = instance.cycle().number;
        instance.states(&mut |name, state| {
            if name == "cycler_state" && cycle >= FIRST {
                let mut value = as_json(state);
                (self.nudge)(&mut value, cycle);
                let loaded = state.load(&Given::from(&value));
                loaded.expect("it is such a state");
            }
        });
    }

    fn finished(&mut self, instance: &dyn Instance) {
        self.observer.finished(instance);
    }
}

fn as_json(state: &dyn State) -> Value {
    let mut text = Vec::new();
    let mut json = serde_json::Serializer::new(&mut text);
    let saved = state.save(&mut <dyn erased_serde::Serializer>::erase(&mut json));
    saved.expect("it is a state");
    serde_json::from_slice(&text).expect("it is JSON")
}

/// The next number that an `f32` can be.
fn next(value: &mut Value) {
    let number = value.as_f64().expect("a number") as f32;
    *value = number.next_up().into();
}

/// The plan depends on it, of which the recording has digests alone.
fn change_phase(state: &mut Value) {
    let phase = &mut state["gait"]["phase"];
    *phase = json!(phase.as_f64().expect("a number") / 2.0);
}

fn record(nudge: fn(&mut Value, u64)) -> Tape {
    record_outputs(&[], nudge)
}

/// With channels for these outputs.
fn record_outputs(outputs: &[&str], nudge: fn(&mut Value, u64)) -> Tape {
    let tape = Tape::new();
    let mut zoo = Zoo::new(Clock::stepped());
    let about = About {
        outputs: outputs.iter().map(|output| (*output).to_owned()).collect(),
        ..About::default()
    };
    let recording = Recording::start_with(&tape.path, &zoo.robot, about, Settings::default(), on);
    let mut recording = recording.expect("the folder is empty");
    let hardware = zoo.hardware.clone();
    let mut lockstep = Lockstep::new(&mut zoo.robot, &*hardware).observed(|instance| {
        let observer = recording.observer(instance)?;
        Some(match instance.name {
            "Control" => Box::new(Nudging { observer, nudge }),
            _ => observer,
        })
    });
    let end = Timestamp::from_nanos(2_000_000_000);
    lockstep.run_until(end, |_| {}).expect("the zoo goes on");
    drop(lockstep);
    recording.end();
    tape
}

/// As if it came from a machine whose elementary functions give other bits.
fn elsewhere(tape: &Tape) -> File {
    let mut file = tape.read();
    let mut metadata = file.metadata.iter_mut();
    let run = metadata.find(|one| one.name == "run").expect("it is there");
    let mut entries = run.entries.iter_mut();
    let numerics = entries.find(|(key, _)| key == "numerics");
    numerics.expect("it is there").1 = "elsewhere".to_owned();
    file
}

fn verify_within(file: &File, tolerance: Option<f64>) -> Verification {
    let how = How {
        tolerance,
        ..How::default()
    };
    let shelf = Shelf::of(file).expect("it is of this version");
    verify_how(&shelf, recording::INSTANCES, &how).expect("it is of this robot")
}

/// Control's cycles whose outputs the recording has.
fn stored(file: &File) -> Vec<u64> {
    let mut channels = file.channels.iter();
    let channel = channels.find(|(_, channel)| channel.topic == "values/Control");
    let (number, _) = channel.expect("others read it");
    let messages = file.chunks.iter().flat_map(|chunk| chunk.messages());
    let own = messages.filter(|message| message.channel == *number);
    own.map(|message| u64::from(message.sequence)).collect()
}

#[test]
fn last_bits_may_differ_and_that_is_said() {
    let tape = record(|state, _| {
        next(&mut state["filter"]["drift"]["x"]);
        change_phase(state);
    });
    let file = elsewhere(&tape);
    let verification = verify_within(&file, None);
    assert!(verification.is_good(), "{verification}");
    assert_eq!(verification.compared_within, Some(TOLERANCE));
    let control = &verification.instances[3];
    assert_eq!(control.verified, control.frames, "{verification}");
    // What others read of it the recording has.
    let seen = stored(&file).iter().filter(|cycle| **cycle > FIRST).count() as u64;
    assert!(control.within > seen / 2, "{seen}: {verification}");
    assert!(control.not_compared > 0, "{verification}");
    let text = verification.to_string();
    for said in [
        "recorded with other numerics (elsewhere, here ",
        "compared within 1e-6 where the recording has values, else bit for bit",
        "(`--tolerance NUMBER`: within another one, 0: bit for bit)",
        " outputs within the tolerance, ",
        " outputs not comparable: only their digests were recorded",
    ] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let json = verification.to_json();
    assert_eq!(json["compared_within"], 1e-6, "{json}");
    assert_eq!(json["tolerance"], Value::Null, "{json}");

    // Bits differ: on the same machine, and where bits are asked for.
    for (file, tolerance, said) in [
        (tape.read(), None, None),
        (
            tape.read(),
            Some(1e-6),
            Some("compared bit for bit, without a tolerance"),
        ),
        (
            elsewhere(&tape),
            Some(0.0),
            Some("compared bit for bit, as was asked for"),
        ),
    ] {
        let verification = verify_within(&file, tolerance);
        let text = verification.to_string();
        assert!(!verification.is_good(), "{text}");
        assert_eq!(verification.compared_within, None, "{text}");
        assert_eq!(verification.instances[3].within, 0, "{text}");
        let found = verification.divergence.expect("bits differ");
        assert!((FIRST..FIRST + 2).contains(&found.cycle), "{text}");
        assert!(said.is_none_or(|said| text.contains(said)), "{text}");
    }
}

#[test]
fn what_differs_by_more_is_named_with_both_values() {
    // One coordinate by its last bit, the other by more.
    let tape = record(|state, _| {
        let drift = &mut state["filter"]["drift"];
        next(&mut drift["x"]);
        drift["y"] = json!(drift["y"].as_f64().expect("a number") + 1e-3);
    });
    let file = elsewhere(&tape);
    let verification = verify_within(&file, None);
    assert!(!verification.is_good(), "{verification}");
    let first = stored(&file).into_iter().find(|cycle| *cycle >= FIRST);
    let found = verification.divergence.as_ref().expect("it is more");
    assert_eq!(
        (
            found.instance,
            Some(found.cycle),
            &*found.node,
            &*found.output,
            &*found.path
        ),
        (
            "Control",
            first,
            "zoo_nodes::control::pose_filter",
            "pose",
            "position.y"
        ),
        "{verification}"
    );
    let values = [&found.recorded, &found.recomputed].map(|value| {
        let value = value.as_ref().expect("the recording has it");
        value["position"]["y"].as_f64().expect("a number")
    });
    assert!(
        (values[0] - values[1] - 1e-3).abs() < 1e-5,
        "{verification}"
    );
    let text = verification.to_string();
    for said in [
        "`pose` of `zoo_nodes::control::pose_filter`, first in `position.y`",
        "recorded:   {",
        "recomputed: {",
    ] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let wide = verify_within(&file, Some(0.1));
    assert!(wide.is_good(), "{wide}");
    assert!(wide.to_string().contains("compared within 1e-1"), "{wide}");
}

#[test]
fn an_output_of_which_there_is_a_digest_alone_is_counted_and_the_rest_is_verified() {
    let tape = record(|state, cycle| {
        if cycle == FIRST {
            change_phase(state);
        }
    });
    let verification = verify_within(&elsewhere(&tape), None);
    assert!(verification.is_good(), "{verification}");
    let control = &verification.instances[3];
    assert_eq!(
        (control.verified, control.diverged, control.not_compared),
        (control.frames, 0, 1),
        "{verification}"
    );
    let text = verification.to_string();
    let said = "1 output not comparable: only its digest was recorded";
    assert!(text.contains(said), "{text}");
}

#[test]
fn an_instance_of_which_nothing_can_be_compared_was_not_verified() {
    let tape = Tape::new();
    // It writes nothing else, and nobody reads it.
    record_flipping(&tape, "Reflexes", "sum", 0..=u64::MAX);
    let verification = verify_within(&elsewhere(&tape), None);
    assert!(!verification.is_good(), "{verification}");
    assert_eq!(verification.divergence, None, "{verification}");
    for one in &verification.instances {
        let is_other = one.instance == "Reflexes";
        assert_eq!(one.is_good(), !is_other, "{verification}");
        let expected = if is_other { one.frames } else { 0 };
        assert_eq!(one.not_compared, expected, "{verification}");
    }
    let text = verification.to_string();
    assert!(
        text.contains("nothing verified, 200 outputs not comparable"),
        "{text}"
    );
}

#[test]
fn a_value_that_stands_in_a_channel_of_its_own_is_told_where_it_differs() {
    let outputs = ["Control.main_outputs.plan", "Control.main_outputs.pose"];
    let change = |state: &mut Value, cycle| {
        if cycle == FIRST {
            change_phase(state);
        }
    };
    let tape = record_outputs(&outputs, change);
    let verification = tape.verify();
    let found = verification.divergence.as_ref().expect("it differs");
    // The first of the angles is always 0.
    assert_eq!(
        (found.cycle, &*found.output, &*found.path),
        (FIRST, "plan", "1"),
        "{verification}"
    );
    let angles = [&found.recorded, &found.recomputed].map(|value| {
        let value = value.as_ref().expect("the recording has it");
        value[1].as_f64().expect("a number")
    });
    assert!((angles[0] - angles[1]).abs() > 1e-3, "{verification}");
    let text = verification.to_string();
    assert!(
        text.contains("`plan` of `zoo_nodes::control::gait`, first in `1`"),
        "{text}"
    );
    assert!(!text.contains("digest"), "{text}");
    // So it can be compared within a tolerance, too: to be the same, and not to be.
    let control = |tolerance| {
        let verification = verify_within(&elsewhere(&tape), tolerance);
        let control = &verification.instances[3];
        (control.diverged, control.within, control.not_compared)
    };
    assert_eq!(control(None), (1, 0, 0));
    assert_eq!(control(Some(10.0)), (0, 1, 0));
    // Without a channel there are digests.
    let text = record(change).verify().to_string();
    assert!(text.contains("recorded:   digest "), "{text}");
}
