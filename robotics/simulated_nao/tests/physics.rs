//! The dynamic physics against closed forms, and what every robot does.

use kinematics::feet::SOLE_BELOW_ANKLE;
use kinematics::inertial::GRAVITY;
use kinematics::links::{LINKS, LinkName};
use kinematics::{forward_kinematics, limits};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use simulated_nao::physics::{
    Body, Disturbance, Dynamic, Physics, ROLLING_DECELERATION, STEP, Situation, Start, weight,
};
use simulated_nao::posture;
use types::feet::Feet;
use types::joints::Joints;
use types::motor_commands::MotorCommands;

/// Numbers without a pattern (splitmix64), always the same.
struct Numbers(u64);

impl Numbers {
    /// From -1 to 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.next(), self.next(), self.next())
    }

    /// Within the limits of the joints.
    fn joints(&mut self) -> Joints<f64> {
        Joints::from_fn(|joint| {
            let limits = limits::of(joint);
            let (middle, half) = (limits.lower + limits.upper, limits.upper - limits.lower);
            (middle + self.next() * half) / 2.0
        })
    }
}

fn world(starts: &[Start], ball: Option<[f64; 2]>) -> Dynamic {
    Dynamic::new(&Situation {
        robots: starts.to_vec(),
        ball,
        ..Situation::default()
    })
}

fn standing(pose: [f64; 3]) -> Start {
    Start {
        joints: posture::standing(),
        pose,
    }
}

fn hold(joints: Joints<f64>, stiffness: f32) -> MotorCommands {
    MotorCommands::holding(joints.map(|angle| angle as f32), stiffness)
}

fn run(physics: &mut Dynamic, seconds: f64, commands: &[MotorCommands]) {
    for _ in 0..(seconds / STEP.as_secs_f64()).round() as usize {
        physics.step(commands);
    }
}

fn pressure(body: &Body) -> f64 {
    let forces = &body.contact_forces;
    forces.left.iter().chain(&forces.right).sum()
}

#[test]
fn the_engine_has_the_links_where_the_kinematics_has_them() {
    let mut physics = world(&[standing([0.0; 3])], None);
    let mut numbers = Numbers(1);
    for pose in 0..1000 {
        let joints = numbers.joints();
        let torso = Isometry3::new(numbers.vector() * 5.0, numbers.vector() * 3.0);
        physics.place(0, &joints, &torso);
        let poses = forward_kinematics(&joints);
        let links = physics.links(0);
        let names = LINKS.iter().map(|link| link.name);
        for name in names.chain([LinkName::Torso]) {
            let expected = torso * poses.link(name);
            let actual = links[name as usize];
            let apart = (actual.translation.vector - expected.translation.vector).norm();
            assert!(apart < 1e-6, "{name:?} of pose {pose}: {apart} m");
            let turned = actual.rotation.angle_to(&expected.rotation);
            assert!(turned < 1e-6, "{name:?} of pose {pose}: {turned} rad");
        }
    }
}

#[test]
fn a_standing_robot_stands_for_a_minute_and_presses_with_its_weight() {
    let mut physics = world(&[standing([1.0, -0.5, 2.0])], None);
    let commands = [hold(posture::standing(), 0.75)];
    run(&mut physics, 1.0, &commands);
    let begun = physics.bodies()[0];
    let mut sum = 0.0;
    for _ in 0..590 {
        run(&mut physics, 0.1, &commands);
        sum += pressure(&physics.bodies()[0]);
        assert!(physics.bodies()[0].tilt() < 0.06);
    }
    let body = physics.bodies()[0];
    assert!(
        (sum / 590.0 / weight() - 1.0).abs() < 0.01,
        "{}",
        sum / 590.0
    );
    assert!((pressure(&body) / weight() - 1.0).abs() < 0.01);
    let Feet { left, right } = body.contact_forces;
    for foot in [left, right] {
        assert!((foot.iter().sum::<f64>() / weight() - 0.5).abs() < 0.05);
    }
    let moved = begun.ground_to_field().inverse() * body.ground_to_field();
    assert!(moved.translation.vector.norm() < 0.02, "{moved}");
    assert!(moved.rotation.angle() < 0.06, "{moved}");
    for (joint, angle) in body.joints.iter() {
        let off = (angle - posture::standing()[joint]).abs();
        assert!(off < 0.03, "{joint:?} is {off} rad off");
    }
    // Gravity is what an accelerometer at rest feels.
    assert!((body.proper_acceleration.norm() - GRAVITY).abs() < 0.1);
    assert!(body.angular_velocity.norm() < 0.02);
}

