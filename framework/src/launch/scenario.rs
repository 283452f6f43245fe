//! `--scenario`: plays a file in place of running, and tells what came of it.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use super::options::{Format, Options};
use super::{DONE, FAILED, Target, known_identities, layers};
use crate::clock::Clock;
use crate::data::ParameterData;
use crate::error::{Error, Result};
use crate::hardware::{Hardware, HardwareContext};
use crate::report::tell;
use crate::robot::{Robot, Start};
use crate::scenario::{Outcome, Played, Scenario, play};
use crate::stop::Stop;

/// Plays it with every seed; gives the exit status.
pub(super) fn run<H: Hardware, P: ParameterData>(
    target: &Target,
    options: &Options,
    file: &Path,
    stop: &Stop,
    output: &mut dyn Write,
    create: &mut impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
) -> Result<u8> {
    let scenario = Scenario::load(file)?;
    let mut runs: Vec<Played> = Vec::new();
    let first = options.seed.unwrap_or(1);
    for seed in first..first.saturating_add(options.repeat.unwrap_or(1)) {
        stop.check()?;
        let played = play_once(target, options, &scenario, seed, stop, create);
        let played =
            played.map_err(|error| error.context(format!("scenario {}", file.display())))?;
        if options.format == Format::Text {
            tell(format_args!("{}", played.headline()));
        }
        runs.push(played);
    }
    let passes = runs.iter().filter(|run| run.passed).count();
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "seeds are few"
    )]
    let needed = (scenario.passes * runs.len() as f64 - 1e-9).ceil() as usize;
    let outcome = Outcome {
        version: 1,
        scenario: file.to_owned(),
        about: scenario.about,
        passed: passes >= needed,
        passes,
        needed,
        runs,
    };
    let written = match options.format {
        Format::Json => writeln!(output, "{}", serde_json::to_string(&outcome)?),
        Format::Text => writeln!(output, "{}", outcome.to_string().trim_end()),
    };
    written.map_err(|error| Error::from(error).context("cannot write the outcome"))?;
    Ok(if outcome.passed { DONE } else { FAILED })
}

fn play_once<H: Hardware, P: ParameterData>(
    target: &Target,
    options: &Options,
    scenario: &Scenario,
    seed: u64,
    stop: &Stop,
    create: &mut impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
) -> Result<Played> {
    let clock = Clock::stepped();
    // What somebody says on the command line wins.
    let mut layers = layers(target, options);
    layers
        .settings
        .splice(0..0, scenario.settings.iter().cloned());
    let table = layers.load()?.hardware(target.name)?;
    let hardware = H::new(HardwareContext {
        options: options.hardware.clone(),
        table: scenario.world(table, seed)?,
        run_folder: options.run_folder.clone(),
        clock: clock.clone(),
        stop: stop.clone(),
    });
    let hardware = Arc::new(
        hardware.map_err(|error| error.context(format!("hardware of `{}`", target.name)))?,
    );
    layers.identities = known_identities(target, hardware.identities());
    let start = Start {
        clock,
        stop: stop.clone(),
        parameters: layers.load()?.deserialize()?,
    };
    let mut robot = create(&hardware, start)?;
    play(scenario, seed, &hardware, &mut robot)
}
