//! Knows what the other robots of the own team said last, from messages that come when they come.
//!
//! What this robot said itself is no message: `team_message_parser` leaves it out. Whom the referee has taken out plays no
//! part for its team, whatever it said before or says from beside the field. Who says that it stands where there is no carpet
//! does not know where it is, and a ball that would lie there is none. Nor is one that it saw long ago, before or after it said
//! so: where the team has to talk less a mate is remembered for longer than what it knew of the ball.

use framework::{
    CycleTime, Input, MainOutput, Parameter, PerceptionInput, Result, RollBack, Timestamp, context,
};
use nalgebra::{Isometry2, Point2};
use serde::{Deserialize, Serialize};
use types::field_markings::FieldMarkings;
use types::game::{GameControllerState, PLAYER_COUNT, Penalty};
use types::team::{TeamBall, TeamMessage, Teammate};

use crate::team_rhythm::TeamRhythm;

/// By the number of the shirt, 1 first.
type Team = [Option<Teammate>; PLAYER_COUNT];

/// Who was heard so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct TeamMessageFilter {
    heard: RollBack<Team>,
    /// How many times as long the team was silent between two messages when a referee was heard last, who alone knows.
    slowness: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    messages: PerceptionInput<Option<TeamMessage>, "SplNetwork", "team_message">,
    game_controller_state: Input<Option<GameControllerState>, "game_controller_state">,
    cycle_time: CycleTime,

    /// A robot that is silent for so long is not there; where the team has to talk less, it is as many times as long.
    #[reflect(unit = "s", range = 0.0..)]
    forget_after: Parameter<f32, "team_message_filter.forget_after">,
    rhythm: Parameter<TeamRhythm, "team_rhythm">,
    markings: Parameter<FieldMarkings, "field_dimensions.markings">,
    /// How far the carpet reaches beside the lines.
    #[reflect(unit = "m", range = 0.0..)]
    carpet: Parameter<f32, "team_message_filter.carpet">,
    /// In s: a ball that was seen longer ago is nobody's.
    oldest_ball: Parameter<f32, "team_ball_filter.oldest">,

    /// The other robots of the own team that were heard lately and may play, by their number.
    teammates: MainOutput<Vec<Teammate>>,
}

#[context]
pub struct MainOutputs {}

impl TeamMessageFilter {
    /// Has heard nobody.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            heard: RollBack::default(),
            slowness: 1.0,
        })
    }

    /// Learns from what is settled, then listens to what is not.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let hear = |team: &mut Team, timestamp, message: &Option<TeamMessage>| {
            if let Some(message) = message {
                remember(team, timestamp, message);
            }
        };
        self.heard.settle(context.messages.persistent, hear);
        let newest = self.heard.with_transient(context.messages.transient, hear);

        let now = context.cycle_time.start;
        let referee = context.game_controller_state.as_ref();
        if let Some(referee) = referee {
            self.slowness = context.rhythm.slowness(referee);
        }
        let silence = *context.forget_after * self.slowness;
        let is_recent = |teammate: &Teammate| (now - teammate.heard_at).as_secs_f32() <= silence;
        let may_play = |teammate: &Teammate| {
            let number = teammate.message.player_number;
            referee.is_none_or(|referee| referee.penalty_of(number) == Penalty::None)
        };
        let recent = newest.into_iter().flatten().filter(is_recent);
        let is_on_carpet =
            |place: &Point2<f32>| context.markings.is_inside(*place, *context.carpet);
        let believed = recent.filter(may_play).map(|teammate| {
            let silent = (now - teammate.heard_at).as_secs_f32();
            let is_recent = |ball: &TeamBall| ball.age + silent <= *context.oldest_ball;
            let mut message = believed(teammate.message, is_on_carpet);
            message.ball = message.ball.filter(is_recent);
            Teammate {
                message,
                ..teammate
            }
        });
        context.teammates.extend(believed);
        Ok(MainOutputs {})
    }
}

/// Without what cannot be so.
fn believed(message: TeamMessage, is_on_carpet: impl Fn(&Point2<f32>) -> bool) -> TeamMessage {
    let stands_there = |pose: &Isometry2<f32>| is_on_carpet(&pose.translation.vector.into());
    let ground_to_field = message.ground_to_field.filter(stands_there);
    let lies_there = |ball: &TeamBall| match ground_to_field {
        Some(pose) => is_on_carpet(&(pose * ball.position)),
        None => true,
    };
    TeamMessage {
        ground_to_field,
        ball: message.ball.filter(lies_there),
        ..message
    }
}

