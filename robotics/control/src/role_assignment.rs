//! Decides what this robot is for its team.
//!
//! Every robot decides for itself, from the last messages of the others, by the same rule: the goalkeeper's shirt guards the
//! goal, of the others the one that is nearest to the ball plays it, the rest take their places in the order of their numbers.
//! Messages come every few seconds, so that robots may disagree for as long; who plays the ball already, by its own word,
//! counts as nearer than it is, for itself and for the others: else two that are about as far away would both play it. Where the keeper is out, taken out or far from its goal, the first of the rest stands between ball and goal. Before
//! the ball is in play numbers alone count. A robot that hears nobody plays the ball itself, unless it keeps the goal and the
//! others have a penalty kick. In a penalty shoot-out whose shot it is decides.
//!
//! Whose the goalkeeper's shirt is the referee says, and whoever has been taken out has no role: `teammates` leaves others out.

use framework::{Input, MainOutput, Parameter, Reflect, Result, context};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use types::ball::Ball;
use types::behavior::Role;
use types::field_markings::FieldMarkings;
use types::game::{GameControllerState, KickingTeam, Player, PrimaryState, WhoseBall};
use types::team::Teammate;

/// In the order in which players without gloves and without the ball take them.
const PLACES: [Role; 3] = [Role::DefenderLeft, Role::Supporter, Role::DefenderRight];

/// What this robot and the goalkeeper were last.
#[derive(Debug, Deserialize, Serialize)]
pub struct RoleAssignment {
    role: Option<Role>,
    /// Number of the goalkeeper's shirt; a referee that falls silent has not given it to somebody else.
    goalkeeper: Option<u8>,
    /// Whether that one was out.
    is_keeper_out: bool,
}

/// How robots of a team share the work.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RoleParameters {
    /// Number of the goalkeeper's shirt until the referee says it.
    pub keeper: u8,
    /// So much nearer to the ball than it is the robot counts that plays it.
    #[reflect(unit = "m", range = 0.0..)]
    pub hysteresis: f32,
    /// A keeper that is farther from the middle of its goal is out.
    #[reflect(unit = "m", range = 0.0..)]
    pub keeper_out: f32,
    /// And is back when it is nearer.
    #[reflect(unit = "m", range = 0.0..)]
    pub keeper_back: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    primary_state: Input<PrimaryState, "primary_state">,
    game_controller_state: Input<Option<GameControllerState>, "game_controller_state">,
    whose_ball: Input<WhoseBall, "whose_ball">,
    ball: Input<Option<Ball>, "ball">,
    team_ball: Input<Option<Point2<f32>>, "team_ball">,
    teammates: Input<Vec<Teammate>, "teammates">,

    /// Who this robot is in the game.
    player: Parameter<Player, "player">,
    parameters: Parameter<RoleParameters, "role_assignment">,
    markings: Parameter<FieldMarkings, "field_dimensions.markings">,
}

#[context]
pub struct MainOutputs {
    /// What this robot is for its team; `None` while it may not play.
    role: MainOutput<Option<Role>>,
    /// Number of the own goalkeeper's shirt; no robot has it where there is none.
    goalkeeper: MainOutput<u8>,
}

