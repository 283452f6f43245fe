//! What the NAO hears, reads, feels and sees, in lockstep, against the truth that its nodes cannot see.

use std::collections::VecDeque;

use framework::{Digest, Timestamp};
use nalgebra::{Isometry2, Point2, Point3};
use simulated_nao::RobotTruth;
use support::nao::{Nao, balls, camera_of, output};
use types::audio::Whistle;
use types::ball::LearntImage;
use types::fall_state::FallState;
use types::game::{GameControllerState, GameState, Penalty, PrimaryState};
use types::network::PacketCounts;
use types::obstacles::Obstacle;
use types::odometry::Odometry;
use types::team::Teammate;

/// Until then the robot takes its pose.
const SETTLED: Timestamp = Timestamp::from_nanos(4_000_000_000);

/// A robot that so many images of the last second show is known: the filter believes five.
const IMAGES_TO_BE_SURE: usize = 10;

fn seconds(timestamp: Timestamp) -> f64 {
    timestamp.as_nanos() as f64 / 1e9
}

#[test]
fn every_whistle_is_heard_at_once_and_nothing_else_in_ten_minutes() {
    let whistles = [12.0, 47.3, 101.11, 180.5, 263.0, 264.9, 399.99, 512.25];
    let mut nao = Nao::new(
        &["--no-cameras"],
        &[(
            "hardware.simulated.sound.whistles",
            &format!("{whistles:?}"),
        )],
    );
    let (mut heard, mut last, mut wrong, mut cycles) = (Vec::new(), false, Vec::new(), 0);
    nao.run(600.0, |hardware, instance| {
        if instance.description().name != "Control" {
            return;
        }
        cycles += 1;
        let whistle: Whistle = output(instance, "whistle");
        let now = seconds(instance.cycle().time.start);
        if whistle.is_heard && !last {
            heard.push(now);
        }
        last = whistle.is_heard;
        let truth = hardware.whistles();
        let sounds = |truth: &simulated_nao::WhistleTruth| {
            (truth.begins_at..truth.begins_at + truth.duration + 1.0).contains(&now)
        };
        if whistle.is_heard && !truth.iter().any(sounds) {
            wrong.push(now);
        }
    });
    let delays: Vec<f64> = heard
        .iter()
        .zip(whistles)
        .map(|(heard, begun)| heard - begun)
        .collect();
    println!("{cycles} cycles, delays {delays:.3?}");
    assert!(cycles > 49_000, "{cycles} cycles of Control");
    assert_eq!(heard.len(), whistles.len(), "heard at {heard:?}");
    assert!(
        delays.iter().all(|delay| (0.0..=0.5).contains(delay)),
        "{delays:?}"
    );
    assert!(wrong.is_empty(), "a whistle that nobody blew at {wrong:?}");
}

const GAME: &str = r#"[
    { at = 0.0, state = "Standby" },
    { at = 2.0, state = "Ready", kicking_team = "Opponent" },
    { at = 4.0, state = "Set" },
    { at = 6.0, state = "Playing" },
    { at = 8.0, state = "Playing", penalty = "PlayerPushing" },
    { at = 10.0, state = "Playing" },
    { at = 12.0, state = "Finished" },
]"#;

