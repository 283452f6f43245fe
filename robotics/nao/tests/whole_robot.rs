//! The generated robot with the NAO's hardware, on the sockets of a simulated body.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use framework::driver::Threads;
use framework::parameters::Layers;
use framework::testing::created;
use framework::{Clock, Stop};
use nao::Hardware;
use nao_runtime::runtime;
use simulated_nao::Simulator;
use simulated_nao::settings::{PhysicsChoice, Settings};
use types::joints::Joints;

/// A busy machine may take so long for anything.
const PATIENCE: Duration = Duration::from_secs(120);

#[test]
fn the_robot_stands_up_on_another_process_body() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lola");
    let settings = Settings {
        socket: Some(path.clone()),
        physics: PhysicsChoice::Kinematic,
        ..Settings::default()
    };
    // As fast as the robot answers, so that a busy machine is no different one.
    let simulator = Simulator::paced(&settings, u64::MAX).unwrap();
    let layers = Layers {
        directory: Path::new(env!("CARGO_MANIFEST_DIR")).join("../parameters"),
        location: Some("nao".to_owned()),
        ..Layers::default()
    };
    let (clock, stop) = (Clock::wall(), Stop::new());
    let options = ["--simulator", path.to_str().unwrap()];
    let (hardware, mut robot): (Arc<Hardware>, _) =
        created(&layers, "nao", &options, &clock, &stop, runtime::create);
    let threads = Threads::new(&clock, &*hardware, &stop);
    let stands = std::thread::scope(|scope| {
        let running = scope.spawn(|| threads.run(&mut robot.instances));
        let begun = Instant::now();
        let mut stands = false;
        while !stands && begun.elapsed() < PATIENCE && !running.is_finished() {
            std::thread::sleep(Duration::from_millis(50));
            let truth = simulator.ground_truth();
            let is_stiff = truth.commands.stiffnesses.left_knee_pitch > 0.5;
            let is_high = truth.torso_to_field.translation.z > 0.3;
            stands = is_stiff && is_high && simulator.exchange().commands > 100;
        }
        stop.request();
        running.join().unwrap().unwrap();
        stands
    });
    assert!(stands, "{:?}", simulator.ground_truth().torso_to_field);
    drop((robot, hardware));
    let begun = Instant::now();
    let stiffnesses = || simulator.ground_truth().commands.stiffnesses;
    while stiffnesses() != Joints::filled(0.0) && begun.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(50));
    }
    assert_eq!(stiffnesses(), Joints::filled(0.0), "it was let down");
    assert_eq!(simulator.dropped_clients(), 0);
    let exchange = simulator.exchange();
    assert_eq!(exchange.rejected, 0, "{exchange:?}");
    assert_eq!(simulator.ground_truth().harmful_commands, 0);
}
