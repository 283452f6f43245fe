//! Plays tones on a thread of its own, so that no node waits for the sound.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

use framework::{Error, Result, math};
use types::audio::Tone;

use super::library::Library;

/// Samples per second.
const SAMPLE_RATE: u32 = 48_000;
/// So much is played before the thread looks whether another tone is wanted: 20 ms.
const PIECE: usize = 960;
/// No tone is longer, in s: the device keeps a second, and nobody wants to wait for the end of more.
const LONGEST: f32 = 10.0;

/// The loudspeakers, or their absence.
pub(crate) struct Speaker {
    wishes: Arc<Wishes>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Wishes {
    wish: Mutex<Wish>,
    changed: Condvar,
}

#[derive(Default)]
struct Wish {
    next: Option<Tone>,
    is_closing: bool,
}

impl Speaker {
    /// None: what is to be played is dropped.
    pub(super) fn silent() -> Self {
        Self {
            wishes: Arc::default(),
            thread: None,
        }
    }

    /// Plays on a device of ALSA, which is open while something sounds.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub(super) fn new(library: Arc<Library>, device: String) -> Result<Self> {
        let wishes = Arc::new(Wishes::default());
        let thread = std::thread::Builder::new()
            .name("nao.speaker".to_owned())
            .spawn({
                let wishes = Arc::clone(&wishes);
                move || wishes.fulfil(&library, &device)
            })
            .map_err(|error| Error::from(error).context("cannot start the loudspeakers' thread"))?;
        Ok(Self {
            wishes,
            thread: Some(thread),
        })
    }

    /// Begins a tone, in place of the one that sounds.
    pub(crate) fn play(&self, tone: Tone) {
        if self.thread.is_some() {
            self.wishes.lock().next = Some(tone);
            self.wishes.changed.notify_all();
        }
    }
}

impl Drop for Speaker {
    fn drop(&mut self) {
        self.wishes.lock().is_closing = true;
        self.wishes.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            // A panic of the thread has been printed.
            let _ = thread.join();
        }
    }
}

impl Wishes {
    fn lock(&self) -> MutexGuard<'_, Wish> {
        // Nothing in it can be half done.
        self.wish.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn fulfil(&self, library: &Arc<Library>, device: &str) {
        let mut has_told = false;
        while let Some(tone) = self.next() {
            // Told once: the next tone will not sound either.
            if let Err(error) = self.sound(library, device, tone)
                && !std::mem::replace(&mut has_told, true)
            {
                eprintln!("loudspeakers {device}: {error}");
            }
        }
    }

    /// Waits for a wish; `None` at the end.
    fn next(&self) -> Option<Tone> {
        let mut wish = self.lock();
        loop {
            if let Some(tone) = wish.next.take() {
                return Some(tone);
            }
            if wish.is_closing {
                return None;
            }
            let woken = self.changed.wait(wish);
            wish = woken.unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn sound(&self, library: &Arc<Library>, device: &str, tone: Tone) -> Result<()> {
        let mut playing = library.play(device, 1, SAMPLE_RATE)?;
        let samples: Vec<_> = samples(&tone).collect();
        for piece in samples.chunks(PIECE) {
            if self.lock().next.is_some() {
                return Ok(());
            }
            let mut played = 0;
            while played < piece.len() {
                played += playing.write(&piece[played..])?;
            }
        }
        playing.finish();
        Ok(())
    }
}

fn samples(tone: &Tone) -> impl Iterator<Item = f32> {
    let Tone {
        frequency,
        duration,
        volume,
    } = *tone;
    let rate = f64::from(SAMPLE_RATE);
    let count = (f64::from(duration.clamp(0.0, LONGEST)) * rate).round() as u32;
    (0..count).map(move |number| {
        let phase = f64::from(number) / rate * f64::from(frequency) * std::f64::consts::TAU;
        math::sin(phase) as f32 * volume.clamp(0.0, 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tone_has_its_frequency_and_no_hostile_length() {
        let mut tone = Tone {
            frequency: 440.0,
            duration: 1.0,
            volume: 2.0,
        };
        let heard: Vec<_> = samples(&tone).collect();
        let rising = heard.windows(2).filter(|two| two[0] < 0.0 && two[1] >= 0.0);
        assert!((439..=440).contains(&rising.count()));
        assert!(heard.iter().all(|sample| sample.abs() <= 1.0));
        tone.duration = 1e9;
        assert_eq!(samples(&tone).count(), 480_000);
        tone.duration = -1.0;
        assert_eq!(samples(&tone).count(), 0);
    }
}
