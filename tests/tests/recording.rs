//! The whole NAO recorded in lockstep, and every cycle of it recomputed, whatever the recording lacks.

#[path = "recording/python.rs"]
mod python;

use std::io::ErrorKind;
use std::path::PathBuf;
use std::process::Command;

use framework::recorded::{About, Recording, RecordingReport, Settings};
use framework::replay::{Players, Ran, Shelf, Verification, verify};
use framework::{InstanceDescription, Lockstep, Record, Timestamp};
use hulkgen_recording::Recording as File;
use nao_runtime::recording;
use serde_json::{Value, json};
use support::nao::Nao;
use support::skip;

/// Instances that have many cycles in a second; the network waits for packets.
const BUSY: [&str; 4] = ["VisionTop", "VisionBottom", "Control", "Audio"];

/// Room for two cameras in a world that does not run at the pace of the clock.
fn large() -> Settings {
    Settings {
        blocks: 256,
        ..Settings::default()
    }
}

/// A recording in a folder of its own.
struct Tape {
    _folder: tempfile::TempDir,
    path: PathBuf,
    report: RecordingReport,
}

impl Tape {
    /// So many seconds of a NAO with a ball before it.
    fn record(
        seconds: u64,
        settings: Settings,
        record_of: impl Fn(&InstanceDescription) -> Record,
    ) -> Self {
        Self::record_with(seconds, About::default(), settings, record_of)
    }

    /// The same, with this to say of it.
    fn record_with(
        seconds: u64,
        about: About,
        settings: Settings,
        record_of: impl Fn(&InstanceDescription) -> Record,
    ) -> Self {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let path = folder.path().join("nao.mcap");
        let mut nao = Nao::new(&["--pose", "2.0,0.0,0.0", "--ball", "2.9,0.3"], &[]);
        let mut tape = Recording::start_with(&path, &nao.robot, about, settings, record_of)
            .expect("the folder is empty");
        let hardware = nao.hardware.clone();
        let mut lockstep =
            Lockstep::new(&mut nao.robot, &*hardware).observed(|instance| tape.observer(instance));
        lockstep
            .run_until(Timestamp::from_nanos(seconds * 1_000_000_000), |_| {})
            .expect("no node fails");
        drop(lockstep);
        framework::logs::tell_warning("nao::test", &"the time is over");
        Self {
            report: tape.end(),
            path,
            _folder: folder,
        }
    }

    fn open(&self) -> File {
        File::open(&self.path).expect("it was written")
    }

    /// What a recomputation finds; nothing differs and nothing that is there cannot be read.
    fn verify(&self) -> Verification {
        let verification = verify(&self.open(), recording::INSTANCES).expect("it is of this robot");
        assert_eq!(verification.divergence, None, "{verification}");
        assert_eq!(verification.unknown, Vec::<String>::new());
        for one in &verification.instances {
            assert_eq!(
                (one.diverged, &one.unreadable),
                (0, &None),
                "{verification}"
            );
        }
        verification
    }
}

/// How many cycles of an instance were computed again.
fn verified(verification: &Verification, instance: &str) -> u64 {
    let mut all = verification.instances.iter();
    let one = all.find(|one| one.instance == instance);
    one.expect("it is an instance of the NAO").verified
}

#[test]
fn every_cycle_of_the_nao_is_recomputed_bit_for_bit_from_any_of_them() {
    let tape = Tape::record(2, large(), |_| Record::On);
    assert!(tape.report.ended.is_complete, "{}", tape.report);
    let verification = tape.verify();
    println!("{verification}");
    for one in &verification.instances {
        assert_eq!(one.dropped, 0, "{verification}");
        assert!(one.outputs >= one.verified, "{verification}");
    }
    for name in BUSY {
        assert!(verified(&verification, name) > 20, "{verification}");
    }
    from_any_cycle(&tape.open());
}

/// Alone from the first, a middle and the last cycle, and with one player to the end, back, and to the end again.
fn from_any_cycle(file: &File) {
    let shelf = Shelf::of(file).expect("it is of this version");
    for instance in BUSY {
        let players = || Players::new(&shelf, recording::INSTANCES).expect("it fits");
        let mut played = players();
        let (player, chunks) = played.of(instance).expect("it is an instance");
        let ended = player.frames.iter().rposition(|frame| frame.is_finished());
        let last = ended.expect("cycles have ended");
        for position in [0, last / 2, last, last / 3, last] {
            let mut alone = players();
            let (alone, _) = alone.of(instance).expect("it is an instance");
            for player in [&mut *player, alone] {
                let recorded = player.digests(position, chunks).expect("it can be read");
                let recorded = recorded.expect("the cycle has ended");
                let ran = player.play(position, chunks).expect("the frame is whole");
                assert_eq!(ran, Ran::Finished, "{instance} {position}");
                let mut digests = Vec::new();
                let replay = player.replay().expect("it was loaded").instance();
                let visited = replay.digests(&mut |_, _, digest| digests.push(digest));
                visited.expect("every output serialises");
                assert_eq!(digests, recorded, "{instance} {position}");
            }
        }
    }
}

