//! A robot that was put together: its instances, and the ends that clients hold.

use crate::clock::Clock;
use crate::cycler::Instance;
use crate::error::{Error, Result};
use crate::injection::Inject;
use crate::parameters::LiveParameters;
use crate::procedure::CallAny;
use crate::reflect;
use crate::remote::Feed;
use crate::stop::Stop;
use crate::subscriptions::Subscriptions;

/// What the generated `create` needs besides the hardware.
#[derive(Clone, Debug)]
pub struct Start<P> {
    /// The one clock of the robot: wall for threads, stepped for lockstep.
    pub clock: Clock,
    /// Ends the run.
    pub stop: Stop,
    /// The parameters at the start.
    pub parameters: P,
}

/// All instances of one robot, ready for a driver.
pub struct Robot<P> {
    /// As in the manifest.
    pub name: &'static str,
    /// The clock that `create` was given.
    pub clock: Clock,
    /// In manifest order.
    pub instances: Vec<Box<dyn Instance>>,
    /// What clients may do with each instance, in the same order.
    pub access: Vec<Access>,
    /// Instances that do not run here, in a partial robot or because another machine runs them: the hardware may have
    /// events for them, and nothing comes of those.
    pub left_out: &'static [&'static str],
    /// What stands in for instances that another machine runs, in manifest order: none was ever written until it is fed.
    pub remotes: Vec<Box<dyn Feed>>,
    /// The parameters: what is changed here, every instance sees from its next `begin` on.
    pub parameters: LiveParameters<P>,
}

/// What clients may do with one instance while a driver has it.
pub struct Access {
    /// The instance's name.
    pub instance: &'static str,
    /// Who listens to its additional outputs.
    pub subscriptions: Subscriptions,
    /// Replaces its main outputs.
    pub injector: Box<dyn Inject>,
    /// Calls that its nodes answer, by name.
    pub procedures: Vec<(&'static str, Box<dyn CallAny>)>,
}

impl<P> Robot<P> {
    /// The instance with this name.
    pub fn instance(&self, name: &str) -> Result<&dyn Instance> {
        let found = self
            .instances
            .iter()
            .find(|instance| instance.description().name == name);
        found.map(Box::as_ref).ok_or_else(|| {
            let known: Vec<_> = self
                .instances
                .iter()
                .map(|instance| instance.description().name)
                .collect();
            Error::new(format!(
                "no instance `{name}`; there are {}",
                known.join(", ")
            ))
        })
    }

    /// What clients may do with the instance of this name.
    pub fn access(&mut self, instance: &str) -> Result<&mut Access> {
        let found = self
            .access
            .iter_mut()
            .find(|access| access.instance == instance);
        found.ok_or_else(|| Error::new(format!("no instance `{instance}`")))
    }

    /// A value of the last finished cycle: `VisionTop.main_outputs.balls`, `Control.additional_outputs.filter.residual`.
    pub fn read(&self, path: &str) -> Result<serde_json::Value> {
        let (instance, _) = path.split_once('.').ok_or_else(|| unknown(path))?;
        read_output(self.instance(instance)?, path)
    }
}

/// As [`Robot::read`], of the instance that the path begins with.
pub(crate) fn read_output(instance: &dyn Instance, path: &str) -> Result<serde_json::Value> {
    let mut parts = path.splitn(3, '.').skip(1);
    let (Some(part), Some(rest)) = (parts.next(), parts.next()) else {
        return Err(unknown(path));
    };
    // Names of outputs may have dots themselves, so the longest that is known is the output.
    let mut end = rest.len();
    loop {
        let name = &rest[..end];
        let output = match part {
            "main_outputs" => instance.main_output(name),
            "additional_outputs" => instance.additional_output(name),
            _ => return Err(unknown(path)),
        };
        if let Some(output) = output {
            let below = rest[end..].trim_start_matches('.');
            return read_below(output, below).map_err(|error| error.context(format!("`{path}`")));
        }
        end = name
            .rfind('.')
            .ok_or_else(|| absent(instance, part, rest))?;
    }
}

/// Whether a path that is no value now can be one in another cycle: a main output that there is not never will.
pub(crate) fn may_have(instance: &dyn Instance, path: &str) -> bool {
    let mut parts = path.splitn(3, '.').skip(1);
    let (Some(part), Some(rest)) = (parts.next(), parts.next()) else {
        return false;
    };
    let mut main = instance.main_outputs().iter();
    match part {
        "main_outputs" => main.any(|name| {
            let below = rest.strip_prefix(name);
            below.is_some_and(|below| below.is_empty() || below.starts_with('.'))
        }),
        // Whether there is one is told by nobody while it is not computed.
        "additional_outputs" => true,
        _ => false,
    }
}

fn unknown(path: &str) -> Error {
    Error::new(format!(
        "no `{path}`: expected `Instance.main_outputs.name` or `Instance.additional_outputs.name`"
    ))
}

fn read_below(output: &dyn reflect::Reflect, path: &str) -> Result<serde_json::Value> {
    let value = if path.is_empty() {
        output
    } else {
        reflect::at(output, &path.parse()?)?
    };
    Ok(serde_json::to_value(value.as_serialize())?)
}

fn absent(instance: &dyn Instance, part: &str, name: &str) -> Error {
    let instance_name = instance.description().name;
    match part {
        "main_outputs" => Error::new(format!(
            "`{instance_name}` has no main output `{name}`; it has {}",
            instance.main_outputs().join(", ")
        )),
        _ => Error::new(format!(
            "`{instance_name}` has no additional output `{name}`, or nobody was subscribed to it"
        )),
    }
}
