//! What has to be so, and when.

use std::time::Duration;

use serde::Deserialize;
use serde_json::Value;

use super::file::{first, in_order, seconds, within_run};
use crate::error::{Error, Result};
use crate::reflect::Path;
use crate::time::Timestamp;

/// One `[[assertion]]`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Assertion {
    /// For people.
    pub what: String,
    /// `truth.…`, or an output: `Control.main_outputs.lamp.level`.
    pub value: String,
    /// Whose, counted from 1.
    #[serde(default = "first")]
    pub robot: usize,
    /// A truth; what counts is how far apart the value and it are.
    pub apart_from: Option<String>,
    /// A truth; only looks at moments at which it is `true` count.
    #[serde(rename = "while")]
    pub only_while: Option<String>,
    equals: Option<Value>,
    is_not: Option<Value>,
    is_there: Option<bool>,
    below: Option<f64>,
    above: Option<f64>,
    from: Option<f64>,
    until: Option<f64>,
    before: Option<f64>,
    share: Option<f64>,
    #[serde(default)]
    at_end: bool,
}

/// What a value has to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Condition<'a> {
    /// Exactly this.
    Equals(&'a Value),
    /// Anything else.
    IsNot(&'a Value),
    /// Something (`true`), or `None` (`false`).
    IsThere(bool),
    /// A number between these.
    Between {
        /// It is more.
        above: Option<f64>,
        /// It is less.
        below: Option<f64>,
    },
}

/// When it has to be so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Window {
    /// Whenever it is looked at between these, at least once.
    Always {
        /// Not before.
        from: Timestamp,
        /// Not after.
        until: Timestamp,
    },
    /// Once between these.
    Once {
        /// Not before.
        from: Timestamp,
        /// Not after.
        until: Timestamp,
    },
    /// In so many of all looks between these.
    Mostly {
        /// Not before.
        from: Timestamp,
        /// Not after.
        until: Timestamp,
        /// Of the looks, 0 to 1.
        share: f64,
    },
    /// When it is looked at for the last time.
    AtEnd,
}

impl Assertion {
    /// What the value has to be.
    pub fn condition(&self) -> Condition<'_> {
        match (&self.equals, &self.is_not, self.is_there) {
            (Some(value), _, _) => Condition::Equals(value),
            (None, Some(value), _) => Condition::IsNot(value),
            (None, None, Some(is_there)) => Condition::IsThere(is_there),
            (None, None, None) => Condition::Between {
                above: self.above,
                below: self.below,
            },
        }
    }

    /// When.
    pub fn window(&self) -> Window {
        let time = |seconds: f64| {
            let since_start = Duration::try_from_secs_f64(seconds).unwrap_or_default();
            Timestamp::ZERO + since_start
        };
        let from = self.from.map_or(Timestamp::ZERO, time);
        let until = self.until.map_or(Timestamp::NEVER, time);
        match (self.at_end, self.before, self.share) {
            (true, _, _) => Window::AtEnd,
            (false, Some(before), _) => Window::Once {
                from,
                until: time(before),
            },
            (false, None, Some(share)) => Window::Mostly { from, until, share },
            (false, None, None) => Window::Always { from, until },
        }
    }

    /// The instance whose output it is; `None`: a truth.
    pub fn instance(&self) -> Option<&str> {
        self.value
            .split_once('.')
            .map(|(first, _)| first)
            .filter(|first| *first != TRUTH)
    }

    pub(super) fn check(&self, ends: Duration) -> Result<()> {
        let wrong = |message: String| {
            Err(Error::new(message).context(format!("assertion `{}`", self.what)))
        };
        let ranges = self.below.is_some() || self.above.is_some();
        let conditions = [
            self.equals.is_some(),
            self.is_not.is_some(),
            self.is_there.is_some(),
            ranges,
        ];
        if conditions.iter().filter(|it| **it).count() != 1 {
            return wrong(
                "expected one of `equals`, `is_not`, `is_there`, `below` and `above` (these two may stand together)".to_owned(),
            );
        }
        let windows = [self.at_end, self.before.is_some(), self.until.is_some()];
        if windows.iter().filter(|it| **it).count() > 1 || (self.at_end && self.from.is_some()) {
            return wrong("`before`, `until` and `at_end` exclude each other".to_owned());
        }
        if let Some(share) = self.share {
            if self.at_end || self.before.is_some() {
                return wrong("`share` goes with neither `before` nor `at_end`".to_owned());
            }
            if !(share > 0.0 && share <= 1.0) {
                return wrong(format!(
                    "`share = {share}` is no share of the looks: expected more than 0, up to 1"
                ));
            }
        }
        if let Some(path) = &self.apart_from
            && (!ranges || !is_truth(path))
        {
            return wrong(format!(
                "`apart_from = \"{path}\"`: expected a truth (`truth.NAME`), with `below` or `above`"
            ));
        }
        if let Some(path) = &self.only_while
            && !is_truth(path)
        {
            return wrong(format!(
                "`while = \"{path}\"`: expected a truth (`truth.NAME`) that is `true` or `false`"
            ));
        }
        self.check_times(ends)
            .map_err(|error| error.context(format!("assertion `{}`", self.what)))?;
        if self.value.parse::<Path>().is_err() || !self.value.contains('.') {
            return wrong(format!(
                "`{}` is no value: expected `truth.NAME` or an output like `Control.main_outputs.NAME`",
                self.value
            ));
        }
        Ok(())
    }
}

