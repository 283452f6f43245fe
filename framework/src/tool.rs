//! Tries out one instance of a robot, for tools that hardware offers beside running: [`crate::Hardware::tool`].
//!
//! A trial is a robot of its own: nothing of it is there in the next one.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::clock::Clock;
use crate::driver::Lockstep;
use crate::error::{Error, Result};
use crate::hardware::Hardware;
use crate::parameters::Given;
use crate::robot::Robot;
use crate::time::Timestamp;

/// No world of a trial is there for so long: 292 years.
const END: Timestamp = Timestamp::from_nanos(i64::MAX as u64);

/// Where robots for trials come from.
pub trait Bench<H> {
    /// Creates the robot on this hardware and lets it live in lockstep until the hardware has no more events. Gives the main
    /// outputs of the last cycle that the instance finished, by name.
    ///
    /// # Errors
    /// Where there is no such instance or output, or the instance finished no cycle: why the last one failed stands in the
    /// log of the node.
    fn try_out(&mut self, trial: &Trial<'_, H>) -> Result<BTreeMap<String, serde_json::Value>>;

    /// The value that nodes of a robot on this hardware get for the parameter at this path, with the layers of the hardware's
    /// identities and of the command line.
    ///
    /// # Errors
    /// Where the layers cannot be read, or have nothing at the path.
    fn parameter(&mut self, hardware: &H, path: &str) -> Result<serde_json::Value>;
}

/// One instance under known circumstances.
#[derive(Debug)]
pub struct Trial<'a, H> {
    /// Tells the events that there are.
    pub hardware: Arc<H>,
    /// A stepped clock, that of the hardware.
    pub clock: Clock,
    /// The instance by name.
    pub instance: &'a str,
    /// Main outputs of the instance that get a value in place of their node's.
    pub injected: Vec<(&'a str, serde_json::Value)>,
    /// Main outputs that are not wanted, such as large ones.
    pub left_out: &'a [&'a str],
}

impl<H: Hardware> Trial<'_, H> {
    /// What came of it for this robot.
    pub(crate) fn run<P>(
        &self,
        robot: &mut Robot<P>,
    ) -> Result<BTreeMap<String, serde_json::Value>> {
        robot.instance(self.instance)?;
        let injector = &mut robot.access(self.instance)?.injector;
        for (output, value) in &self.injected {
            injector.inject(output, &Given::from(value))?;
        }
        let mut lockstep = Lockstep::new(robot, self.hardware.as_ref());
        let mut is_finished = false;
        lockstep.run_until(END, |instance| {
            is_finished |= instance.description().name == self.instance;
        })?;
        if !is_finished {
            return Err(Error::new(format!(
                "{} finished no cycle; look above for why its nodes failed",
                self.instance
            )));
        }
        drop(lockstep);
        let outputs = robot.instance(self.instance)?.main_outputs();
        let wanted = outputs.iter().filter(|name| !self.left_out.contains(name));
        wanted
            .map(|name| {
                let value = robot.read(&format!("{}.main_outputs.{name}", self.instance))?;
                Ok(((*name).to_owned(), value))
            })
            .collect()
    }
}