#[test]
fn a_falling_robot_falls_as_galileo_says() {
    let mut physics = world(&[standing([0.0; 3])], None);
    let torso = Isometry3::translation(0.0, 0.0, 3.0);
    physics.place(0, &posture::standing(), &torso);
    let start = physics.bodies()[0].center_of_mass;
    let commands = [hold(posture::standing(), 1.0)];
    run(&mut physics, 0.6, &commands);
    let body = physics.bodies()[0];
    let fallen = start.z - body.center_of_mass.z;
    let expected = GRAVITY * 0.6 * 0.6 / 2.0;
    assert!((fallen / expected - 1.0).abs() < 0.01, "{fallen} m");
    assert!((body.center_of_mass - start).xy().norm() < 1e-3);
    assert!(body.proper_acceleration.norm() < 0.1, "weightless");
    assert!(body.angular_velocity.norm() < 0.01);
    assert_eq!(pressure(&body), 0.0);
}

#[test]
fn a_ball_rolls_as_far_as_the_carpet_lets_it() {
    for speed in [0.5, 1.0, 2.0] {
        let mut physics = world(&[], Some([0.0, 0.0]));
        let radius = physics.ball().unwrap().position.z;
        physics.disturb(&Disturbance::MoveBall {
            position: Point3::new(-1.0, 1.0, radius),
            velocity: Vector3::new(speed, 0.0, 0.0),
        });
        // On its way as fast as a constant deceleration says.
        let half = speed / ROLLING_DECELERATION / 2.0;
        run(&mut physics, half, &[]);
        let on_its_way = physics.ball().unwrap().velocity.x;
        assert!((on_its_way / speed - 0.5).abs() < 0.02, "{on_its_way}");
        run(&mut physics, half + 0.5, &[]);
        let ball = physics.ball().unwrap();
        let rolled = ball.position.x + 1.0;
        let expected = speed * speed / (2.0 * ROLLING_DECELERATION);
        assert!((rolled / expected - 1.0).abs() < 0.02, "{rolled} m");
        assert!((ball.position.y - 1.0).abs() < 1e-6);
        assert!(ball.velocity.norm() < 1e-3);
    }
}

#[test]
fn a_ball_stays_in_the_goal_and_bounces_off_a_post() {
    let shoot = |y: f64| {
        let mut physics = world(&[], Some([0.0, 0.0]));
        let position = Point3::new(3.5, y, 0.05);
        let velocity = Vector3::new(4.0, 0.0, 0.5);
        physics.disturb(&Disturbance::MoveBall { position, velocity });
        run(&mut physics, 6.0, &[]);
        physics.ball().unwrap().position
    };
    let scored = shoot(0.3);
    assert!(scored.x > 4.5 && scored.x < 5.05, "{scored}");
    let missed = shoot(0.8);
    assert!(missed.x < 4.4, "{missed}");
}

#[test]
fn a_robot_without_torque_falls() {
    let mut physics = world(&[standing([0.0; 3])], None);
    run(&mut physics, 1.0, &[hold(posture::standing(), 0.75)]);
    assert!(physics.bodies()[0].tilt() < 0.06);
    run(&mut physics, 3.0, &[hold(posture::standing(), 0.0)]);
    let body = physics.bodies()[0];
    let height = body.torso_to_field.translation.z;
    assert!(
        height < 0.2,
        "the torso is still {height} m above the floor"
    );
}

#[test]
fn a_limp_robot_keeps_sitting() {
    let (joints, pose) = (posture::sitting(), [0.0; 3]);
    let mut physics = world(&[Start { joints, pose }], None);
    run(&mut physics, 3.0, &[hold(joints, 0.0)]);
    let tilt = physics.bodies()[0].tilt();
    assert!(tilt < 0.1, "{tilt} rad");
}

