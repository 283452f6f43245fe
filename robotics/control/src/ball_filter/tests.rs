//! Balls that lie, roll, jump, and vanish in front of robots that stand, turn, and walk.

use std::f32::consts::FRAC_PI_2;
use std::sync::LazyLock;

use framework::math;
use framework::testing::{
    AdditionalProbe, ParameterFile, at_millis, cycle_time, history, perception,
};

use super::hypotheses::MOST_HYPOTHESES;
use super::*;

mod missed;

type Seen<'a> = Vec<(Timestamp, &'a Vec<BallCandidate>)>;

/// What listeners see of a cycle.
struct Cycle {
    ball: Option<Ball>,
    persistent_ball: Option<Ball>,
    hypotheses: Vec<BallHypothesis>,
    delivered: Vec<LearntImage>,
}

/// Those of the robot.
fn parameters() -> BallFilterParameters {
    static PARAMETERS: LazyLock<BallFilterParameters> = LazyLock::new(|| {
        ParameterFile::new(include_str!("../../../parameters/default.toml")).get("ball_filter")
    });
    *PARAMETERS
}

fn node() -> BallFilter {
    BallFilter::new(CreationContext {}).unwrap()
}

/// As a camera sees it from 0.5 m, whose tilt is known to 0.6 degrees.
fn candidate(x: f32, y: f32) -> Vec<BallCandidate> {
    let noise = SightNoise {
        least: 0.005,
        along: 0.0,
        tilt: 0.02,
        across: 0.002,
    };
    vec![BallCandidate {
        position: Some(Point2::new(x, y)),
        covariance: Some(noise.covariance(Vector2::new(x, y))),
        ..BallCandidate::default()
    }]
}

fn pose(x: f32, y: f32, yaw: f32) -> Odometry {
    Odometry {
        ground_to_start: Isometry2::new(Vector2::new(x, y), yaw),
    }
}

/// What images have beside balls; by default nothing that says where balls were looked for.
#[derive(Default)]
struct Around {
    view: Option<BallView>,
    border: FieldBorder,
    limbs: LimbMask,
    obstacles: Vec<ObstacleCandidate>,
    /// What the robot knows of by other means, in the ground frame.
    known: Vec<Obstacle>,
}

/// The same in each of the images.
fn each<'a, T>(times: &[Vec<Timestamp>; 2], value: &'a T) -> [Vec<(Timestamp, &'a T)>; 2] {
    times
        .each_ref()
        .map(|times| times.iter().map(|at| (*at, value)).collect())
}

/// A cycle at `now` ms of a robot that was at `before` from the start and is at `pose` now.
fn cycle_at(
    node: &mut BallFilter,
    now: u64,
    poses: (&Odometry, &Odometry),
    parameters: &BallFilterParameters,
    seen: (Seen<'_>, Seen<'_>),
) -> Cycle {
    cycle_around(node, now, poses, parameters, seen, &Around::default())
}

fn cycle_around(
    node: &mut BallFilter,
    now: u64,
    (before, pose): (&Odometry, &Odometry),
    parameters: &BallFilterParameters,
    (persistent, transient): (Seen<'_>, Seen<'_>),
    around: &Around,
) -> Cycle {
    let past = [(Timestamp::ZERO, before)];
    let times =
        [&persistent, &transient].map(|seen| seen.iter().map(|(at, _)| *at).collect::<Vec<_>>());
    let [views, open_views] = each(&times, &around.view);
    let [limbs, open_limbs] = each(&times, &around.limbs);
    let [borders, open_borders] = each(&times, &around.border);
    let [seen, open_seen] = each(&times, &around.obstacles);
    let (mut hypotheses, mut ball, mut delivered) = (
        AdditionalProbe::default(),
        AdditionalProbe::default(),
        AdditionalProbe::default(),
    );
    let context = CycleContext {
        balls: perception(&persistent, &transient),
        ball_views: perception(&views, &open_views),
        limb_masks: perception(&limbs, &open_limbs),
        borders: perception(&borders, &open_borders),
        obstacles_seen: perception(&seen, &open_seen),
        obstacles: &around.known,
        odometry: history(&past, at_millis(now), pose),
        cycle_time: cycle_time(now, 12),
        parameters,
        hypotheses: hypotheses.output(),
        persistent_ball: ball.output(),
        delivered: delivered.output(),
    };
    let outputs = node.cycle(context).unwrap();
    Cycle {
        ball: outputs.ball.value,
        persistent_ball: *ball.value().unwrap(),
        hypotheses: hypotheses.value().unwrap().clone(),
        delivered: delivered.value().unwrap().clone(),
    }
}

/// A cycle of a robot that stands where it began.
fn cycle(node: &mut BallFilter, now: u64, persistent: Seen<'_>, transient: Seen<'_>) -> Cycle {
    let standing = Odometry::default();
    let seen = (persistent, transient);
    cycle_at(node, now, (&standing, &standing), &parameters(), seen)
}

/// The same thing in so many images, 33 ms apart, from then on.
fn images(from: u64, count: u64, seen: &Vec<BallCandidate>) -> Seen<'_> {
    let image = |index| (at_millis(from + 33 * index), seen);
    (0..count).map(image).collect()
}