#[test]
fn the_robot_is_in_the_state_that_the_packets_say() {
    let mut nao = Nao::new(
        &["--no-cameras", "--no-sound"],
        &[
            ("hardware.simulated.game.schedule", GAME),
            ("hardware.simulated.sound.whistles", "[]"),
        ],
    );
    let mut states: Vec<(f64, PrimaryState)> = Vec::new();
    let mut compared = 0;
    nao.run(14.0, |hardware, instance| {
        if instance.description().name != "Control" {
            return;
        }
        let primary_state: PrimaryState = output(instance, "primary_state");
        let now = seconds(instance.cycle().time.start);
        if states.last().is_none_or(|(_, last)| *last != primary_state) {
            states.push((now, primary_state));
        }
        let known: Option<GameControllerState> = output(instance, "game_controller_state");
        // A packet takes 1 ms, and up to one cycle until it is used.
        if let (Some(known), Some(sent)) = (known, hardware.network_truth().game_message)
            && instance.cycle().time.start - known.received_at
                < std::time::Duration::from_millis(400)
        {
            let own = sent
                .teams
                .iter()
                .find(|team| team.number == 77)
                .expect("our team plays");
            assert_eq!(known.game_state, sent.game_state, "at {now}");
            assert_eq!(known.penalty, own.players[0].penalty, "at {now}");
            assert_eq!(known.seconds_remaining, sent.seconds_remaining, "at {now}");
            compared += 1;
        }
    });
    println!("{states:?}");
    let order: Vec<PrimaryState> = states.iter().map(|(_, state)| *state).collect();
    use PrimaryState::{Finished, Penalized, Playing, Ready, Set, Standby, Unstiff};
    assert_eq!(
        order,
        [
            Unstiff, Standby, Ready, Set, Playing, Penalized, Playing, Finished
        ]
    );
    for ((at, state), said) in states[2..].iter().zip([2.0, 4.0, 6.0, 8.0, 10.0, 12.0]) {
        // The referee's computer speaks every 0.5 s.
        assert!((said..said + 0.6).contains(at), "{state:?} at {at}");
    }
    assert!(compared > 500, "{compared} comparisons");
}

#[test]
fn hostile_packets_are_counted_and_change_nothing() {
    let options = ["--no-cameras", "--no-sound"];
    let mut nao = Nao::new(&options, &[]);
    nao.run(1.0, |_, _| {});
    let hostile: [&[u8]; 4] = [b"", b"RGme", &[0xff; 118], &[0; 1500]];
    for bytes in hostile {
        nao.hardware
            .send_to_control_port(bytes)
            .expect("it has sockets");
        nao.hardware
            .send_to_team_port(bytes)
            .expect("it has sockets");
    }
    nao.run(2.0, |_, _| {});
    let network = nao.robot.instance("SplNetwork").expect("it runs");
    let counts = |name| output::<PacketCounts>(network, name);
    assert_eq!(counts("game_controller_counts").rejected, 4);
    assert_eq!(counts("team_message_counts").rejected, 4);
    assert_eq!(counts("game_controller_counts").accepted, 4);
    assert_eq!(network.report().counts.failures, 0);
    let control = nao.robot.instance("Control").expect("it runs");
    let known: Option<GameControllerState> = output(control, "game_controller_state");
    let known = known.expect("the referee is heard");
    assert_eq!(
        (known.game_state, known.penalty),
        (GameState::Initial, Penalty::None)
    );
}

#[test]
fn a_standing_robot_does_not_move_and_does_not_fall() {
    let mut nao = Nao::new(&["--no-cameras", "--no-sound"], &[]);
    let mut poses: Vec<Isometry2<f32>> = Vec::new();
    nao.run(20.0, |_, instance| {
        if instance.description().name != "Control" || instance.cycle().time.start < SETTLED {
            return;
        }
        poses.push(output::<Odometry>(instance, "odometry").ground_to_start);
        assert!(output::<bool>(instance, "has_ground_contact"));
        assert_eq!(
            output::<FallState>(instance, "fall_state"),
            FallState::Upright
        );
    });
    assert!(poses.len() > 1300, "{} cycles", poses.len());
    assert!(
        poses.iter().all(|pose| *pose == poses[0]),
        "{:?} to {:?}",
        poses[0],
        poses.last()
    );
}

#[test]
fn a_ball_that_is_seen_lies_where_it_is_said_to_lie() {
    let (mut seen, mut worst) = (0, 0.0_f32);
    for ball in ["2.9,0.3", "3.4,-0.3", "4.0,0.5"] {
        let mut nao = Nao::new(&["--ball", ball, "--no-sound"], &[]);
        nao.run(12.0, |hardware, instance| {
            let Some(camera) = camera_of(instance) else {
                return;
            };
            if instance.cycle().time.start < SETTLED {
                return;
            }
            let truth = hardware
                .image_truth(camera, instance.cycle().time.start)
                .expect("every cycle of Vision is about an image that was exposed");
            if !truth.ball.is_some_and(|ball| ball.is_whole) {
                return;
            }
            let field = hardware.ground_truth().ball.expect("there is one");
            let expected = (truth.ground_to_field.inverse() * field).xy();
            for position in balls(instance).iter().filter_map(|ball| ball.position) {
                let distance = (position - expected).norm();
                let allowed = 0.05 + 0.1 * expected.coords.norm();
                worst = worst.max(distance / allowed);
                seen += 1;
                assert!(distance <= allowed, "{position} instead of {expected}");
            }
        });
    }
    println!(
        "{seen} balls, the worst at {:.0} % of what is allowed",
        worst * 100.0
    );
    assert!(seen >= 200, "{seen} balls only");
}

