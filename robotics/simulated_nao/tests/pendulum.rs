//! The engine, as it is set up here, against what is known in closed form of a pendulum.

use std::f64::consts::TAU;

use kinematics::inertial::GRAVITY;
use rapier3d_f64::prelude::{
    JointAxis, MassProperties, RevoluteJointBuilder, RigidBodyBuilder, Vector,
};

use simulated_nao::physics::{STEP, empty_world};

/// From the axis to the centre of mass, m: that of a NAO's leg.
const LENGTH: f64 = 0.15;
/// kg
const MASS: f64 = 1.0;
/// About the centre of mass, kg m².
const INERTIA: f64 = 0.004;

/// The mean of the first periods of a pendulum that is let go at an angle (rad), s, and how far it swings in the last.
fn swing(amplitude: f64) -> (f64, f64) {
    let mut world = empty_world();
    let base = world.insert_body(RigidBodyBuilder::fixed());
    let center = Vector::new(0.0, 0.0, -LENGTH);
    let mass = MassProperties::new(center, MASS, Vector::new(INERTIA, INERTIA, INERTIA));
    let rod = world.insert_body(
        RigidBodyBuilder::dynamic()
            .additional_mass_properties(mass)
            .can_sleep(false),
    );
    let hinge = RevoluteJointBuilder::new(Vector::new(0.0, 1.0, 0.0));
    let handle = world
        .insert_multibody_joint(base, rod, hinge)
        .expect("two bodies can be joined");
    let angle_of = |world: &rapier3d_f64::prelude::PhysicsWorld| {
        let (multibody, link) = world.multibody_joints.get(handle).expect("it was inserted");
        let link = multibody.link(link).expect("it has a link");
        link.joint.coords()[JointAxis::AngX as usize]
    };
    let (multibody, _) = world
        .multibody_joints
        .get_mut(handle)
        .expect("it was inserted");
    multibody.damping_mut().fill(0.0);
    let mut turns = vec![0.0; multibody.ndofs()];
    if let Some(turn) = turns.last_mut() {
        *turn = amplitude;
    }
    multibody.apply_displacements(&turns);
    multibody.forward_kinematics(&world.bodies, false);
    multibody.update_rigid_bodies(&mut world.bodies, true);
    let (mut before, mut crossings, mut greatest) = (angle_of(&world), Vec::new(), 0.0_f64);
    let mut time = 0.0;
    while crossings.len() < 9 && time < 60.0 {
        world.step();
        time += STEP.as_secs_f64();
        let angle = angle_of(&world);
        if before > 0.0 && angle <= 0.0 {
            let part = before / (before - angle);
            crossings.push(time - STEP.as_secs_f64() * (1.0 - part));
            greatest = 0.0;
        }
        greatest = greatest.max(angle.abs());
        before = angle;
    }
    let periods = (crossings.len() - 1) as f64;
    (
        (crossings[crossings.len() - 1] - crossings[0]) / periods,
        greatest,
    )
}

#[test]
fn a_pendulum_swings_as_the_closed_form_says() {
    for amplitude in [0.05, 0.5_f64] {
        let moment = INERTIA + MASS * LENGTH * LENGTH;
        let small = TAU * (moment / (MASS * GRAVITY * LENGTH)).sqrt();
        // The series of the elliptic integral, to the fourth power.
        let squared = amplitude * amplitude;
        let expected = small * (1.0 + squared / 16.0 + 11.0 * squared * squared / 3072.0);
        let (period, _) = swing(amplitude);
        let error = (period - expected).abs() / expected;
        assert!(error < 0.01, "{period} s instead of {expected} s: {error}");
    }
}