/// Share of its speed that a ball keeps.
fn kept(millis: u64) -> f32 {
    math::exp(-(millis as f32) / 1000.0 / parameters().rolling_time)
}

/// How far a ball of 2 m/s rolls, in m.
fn rolled(millis: u64) -> f32 {
    2.0 * parameters().rolling_time * (1.0 - kept(millis))
}

fn assert_near(found: Point2<f32>, x: f32, y: f32, tolerance: f32) {
    let error = (found - Point2::new(x, y)).norm();
    assert!(error <= tolerance, "{found} is not ({x}, {y})");
}

#[test]
fn one_sighting_is_no_ball_and_three_are() {
    let (mut node, seen) = (node(), candidate(1.0, 0.2));
    assert_eq!(cycle(&mut node, 10, images(0, 1, &seen), vec![]).ball, None);
    let ball = cycle(&mut node, 80, images(33, 2, &seen), vec![])
        .ball
        .unwrap();
    assert_near(ball.position, 1.0, 0.2, 1e-6);
    assert_eq!(ball.velocity, Vector2::zeros());
    assert_eq!(ball.seen_at, at_millis(66));
}

#[test]
fn a_ball_is_remembered_until_it_is_too_old() {
    let (mut node, seen) = (node(), candidate(1.0, 0.2));
    cycle(&mut node, 1000, images(670, 11, &seen), vec![]);
    let forget_after = (parameters().forget_after * 1000.0) as u64;
    let remembered = cycle(&mut node, 990 + forget_after, vec![], vec![]);
    assert_near(remembered.ball.unwrap().position, 1.0, 0.2, 1e-6);
    let later = cycle(&mut node, 1012 + forget_after, vec![], vec![]);
    assert_eq!(later.ball, None);
    assert_eq!(later.hypotheses, []);
}

#[test]
fn transient_sightings_answer_but_are_not_learnt() {
    let (mut node, seen) = (node(), candidate(2.0, 0.0));
    let now = cycle(&mut node, 100, vec![], images(0, 3, &seen));
    assert_near(now.ball.unwrap().position, 2.0, 0.0, 1e-6);
    assert_eq!((now.persistent_ball, now.delivered), (None, vec![]));
    assert_eq!(cycle(&mut node, 112, vec![], vec![]).ball, None);
}

#[test]
fn what_was_learnt_does_not_depend_on_what_was_transient_meanwhile() {
    let (first, second) = (candidate(2.0, 0.0), candidate(2.1, 0.1));
    let (mut eager, mut patient) = (node(), node());
    cycle(&mut eager, 40, images(0, 2, &first), images(66, 3, &second));
    cycle(&mut patient, 40, images(0, 2, &first), vec![]);
    let eager = cycle(&mut eager, 200, images(66, 3, &second), vec![]);
    let patient = cycle(&mut patient, 200, images(66, 3, &second), vec![]);
    assert_eq!(eager.ball, patient.ball);
    assert!(eager.ball.is_some());
    assert_eq!(eager.persistent_ball, eager.ball);
    let captured = eager.delivered.iter().map(|image| image.captured_at);
    assert!(
        captured.eq([66, 99, 132].map(at_millis)),
        "{:?}",
        eager.delivered
    );
}