#[test]
fn a_robot_lifted_and_let_go_lands_on_its_feet() {
    let mut physics = world(&[standing([0.0; 3])], None);
    let torso = physics.bodies()[0].torso_to_field;
    let lifted = Translation3::new(0.0, 0.0, 0.03) * torso;
    physics.place(0, &posture::standing(), &lifted);
    run(&mut physics, 2.0, &[hold(posture::standing(), 1.0)]);
    assert!(physics.bodies()[0].tilt() < 0.1);
}

#[test]
fn piles_of_robots_come_to_rest() {
    let mut numbers = Numbers(7);
    let starts: Vec<_> = (0..4).map(|_| standing([0.0; 3])).collect();
    let mut physics = world(&starts, Some([0.3, 0.0]));
    for robot in 0..starts.len() {
        let turn = UnitQuaternion::from_scaled_axis(numbers.vector() * 3.0);
        let place = numbers.vector() * 0.05 + Vector3::z() * (0.6 + 0.4 * robot as f64);
        let torso = Isometry3::from_parts(place.into(), turn);
        physics.place(robot, &numbers.joints(), &torso);
    }
    let commands = vec![hold(posture::standing(), 0.3); starts.len()];
    let mut fastest: f64 = 0.0;
    let mut before: Vec<_> = physics.bodies().to_vec();
    for _ in 0..2000 {
        physics.step(&commands);
        for (body, before) in physics.bodies().iter().zip(&mut before) {
            let moved = body.center_of_mass - before.center_of_mass;
            fastest = fastest.max(moved.norm() / STEP.as_secs_f64());
            *before = *body;
        }
    }
    // Nobody falls faster than from the height of the pile.
    assert!(fastest < (2.0 * GRAVITY * 2.2_f64).sqrt(), "{fastest} m/s");
    let resting: Vec<_> = physics.bodies().to_vec();
    run(&mut physics, 0.3, &commands);
    for (body, before) in physics.bodies().iter().zip(&resting) {
        let moved = (body.center_of_mass - before.center_of_mass).norm();
        assert!(moved < 0.1, "{moved} m in 0.3 s");
        let height = body.center_of_mass.z;
        assert!((0.0..0.6).contains(&height), "{height} m");
        assert!(body.center_of_mass.coords.xy().norm() < 2.0);
    }
}

#[test]
fn joints_reach_their_targets_no_faster_than_their_motors() {
    let mut physics = world(&[standing([0.0; 3])], None);
    let mut target = posture::standing();
    target.head_yaw = 1.0;
    target.left_shoulder_roll = 1.0;
    target.left_hand = 0.5;
    let mut before = physics.bodies()[0].joints;
    for _ in 0..300 {
        physics.step(&[hold(target, 1.0)]);
        let joints = physics.bodies()[0].joints;
        for (joint, angle) in joints.iter() {
            let speed = (angle - before[joint]).abs() / STEP.as_secs_f64();
            let most = limits::of(joint).velocity;
            assert!(speed < 1.05 * most, "{joint:?}: {speed} rad/s");
        }
        before = joints;
    }
    assert!((before.head_yaw - 1.0).abs() < 0.02, "{}", before.head_yaw);
    assert!((before.left_shoulder_roll - 1.0).abs() < 0.03);
    assert_eq!(before.left_hand, 0.5);
}

#[test]
fn the_hips_turn_together() {
    let mut physics = world(&[standing([0.0; 3])], None);
    let hanging = Isometry3::translation(0.0, 0.0, 3.0);
    physics.place(0, &posture::standing(), &hanging);
    let mut target = posture::standing();
    target.hip_yaw_pitch = -0.6;
    run(&mut physics, 0.4, &[hold(target, 1.0)]);
    let links = physics.links(0);
    let angle = |pelvis: LinkName| {
        (links[LinkName::Torso as usize].inverse() * links[pelvis as usize])
            .rotation
            .angle()
    };
    let (left, right) = (angle(LinkName::LeftPelvis), angle(LinkName::RightPelvis));
    assert!((left - 0.6).abs() < 0.05, "{left}");
    assert!((left - right).abs() < 0.005, "{left} and {right}");
}

