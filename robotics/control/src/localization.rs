//! Knows where the robot is on the field, from the lines, centre circles and penalty marks that both cameras saw in order.
//! Corners say more where a lost robot may be, and nothing beyond their lines where it is not lost.
//!
//! A few hypotheses, each an extended Kalman filter over place and heading that odometry moves. What
//! was seen belongs to the marking that was expected nearest; a hypothesis that explains little of it
//! loses weight. A robot whose best hypothesis explains too little is lost: it looks for places from
//! which the field looks as it was seen lately. It begins at the start pose of its number, or lost at
//! any of them where its number has none, and comes back from a penalty where the rules have it put.
//!
//! Cycles of Vision that nothing older can overtake any more are learnt; younger ones only refine
//! this cycle's answer.

mod belief;
mod estimate;
mod features;
mod memory;
mod parameters;
mod search;
mod seen;
mod sight;

use std::f32::consts::FRAC_PI_2;
use std::slice;

use framework::{
    AdditionalOutput, CycleTime, HistoricInput, Input, MainOutput, Parameter, PerceptionInput,
    Reflect, Result, RollBack, Timestamp, context,
};
use nalgebra::{Isometry2, Matrix3, Vector2};
use serde::{Deserialize, Serialize};
use types::fall_state::FallState;
use types::field_features::{CenterCircle, LineCorner, LineSegment, PenaltyMark};
use types::field_markings::FieldMarkings;
use types::game::{GameControllerState, KickingTeam, Player, PrimaryState};
use types::odometry::Odometry;

use self::belief::{Belief, Hypothesis};
use self::estimate::Estimate;
pub use self::parameters::{FieldPose, LocalizationParameters};
use self::seen::{Seen, images};
use self::sight::View;
use crate::start_frame::ground_to_start;

/// A place where the robot may be.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct PoseHypothesis {
    /// From the ground frame to the field frame, m and rad.
    pub ground_to_field: Isometry2<f32>,
    /// Of x, y and heading, in m², m rad and rad².
    pub covariance: Matrix3<f32>,
    /// Share of what was seen lately that it explains, 0 to 1.
    pub evidence: f32,
}

/// What was learnt of the own place.
#[derive(Debug, Deserialize, Serialize)]
pub struct Localization {
    belief: RollBack<Belief>,
    primary_state: PrimaryState,
    /// What was seen before does not count.
    begun_at: Timestamp,
    /// Whose shot of a shoot-out it was put down for last; `None` once that is over.
    put_for: Option<KickingTeam>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    lines: PerceptionInput<Vec<LineSegment>, "Vision", "lines">,
    penalty_mark: PerceptionInput<Option<PenaltyMark>, "Vision", "penalty_mark">,
    center_circle: PerceptionInput<Option<CenterCircle>, "Vision", "center_circle">,
    corners: PerceptionInput<Vec<LineCorner>, "Vision", "corners">,
    odometry: HistoricInput<Odometry, "odometry">,
    fall_state: Input<FallState, "fall_state">,
    has_ground_contact: Input<bool, "has_ground_contact">,
    primary_state: Input<PrimaryState, "primary_state">,
    game_controller_state: Input<Option<GameControllerState>, "game_controller_state">,
    cycle_time: CycleTime,

    /// Who this robot is in the game.
    player: Parameter<Player, "player">,
    markings: Parameter<FieldMarkings, "field_dimensions.markings">,
    parameters: Parameter<LocalizationParameters, "localization">,

    /// All places where the robot may be, the one that counts first.
    hypotheses: AdditionalOutput<Vec<PoseHypothesis>, "localization.hypotheses">,
}

#[context]
pub struct MainOutputs {
    /// From the ground frame of this cycle to the field frame, m and rad; x points to the opponents' goal.
    /// `None` while the robot does not know where it is.
    ground_to_field: MainOutput<Option<Isometry2<f32>>>,
}

