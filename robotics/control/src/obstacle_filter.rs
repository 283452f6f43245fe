//! Knows what stands in the way, from the feet that cameras see, echoes, and what the own feet touch.
//!
//! Each obstacle is a Kalman filter in the start frame of odometry: obstacles hardly move, the robot
//! does. Cycles of Vision that nothing older can overtake any more are learnt, and with them what the
//! body feels now; younger images only refine this cycle's answer.

mod hypotheses;
mod nearby;

use framework::{
    CycleTime, HistoricInput, Input, MainOutput, Parameter, PerceptionInput, Reflect, Result,
    RollBack, context,
};
use nalgebra::Isometry2;
use serde::{Deserialize, Serialize};
use types::fall_state::FallState;
use types::feet::Feet;
use types::obstacles::{Obstacle, ObstacleCandidate, ObstacleKind};
use types::odometry::Odometry;
use types::sonar::SonarDistances;

use self::hypotheses::{Hypotheses, Hypothesis, Measurement};
use self::nearby::{bumps, echoes};
use crate::start_frame::ground_to_start;

/// What is believed of obstacles and of those who perceive them.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ObstacleFilterParameters {
    /// Of a robot.
    #[reflect(unit = "m", range = 0.0..)]
    pub robot_radius: f32,
    /// Of anything else.
    #[reflect(unit = "m", range = 0.0..)]
    pub unknown_radius: f32,
    /// How far the middle of a robot is behind the near side of its feet, which is what a camera sees.
    #[reflect(unit = "m", range = 0.0..)]
    pub feet_depth: f32,
    /// In m after 1 s: how far an obstacle gets, one standard deviation.
    pub position_noise: f32,
    /// In m per m of distance: how wrong a camera is, one standard deviation.
    pub camera_noise: f32,
    /// How wrong an echo is that was measured once, one standard deviation.
    #[reflect(unit = "m", range = 0.0..)]
    pub sonar_noise: f32,
    /// How wrong a touch is, one standard deviation.
    #[reflect(unit = "m", range = 0.0..)]
    pub bumper_noise: f32,
    /// Nothing is measured more exactly, one standard deviation: the shell of a foot is no point. What a camera sees before its
    /// own toes would else be known for certain, and whatever is perceived later would not move it.
    #[reflect(unit = "m", range = 0.001..)]
    pub least_noise: f32,
    /// What is perceived nearer to an obstacle than this is that obstacle.
    #[reflect(unit = "m", range = 0.0..)]
    pub same_place: f32,
    /// As how many measurements something in an image counts.
    pub camera_evidence: f32,
    /// As how many measurements a cycle with an echo counts.
    pub sonar_evidence: f32,
    /// As how many measurements a cycle with a touch counts.
    pub bumper_evidence: f32,
    /// So many measurements make an obstacle.
    pub least_evidence: f32,
    /// More measurements do not count.
    pub most_evidence: f32,
    /// What nobody perceived for so long is forgotten.
    #[reflect(unit = "s", range = 0.0..)]
    pub forget_after: f32,
    /// How far to the side each of the sonar's receivers hears.
    #[reflect(unit = "rad")]
    pub sonar_angle: f32,
    /// Echoes from farther away do not count.
    #[reflect(unit = "m", range = 0.0..)]
    pub sonar_reach: f32,
    /// How far ahead the bumpers are.
    #[reflect(unit = "m", range = 0.0..)]
    pub bumper_distance: f32,
    /// How far to the side the bumpers are.
    #[reflect(unit = "rad")]
    pub bumper_angle: f32,
    /// What a foot touches for longer does not count any more: bumpers stick, and what stays there other senses see.
    #[reflect(unit = "s", range = 0.0..)]
    pub bumper_duration: f32,
}

/// What was perceived so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct ObstacleFilter {
    hypotheses: RollBack<Hypotheses>,
    /// For how long each bumper has been pressed, s.
    pressed_for: Feet<f32>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    candidates: PerceptionInput<Vec<ObstacleCandidate>, "Vision", "obstacles">,
    odometry: HistoricInput<Odometry, "odometry">,
    sonar_distances: Input<SonarDistances, "sonar_distances">,
    bumpers: Input<Feet<bool>, "buttons.bumpers">,
    fall_state: Input<FallState, "fall_state">,
    cycle_time: CycleTime,
    parameters: Parameter<ObstacleFilterParameters, "obstacle_filter">,

    /// What the robot must not run into, nearest first.
    obstacles: MainOutput<Vec<Obstacle>>,
}

