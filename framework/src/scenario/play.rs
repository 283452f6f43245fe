//! Plays a scenario once.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::assertion::Assertion;
use super::audience::Audience;
use super::ensemble::{Ensemble, Lives, together};
use super::file::{Call, Event, Scenario};
use super::judge::{Judge, Verdict};
use super::pace::{Callers, Pace, watched};
use super::report::Played;
use crate::digest::Digest;
use crate::driver::Lockstep;
use crate::error::{Error, Result};
use crate::guarded::contain;
use crate::hardware::Hardware;
use crate::launch::{Listening, Served, start_server};
use crate::parameters::Given;
use crate::procedure::{CallAny, PendingAny};
use crate::recorded::{Counts, Recording};
use crate::reflect::Shape;
use crate::robot::Robot;
use crate::stop::Stop;
use crate::time::Timestamp;
use crate::world::{self, Named};

/// One robot that was created for this scenario and this seed.
pub(crate) struct Cast<H, P> {
    /// Its place in the world.
    pub(crate) hardware: Arc<H>,
    /// The robot.
    pub(crate) robot: Robot<P>,
    /// What sees its cycles.
    pub(crate) recording: Option<Recording>,
}

/// How a scenario is played; nothing of it changes what happens.
pub(crate) struct Manner<'run> {
    /// On how many threads several robots live.
    pub(crate) threads: usize,
    /// Whether a digest of each robot is told.
    pub(crate) digests: bool,
    /// Ends all of it; robots that end by themselves have their own.
    pub(crate) stop: &'run Stop,
    /// Who serves the robots to clients, if any may come, and where each is served. What clients do is no part of the scenario.
    pub(crate) audience: Option<(&'run Audience, Vec<Listening>)>,
}

/// How far one robot goes before anybody looks whether the run is to end. Several go as far as their world.
const STRETCH: Duration = Duration::from_secs(1);

/// The same where clients watch, in whose time it goes.
const WATCHED_STRETCH: Duration = Duration::from_millis(12);