/// Whether the image of this cycle shows both feet of a robot, uncovered by the image's edge, within 3.5 m.
fn is_in_sight(robot: &RobotTruth) -> bool {
    let feet = [robot.feet.left, robot.feet.right];
    let is_clear = |foot: Option<Point2<f32>>| {
        foot.is_some_and(|pixel| {
            (30.0..610.0).contains(&pixel.x) && (30.0..450.0).contains(&pixel.y)
        })
    };
    robot.position.coords.norm() <= 3.5 && feet.into_iter().all(is_clear)
}

#[test]
fn obstacles_are_the_robots_that_stand_there() {
    // Without a ball the head looks around all the time.
    let mut nao = Nao::new(&["--no-sound", "--no-ball"], &[]);
    // When an image showed each robot in the last second.
    let mut seen: Vec<VecDeque<f64>> = Vec::new();
    let (mut expected, mut known, mut reported, mut near, mut worst) = (0, 0, 0, 0, 0.0_f32);
    nao.run(14.0, |hardware, instance| {
        let time = instance.cycle().time.start;
        if time < SETTLED {
            return;
        }
        let now = seconds(time);
        let truth = hardware.ground_truth();
        if let Some(camera) = camera_of(instance) {
            let image = hardware
                .image_truth(camera, time)
                .expect("every cycle of Vision is about an image that was exposed");
            seen.resize_with(truth.robots.len(), VecDeque::new);
            for (robot, seen) in image.robots().zip(&mut seen) {
                if is_in_sight(&robot) {
                    seen.push_back(now);
                }
            }
            return;
        }
        if instance.description().name != "Control" {
            return;
        }
        let obstacles: Vec<Obstacle> = output(instance, "obstacles");
        let to_ground = truth.ground_to_field.inverse();
        let on_ground = |point: &Point2<f64>| {
            let point = Point3::from(point.cast::<f32>().coords.push(0.0));
            (to_ground * point).xy()
        };
        for (robot, seen) in truth.robots.iter().zip(&mut seen) {
            seen.retain(|at| now - at <= 1.0);
            if seen.len() < IMAGES_TO_BE_SURE {
                continue;
            }
            let robot = on_ground(&robot.position);
            let off = obstacles.iter().map(|one| (one.position - robot).norm());
            let off = off.fold(f32::MAX, f32::min);
            expected += 1;
            if off <= 0.2 + 0.1 * robot.coords.norm() {
                known += 1;
                worst = worst.max(off);
            }
        }
        let ball = truth.ball.map(|ball| (to_ground * ball).xy());
        let real: Vec<Point2<f32>> = truth
            .obstacles
            .iter()
            .map(|(at, _)| on_ground(at))
            .collect();
        for obstacle in &obstacles {
            let real = real.iter().chain(&ball);
            let off = real.map(|real| (real - obstacle.position).norm());
            reported += 1;
            near += usize::from(off.fold(f32::MAX, f32::min) <= 0.5);
        }
    });
    println!(
        "robots known in {known} of {expected} cycles after they were seen, at most {worst} m off; \
         {near} of {reported} obstacles are something real"
    );
    assert!(expected > 300, "{expected}");
    assert!(known * 100 >= expected * 95, "{known} of {expected}");
    assert!(reported > 500, "{reported}");
    assert!(near * 100 >= reported * 98, "{near} of {reported}");
}

