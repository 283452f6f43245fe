//! What instances are recorded while it is true: a `bool` in a main output of the same or another instance.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::output::shape_of;
use crate::cycler::{Instance, InstanceDescription, Record};
use crate::error::{Error, Result};
use crate::reflect::{self, Content, Leaf, Path, Shape, binary};
use crate::robot::Robot;

/// The conditions of all instances.
pub(super) struct Conditions {
    /// By the instance whose cycles depend on it.
    holds: BTreeMap<&'static str, Arc<AtomicBool>>,
    /// By the instance that is asked.
    asked: BTreeMap<&'static str, Vec<Condition>>,
}

/// A `bool` in a main output, for whoever records while it is true.
pub(super) struct Condition {
    output: &'static str,
    below: Path,
    holds: Arc<AtomicBool>,
    bytes: Vec<u8>,
}

impl Conditions {
    /// # Errors
    /// If one names what its instance never writes, or what is no `bool`.
    pub(super) fn of_all<P>(robot: &Robot<P>, all: &[InstanceDescription]) -> Result<Self> {
        let mut conditions = Self {
            holds: BTreeMap::new(),
            asked: BTreeMap::new(),
        };
        for one in all {
            let Record::While { instance, path } = one.record else {
                continue;
            };
            let holds = Arc::<AtomicBool>::default();
            conditions.holds.insert(one.name, holds.clone());
            if robot.left_out.contains(&instance) {
                continue;
            }
            let condition = Condition::new(robot, instance, path, holds).map_err(|error| {
                let name = one.name;
                error.context(format!(
                    "`{name}` is recorded while `{path}` of `{instance}` is true"
                ))
            })?;
            let asked = conditions.asked.entry(instance).or_default();
            asked.push(condition);
        }
        Ok(conditions)
    }

    /// Whether this instance is to be recorded now.
    pub(super) fn of(&self, instance: &str) -> Arc<AtomicBool> {
        self.holds.get(instance).cloned().unwrap_or_default()
    }

    /// What is asked of this instance's outputs, once.
    pub(super) fn asked_of(&mut self, instance: &str) -> Vec<Condition> {
        self.asked.remove(instance).unwrap_or_default()
    }
}

impl Condition {
    fn new<P>(
        robot: &Robot<P>,
        instance: &'static str,
        path: &str,
        holds: Arc<AtomicBool>,
    ) -> Result<Self> {
        let asked = robot.instance(instance)?;
        let outputs = asked.main_outputs();
        let begins = |output: &&&str| {
            let rest = path.strip_prefix(**output);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        // Names of outputs may have dots themselves, so the longest is the output.
        let output = outputs.iter().filter(begins).max_by_key(|name| name.len());
        let output = output.ok_or_else(|| {
            let there = outputs.join(", ");
            Error::new(format!("it writes no such output; there are {there}"))
        })?;
        let below = path[output.len()..].trim_start_matches('.').parse()?;
        let accesses = &robot.access;
        if let Some(access) = accesses.iter().find(|one| one.instance == instance) {
            let whole = format!("{instance}.main_outputs.{output}");
            if let Some((shape, _)) = shape_of(asked, &access.subscriptions, &whole) {
                must_be_bool(&shape, &below)?;
            }
        }
        Ok(Self {
            output,
            below,
            holds,
            bytes: Vec::with_capacity(1),
        })
    }

    /// Looks at the last finished cycle; what is no `bool` now does not hold.
    pub(super) fn look(&mut self, instance: &dyn Instance) {
        self.bytes.clear();
        let value = instance.main_output(self.output);
        let value = value.and_then(|value| reflect::at(value, &self.below).ok());
        let is_encoded = value.is_some_and(|value| binary::encode(value, &mut self.bytes).is_ok());
        let holds = is_encoded && self.bytes == [1];
        self.holds.store(holds, Ordering::Relaxed);
    }
}

/// Of what has a form of its own nobody knows it before it is there.
fn must_be_bool(output: &Shape, below: &Path) -> Result<()> {
    let Some(found) = output.known_at(below) else {
        return Ok(());
    };
    let found = found?;
    match found.content {
        Content::Leaf(Leaf::Bool) => Ok(()),
        _ if found.is_opaque() => Ok(()),
        _ => Err(Error::new(format!(
            "that is `{}` and no `bool`; name an output of type `bool`, or a part of one",
            found.type_name
        ))),
    }
}
