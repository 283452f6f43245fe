//! The recorded instances as a server has those of a running robot.

use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use super::TIMELINE;
use crate::cycler::{Counters, InstanceDescription, Kind, Record};
use crate::error::{Error, Result};
use crate::guarded::OnFailure;
use crate::injection::Inject;
use crate::link::InstanceLink;
use crate::parameters::Given;
use crate::procedure::CallAny;
use crate::replay::{Chunks, Player, Players};
use crate::robot::Access;
use crate::scheduling::Scheduling;
use crate::subscriptions::Subscriptions;
use crate::tap::Reports;

/// An instance that is left out, and why.
pub(super) struct Unfit {
    instance: &'static str,
    reason: String,
}

/// Nothing of a recording can be replaced.
struct Recorded;

/// What a server needs of each instance that has a cycle which fits this robot; it is at the first such cycle. The others are
/// dropped.
pub(super) fn fitting(players: &mut Players<'_>) -> (Vec<InstanceLink>, Vec<Unfit>) {
    let (mut instances, mut unfit, mut fits) = (Vec::new(), Vec::new(), Vec::new());
    for (player, chunks) in players.each() {
        let instance = player.instance;
        let mut leave_out = |reason| unfit.push(Unfit { instance, reason });
        let link = match player.frames.is_empty() {
            false => link(player, chunks).map_err(|error| leave_out(error.to_string())),
            true => {
                // One that was not to be recorded is no news.
                if !player.is_known {
                    leave_out("the recording has no such instance".to_owned());
                }
                Err(())
            }
        };
        fits.push(link.is_ok());
        instances.extend(link);
    }
    let mut fits = fits.into_iter();
    players.players.retain(|_| fits.next().unwrap_or_default());
    (instances, unfit)
}

/// Why there is nothing to show.
pub(super) fn none(unfit: &[Unfit]) -> Error {
    if unfit.is_empty() {
        return Error::new(
            "the recording has no cycles: nothing was to be recorded, or it broke off before its first chunk",
        );
    }
    let reasons = unfit.iter().map(|one| format!("\n  {one}"));
    let reasons: String = reasons.collect();
    Error::new(format!(
        "the recording has no cycle that this robot can replay: build the robot that it was made with{reasons}"
    ))
}

/// The instance that answers these procedures.
pub(super) fn timeline(procedures: Vec<(&'static str, Box<dyn CallAny>)>) -> InstanceLink {
    let mut access = access(TIMELINE, Subscriptions::new(&[]));
    access.procedures = procedures;
    InstanceLink {
        description: description(),
        nodes: Vec::new(),
        counters: Arc::new(Counters::default()),
        taps: Vec::new(),
        reports: Reports::silent(),
        access,
    }
}

fn link(player: &mut Player<'_>, chunks: Chunks<'_>) -> Result<InstanceLink> {
    let name = player.instance;
    let first = player.load_at(0, chunks);
    let others = 1..player.frames.len();
    first.or_else(|why| {
        let mut others = others.map(|position| player.load_at(position, chunks));
        others.find(Result::is_ok).unwrap_or(Err(why))
    })?;
    let replay = player.replay_mut()?;
    let subscriptions = replay.subscriptions().clone();
    let instance = replay.instance_mut();
    let (taps, reports) = instance.tap(&subscriptions);
    let nodes = instance.report().nodes;
    Ok(InstanceLink {
        description: *instance.description(),
        nodes: nodes.iter().map(|node| node.node).collect(),
        counters: instance.counters().clone(),
        taps,
        reports,
        access: access(name, subscriptions),
    })
}

fn access(instance: &'static str, subscriptions: Subscriptions) -> Access {
    Access {
        instance,
        subscriptions,
        injector: Box::new(Recorded),
        procedures: Vec::new(),
    }
}

fn description() -> InstanceDescription {
    InstanceDescription {
        name: TIMELINE,
        cycler: TIMELINE,
        kind: Kind::RealTime,
        on_failure: OnFailure::Stop,
        deadline: None,
        pending_timeout: Duration::from_secs(1),
        watchdog: Duration::from_secs(1),
        history: Duration::from_secs(1),
        lockstep_duration: None,
        scheduling: Scheduling::BY_THE_SYSTEM,
        record: Record::Off,
    }
}

impl Inject for Recorded {
    fn inject(&mut self, _: &str, _: &Given<'_>) -> Result<()> {
        Err(Error::new(
            "this is a recording: nothing of it can be replaced",
        ))
    }

    fn release(&mut self, _: &str) -> Result<()> {
        Ok(())
    }

    fn release_all(&mut self) {}
}

impl fmt::Display for Unfit {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { instance, reason } = self;
        write!(out, "`{instance}` is not shown: {reason}")
    }
}
