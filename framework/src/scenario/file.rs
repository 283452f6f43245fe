//! What a scenario's file may say.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use serde::Deserialize;

use super::assertion::Assertion;
use super::draw::Draw;
use super::durations::Durations;
use crate::error::{Error, Result};
use crate::parameters::Above;
use crate::time::Timestamp;

/// Between two calls of one client.
const SHORTEST: Duration = Duration::from_millis(1);

/// A scenario as it was written.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// For people.
    pub about: String,
    /// How long it lasts.
    pub ends: Duration,
    /// Share of the seeds that have to pass, 0 to 1.
    pub passes: f64,
    /// As it was written, for the parameters above all layers.
    text: Arc<str>,
    /// How long cycles take in virtual time, of every robot.
    pub durations: Durations,
    /// What stands over the parameters' `[hardware.<target>]`.
    pub world: toml::Table,
    /// Numbers of the world that a seed changes, with how far.
    pub random: toml::Table,
    /// The robots, where the file names them; else there is one.
    pub robots: Vec<Participant>,
    /// By time.
    pub events: Vec<Event>,
    /// What a client asks of the robot.
    pub calls: Vec<Call>,
    /// At least one.
    pub assertions: Vec<Assertion>,
}

/// One of the robots of a scenario.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Participant {
    /// How long its cycles take, above those of the scenario.
    pub durations: Durations,
    /// The key `robot` of its hardware's table, in the words of the hardware.
    pub entry: toml::Table,
    /// Numbers of the entry that a seed changes, with how far.
    pub random: toml::Table,
}

/// Something that happens to the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// The robot whose hardware is told, counted from 0.
    pub robot: usize,
    /// When.
    pub at: Timestamp,
    /// How much earlier or later a seed lets it happen.
    pub within: Duration,
    /// In the words of the hardware.
    pub deed: toml::Table,
}

/// A procedure that a client calls again and again, as one does that drives a robot.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Call {
    /// Which robot is asked, counted from 1.
    #[serde(default = "first")]
    pub robot: usize,
    /// `Control.procedures.walk`
    pub path: String,
    /// What is asked.
    #[serde(default)]
    pub argument: serde_json::Value,
    /// First, in s.
    pub from: f64,
    /// Not after, in s; absent: once.
    pub until: Option<f64>,
    /// How often, in s.
    #[serde(default = "twice_a_second")]
    pub every: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(default)]
    about: String,
    ends: f64,
    #[serde(default = "all")]
    passes: f64,
    #[serde(default, rename = "parameters")]
    _parameters: toml::Table,
    #[serde(default)]
    durations: toml::Table,
    #[serde(default)]
    world: toml::Table,
    #[serde(default)]
    random: toml::Table,
    #[serde(default, rename = "robot")]
    robots: Vec<toml::Table>,
    #[serde(default, rename = "event")]
    events: Vec<toml::Table>,
    #[serde(default, rename = "call")]
    calls: Vec<Call>,
    #[serde(default, rename = "assertion")]
    assertions: Vec<Assertion>,
}

fn twice_a_second() -> f64 {
    0.5
}

pub(super) fn first() -> usize {
    1
}

fn all() -> f64 {
    1.0
}

impl Scenario {
    /// Reads a file.
    ///
    /// # Errors
    /// Names the file, and the line and column where that is known.
    pub fn load(file: &Path) -> Result<Self> {
        let text = std::fs::read_to_string(file).map_err(Error::from);
        text.and_then(|text| Self::parse(&text))
            .map_err(|error| error.context(format!("scenario {}", file.display())))
    }

