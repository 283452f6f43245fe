//! The rover against ground truth: in virtual time, again, and in threads.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use framework::launch::{self, Target};
use framework::parameters::Layers;
use framework::testing::{self, created};
use framework::{Clock, Hardware as _, Lockstep, Robot, Stop, Threads, Timestamp};
use rover_runtime::{parameters::Parameters, runtime};
use rover_simulation::Hardware;

/// As the parameters say; the way is about 12 m.
const GOALS: [[f64; 2]; 4] = [[3.6, 0.0], [3.6, 2.6], [0.2, 2.4], [0.0, 0.0]];

fn example(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn rover(clock: &Clock, stop: &Stop) -> (Arc<Hardware>, Robot<Parameters>) {
    let layers = Layers {
        directory: example("parameters"),
        ..Layers::default()
    };
    created(&layers, "room", &[], clock, stop, runtime::create)
}

fn place(hardware: &Hardware) -> [f64; 2] {
    let truth = hardware.truth();
    [0, 1].map(|axis| truth["place"][axis].as_f64().expect("it is a number"))
}

/// Drives for a minute; gives every place.
fn driven() -> Vec<[f64; 2]> {
    let (hardware, mut robot) = rover(&Clock::stepped(), &Stop::new());
    let mut places = Vec::new();
    Lockstep::new(&mut robot, &*hardware)
        .run_until(Timestamp::from_nanos(60_000_000_000), |_| {
            places.push(place(&hardware));
        })
        .expect("nothing ends it");
    places
}

#[test]
fn it_comes_to_every_goal_in_their_order() {
    let places = driven();
    let mut rest = places.iter();
    for [x, y] in GOALS {
        let reached = rest.any(|place| (place[0] - x).hypot(place[1] - y) < 0.3);
        assert!(reached, "it never comes to {x}, {y}");
    }
}

#[test]
fn it_drives_the_same_way_again() {
    assert_eq!(driven(), driven());
}

#[test]
fn its_scenario_passes() {
    const ROOM: Target = Target {
        robot: "rover",
        name: "room",
        ..testing::TARGET
    };
    let arguments = [
        "--parameters".into(),
        example("parameters").into_os_string(),
        "--scenario".into(),
        example("scenario.toml").into_os_string(),
        "--record".into(),
        "off".into(),
        "--format".into(),
        "json".into(),
    ];
    let mut output = Vec::new();
    let create = runtime::create::<Hardware>;
    let status = launch::run(ROOM, arguments, &mut output, create, launch::nobody);
    assert_eq!(status, 0, "{}", String::from_utf8_lossy(&output));
}

#[test]
fn it_drives_in_threads() {
    let (clock, stop) = (Clock::wall(), Stop::new());
    let (hardware, mut robot) = rover(&clock, &stop);
    let driver = std::thread::spawn({
        let (hardware, stop) = (hardware.clone(), stop.clone());
        move || {
            // However slow this machine is just now.
            let end = Instant::now() + Duration::from_secs(60);
            while place(&hardware)[0] < 0.3 && Instant::now() < end {
                std::thread::sleep(Duration::from_millis(20));
            }
            stop.request();
        }
    });
    Threads::new(&clock, &*hardware, &stop)
        .run(&mut robot.instances)
        .expect("nothing ends it before");
    driver.join().expect("it only looks");
    let truth = hardware.truth();
    assert!(place(&hardware)[0] >= 0.3, "{truth}");
    assert_eq!(truth["collisions"], 0, "{truth}");
}
