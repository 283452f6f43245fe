//! The NAO moves, in lockstep, on legs with masses: what it does is judged by the truth, not by its own belief.

use framework::Given;
use kinematics::limits;
use nalgebra::{Isometry2, Point2, Vector2, Vector3};
use serde_json::json;
use simulated_nao::GroundTruth;
use simulated_nao::physics::Disturbance;
use support::nao::{Nao, call, output};
use types::joints::Joints;
use types::motion::{BodyMotion, MotionSelection, Script};
use types::motor_commands::MotorCommands;
use types::odometry::Odometry;
use types::sensor_data::SensorData;

/// Until then the robot has got up from sitting and stands.
const STANDS: f64 = 5.0;

/// How far a robot that walks may lean, rad.
const UPRIGHT: f32 = 0.4;

/// Commands reach LoLA as 32-bit floats; between two of them lie 12 ms.
const ROUNDING: f32 = 1e-5;

/// A robot, and what was seen of it so far.
struct Robot {
    nao: Nao,
    now: f64,
    /// The last of LoLA's commands that was judged.
    last: Option<(u64, MotorCommands)>,
    /// How far it leant at most since the last question, rad.
    lean: f32,
}

impl Robot {
    fn new(options: &[&str], settings: &[(&str, &str)]) -> Self {
        Self {
            nao: Nao::dynamic(options, settings),
            now: 0.0,
            last: None,
            lean: 0.0,
        }
    }

    /// Without cameras, in a game that does not begin, at x, y and heading.
    fn driven(pose: &str) -> Self {
        let options = [
            "--no-cameras",
            "--no-sound",
            "--game",
            "Initial",
            "--pose",
            pose,
        ];
        let mut robot = Self::new(&options, &[]);
        robot.live(STANDS, |_| {});
        robot
    }

    /// Lives on for so many seconds; every command on the way is one that harms no joint.
    fn live(&mut self, seconds: f64, mut before_each: impl FnMut(&mut Nao)) {
        let end = self.now + seconds;
        while self.now < end - 1e-9 {
            before_each(&mut self.nao);
            self.now = (self.now + 0.5).min(end);
            let lean = &mut self.lean;
            self.nao.run(self.now, |hardware, instance| {
                if instance.description().name == "Control" {
                    *lean = lean.max(tilt(&hardware.ground_truth()));
                }
            });
            self.judge_commands();
        }
    }

    /// Lives on under a client that asks for these steps twice a second.
    fn walk(&mut self, seconds: f64, forward: f32, left: f32, turn: f32) {
        self.live(seconds, |nao| {
            let step = json!({ "forward": forward, "left": left, "turn": turn });
            let _answer = call(&mut nao.robot, "walk", step);
        });
    }

    fn judge_commands(&mut self) {
        for (number, commands) in self.nao.hardware.received_commands() {
            match &self.last {
                Some((last, _)) if number <= *last => continue,
                Some((last, before)) => {
                    assert_eq!(number, last + 1, "a command that nobody has seen");
                    assert_harmless(Some(before), &commands);
                }
                None => assert_harmless(None, &commands),
            }
            self.last = Some((number, commands));
        }
    }

    fn truth(&self) -> GroundTruth {
        self.nao.hardware.ground_truth()
    }

    /// On the field: x, y in m, heading in rad.
    fn pose(&self) -> Isometry2<f32> {
        let ground = self.truth().ground_to_field;
        let ahead = ground.rotation * Vector3::x();
        let place = ground.translation.vector.xy();
        Isometry2::new(place, ahead.y.atan2(ahead.x))
    }

    /// Where it believes to be, seen from where it was first.
    fn odometry(&self) -> Isometry2<f32> {
        let control = self.nao.robot.instance("Control").expect("it runs");
        output::<Odometry>(control, "odometry").ground_to_start
    }

    fn selection(&self) -> MotionSelection {
        let control = self.nao.robot.instance("Control").expect("it runs");
        output(control, "motion_selection")
    }

    /// Pushes the torso, N s in the robot's own x and y.
    fn push(&self, impulse: [f64; 2]) {
        let ahead = self.pose().rotation.cast::<f64>();
        let aside = ahead * Vector2::from(impulse);
        self.nao.hardware.disturb(&Disturbance::Push {
            robot: 0,
            impulse: aside.push(0.0),
        });
    }

    fn greatest_lean(&mut self) -> f32 {
        std::mem::take(&mut self.lean)
    }
}

