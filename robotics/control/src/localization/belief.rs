//! Owns `Belief`, everything that is believed of the robot's place at one time.
//!
//! Invariant: the hypothesis that counts stands first; another one takes its place only when clearly
//! more speaks for it, so that the robot does not jump to and fro.

use framework::{Timestamp, math};
use nalgebra::{Isometry2, Point2, Vector3};
use serde::{Deserialize, Serialize};

use super::estimate::Estimate;
use super::features::Line;
use super::memory::Memory;
use super::search;
use super::seen::Seen;
use super::sight::{Match, View};
use crate::angle::wrap;

/// More are not kept: the one for which least speaks makes room.
pub(super) const MOST_HYPOTHESES: usize = 8;

/// A place where the robot may be.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub(super) struct Hypothesis {
    pub(super) estimate: Estimate,
    /// Share of what was seen lately that it explains, 0 to 1.
    pub(super) evidence: f32,
}

/// Where the robot may be, and what it saw on its way there.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Belief {
    time: Timestamp,
    /// From the ground frame at that time to the start frame of odometry; `None` before the first.
    odometry: Option<Isometry2<f32>>,
    /// The one that counts stands first.
    hypotheses: [Option<Hypothesis>; MOST_HYPOTHESES],
    memory: Memory,
    searched_at: Timestamp,
}

impl Default for Belief {
    fn default() -> Self {
        Self {
            time: Timestamp::ZERO,
            odometry: None,
            hypotheses: [None; MOST_HYPOTHESES],
            memory: Memory::default(),
            searched_at: Timestamp::ZERO,
        }
    }
}

impl Belief {
    pub(super) fn iter(&self) -> impl Iterator<Item = &Hypothesis> {
        self.hypotheses.iter().flatten()
    }

    /// The hypothesis that counts.
    pub(super) fn best(&self) -> Option<&Hypothesis> {
        self.hypotheses[0].as_ref()
    }

    /// Forgets everything; the robot stands at one of these places. What was seen before now counts no more.
    pub(super) fn begin(
        &mut self,
        now: Timestamp,
        odometry: Isometry2<f32>,
        places: impl Iterator<Item = Hypothesis>,
    ) {
        *self = Self {
            time: now,
            odometry: Some(odometry),
            searched_at: now,
            ..Self::default()
        };
        places.for_each(|hypothesis| self.insert(hypothesis));
    }

    /// The robot may also stand at one of these places: they count as much as the best so far.
    pub(super) fn or_at(&mut self, places: impl Iterator<Item = Hypothesis>) {
        self.memory = Memory::default();
        places.for_each(|hypothesis| self.insert(hypothesis));
    }

    /// Goes on to `time`, as far as odometry says; a time in the past is now.
    pub(super) fn predict(
        &mut self,
        time: Timestamp,
        odometry: Isometry2<f32>,
        is_upright: bool,
        view: &View<'_>,
    ) {
        let before = *self.odometry.get_or_insert(odometry);
        if time <= self.time {
            return;
        }
        let passed = (time - self.time).as_secs_f32();
        let movement = before.inv_mul(&odometry);
        let noise = movement_noise(&movement, passed, is_upright, view);
        for place in &mut self.hypotheses {
            place.take_if(|hypothesis| {
                let estimate = &mut hypothesis.estimate;
                estimate.predict(&movement, &noise);
                let margin = view.parameters.greatest_distance_outside;
                !estimate.is_finite()
                    || !view
                        .markings
                        .is_inside(Point2::from(estimate.mean.xy()), margin)
            });
        }
        self.close_gaps();
        self.time = time;
        self.odometry = Some(odometry);
    }

    /// Learns from an image that was taken at `time`, where odometry was that.
    pub(super) fn learn(
        &mut self,
        time: Timestamp,
        odometry: Isometry2<f32>,
        seen: Seen<'_>,
        view: &View<'_>,
    ) {
        let Some(current) = self.odometry else {
            return;
        };
        if seen.is_empty() {
            return;
        }
        // An image that is older than what is known already shows things from where the robot was.
        let to_now = current.inv_mul(&odometry);
        for hypothesis in self.hypotheses.iter_mut().flatten() {
            hypothesis.learn(&seen, &to_now, view);
        }
        self.memory.remember(time, &odometry, &seen, view);
        self.sort(view);
        self.merge(view);
        let is_lost = self
            .best()
            .is_none_or(|best| best.evidence < view.parameters.doubted_evidence);
        let since = (self.time - self.searched_at).as_secs_f32();
        if is_lost && since >= view.parameters.search_interval {
            self.searched_at = self.time;
            self.search(&current, view);
        }
    }

    /// Adds places that explain what was seen lately.
    fn search(&mut self, ground_to_start: &Isometry2<f32>, view: &View<'_>) {
        let anchor = self.best().map(|best| best.estimate.pose());
        let lines = self.memory.lines(self.time, ground_to_start, view);
        let corners = self.memory.corners(self.time, ground_to_start, view);
        for found in search::places(&lines, &corners, anchor.as_ref(), view)
            .into_iter()
            .flatten()
        {
            let is_known = self.iter().any(|known| known.is_same(&found, view));
            if !is_known {
                self.insert(found);
            }
        }
        self.sort(view);
    }

