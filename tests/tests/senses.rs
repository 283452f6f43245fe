//! What the NAO hears, reads, feels and sees, in lockstep, against the truth that its nodes cannot see.

use std::collections::{BTreeSet, VecDeque};

use framework::report::QueueReport;
use framework::{Digest, Timestamp};
use nalgebra::{Isometry2, Point2, Point3};
use simulated_nao::scene::{Robot, Team};
use simulated_nao::{BallTruth, GroundTruth, ImageTruth, RobotTruth};
use spl_messages::{control_data, team_message};
use support::nao::{Nao, balls, camera_of, output};
use types::audio::Whistle;
use types::ball::LearntImage;
use types::fall_state::FallState;
use types::game::{
    GameControllerMessage, GameControllerState, GameState, KickingTeam, PrimaryState,
};
use types::leds::Leds;
use types::motion::{BodyMotion, HeadMotion, MotionCommand};
use types::network::PacketCounts;
use types::obstacles::Obstacle;
use types::odometry::Odometry;
use types::team::{TeamMessage, Teammate};

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
    { at = 6.0, state = "Playing", score = [2, 0] },
    { at = 8.0, state = "Playing", score = [2, 1], penalty = "PlayerPushing", kicking_team = "Nobody" },
    { at = 10.0, state = "Playing", score = [2, 1] },
    { at = 12.0, state = "Finished", score = [2, 3] },
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
    let (mut compared, mut penalized) = (0, 0);
    let (mut kickers, mut scores) = (BTreeSet::new(), BTreeSet::new());
    nao.run(14.0, |hardware, instance| {
        if instance.description().name != "Control" {
            return;
        }
        let primary_state: PrimaryState = output(instance, "primary_state");
        let now = seconds(instance.cycle().time.start);
        if states.last().is_none_or(|(_, last)| *last != primary_state) {
            states.push((now, primary_state));
        }
        let command: MotionCommand = output(instance, "motion_command");
        let chest = output::<Option<Leds>>(instance, "leds")
            .expect("the node does not fail")
            .chest;
        let is_penalized = primary_state == PrimaryState::Penalized;
        assert_eq!(command.body == BodyMotion::Penalized, is_penalized, "{now}");
        let is_red = chest.red > 0.5 && chest.green < 0.1 && chest.blue < 0.1;
        assert_eq!(is_red, is_penalized, "{chest:?} at {now}");
        penalized += usize::from(is_penalized);
        let known: Option<GameControllerState> = output(instance, "game_controller_state");
        // A packet takes 1 ms, and up to one cycle until it is used.
        if let (Some(known), Some(sent)) = (known, hardware.network_truth().game_message)
            && instance.cycle().time.start - known.received_at
                < std::time::Duration::from_millis(400)
        {
            let [own, opponent] = sent.teams;
            assert_eq!(own.number, 77);
            let kicking_team = match sent.kicking_team {
                Some(77) => KickingTeam::Own,
                Some(_) => KickingTeam::Opponent,
                None => KickingTeam::Nobody,
            };
            assert_eq!(known.game_state, sent.game_state, "at {now}");
            assert_eq!(known.kicking_team, kicking_team, "at {now}");
            assert_eq!(known.penalty, own.players[0].penalty, "at {now}");
            assert_eq!(known.seconds_remaining, sent.seconds_remaining, "at {now}");
            let score = [known.own_score, known.opponent_score];
            assert_eq!(score, [own.score, opponent.score], "at {now}");
            assert_eq!(known.message_budget, own.message_budget, "at {now}");
            assert!(known.message_budget > 0);
            kickers.insert(format!("{kicking_team:?}"));
            scores.insert(score);
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
    assert!(penalized > 100, "penalised in {penalized} cycles");
    assert_eq!(kickers.len(), 3, "{kickers:?}");
    assert_eq!(scores.len(), 4, "{scores:?}");
}

#[test]
fn hostile_packets_are_counted_and_change_nothing() {
    let options = ["--no-cameras", "--no-sound", "--game", "Playing"];
    let mut nao = Nao::new(&options, &[]);
    nao.run(1.0, |_, _| {});
    let before = game_and_mates(&nao);
    assert_eq!(before.0.game_state, GameState::Playing);
    assert_eq!(before.1.len(), 1, "{:?}", before.1);

    // What would end the game, and what would make the mate fall, but for one byte.
    let end = control_data::encode(&GameControllerMessage {
        game_state: GameState::Finished,
        packet_number: 10,
        ..nao.hardware.network_truth().game_message.expect("it spoke")
    });
    let fallen = TeamMessage {
        player_number: 2,
        is_fallen: true,
        ..TeamMessage::default()
    };
    let mut room = [0; team_message::GREATEST_LENGTH];
    let fallen = team_message::encode(&fallen, &mut room).expect("it can be said");
    let with_version = |bytes: &[u8], version: u8| {
        let mut bytes = bytes.to_vec();
        bytes[4] = version;
        bytes
    };
    let [end_of_another_version, fallen_of_another_version] =
        [with_version(&end, 17), with_version(fallen, 2)];
    let hostile: [&[u8]; 8] = [
        b"",
        b"RGme",
        &[0xff; 118],
        &[0; 1500],
        &end_of_another_version,
        &end[..117],
        &fallen_of_another_version,
        &fallen[..fallen.len() - 1],
    ];
    for (bytes, until) in hostile.into_iter().zip(1..) {
        nao.hardware
            .send_to_control_port(bytes)
            .expect("it has sockets");
        nao.hardware
            .send_to_team_port(bytes)
            .expect("it has sockets");
        // Time for two cycles and a packet of somebody else.
        nao.run(1.0 + 0.07 * f64::from(until), |_, _| {});
    }
    nao.run(2.0, |_, _| {});
    let network = nao.robot.instance("SplNetwork").expect("it runs");
    let counts = |name| output::<PacketCounts>(network, name);
    assert_eq!(counts("game_controller_counts").rejected, 8);
    assert_eq!(counts("team_message_counts").rejected, 8);
    // The referee's computer and the mate were heard meanwhile, and say the same.
    assert_eq!(counts("game_controller_counts").accepted, 4);
    assert_eq!(counts("team_message_counts").accepted, 2);
    let (game, mates) = before;
    let game = GameControllerState {
        // The mate's second message was counted, nothing else.
        message_budget: game.message_budget - 1,
        ..game
    };
    assert_eq!(game_and_mates(&nao), (game, mates));
    // Whole and of the right version they would not be harmless.
    nao.hardware
        .send_to_control_port(&end)
        .expect("it has sockets");
    nao.hardware
        .send_to_team_port(fallen)
        .expect("it has sockets");
    nao.run(2.09, |_, _| {});
    let network = nao.robot.instance("SplNetwork").expect("it runs");
    let counts = |name| output::<PacketCounts>(network, name);
    assert_eq!(counts("game_controller_counts").accepted, 5);
    assert!(game_and_mates(&nao).1[0].is_fallen);
}

/// What the robot knows from others, without the times and clocks that go on.
fn game_and_mates(nao: &Nao) -> (GameControllerState, Vec<TeamMessage>) {
    let control = nao.robot.instance("Control").expect("it runs");
    let game: Option<GameControllerState> = output(control, "game_controller_state");
    let game = GameControllerState {
        received_at: Timestamp::ZERO,
        seconds_remaining: 0,
        ..game.expect("the referee is heard")
    };
    let mates: Vec<Teammate> = output(control, "teammates");
    (game, mates.into_iter().map(|mate| mate.message).collect())
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
    // Taking its pose the robot has moved its feet, but not from its place.
    let (way, turn) = (
        poses[0].translation.vector.norm(),
        poses[0].rotation.angle(),
    );
    println!("{way} m and {turn} rad from the start");
    assert!(way < 0.01 && turn.abs() < 0.01, "{way} m, {turn} rad");
}

/// Whether no pixel of the image can show the ball.
fn is_out_of_sight(truth: &ImageTruth) -> bool {
    truth.ball.is_none_or(|BallTruth { center, radius, .. }| {
        let is_within =
            |place: f32, size: f32| (-radius - 1.0..size + radius + 1.0).contains(&place);
        !is_within(center.x, 640.0) || !is_within(center.y, 480.0)
    })
}

#[test]
fn a_ball_that_is_seen_lies_where_it_is_said_to_lie() {
    let (mut seen, mut worst, mut without, mut wrong) = (0, 0.0_f32, 0, Vec::new());
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
            let found = balls(instance);
            if is_out_of_sight(&truth) {
                without += 1;
                wrong.extend(found);
                return;
            }
            if !truth.ball.is_some_and(|ball| ball.is_whole) {
                return;
            }
            let field = hardware.ground_truth().ball.expect("there is one");
            let expected = (truth.ground_to_field.inverse() * field).xy();
            for ball in found {
                let position = ball
                    .position
                    .expect("the robot stands, so it knows where its cameras are");
                let distance = (position - expected).norm();
                let allowed = 0.05 + 0.1 * expected.coords.norm();
                worst = worst.max(distance / allowed);
                seen += 1;
                assert!(distance <= allowed, "{position} instead of {expected}");
            }
        });
    }
    println!(
        "{seen} balls, the worst at {:.0} % of what is allowed; {} in {without} images without",
        worst * 100.0,
        wrong.len()
    );
    assert!(seen >= 200, "{seen} balls only");
    assert!(without >= 200, "{without} images without a ball only");
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Squares of errors in standard deviations, of one range of distances; two numbers are 2 where deviations are true.
#[derive(Default)]
struct Calibration {
    sum: f32,
    count: u16,
}