/// Between the torso's z axis and the vertical, rad.
fn tilt(truth: &GroundTruth) -> f32 {
    let up = truth.torso_to_field.rotation * Vector3::z();
    up.z.clamp(-1.0, 1.0).acos()
}

/// Within the limits of every joint, and no faster than any of them can be.
fn assert_harmless(before: Option<&MotorCommands>, commands: &MotorCommands) {
    for (joint, angle) in commands.positions.iter() {
        let stiffness = commands.stiffnesses[joint];
        assert!((0.0..=1.0).contains(&stiffness), "{joint:?}: {stiffness}");
        let nearest = limits::clamp(joint, *angle);
        assert!(
            (angle - nearest).abs() < ROUNDING,
            "{joint:?} at {angle} rad"
        );
        // What is limp only says where it is.
        let Some(before) = before.filter(|before| before.stiffnesses[joint] > 0.0) else {
            continue;
        };
        let speed = (angle - before.positions[joint]).abs() / 0.012;
        let most = limits::of(joint).velocity as f32;
        let is_slow = stiffness == 0.0 || speed <= most * 1.001 + ROUNDING / 0.012;
        assert!(is_slow, "{joint:?} shall move with {speed} of {most} rad/s");
    }
}

/// How wrong the odometry was about a way: m, and rad.
fn error(truth: [Isometry2<f32>; 2], belief: [Isometry2<f32>; 2]) -> (f32, f32) {
    let way = |[from, to]: [Isometry2<f32>; 2]| from.inverse() * to;
    let (truth, belief) = (way(truth), way(belief));
    let place: Vector2<f32> = truth.translation.vector - belief.translation.vector;
    (
        place.norm(),
        truth.rotation.angle_to(&belief.rotation).abs(),
    )
}

#[test]
fn a_client_walks_the_robot_and_its_odometry_says_where() {
    for (pose, [forward, left, turn]) in [
        ("-3.0,0.0,0.0", [0.06, 0.0, 0.0]),
        ("0.0,-2.0,1.3", [0.065, 0.0, 0.0]),
        ("1.0,1.0,3.0", [-0.04, 0.0, 0.0]),
        ("0.0,0.0,0.5", [0.0, 0.06, 0.0]),
        ("0.0,0.0,-2.0", [0.0, -0.06, 0.0]),
        ("0.0,1.0,2.0", [0.0, 0.0, 0.4]),
        ("0.5,1.0,-1.0", [0.05, 0.0, -0.2]),
    ] {
        let mut robot = Robot::driven(pose);
        let before = [robot.pose(), robot.odometry()];
        robot.greatest_lean();
        let mut turned = 0.0;
        for _ in 0..10 {
            let from = robot.pose();
            robot.walk(1.0, forward, left, turn);
            turned += from.rotation.angle_to(&robot.pose().rotation).abs();
        }
        let (lean, after) = (robot.greatest_lean(), [robot.pose(), robot.odometry()]);
        let way = before[0].inverse() * after[0];
        let (place, heading) = error([before[0], after[0]], [before[1], after[1]]);
        println!(
            "{forward} {left} {turn}: {:.2} m {:.2} m {turned:.2} rad in 10 s, lean {lean:.2} rad, odometry off by {place:.3} m {heading:.3} rad",
            way.translation.x, way.translation.y
        );
        assert!(lean < UPRIGHT, "it leant by {lean} rad");
        let distance = way.translation.vector.norm();
        let along = Vector2::new(forward, left);
        if along.norm() > 0.0 && turn == 0.0 {
            assert!(
                way.translation.vector.dot(&along.normalize()) > 0.6,
                "{way}"
            );
            assert!(way.rotation.angle().abs() < 0.5, "{way}");
        }
        // 10 % of the way, 10 degrees of each full turn.
        assert!(place < 0.1 * distance + 0.05, "{place} of {distance} m");
        let allowed = 0.05 + turned * 10.0 / 360.0;
        assert!(heading < allowed, "{heading} of {turned} rad");
    }
}

#[test]
fn a_robot_that_nobody_drives_any_more_stands() {
    let mut robot = Robot::driven("0.0,0.0,0.0");
    robot.walk(3.0, 0.05, 0.0, 0.0);
    assert!(robot.selection().is_at(BodyMotion::Walk));
    robot.live(5.0, |_| {});
    assert!(robot.selection().is_at(BodyMotion::Stand));
    let stood = robot.pose();
    robot.live(1.0, |_| {});
    let moved = (robot.pose().translation.vector - stood.translation.vector).norm();
    assert!(moved < 0.01, "{moved} m");

    robot.walk(3.0, 0.05, 0.0, 0.0);
    call(&mut robot.nao.robot, "motion", json!("Release"));
    robot.live(3.0, |_| {});
    assert!(robot.selection().is_at(BodyMotion::Stand));
    assert!(robot.greatest_lean() < UPRIGHT);
}

