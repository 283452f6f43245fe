//! `--replay`: recorded cycles run again, instead of the robot.

use std::io::Write;
use std::path::{Path, PathBuf};

use lexopt::{Parser, ValueExt};

use super::options::{Format, Options};
use super::record::digest_of;
use super::{DONE, FAILED, Serve, Target};
use crate::data::ParameterData;
use crate::error::{Error, Result};
use crate::recorded::Loading;
use crate::replay::{
    Call, Comparison, Elsewhere, How, Needed, OtherParameters, Players, Shelf, Timeline, answer,
    compare, read_in_new_alone, recorded_parameters, snapshot, verify_how, with_settings,
};
use crate::report::tell;
use crate::stop::Stop;

/// What is to be done with a recording.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Replaying {
    /// The recording; empty: there is none.
    pub(super) file: PathBuf,
    /// Whether it gives the same bits.
    pub(super) verify: bool,
    /// Whether cycles under other parameters go on with what the one before them left behind.
    pub(super) carry: bool,
    /// What one node needs instead of everything.
    pub(super) node: Option<String>,
    pub(super) tolerance: Option<f64>,
    /// Another program, whose outputs are compared.
    pub(super) against: Option<PathBuf>,
    /// What the other program is called in the answer.
    pub(super) against_name: Option<String>,
    /// Answer another program.
    pub(super) answer: bool,
    /// A node of whose call everything is to be told.
    pub(super) capture: Option<String>,
    pub(super) instance: Option<String>,
    pub(super) at: Option<u64>,
}

