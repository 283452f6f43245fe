//! Robots that fall onto each other.

use nalgebra::{Isometry3, Vector3};
use simulated_nao::physics::{Dynamic, Physics, Situation, Start};
use simulated_nao::posture;

/// s
const STEP: f64 = 0.003;

#[test]
fn a_pile_of_limp_robots_comes_to_rest() {
    let start = |place: u8| Start {
        joints: posture::standing(),
        pose: [f64::from(place), 0.0, 0.0],
    };
    let situation = Situation {
        robots: (0..5).map(start).collect(),
        ..Situation::default()
    };
    let mut world = Dynamic::new(&situation);
    // Lying across each other, one above the other.
    for (robot, height) in (0_u8..5).zip([0.3, 0.6, 0.9, 1.2, 1.5]) {
        let turn = Vector3::z() * (0.7 * f64::from(robot));
        let upright = Isometry3::new(Vector3::new(0.0, 0.0, height), turn);
        let lying = upright * Isometry3::rotation(Vector3::y() * 1.5);
        world.place(robot.into(), &posture::standing(), &lying);
    }
    let places = |world: &Dynamic| {
        let bodies = world.bodies().iter();
        bodies
            .map(|body| body.torso_to_field.translation.vector)
            .collect::<Vec<_>>()
    };
    let mut fastest: f64 = 0.0;
    let mut before = places(&world);
    for step in 0..2000 {
        world.step(&[]);
        let now = places(&world);
        for (now, before) in now.iter().zip(&before) {
            let speed = (now - before).norm() / STEP;
            assert!(
                speed.is_finite() && speed < 6.0,
                "{speed} m/s at step {step}"
            );
            if step > 1800 {
                fastest = fastest.max(speed);
            }
        }
        before = now;
    }
    assert!(
        fastest < 0.5,
        "after 5 s somebody still moves at {fastest} m/s"
    );
    for place in before {
        assert!(place.norm() < 2.0 && place.z > 0.0, "{place:?}");
    }
}