/// A number that no shirt has is nobody's.
fn remember(team: &mut Team, heard_at: Timestamp, message: &TeamMessage) {
    let index = usize::from(message.player_number).checked_sub(1);
    if let Some(place) = index.and_then(|index| team.get_mut(index)) {
        *place = Some(Teammate {
            message: *message,
            heard_at,
        });
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{ParameterFile, at_millis, cycle_time, perception};

    use super::*;

    type Heard<'a> = Vec<(Timestamp, &'a Option<TeamMessage>)>;

    fn message(player_number: u8, is_fallen: bool) -> Option<TeamMessage> {
        Some(TeamMessage {
            player_number,
            is_fallen,
            ..TeamMessage::default()
        })
    }

    fn node() -> TeamMessageFilter {
        TeamMessageFilter::new(CreationContext {}).unwrap()
    }

    fn cycle(
        node: &mut TeamMessageFilter,
        now: u64,
        persistent: Heard<'_>,
        transient: Heard<'_>,
    ) -> Vec<Teammate> {
        cycle_with(node, None, now, persistent, transient)
    }

    fn cycle_with(
        node: &mut TeamMessageFilter,
        referee: Option<GameControllerState>,
        now: u64,
        persistent: Heard<'_>,
        transient: Heard<'_>,
    ) -> Vec<Teammate> {
        let mut teammates = Vec::new();
        let context = CycleContext {
            messages: perception(&persistent, &transient),
            game_controller_state: &referee,
            cycle_time: cycle_time(now, 12),
            forget_after: &10.0,
            rhythm: &TeamRhythm {
                interval: 5.0,
                reserve: 30,
                half: 600.0,
            },
            markings: &ParameterFile::new(include_str!("../../parameters/default.toml"))
                .get("field_dimensions.markings"),
            carpet: &0.7,
            oldest_ball: &10.0,
            teammates: &mut teammates,
        };
        node.cycle(context).unwrap();
        teammates
    }

    fn numbers(teammates: &[Teammate]) -> Vec<u8> {
        let number = |teammate: &Teammate| teammate.message.player_number;
        teammates.iter().map(number).collect()
    }

    #[test]
    fn teammates_stand_in_the_order_of_their_numbers_and_the_newest_counts() {
        let (five, two, later) = (message(5, false), message(2, false), message(5, true));
        let heard = vec![
            (at_millis(10), &five),
            (at_millis(20), &two),
            (at_millis(30), &later),
        ];
        let teammates = cycle(&mut node(), 40, heard, vec![]);
        assert_eq!(numbers(&teammates), [2, 5]);
        assert!(teammates[1].message.is_fallen);
        assert_eq!(teammates[1].heard_at, at_millis(30));
    }

    #[test]
    fn numbers_without_a_shirt_and_no_messages_are_ignored() {
        let (zero, large, nothing) = (message(0, false), message(21, false), None);
        let heard = [&zero, &large, &nothing].map(|message| (at_millis(10), message));
        assert_eq!(cycle(&mut node(), 20, heard.to_vec(), vec![]), []);
    }

    #[test]
    fn a_silent_teammate_is_forgotten() {
        let two = message(2, false);
        let mut node = node();
        cycle(&mut node, 10, vec![(at_millis(10), &two)], vec![]);
        assert_eq!(numbers(&cycle(&mut node, 10_010, vec![], vec![])), [2]);
        assert_eq!(cycle(&mut node, 10_020, vec![], vec![]), []);
    }

    #[test]
    fn where_the_team_has_to_talk_less_silence_may_last_longer() {
        let two = message(2, false);
        // For three players 10 s between two messages of each: 180 of 210 messages in 600 s.
        let mut referee = GameControllerState {
            message_budget: 210,
            seconds_remaining: 600,
            own_penalties: [Penalty::Substitute; PLAYER_COUNT],
            ..GameControllerState::default()
        };
        referee.own_penalties[..3].fill(Penalty::None);
        let mut node = node();
        let heard = vec![(at_millis(0), &two)];
        cycle_with(&mut node, Some(referee), 10, heard, vec![]);
        let there = cycle_with(&mut node, Some(referee), 19_800, vec![], vec![]);
        assert_eq!(numbers(&there), [2]);
        // Nor do they talk more because the referee is not heard.
        let there = cycle_with(&mut node, None, 19_900, vec![], vec![]);
        assert_eq!(numbers(&there), [2]);
        let there = cycle_with(&mut node, Some(referee), 20_100, vec![], vec![]);
        assert_eq!(there, []);
    }

    #[test]
    fn whom_the_referee_has_taken_out_is_no_teammate_until_it_may_play_again() {
        let (two, five) = (message(2, false), message(5, false));
        for (penalty, expected) in [
            (Penalty::None, vec![2, 5]),
            (Penalty::IllegalBallContact, vec![5]),
            (Penalty::PlayerPushing, vec![5]),
            (Penalty::IllegalMotionInSet, vec![5]),
            (Penalty::InactivePlayer, vec![5]),
            (Penalty::IllegalPosition, vec![5]),
            (Penalty::LeavingTheField, vec![5]),
            (Penalty::RequestForPickup, vec![5]),
            (Penalty::LocalGameStuck, vec![5]),
            (Penalty::IllegalPositionInSet, vec![5]),
            (Penalty::PlayerStance, vec![5]),
            (Penalty::IllegalMotionInStandby, vec![5]),
            (Penalty::Substitute, vec![5]),
            (Penalty::Manual, vec![5]),
        ] {
            let mut referee = GameControllerState::default();
            let mut node = node();
            referee.own_penalties[1] = penalty;
            let heard = vec![(at_millis(10), &two), (at_millis(10), &five)];
            let playing = cycle_with(&mut node, Some(referee), 20, heard, vec![]);
            assert_eq!(numbers(&playing), expected, "{penalty:?}");
            referee.own_penalties[1] = Penalty::None;
            let back = cycle_with(&mut node, Some(referee), 30, vec![], vec![]);
            assert_eq!(numbers(&back), [2, 5], "{penalty:?}");
        }
    }

    #[test]
    fn a_ball_that_a_mate_saw_long_ago_is_none_however_long_the_mate_is_remembered() {
        // There is nothing left to say in 600 s.
        let referee = GameControllerState {
            seconds_remaining: 600,
            ..GameControllerState::default()
        };
        for (age, now, knows_ball) in [
            (0.0, 9_900, true),
            (0.0, 10_100, false),
            (4.0, 5_900, true),
            (4.0, 6_100, false),
            (0.0, 300_000, false),
        ] {
            let two = Some(TeamMessage {
                player_number: 2,
                ball: Some(TeamBall {
                    position: Point2::new(0.2, 0.0),
                    age,
                }),
                ..TeamMessage::default()
            });
            let heard = vec![(at_millis(0), &two)];
            let there = cycle_with(&mut node(), Some(referee), now, heard, vec![]);
            assert_eq!(numbers(&there), [2], "{now} ms");
            let ball = there[0].message.ball;
            assert_eq!(ball.is_some(), knows_ball, "{age} s, {now} ms");
        }
    }

    #[test]
    fn who_tells_of_what_lies_beside_the_carpet_is_not_believed() {
        let seen_from = |x: f32, y: f32, ball: [f32; 2]| {
            let told = Some(TeamMessage {
                player_number: 2,
                ground_to_field: Some(Isometry2::translation(x, y)),
                ball: Some(TeamBall {
                    position: Point2::from(ball),
                    age: 0.0,
                }),
                ..TeamMessage::default()
            });
            let heard = vec![(at_millis(10), &told)];
            let message = cycle(&mut node(), 20, heard, vec![])[0].message;
            (message.ground_to_field.is_some(), message.ball.is_some())
        };
        // Where it rolled over the line it is the ball.
        assert_eq!(seen_from(4.0, 3.5, [0.9, -0.2]), (true, true));
        for ball in [[1e20, 0.0], [0.0, 40.0], [f32::NAN, 0.0]] {
            assert_eq!(seen_from(0.0, 0.0, ball), (true, false), "{ball:?}");
        }
        // Who does not know where it stands may still stand before a ball.
        assert_eq!(seen_from(0.0, 6.0, [0.3, 0.0]), (false, true));
    }

    #[test]
    fn transient_messages_answer_but_are_not_learnt() {
        let two = message(2, false);
        let mut node = node();
        let teammates = cycle(&mut node, 20, vec![], vec![(at_millis(10), &two)]);
        assert_eq!(numbers(&teammates), [2]);
        assert_eq!(cycle(&mut node, 30, vec![], vec![]), []);
    }
}