    /// Reads a text.
    ///
    /// # Errors
    /// Says what is wrong, and at which line and column where that is known.
    pub fn parse(text: &str) -> Result<Self> {
        let written: Written = toml::from_str(text)?;
        if written.assertions.is_empty() {
            return Err(Error::new(
                "there is no `[[assertion]]`: nothing could fail",
            ));
        }
        if !(0.0..=1.0).contains(&written.passes) || written.passes == 0.0 {
            return Err(Error::new(format!(
                "`passes = {}` is no share of the seeds: expected more than 0, up to 1",
                written.passes
            )));
        }
        let ends = seconds("ends", written.ends)?;
        let robots: Result<Vec<Participant>> =
            written.robots.into_iter().map(Participant::read).collect();
        let robots = robots?;
        let count = robots.len().max(1);
        let has_robot = |number: usize, what: String| {
            if (1..=count).contains(&number) {
                return Ok(());
            }
            Err(Error::new(format!(
                "{what}: there is no robot {number}; add a `[[robot]]` for each, the first is 1"
            )))
        };
        for call in &written.calls {
            has_robot(call.robot, format!("call of `{}`", call.path))?;
            call.check(ends)
                .map_err(|error| error.context(format!("call of `{}`", call.path)))?;
        }
        for assertion in &written.assertions {
            has_robot(assertion.robot, format!("assertion `{}`", assertion.what))?;
            assertion.check(ends)?;
        }
        let events: Result<Vec<Event>> = written.events.into_iter().map(Event::read).collect();
        let mut events = events?;
        if let Some(late) = events
            .iter()
            .find(|event| event.at > Timestamp::ZERO + ends)
        {
            return Err(Error::new(format!(
                "the event at {} s comes after the end",
                (late.at - Timestamp::ZERO).as_secs_f64()
            )));
        }
        for event in &events {
            let at = (event.at - Timestamp::ZERO).as_secs_f64();
            has_robot(event.robot + 1, format!("the event at {at} s"))?;
            if event.deed.is_empty() {
                return Err(Error::new(format!(
                    "the event at {at} s does not say what happens: add a key that the hardware understands"
                )));
            }
            let within = event.within.as_secs_f64();
            if within > at || at + within > ends.as_secs_f64() {
                return Err(Error::new(format!(
                    "the event at {at} s may be moved by {within} s, beyond the start or the end"
                )));
            }
        }
        events.sort_by_key(|event| event.at);
        Ok(Self {
            about: written.about,
            ends,
            passes: written.passes,
            text: text.into(),
            durations: Durations::read(&written.durations)?,
            world: written.world,
            random: written.random,
            robots,
            events,
            calls: written.calls,
            assertions: written.assertions,
        })
    }

    /// The hardware's table for a seed, made of the one that the parameters give.
    ///
    /// # Errors
    /// Names what is drawn and not there.
    pub fn world(&self, mut table: toml::Table, seed: u64) -> Result<toml::Table> {
        overlay(&mut table, &self.world);
        Draw::new(seed)
            .change(&mut table, &self.random)
            .map_err(|error| error.context("`random`"))?;
        Ok(table)
    }

    /// As [`Self::world`], of one of the robots, counted from 0.
    ///
    /// # Errors
    /// Names what is drawn and not there.
    pub fn world_of(&self, robot: usize, table: toml::Table, seed: u64) -> Result<toml::Table> {
        let mut table = self.world(table, seed)?;
        if let Some(participant) = self.robots.get(robot) {
            let mut entry = participant.entry.clone();
            // Robots that begin alike do not end alike.
            Draw::new(seed.wrapping_add((robot as u64 + 1) << 32))
                .change(&mut entry, &participant.random)
                .map_err(|error| error.context(format!("`random` of robot {}", robot + 1)))?;
            table.insert(ENTRY.to_owned(), entry.into());
        }
        Ok(table)
    }

    /// What happens with a seed, by time: events that have `within` are moved by up to as much.
    pub fn events(&self, seed: u64) -> Vec<Event> {
        let mut draw = Draw::new(seed.wrapping_add(EVENTS));
        let moved = |event: &Event| {
            let later = event.within.mul_f64(2.0 * draw.share());
            let earliest = (event.at - Timestamp::ZERO).saturating_sub(event.within);
            let at = Timestamp::ZERO + earliest + later;
            Event {
                at,
                ..event.clone()
            }
        };
        let mut events: Vec<_> = self.events.iter().map(moved).collect();
        events.sort_by_key(|event| event.at);
        events
    }

    /// How long cycles of one of the robots take, counted from 0.
    pub fn durations_of(&self, robot: usize) -> Durations {
        let own = self.robots.get(robot);
        own.map_or_else(
            || self.durations.clone(),
            |own| self.durations.under(&own.durations),
        )
    }

    /// Parameters of one of the robots, counted from 0, above all layers: those that the scenario, which stands in this file,
    /// has for all, and its own.
    pub fn parameters_of(&self, robot: usize, file: &Path) -> Vec<Above> {
        let paths = ["parameters".to_owned(), format!("robot.{robot}.parameters")];
        let parts = paths.into_iter().map(|path| Above::Part {
            file: file.display().to_string(),
            text: self.text.clone(),
            path,
        });
        parts.collect()
    }

    /// How many robots there are.
    pub fn robot_count(&self) -> usize {
        self.robots.len().max(1)
    }
}

