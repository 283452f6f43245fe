//! Numbers of the world that a seed changes.

use crate::error::{Error, Result};
use crate::split_mix::SplitMix;

/// Draws changes from a seed.
pub(super) struct Draw(SplitMix);

impl Draw {
    pub(super) fn new(seed: u64) -> Self {
        Self(SplitMix::new(seed))
    }

    /// A number from 0 to 1.
    pub(super) fn share(&mut self) -> f64 {
        f64::midpoint(self.0.signed(), 1.0)
    }

    /// A whole number from `-spread` to `spread`.
    fn whole(&mut self, spread: i64) -> i64 {
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            reason = "what a world is made of is small"
        )]
        let drawn = (spread as f64 * self.0.signed()).round() as i64;
        drawn
    }

    /// Moves every number that `spread` names by up to so much. Whole numbers stay whole where the spread is whole.
    pub(super) fn change(&mut self, table: &mut toml::Table, spread: &toml::Table) -> Result<()> {
        for (key, spread) in spread {
            let value = table
                .get_mut(key)
                .ok_or_else(|| Error::new(format!("there is no `{key}` that could be changed")))?;
            self.change_value(value, spread)
                .map_err(|error| error.context(format!("`{key}`")))?;
        }
        Ok(())
    }

    fn change_value(&mut self, value: &mut toml::Value, spread: &toml::Value) -> Result<()> {
        match (value, spread) {
            (toml::Value::Table(table), toml::Value::Table(spread)) => self.change(table, spread),
            (toml::Value::Array(values), toml::Value::Array(spreads))
                if values.len() == spreads.len() =>
            {
                values
                    .iter_mut()
                    .zip(spreads)
                    .try_for_each(|(value, spread)| self.change_value(value, spread))
            }
            (toml::Value::Integer(whole), toml::Value::Integer(spread)) => {
                *whole = whole.saturating_add(self.whole(*spread));
                Ok(())
            }
            (value, spread) => {
                let (Some(number), Some(spread)) = (number(value), number(spread)) else {
                    return Err(Error::new(format!(
                        "{value} cannot be changed by up to {spread}: expected two numbers, or lists of as many"
                    )));
                };
                *value = toml::Value::Float(number + spread * self.0.signed());
                Ok(())
            }
        }
    }
}

fn number(value: &toml::Value) -> Option<f64> {
    match value {
        toml::Value::Float(number) => Some(*number),
        #[expect(
            clippy::cast_precision_loss,
            reason = "what a world is made of is small"
        )]
        toml::Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
}
