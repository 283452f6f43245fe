//! Makes one ball of what the robots of the own team see, this one among them.
//!
//! A sighting weighs as much as it is known: its variance grows with the distance to who saw it and with its age, and no place
//! is known better than the robot that tells of it. Sightings that lie within the gate of one of them agree, and are merged
//! by their weights; of those that disagree the heaviest company is the ball, the one that was it before with a head start.
//! Whom the referee has taken out, or nobody has heard for long, is not among `teammates`.

use framework::{CycleTime, Input, MainOutput, Parameter, Reflect, Result, Timestamp, context};
use nalgebra::{Isometry2, Point2, Vector2};
use serde::{Deserialize, Serialize};
use types::ball::Ball;
use types::game::Player;
use types::team::Teammate;

/// Where the team saw the ball last.
#[derive(Debug, Deserialize, Serialize)]
pub struct TeamBallFilter {
    /// In the field frame, m; `None` where nobody saw it.
    last: Option<Point2<f32>>,
}

/// How much robots of a team are believed.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TeamBallParameters {
    /// A ball that was seen longer ago does not count.
    #[reflect(unit = "s", range = 0.0..)]
    pub oldest: f32,
    /// Sightings that are nearer to each other are of one ball.
    #[reflect(unit = "m", range = 0.0..)]
    pub gate: f32,
    /// So many times as heavy others have to be that take the ball elsewhere.
    #[reflect(range = 1.0..)]
    pub head_start: f32,
    /// How wrong a robot is about its own place, one standard deviation.
    #[reflect(unit = "m", range = 0.0..)]
    pub place_noise: f32,
    /// How wrong a sighting is per m of distance, one standard deviation.
    #[reflect(range = 0.0..)]
    pub distance_noise: f32,
    /// In m after 1 s: how far the ball gets without anybody seeing it, one standard deviation.
    #[reflect(range = 0.0..)]
    pub age_noise: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    ground_to_field: Input<Option<Isometry2<f32>>, "ground_to_field">,
    ball: Input<Option<Ball>, "ball">,
    teammates: Input<Vec<Teammate>, "teammates">,
    cycle_time: CycleTime,

    /// Who this robot is in the game.
    player: Parameter<Player, "player">,
    parameters: Parameter<TeamBallParameters, "team_ball_filter">,
}

#[context]
pub struct MainOutputs {
    /// Where the team sees the ball, in the own ground frame, m; `None` where nobody has seen it lately, or the own pose is
    /// not known.
    team_ball: MainOutput<Option<Point2<f32>>>,
}

impl TeamBallFilter {
    /// Nobody has seen it.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { last: None })
    }

    /// From what is known now; who does not know where it is cannot use what others see.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let (now, parameters) = (context.cycle_time.start, context.parameters);
        let number = context.player.number;
        let team_ball = context.ground_to_field.map(|ground_to_field| {
            let own = context
                .ball
                .map(|ball| own_sighting(&ball, &ground_to_field, now));
            let others = context
                .teammates
                .iter()
                .filter(|teammate| teammate.message.player_number != number)
                .filter_map(|teammate| sighting(teammate, now));
            let all = own.into_iter().chain(others);
            let recent = all.filter(|sighting| sighting.age <= parameters.oldest);
            self.last = heaviest(recent, self.last, parameters);
            self.last.map(|ball| ground_to_field.inverse() * ball)
        });
        if team_ball.is_none() {
            self.last = None;
        }
        Ok(MainOutputs {
            team_ball: team_ball.flatten().into(),
        })
    }
}

/// One robot's ball.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sighting {
    /// In the field frame, m.
    place: Point2<f32>,
    /// From who saw it, m.
    distance: f32,
    /// Since it was seen, s.
    age: f32,
}

impl Sighting {
    /// One by its variance, 1/m².
    fn weight(&self, parameters: &TeamBallParameters) -> f32 {
        let square = |value: f32| value * value;
        let variance = square(parameters.place_noise)
            + square(parameters.distance_noise * self.distance)
            + square(parameters.age_noise * self.age);
        1.0 / variance.max(f32::EPSILON)
    }
}

fn own_sighting(ball: &Ball, ground_to_field: &Isometry2<f32>, now: Timestamp) -> Sighting {
    Sighting {
        place: ground_to_field * ball.position,
        distance: ball.position.coords.norm(),
        age: (now - ball.seen_at).as_secs_f32(),
    }
}

