//! A recording that clients see as a running robot: its cycles run again at any speed, forwards and backwards.
//!
//! All instances of the recording are there under their names, with their main outputs. One more, [`TIMELINE`], answers
//! the procedure [`PROCEDURE`], which moves the time of the recording and says where it is.

mod instances;
mod parameters;
mod said;

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::events::{Happened, events};
use super::{Players, Ran};
use crate::Reflect;
use crate::clock::Clock;
use crate::data::ParameterData;
use crate::error::{Error, Result};
use crate::link::Link;
use crate::logs::{Again, again};
use crate::parameters::LiveParameters;
use crate::procedure::{Answerer, procedure};
use crate::rearm::Rearm;
use crate::report::tell;
use crate::stop::Stop;
use crate::time::Timestamp;
use parameters::RecordedParameters;
use said::Said;

/// The instance that clients call.
pub const TIMELINE: &str = "Replay";

/// Its procedure: `Replay.procedures.timeline`.
pub const PROCEDURE: &str = "timeline";

/// How long the replay sleeps between two looks at the time and at its clients.
const PAUSE: Duration = Duration::from_millis(2);

/// So long clients wait for cycles that take more time than they have; then time waits.
const LONGEST: Duration = Duration::from_millis(20);

/// While time stands still, the cycles that it stands at run again so often: for clients that come then.
const SHOWN_EVERY: Duration = Duration::from_millis(100);

/// No speed is greater, in either direction.
const FASTEST: f64 = 1000.0;

/// What a client asks for; what is left out stays as it is.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Reflect, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Move {
    /// Whether time goes on.
    pub play: Option<bool>,
    /// Seconds of the recording per second; negative: backwards.
    pub speed: Option<f64>,
    /// Seconds of the run to go to.
    pub time: Option<f64>,
    /// The cycle of `instance` to go to.
    pub cycle: Option<u64>,
    /// So many cycles on, or back, of `instance`, or of all; time then stands still.
    pub step: Option<i64>,
    /// Whose cycles are meant.
    pub instance: Option<String>,
    /// Whether the answer is to have `events`.
    pub events: bool,
}

/// Where the replay is.
#[derive(Clone, Debug, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Place {
    /// Seconds of the run.
    pub time: f64,
    /// Of the first and of the last recorded cycle.
    pub begins: f64,
    pub ends: f64,
    pub is_playing: bool,
    pub speed: f64,
    pub instances: Vec<InstancePlace>,
    /// What happened to the recorded cycles, in order of time; no more than [`super::MOST_EVENTS`]. Where it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub events: Option<Vec<Happened>>,
}

/// Where one instance is.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Reflect, Serialize)]
pub struct InstancePlace {
    pub instance: String,
    /// The cycle that is shown; `None` before its first one.
    pub cycle: Option<u64>,
    /// Recorded cycles.
    pub frames: usize,
    /// Cycles between the first and the last recorded one that the recording does not have.
    pub missing: u64,
}

/// One recorded cycle.
#[derive(Clone, Copy, Debug)]
struct Moment {
    at: Timestamp,
    /// Among the players.
    instance: usize,
    position: usize,
}

/// The replay of all instances.
pub struct Timeline<'r> {
    players: Players<'r>,
    /// In order of time.
    moments: Vec<Moment>,
    /// How many of them have been.
    passed: usize,
    /// Nanoseconds of the run.
    now: f64,
    /// That of the link, at the same time.
    clock: Clock,
    is_playing: bool,
    speed: f64,
    moves: Answerer<Move, Place>,
    parameters: RecordedParameters<'r>,
    said: Said<'r>,
    /// The position of each instance that ran last: what it says when it runs again was heard.
    heard: Vec<Option<usize>>,
    /// Instances and positions of the frames that do not fit: each is told once.
    unreadable: BTreeSet<(usize, usize)>,
}

