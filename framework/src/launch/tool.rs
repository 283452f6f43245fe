//! `--tool`: what the hardware offers beside running the robot.

use std::collections::BTreeMap;
use std::io::Write;
use std::sync::Arc;

use super::options::Options;
use super::{DONE, Target, WRONG_USAGE, hardware_table, known_identities, layers};
use crate::clock::Clock;
use crate::data::ParameterData;
use crate::error::{Error, Result};
use crate::hardware::{Hardware, HardwareContext};
use crate::report::tell;
use crate::robot::{Robot, Start};
use crate::stop::Stop;
use crate::tool::{Bench, Trial};

/// Hands over to the hardware; gives the exit status.
pub(super) fn run<H: Hardware, P: ParameterData>(
    target: &Target,
    options: &Options,
    stop: &Stop,
    output: &mut dyn Write,
    create: &mut impl FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>>,
) -> Result<u8> {
    let name = options.tool.as_deref().unwrap_or_default();
    if !H::tools().contains(&name) {
        let known = match H::tools() {
            [] => "it has none".to_owned(),
            tools => format!("there are {}", tools.join(", ")),
        };
        let target = target.name;
        tell(format_args!(
            "error: the hardware of target `{target}` has no tool `{name}`; {known}"
        ));
        return Ok(WRONG_USAGE);
    }
    let context = HardwareContext {
        options: options.hardware.clone(),
        table: hardware_table(target, &layers(target, options)?.load()?)?,
        run_folder: options.run_folder.clone(),
        clock: Clock::stepped(),
        stop: stop.clone(),
    };
    let mut workbench = Workbench {
        target,
        options,
        create,
    };
    H::tool(name, context, &mut workbench, output)?;
    Ok(DONE)
}

/// What creates a robot with its nodes.
type Create<'run, H, P> = dyn FnMut(&Arc<H>, Start<P>) -> Result<Robot<P>> + 'run;

/// Creates robots with the parameters that the command line asks for.
struct Workbench<'run, H, P> {
    target: &'run Target,
    options: &'run Options,
    create: &'run mut Create<'run, H, P>,
}

impl<H: Hardware, P: ParameterData> Workbench<'_, H, P> {
    /// As the layers for this hardware say.
    fn parameters(&self, hardware: &H) -> Result<P> {
        let mut layers = layers(self.target, self.options)?;
        layers.identities = known_identities(self.target, hardware.identities());
        layers.load()?.deserialize()
    }
}

impl<H: Hardware, P: ParameterData> Bench<H> for Workbench<'_, H, P> {
    fn try_out(&mut self, trial: &Trial<'_, H>) -> Result<BTreeMap<String, serde_json::Value>> {
        let start = Start {
            clock: trial.clock.clone(),
            stop: Stop::new(),
            parameters: self.parameters(&trial.hardware)?,
        };
        let mut robot = (self.create)(&trial.hardware, start)?;
        trial.run(&mut robot)
    }

    fn parameter(&mut self, hardware: &H, path: &str) -> Result<serde_json::Value> {
        let parameters = serde_json::to_value(self.parameters(hardware)?)?;
        let pointer = format!("/{}", path.replace('.', "/"));
        let value = parameters.pointer(&pointer).cloned();
        value.ok_or_else(|| Error::new(format!("this robot has no parameter `{path}`")))
    }
}