/// Of a team mate that knows where it is, and the ball.
fn sighting(teammate: &Teammate, now: Timestamp) -> Option<Sighting> {
    let ball = teammate.message.ball?;
    Some(Sighting {
        place: teammate.message.ground_to_field? * ball.position,
        distance: ball.position.coords.norm(),
        age: ball.age + (now - teammate.heard_at).as_secs_f32(),
    })
}

/// The middle of those that agree and weigh most together; of equals the first.
fn heaviest(
    sightings: impl Iterator<Item = Sighting> + Clone,
    last: Option<Point2<f32>>,
    parameters: &TeamBallParameters,
) -> Option<Point2<f32>> {
    let agree = |one: &Point2<f32>, other: &Point2<f32>| (one - other).norm() <= parameters.gate;
    let companies = sightings.clone().map(|centre| {
        let company = sightings
            .clone()
            .filter(|other| agree(&other.place, &centre.place));
        let (sum, weight) = company.fold((Vector2::zeros(), 0.0), |(sum, weight), one| {
            let more = one.weight(parameters);
            (sum + one.place.coords * more, weight + more)
        });
        let middle = Point2::from(sum / weight);
        let was_it = last.is_some_and(|last| agree(&last, &middle));
        let head_start = if was_it { parameters.head_start } else { 1.0 };
        (middle, weight * head_start)
    });
    let heavier = |best: (Point2<f32>, f32), next: (Point2<f32>, f32)| match next.1 > best.1 {
        true => next,
        false => best,
    };
    companies.reduce(heavier).map(|(middle, _)| middle)
}

#[cfg(test)]
mod tests {
    use framework::testing::{ParameterFile, at_millis, cycle_time};
    use types::team::{TeamBall, TeamMessage};

    use super::*;

    const NOW: u64 = 10_000;

    fn parameters() -> TeamBallParameters {
        ParameterFile::new(include_str!("../../parameters/default.toml")).get("team_ball_filter")
    }

    /// Stands so far from a ball of the field frame, on its left and with its back to it, and saw it so long ago.
    fn mate(number: u8, ball: [f32; 2], distance: f32, age: f32) -> Teammate {
        let place = Vector2::new(ball[0], ball[1] + distance);
        Teammate {
            message: TeamMessage {
                player_number: number,
                is_fallen: false,
                plays_ball: false,
                ground_to_field: Some(Isometry2::new(place, std::f32::consts::FRAC_PI_2)),
                ball: Some(TeamBall {
                    position: Point2::new(-distance, 0.0),
                    age,
                }),
            },
            heard_at: at_millis(NOW),
        }
    }

    fn node() -> TeamBallFilter {
        TeamBallFilter::new(CreationContext {}).unwrap()
    }

    /// What robot 1 in the middle of the field, which looks to the left, makes of it, in the field frame.
    fn cycle(
        node: &mut TeamBallFilter,
        own: Option<[f32; 2]>,
        teammates: &[Teammate],
    ) -> Option<Point2<f32>> {
        let pose = Isometry2::rotation(std::f32::consts::FRAC_PI_2);
        let ball = own.map(|[x, y]| pose.inverse() * Point2::new(x, y));
        Some(pose * cycle_at(node, Some(pose), ball, NOW, teammates)?)
    }

    fn cycle_at(
        node: &mut TeamBallFilter,
        ground_to_field: Option<Isometry2<f32>>,
        own: Option<Point2<f32>>,
        now: u64,
        teammates: &[Teammate],
    ) -> Option<Point2<f32>> {
        let context = CycleContext {
            ground_to_field: &ground_to_field,
            ball: &own.map(|position| Ball {
                position,
                seen_at: at_millis(NOW),
                ..Ball::default()
            }),
            teammates: &teammates.to_vec(),
            cycle_time: cycle_time(now, 12),
            player: &Player {
                number: 1,
                team: 77,
            },
            parameters: &parameters(),
        };
        node.cycle(context).unwrap().team_ball.value
    }

    fn assert_near(ball: Option<Point2<f32>>, expected: [f32; 2], tolerance: f32) {
        let ball = ball.expect("somebody sees it");
        assert!((ball - Point2::from(expected)).norm() < tolerance, "{ball}");
    }