impl<'r> Timeline<'r> {
    /// Of all instances that have a cycle which fits this robot; with what a server needs of them. Of the others it is told
    /// why they are left out.
    ///
    /// # Errors
    /// If there is none.
    pub fn new<P: ParameterData>(
        robot: &'static str,
        mut players: Players<'r>,
        parameters: P,
        stop: &Stop,
    ) -> Result<(Self, Link)> {
        let (mut instances, unfit) = instances::fitting(&mut players);
        let moments = moments(&players);
        let first = moments.first().map(|moment| moment.at);
        let first = first.ok_or_else(|| instances::none(&unfit))?;
        for one in &unfit {
            tell(format_args!("{one}"));
        }
        let (caller, moves) = procedure();
        instances.push(instances::timeline(vec![(PROCEDURE, Box::new(caller))]));
        // What clients are told beside the cycles happened when those did.
        let clock = Clock::shown(first);
        let (writer, [], []) = crate::buffer::buffer_of(|| parameters.clone(), []);
        let parameters = LiveParameters::new(writer, parameters.clone(), clock.clone());
        let link = Link {
            robot,
            clock: clock.clone(),
            stop: stop.clone(),
            rearm: Rearm::default(),
            procedures: Vec::new(),
            parameters: parameters.live(),
            instances,
            remotes: Vec::new(),
            recorded: Vec::new(),
        };
        let recording = players.chunks().shelf;
        let timeline = Self {
            parameters: RecordedParameters::fixed(parameters.live(), recording),
            said: Said::nothing(recording),
            heard: vec![None; players.players.len()],
            players,
            moments,
            passed: 0,
            now: first.as_nanos() as f64,
            clock,
            is_playing: true,
            speed: 1.0,
            moves,
            unreadable: BTreeSet::new(),
        };
        Ok((timeline, link))
    }

    /// From now on the parameters that clients see are what the cycles took that are shown; else they stay as they are.
    pub fn follow_parameters(&mut self) {
        self.parameters.follow(&self.players, &self.moments);
        self.parameters.show(self.passed);
    }

    /// From now on clients hear what was said when the recording was made.
    pub fn say_again(&mut self) {
        let recording = self.players.chunks().shelf;
        self.said = Said::new(recording, &self.players, &self.moments);
    }

    /// Plays, and does what clients ask, until it is told to stop or the time is over.
    pub fn run(&mut self, stop: &Stop, duration: Option<Duration>) {
        let started = Instant::now();
        let (mut looked, mut shown) = (started, started);
        while !stop.is_requested() && duration.is_none_or(|all| started.elapsed() < all) {
            self.answer();
            let elapsed = looked.elapsed();
            looked += elapsed;
            if self.is_playing {
                let begun = Instant::now();
                self.advance_while(elapsed, &mut || begun.elapsed() < LONGEST);
            } else if shown.elapsed() >= SHOWN_EVERY {
                shown = Instant::now();
                self.show();
            }
            std::thread::sleep(PAUSE);
        }
    }

    /// Answers the next client, if there is one.
    fn answer(&mut self) {
        self.moves.take();
        let Some(asked) = self.moves.request().cloned() else {
            return;
        };
        let done = self.go(&asked);
        let mut place = self.place();
        place.events = asked.events.then(|| self.events());
        if let Some(call) = self.moves.call() {
            match done {
                Ok(()) => call.answer(place),
                Err(error) => call.refuse(error.to_string()),
            }
        }
        self.show();
    }

