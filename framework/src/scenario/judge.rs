//! Looks at values while a scenario is played, and says what came of each assertion.

use std::cell::LazyCell;

use serde::Serialize;
use serde_json::{Value, json};

use super::assertion::{Assertion, TRUTH, Window, distance};
use crate::cycler::Instance;
use crate::error::{Error, Result};
use crate::parameters::nearest;
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
    /// Whether it was so when it was looked at for the last time.
    held: bool,
    /// Decided before the end.
    decided: Option<bool>,
    /// Where a share decides.
    counted: Counted,
    /// What was seen of the truth at which moments count.
    only_while: Seen,
}

/// Whether a truth can be one by which moments count.
#[derive(Debug, Default, PartialEq)]
enum Seen {
    /// It may still come: nothing was seen, or no value.
    #[default]
    Nothing,
    /// It was `true` or `false` once.
    Usable,
    /// Why it cannot.
    Wrong(String),
}

/// How often something was looked at.
#[derive(Debug, Default)]
struct Counted {
    held: usize,
    /// What was seen; infinite where it was no number.
    seen: Vec<f64>,
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
            held: false,
            decided: None,
            counted: Counted::default(),
            only_while: Seen::Nothing,
        });
        Self {
            assertions: assertions.collect(),
        }
    }

    /// Looks at an instance that has finished a cycle, and at the truth. Only what some assertion still asks is read.
    pub fn look(&mut self, now: Timestamp, instance: &dyn Instance, truth: impl FnOnce() -> Value) {
        let name = instance.description().name;
        let mut undecided = self.assertions.iter_mut().filter(|one| one.asks(now));
        let truth = LazyCell::new(truth);
        for one in undecided.by_ref() {
            let value = match one.assertion.instance() {
                None => Ok(below(&truth, &one.assertion.value).cloned()),
                Some(of) if of == name => {
                    robot::read_output(instance, &one.assertion.value).map(Some)
                }
                Some(_) => continue,
            };
            // What nobody asks for stays unread.
            if one.assertion.only_while.is_some() && !one.counts_while(&truth) {
                continue;
            }
            let value = value.and_then(|value| match &one.assertion.apart_from {
                Some(path) => apart(&one.assertion.value, value, path, &truth),
                None => Ok(value),
            });
            let condition = one.assertion.condition();
            // What is not there is told as what was seen.
            let (holds, value) = match value {
                Ok(Some(value)) => (condition.holds(&value), value),
                Ok(None) => {
                    let text = format!("there is no `{}`", one.assertion.value);
                    (condition.holds_without(), text.into())
                }
                Err(error) => {
                    let path = &one.assertion.value;
                    let may_come =
                        one.assertion.instance().is_none() || robot::may_have(instance, path);
                    let holds = condition.holds_without() && may_come;
                    (holds, error.to_string().into())
                }
            };
            one.judge(now, value, holds);
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
                Window::Always { from, until }
                | Window::Once { from, until }
                | Window::Mostly { from, until, .. } => from <= now && now <= until,
                Window::AtEnd => true,
            }
    }

    /// Whether this moment counts.
    fn counts_while(&mut self, truth: &Value) -> bool {
        let Some(path) = &self.assertion.only_while else {
            return true;
        };
        match below(truth, path) {
            Some(Value::Bool(counts)) => {
                self.only_while = Seen::Usable;
                return *counts;
            }
            Some(Value::Null) => {}
            found if self.only_while == Seen::Nothing => {
                let why = match found {
                    Some(other) => Some(format!("`{path}` is {other}, neither true nor false")),
                    None => missing(truth, path),
                };
                self.only_while = why.map_or(Seen::Nothing, Seen::Wrong);
            }
            _ => {}
        }
        false
    }

    fn judge(&mut self, now: Timestamp, value: Value, holds: bool) {
        let condition = self.assertion.condition();
        self.held = holds;
        match self.window {
            Window::Always { .. } if !holds => self.decided = Some(false),
            Window::Once { .. } if holds => self.decided = Some(true),
            Window::Always { .. } => {
                let seen = self.seen.as_ref();
                if seen.is_some_and(|(_, seen)| condition.is_nearer(seen, &value)) {
                    return;
                }
            }
            Window::Mostly { .. } => {
                self.counted.held += usize::from(holds);
                self.counted
                    .seen
                    .push(value.as_f64().unwrap_or(f64::INFINITY));
            }
            Window::Once { .. } | Window::AtEnd => {}
        }
        self.seen = Some((now, value));
    }

    fn verdict(mut self) -> Verdict {
        if let Window::Mostly { share, .. } = self.window
            && let Some((_, value)) = &mut self.seen
        {
            let seen = self.counted.share();
            *value = json!({ "share": seen, "median": self.counted.median() });
            self.decided = Some(seen >= share);
        }
        let holds_at_last = match (&self.seen, self.window) {
            (None, _) | (_, Window::Once { .. } | Window::Mostly { .. }) => false,
            (Some(_), Window::Always { .. }) => true,
            (Some(_), Window::AtEnd) => self.held,
        };
        let only_while = self.assertion.only_while.as_ref();
        let only_while = only_while.map_or_else(String::new, |path| format!(" while `{path}`"));
        let never = || match &self.only_while {
            Seen::Wrong(why) => format!("nothing: {why}").into(),
            Seen::Nothing | Seen::Usable => {
                format!("nothing: no cycle ended in that time{only_while}").into()
            }
        };
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

impl Counted {
    fn share(&self) -> f64 {
        self.held as f64 / self.seen.len().max(1) as f64
    }

    /// `None` where the middle one was no number.
    fn median(&mut self) -> Option<f64> {
        self.seen.sort_by(f64::total_cmp);
        let middle = self.seen.get(self.seen.len() / 2)?;
        middle.is_finite().then_some(*middle)
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

/// How far a value and a truth are apart; `None` where there is no value.
fn apart(name: &str, value: Option<Value>, path: &str, truth: &Value) -> Result<Option<Value>> {
    let Some(value) = value.filter(|value| !value.is_null()) else {
        return Ok(None);
    };
    let Some(truth) = below(truth, path).filter(|truth| !truth.is_null()) else {
        let absent = || format!("there is no `{path}`");
        return Err(Error::new(missing(truth, path).unwrap_or_else(absent)));
    };
    let apart = distance(&value, truth).ok_or_else(|| {
        Error::new(format!(
            "`{name}` is {value} and `{path}` is {truth}: expected two numbers, or two lists of as many numbers"
        ))
    })?;
    Ok(Some(apart.into()))
}

/// That there is no such truth, unless it lies in one without a value, where it may come.
fn missing(truth: &Value, path: &str) -> Option<String> {
    let mut known = TRUTH.to_owned();
    let mut value = truth;
    for name in path.split('.').skip_while(|name| *name == TRUTH) {
        let (next, names): (_, Vec<&str>) = match value {
            Value::Null => return None,
            Value::Array(items) => {
                let index = name.parse::<usize>().ok();
                (index.and_then(|index| items.get(index)), Vec::new())
            }
            value => {
                let entries = value.as_object().into_iter().flatten();
                (
                    value.get(name),
                    entries.map(|(key, _)| key.as_str()).collect(),
                )
            }
        };
        let Some(next) = next else {
            let hint = match (nearest(name, names.iter().copied()), names.as_slice()) {
                (Some(near), _) => format!("; did you mean `{known}.{near}`?"),
                (None, []) => String::new(),
                (None, _) => format!("; `{known}` has {}", names.join(", ")),
            };
            return Some(format!("there is no `{path}`{hint}"));
        };
        known = format!("{known}.{name}");
        value = next;
    }
    None
}