impl Replaying {
    /// Takes an option if it is one of a replay; gives whether it is.
    pub(super) fn take(&mut self, option: &str, parser: &mut Parser) -> Result<bool> {
        match option {
            "replay" => self.file = parser.value()?.into(),
            "verify" => self.verify = true,
            "carry" => self.carry = true,
            "node" => self.node = Some(parser.value()?.string()?),
            "tolerance" => self.tolerance = Some(tolerance(&parser.value()?.string()?)?),
            "against" => self.against = Some(parser.value()?.into()),
            "against-name" => self.against_name = Some(parser.value()?.string()?),
            "answer" => self.answer = true,
            "capture" => self.capture = Some(parser.value()?.string()?),
            "instance" => self.instance = Some(parser.value()?.string()?),
            "at" => self.at = Some(parser.value()?.parse()?),
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Whether something is to be computed; else it is played.
    pub(super) fn is_question(&self) -> bool {
        let deeds = [self.verify, self.answer, self.against.is_some()];
        deeds.contains(&true) || self.node.is_some() || self.capture.is_some()
    }

    /// Whether there is something to replay.
    ///
    /// # Errors
    /// If options do not go together; `changes`: parameters are set.
    pub(super) fn is_asked(&self, changes: bool) -> Result<bool> {
        let is_asked = !self.file.as_os_str().is_empty();
        let deeds = [
            (self.verify, "--verify"),
            (is_asked && changes, "--set"),
            (self.against.is_some(), "--against"),
            (self.answer, "--answer"),
            (self.capture.is_some(), "--capture"),
        ];
        let deeds: Vec<_> = deeds.iter().filter(|(is_there, _)| *is_there).collect();
        if let [(_, one), (_, other), ..] = deeds.as_slice() {
            return Err(Error::new(format!("{one} and {other} are two replays")));
        }
        let is_verified = self.verify || (self.node.is_some() && deeds.is_empty());
        if self.tolerance.is_some() && !is_verified {
            return Err(Error::new("--tolerance is for --verify"));
        }
        let call = (self.instance.is_some(), self.at.is_some());
        if call != (self.capture.is_some(), self.capture.is_some()) {
            return Err(Error::new(
                "--capture NODE, --instance NAME and --at CYCLE go together",
            ));
        }
        if self.carry && !(is_asked && changes) {
            return Err(Error::new("--carry is for --set"));
        }
        let options = !deeds.is_empty() || self.node.is_some();
        if options && !is_asked {
            return Err(Error::new(
                "--verify, --node, --against, --answer and --capture are for --replay FILE",
            ));
        }
        Ok(is_asked)
    }
}

/// Plays it for clients, as if the robot ran.
fn served<P: ParameterData>(
    target: &Target,
    recording: &Shelf,
    options: &Options,
    serve: Serve,
) -> Result<bool> {
    let mut are_recorded = true;
    let parameters: P = match recorded_parameters(recording) {
        Ok(parameters) => parameters,
        Err(why) => {
            let files = super::layers(target, options).and_then(|layers| layers.load());
            let parameters = files.and_then(|files| files.deserialize());
            let parameters = parameters.map_err(|error| error.context(why.to_string()))?;
            tell(format_args!("{why}; those of the files are shown"));
            are_recorded = false;
            parameters
        }
    };
    let players = Players::new(recording, target.replayables)?;
    for unknown in &players.unknown {
        tell(format_args!(
            "{unknown}: this robot has no such instance, or cannot replay it"
        ));
    }
    let stop = Stop::new();
    let (mut timeline, link) = Timeline::new(target.robot, players, parameters, &stop)?;
    if are_recorded {
        timeline.follow_parameters();
    }
    timeline.say_again();
    let listening = options
        .listening(target)
        .ok_or_else(|| Error::new("--listen off leaves nobody to show the recording to"))?;
    let served = serve(link, listening).map_err(|error| error.context("cannot serve clients"))?;
    if let Some(served) = &served {
        tell(format_args!("page: {}", super::page(served.as_ref())));
    }
    timeline.run(&stop, options.duration);
    Ok(true)
}

fn tolerance(text: &str) -> Result<f64> {
    let number = text.parse().ok();
    let number = number.filter(|number: &f64| number.is_finite() && *number >= 0.0);
    number.ok_or_else(|| Error::new(format!("`{text}` is no tolerance: expected e.g. 1e-6")))
}

/// Replays; gives the exit status.
pub(super) fn run<P: ParameterData>(
    target: &Target,
    options: &Options,
    output: &mut dyn Write,
    serve: Serve,
) -> u8 {
    let file = &options.replay.file;
    let result = Shelf::open(file).and_then(|recording| {
        if options.replay.is_question() || !options.settings.is_empty() {
            replayed::<P>(target, &recording, options, output)
        } else {
            served::<P>(target, &recording, options, serve)
        }
    });
    match result {
        Ok(true) => DONE,
        Ok(false) => FAILED,
        Err(error) => {
            tell(format_args!("error: {}: {error}", file.display()));
            FAILED
        }
    }
}

fn replayed<P: ParameterData>(
    target: &Target,
    recording: &Shelf,
    options: &Options,
    output: &mut dyn Write,
) -> Result<bool> {
    let replay = &options.replay;
    if replay.answer {
        let mut players = Players::new(recording, target.replayables)?;
        answer(&mut players, std::io::stdin().lock(), output)?;
        return Ok(true);
    }
    if let Some(node) = &replay.capture {
        let mut players = Players::new(recording, target.replayables)?;
        let call = Call {
            instance: replay.instance.as_deref().unwrap_or_default(),
            cycle: replay.at.unwrap_or_default(),
            needed: &Needed::new(node, target.graph)?,
        };
        let parameters = |recorded: &[u8]| {
            let parameters: P = Loading::new(recorded).take()?;
            Ok(serde_json::to_value(parameters)?)
        };
        let snapshot = snapshot(&mut players, call, &parameters)?;
        writeln!(output, "{snapshot}")?;
        return Ok(true);
    }
    let node = replay.node.as_deref();
    let needed = node
        .map(|name| Needed::new(name, target.graph))
        .transpose()?;
    let is_good = if let Some(program) = &replay.against {
        let comparison = against(target, recording, (program, replay), needed.as_ref())?;
        say(&comparison, comparison.to_json(), options.format, output)?;
        comparison.is_good()
    } else if !options.settings.is_empty() {
        let comparison = under::<P>(target, recording, options, needed.as_ref())?;
        say(&comparison, comparison.to_json(), options.format, output)?;
        comparison.is_good()
    } else {
        let how = How {
            needed,
            tolerance: replay.tolerance,
            graph: Some(digest_of(target.dataflow)),
        };
        let verification = verify_how(recording, target.replayables, &how)?;
        say(
            &verification,
            verification.to_json(),
            options.format,
            output,
        )?;
        verification.is_good()
    };
    for offset in recording.damaged() {
        tell(format_args!(
            "the chunk at byte {offset} is damaged (its check sum is wrong): what it had is lost"
        ));
    }
    for offset in &recording.contents().unreadable {
        tell(format_args!(
            "the record at byte {offset} (metadata, or an attachment) is damaged: what it had is lost"
        ));
    }
    if !recording.is_complete() {
        tell(format_args!(
            "the recording is INCOMPLETE: frames were dropped, something in it is damaged, or it was cut off"
        ));
    }
    Ok(is_good)
}

fn say(
    answer: &dyn std::fmt::Display,
    json: serde_json::Value,
    format: Format,
    output: &mut dyn Write,
) -> Result<()> {
    match format {
        Format::Json => writeln!(output, "{json}")?,
        Format::Text => write!(output, "{answer}")?,
    }
    Ok(())
}

/// Another build beside this one.
fn against(
    target: &Target,
    recording: &Shelf,
    (program, replay): (&Path, &Replaying),
    needed: Option<&Needed>,
) -> Result<Comparison> {
    let mut here = Players::new(recording, target.replayables)?;
    if let Some(needed) = needed {
        here = here.only(needed);
    }
    let mut there = Elsewhere::start(program, &replay.file)?;
    let mut comparison = compare(&mut there, &mut here, needed)?;
    let name = replay.against_name.clone();
    let name = name.unwrap_or_else(|| program.display().to_string());
    comparison.names = (name, "this build".to_owned());
    Ok(comparison)
}

/// The recorded parameters beside others.
fn under<P: ParameterData>(
    target: &Target,
    recording: &Shelf,
    options: &Options,
    needed: Option<&Needed>,
) -> Result<Comparison> {
    let settings = &options.settings;
    let carry = options.replay.carry;
    let mut unread = Vec::new();
    let other = OtherParameters::new(recording, &mut |recorded| {
        unread = read_in_new_alone::<P>(recorded, settings)?;
        with_settings::<P>(recorded, settings)
    })?;
    let players = || -> Result<Players<'_>> {
        let players = Players::new(recording, target.replayables)?;
        Ok(match needed {
            Some(needed) => players.only(needed),
            None => players,
        })
    };
    let mut after = players()?.under(&other);
    if carry {
        after = after.carrying(target.graph)?;
    }
    let mut comparison = compare(&mut players()?, &mut after, needed)?;
    let settings = settings.iter();
    let settings: Vec<_> = settings
        .map(|(path, value)| format!("{path}={value}"))
        .collect();
    comparison.names = ("as recorded".to_owned(), settings.join(" "));
    let note = match carry {
        false => {
            "each cycle begins with the states that were recorded: --carry says what a change does over many cycles"
        }
        true => {
            // All nodes ran.
            comparison.recomputed.clear();
            "cycles go on with the states that the one before them left: sensors, other instances and clients are as they were recorded"
        }
    };
    comparison.notes.push(note.to_owned());
    for path in unread {
        comparison.notes.push(format!(
            "`{path}` is read in `new` alone, which a replay does not call: it changes nothing here"
        ));
    }
    Ok(comparison)
}
