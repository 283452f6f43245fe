//! The game in the world: what the referee sees, and what becomes of the rulings.

use framework::Timestamp;
use nalgebra::{Point3, Vector3};
use types::game::{GameControllerMessage, Penalty};

use super::World;
use crate::field::BALL_RADIUS;
use crate::ground_truth::GameTruth;
use crate::physics::{Disturbance, heading};
use crate::referee::{self, Player, Referee, Ruling};
use crate::scene::Team;
use crate::settings::GameSettings;
use crate::simulation::TICK;

/// Before a whistle sounds, s: longer than anybody is ahead of the world, so that nobody misses its beginning.
const BREATH: f64 = 0.05;

/// How long whoever carries a robot holds it upright where it will stand, s: by then the referee's computer has told it that it
/// is penalised, twice a second, and it has gone into the pose in which it waits.
const HELD: f64 = 4.0;

/// A game that is played.
pub(super) struct Game {
    referee: Referee,
    settings: GameSettings,
    held: Vec<Held>,
}

/// A robot in somebody's hands.
struct Held {
    robot: usize,
    /// x and y in m, heading in rad.
    pose: [f64; 3],
    /// When it is let go, s.
    until: f64,
}

impl Game {
    /// Where the settings ask for one.
    pub(super) fn new(settings: &GameSettings) -> Option<Self> {
        settings.play.map(|play| Self {
            referee: Referee::new(play),
            settings: settings.clone(),
            held: Vec::new(),
        })
    }

    /// A team that has sent more messages than it may loses all its goals.
    fn take_goals(&mut self, messages: [u32; 2]) {
        for (score, sent) in self.referee.score.iter_mut().zip(messages) {
            if sent > u32::from(self.settings.message_budget) {
                *score = 0;
            }
        }
    }
}

impl World {
    /// Lets the referee rule, as often as LoLA sends states.
    pub(super) fn referee_looks(&mut self) {
        let passed = self.stepped - Timestamp::ZERO;
        if self.game.is_none() || !passed.as_nanos().is_multiple_of(TICK.as_nanos()) {
            return;
        }
        let (now, ball, players) = (passed.as_secs_f64(), self.ball(), self.players());
        let rulings = self
            .game
            .as_mut()
            .map(|game| game.referee.look(now, ball, &players));
        if let Some(game) = &mut self.game {
            game.take_goals(self.messages);
        }
        self.obey(now, rulings.unwrap_or_default());
    }

    /// One of a team has told it something.
    pub(crate) fn count_message(&mut self, team: Team) {
        let sent = &mut self.messages[usize::from(team == Team::Opponent)];
        *sent = sent.saturating_add(1);
    }

    /// How many messages the own team and the other one have sent.
    pub(crate) fn messages(&self) -> [u32; 2] {
        self.messages
    }

    /// Keeps robots upright and where they are held; their joints move as they please. After every step, so that they feel
    /// the hands that bear them.
    pub(super) fn hold(&mut self) {
        let Some(game) = &mut self.game else {
            return;
        };
        let now = (self.stepped - Timestamp::ZERO).as_secs_f64();
        game.held.retain(|held| now < held.until);
        let held: Vec<_> = game
            .held
            .iter()
            .map(|held| (held.robot, held.pose))
            .collect();
        for (robot, pose) in held {
            self.disturb(&Disturbance::Hold { robot, pose });
        }
    }

    /// Somebody takes a robot out; whether there is a game.
    pub(crate) fn penalise(&mut self, robot: usize, penalty: Penalty) -> bool {
        let players = self.players();
        let Some(game) = &mut self.game else {
            return false;
        };
        let rulings = game.referee.penalise(robot, penalty, &players);
        self.obey((self.now - Timestamp::ZERO).as_secs_f64(), rulings);
        true
    }

    /// Somebody whistles.
    pub(crate) fn whistle(&mut self) {
        self.obey(
            (self.now - Timestamp::ZERO).as_secs_f64(),
            vec![Ruling::Whistle],
        );
    }

    /// When whistles of this world began that nobody had planned, s.
    pub(crate) fn whistles(&self) -> &[f64] {
        &self.whistles
    }

    /// What the referee's computer says, where a game is played; without its number.
    pub(crate) fn game_message(&self) -> Option<GameControllerMessage> {
        let now = (self.now - Timestamp::ZERO).as_secs_f64();
        self.game
            .as_ref()
            .map(|game| referee::message(&game.referee, &game.settings, now, &self.players()))
    }

    /// How the game really stands for the robot at this place of the world, where one is played.
    pub(crate) fn game_truth(&self, robot: usize) -> Option<GameTruth> {
        self.game.as_ref().map(|Game { referee, .. }| GameTruth {
            state: referee.state,
            set_play: referee.set_play,
            kicking: referee.kicking,
            score: referee.score,
            removed: referee.removals(robot).count(),
            misplaced: referee.removals(robot).filter(is_of_place).count(),
            plays: referee.plays(robot),
        })
    }

    fn players(&self) -> Vec<Player> {
        let robots = self.physics.bodies().iter().zip(&self.inhabitants);
        robots
            .map(|(body, inhabitant)| {
                let ground = body.ground_to_field().translation.vector;
                let soles = [body.soles_to_field.left, body.soles_to_field.right];
                Player {
                    team: inhabitant.team,
                    number: inhabitant.number,
                    pose: [ground.x, ground.y, heading(&body.torso_to_field)],
                    tilt: body.tilt(),
                    feet: soles.map(|sole| sole.translation.vector.xy().into()),
                }
            })
            .collect()
    }

    fn carry(&mut self, now: f64, robot: usize, pose: [f64; 3]) {
        self.disturb(&Disturbance::Hold { robot, pose });
        if let Some(game) = &mut self.game {
            game.held.retain(|held| held.robot != robot);
            game.held.push(Held {
                robot,
                pose,
                until: now + HELD,
            });
        }
    }

    fn obey(&mut self, now: f64, rulings: Vec<Ruling>) {
        for ruling in rulings {
            match ruling {
                Ruling::Whistle => self.whistles.push(now + BREATH),
                Ruling::PlaceBall([x, y]) => self.disturb(&Disturbance::MoveBall {
                    position: Point3::new(x, y, f64::from(BALL_RADIUS)),
                    velocity: Vector3::zeros(),
                }),
                Ruling::Carry(robot, pose) => self.carry(now, robot, pose),
            }
        }
    }
}

/// Whether a robot was removed for where it stood or walked.
fn is_of_place(penalty: &Penalty) -> bool {
    matches!(
        penalty,
        Penalty::IllegalPosition
            | Penalty::IllegalPositionInSet
            | Penalty::IllegalMotionInSet
            | Penalty::LeavingTheField
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::PlaySettings;

    #[test]
    fn more_messages_than_the_budget_cost_the_team_its_goals() {
        let mut game = Game::new(&GameSettings {
            message_budget: 3,
            play: Some(PlaySettings::default()),
            ..GameSettings::default()
        })
        .unwrap();
        game.referee.score = [2, 1];
        game.take_goals([3, 3]);
        assert_eq!(game.referee.score, [2, 1]);
        game.take_goals([3, 4]);
        assert_eq!(game.referee.score, [2, 0]);
    }
}
