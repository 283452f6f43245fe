//! Ctrl-C ends a run in order.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use framework::LiveParameters;
use framework::launch;
use framework::testing::TARGET;
use framework::{Hardware, HardwareContext, Result, Robot, Start, buffer_of};

static IN_SAFE_STATE: AtomicBool = AtomicBool::new(false);

#[derive(Clone, Debug, serde::Deserialize, framework::Reflect, serde::Serialize)]
struct Parameters {}

struct InterruptedHardware;

impl Hardware for InterruptedHardware {
    fn new(_: HardwareContext) -> Result<Self> {
        thread::spawn(|| {
            thread::sleep(Duration::from_millis(50));
            signal_hook::low_level::raise(signal_hook::consts::SIGINT).expect("a valid signal");
        });
        Ok(Self)
    }

    fn stop(&self) {}

    fn enter_safe_state(&self) {
        IN_SAFE_STATE.store(true, Ordering::Relaxed);
    }
}

// The only test of this file: signals are the whole process's.
#[test]
fn an_interrupted_run_reports_and_ends_with_130() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    std::fs::write(directory.path().join("default.toml"), "").expect("can be written");
    let arguments = [
        "--parameters".into(),
        directory.path().into(),
        "--format=json".into(),
    ];
    let create = |_: &Arc<InterruptedHardware>, start: Start<Parameters>| {
        let (parameters, [], []) = buffer_of(|| start.parameters.clone(), []);
        let (instances, access) = (Vec::new(), Vec::new());
        Ok(Robot {
            name: "test",
            clock: start.clock.clone(),
            instances,
            access,
            left_out: &[],
            remotes: Vec::new(),
            parameters: LiveParameters::new(parameters, start.parameters, start.clock),
        })
    };
    let mut output = Vec::new();
    assert_eq!(
        launch::run(TARGET, arguments, &mut output, create, launch::nobody),
        130
    );
    assert!(
        String::from_utf8(output)
            .expect("text")
            .starts_with("{\"version\":1")
    );
    assert!(IN_SAFE_STATE.load(Ordering::Relaxed));
}