/// Lets the robots live through it. One that stops is told of; the others go on. Where somebody ends the run, that is told as well,
/// and what was seen until then: it may have taken long. The same where somebody chooses another scenario, whose file comes with it.
///
/// # Errors
/// Where the hardware does not understand an event.
pub(crate) fn play<H: Hardware + 'static, P: Send>(
    scenario: &Scenario,
    seed: u64,
    casts: &mut [Cast<H, P>],
    manner: Manner<'_>,
) -> Result<(Played, Option<PathBuf>)> {
    let begun = Instant::now();
    let mut hardwares: Vec<&dyn Hardware> = Vec::new();
    let mut actors = Vec::new();
    let (audience, seats) = manner.audience.unzip();
    let mut seats = seats.unwrap_or_default().into_iter();
    let (callers, watched) = audience.map(|audience| watched(&audience.file)).unzip();
    // Servers end when the robots have lived.
    let mut served = Vec::new();
    for (number, cast) in (1..).zip(casts.iter_mut()) {
        let hardware: &dyn Hardware = cast.hardware.as_ref();
        let recording = &mut cast.recording;
        let recorded = (recording.as_ref()).map_or_else(Vec::new, Recording::shared_counts);
        let procedures = share_procedures(&mut cast.robot);
        let mut lockstep = beginning(&mut cast.robot, hardware, scenario, number)?
            .observed(|instance| recording.as_mut()?.observer(instance));
        if let Some(seat) = audience.zip(seats.next()) {
            let mut procedures = world::procedures(&cast.hardware);
            procedures.extend(callers.iter().flat_map(Callers::procedures));
            let tells = (procedures, recorded);
            served.extend(seated(&mut lockstep, tells, seat, manner.stop)?);
        }
        hardwares.push(hardware);
        actors.push(Mutex::new(Actor {
            is_alone: scenario.robot_count() == 1,
            lockstep,
            hardware,
            procedures,
            judge: Some(Judge::new(&scenario.assertions, number)),
            digest: manner.digests.then(Digest::new),
            stopped: None,
        }));
    }
    let (lasted, end, verdicts) = together(&actors, manner.threads, |ensemble| {
        let pace = watched.map_or(Pace::Free, Pace::Watched);
        let end = match live_through(scenario, seed, &hardwares, ensemble, (pace, manner.stop)) {
            Err(error) if error.is_stopped() && manner.stop.is_requested() => End::Stopped,
            lived => lived?,
        };
        let now = |actor: &Actor<'_, P>| actor.lockstep.robot().clock.now();
        let lasted = ensemble.all().map(|actor| now(&actor)).max();
        let verdicts = ensemble
            .all()
            .map(|mut actor| actor.judge.take().map(Judge::verdicts).unwrap_or_default());
        let lasted = lasted.map_or(0.0, |now| (now - Timestamp::ZERO).as_secs_f64());
        Ok::<_, Error>((lasted, end, in_order(scenario, verdicts.collect())))
    })?;
    drop(served);
    let mut digests = Vec::new();
    let mut stopped: Vec<_> = end.early(lasted).into_iter().collect();
    for (number, actor) in (1..).zip(actors) {
        let actor = actor.into_inner().unwrap_or_else(PoisonError::into_inner);
        digests.extend(actor.digest.map(|digest| digest.to_string()));
        stopped.extend(actor.stopped.map(|why| match hardwares.len() {
            1 => why,
            _ => format!("robot {number}: {why}"),
        }));
        // What it was about to do is abandoned, as at every end.
        drop(actor.lockstep);
    }
    let instances = casts.iter().flat_map(|cast| &cast.robot.instances);
    let failures = instances.map(|instance| instance.report().counts.failures);
    let played = Played {
        seed,
        passed: stopped.is_empty() && verdicts.iter().all(|verdict| verdict.passed),
        stopped: (!stopped.is_empty()).then(|| stopped.join("; ")),
        failures: failures.sum(),
        digests,
        recordings: Vec::new(),
        assertions: verdicts,
        lasted,
        real_time_factor: lasted / begun.elapsed().as_secs_f64().max(1e-9),
    };
    Ok((played, end.chosen()))
}

/// The robot with this number, counted from 1, whose cycles take as long as the scenario says.
fn beginning<'run, P>(
    robot: &'run mut Robot<P>,
    hardware: &'run dyn Hardware,
    scenario: &Scenario,
    number: usize,
) -> Result<Lockstep<'run, P>> {
    subscribe(robot, &scenario.assertions, number);
    let durations = scenario.durations_of(number - 1);
    let instances = robot.instances.iter();
    let names: Vec<_> = instances
        .map(|instance| instance.description().name)
        .collect();
    durations.check(&names)?;
    Ok(Lockstep::new(robot, hardware).lasting(|instance| durations.of(instance)))
}

/// Subscribes to the additional outputs of which something is asserted: nobody else may, and then they are not computed.
fn subscribe<P>(robot: &Robot<P>, assertions: &[Assertion], number: usize) {
    let own = assertions.iter().filter(|one| one.robot == number);
    let additional = own.filter_map(|one| one.value.split_once(".additional_outputs."));
    for (instance, path) in additional {
        let mut access = robot.access.iter();
        let Some(access) = access.find(|access| access.instance == instance) else {
            continue;
        };
        let names = access.subscriptions.names().iter();
        let known = names.filter(|name| {
            let below = path.strip_prefix(**name);
            below.is_some_and(|below| below.is_empty() || below.starts_with('.'))
        });
        // Names of outputs may have dots themselves, so the longest is the output.
        if let Some(name) = known.max_by_key(|name| name.len()) {
            access.subscriptions.subscribe(name);
        }
    }
}

/// How a scenario ended.
enum End {
    AsWritten,
    /// Somebody ended the run.
    Stopped,
    /// Somebody chose the scenario in this file in place of it.
    Another(PathBuf),
}