#[test]
fn a_ball_seen_before_a_turn_lies_beside_the_robot_after_it() {
    let (before, after) = (pose(3.0, -1.0, 0.0), pose(3.0, -1.0, FRAC_PI_2));
    let seen = candidate(1.0, 0.0);
    let seen = (vec![], images(0, 3, &seen));
    let ball = cycle_at(&mut node(), 100, (&before, &after), &parameters(), seen).ball;
    assert_near(ball.unwrap().position, 0.0, -1.0, 1e-5);
}

#[test]
fn a_ball_comes_nearer_as_the_robot_walks() {
    let (before, after) = (
        pose(0.0, 0.0, 1.0),
        pose(math::cos(1.0_f32), math::sin(1.0_f32), 1.0),
    );
    let seen = candidate(3.0, 0.5);
    let seen = (images(0, 3, &seen), vec![]);
    let ball = cycle_at(&mut node(), 100, (&before, &after), &parameters(), seen).ball;
    assert_near(ball.unwrap().position, 2.0, 0.5, 1e-5);
}

#[test]
fn a_ball_at_rest_does_not_drift_before_a_robot_that_stands_far_from_its_start() {
    let (mut node, standing) = (node(), pose(7.3, -4.1, 2.2));
    let seen = candidate(1.0, 0.4);
    let mut positions = Vec::new();
    for index in 0..5000 {
        let now = 100 + 12 * index;
        let images: Seen<'_> = if index % 25 == 0 {
            vec![(at_millis(now), &seen)]
        } else {
            vec![]
        };
        let around = (&standing, &standing);
        let ball = cycle_at(&mut node, now, around, &parameters(), (images, vec![])).ball;
        positions.extend(ball.map(|ball| ball.position));
    }
    assert!(positions.len() > 4900);
    for position in positions {
        assert_near(position, 1.0, 0.4, 1e-5);
    }
}

#[test]
fn the_speed_of_a_rolling_ball_is_found_and_it_rolls_on_unseen() {
    let mut node = node();
    let x = |millis| 0.5 + rolled(millis);
    for index in 0..20 {
        let seen = candidate(x(33 * index), 0.0);
        cycle(&mut node, 33 * index, images(33 * index, 1, &seen), vec![]);
    }
    let seen = cycle(&mut node, 627, vec![], vec![]).ball.unwrap();
    let error = seen.velocity.x - 2.0 * kept(627);
    println!("after 0.6 s {error} m/s too fast");
    assert!(error.abs() < 0.15, "{}", seen.velocity);
    let later = cycle(&mut node, 1127, vec![], vec![]).ball.unwrap();
    assert_near(later.position, x(1127), 0.0, 0.1);
    assert_eq!(later.seen_at, seen.seen_at);
}

#[test]
fn a_kicked_ball_is_followed_at_once() {
    let mut node = node();
    let resting = candidate(0.3, 0.0);
    cycle(&mut node, 1000, images(0, 31, &resting), vec![]);
    let mut worst = 0.0_f32;
    for index in 1..20 {
        let now = 990 + 33 * index;
        let x = 0.3 + rolled(33 * index);
        let seen = candidate(x, 0.0);
        let ball = cycle(&mut node, now, images(now, 1, &seen), vec![]).ball;
        worst = worst.max((ball.unwrap().position.x - x).abs());
    }
    let found = cycle(&mut node, 1617, vec![], vec![]);
    let ball = found.ball.unwrap();
    assert!(worst < 0.1, "{worst} m");
    let error = ball.velocity.x - 2.0 * kept(627);
    println!("at most {worst} m behind, after 0.6 s {error} m/s too fast");
    assert!(error.abs() < 0.2, "{}", ball.velocity);
    assert_eq!(found.hypotheses.len(), 1);
}

