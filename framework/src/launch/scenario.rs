//! `--scenario`: plays a file in place of running, and those that clients choose after it, and tells what came of each.

mod blame;

use std::io::Write;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use self::blame::{blame, place};
use super::options::{Format, Options, Record};
use super::{
    DONE, FAILED, Serve, Target, ending, hardware_table, known_identities, layers, record,
};
use crate::clock::Clock;
use crate::data::ParameterData;
use crate::error::{Error, Result};
use crate::hardware::{Hardware, HardwareContext};
use crate::logs;
use crate::parameters::{Above, Origin};
use crate::recorded::{Recording, RecordingReport};
use crate::report::tell;
use crate::robot::{Robot, Start};
use crate::scenario::{Audience, Cast, Manner, Outcome, Played, Scenario, misspelt, play};
use crate::stop::Stop;

/// Plays it with every seed, and what clients choose in place of it likewise; gives the exit status, that of the last one.
pub(super) fn run<H: Hardware + 'static, P: ParameterData>(
    target: &Target,
    options: &Options,
    file: &Path,
    stop: &Stop,
    output: &mut dyn Write,
    create: &mut impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
    serve: Serve,
) -> Result<u8> {
    let mut file = file.to_owned();
    // Where clients chose this one: what was played before.
    let mut before = None;
    loop {
        // Nobody watches unless somebody says where: most scenarios are played to be judged.
        let listening = options
            .listening(target)
            .filter(|listening| listening.address.is_some());
        let audience = listening.map(|listening| Audience {
            serve,
            listening,
            file: file.clone(),
        });
        let scenario = Scenario::load(&file);
        let played = scenario.and_then(|scenario| {
            let stage = Stage {
                audience,
                target,
                options,
                scenario,
                file: &file,
                stop,
            };
            stage.play_all(create)
        });
        let (outcome, chosen) = match (played, before.take()) {
            (Err(error), Some(last)) if !stop.is_requested() => {
                tell(format_args!(
                    "error: {error}; what was played before begins anew"
                ));
                file = last;
                continue;
            }
            (played, _) => played?,
        };
        let written = match options.format {
            Format::Json => writeln!(output, "{}", serde_json::to_string(&outcome)?),
            Format::Text => writeln!(output, "{}", outcome.to_string().trim_end()),
        };
        written.map_err(|error| Error::from(error).context("cannot write the outcome"))?;
        match chosen {
            Some(chosen) => before = Some(std::mem::replace(&mut file, chosen)),
            None => return Ok(if outcome.passed { DONE } else { FAILED }),
        }
    }
}

/// The seeds that are played, one at least.
fn seeds(options: &Options) -> Result<RangeInclusive<u64>> {
    let first = options.seed.unwrap_or(1);
    let further = options.repeat.unwrap_or(1).checked_sub(1);
    let last = further.and_then(|further| first.checked_add(further));
    let last = last.ok_or_else(|| {
        Error::new("nothing would be played: `--repeat` is at least 1, and seeds end at 2^64 - 1")
    })?;
    Ok(first..=last)
}

/// What is played, and how.
struct Stage<'run> {
    target: &'run Target,
    options: &'run Options,
    scenario: Scenario,
    file: &'run Path,
    stop: &'run Stop,
    audience: Option<Audience>,
}