#[test]
fn the_same_pushes_give_the_same_bits() {
    let run_once = |strength: f64| {
        let mut physics = world(
            &[standing([0.0; 3]), standing([0.3, 0.0, 1.0])],
            Some([0.2, 0.1]),
        );
        let commands = [hold(posture::standing(), 0.6); 2];
        let mut numbers = Numbers(3);
        for _ in 0..10 {
            let impulse = numbers.vector() * strength;
            physics.disturb(&Disturbance::Push { robot: 0, impulse });
            run(&mut physics, 0.15, &commands);
        }
        let bodies = physics.bodies().iter();
        let mut bits: Vec<_> = bodies
            .flat_map(|body| {
                let torso = body.torso_to_field.to_homogeneous();
                let numbers = torso.iter().chain(body.joints.each_ref()).copied();
                numbers.map(f64::to_bits).collect::<Vec<_>>()
            })
            .collect();
        let ball = physics.ball().unwrap().position;
        bits.extend(ball.iter().map(|number| number.to_bits()));
        bits
    };
    assert_eq!(run_once(1.0), run_once(1.0));
    assert_ne!(run_once(1.0), run_once(1.000_001));
}

#[test]
fn a_push_moves_and_a_strong_one_fells() {
    let push = |strength: f64| {
        let mut physics = world(&[standing([0.0; 3])], None);
        let commands = [hold(posture::standing(), 0.75)];
        run(&mut physics, 0.5, &commands);
        let impulse = Vector3::new(0.0, strength, 0.0);
        physics.disturb(&Disturbance::Push { robot: 0, impulse });
        physics.step(&commands);
        // Felt at once.
        let sideways = physics.bodies()[0].proper_acceleration.y;
        run(&mut physics, 3.0, &commands);
        (sideways, physics.bodies()[0].tilt())
    };
    let (felt, tilt) = push(0.3);
    assert!(felt > 3.0, "{felt} m/s²");
    assert!(tilt < 0.1, "{tilt} rad");
    let (_, tilt) = push(8.0);
    assert!(tilt > 1.0, "{tilt} rad");
}

#[test]
fn a_kidnapped_robot_stands_elsewhere() {
    let mut physics = world(&[standing([0.0; 3])], None);
    let commands = [hold(posture::standing(), 0.75)];
    run(&mut physics, 0.5, &commands);
    let pose = [-2.0, 1.5, 1.0];
    physics.disturb(&Disturbance::Kidnap { robot: 0, pose });
    run(&mut physics, 1.0, &commands);
    let body = physics.bodies()[0];
    let ground = body.ground_to_field().translation.vector;
    assert!(
        (ground - Vector3::new(-2.0, 1.5, 0.0)).norm() < 0.01,
        "{ground}"
    );
    assert!(body.tilt() < 0.06);
}

#[test]
fn disturbing_what_is_not_there_changes_nothing() {
    let mut physics = world(&[], None);
    let pose = [0.0; 3];
    physics.disturb(&Disturbance::Kidnap { robot: 3, pose });
    let impulse = Vector3::x();
    physics.disturb(&Disturbance::Push { robot: 3, impulse });
    let (position, velocity) = (Point3::origin(), Vector3::x());
    physics.disturb(&Disturbance::MoveBall { position, velocity });
    physics.step(&[]);
    assert!(physics.bodies().is_empty() && physics.ball().is_none());
}

#[test]
fn a_bystander_stands_until_somebody_runs_into_it() {
    let mut physics = Dynamic::new(&Situation {
        robots: vec![standing([0.0; 3])],
        bystanders: vec![standing([1.0, 0.0, 3.0])],
        ..Situation::default()
    });
    let commands = [hold(posture::standing(), 1.0)];
    let upright = |physics: &Dynamic| (physics.bystanders()[0].rotation * Vector3::z()).z;
    run(&mut physics, 2.0, &commands);
    assert!(upright(&physics) > 0.99);
    // Thrown at it.
    let torso = Isometry3::translation(0.78, 0.0, SOLE_BELOW_ANKLE + 0.4);
    physics.place(0, &posture::standing(), &torso);
    let impulse = Vector3::new(20.0, 0.0, 0.0);
    physics.disturb(&Disturbance::Push { robot: 0, impulse });
    run(&mut physics, 3.0, &commands);
    assert!(upright(&physics) < 0.5, "{}", upright(&physics));
}