#[test]
fn in_the_game_the_robot_walks_to_the_ball() {
    for (pose, ball) in [("2.0,0.0,0.0", "3.4,0.4"), ("-1.0,0.5,1.0", "0.0,1.5")] {
        let options = [
            "--no-sound",
            "--game",
            "Playing",
            "--pose",
            pose,
            "--ball",
            ball,
        ];
        let mut robot = Robot::new(&options, &[]);
        // Once there it plays the ball, so it does not stay near.
        let mut nearest = f32::INFINITY;
        for _ in 0..50 {
            robot.live(0.5, |_| {});
            let truth = robot.truth();
            let ball = truth.ground_to_field.inverse() * truth.ball.expect("there is one");
            assert!(tilt(&truth) < UPRIGHT);
            if ball.x > 0.0 {
                nearest = nearest.min(ball.coords.xy().norm());
            }
        }
        println!(
            "within 25 s the ball is {nearest} m ahead, lean {}",
            robot.greatest_lean()
        );
        assert!(nearest < 0.3, "{nearest}");
    }
}

#[test]
fn whatever_a_client_puts_in_place_of_commands_no_joint_is_harmed() {
    for output in ["stand_commands", "motor_commands"] {
        let mut robot = Robot::driven("0.0,0.0,0.0");
        for absurd in [1e30_f32, -1e30] {
            let commands = MotorCommands::holding(Joints::filled(absurd), absurd);
            let commands = serde_json::to_value(commands).expect("it is data");
            let access = robot.nao.robot.access("Control").expect("it runs");
            access
                .injector
                .inject(output, &Given::from(&commands))
                .expect("it is a value of that output");
            // Every command that the body gets is judged.
            robot.live(1.0, |_| {});
        }
        let access = robot.nao.robot.access("Control").expect("it runs");
        access.injector.release_all();
        robot.live(1.0, |_| {});
    }
}

/// What broken sensors say: mostly nothing that a body can do, drawn from a number.
fn broken(number: u32, last: &SensorData) -> SensorData {
    let mut drawn = number;
    let mut next = |true_value: f32| {
        // Numerical Recipes' generator: any that is the same on every machine.
        drawn = drawn.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let anything = [
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            1e30,
            -1e30,
            -7.0,
            0.0,
            true_value,
        ];
        anything[(drawn >> 16) as usize % anything.len()]
    };
    let mut sensors = *last;
    sensors.positions = last.positions.map(&mut next);
    sensors.temperatures = last.temperatures.map(&mut next);
    sensors.inertial.gyroscope = last.inertial.gyroscope.map(&mut next);
    sensors.inertial.accelerometer = last.inertial.accelerometer.map(&mut next);
    let feet = &mut sensors.force_sensitive_resistors;
    *feet = feet.map(|resistors| resistors.map(&mut next));
    sensors
}

#[test]
fn whatever_the_sensors_say_no_joint_is_harmed() {
    let mut robot = Robot::driven("0.0,0.0,0.0");
    robot.walk(2.0, 0.05, 0.0, 0.0);
    let sensors = |robot: &Robot| {
        let control = robot.nao.robot.instance("Control").expect("it runs");
        output::<SensorData>(control, "sensor_data")
    };
    let frozen = sensors(&robot);
    let lost = SensorData::default();
    let everything = |number| broken(number, &frozen);
    let all = [frozen, lost].into_iter().chain((0..12).map(everything));
    for (number, wrong) in all.enumerate() {
        // Text with numbers would lose those that are none.
        let wrong = toml::Value::try_from(wrong).expect("it is data");
        let access = robot.nao.robot.access("Control").expect("it runs");
        access
            .injector
            .inject("sensor_data", &Given::from(&wrong))
            .expect("it is a value of that output");
        // Every command that the body gets is judged.
        robot.walk(0.5, 0.05, 0.02, 0.1);
        let access = robot.nao.robot.access("Control").expect("it runs");
        access.injector.release_all();
        robot.walk(0.3, 0.05, 0.0, 0.0);
        assert!(robot.last.is_some(), "no command came after {number}");
    }
    assert_eq!(robot.truth().harmful_commands, 0);
}

