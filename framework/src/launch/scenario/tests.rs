//! What came of a recording is part of what was played.

use hulkgen_recording::Ended;

use super::*;

fn with(report: RecordingReport) -> Played {
    let mut played = Played {
        seed: 1,
        passed: true,
        stopped: None,
        failures: 0,
        digests: Vec::new(),
        recordings: Vec::new(),
        assertions: Vec::new(),
        lasted: 1.0,
        real_time_factor: 1.0,
    };
    add(&mut played, report);
    played
}

fn report(is_outstanding: bool) -> RecordingReport {
    let ended = Ended {
        path: "run.mcap".into(),
        is_complete: !is_outstanding,
        error: None,
        is_outstanding,
    };
    RecordingReport {
        ended,
        instances: Vec::new(),
        missing: Vec::new(),
    }
}

#[test]
fn a_run_whose_disk_does_not_take_its_recording_has_not_passed() {
    let played = with(report(false));
    assert!(played.passed && played.stopped.is_none(), "{played:?}");
    let played = with(report(true));
    assert!(!played.passed, "{played:?}");
    let why = played.stopped.as_deref().unwrap_or_default();
    assert!(why.starts_with("its recording run.mcap: the disk"), "{why}");
    assert_eq!(played.recordings, [PathBuf::from("run.mcap")]);
}