impl End {
    /// The scenario that is next.
    fn chosen(self) -> Option<PathBuf> {
        match self {
            Self::Another(file) => Some(file),
            Self::AsWritten | Self::Stopped => None,
        }
    }

    /// What is told where it was early, after so many seconds.
    fn early(&self, lasted: f64) -> Option<String> {
        let who = match self {
            Self::AsWritten => return None,
            Self::Stopped => "somebody ended it".to_owned(),
            Self::Another(file) => format!("somebody chose {}", file.display()),
        };
        Some(format!(
            "{who} after {lasted:.1} s; what follows was seen until then"
        ))
    }
}

/// The server of one robot, with what clients may do to its world, and what became of its recording.
fn seated<P>(
    lockstep: &mut Lockstep<'_, P>,
    (procedures, recorded): (Vec<Named>, Vec<(String, Arc<Counts>)>),
    (audience, listening): (&Audience, Listening),
    stop: &Stop,
) -> Result<Option<Box<dyn Served>>> {
    let rearm = lockstep.rearming();
    let mut link = lockstep.robot_mut().link(stop, rearm);
    link.procedures = procedures;
    link.recorded = recorded;
    start_server(link, listening, audience.serve)
}

/// A robot on its way through the scenario.
struct Actor<'run, P> {
    /// No other robot lives in its world.
    is_alone: bool,
    lockstep: Lockstep<'run, P>,
    hardware: &'run dyn Hardware,
    /// What its nodes answer, by path.
    procedures: Vec<(String, Arc<dyn CallAny>)>,
    /// There until the end.
    judge: Option<Judge<'run>>,
    digest: Option<Digest>,
    /// Why it does not go on.
    stopped: Option<String>,
}

impl<P: Send> Lives for Actor<'_, P> {
    fn live(&mut self, until: Timestamp) {
        if self.stopped.is_some() {
            return;
        }
        let Self {
            is_alone,
            lockstep,
            hardware,
            judge,
            digest,
            stopped,
            procedures: _,
        } = self;
        let clock = lockstep.robot().clock.clone();
        lockstep.world_goes_on();
        let lived = contain("a robot's life", || {
            let mut undigested = Ok(());
            lockstep.run_until(until, |instance| {
                if let Some(judge) = judge {
                    judge.look(clock.now(), instance, || hardware.truth());
                }
                if let Some(digest) = digest
                    && let Err(error) = digest.add_cycle(instance)
                {
                    undigested = Err(Error::new(format!("no digest: {error}")));
                }
            })?;
            undigested
        });
        *stopped = match lived {
            Err(error) => Some(error.to_string()),
            // There was no more to do.
            Ok(()) if clock.now() < until => early_end(lockstep, *is_alone),
            Ok(()) => None,
        };
    }
}

/// Why a robot did not come as far as it was to; none that shares its world: that goes on once all have come as far as it.
fn early_end<P>(lockstep: &Lockstep<'_, P>, is_alone: bool) -> Option<String> {
    let what = match (lockstep.ended_itself(), is_alone) {
        (true, _) => "it ended by itself",
        (false, true) => "its world ended",
        (false, false) => return None,
    };
    let at = (lockstep.robot().clock.now() - Timestamp::ZERO).as_secs_f64();
    Some(format!("{what} at {at:.3} s"))
}