#[test]
fn sightings_of_the_ball_are_off_as_their_covariances_say() {
    const NAMES: [&str; 3] = ["up to 1 m", "1 to 2.5 m", "beyond"];
    let mut ranges: [Calibration; 3] = Default::default();
    for ball in ["1.5,1.0", "-2.0,-1.5"] {
        let options = [
            "--ball",
            ball,
            "--no-sound",
            "--game",
            "Playing",
            "--imperfect",
            "1",
        ];
        let mut nao = Nao::dynamic(&options, &[]);
        let (mut last, mut images_at_rest) = (None, 0);
        nao.run(25.0, |hardware, instance| {
            let Some(camera) = camera_of(instance) else {
                return;
            };
            let truth = hardware
                .image_truth(camera, instance.cycle().time.start)
                .expect("every cycle of Vision is about an image that was exposed");
            // The truth about the ball is that of now, not that of the image.
            let field = hardware.ground_truth().ball.expect("there is one");
            images_at_rest = if last.replace(field) == Some(field) {
                images_at_rest + 1
            } else {
                0
            };
            if images_at_rest < 30 || !truth.ball.is_some_and(|ball| ball.is_whole) {
                return;
            }
            let expected = (truth.ground_to_field.inverse() * field).xy();
            for ball in balls(instance) {
                let (Some(position), Some(covariance)) = (ball.position, ball.covariance) else {
                    continue;
                };
                let inverse = covariance.try_inverse().expect("it is positive definite");
                let error = position - expected;
                let range = match expected.coords.norm() {
                    ..1.0 => 0,
                    1.0..2.5 => 1,
                    _ => 2,
                };
                ranges[range].sum += error.dot(&(inverse * error));
                ranges[range].count += 1;
            }
        });
    }
    for (range, name) in ranges.iter().zip(NAMES) {
        let mean = range.sum / f32::from(range.count);
        println!("{name}: {mean:.3} of {} sightings", range.count);
        assert!(range.count >= 50, "{name}: {} sightings", range.count);
        assert!((0.05..2.0).contains(&mean), "{name}: {mean}");
    }
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
    // One: the robot is no team mate of itself.
    assert_eq!(teammates.len(), 1, "{teammates:?}");
    let mate = teammates[0].message;
    let truth = nao.hardware.ground_truth();
    let is_mate = |robot: &&Robot| robot.team == Team::Own && robot.number == mate.player_number;
    let robot = truth.robots.iter().find(is_mate);
    let robot = robot.expect("the cameras could see who speaks");
    let expected = Isometry2::new(robot.position.coords, robot.heading).cast::<f32>();
    let pose = mate.ground_to_field.expect("it knows its place");
    assert!((pose.translation.vector - expected.translation.vector).norm() < 1e-6);
    assert!(pose.rotation.angle_to(&expected.rotation).abs() < 1e-6);
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

#[test]
fn what_the_robot_tells_of_itself_and_the_ball_is_true() {
    // In Set it looks at the ball and lets it lie.
    let options = ["--no-sound", "--game", "Set", "--ball", "2.9,0.3"];
    let mut nao = Nao::new(&options, &[]);
    let (mut looks, mut worst) = (0, 0.0_f32);
    nao.run(16.0, |hardware, instance| {
        if instance.description().name != "Control" || instance.cycle().time.start < SETTLED {
            return;
        }
        let command: MotionCommand = output(instance, "motion_command");
        if let HeadMotion::LookAt(point) = command.head {
            looks += 1;
            worst = worst.max(share_of_allowed(&hardware.ground_truth(), point));
        }
    });
    println!("looked at the ball in {looks} cycles, at most {worst} of what is allowed off");
    assert!(looks > 500, "looked at the ball in {looks} cycles");
    assert!(worst <= 1.0, "{worst}");
    let (network, truth) = (nao.hardware.network_truth(), nao.hardware.ground_truth());
    let answer = network.return_data.last().expect("the robot has answered");
    let message = network.team_messages.last().expect("the robot has spoken");
    assert!(seconds(answer.at) > 14.0 && seconds(message.at) > 14.0);
    let told = [
        (answer.message.is_fallen, answer.message.ball),
        (message.message.is_fallen, message.message.ball),
    ];
    for (is_fallen, ball) in told {
        let ball = ball.expect("the ball lies before the robot");
        assert!(!is_fallen);
        assert!(ball.age < 2.0, "{ball:?}");
        let share = share_of_allowed(&truth, ball.position);
        assert!(share <= 1.0, "{ball:?} is {share} of what is allowed off");
    }
    let answer = answer.message;
    assert_eq!((answer.player_number, answer.team_number), (1, 77));
    assert_eq!(message.message.player_number, 1);
}

/// How far a place in the ground frame is from the ball, as a share of 10 % and 5 cm.
fn share_of_allowed(truth: &GroundTruth, place: Point2<f32>) -> f32 {
    let ball = truth.ball.expect("there is one");
    let ball = (truth.ground_to_field.inverse() * ball).xy();
    (place - ball).norm() / (0.05 + 0.1 * ball.coords.norm())
}

/// What became of the images of one chaos.
#[derive(Debug, PartialEq)]
struct Chaotic {
    /// The images that the ball filter learnt, as it learnt them.
    delivered: Vec<Timestamp>,
    /// The images of both cameras in the order in which Vision had finished with them.
    finished: Vec<Timestamp>,
    queues: Vec<QueueReport>,
    /// Of everything.
    digest: String,
}

fn chaotic(seed: u64) -> Chaotic {
    let mut nao = Nao::new(&["--ball", "2.9,0.2"], &[]);
    let access = nao.robot.access("Control").expect("it is an instance");
    assert!(access.subscriptions.subscribe("ball_filter.delivered"));
    let (mut delivered, mut finished) = (Vec::new(), Vec::new());
    let mut digest = Digest::default();
    nao.run_in_chaos(seed, 3.0, |_, instance| {
        digest.add_cycle(instance).expect("outputs can be digested");
        if camera_of(instance).is_some() {
            finished.push(instance.cycle().time.start);
        }
        if let Some(times) = instance.additional_output("ball_filter.delivered") {
            let times = serde_json::to_value(times.as_serialize()).expect("outputs serialise");
            let images: Vec<LearntImage> = serde_json::from_value(times).expect("they are images");
            delivered.extend(images.iter().map(|image| image.captured_at));
        }
    });
    let control = nao.robot.instance("Control").expect("it runs");
    Chaotic {
        delivered,
        finished,
        queues: control.report().queues,
        digest: digest.to_string(),
    }
}

#[test]
fn whatever_the_chaos_the_ball_filter_takes_images_in_the_order_of_their_capture() {
    let runs: Vec<_> = (0..8).map(chaotic).collect();
    let mut overtaking = 0;
    for (seed, run) in runs.iter().enumerate() {
        let Chaotic {
            delivered,
            finished,
            queues,
            ..
        } = run;
        let is_later = |pair: &[Timestamp]| pair[0] < pair[1];
        assert!(
            delivered.windows(2).all(is_later),
            "seed {seed}: {delivered:?}"
        );
        overtaking += finished.windows(2).filter(|pair| !is_later(pair)).count();
        // The last ones may not be settled yet.
        let (learnt, images) = (delivered.len(), finished.len());
        assert!(
            learnt <= images && learnt + 8 >= images,
            "seed {seed}: {learnt} of {images}"
        );
        assert!(learnt > 160, "seed {seed}: {learnt}");
        assert!(delivered.iter().all(|image| finished.contains(image)));
        for queue in queues {
            let lost = (queue.counts.dropped, queue.counts.expired);
            assert_eq!(lost, (0, 0), "seed {seed}: {queue:?}");
        }
        assert_eq!(queues.len(), 4, "{queues:?}");
    }
    println!("images were finished before older ones {overtaking} times");
    assert!(
        overtaking > 0,
        "no chaos finished images out of order: nothing was shown"
    );
    let mut digests: Vec<&String> = runs.iter().map(|run| &run.digest).collect();
    digests.sort();
    digests.dedup();
    assert_eq!(digests.len(), runs.len(), "every chaos is another");
    assert_eq!(chaotic(3), runs[3], "one seed is one run");
}
