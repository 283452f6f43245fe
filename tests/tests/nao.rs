//! What the NAO does, in lockstep, against the truth that its nodes cannot see.

use framework::{Digest, Timestamp};
use simulated_nao::ImageTruth;
use support::nao::{Nao, balls, camera_matrix, camera_of, output};
use types::joints::{JointName, Joints};
use types::sensor_data::SensorData;

/// Until then the robot takes its pose.
const SETTLED: Timestamp = Timestamp::from_nanos(3_000_000_000);
const WAYS: [&str; 3] = ["1.6,0.3,0.1", "2.2,-0.2,-0.15", "1.9,0.0,0.0"];

#[test]
fn camera_matrices_project_the_penalty_mark_while_the_head_scans() {
    let (mut shown, mut near, mut worst) = (0, 0, 0.0_f32);
    let mut directions: Vec<f32> = Vec::new();
    for pose in WAYS {
        // Before the kick-off, which no whistle announces, nobody walks.
        let mut nao = Nao::new(&["--pose", pose, "--game", "Set", "--no-sound"], &[]);
        nao.run(20.0, |hardware, instance| {
            let Some(camera) = camera_of(instance) else {
                return;
            };
            let cycle = instance.cycle();
            if cycle.time.start < SETTLED {
                return;
            }
            let truth = hardware
                .image_truth(camera, cycle.time.start)
                .expect("every cycle of Vision is about an image that was exposed");
            for mark in ImageTruth::penalty_marks() {
                let Some(pixel) = truth.project(mark) else {
                    continue;
                };
                shown += 1;
                directions.push(truth.camera_matrix.ground_to_camera.rotation.angle());
                let mark_on_ground = truth.ground_to_field.inverse() * mark;
                let projected = camera_matrix(instance)
                    .and_then(|matrix| matrix.ground_to_pixel(mark_on_ground));
                let distance = projected.map_or(f32::INFINITY, |seen| (seen - pixel).norm());
                worst = worst.max(distance);
                near += usize::from(distance <= 5.0);
            }
        });
    }
    println!("{near} of {shown} projections within 5 px, worst {worst:.1} px");
    assert!(
        shown >= 200,
        "the head looks at a penalty mark in {shown} images only"
    );
    let (least, most) = directions
        .iter()
        .fold((f32::MAX, f32::MIN), |(least, most), angle| {
            (least.min(*angle), most.max(*angle))
        });
    assert!(most - least > 0.1, "the head does not scan");
    assert!(near * 100 >= shown * 95, "{near} of {shown} within 5 px");
}

#[test]
fn the_ball_is_seen_where_it_is() {
    let (mut shown, mut found) = (0, 0);
    for ball in ["2.9,0.3", "3.4,-0.3", "2.6,0.0", "4.0,0.5"] {
        let mut nao = Nao::new(&["--pose", "2.0,0.0,0.0", "--ball", ball], &[]);
        nao.run(15.0, |hardware, instance| {
            let Some(camera) = camera_of(instance) else {
                return;
            };
            let cycle = instance.cycle();
            if cycle.time.start < SETTLED {
                return;
            }
            let truth = hardware
                .image_truth(camera, cycle.time.start)
                .expect("every cycle of Vision is about an image that was exposed");
            let Some(ball) = truth.ball.filter(|ball| ball.is_whole) else {
                return;
            };
            shown += 1;
            found += usize::from(
                balls(instance)
                    .iter()
                    .any(|seen| (seen.center - ball.center).norm() <= 15.0),
            );
        });
    }
    println!("{found} of {shown} balls found within 15 px");
    assert!(shown >= 100, "the ball is shown in {shown} images only");
    assert!(found * 100 >= shown * 80, "{found} of {shown} found");
}

#[test]
fn no_ball_is_seen_where_there_is_none() {
    let mut images = 0;
    let mut seen = Vec::new();
    for pose in ["2.0,0.0,0.0", "-1.0,1.0,2.0"] {
        let mut nao = Nao::new(&["--no-ball", "--pose", pose], &[]);
        nao.run(6.0, |_, instance| {
            if camera_of(instance).is_some() && instance.cycle().time.start >= SETTLED {
                images += 1;
                seen.extend(balls(instance));
            }
        });
    }
    println!("{} balls in {images} images without", seen.len());
    assert!(images >= 100, "{images} images only");
    assert!(seen.is_empty(), "{seen:?}");
}

