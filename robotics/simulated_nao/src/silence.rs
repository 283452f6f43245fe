//! Owns until when a part of the robot says nothing: a camera that drops out, a LoLA that stalls.

use std::time::Duration;

use framework::{Error, Result, Timestamp};
use serde::Deserialize;
use types::camera::CameraPosition;

use crate::per_camera::PerCamera;
use crate::world::IMAGE_LATENCY;

/// What says nothing until then.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Silence {
    cameras: PerCamera<Timestamp>,
    lola: Timestamp,
}

/// A camera without images.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct DropOut {
    pub(crate) camera: CameraPosition,
    /// How long, s.
    pub(crate) lasts: f64,
}

impl Silence {
    /// From now on that camera takes no images.
    ///
    /// # Errors
    /// Where the time is none.
    pub(crate) fn drop_out(&mut self, now: Timestamp, drop_out: DropOut) -> Result<()> {
        *self.cameras.of_mut(drop_out.camera) = now + duration(drop_out.lasts)?;
        Ok(())
    }

    /// From now on LoLA sends no states and takes no commands.
    ///
    /// # Errors
    /// Where the time (s) is none.
    pub(crate) fn stall(&mut self, now: Timestamp, lasts: f64) -> Result<()> {
        self.lola = now + duration(lasts)?;
        Ok(())
    }

    /// Whether that camera takes no image at that time.
    pub(crate) fn covers_exposure(&self, camera: CameraPosition, at: Timestamp) -> bool {
        at < *self.cameras.of(camera)
    }

    /// Whether that camera has no image that is ready at that time.
    pub(crate) fn covers_image(&self, camera: CameraPosition, ready_at: Timestamp) -> bool {
        ready_at < *self.cameras.of(camera) + IMAGE_LATENCY
    }

    /// Whether LoLA does nothing at that time.
    pub(crate) fn covers_tick(&self, at: Timestamp) -> bool {
        at < self.lola
    }
}

/// Of so many seconds.
fn duration(lasts: f64) -> Result<Duration> {
    let is_time = lasts > 0.0;
    let duration = Duration::try_from_secs_f64(lasts).ok();
    duration
        .filter(|_| is_time)
        .ok_or_else(|| Error::new(format!("nothing is silent for {lasts} s")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lasts_no_time_is_no_silence() {
        let mut silence = Silence::default();
        for lasts in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let message = silence.stall(Timestamp::ZERO, lasts).unwrap_err();
            assert!(message.to_string().contains("is silent for"), "{message}");
        }
        assert!(!silence.covers_tick(Timestamp::ZERO));
    }
}