    /// Takes a free place, or that of the last one for which no more speaks.
    fn insert(&mut self, hypothesis: Hypothesis) {
        let evidence = |place: &Option<Hypothesis>| place.map_or(-1.0, |known| known.evidence);
        let least = self
            .hypotheses
            .iter_mut()
            .rev()
            .min_by(|a, b| evidence(a).total_cmp(&evidence(b)));
        if let Some(place) = least.filter(|place| evidence(place) <= hypothesis.evidence) {
            *place = Some(hypothesis);
        }
        self.close_gaps();
    }

    /// The one that counts first, and then those for which most speaks.
    fn sort(&mut self, view: &View<'_>) {
        let margin = view.parameters.switch_margin;
        let evidence = |place: &Option<Hypothesis>| place.map_or(-1.0, |known| known.evidence);
        let [first, others @ ..] = &mut self.hypotheses;
        others.sort_by(|a, b| evidence(b).total_cmp(&evidence(a)));
        if evidence(&others[0]) > evidence(first) + margin {
            std::mem::swap(first, &mut others[0]);
        }
    }

    /// Of hypotheses that have come together only the one that stands before stays.
    fn merge(&mut self, view: &View<'_>) {
        for index in 1..MOST_HYPOTHESES {
            let (before, rest) = self.hypotheses.split_at_mut(index);
            rest[0].take_if(|one| {
                before
                    .iter()
                    .flatten()
                    .any(|other| one.is_same(other, view))
            });
        }
        self.close_gaps();
    }

    fn close_gaps(&mut self) {
        self.hypotheses.sort_by_key(Option::is_none);
    }
}

impl Hypothesis {
    /// Whether both say that the robot is at the same place.
    pub(super) fn is_same(&self, other: &Self, view: &View<'_>) -> bool {
        let apart = self.estimate.mean - other.estimate.mean;
        apart.xy().norm() <= view.parameters.same_place
            && wrap(apart.z).abs() <= view.parameters.same_heading
    }

    /// `to_now` leads from the frame of what was seen to that of the robot now.
    fn learn(&mut self, seen: &Seen<'_>, to_now: &Isometry2<f32>, view: &View<'_>) {
        let parameters = view.parameters;
        let (mut total, mut explained) = (0.0, 0.0);
        let mut count = |found: Option<&Match>, length: f32| {
            total += length;
            explained += found.map_or(0.0, |found| length * quality(found, view));
        };
        let learn = |found: Option<Match>, estimate: &mut Estimate| {
            let clear = found.filter(|found| found.is_clear);
            let innovations = clear.iter().flat_map(|found| &found.innovations);
            innovations.for_each(|one| estimate.learn(one));
        };
        let Self { estimate, evidence } = self;
        if let Some(circle) = seen.circle {
            let found = view.circle(estimate, to_now * circle.position);
            count(found.as_ref(), parameters.circle_length);
            learn(found, estimate);
        }
        let straight = seen.lines.iter().filter(|line| !seen.is_piece(line, view));
        for line in straight {
            let line = Line::from(line).moved(to_now);
            let found = view.line(estimate, &line);
            count(found.as_ref(), line.length().min(parameters.full_length));
            learn(found, estimate);
        }
        if let Some(mark) = seen.mark {
            let found = view.mark(estimate, to_now * mark.position);
            count(found.as_ref(), parameters.mark_length);
            learn(found, estimate);
        }
        if total > 0.0 {
            let newest = 1.0 / parameters.evidence_images.max(1.0);
            // An image with little to see says little.
            let weight = newest * (total / parameters.full_length).min(1.0);
            *evidence += weight * (explained / total - *evidence);
        }
    }
}

/// From 1 where something is exactly where it was expected to the gate's quality there.
pub(super) fn quality(found: &Match, view: &View<'_>) -> f32 {
    let lost = 1.0 - view.parameters.gate_quality;
    1.0 - lost * found.deviation / math::powi(view.parameters.gate, 2)
}

/// Variances of x, y and heading of a movement that took so long.
fn movement_noise(
    movement: &Isometry2<f32>,
    passed: f32,
    is_upright: bool,
    view: &View<'_>,
) -> Vector3<f32> {
    let parameters = view.parameters;
    let (place, heading) = if is_upright {
        (parameters.standing_noise, parameters.standing_turn_noise)
    } else {
        (parameters.fallen_noise, parameters.fallen_turn_noise)
    };
    let way = movement.translation.vector.norm();
    let turn = movement.rotation.angle().abs();
    let planar = math::powi(parameters.way_noise, 2) * way + math::powi(place, 2) * passed;
    let turned = math::powi(parameters.turn_noise, 2) * turn
        + math::powi(parameters.heading_noise, 2) * way
        + math::powi(heading, 2) * passed;
    Vector3::new(planar, planar, turned)
}