#[test]
fn joints_reach_the_commanded_pose_within_their_velocity_limits() {
    let mut nao = Nao::new(&[], &[]);
    let mut last: Option<(Timestamp, Joints<f32>)> = None;
    let mut moved = 0.0_f32;
    nao.run(6.0, |_, instance| {
        if instance.description().name != "Control" {
            return;
        }
        let sensors: SensorData = output(instance, "sensor_data");
        let now = instance.cycle().time.start;
        if let Some((before, positions)) = &last {
            let seconds = (now - *before).as_secs_f32();
            for joint in JointName::ALL {
                let change = (sensors.positions[joint] - positions[joint]).abs();
                let limit = kinematics::limits::of(joint).velocity as f32 * seconds;
                assert!(
                    change <= limit * 1.001 + 1e-5,
                    "{joint:?} moved {change} rad, {limit} allowed"
                );
                moved = moved.max(change);
            }
        }
        last = Some((now, sensors.positions));
    });
    assert!(moved > 0.0, "nothing moved");
    let truth = nao.hardware.ground_truth();
    for joint in JointName::ALL {
        let difference = (truth.positions[joint] - truth.commands.positions[joint]).abs();
        // The head keeps moving, so it follows its command by at most one step.
        assert!(
            difference < 0.02,
            "{joint:?} is {difference} rad from its command"
        );
    }
    // The ready pose bends the knees.
    assert!(
        truth.positions[JointName::LeftKneePitch] > 0.5,
        "{:?}",
        truth.positions
    );
}

#[test]
fn the_eyes_and_the_memory_know_the_ball() {
    let mut nao = Nao::new(&["--pose", "2.0,0.0,0.0", "--ball", "2.9,0.2"], &[]);
    nao.run(12.0, |_, _| {});
    let control = nao.robot.instance("Control").expect("Control runs");
    let ball: Option<types::ball::Ball> = output(control, "ball");
    let ball = ball.expect("the ball lies in front of the robot and was scanned");
    let truth = nao.hardware.ground_truth();
    let expected = truth.ground_to_field.inverse() * truth.ball.expect("there is one");
    assert!(
        (ball.position - expected.xy()).norm() < 0.15,
        "{ball:?} instead of {expected}"
    );
}

#[test]
fn garbled_packets_and_images_are_counted_and_skipped() {
    let mut nao = Nao::new(&[], &[]);
    nao.run(0.5, |_, _| {});
    nao.hardware.garble_next_state();
    nao.hardware
        .garble_next_image(types::camera::CameraPosition::Top);
    nao.run(1.5, |_, _| {});
    let report = |name: &str| nao.robot.instance(name).expect("it runs").report();
    for (name, garbled) in [("Control", 1), ("VisionTop", 1), ("VisionBottom", 0)] {
        assert_eq!(report(name).counts.no_events, garbled, "{name}");
    }
    assert_eq!(nao.hardware.counts().rejected, 1, "states of LoLA");
    assert!(report("Control").counts.cycles > 110, "Control went on");
    assert!(report("VisionTop").counts.cycles > 40, "VisionTop went on");
}

/// A digest of every main output of every cycle of every instance.
fn digest_of_a_run(pose: &str) -> (String, u64) {
    let mut nao = Nao::new(&["--pose", pose], &[]);
    let (mut all, mut cycles) = (Digest::default(), 0);
    nao.run(3.0, |_, instance| {
        all.add_cycle(instance).expect("outputs can be digested");
        cycles += 1;
    });
    (all.to_string(), cycles)
}

#[test]
fn the_same_run_twice_gives_the_same_bits_and_another_run_others() {
    let (first, cycles) = digest_of_a_run("2.0,0.0,0.0");
    assert!(cycles > 350, "{cycles} cycles");
    assert_eq!((first.clone(), cycles), digest_of_a_run("2.0,0.0,0.0"));
    assert_ne!(first, digest_of_a_run("2.0,0.1,0.0").0);
}
