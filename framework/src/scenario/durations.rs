//! How long cycles take in a scenario, where it says so.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::cycler::InstanceDescription;
use crate::error::{Error, Result};
use crate::time;

/// How long cycles take in virtual time, by the names of their instances; those of all others as the manifest says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Durations(BTreeMap<String, Duration>);

impl Durations {
    /// As a file has them: `{ Camera = "100ms" }`.
    ///
    /// # Errors
    /// Names what is no duration.
    pub(super) fn read(table: &toml::Table) -> Result<Self> {
        let durations = table.iter().map(|(instance, written)| {
            let duration = written.as_str().and_then(|text| time::duration(text).ok());
            let duration = duration.ok_or_else(|| {
                Error::new(format!(
                    "`durations.{instance} = {written}` is no duration: expected e.g. \"100ms\" or \"0.5s\""
                ))
            })?;
            Ok((instance.clone(), duration))
        });
        durations.collect::<Result<_>>().map(Self)
    }

    /// With those of `later` over these.
    pub(super) fn under(&self, later: &Self) -> Self {
        let all = self.0.iter().chain(&later.0);
        Self(
            all.map(|(name, duration)| (name.clone(), *duration))
                .collect(),
        )
    }

    /// What is said of an instance.
    pub fn of(&self, instance: &InstanceDescription) -> Option<Duration> {
        self.0.get(instance.name).copied()
    }

    /// Whether each of them is that of an instance.
    ///
    /// # Errors
    /// Names the first that is none, and the instances.
    pub(super) fn check(&self, instances: &[&str]) -> Result<()> {
        let mut names = self.0.keys();
        let Some(unknown) = names.find(|name| !instances.contains(&name.as_str())) else {
            return Ok(());
        };
        Err(Error::new(format!(
            "`durations.{unknown}`: no instance `{unknown}`; there are {}",
            instances.join(", ")
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Durations> {
        Durations::read(&toml::from_str(text).expect("it is TOML"))
    }

    #[test]
    fn later_ones_stand_over_earlier_ones() {
        let earlier = read("Left = '100ms'\nRight = '20ms'").expect("they are durations");
        let later = read("Right = '0.3s'").expect("it is one");
        let expected = read("Left = '100ms'\nRight = '300ms'").expect("they are durations");
        assert_eq!(earlier.under(&later), expected);
    }

    #[test]
    fn what_is_no_duration_or_no_instance_is_named() {
        for wrong in ["Left = 100", "Left = '100'", "Left = 'soon'", "Left = {}"] {
            let message = read(wrong).expect_err("it is none").to_string();
            let expected = "is no duration: expected e.g. \"100ms\"";
            assert!(message.contains("`durations.Left = "), "{message}");
            assert!(message.contains(expected), "{message}");
        }
        let known = read("Left = '1ms'").expect("it is one");
        known.check(&["Right", "Left"]).expect("there is one");
        let message = known.check(&["LeftEye", "Ear"]).expect_err("there is none");
        assert_eq!(
            message.to_string(),
            "`durations.Left`: no instance `Left`; there are LeftEye, Ear"
        );
    }
}