#[context]
pub struct MainOutputs {}

impl ObstacleFilter {
    /// Knows of nothing.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            hypotheses: RollBack::default(),
            pressed_for: Feet::default(),
        })
    }

    /// Learns from what is settled, then looks at what is not.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let (odometry, parameters) = (context.odometry, context.parameters);
        let see = |hypotheses: &mut Hypotheses, timestamp, candidates: &Vec<ObstacleCandidate>| {
            hypotheses.predict(timestamp, parameters);
            if let Some(pose) = ground_to_start(&odometry, timestamp) {
                for measurement in candidates
                    .iter()
                    .filter_map(|seen| behind(seen, parameters))
                {
                    hypotheses.learn(&moved(measurement, pose), timestamp, parameters);
                }
                hypotheses.merge(parameters.same_place);
            }
        };
        self.hypotheses.settle(context.candidates.persistent, see);
        let pose = ground_to_start(&odometry, context.cycle_time.start);
        if let Some(pose) = pose {
            self.feel(&context, pose);
        }
        let transient = context.candidates.transient;
        let mut newest = self.hypotheses.with_transient(transient, see);

        newest.predict(context.cycle_time.start, parameters);
        let obstacles = context.obstacles;
        if let Some(pose) = pose {
            let start_to_ground = pose.inverse();
            let sure = newest
                .iter()
                .filter(|hypothesis| hypothesis.evidence >= parameters.least_evidence);
            obstacles.extend(sure.map(|known| obstacle(known, start_to_ground, parameters)));
        }
        let distance = |obstacle: &Obstacle| obstacle.position.coords.norm();
        obstacles.sort_unstable_by(|a, b| distance(a).total_cmp(&distance(b)));
        Ok(MainOutputs {})
    }

    /// Learns at once what the body feels: nothing that is still to come can change it. A robot that does not stand hears and
    /// touches the ground.
    fn feel(&mut self, context: &CycleContext, ground_to_start: Isometry2<f32>) {
        let parameters = context.parameters;
        let step = context.cycle_time.since_last.as_secs_f32();
        let touched = self.touched(context.bumpers, step, parameters.bumper_duration);
        if *context.fall_state != FallState::Upright {
            return;
        }
        let felt =
            echoes(context.sonar_distances, step, parameters).chain(bumps(&touched, parameters));
        let hypotheses = self.hypotheses.settled_mut();
        hypotheses.predict(context.cycle_time.start, parameters);
        for measurement in felt {
            let measurement = moved(measurement, ground_to_start);
            hypotheses.learn(&measurement, context.cycle_time.start, parameters);
        }
    }

    /// Which feet touch something, for no longer than `duration` s.
    fn touched(&mut self, bumpers: &Feet<bool>, step: f32, duration: f32) -> Feet<bool> {
        let touches = |is_pressed: bool, pressed_for: &mut f32| {
            *pressed_for = if is_pressed { *pressed_for + step } else { 0.0 };
            is_pressed && *pressed_for <= duration
        };
        Feet {
            left: touches(bumpers.left, &mut self.pressed_for.left),
            right: touches(bumpers.right, &mut self.pressed_for.right),
        }
    }
}

/// The near side of its feet is what a camera sees; the middle is farther away.
fn behind(
    candidate: &ObstacleCandidate,
    parameters: &ObstacleFilterParameters,
) -> Option<Measurement> {
    let distance = candidate.position.coords.norm();
    let farther = 1.0 + parameters.feet_depth / distance.max(f32::EPSILON);
    distance.is_finite().then(|| Measurement {
        position: candidate.position * farther,
        noise: parameters.camera_noise * distance,
        evidence: parameters.camera_evidence,
        kind: ObstacleKind::Robot,
    })
}

fn moved(measurement: Measurement, ground_to_start: Isometry2<f32>) -> Measurement {
    Measurement {
        position: ground_to_start * measurement.position,
        ..measurement
    }
}

fn obstacle(
    hypothesis: &Hypothesis,
    start_to_ground: Isometry2<f32>,
    parameters: &ObstacleFilterParameters,
) -> Obstacle {
    let radius = match hypothesis.kind {
        ObstacleKind::Robot => parameters.robot_radius,
        ObstacleKind::Unknown => parameters.unknown_radius,
    };
    Obstacle {
        position: start_to_ground * hypothesis.position,
        radius,
        kind: hypothesis.kind,
        seen_at: hypothesis.seen_at,
    }
}

#[cfg(test)]
mod tests;
