//! Looks at values while a scenario is played, and says what came of each assertion.

use serde::Serialize;
use serde_json::Value;

use super::assertion::{Assertion, TRUTH, Window};
use crate::cycler::Instance;
use crate::robot;
use crate::time::Timestamp;

/// What came of an assertion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// As the assertion says it.
    pub what: String,
    /// Whether it was so.
    pub passed: bool,
    /// When that was decided, in s: when it was so, or failed to be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<f64>,
    /// What was seen then, or why nothing was.
    pub seen: Value,
}

/// Judges one run.
#[derive(Debug)]
pub struct Judge<'a> {
    assertions: Vec<Looked<'a>>,
}

#[derive(Debug)]
struct Looked<'a> {
    assertion: &'a Assertion,
    window: Window,
    /// What was seen within the window and counts, and when: what decided; else of numbers that always have to be in a
    /// range the one next to its end, of everything else the last.
    seen: Option<(Timestamp, Value)>,
    /// Decided before the end.
    decided: Option<bool>,
}

impl<'a> Judge<'a> {
    /// Of the robot with this number, counted from 1. Nothing has been seen.
    pub fn new(assertions: &'a [Assertion], robot: usize) -> Self {
        let of_robot = assertions
            .iter()
            .filter(|assertion| assertion.robot == robot);
        let assertions = of_robot.map(|assertion| Looked {
            assertion,
            window: assertion.window(),
            seen: None,
            decided: None,
        });
        Self {
            assertions: assertions.collect(),
        }
    }

    /// Looks at an instance that has finished a cycle, and at the truth. Only what some assertion still asks is read.
    pub fn look(&mut self, now: Timestamp, instance: &dyn Instance, truth: impl FnOnce() -> Value) {
        let name = instance.description().name;
        let mut undecided = self.assertions.iter_mut().filter(|one| one.asks(now));
        let mut truth = Some(truth);
        let mut known = None;
        for one in undecided.by_ref() {
            let value = match one.assertion.instance() {
                None => {
                    let truth = known
                        .get_or_insert_with(|| truth.take().map_or(Value::Null, |truth| truth()));
                    Ok(below(truth, &one.assertion.value).cloned())
                }
                Some(of) if of == name => {
                    robot::read_output(instance, &one.assertion.value).map(Some)
                }
                Some(_) => continue,
            };
            // What is not there is told as what was seen.
            let value = match value {
                Ok(Some(value)) => value,
                Ok(None) => Value::from(format!("there is no `{}`", one.assertion.value)),
                Err(error) => Value::from(error.to_string()),
            };
            one.judge(now, value);
        }
    }

    /// Ends the run; in the order of the file.
    pub fn verdicts(self) -> Vec<Verdict> {
        self.assertions.into_iter().map(Looked::verdict).collect()
    }
}

impl Looked<'_> {
    fn asks(&self, now: Timestamp) -> bool {
        self.decided.is_none()
            && match self.window {
                Window::Always { from, until } | Window::Once { from, until } => {
                    from <= now && now <= until
                }
                Window::AtEnd => true,
            }
    }

    fn judge(&mut self, now: Timestamp, value: Value) {
        let condition = self.assertion.condition();
        let holds = condition.holds(&value);
        match self.window {
            Window::Always { .. } if !holds => self.decided = Some(false),
            Window::Once { .. } if holds => self.decided = Some(true),
            Window::Always { .. } => {
                let seen = self.seen.as_ref();
                if seen.is_some_and(|(_, seen)| condition.is_nearer(seen, &value)) {
                    return;
                }
            }
            Window::Once { .. } | Window::AtEnd => {}
        }
        self.seen = Some((now, value));
    }

    fn verdict(self) -> Verdict {
        let holds_at_last = match (&self.seen, self.window) {
            (None, _) | (_, Window::Once { .. }) => false,
            (Some(_), Window::Always { .. }) => true,
            (Some((_, value)), Window::AtEnd) => self.assertion.condition().holds(value),
        };
        let never = || Value::from("nothing: no cycle ended in that time");
        Verdict {
            what: self.assertion.what.clone(),
            passed: self.decided.unwrap_or(holds_at_last),
            at: self
                .seen
                .as_ref()
                .map(|(at, _)| (*at - Timestamp::ZERO).as_secs_f64()),
            seen: self.seen.map_or_else(never, |(_, value)| value),
        }
    }
}

/// The part of the truth that a path names.
fn below<'a>(truth: &'a Value, path: &str) -> Option<&'a Value> {
    let names = path.split('.').skip_while(|name| *name == TRUTH);
    names
        .into_iter()
        .try_fold(truth, |value, name| match value {
            Value::Array(items) => items.get(name.parse::<usize>().ok()?),
            value => value.get(name),
        })
}