impl Assertion {
    /// A time in which nothing is looked at would be told of only when all is played.
    fn check_times(&self, ends: Duration) -> Result<()> {
        let later = [("until", self.until), ("before", self.before)];
        for (key, number) in later.into_iter().chain([("from", self.from)]) {
            within_run(key, number, ends)?;
        }
        let from = self.from.unwrap_or_default();
        for (key, number) in later {
            in_order(from, key, number)?;
        }
        match self.from {
            Some(from) if seconds("from", from)? == ends => Err(Error::new(format!(
                "`from = {from}` is the end: say `at_end = true` for what has to be so then"
            ))),
            _ => Ok(()),
        }
    }
}

/// What paths of the hardware's truths begin with.
pub(super) const TRUTH: &str = "truth";

fn is_truth(path: &str) -> bool {
    path.starts_with("truth.") && path.parse::<Path>().is_ok()
}

impl Condition<'_> {
    /// Whether a value is so.
    pub fn holds(&self, value: &Value) -> bool {
        match self {
            Self::Equals(wanted) => is_same(value, wanted),
            Self::IsNot(unwanted) => !is_same(value, unwanted),
            Self::IsThere(is_there) => value.is_null() != *is_there,
            Self::Between { above, below } => value.as_f64().is_some_and(|number| {
                above.is_none_or(|above| number > above) && below.is_none_or(|below| number < below)
            }),
        }
    }
}

impl Condition<'_> {
    /// Whether it is so where there is nothing to look at: that is anything but a value, but no `Option` without one.
    pub(super) fn holds_without(&self) -> bool {
        matches!(self, Self::IsNot(_))
    }

    /// Whether one number lies nearer to an end of the range than another; both lie within.
    pub(super) fn is_nearer(&self, one: &Value, other: &Value) -> bool {
        let Self::Between { above, below } = self else {
            return false;
        };
        let room = |value: &Value| {
            let number = value.as_f64().unwrap_or_default();
            let above = above.map_or(f64::INFINITY, |above| number - above);
            above.min(below.map_or(f64::INFINITY, |below| below - number))
        };
        room(one) <= room(other)
    }
}

/// How far apart two numbers are, or two lists of as many numbers, as if they were places.
pub(super) fn distance(one: &Value, other: &Value) -> Option<f64> {
    if let (Some(one), Some(other)) = (one.as_f64(), other.as_f64()) {
        return Some((one - other).abs());
    }
    let (one, other) = (one.as_array()?, other.as_array()?);
    let mut pairs = one.iter().zip(other);
    let squares: Option<f64> = pairs
        .by_ref()
        .map(|(one, other)| Some((one.as_f64()? - other.as_f64()?).powi(2)))
        .sum();
    squares.filter(|_| one.len() == other.len()).map(f64::sqrt)
}

/// `1` and `1.0` are the same number.
fn is_same(value: &Value, other: &Value) -> bool {
    match (value.as_f64(), other.as_f64()) {
        (Some(value), Some(other)) => value == other,
        _ => value == other,
    }
}