/// In a game without a ball, where the robot gets up by itself.
fn playing(pose: &str) -> Robot {
    let options = [
        "--no-cameras",
        "--no-sound",
        "--no-ball",
        "--game",
        "Playing",
        "--pose",
        pose,
    ];
    let mut robot = Robot::new(&options, &[]);
    robot.live(STANDS, |_| {});
    robot
}

#[test]
fn a_robot_that_is_pushed_over_protects_itself_and_stands_up() {
    let (front, back) = (Script::StandUpFront, Script::StandUpBack);
    let mut times = Vec::new();
    for (pose, impulse, expected) in [
        ("0.0,0.0,0.0", [3.0, 0.0], front),
        ("1.0,1.0,2.0", [3.5, 0.2], front),
        ("0.0,0.0,1.0", [-3.0, 0.0], back),
        ("-1.0,-1.0,0.7", [-3.8, 0.2], back),
    ] {
        let mut robot = playing(pose);
        assert!(tilt(&robot.truth()) < UPRIGHT);
        robot.push(impulse);
        let (mut protected, mut fell, mut begun) = (false, false, None);
        let pushed = robot.now;
        while robot.now < pushed + 14.0 {
            robot.live(0.1, |_| {});
            fell |= tilt(&robot.truth()) > 1.3;
            match robot.selection().current {
                BodyMotion::Scripted(script) if script.protects() => protected = true,
                BodyMotion::Scripted(script) if script == expected => {
                    begun.get_or_insert(robot.now);
                }
                BodyMotion::Stand | BodyMotion::Walk if begun.is_some() => break,
                _ => {}
            }
        }
        times.push(robot.now - pushed);
        robot.live(3.0, |_| {});
        let truth = robot.truth();
        assert!(
            protected && fell,
            "{protected} {fell}: the push did not knock it over"
        );
        assert!(tilt(&truth) < UPRIGHT, "it leans by {} rad", tilt(&truth));
        assert!(truth.torso_to_field.translation.z > 0.28);
        // From there it looks for the ball.
        let current = robot.selection().current;
        assert!(
            matches!(current, BodyMotion::Stand | BodyMotion::Walk),
            "{current:?}"
        );
    }
    println!("on its feet {times:.1?} s after the push");
    assert!(times.iter().all(|time| *time < 12.0), "{times:?}");
}

#[test]
fn a_robot_that_is_pushed_to_any_side_protects_itself_before_it_lies() {
    for (impulse, expected) in [
        ([-3.0, 0.0], Script::FallBackward),
        ([0.0, 4.0], Script::FallSideways),
        ([0.0, -4.0], Script::FallSideways),
    ] {
        let mut robot = playing("0.0,0.0,0.0");
        robot.push(impulse);
        let (mut scripts, pushed) = (Vec::new(), robot.now);
        while robot.now < pushed + 1.5 {
            robot.live(0.05, |_| {});
            if let BodyMotion::Scripted(script) = robot.selection().current
                && scripts.last() != Some(&script)
            {
                scripts.push(script);
            }
        }
        assert!(scripts.contains(&expected), "{impulse:?}: {scripts:?}");
        assert!(
            tilt(&robot.truth()) > 1.0,
            "{impulse:?} does not knock it over"
        );
    }
}

#[test]
fn a_client_makes_the_robot_kick_with_either_foot() {
    for (request, side, pose) in [
        ("KickLeft", 1.0, "0.0,0.0,0.0"),
        ("KickRight", -1.0, "1.0,1.0,2.0"),
    ] {
        let mut robot = Robot::driven(pose);
        let place = robot.pose() * Point2::new(0.18, side * 0.05);
        robot.nao.hardware.disturb(&Disturbance::MoveBall {
            position: place.coords.push(0.05).cast::<f64>().into(),
            velocity: Vector3::zeros(),
        });
        robot.greatest_lean();
        call(&mut robot.nao.robot, "motion", json!(request));
        robot.live(8.0, |_| {});
        let (lean, ball) = (robot.greatest_lean(), robot.truth().ball);
        let way = ball.expect("there is one").xy() - place;
        let way = robot.pose().rotation.inverse() * way;
        println!(
            "{request}: {:.2} m at {:.2} rad, lean {lean:.2} rad",
            way.norm(),
            way.y.atan2(way.x)
        );
        assert!(lean < UPRIGHT, "it leant by {lean} rad");
        assert!(robot.selection().is_at(BodyMotion::Stand), "it kicks on");
        assert!(way.x > 1.5, "{way}");
        assert!(way.y.atan2(way.x).abs() < 0.35, "{way}");
    }
}
