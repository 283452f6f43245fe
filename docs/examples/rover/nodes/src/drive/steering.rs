//! Drives from goal to goal: of the ways that are free, the one that leads there.

use framework::{HistoricInput, Input, MainOutput, Parameter, PerceptionInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Freeway, Pose, Speeds, wrapped};

/// Where there was room, and which goal is next.
#[derive(Debug, Deserialize, Serialize)]
pub struct Steering {
    /// Of the newest scan; directions as seen from the start.
    freeways: Vec<Freeway>,
    goal: usize,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    freeways: PerceptionInput<Vec<Freeway>, "Lidar", "freeways">,
    poses: HistoricInput<Pose, "pose">,
    pose: Input<Pose, "pose">,

    /// As seen from the start, metres; after the last comes the first.
    goals: Parameter<Vec<[f32; 2]>, "steering.goals">,
    /// Nearer than this a goal is reached.
    #[reflect(unit = "m", range = 0.0..)]
    tolerance: Parameter<f32, "steering.tolerance">,
    /// What has to be free on the way that is taken.
    #[reflect(unit = "m", range = 0.0..)]
    look_ahead: Parameter<f32, "steering.look_ahead">,
    /// Where there is room.
    #[reflect(unit = "m/s", range = 0.0..=1.0)]
    cruising: Parameter<f32, "steering.cruising">,
    /// How fast it turns into the way that is taken.
    #[reflect(unit = "1/s", range = 0.0..)]
    gain: Parameter<f32, "steering.gain">,
    #[reflect(unit = "rad/s", range = 0.0..)]
    fastest_turn: Parameter<f32, "steering.fastest_turn">,
}

#[context]
pub struct MainOutputs {
    /// `None` while nothing was seen, or there is no goal.
    speeds: MainOutput<Option<Speeds>>,
}

impl Steering {
    /// Nothing was seen yet.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            freeways: Vec::new(),
            goal: 0,
        })
    }

    /// Learns where there is room, then chooses.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let seen = context.freeways;
        if let Some((captured_at, freeways)) = seen.transient.last().or(seen.persistent.last()) {
            // The rover has turned since the scan was taken.
            let heading = context
                .poses
                .get(captured_at)
                .unwrap_or(context.pose)
                .heading;
            self.freeways.clear();
            self.freeways.extend(freeways.iter().map(|one| Freeway {
                direction: wrapped(one.direction + heading),
                distance: one.distance,
            }));
        }
        let goal = context.goals.get(self.goal % context.goals.len().max(1));
        let speeds = goal.and_then(|goal| {
            let away = [0, 1].map(|axis| goal[axis] - context.pose.position[axis]);
            let distance = away[0].hypot(away[1]);
            if distance < *context.tolerance {
                self.goal += 1;
            }
            let way = self.way(away[1].atan2(away[0]), distance, &context)?;
            Some(towards(way, &context))
        });
        Ok(MainOutputs {
            speeds: speeds.into(),
        })
    }

    /// Of the ways that are free far enough the nearest to the goal's direction; else the one that is free farthest.
    fn way(&self, goal: f32, distance: f32, context: &CycleContext) -> Option<Freeway> {
        let needed = distance.min(*context.look_ahead);
        let detour = |way: &Freeway| {
            let aside = wrapped(way.direction - goal).abs();
            // Of two that are equally good the one ahead, so that it does not waver.
            aside + 0.3 * wrapped(way.direction - context.pose.heading).abs()
        };
        let free = self.freeways.iter().filter(|way| way.distance > needed);
        let best = free.min_by(|one, other| detour(one).total_cmp(&detour(other)));
        let farthest = || {
            let ways = self.freeways.iter();
            ways.max_by(|one, other| one.distance.total_cmp(&other.distance))
        };
        best.or_else(farthest).copied()
    }
}

/// Turns into the way, and drives the faster the more it is ahead.
fn towards(way: Freeway, context: &CycleContext) -> Speeds {
    let aside = wrapped(way.direction - context.pose.heading);
    let room = (way.distance / context.look_ahead).clamp(0.2, 1.0);
    let fastest = *context.fastest_turn;
    Speeds {
        forward: context.cruising * room * aside.cos().max(0.0).powi(4),
        turn: (context.gain * aside).clamp(-fastest, fastest),
    }
}
