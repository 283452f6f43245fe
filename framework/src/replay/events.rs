//! What happened to the cycles of a recording: which are missing, were not finished, began anew, or had new parameters.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Player, Players};
use crate::Reflect;
use crate::recorded::PARAMETERS;
use crate::time::Timestamp;

/// More are no picture, and slow to send.
pub const MOST_EVENTS: usize = 1000;

/// What happened to cycles of one instance.
#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Happened {
    pub instance: String,
    /// Seconds of the run: the recorded cycle before, or the one that it is about.
    pub from: f64,
    /// The recorded cycle behind, or the same.
    pub to: f64,
    pub what: What,
}

/// Kinds of [`Happened`].
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Reflect, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum What {
    /// The recording does not have the cycles between.
    Missing,
    /// It failed or was abandoned.
    Unfinished,
    /// It was the first after a restart.
    Restarted,
    /// It was the first, of any instance, with these parameters: somebody changed them while the robot ran.
    Parameters,
}

/// Of all instances, in order of time.
pub(super) fn events(players: &Players<'_>) -> Vec<Happened> {
    let mut events = Vec::new();
    for player in &players.players {
        let mut tell = |from: Timestamp, to: Timestamp, what| {
            let [from, to] = [from, to].map(|at| at.as_nanos() as f64 / 1e9);
            events.push(Happened {
                instance: player.instance.to_owned(),
                from,
                to,
                what,
            });
        };
        let mut last = None;
        for frame in player.frames {
            let head = frame.head;
            if let Some((number, start)) = last
                && number + 1 < head.number
            {
                tell(start, head.start, What::Missing);
            }
            if head.restarted {
                tell(head.start, head.start, What::Restarted);
            }
            if !frame.is_finished() {
                tell(head.start, head.start, What::Unfinished);
            }
            last = Some((head.number, head.start));
        }
    }
    events.extend(changes(players));
    events.sort_by(|one, other| one.from.total_cmp(&other.from));
    events.truncate(MOST_EVENTS);
    events
}

/// The first cycle with each further version of the parameters.
fn changes(players: &Players<'_>) -> impl Iterator<Item = Happened> {
    let mut first_seen: BTreeMap<u64, (Timestamp, &'static str)> = BTreeMap::new();
    for player in players
        .players
        .iter()
        .filter(|player| reads_parameters(player))
    {
        for (position, frame) in player.frames.iter().enumerate() {
            let Some(version) = player.parameters_version(position) else {
                continue;
            };
            let start = frame.head.start;
            let seen = first_seen
                .entry(version)
                .or_insert((start, player.instance));
            if start < seen.0 {
                *seen = (start, player.instance);
            }
        }
    }
    // The recording began with the first one.
    first_seen.into_values().skip(1).map(|(start, instance)| {
        let at = start.as_nanos() as f64 / 1e9;
        Happened {
            instance: instance.to_owned(),
            from: at,
            to: at,
            what: What::Parameters,
        }
    })
}

/// Frames of other instances begin with something else.
pub(super) fn reads_parameters(player: &Player<'_>) -> bool {
    let mut reads = false;
    if let Some(replay) = player.replay() {
        let instance = replay.instance();
        instance.references(&mut |reference| reads |= reference.instance == PARAMETERS);
    }
    reads
}