#[test]
fn a_scattered_ball_at_rest_rests() {
    let mut node = node();
    // Errors of ± 3 cm at 1 m, a pattern without order.
    let errors = [
        0.03, -0.02, 0.01, -0.03, 0.02, 0.0, -0.01, 0.03, -0.03, 0.01,
    ];
    for index in 0..100_usize {
        let (along, across) = (errors[index % 10], errors[(3 * index + 1) % 10] * 0.5);
        let seen = candidate(1.0 + along, across);
        let now = 33 * index as u64;
        let ball = cycle(&mut node, now, images(now, 1, &seen), vec![]).ball;
        if index > 20 {
            let ball = ball.unwrap();
            assert_near(ball.position, 1.0, 0.0, 0.03);
            assert_eq!(ball.velocity, Vector2::zeros());
        }
    }
}

#[test]
fn a_ball_that_was_carried_away_is_followed_within_a_second() {
    let mut node = node();
    let (first, second) = (candidate(1.0, 0.0), candidate(3.0, 1.0));
    cycle(&mut node, 1000, images(0, 30, &first), vec![]);
    let both = cycle(&mut node, 1100, images(1000, 3, &second), vec![]);
    assert_eq!(both.hypotheses.len(), 2);
    let ball = cycle(&mut node, 2000, images(1100, 27, &second), vec![]);
    assert_near(ball.ball.unwrap().position, 3.0, 1.0, 0.01);
}

#[test]
fn a_wrong_candidate_beside_the_ball_changes_nothing() {
    let mut node = node();
    let ball = candidate(1.0, 0.0);
    let both = [candidate(0.5, 1.5), ball.clone()].concat();
    cycle(&mut node, 400, images(0, 10, &ball), vec![]);
    let found = cycle(&mut node, 500, images(400, 1, &both), vec![]);
    assert_near(found.ball.unwrap().position, 1.0, 0.0, 1e-5);
}

#[test]
fn several_candidates_of_one_image_at_one_place_are_one_sighting() {
    let mut node = node();
    let pair = [candidate(1.0, 0.2), candidate(1.05, 0.22)].concat();
    let found = cycle(&mut node, 10, images(0, 1, &pair), vec![]);
    assert_eq!(found.ball, None);
    assert_eq!(found.hypotheses.len(), 1);
    let validity = found.hypotheses[0].validity;
    assert!((0.9..=1.0).contains(&validity), "{validity}");
}

#[test]
fn however_many_candidates_there_are_few_hypotheses_are_kept() {
    let mut node = node();
    let many: Vec<_> = (0..30)
        .flat_map(|index| candidate(1.0 + 1.6 * (index % 6) as f32, 1.5 * (index / 6) as f32))
        .collect();
    let ball = candidate(0.5, 0.0);
    cycle(&mut node, 400, images(0, 10, &ball), vec![]);
    let found = cycle(&mut node, 500, images(400, 2, &many), vec![]);
    assert_eq!(found.hypotheses.len(), MOST_HYPOTHESES);
    assert_near(found.ball.unwrap().position, 0.5, 0.0, 1e-4);
}

#[test]
fn candidates_without_a_place_on_the_ground_teach_nothing() {
    let nowhere = vec![BallCandidate::default()];
    let nonsense = candidate(f32::NAN, f32::INFINITY);
    let seen = [images(0, 3, &nowhere), images(99, 3, &nonsense)].concat();
    let found = cycle(&mut node(), 300, seen, vec![]);
    assert_eq!((found.ball, found.hypotheses), (None, vec![]));
}