fn live_through<P: Send>(
    scenario: &Scenario,
    seed: u64,
    hardwares: &[&dyn Hardware],
    ensemble: &Ensemble<'_, Actor<'_, P>>,
    (mut pace, stop): (Pace, &Stop),
) -> Result<End> {
    let stretch = match pace {
        Pace::Watched(_) => WATCHED_STRETCH,
        Pace::Free => STRETCH,
    };
    let events = scenario.events(seed);
    let mut world = Timestamp::ZERO;
    for (until, deed) in deeds(scenario, &events)? {
        loop {
            stop.check()?;
            ensemble.live(world.min(until));
            if world >= until {
                break;
            }
            world = match hardwares {
                [first, _, ..] => contain("Hardware::advance", || first.advance())?,
                _ => until.min(world + stretch),
            };
            if let ControlFlow::Break(file) = pace.wait_for(world, stop)? {
                return Ok(End::Another(file));
            }
        }
        if ensemble.all().all(|actor| actor.stopped.is_some()) {
            return Ok(End::AsWritten);
        }
        let at = (until - Timestamp::ZERO).as_secs_f64();
        let with_time = |error: Error| error.context(format!("at {at:.3} s"));
        let done = match deed {
            Deed::Event(event) => {
                let disturb = || Ok(hardwares[event.robot].disturb(&event.deed));
                contain("Hardware::disturb", disturb).unwrap_or_else(|panicked| {
                    // As where it panics in the robot's life.
                    let why = with_time(panicked).to_string();
                    ensemble.actor(event.robot).stopped.get_or_insert(why);
                    Ok(())
                })
            }
            Deed::Call(asked) => call(&ensemble.actor(asked.robot - 1).procedures, asked),
            Deed::End => Ok(()),
        };
        done.map_err(with_time)?;
    }
    Ok(End::AsWritten)
}

/// As the file has them, from those of each robot.
fn in_order(scenario: &Scenario, of_robots: Vec<Vec<Verdict>>) -> Vec<Verdict> {
    let mut of_robots: Vec<_> = of_robots.into_iter().map(Vec::into_iter).collect();
    let assertions = scenario.assertions.iter();
    assertions
        .filter_map(|assertion| of_robots.get_mut(assertion.robot - 1)?.next())
        .collect()
}

/// What is done between two stretches of a life.
enum Deed<'a> {
    Event(&'a Event),
    Call(&'a Call),
    End,
}

/// By time; what happens to the world comes before what clients ask.
fn deeds<'a>(scenario: &'a Scenario, events: &'a [Event]) -> Result<Vec<(Timestamp, Deed<'a>)>> {
    let end = Timestamp::ZERO + scenario.ends;
    let events = events.iter();
    let mut deeds: Vec<_> = events.map(|event| (event.at, Deed::Event(event))).collect();
    for call in &scenario.calls {
        let times = call.times()?.take_while(|at| *at <= end);
        deeds.extend(times.map(|at| (at, Deed::Call(call))));
    }
    deeds.sort_by_key(|(at, _)| *at);
    deeds.push((end, Deed::End));
    Ok(deeds)
}

/// One procedure for the scenario and for clients.
struct Shared(Arc<dyn CallAny>);

impl CallAny for Shared {
    fn types(&self) -> (&'static str, &'static str) {
        self.0.types()
    }

    fn shapes(&self) -> Option<(Shape, Shape)> {
        self.0.shapes()
    }

    fn call_any(&self, request: &Given<'_>) -> Result<Box<dyn PendingAny>> {
        self.0.call_any(request)
    }
}

/// Procedures by path; a server may have those of the robot nevertheless.
fn share_procedures<P>(robot: &mut Robot<P>) -> Vec<(String, Arc<dyn CallAny>)> {
    let mut shared = Vec::new();
    for access in &mut robot.access {
        let instance = access.instance;
        let taken = std::mem::take(&mut access.procedures).into_iter();
        let share = |(name, procedure): (&'static str, Box<dyn CallAny>)| {
            let procedure: Arc<dyn CallAny> = procedure.into();
            shared.push((format!("{instance}.procedures.{name}"), procedure.clone()));
            (name, Box::new(Shared(procedure)) as Box<dyn CallAny>)
        };
        access.procedures = taken.map(share).collect();
    }
    shared
}

/// As a client would that does not wait for the answer.
fn call(procedures: &[(String, Arc<dyn CallAny>)], asked: &Call) -> Result<()> {
    let found = procedures.iter().find(|(path, _)| *path == asked.path);
    let (_, procedure) =
        found.ok_or_else(|| Error::new(format!("there is no procedure `{}`", asked.path)))?;
    procedure
        .call_any(&Given::from(&asked.argument))
        .map(drop)
        .map_err(|error| error.context(format!("`{}`", asked.path)))
}
