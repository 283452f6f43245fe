//! How much of the server's time images may take: compressing is the one thing that clients can ask for which takes
//! milliseconds, and whoever asks for less must not wait for it.

use std::time::{Duration, Instant};

use framework::reflect::{Image, Reflect, Shape};

use crate::jpeg;

/// Of the server's time.
const SHARE: f64 = 0.5;

/// Seconds: what was not used is kept so long.
const KEPT: f64 = 0.1;

/// Compresses images, as long as there is time for it.
pub(crate) struct Press {
    /// Seconds; less than nothing where an image took longer than there was time.
    left: f64,
    looked: Instant,
}

impl Press {
    pub(crate) fn new() -> Self {
        Self {
            left: KEPT,
            looked: Instant::now(),
        }
    }

    /// Whether there is time for an image now; it may take more than is left, the next ones wait for that.
    pub(crate) fn is_free(&mut self, now: Instant) -> bool {
        let passed = now.saturating_duration_since(self.looked);
        self.looked = now;
        self.left = (self.left + SHARE * passed.as_secs_f64()).min(KEPT);
        self.left > 0.0
    }

    /// The file, nothing where there is no image or one that is no whole image.
    pub(crate) fn compress(
        &mut self,
        shape: &Shape,
        value: Option<&dyn Reflect>,
        quality: u8,
    ) -> Vec<u8> {
        let begin = Instant::now();
        let image = shape.image().zip(value);
        let image = image.and_then(|(pixels, value)| Image::read(pixels, value));
        let file = image.and_then(|image| jpeg::encode(&image, quality));
        self.spend(begin.elapsed());
        file.unwrap_or_default()
    }

    fn spend(&mut self, time: Duration) {
        self.left -= time.as_secs_f64();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_take_no_more_than_their_share() {
        let mut press = Press::new();
        let start = press.looked;
        let mut spent = Duration::ZERO;
        // An image of 30 ms wants to be compressed every 10 ms, for 10 s.
        for number in 0..1000 {
            if press.is_free(start + Duration::from_millis(10 * number)) {
                press.spend(Duration::from_millis(30));
                spent += Duration::from_millis(30);
            }
        }
        let share = spent.as_secs_f64() / 10.0;
        assert!((0.45..=0.52).contains(&share), "{share}");
        // And one of 4 ms every 10 ms always finds time.
        let start = start + Duration::from_secs(20);
        for number in 0..1000 {
            assert!(press.is_free(start + Duration::from_millis(10 * number)));
            press.spend(Duration::from_millis(4));
        }
    }
}