    #[test]
    fn equal_sightings_that_agree_meet_in_the_middle_and_better_ones_pull_more() {
        let ball = |mates: &[Teammate]| cycle(&mut node(), None, mates);
        let (left, right) = ([1.0, 0.3], [1.0, -0.3]);
        let equal = [mate(2, left, 2.0, 1.0), mate(3, right, 2.0, 1.0)];
        assert_near(ball(&equal), [1.0, 0.0], 1e-5);
        // Nearer, then younger.
        for other in [mate(3, right, 6.0, 1.0), mate(3, right, 2.0, 5.0)] {
            let merged = ball(&[mate(2, left, 2.0, 1.0), other]).unwrap();
            assert!((0.1..0.3).contains(&merged.y), "{merged}");
        }
    }

    #[test]
    fn a_liar_is_outvoted_and_believed_where_nobody_else_sees_the_ball() {
        let liar = mate(4, [-3.0, 2.0], 1.0, 0.0);
        let honest = [
            mate(2, [1.0, 0.0], 2.0, 1.0),
            mate(3, [1.4, 0.0], 2.0, 1.0),
            liar,
        ];
        assert_near(cycle(&mut node(), None, &honest), [1.2, 0.0], 1e-5);
        let backwards: Vec<_> = honest.iter().rev().copied().collect();
        assert_near(cycle(&mut node(), None, &backwards), [1.2, 0.0], 1e-5);
        assert_near(cycle(&mut node(), None, &[liar]), [-3.0, 2.0], 1e-5);
    }

    #[test]
    fn the_ball_does_not_jump_between_two_that_weigh_about_as_much() {
        let mut node = node();
        let mut ball = |one: f32, other: f32| {
            let mates = [
                mate(2, [1.0, 0.0], one, 0.0),
                mate(3, [-2.0, 0.0], other, 0.0),
            ];
            cycle(&mut node, None, &mates).unwrap().x
        };
        assert_eq!(ball(1.0, 1.1).round(), 1.0);
        assert_eq!(ball(1.1, 1.0).round(), 1.0, "hardly better known");
        assert_eq!(ball(6.0, 1.0).round(), -2.0);
        assert_eq!(ball(1.0, 1.1).round(), -2.0);
    }

    #[test]
    fn balls_age_and_old_ones_do_not_count() {
        let mates = [
            mate(2, [1.0, 0.0], 1.0, 4.0),
            mate(3, [-2.0, 0.0], 1.0, 0.5),
        ];
        assert_near(cycle(&mut node(), None, &mates), [-2.0, 0.0], 1e-5);
        let pose = Some(Isometry2::identity());
        let at = |now| cycle_at(&mut node(), pose, None, now, &mates[..1]);
        // It was 4 s old, and counts until it is 10 s old.
        assert_near(at(NOW + 5_900), [1.0, 0.0], 1e-5);
        assert_eq!(at(NOW + 6_100), None);
    }

    #[test]
    fn the_own_ball_counts_once_whatever_a_message_under_the_own_number_says() {
        let own = Some([0.0, -2.0]);
        assert_near(cycle(&mut node(), own, &[]), [0.0, -2.0], 1e-5);
        let other = mate(2, [0.0, -2.6], 2.0, 0.0);
        assert_near(cycle(&mut node(), own, &[other]), [0.0, -2.3], 1e-5);
        let echo = mate(1, [0.0, -2.0], 2.0, 0.0);
        assert_near(cycle(&mut node(), own, &[echo, other]), [0.0, -2.3], 1e-5);
    }

    #[test]
    fn who_does_not_know_where_it_is_says_nothing_and_hears_nothing() {
        let mut lost = mate(2, [1.0, 0.0], 1.0, 0.0);
        lost.message.ground_to_field = None;
        let mut blind = mate(3, [1.0, 0.0], 1.0, 0.0);
        blind.message.ball = None;
        assert_eq!(cycle(&mut node(), None, &[lost, blind]), None);
        let known = [mate(2, [1.0, 0.0], 1.0, 0.0)];
        let own = Some(Point2::new(1.0, 0.0));
        assert_eq!(cycle_at(&mut node(), None, own, NOW, &known), None);
    }

    #[test]
    fn it_is_seen_from_where_this_robot_stands() {
        let pose = Some(Isometry2::new(Vector2::new(-1.0, 0.0), 0.0));
        let mates = [mate(2, [1.0, 0.5], 1.0, 0.0)];
        let ball = cycle_at(&mut node(), pose, None, NOW, &mates);
        assert_near(ball, [2.0, 0.5], 1e-5);
    }
}