#[test]
fn odometry_and_parameters_that_are_no_numbers_are_survived() {
    let (standing, broken) = (Odometry::default(), pose(f32::NAN, 0.0, f32::INFINITY));
    let seen = candidate(1.0, 0.0);
    let mut node = node();
    let images = || (images(0, 5, &seen), vec![]);
    let lost = cycle_at(
        &mut node,
        200,
        (&standing, &broken),
        &parameters(),
        images(),
    );
    assert_eq!((lost.ball, lost.hypotheses), (None, vec![]));
    let found = cycle(&mut node, 212, vec![], vec![]).ball.unwrap();
    assert_near(found.position, 1.0, 0.0, 1e-5);

    let nonsense: BallFilterParameters = BallFilterParameters {
        rolling_time: f32::NAN,
        least_noise: f32::NAN,
        velocity_noise: f32::INFINITY,
        ..parameters()
    };
    let around = (&standing, &standing);
    let lost = cycle_at(&mut node, 400, around, &nonsense, images());
    assert_eq!(lost.ball, None);
}

/// A camera's node needs so long for an image; the other camera's images wait for it, ms.
const SLOW: u64 = 250;
/// Where a ball that is kicked away at `kicked` ms lies at that time, m ahead.
fn kicked_ball(millis: u64, kicked: u64) -> f32 {
    0.5 + rolled(millis.saturating_sub(kicked))
}

fn shown(images: Vec<&(u64, Vec<BallCandidate>)>) -> Seen<'_> {
    let images = images.into_iter();
    images.map(|(at, seen)| (at_millis(*at), seen)).collect()
}

/// Of what is settled, and of what is not, too: how far off the ball is believed, m, and how long after the kick it is
/// noticed that it rolls, ms.
fn kick_seen_by_a_slow_camera(kicked: u64) -> ([f32; 2], [u64; 2]) {
    let mut node = node();
    let images: Vec<_> = (0..90)
        .map(|index| (33 * index, candidate(kicked_ball(33 * index, kicked), 0.0)))
        .collect();
    let mut errors = [0.0_f32; 2];
    let mut noticed = [None; 2];
    let (mut settled, mut cycles) = (0, 0.0);
    for now in (504..2500).step_by(12) {
        // An image takes 33 ms; the slow one that is under way was begun then.
        let pending = now / SLOW * SLOW;
        let done = |captured: u64| captured + 33 <= now;
        let ready = images.iter().filter(|(captured, _)| done(*captured));
        let (persistent, transient): (Vec<_>, Vec<_>) = ready
            .skip(settled)
            .partition(|(captured, _)| *captured < pending);
        settled += persistent.len();
        let cycle = cycle(&mut node, now, shown(persistent), shown(transient));
        let truth = kicked_ball(now, kicked);
        let balls = [cycle.persistent_ball, cycle.ball];
        for (index, ball) in balls.into_iter().enumerate() {
            let ball = ball.expect("the ball is known from the beginning");
            errors[index] += (ball.position.x - truth).abs();
            if ball.velocity.x > 0.5 {
                noticed[index].get_or_insert(now - kicked);
            }
        }
        cycles += 1.0;
    }
    let noticed = noticed.map(|after| after.expect("the kick is noticed"));
    (errors.map(|sum| sum / cycles), noticed)
}

#[test]
fn with_a_slow_camera_what_is_not_settled_shows_a_kick_earlier() {
    const KICKS: [u64; 5] = [1010, 1060, 1110, 1160, 1210];
    let mut errors = [0.0_f32; 2];
    let mut delays = [0; 2];
    // Anywhere between two images of the slow camera.
    for kicked in KICKS {
        let (error, delay) = kick_seen_by_a_slow_camera(kicked);
        for index in 0..2 {
            errors[index] += error[index] / KICKS.len() as f32;
            delays[index] += delay[index] / KICKS.len() as u64;
        }
    }
    let ([settled, newest], [late, early]) = (errors, delays);
    println!(
        "settled: {settled:.3} m off, kick noticed after {late} ms; newest: {newest:.3} m off, after {early} ms"
    );
    assert!(newest < 0.6 * settled, "{newest} m and {settled} m");
    assert!(early + 100 <= late, "{early} ms and {late} ms");
}