#[test]
fn the_nao_is_recomputed_without_a_producer_and_with_every_fifth_of_its_cycles() {
    let tape = Tape::record(1, large(), |instance| match instance.name {
        "VisionTop" => Record::Off,
        "VisionBottom" => Record::Every(5),
        _ => Record::On,
    });
    assert!(tape.report.ended.is_complete, "{}", tape.report);
    let verification = tape.verify();
    assert!(verification.is_good(), "{verification}");
    let [top, bottom, control] =
        ["VisionTop", "VisionBottom", "Control"].map(|name| verified(&verification, name));
    assert_eq!(top, 0, "{verification}");
    assert!((4..=8).contains(&bottom), "{verification}");
    assert!(control > 70, "{verification}");
}

#[test]
fn images_that_have_no_room_are_dropped_counted_and_missed_by_nobody() {
    // By handle they have, whatever is larger than a block; copied they have not.
    for late in [1000, 0] {
        let settings = Settings {
            block_bytes: 256 << 10,
            late,
            ..large()
        };
        let tape = Tape::record(1, settings, |_| Record::On);
        let state = tape.report.state();
        assert_eq!(state == "COMPLETE", late > 0, "{}", tape.report);
        let verification = tape.verify();
        for (one, told) in verification.instances.iter().zip(&tape.report.instances) {
            let is_copied_image = late == 0 && one.instance.starts_with("Vision");
            assert_eq!(one.dropped > 0, is_copied_image, "{verification}");
            assert_eq!(told.wanted, one.dropped + one.frames, "{verification}");
            let compared = one.verified + one.unfinished;
            assert_eq!(compared, one.frames, "{verification}");
        }
        for name in ["Control", "Audio"] {
            assert!(verified(&verification, name) > 15, "{verification}");
        }
        let cameras = ["VisionTop", "VisionBottom"].map(|name| verified(&verification, name));
        assert!(cameras.iter().all(|images| (*images > 20) == (late > 0)));
    }
}

#[test]
fn three_chunks_of_the_nao_are_recomputed_alone() {
    let settings = Settings {
        budget: 12 << 20,
        ..large()
    };
    let tape = Tape::record(1, settings, |_| Record::On);
    let file = tape.open();
    let chunks = file.chunks.len();
    assert!(file.gone > 0 && chunks >= 3, "{chunks} chunks");
    let verification = tape.verify();
    for one in &verification.instances {
        assert_eq!(one.verified + one.unfinished, one.frames, "{verification}");
    }
    assert!(verified(&verification, "VisionTop") > 3, "{verification}");
}

#[test]
fn others_read_images_transforms_joints_and_logs_in_their_own_form() {
    const NAME: &str = "others_read_images_transforms_joints_and_logs_in_their_own_form";
    let forms = [
        ("VisionTop.main_outputs.image", "foxglove.RawImage"),
        (
            "Control.main_outputs.robot_kinematics",
            "foxglove.FrameTransforms",
        ),
        ("Control.main_outputs.sensor_data", "foxglove.JointStates"),
    ];
    let about = About {
        outputs: forms.map(|(output, _)| output.to_owned()).into(),
        ..About::default()
    };
    let tape = Tape::record_with(1, about, large(), |_| Record::Off);
    assert!(tape.report.ended.is_complete, "{}", tape.report);
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/recording/foxglove.py");
    let output = match Command::new("python3").arg(script).arg(&tape.path).output() {
        Err(error) if error.kind() == ErrorKind::NotFound => return skip(NAME, "python3"),
        output => output.expect("Python can be started"),
    };
    let error = String::from_utf8_lossy(&output.stderr);
    if error.contains("No module named") {
        return skip(NAME, "pip install mcap lz4 jsonschema");
    }
    assert!(output.status.success(), "{error}");
    let told: Value = serde_json::from_slice(&output.stdout).expect("it prints JSON");
    let file = tape.open();
    for (topic, schema) in forms.into_iter().chain([("logs", "foxglove.Log")]) {
        let mut channels = file.channels.iter();
        let channel = channels.find(|(_, channel)| channel.topic == topic);
        let (number, _) = channel.expect("it has a channel");
        let messages = file.chunks.iter().flat_map(|chunk| chunk.messages());
        let own = messages.filter(|message| message.channel == *number);
        let messages = own.count();
        assert!(messages > 0, "{topic}");
        assert_eq!(
            told[topic],
            json!({ "schema": schema, "messages": messages }),
            "{told}"
        );
    }
    assert!(told[forms[0].0]["messages"].as_u64() > Some(20), "{told}");
    assert!(told[forms[1].0]["messages"].as_u64() > Some(70), "{told}");
}
