//! The whole generated robot in a world with masses, torques and contacts.

use std::path::Path;
use std::sync::Arc;

use framework::driver::lockstep::Lockstep;
use framework::parameters::Layers;
use framework::testing::created;
use framework::{Clock, Stop, Timestamp, math};
use nao_runtime::runtime;
use simulated_nao::Hardware;

/// How far a robot that stands may lean, rad; its pose leans by 0.03.
const UPRIGHT: f32 = 0.1;

#[test]
fn the_robot_stands_up_and_stands_for_a_minute() {
    let clock = Clock::stepped();
    let stop = Stop::default();
    let layers = Layers {
        directory: Path::new(env!("CARGO_MANIFEST_DIR")).join("../parameters"),
        location: Some("simulated".to_owned()),
        ..Layers::default()
    };
    let options = [
        "--no-cameras",
        "--no-sound",
        "--free-ports",
        "--game",
        "Set",
    ];
    let (hardware, mut robot): (Arc<Hardware>, _) = created(
        &layers,
        "simulated",
        &options,
        &clock,
        &stop,
        runtime::create,
    );
    let (mut stood, mut place) = (0, None);
    let end = Timestamp::from_nanos(66_000_000_000);
    Lockstep::new(&mut robot, &*hardware)
        .run_until(end, |instance| {
            let truth = hardware.ground_truth();
            let seconds = (truth.now - Timestamp::ZERO).as_secs_f64();
            if instance.description().name != "Control" || seconds < 6.0 {
                return;
            }
            let torso = truth.torso_to_field;
            let up = torso.rotation * nalgebra::Vector3::z();
            assert!(
                up.z > math::cos(UPRIGHT),
                "leans too far at {seconds} s: {up}"
            );
            let height = torso.translation.z;
            assert!(height > 0.3, "{height} m high at {seconds} s");
            let begun = *place.get_or_insert(torso.translation.vector);
            let moved = (torso.translation.vector - begun).norm();
            assert!(moved < 0.02, "{moved} m away at {seconds} s");
            stood += 1;
        })
        .unwrap();
    assert!(stood >= 5000, "{stood} of LoLA's cycles");
}
