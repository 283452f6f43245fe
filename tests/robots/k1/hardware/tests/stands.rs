//! The generated robot on another body than the NAO's.

use std::path::Path;
use std::sync::Arc;

use framework::driver::lockstep::Lockstep;
use framework::parameters::Layers;
use framework::testing::created;
use framework::{Clock, Stop, Timestamp};
use k1_hardware::Hardware;
use k1_nodes::joints::{HEAD_YAW, LEFT_ARM, LEFT_LEG, RIGHT_ARM, RIGHT_LEG, SHOULDER_PITCH};
use k1_runtime::runtime;

/// Seconds of the world: two of standing.
const END: u64 = 4_000_000_000;

#[test]
fn a_k1_stands_and_moves_its_head_and_arms() {
    let (clock, stop) = (Clock::stepped(), Stop::new());
    let layers = Layers {
        directory: Path::new(env!("CARGO_MANIFEST_DIR")).join("../parameters"),
        ..Layers::default()
    };
    let (hardware, mut robot): (Arc<Hardware>, _) =
        created(&layers, "on_a_stand", &[], &clock, &stop, runtime::create);
    // Least and greatest angles while it stands.
    let mut ranges = [[f32::MAX, f32::MIN]; 3];
    let mut cycles = 0;
    Lockstep::new(&mut robot, &*hardware)
        .run_until(Timestamp::from_nanos(END), |_| {
            cycles += 1;
            let truth = hardware.truth();
            if cycles < 1000 {
                return;
            }
            let left = LEFT_ARM + SHOULDER_PITCH;
            let right = RIGHT_ARM + SHOULDER_PITCH;
            for (range, joint) in ranges.iter_mut().zip([HEAD_YAW, left, right]) {
                let angle = truth.body.positions[joint];
                *range = [range[0].min(angle), range[1].max(angle)];
            }
            for leg in [LEFT_LEG, RIGHT_LEG] {
                let pose = [-0.2, 0.0, 0.0, 0.4, -0.2, 0.0];
                let angles = &truth.body.positions[leg..leg + 6];
                for (angle, wanted) in angles.iter().zip(pose) {
                    assert!(
                        (angle - wanted).abs() < 0.02,
                        "{angles:?} in cycle {cycles}"
                    );
                }
            }
            for pitch in truth.sole_pitches {
                assert!(
                    pitch.abs() < 0.03,
                    "a sole leans by {pitch} in cycle {cycles}"
                );
            }
            // With stretched legs it would be 0.437 m.
            assert!(
                (truth.hip_height - 0.428).abs() < 0.003,
                "{}",
                truth.hip_height
            );
        })
        .unwrap();
    assert!(cycles >= 1990, "{cycles} cycles of 2 ms");
    assert_eq!(hardware.truth().harmful, 0);
    for [least, most] in ranges {
        assert!(least < -0.25 && most > 0.25, "{ranges:?}");
    }
}
