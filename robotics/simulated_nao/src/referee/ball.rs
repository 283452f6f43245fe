//! What becomes of the game where the ball goes.

use nalgebra::{Point2, Point3};
use types::game::{GameState, SetPlay};

use super::{Player, Referee, Ruling, direction, index, other};
use crate::field::{
    BALL_RADIUS, GOAL_AREA, GOAL_POST_RADIUS, GOAL_WIDTH, LENGTH, LINE_WIDTH, WIDTH,
};
use crate::scene::Team;

/// Nearer to the middle of a sole than this, m, the ball is touched: half the length of a foot, and the ball.
pub(crate) const TOUCH: f64 = 0.16;

impl Referee {
    pub(super) fn watch_ball(
        &mut self,
        now: f64,
        ball: &Point3<f64>,
        players: &[Player],
        rulings: &mut Vec<Ruling>,
    ) {
        if let Some(team) = touching(&ball.xy(), players) {
            self.touched_last = Some(team);
            // Whoever was to kick has done so.
            if team == self.kicking {
                self.set_play = SetPlay::None;
            }
        }
        // All of it has to be behind all of the line.
        let margin = f64::from(LINE_WIDTH) / 2.0 + f64::from(BALL_RADIUS);
        let (end, side) = (f64::from(LENGTH) / 2.0, f64::from(WIDTH) / 2.0);
        if ball.x.abs() > end + margin {
            let defending = if ball.x < 0.0 {
                Team::Own
            } else {
                Team::Opponent
            };
            if ball.y.abs() < f64::from(GOAL_WIDTH / 2.0 - GOAL_POST_RADIUS) {
                self.goal(now, other(defending), rulings);
            } else {
                self.behind_goal_line(now, defending, ball, rulings);
            }
        } else if ball.y.abs() > side + margin {
            let kicks = self.touched_last.map_or(self.kicking, other);
            let place = [ball.x.clamp(-end, end), side * ball.y.signum()];
            self.restart(now, SetPlay::KickIn, kicks, place, rulings);
        }
    }

    fn goal(&mut self, now: f64, team: Team, rulings: &mut Vec<Ruling>) {
        self.keep_secret(now);
        let score = &mut self.score[index(team)];
        *score = score.saturating_add(1);
        self.kicking = other(team);
        rulings.push(Ruling::Whistle);
        rulings.push(Ruling::PlaceBall([0.0, 0.0]));
        // Ten goals more are enough.
        let [blue, red] = self.score;
        let state = if blue.abs_diff(red) >= 10 {
            self.half = self.settings.halves;
            GameState::Finished
        } else {
            GameState::Ready
        };
        self.enter(now, state);
    }

    fn behind_goal_line(
        &mut self,
        now: f64,
        defending: Team,
        ball: &Point3<f64>,
        rulings: &mut Vec<Ruling>,
    ) {
        let toward = -direction(defending);
        let is_corner = self.touched_last == Some(defending);
        let end = f64::from(LENGTH) / 2.0;
        let (x, y) = if is_corner {
            (end, f64::from(WIDTH) / 2.0)
        } else {
            (end - f64::from(GOAL_AREA.x), f64::from(GOAL_AREA.y) / 2.0)
        };
        let place = [x * toward, y * ball.y.signum()];
        match is_corner {
            true => self.restart(now, SetPlay::CornerKick, other(defending), place, rulings),
            false => self.restart(now, SetPlay::GoalKick, defending, place, rulings),
        }
    }

    pub(super) fn restart(
        &mut self,
        now: f64,
        set_play: SetPlay,
        team: Team,
        place: [f64; 2],
        rulings: &mut Vec<Ruling>,
    ) {
        self.set_play = set_play;
        self.set_play_since = now;
        self.kicking = team;
        self.touched_last = None;
        rulings.push(Ruling::Whistle);
        rulings.push(Ruling::PlaceBall(place));
    }
}

/// Whose foot is next to the ball, if one is.
fn touching(ball: &Point2<f64>, players: &[Player]) -> Option<Team> {
    let feet = players
        .iter()
        .flat_map(|player| player.feet.map(|foot| (player.team, foot)));
    let near = feet
        .map(|(team, foot)| (team, (foot - ball).norm()))
        .filter(|(_, distance)| *distance < TOUCH);
    near.min_by(|(_, one), (_, other)| one.total_cmp(other))
        .map(|(team, _)| team)
}