impl RoleAssignment {
    /// Alone until somebody is heard.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            role: Some(Role::Striker),
            goalkeeper: None,
            is_keeper_out: false,
        })
    }

    /// From what is known now.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let own = context
            .ball
            .map(|ball| ball.position)
            .or(*context.team_ball)
            .map(|ball| ball.coords.norm());
        let plays_ball = self.role == Some(Role::Striker);
        let hysteresis = context.parameters.hysteresis;
        // A mate that does not play yet is left the ball only where it is nearer by twice the hysteresis: it hears seldom how far the ball
        // went from here, and waits as long. Rather both than nobody.
        let handicap = |mate_plays: bool| match (mate_plays, plays_ball) {
            (true, _) => -hysteresis,
            (false, true) => hysteresis,
            (false, false) => 0.0,
        };
        let referee = context.game_controller_state.as_ref();
        self.goalkeeper = referee
            .map(|referee| referee.goalkeeper)
            .or(self.goalkeeper);
        let goalkeeper = self.goalkeeper.unwrap_or(context.parameters.keeper);
        let others = context.teammates.iter().map(|teammate| Candidate {
            number: teammate.message.player_number,
            distance: distance_to_ball(teammate)
                .map(|distance| distance + handicap(teammate.message.plays_ball)),
        });
        let own = Candidate {
            number: context.player.number,
            distance: match plays_ball {
                true => own.map(|distance| distance - hysteresis),
                false => own,
            },
        };
        self.is_keeper_out = self.is_keeper_out(goalkeeper, &context);
        let in_shoot_out = context.whose_ball.shot_of().and_then(role_in_shoot_out);
        self.role = match context.primary_state {
            PrimaryState::Penalized => None,
            _ if in_shoot_out.is_some() => in_shoot_out,
            // Alone, too, it may not leave its line.
            _ if own.number == goalkeeper && context.whose_ball.is_penalty_kick_of_others() => {
                Some(Role::Keeper)
            }
            state => {
                let is_playing = *state == PrimaryState::Playing;
                let is_out = is_playing && self.is_keeper_out;
                Some(role(own, others, goalkeeper, is_playing, is_out))
            }
        };
        Ok(MainOutputs {
            role: self.role.into(),
            goalkeeper: goalkeeper.into(),
        })
    }

    /// Whether the goal is without a keeper: nobody has its shirt who may play, or it has gone far away.
    fn is_keeper_out(&self, goalkeeper: u8, context: &CycleContext<'_>) -> bool {
        let goal = Point2::new(-0.5 * context.markings.length, 0.0);
        let reach = match self.is_keeper_out {
            true => context.parameters.keeper_back,
            false => context.parameters.keeper_out,
        };
        let mut teammates = context.teammates.iter();
        let keeper = teammates.find(|teammate| teammate.message.player_number == goalkeeper);
        // One that does not know where it is stays where it is.
        keeper.is_none_or(|keeper| {
            keeper
                .message
                .ground_to_field
                .is_some_and(|pose| (Point2::from(pose.translation.vector) - goal).norm() > reach)
        })
    }
}

/// One robot shoots and one keeps, whatever their shirts.
fn role_in_shoot_out(shot_of: KickingTeam) -> Option<Role> {
    match shot_of {
        KickingTeam::Own => Some(Role::Striker),
        KickingTeam::Opponent => Some(Role::Keeper),
        KickingTeam::Nobody => None,
    }
}

/// Who could play the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    number: u8,
    /// From the ball in m; `None` for one that does not know, or lies.
    distance: Option<f32>,
}

fn role(
    own: Candidate,
    others: impl Iterator<Item = Candidate> + Clone,
    keeper: u8,
    is_playing: bool,
    is_keeper_out: bool,
) -> Role {
    let others = others.filter(|other| other.number != own.number);
    let is_alone = others.clone().next().is_none();
    if own.number == keeper {
        // Nobody else plays, so there is nothing to win at the goal.
        return match is_alone && is_playing {
            true => Role::Striker,
            false => Role::Keeper,
        };
    }
    let field_players = || others.clone().filter(|other| other.number != keeper);
    let comes_before = |one: Candidate, other: Candidate| {
        let key = |candidate: Candidate| match is_playing {
            true => candidate.distance.unwrap_or(f32::INFINITY),
            false => 0.0,
        };
        key(one)
            .total_cmp(&key(other))
            .then(one.number.cmp(&other.number))
            .is_lt()
    };
    let striker = field_players().fold(own, |best, other| match comes_before(other, best) {
        true => other,
        false => best,
    });
    if striker.number == own.number {
        return Role::Striker;
    }
    let before =
        field_players().filter(|other| other.number != striker.number && other.number < own.number);
    match before.count() {
        0 if is_keeper_out => Role::Sweeper,
        before => PLACES[before % PLACES.len()],
    }
}

fn distance_to_ball(teammate: &Teammate) -> Option<f32> {
    let message = &teammate.message;
    let ball = message.ball.filter(|_| !message.is_fallen)?;
    Some(ball.position.coords.norm())
}

#[cfg(test)]
mod tests;
