//! `--check-parameters`: what the start of the robot would say about its parameters, for every robot that files name.

use std::collections::BTreeMap;
use std::io::{self, Write};

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::json;

use super::options::{Format, Options};
use super::{DONE, FAILED, Target, check_hardware, layers, of_hardware};
use crate::clock::Clock;
use crate::error::{Error, Result};
use crate::hardware::{Hardware, HardwareContext};
use crate::parameters::{Fault, Layers, Origin, ParameterError};
use crate::reflect::Reflect;
use crate::report::tell;
use crate::stop::Stop;

/// Why a robot would not start.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
struct Mistake {
    /// None: it stands in no file.
    file: Option<String>,
    line: Option<usize>,
    /// Empty where no value is meant.
    key: String,
    fault: Fault,
    /// With its place, as the start of the robot says it.
    text: String,
    message: String,
    /// The first robot that has it.
    identities: BTreeMap<String, String>,
}

/// Loads the parameters as every robot would that files name, and says what is wrong; gives the exit status.
///
/// A value is only missing if no file of an identity has it: which robots there are, nobody knows here.
pub(super) fn parameters<H: Hardware, P: DeserializeOwned + Reflect>(
    target: &Target,
    options: &Options,
    output: &mut dyn Write,
) -> u8 {
    let mistakes = match layers(target, options) {
        Ok(layers) => {
            let mut found = mistakes::<P>(target, &layers.combinations(target.identities));
            found.extend(mistake_of_hardware::<H>(target, options, &layers));
            found
        }
        Err(error) => vec![Mistake::new(&error, Vec::new())],
    };
    let written = match options.format {
        Format::Json => tell_programs(&mistakes, output),
        Format::Text => {
            mistakes.iter().for_each(Mistake::tell);
            Ok(())
        }
    };
    if mistakes.is_empty() && written.is_ok() {
        DONE
    } else {
        FAILED
    }
}

/// Why robots would not start, each reason once.
fn mistakes<P: DeserializeOwned + Reflect>(target: &Target, robots: &[Layers]) -> Vec<Mistake> {
    let count = robots.len();
    let mut found: Vec<(Mistake, usize)> = Vec::new();
    for robot in robots {
        let loaded = robot.load().and_then(|all| {
            check_hardware(target, &all)?;
            all.deserialize::<P>()
        });
        let Err(error) = loaded.map(drop) else {
            continue;
        };
        let mistake = Mistake::new(&error, robot.identities.clone());
        match found.iter_mut().find(|(one, _)| one.is_same(&mistake)) {
            Some((_, robots)) => *robots += 1,
            None => found.push((mistake, 1)),
        }
    }
    found.retain(|(mistake, robots)| mistake.fault != Fault::Missing || *robots == count);
    found.into_iter().map(|(mistake, _)| mistake).collect()
}

/// Why the hardware would not start; its table is that without identities, for it is the hardware that has them.
fn mistake_of_hardware<H: Hardware>(
    target: &Target,
    options: &Options,
    layers: &Layers,
) -> Option<Mistake> {
    // What cannot be loaded, or is for no target, is told of the parameters.
    let loaded = layers.load().ok()?;
    check_hardware(target, &loaded).ok()?;
    let read = |table| -> Result<()> {
        H::check_parameters(&HardwareContext {
            options: options.hardware.clone(),
            table,
            run_folder: options.run_folder.clone(),
            clock: Clock::wall(),
            stop: Stop::new(),
        })
        .map_err(|error| of_hardware(target, &loaded, error))
    };
    let error = loaded.hardware(target.name).and_then(read).err()?;
    let mistake = Mistake::new(&error, Vec::new());
    Some(match mistake.key.as_str() {
        // Neither key nor file: it says in its own words what is wrong.
        "" => Mistake {
            key: format!("hardware.{}", target.name),
            ..mistake
        },
        _ => mistake,
    })
}

fn tell_programs(mistakes: &[Mistake], output: &mut dyn Write) -> io::Result<()> {
    writeln!(output, "{}", json!({ "version": 1, "mistakes": mistakes }))
}

impl Mistake {
    fn new(error: &Error, identities: Vec<(String, String)>) -> Self {
        let located = error.find::<ParameterError>();
        let place = located.and_then(|error| match &error.origin {
            Origin::File { path, line } => Some((path.to_string(), *line)),
            Origin::Environment(_) | Origin::Setting(_) | Origin::Unknown => None,
        });
        let text = error.to_string();
        Self {
            line: place.as_ref().map(|(_, line)| *line),
            file: place.map(|(file, _)| file),
            key: located.map_or_else(String::new, |error| error.key.clone()),
            fault: located.map_or(Fault::Invalid, |error| error.fault),
            message: located.map_or_else(|| text.clone(), |error| error.message.clone()),
            text,
            identities: identities.into_iter().collect(),
        }
    }

    /// Perhaps of another robot, whose files are others.
    fn is_same(&self, other: &Self) -> bool {
        let parts = |one: &Self| {
            (
                one.file.clone(),
                one.line,
                one.key.clone(),
                one.message.clone(),
            )
        };
        parts(self) == parts(other)
    }

    fn tell(&self) {
        let identities = self.identities.iter();
        let robot: String = identities
            .map(|(name, id)| format!(" ({name} {id})"))
            .collect();
        tell(format_args!("error: {}{robot}", self.text));
    }
}
