//! Plays a scenario once.

use std::sync::Arc;
use std::time::Instant;

use super::file::{Call, Scenario};
use super::judge::Judge;
use super::report::Played;
use crate::driver::Lockstep;
use crate::error::{Error, Result};
use crate::hardware::Hardware;
use crate::robot::Robot;
use crate::time::Timestamp;

/// Lets a robot that was created for this scenario and this seed live through it.
///
/// # Errors
/// Where the hardware does not understand an event.
pub(crate) fn play<H: Hardware, P>(
    scenario: &Scenario,
    seed: u64,
    hardware: &Arc<H>,
    robot: &mut Robot<P>,
) -> Result<Played> {
    let begun = Instant::now();
    let mut judge = Judge::new(&scenario.assertions);
    let mut paused = None;
    let mut stopped = None;
    let clock = robot.clock.clone();
    for (until, deed) in deeds(scenario)? {
        let lockstep = Lockstep::new(robot, hardware.as_ref());
        let mut lockstep = match paused.take() {
            Some(paused) => lockstep.after(paused),
            None => lockstep,
        };
        let lived = lockstep.run_until(until, |instance| {
            judge.look(clock.now(), instance, || hardware.truth());
        });
        paused = Some(lockstep.pause());
        if let Err(error) = lived {
            stopped = Some(error.to_string());
            break;
        }
        let done = match deed {
            Deed::Event(deed) => hardware.disturb(deed),
            Deed::Call(asked) => call(robot, asked),
            Deed::End => Ok(()),
        };
        let at = (until - Timestamp::ZERO).as_secs_f64();
        done.map_err(|error| error.context(format!("at {at:.3} s")))?;
    }
    let assertions = judge.verdicts();
    let reports = robot.instances.iter().map(|instance| instance.report());
    let lasted = (clock.now() - Timestamp::ZERO).as_secs_f64();
    Ok(Played {
        seed,
        passed: stopped.is_none() && assertions.iter().all(|verdict| verdict.passed),
        stopped,
        failures: reports.map(|report| report.counts.failures).sum(),
        assertions,
        lasted,
        real_time_factor: lasted / begun.elapsed().as_secs_f64().max(1e-9),
    })
}

/// What is done between two stretches of a life.
enum Deed<'a> {
    Event(&'a toml::Table),
    Call(&'a Call),
    End,
}

/// By time; what happens to the world comes before what clients ask.
fn deeds(scenario: &Scenario) -> Result<Vec<(Timestamp, Deed<'_>)>> {
    let end = Timestamp::ZERO + scenario.ends;
    let events = scenario.events.iter();
    let mut deeds: Vec<_> = events
        .map(|event| (event.at, Deed::Event(&event.deed)))
        .collect();
    for call in &scenario.calls {
        let times = call.times()?.take_while(|at| *at <= end);
        deeds.extend(times.map(|at| (at, Deed::Call(call))));
    }
    deeds.sort_by_key(|(at, _)| *at);
    deeds.push((end, Deed::End));
    Ok(deeds)
}

/// As a client would that does not wait for the answer.
fn call<P>(robot: &mut Robot<P>, asked: &Call) -> Result<()> {
    let unknown = || Error::new(format!("there is no procedure `{}`", asked.path));
    let (instance, name) = asked.path.split_once(".procedures.").ok_or_else(unknown)?;
    let procedures = &robot.access(instance)?.procedures;
    let (_, procedure) = procedures
        .iter()
        .find(|(known, _)| *known == name)
        .ok_or_else(unknown)?;
    let mut argument = <dyn erased_serde::Deserializer<'_>>::erase(&asked.argument);
    procedure
        .call_any(&mut argument)
        .map(drop)
        .map_err(|error| error.context(format!("`{}`", asked.path)))
}