impl Stage<'_> {
    /// Plays it with every seed, until somebody chooses another one: its file comes with the outcome.
    fn play_all<H: Hardware + 'static, P: ParameterData>(
        &self,
        create: &mut impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
    ) -> Result<(Outcome, Option<PathBuf>)> {
        let mut runs: Vec<Played> = Vec::new();
        let mut chosen = None;
        for seed in seeds(self.options)? {
            self.stop.check()?;
            let played = self.play(seed, create);
            let played =
                played.map_err(|error| error.context(format!("scenario {}", self.file.display())));
            let (played, next) = played?;
            if self.options.format == Format::Text {
                tell(format_args!("{}", played.headline()));
            }
            runs.push(played);
            chosen = next;
            if chosen.is_some() || self.stop.is_requested() {
                break;
            }
        }
        // Who ends it early has not seen the others pass.
        let asked = self.options.repeat.unwrap_or(1);
        let passes = runs.iter().filter(|run| run.passed).count();
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "seeds are few"
        )]
        let needed = (self.scenario.passes * asked as f64 - 1e-9).ceil() as usize;
        let outcome = Outcome {
            version: 1,
            scenario: self.file.to_owned(),
            about: self.scenario.about.clone(),
            passed: passes >= needed,
            passes,
            needed,
            runs,
        };
        Ok((outcome, chosen))
    }

    /// Plays it once; and where it does not pass, once more for a recording: the same seed gives the same.
    fn play<H: Hardware + 'static, P: ParameterData>(
        &self,
        seed: u64,
        create: &mut impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
    ) -> Result<(Played, Option<PathBuf>)> {
        let record_always = matches!(self.options.record, Record::On);
        let record_never = matches!(self.options.record, Record::Off);
        let (played, chosen) = self.play_once(seed, record_always, create)?;
        // What clients did would not come again.
        let was_watched = self.audience.is_some();
        let is_enough = record_always || record_never || was_watched || self.stop.is_requested();
        if played.passed || is_enough {
            return Ok((played, chosen));
        }
        let (recorded, chosen) = match self.play_once(seed, true, create) {
            // What was seen is true nevertheless, and so is what came of the seeds before.
            Err(error) if !self.stop.is_requested() => {
                tell(format_args!("seed {seed} is not recorded: {error}"));
                return Ok((played, chosen));
            }
            again => again?,
        };
        let played = Played {
            recordings: recorded.recordings,
            // The same, or that somebody ended the recording.
            stopped: recorded.stopped,
            ..played
        };
        Ok((played, chosen))
    }

    fn play_once<H: Hardware + 'static, P: ParameterData>(
        &self,
        seed: u64,
        is_recorded: bool,
        create: &mut impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
    ) -> Result<(Played, Option<PathBuf>)> {
        let mut casts = Vec::new();
        // Before files of a run that would not begin.
        let seats = (self.audience.as_ref()).map(|audience| {
            Ok::<_, Error>((audience, audience.open(self.scenario.robot_count())?))
        });
        let audience = seats.transpose()?;
        for robot in 0..self.scenario.robot_count() {
            casts.push(self.cast(robot, seed, &casts, create)?);
        }
        let recorded = match is_recorded {
            true => self.record_all(seed, &mut casts),
            false => Ok(()),
        };
        let threads = || std::thread::available_parallelism().map_or(1, usize::from);
        let manner = Manner {
            threads: self.options.threads.unwrap_or_else(threads),
            digests: self.options.digests,
            stop: self.stop,
            audience,
        };
        let played = recorded.and_then(|()| play(&self.scenario, seed, &mut casts, manner));
        // Also where nothing was played: who drops a recording waits for its disk without end.
        let recordings = casts.into_iter().filter_map(|cast| cast.recording);
        let reports: Vec<_> = recordings.map(ending::end).collect();
        let (mut played, chosen) = played?;
        for report in reports {
            tell(format_args!("{}", report.to_string().trim_end()));
            add(&mut played, report);
        }
        Ok((played, chosen))
    }

    /// One robot in the world of those that are there already.
    fn cast<H: Hardware, P: ParameterData>(
        &self,
        robot: usize,
        seed: u64,
        others: &[Cast<H, P>],
        create: &mut impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
    ) -> Result<Cast<H, P>> {
        // One that stops ends nothing but itself.
        let (clock, stop) = (Clock::stepped(), Stop::new());
        let _within = logs::within(&clock);
        let mut layers = layers(self.target, self.options)?;
        // Later ones win: what somebody says on the command line stands behind.
        layers.above = self.scenario.parameters_of(robot, self.file);
        let loaded = layers.load()?;
        let table = hardware_table(self.target, &loaded)?;
        let context = HardwareContext {
            options: self.options.hardware.clone(),
            table: self.scenario.world_of(robot, table, seed)?,
            run_folder: self.options.run_folder.clone(),
            clock: clock.clone(),
            stop: stop.clone(),
        };
        let hardware = match others.first() {
            None => H::new(context),
            Some(first) => first.hardware.join(context),
        };
        let hardware = Arc::new(hardware.map_err(|error| {
            let error = loaded.locate(self.target.name, self.blame(robot, error));
            error.context(match self.scenario.robot_count() {
                1 => format!("hardware of `{}`", self.target.name),
                _ => format!("hardware of `{}`, robot {}", self.target.name, robot + 1),
            })
        })?);
        let of_hardware = Above::Settings(hardware.settings());
        layers.above.insert(0, of_hardware);
        layers.identities = known_identities(self.target, hardware.identities());
        let start = Start {
            clock,
            stop,
            parameters: (layers.load()?.deserialize()).map_err(|error| self.blame(robot, error))?,
        };
        let created = create(&hardware, start)?;
        if let Some(wrong) = misspelt(&self.scenario.assertions, &created, robot + 1) {
            let place = place(self.file, &wrong.path());
            return Err(wrong.at(place.unwrap_or(Origin::Unknown)).into());
        }
        Ok(Cast {
            hardware,
            robot: created,
            recording: None,
        })
    }

    /// With the place in the file of what the scenario says.
    fn blame(&self, robot: usize, error: Error) -> Error {
        blame(self.file, robot, error)
    }

    /// Begins the files of all robots, behind everything else that may be wrong.
    fn record_all<H: Hardware, P: ParameterData>(
        &self,
        seed: u64,
        casts: &mut [Cast<H, P>],
    ) -> Result<()> {
        casts.iter_mut().enumerate().try_for_each(|(robot, cast)| {
            cast.recording = Some(self.record(robot, seed, cast)?);
            Ok(())
        })
    }

    fn record<H: Hardware, P: ParameterData>(
        &self,
        robot: usize,
        seed: u64,
        cast: &Cast<H, P>,
    ) -> Result<Recording> {
        let name = self.file.file_stem().unwrap_or_default().to_string_lossy();
        let number = match self.scenario.robot_count() {
            1 => String::new(),
            _ => format!("-robot-{}", robot + 1),
        };
        let name = format!("{name}-seed-{seed}{number}");
        record::start_into(
            // Clients may choose one that was played already.
            &record::free_place(&self.options.run_folder, &name),
            self.target,
            self.options,
            &cast.robot,
            &cast.hardware.identities(),
        )
    }
}

/// What came of a recording belongs to what was played: without its end, nobody can see of it what was asked for.
fn add(played: &mut Played, report: RecordingReport) {
    if report.ended.is_outstanding {
        played.passed = false;
        let path = report.ended.path.display();
        let why = format!(
            "its recording {path}: {}",
            report.error().unwrap_or_default()
        );
        let before = played.stopped.take().map(|before| format!("{before}; "));
        played.stopped = Some(before.unwrap_or_default() + &why);
    }
    played.recordings.push(report.ended.path);
}

#[cfg(test)]
mod tests;