/// Times of events do not follow from the numbers of the world.
const EVENTS: u64 = 1 << 48;

/// Where a robot's hardware finds its `[[robot]]`.
const ENTRY: &str = "robot";

impl Participant {
    fn read(mut table: toml::Table) -> Result<Self> {
        let mut take = |key: &str| match table.remove(key) {
            None => Ok(toml::Table::new()),
            Some(toml::Value::Table(inner)) => Ok(inner),
            Some(other) => Err(Error::new(format!(
                "`{key}` of a `[[robot]]` is a table, not {other}"
            ))),
        };
        // They are a layer, and read where the layers are.
        take("parameters")?;
        let durations = Durations::read(&take("durations")?)?;
        let random = take("random")?;
        Ok(Self {
            durations,
            entry: table,
            random,
        })
    }
}

impl Call {
    /// A time that never comes would be a call that is never made.
    fn check(&self, ends: Duration) -> Result<()> {
        let _times = self.times()?;
        for (key, number) in [("from", Some(self.from)), ("until", self.until)] {
            within_run(key, number, ends)?;
        }
        in_order(self.from, "until", self.until)
    }

    /// When it is made.
    pub(super) fn times(&self) -> Result<impl Iterator<Item = Timestamp> + use<>> {
        let from = Timestamp::ZERO + seconds("from", self.from)?;
        let until = match self.until {
            Some(until) => Timestamp::ZERO + seconds("until", until)?,
            None => from,
        };
        let every = seconds("every", self.every)?;
        if every < SHORTEST {
            let every = self.every;
            return Err(Error::new(format!(
                "`every = {every}`: a call comes at most once in a millisecond"
            )));
        }
        let times = std::iter::successors(Some(from), move |at| Some(*at + every));
        Ok(times.take_while(move |at| *at <= until))
    }
}

/// A number, however it is written.
fn number(written: &toml::Value) -> Option<f64> {
    match written {
        toml::Value::Float(number) => Some(*number),
        #[expect(clippy::cast_precision_loss, reason = "seconds of a scenario are few")]
        toml::Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
}

impl Event {
    fn read(mut table: toml::Table) -> Result<Self> {
        let at = table.remove("at").as_ref().and_then(number);
        let at = at.ok_or_else(|| Error::new("an `[[event]]` needs `at = SECONDS`"))?;
        let within = match table.remove("within") {
            None => Duration::ZERO,
            Some(written) => {
                let within = number(&written).ok_or_else(|| {
                    Error::new(format!(
                        "`within = {written}` of an `[[event]]` is no number of seconds: expected e.g. 0.5"
                    ))
                })?;
                seconds("within", within)?
            }
        };
        let robot = match table.remove("robot") {
            None => first(),
            Some(written) => {
                let number = written
                    .as_integer()
                    .and_then(|number| usize::try_from(number).ok());
                number.filter(|number| *number > 0).ok_or_else(|| {
                    Error::new(format!(
                        "`robot = {written}` of an `[[event]]` is no number of a robot: the first is 1"
                    ))
                })?
            }
        };
        Ok(Self {
            robot: robot - 1,
            at: Timestamp::ZERO + seconds("at", at)?,
            within,
            deed: table,
        })
    }
}

pub(super) fn seconds(key: &str, number: f64) -> Result<Duration> {
    Duration::try_from_secs_f64(number)
        .map_err(|_| Error::new(format!("`{key} = {number}` is no number of seconds")))
}

/// Nothing comes after the end.
pub(super) fn within_run(key: &str, number: Option<f64>, ends: Duration) -> Result<()> {
    match number {
        Some(number) if seconds(key, number)? > ends => Err(Error::new(format!(
            "`{key} = {number}` comes after the end"
        ))),
        _ => Ok(()),
    }
}

/// What ends before it begins never is.
pub(super) fn in_order(from: f64, key: &str, later: Option<f64>) -> Result<()> {
    match later {
        Some(later) if later < from => Err(Error::new(format!(
            "`{key} = {later}` comes before `from = {from}`"
        ))),
        _ => Ok(()),
    }
}

/// Puts a later table over an earlier one: tables merge, everything else is replaced.
fn overlay(table: &mut toml::Table, later: &toml::Table) {
    for (key, value) in later {
        match (table.get_mut(key), value) {
            (Some(toml::Value::Table(table)), toml::Value::Table(later)) => overlay(table, later),
            _ => {
                table.insert(key.clone(), value.clone());
            }
        }
    }
}

#[cfg(test)]
mod tests;