#[test]
fn what_leaves_the_robot_is_what_people_and_computers_expect() {
    let mut nao = Nao::new(&["--no-cameras"], &[]);
    nao.run(40.0, |_, _| {});
    let network = nao.hardware.network_truth();
    let answers = network.return_data.len();
    assert!((35..=42).contains(&answers), "{answers} answers in 40 s");
    assert_eq!(network.return_data_counts.rejected, 0);
    let sent: Vec<f64> = network
        .team_messages
        .iter()
        .map(|message| seconds(message.at))
        .collect();
    assert!((4..=6).contains(&sent.len()), "messages at {sent:?}");
    // More than the budget costs all goals.
    let gaps = sent.windows(2).map(|pair| pair[1] - pair[0]);
    assert!(gaps.clone().all(|gap| gap > 6.9), "messages at {sent:?}");
    assert_eq!(network.team_message_counts.rejected, 0);
    let control = nao.robot.instance("Control").expect("it runs");
    let teammates: Vec<Teammate> = output(control, "teammates");
    let numbers: Vec<u8> = teammates
        .iter()
        .map(|mate| mate.message.player_number)
        .collect();
    assert_eq!(numbers.len(), 1, "{teammates:?}");
    assert_ne!(numbers[0], 1, "the robot is no team mate of itself");
    // The whistle at 12 s began the game: one tone for it, and none in Set.
    let tones = nao.hardware.tones();
    let whistle_tones: Vec<f64> = tones
        .iter()
        .filter(|tone| tone.message.frequency == 900.0)
        .map(|tone| seconds(tone.at))
        .collect();
    assert!(
        matches!(whistle_tones[..], [at] if (12.0..12.6).contains(&at)),
        "{tones:?}"
    );
    let in_set = tones
        .iter()
        .filter(|tone| (8.6..12.0).contains(&seconds(tone.at)));
    assert_eq!(in_set.count(), 0, "{tones:?}");
    let chest = nao.hardware.leds().chest;
    assert!(
        chest.green > 0.5 && chest.red < 0.1,
        "green while playing: {chest:?}"
    );
    assert!(output::<bool>(control, "is_recording_wanted"));
}

/// Delivered measurements of the ball filter, and a digest of everything, in one chaos.
fn chaotic(seed: u64) -> (Vec<Timestamp>, String, u64) {
    let mut nao = Nao::new(&["--ball", "2.9,0.2"], &[]);
    let access = nao.robot.access("Control").expect("it is an instance");
    assert!(access.subscriptions.subscribe("ball_filter.delivered"));
    let (mut delivered, mut digest) = (Vec::new(), Digest::default());
    nao.run_in_chaos(seed, 3.0, |_, instance| {
        digest.add_cycle(instance).expect("outputs can be digested");
        if let Some(times) = instance.additional_output("ball_filter.delivered") {
            let times = serde_json::to_value(times.as_serialize()).expect("outputs serialise");
            let images: Vec<LearntImage> = serde_json::from_value(times).expect("they are images");
            delivered.extend(images.iter().map(|image| image.captured_at));
        }
    });
    let cameras = ["VisionTop", "VisionBottom"].map(|name| {
        let report = nao.robot.instance(name).expect("it runs").report();
        report.counts.cycles
    });
    (delivered, digest.to_string(), cameras.iter().sum())
}

#[test]
fn whatever_the_chaos_the_ball_filter_takes_images_in_the_order_of_their_capture() {
    let runs: Vec<_> = (0..8).map(chaotic).collect();
    for (seed, (delivered, _, images)) in runs.iter().enumerate() {
        assert!(delivered.is_sorted(), "seed {seed}: {delivered:?}");
        assert!(
            delivered.len() as u64 + 8 >= *images,
            "seed {seed}: {} of {images}",
            delivered.len()
        );
        assert!(delivered.len() > 160, "seed {seed}: {}", delivered.len());
    }
    let mut digests: Vec<&String> = runs.iter().map(|(_, digest, _)| digest).collect();
    digests.sort();
    digests.dedup();
    assert_eq!(digests.len(), runs.len(), "every chaos is another");
    assert_eq!(chaotic(3), runs[3], "one seed is one run");
}