    /// Does what a client asks, all of it or nothing.
    ///
    /// # Errors
    /// If it asks for what is not there.
    pub fn go(&mut self, asked: &Move) -> Result<()> {
        let whose = asked.instance.as_deref();
        let whose = whose.map(|name| self.index_of(name)).transpose()?;
        if let Some(speed) = asked.speed
            && (!speed.is_finite() || speed.abs() > FASTEST)
        {
            return Err(Error::new(format!(
                "no speed {speed}: at most {FASTEST}, backwards -{FASTEST}"
            )));
        }
        if asked.time.is_some_and(|time| !time.is_finite()) {
            return Err(Error::new("`time` is no number of seconds"));
        }
        let passed = match (asked.time, asked.cycle, asked.step) {
            (None, None, None) => None,
            (Some(time), None, None) => {
                // The seconds of a cycle, as `events` tells them, lead to that cycle.
                let at = Timestamp::from_nanos((time.max(0.0) * 1e9).round() as u64);
                Some(
                    self.moments
                        .partition_point(|moment| moment.at <= at)
                        .max(1),
                )
            }
            (None, Some(cycle), None) => Some(self.passed_at(whose, cycle)?),
            (None, None, Some(step)) => Some(self.stepped(whose, step)),
            _ => {
                return Err(Error::new(
                    "`time`, `cycle` and `step` are three places to go to: name one",
                ));
            }
        };
        if let Some(speed) = asked.speed {
            self.speed = speed;
        }
        self.is_playing = asked
            .play
            .unwrap_or(self.is_playing && asked.step.is_none());
        if let Some(passed) = passed {
            let before = std::mem::replace(&mut self.passed, passed);
            let (begins, ends) = self.ends();
            self.stand_at(match asked.time {
                Some(time) => (time * 1e9).clamp(begins, ends),
                None => self.moments[passed - 1].at.as_nanos() as f64,
            });
            self.come_from(before);
        }
        Ok(())
    }

    /// Where it is.
    pub fn place(&self) -> Place {
        let (begins, ends) = self.ends();
        let players = self.players.players.iter().enumerate();
        let instances = players.map(|(index, player)| {
            let number = |position: usize| player.frames[position].head.number;
            let last = player.frames.len() - 1;
            InstancePlace {
                instance: player.instance.to_owned(),
                cycle: self.current(index).map(number),
                frames: player.frames.len(),
                missing: (number(last) - number(0)).saturating_sub(last as u64),
            }
        });
        Place {
            time: self.now / 1e9,
            begins: begins / 1e9,
            ends: ends / 1e9,
            is_playing: self.is_playing,
            speed: self.speed,
            instances: instances.collect(),
            events: None,
        }
    }

    /// What happened to the recorded cycles, in order of time: the first [`super::MOST_EVENTS`].
    pub fn events(&self) -> Vec<Happened> {
        events(&self.players)
    }

    /// Lets so much time of the wall clock pass. A cycle whose frame does not fit this robot is told and passed over.
    pub fn advance(&mut self, elapsed: Duration) {
        self.advance_while(elapsed, &mut || true);
    }

    /// As [`Self::advance`], one cycle and then as long as it may go on. What is left of the time then is dropped, as the
    /// cycles that are due would else become more and more.
    pub fn advance_while(&mut self, elapsed: Duration, may_go_on: &mut dyn FnMut() -> bool) {
        let (begins, ends) = self.ends();
        let wanted = self.now + elapsed.as_nanos() as f64 * self.speed;
        let until = wanted.clamp(begins, ends);
        let before = self.passed;
        let mut is_late = false;
        while !is_late && self.step_to(until) {
            is_late = !may_go_on() && self.is_due(until);
        }
        self.stand_at(match is_late {
            true => self.moments[self.passed - 1].at.as_nanos() as f64,
            false => until,
        });
        self.come_from(before);
        if wanted != until && !is_late {
            // It has come to one of its ends.
            self.is_playing = false;
        }
    }

    /// It is so many nanoseconds of the run, for clients, too.
    fn stand_at(&mut self, now: f64) {
        self.now = now;
        self.clock.show(Timestamp::from_nanos(now as u64));
    }

    /// Whether a cycle lies between where it is and this time.
    fn is_due(&self, until: f64) -> bool {
        let at = |index: usize| Some(self.moments.get(index)?.at.as_nanos() as f64);
        match self.speed < 0.0 {
            true => self.passed > 1 && at(self.passed - 1).is_some_and(|at| at > until),
            false => at(self.passed).is_some_and(|at| at <= until),
        }
    }

    /// Runs the next cycle that is due until this time, in the direction in which it plays; gives whether there was one.
    fn step_to(&mut self, until: f64) -> bool {
        if !self.is_due(until) {
            return false;
        }
        if self.speed < 0.0 {
            self.passed -= 1;
            let left = self.moments[self.passed].instance;
            if let Some(position) = self.current(left) {
                self.play(left, position);
            }
        } else {
            let moment = self.moments[self.passed];
            self.passed += 1;
            self.play(moment.instance, moment.position);
        }
        true
    }

