//! What has to be so, and when.

use std::time::Duration;

use serde::Deserialize;
use serde_json::{Number, Value};

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

/// Whether a value is what a file has. There `1` and `1.0` are the same number, and `0.1` is the `f32` next to it, also within
/// lists and tables.
fn is_same(seen: &Value, wanted: &Value) -> bool {
    match (seen, wanted) {
        (Value::Array(seen), Value::Array(wanted)) => {
            let mut pairs = seen.iter().zip(wanted);
            seen.len() == wanted.len() && pairs.all(|(seen, wanted)| is_same(seen, wanted))
        }
        (Value::Object(seen), Value::Object(wanted)) => {
            let mut entries = seen.iter();
            seen.len() == wanted.len()
                && entries.all(|(key, seen)| wanted.get(key).is_some_and(|it| is_same(seen, it)))
        }
        (Value::Number(seen), Value::Number(wanted)) => is_same_number(seen, wanted),
        _ => seen == wanted,
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::float_cmp,
    reason = "it is asked for the very number"
)]
fn is_same_number(seen: &Number, wanted: &Number) -> bool {
    // Large whole numbers are no `f64`.
    if !seen.is_f64() && !wanted.is_f64() {
        return seen == wanted;
    }
    let (Some(number), Some(wanted)) = (seen.as_f64(), wanted.as_f64()) else {
        return false;
    };
    let is_next = || seen.is_f64() && number == f64::from(wanted as f32);
    number == wanted || is_next()
}

#[cfg(test)]
mod tests {
    use serde_json::{json, to_value};

    use super::*;

    fn equals(seen: &Value, wanted: Value) -> bool {
        let is_equal = Condition::Equals(&wanted).holds(seen);
        let is_not = Condition::IsNot(&wanted).holds(seen);
        assert_ne!(is_equal, is_not, "{seen} and {wanted}");
        is_equal
    }

    #[test]
    fn numbers_are_the_same_however_they_are_written_and_wherever_they_lie() {
        assert!(equals(&json!(1.0), json!(1)));
        assert!(equals(&json!([0.0, 0.0]), json!([0, 0])));
        assert!(!equals(&json!([0.0, 0.0]), json!([0, 1])));
        assert!(!equals(&json!([0.0, 0.0]), json!([0])));
        assert!(equals(
            &json!({ "x": 1.0, "y": [2.0] }),
            json!({ "x": 1, "y": [2] })
        ));
        assert!(!equals(&json!({ "x": 1.0 }), json!({ "y": 1 })));
        assert!(!equals(&json!({ "x": 1.0, "y": 1.0 }), json!({ "x": 1 })));
        assert!(!equals(&json!(0.0), json!(null)));
    }

    #[test]
    fn decimals_are_those_that_an_f32_can_have() {
        let seen = to_value(0.1_f32).expect("it has JSON");
        assert!(equals(&seen, json!(0.1)));
        assert!(!equals(&seen, json!(0.100_001)));
        assert!(equals(&json!([seen]), json!([0.1])));
        // An f64 has more of them.
        assert!(!equals(&json!(0.3), json!(0.300_000_001)));
    }

    #[test]
    fn whole_numbers_are_compared_whole() {
        assert!(!equals(&json!(16_777_216), json!(16_777_217)));
        assert!(!equals(&json!(u64::MAX), json!(u64::MAX - 1)));
        assert!(equals(&json!(u64::MAX), json!(u64::MAX)));
    }
}