impl Localization {
    /// Has seen nothing.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            belief: RollBack::default(),
            primary_state: PrimaryState::default(),
            begun_at: Timestamp::ZERO,
            put_for: None,
        })
    }

    /// Learns from what is settled, then looks at what is not.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let now = context.cycle_time.start;
        let view = View {
            markings: context.markings,
            parameters: context.parameters,
        };
        let odometry = context.odometry;
        let is_upright = *context.fall_state == FallState::Upright;
        // What was seen before it began, perhaps while somebody carried it, was seen from elsewhere.
        let see_since = |begun_at| {
            move |belief: &mut Belief, timestamp, seen: Seen<'_>| {
                let pose = ground_to_start(&odometry, timestamp);
                if let Some(pose) = pose.filter(|_| timestamp >= begun_at) {
                    belief.predict(timestamp, pose, is_upright, &view);
                    belief.learn(timestamp, pose, seen, &view);
                }
            }
        };
        let (lines, marks) = (context.lines, context.penalty_mark);
        let (circles, corners) = (context.center_circle, context.corners);
        let persistent = images(
            lines.persistent,
            marks.persistent,
            circles.persistent,
            corners.persistent,
        );
        self.belief.settle(persistent, see_since(self.begun_at));
        let pose = ground_to_start(&odometry, now);
        if let Some(pose) = pose {
            self.put(&context, pose, &view);
        }
        let transient = images(
            lines.transient,
            marks.transient,
            circles.transient,
            corners.transient,
        );
        let mut newest = self
            .belief
            .with_transient(transient, see_since(self.begun_at));
        if let Some(pose) = pose {
            newest.predict(now, pose, is_upright, &view);
        }
        context
            .hypotheses
            .fill_if_subscribed(|| newest.iter().map(described).collect());
        let best = newest.best();
        let known = best.filter(|best| best.evidence >= context.parameters.lost_evidence);
        Ok(MainOutputs {
            ground_to_field: known.map(|known| known.estimate.pose()).into(),
        })
    }

    /// What people do with a robot that does not play: before each half it is put to its start, before a shot of a
    /// shoot-out to ball or goal, after a penalty beside the field, unless it was left where it stood.
    ///
    /// What it believed before does not help then: the teams have changed sides, and the field looks the same from the other.
    fn put(
        &mut self,
        context: &CycleContext<'_>,
        ground_to_start: Isometry2<f32>,
        view: &View<'_>,
    ) {
        let (now, primary_state) = (context.cycle_time.start, *context.primary_state);
        let before = std::mem::replace(&mut self.primary_state, primary_state);
        let is_first = self.begun_at == Timestamp::ZERO;
        let put_to = self.put_for_shot(context, before, is_first);
        let is_put_to_start = match primary_state {
            PrimaryState::Unstiff => true,
            PrimaryState::Initial => {
                !matches!(before, PrimaryState::Unstiff | PrimaryState::Initial)
                    || context.is_carried()
            }
            // Nobody heard that the next half was prepared.
            PrimaryState::Standby | PrimaryState::Ready | PrimaryState::Set => {
                before == PrimaryState::Finished
            }
            _ => false,
        };
        let belief = self.belief.settled_mut();
        if let Some(pose) = put_to.and_then(|team| shot_pose(team, view)) {
            self.begun_at = now;
            belief.begin(now, ground_to_start, [put_at(pose, view)].into_iter());
        } else if is_first || is_put_to_start {
            self.begun_at = now;
            belief.begin(now, ground_to_start, starts(*context.player, view));
        } else if before == PrimaryState::Penalized && primary_state != before {
            belief.or_at(
                return_poses(view)
                    .map(|pose| put_at(pose, view))
                    .into_iter(),
            );
        }
    }

    /// Whose shot of a shoot-out it was put down for in this cycle.
    ///
    /// Once for each: Set comes back where a whistle was somebody else's, and then nobody has touched the robot.
    fn put_for_shot(
        &mut self,
        context: &CycleContext<'_>,
        before: PrimaryState,
        is_first: bool,
    ) -> Option<KickingTeam> {
        let is_in_set = match context.primary_state {
            PrimaryState::Set => true,
            PrimaryState::Playing => false,
            _ => {
                self.put_for = None;
                return None;
            }
        };
        // Who is still carried will stand there.
        if is_in_set && context.is_carried() {
            self.put_for = None;
        }
        let said = context.game_controller_state.as_ref();
        let shot_of = said.and_then(|said| said.whose_ball().shot_of());
        let shot_of = shot_of.filter(|team| *team != KickingTeam::Nobody);
        let is_put = match is_in_set {
            true => *context.has_ground_contact,
            false => is_first || (self.put_for.is_none() && before != PrimaryState::Playing),
        };
        let team = shot_of.filter(|team| is_put && self.put_for != Some(*team))?;
        self.put_for = Some(team);
        Some(team)
    }
}

impl CycleContext<'_> {
    /// Whether somebody holds it, upright in the air.
    fn is_carried(&self) -> bool {
        *self.fall_state == FallState::Upright && !self.has_ground_contact
    }
}

/// The start pose of its number, or all of them where it has none: what it sees decides, and until then it is lost.
fn starts(player: Player, view: &View<'_>) -> impl Iterator<Item = Hypothesis> {
    let poses = view.parameters.start_poses.as_slice();
    let own = match poses {
        [everybodys] => Some(everybodys),
        _ => poses.get(usize::from(player.number).saturating_sub(1)),
    };
    let (poses, evidence) = match own {
        Some(own) => (slice::from_ref(own), view.parameters.start_evidence),
        None => (poses, view.parameters.lost_evidence / 2.0),
    };
    poses.iter().map(move |&FieldPose { x, y, heading }| {
        let pose = Isometry2::new(Vector2::new(x, y), heading);
        Hypothesis {
            evidence,
            ..put_at(pose, view)
        }
    })
}

/// RoboCup SPL rules 2025, penalty shoot-out: who shoots stands on the edge of the penalty area before the ball, who
/// keeps the goal in the middle of its line.
fn shot_pose(team: KickingTeam, view: &View<'_>) -> Option<Isometry2<f32>> {
    let goal_line = view.markings.length / 2.0;
    let x = match team {
        KickingTeam::Own => goal_line - view.markings.penalty_area_length,
        KickingTeam::Opponent => -goal_line,
        KickingTeam::Nobody => return None,
    };
    Some(Isometry2::translation(x, 0.0))
}

/// RoboCup SPL rules 2025: beside the field at the height of the own penalty mark, facing the field.
fn return_poses(view: &View<'_>) -> [Isometry2<f32>; 2] {
    let [_, own_mark] = view.markings.penalty_marks();
    let y = view.markings.width / 2.0 + view.parameters.return_distance;
    [1.0, -1.0].map(|side| Isometry2::new(Vector2::new(own_mark.x, side * y), -side * FRAC_PI_2))
}

fn put_at(pose: Isometry2<f32>, view: &View<'_>) -> Hypothesis {
    let parameters = view.parameters;
    Hypothesis {
        estimate: Estimate::new(pose, parameters.start_noise, parameters.start_turn_noise),
        evidence: parameters.start_evidence,
    }
}

fn described(hypothesis: &Hypothesis) -> PoseHypothesis {
    PoseHypothesis {
        ground_to_field: hypothesis.estimate.pose(),
        covariance: hypothesis.estimate.covariance,
        evidence: hypothesis.evidence,
    }
}

#[cfg(test)]
mod tests;