    /// After time went on or back: what goes with it beside the cycles.
    fn come_from(&mut self, before: usize) {
        self.parameters.show(self.passed);
        self.said.pass(before, self.passed);
    }

    /// Runs the cycles again at which the time stands.
    fn show(&mut self) {
        for index in 0..self.players.players.len() {
            if let Some(position) = self.current(index) {
                self.play(index, position);
            }
        }
    }

    fn play(&mut self, index: usize, position: usize) {
        let mut players = self.players.each();
        let Some((player, chunks)) = players.nth(index) else {
            return;
        };
        let is_heard = self.heard[index].replace(position) == Some(position);
        let _again = again(match is_heard {
            true => Again::Silent,
            false => Again::Apart {
                at: player.frames[position].head.start,
                known: self.said.of(index, position),
            },
        });
        // What is abandoned or asks the hardware has no outputs to show.
        let played: Result<Ran> = player.play(position, chunks);
        if let Err(error) = played
            && self.unreadable.insert((index, position))
        {
            let (name, number) = (player.instance, player.frames[position].head.number);
            tell(format_args!(
                "cycle {number} of `{name}` cannot be shown: {error}"
            ));
        }
    }

    /// Nanoseconds of the first and the last cycle.
    fn ends(&self) -> (f64, f64) {
        let at = |moment: Option<&Moment>| moment.map_or(0.0, |moment| moment.at.as_nanos() as f64);
        (at(self.moments.first()), at(self.moments.last()))
    }

    /// The last cycle of an instance that has been.
    fn current(&self, instance: usize) -> Option<usize> {
        let mut been = self.moments[..self.passed].iter().rev();
        been.find(|moment| moment.instance == instance)
            .map(|moment| moment.position)
    }

    fn index_of(&self, name: &str) -> Result<usize> {
        let mut players = self.players.players.iter();
        let found = players.position(|player| player.instance == name);
        found.ok_or_else(|| {
            let names = self.players.players.iter().map(|player| player.instance);
            let names: Vec<_> = names.collect();
            Error::new(format!(
                "the recording has no instance `{name}`: it has `{}`",
                names.join("`, `")
            ))
        })
    }

    /// How many moments have been once this cycle is shown.
    fn passed_at(&self, whose: Option<usize>, cycle: u64) -> Result<usize> {
        let whose = whose.ok_or_else(|| Error::new("`cycle` needs `instance`: whose"))?;
        let player = &self.players.players[whose];
        let mut frames = player.frames.iter();
        let position = frames.position(|frame| frame.head.number == cycle);
        let is_it = |moment: &Moment| moment.instance == whose && Some(moment.position) == position;
        let found = self.moments.iter().position(is_it);
        found.map(|index| index + 1).ok_or_else(|| {
            let instance = player.instance;
            Error::new(format!("cycle {cycle} of `{instance}` was not recorded"))
        })
    }

    /// How many moments have been after so many steps; it stays between the ends.
    fn stepped(&self, whose: Option<usize>, step: i64) -> usize {
        let is_meant = |moment: &Moment| whose.is_none_or(|index| moment.instance == index);
        let meant = self.moments.iter().enumerate();
        let meant: Vec<_> = meant
            .filter(|(_, moment)| is_meant(moment))
            .map(|(index, _)| index + 1)
            .collect();
        let been = meant.partition_point(|passed| *passed <= self.passed) as i64;
        let wanted = been.saturating_add(step).clamp(1, meant.len() as i64);
        meant[wanted as usize - 1]
    }
}

/// When which cycle began, in order of time.
fn moments(players: &Players<'_>) -> Vec<Moment> {
    let mut moments = Vec::new();
    for (instance, player) in players.players.iter().enumerate() {
        let heads = player.frames.iter().map(|frame| frame.head).enumerate();
        moments.extend(heads.map(|(position, head)| Moment {
            at: head.start,
            instance,
            position,
        }));
    }
    moments.sort_by_key(|moment| moment.at);
    moments
}
