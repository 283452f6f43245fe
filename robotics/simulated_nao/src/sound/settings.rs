//! How loud it is, and when the referee whistles.

use framework::{Error, Result};
use serde::Deserialize;

/// The choices; every key may be left out.
#[derive(Clone, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SoundSettings {
    /// Another seed is another crowd and other whistles.
    pub seed: u64,
    /// Root mean square of the crowd, share of full scale.
    pub noise_level: f64,
    /// When a whistle begins, s since the start of the run, in order.
    pub whistles: Vec<f64>,
    /// In place of `whistles`: one begins every so many s, the first after as many.
    pub whistle_every: Option<f64>,
    /// How long each whistle sounds, s.
    pub whistle_duration: f64,
    /// Amplitude of each whistle, share of full scale. The loudest shouts are twice as loud as the
    /// crowd: whistles should be four times as loud, or may be drowned.
    pub whistle_level: f64,
}

/// A whistle that really sounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhistleTruth {
    /// Counted from 0.
    pub number: u64,
    /// In s since the start of the run.
    pub begins_at: f64,
    /// In s.
    pub duration: f64,
    /// Amplitude, share of full scale.
    pub level: f64,
}

impl Default for SoundSettings {
    /// No whistle; the rest as loud as at a game.
    fn default() -> Self {
        Self {
            seed: 1,
            noise_level: 0.05,
            whistles: Vec::new(),
            whistle_every: None,
            whistle_duration: 0.7,
            whistle_level: 0.4,
        }
    }
}

impl SoundSettings {
    /// Refuses sounds that there cannot be.
    ///
    /// # Errors
    /// Names the key.
    pub fn check(&self) -> Result<()> {
        in_range("noise_level", self.noise_level, 0.0, 1.0)?;
        in_range("whistle_level", self.whistle_level, 0.0, 1.0)?;
        in_range("whistle_duration", self.whistle_duration, 0.1, 10.0)?;
        for &time in &self.whistles {
            in_range("whistles", time, 0.0, 1e9)?;
        }
        let mut pairs = self.whistles.windows(2);
        if let Some(pair) = pairs.find(|pair| pair[1] - pair[0] < self.whistle_duration) {
            return Err(Error::new(format!(
                "hardware.simulated.sound.whistles: {} must come after {} and after that whistle's \
                 {} s",
                pair[1], pair[0], self.whistle_duration
            )));
        }
        let Some(every) = self.whistle_every else {
            return Ok(());
        };
        in_range("whistle_every", every, self.whistle_duration, 1e9)?;
        if !self.whistles.is_empty() {
            return Err(Error::new(
                "hardware.simulated.sound: `whistles` and `whistle_every` exclude each other; leave one out",
            ));
        }
        Ok(())
    }

    /// Every whistle in order; endless with `whistle_every`.
    pub fn whistles(&self) -> impl Iterator<Item = WhistleTruth> {
        (0..).map_while(|number| self.whistle(number))
    }

    /// The whistles that sound at any time from `begin` to `end`, s.
    pub(super) fn whistles_between(
        &self,
        begin: f64,
        end: f64,
    ) -> impl Iterator<Item = WhistleTruth> {
        let first = match self.whistle_every {
            Some(every) => ((begin - self.whistle_duration) / every - 1.0).max(0.0) as u64,
            None => {
                self.whistles
                    .partition_point(|at| at + self.whistle_duration < begin) as u64
            }
        };
        (first..)
            .map_while(|number| self.whistle(number))
            .take_while(move |truth| truth.begins_at < end)
    }

    /// Of whistles that somebody called for, those that sound at any time from `begin` to `end`, s.
    pub(super) fn called_between(
        &self,
        called: &[f64],
        begin: f64,
        end: f64,
    ) -> impl Iterator<Item = WhistleTruth> {
        let sounds = move |at: f64, duration: f64| at < end && begin <= at + duration;
        (0..)
            .zip(called)
            .filter(move |(_, at)| sounds(**at, self.whistle_duration))
            .map(|(number, at)| WhistleTruth {
                number,
                begins_at: *at,
                duration: self.whistle_duration,
                level: self.whistle_level,
            })
    }

    fn whistle(&self, number: u64) -> Option<WhistleTruth> {
        let begins_at = match self.whistle_every {
            Some(every) => every * (number as f64 + 1.0),
            None => *self.whistles.get(usize::try_from(number).ok()?)?,
        };
        Some(WhistleTruth {
            number,
            begins_at,
            duration: self.whistle_duration,
            level: self.whistle_level,
        })
    }
}

/// Refuses NaN too.
fn in_range(key: &str, value: f64, least: f64, most: f64) -> Result<()> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(Error::new(format!(
        "hardware.simulated.sound.{key}: {value} is not from {least} to {most}"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(text: &str) -> Result<SoundSettings> {
        let settings: SoundSettings =
            toml::from_str(text).map_err(|error| Error::new(error.to_string()))?;
        settings.check()?;
        Ok(settings)
    }

    fn begins(whistles: impl Iterator<Item = WhistleTruth>) -> Vec<f64> {
        whistles.map(|truth| truth.begins_at).collect()
    }

    #[test]
    fn whistles_sound_when_they_should() {
        let listed = settings("whistles = [12.0, 40.5]").unwrap();
        assert_eq!(begins(listed.whistles()), [12.0, 40.5]);
        assert_eq!(begins(listed.whistles_between(12.6, 40.5)), [12.0]);
        assert_eq!(begins(listed.whistles_between(12.8, 40.6)), [40.5]);

        let repeated = settings("whistle_every = 20.0").unwrap();
        assert_eq!(begins(repeated.whistles().take(3)), [20.0, 40.0, 60.0]);
        let far = repeated.whistles_between(20_000.5, 20_000.6);
        assert!(begins(far).contains(&20_000.0));
        let none = repeated.whistles_between(30.0, 30.1);
        assert!(
            none.into_iter()
                .all(|truth| truth.begins_at + truth.duration < 30.0)
        );

        assert_eq!(SoundSettings::default().whistles().count(), 0);
    }

    #[test]
    fn a_wrong_key_is_named() {
        for (text, expected) in [
            ("noise = 1.0", "unknown field `noise`"),
            ("seed = -1", "-1"),
            (
                "noise_level = 1.5",
                "sound.noise_level: 1.5 is not from 0 to 1",
            ),
            ("noise_level = nan", "sound.noise_level: NaN"),
            ("whistle_level = -0.1", "sound.whistle_level"),
            ("whistle_duration = 0.0", "sound.whistle_duration"),
            ("whistles = [-1.0]", "sound.whistles: -1"),
            ("whistles = [5.0, 4.0]", "4 must come after 5"),
            ("whistle_every = 0.1", "sound.whistle_every: 0.1"),
            (
                "whistle_every = 9.0\nwhistles = [1.0]",
                "exclude each other",
            ),
        ] {
            let message = settings(text).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
    }
}
