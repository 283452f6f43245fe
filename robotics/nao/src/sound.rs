//! Microphones and loudspeakers: through ALSA, from another process, from a file, or not at all.

mod library;
mod speaker;
mod wav;

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use framework::{Clock, Error, Leased, NoEvent, Pool, Result, Stop, Timestamp, blocking};
use hardware::{MOST_BLOCKS, MicrophoneInterface, SpeakerInterface};
use links::senses::Kind;
use types::audio::{AudioBlock, MICROPHONE_COUNT, Tone};

use self::library::{Library, Recording};
pub(crate) use self::speaker::Speaker;
use self::wav::Wav;
use crate::hardware::Hardware;
use crate::remote::Remote;
use crate::settings::{self, Settings};

/// Samples per second and channel: what whistles are searched in.
const SAMPLE_RATE: u32 = 44_100;
/// Samples of one block and channel: 46 ms.
const BLOCK_LENGTH: usize = 2048;
/// How long one read may block: a stop is noticed after at most this time.
const PATIENCE: Duration = Duration::from_millis(50);
/// After so much silence the caller hears about it.
const SILENCE: Duration = Duration::from_secs(1);

/// The microphones, read by one thread.
pub(crate) struct Microphones {
    /// Blocks are leased from one pool, wherever they come from.
    heard: Mutex<(Source, Pool<AudioBlock>)>,
    clock: Clock,
    stop: Stop,
}

enum Source {
    Device(Device),
    Remote(Remote, Vec<u8>),
    Wav(Wav),
    /// Nothing is heard, and why.
    Silent(String),
}

/// Microphones behind ALSA.
struct Device {
    library: Arc<Library>,
    name: String,
    recording: Option<Recording>,
    samples: Vec<f32>,
}

/// Both ends of sound. What ALSA lacks is told once, here; the robot goes on without it.
///
/// # Errors
/// Where a file that shall be heard cannot be read.
pub(crate) fn open(
    settings: &Settings,
    clock: &Clock,
    stop: &Stop,
) -> Result<(Microphones, Speaker)> {
    let is_needed = matches!(settings.microphones, settings::Microphones::Device(_))
        || matches!(settings.speaker, settings::Speaker::Device(_));
    let library = is_needed.then(|| Library::load(&settings.alsa).map(Arc::new));
    let library = match library {
        Some(Err(error)) => {
            eprintln!("no sound: {error}");
            None
        }
        Some(Ok(library)) => Some(library),
        None => None,
    };
    let source = match (&settings.microphones, &library) {
        (settings::Microphones::Device(name), Some(library)) => Source::Device(Device {
            library: Arc::clone(library),
            name: name.clone(),
            recording: None,
            samples: vec![0.0; BLOCK_LENGTH * MICROPHONE_COUNT],
        }),
        (settings::Microphones::Device(_), None) => {
            Source::Silent("the microphones need ALSA's library".to_owned())
        }
        (settings::Microphones::Socket(path), _) => {
            Source::Remote(Remote::new(path.clone(), Kind::Sound), Vec::new())
        }
        (settings::Microphones::Wav(path), _) => Source::Wav(Wav::load(path, clock.now())?),
        (settings::Microphones::Off, _) => Source::Silent("the microphones are off".to_owned()),
    };
    let speaker = match (&settings.speaker, library) {
        (settings::Speaker::Device(name), Some(library)) => Speaker::new(library, name.clone())?,
        _ => Speaker::silent(),
    };
    let microphones = Microphones {
        heard: Mutex::new((source, Pool::new(MOST_BLOCKS, AudioBlock::default))),
        clock: clock.clone(),
        stop: stop.clone(),
    };
    Ok((microphones, speaker))
}

impl Microphones {
    fn read(&self) -> Result<(Timestamp, Leased<AudioBlock>)> {
        // A reader that panicked left a source that goes on.
        let mut heard = self.heard.lock().unwrap_or_else(PoisonError::into_inner);
        let (source, blocks) = &mut *heard;
        let mut block = match blocks.free() {
            Ok(block) => block,
            Err(held) => {
                // Not as often as the processor can ask.
                blocking(|| self.stop.wait(PATIENCE))?;
                return Err(held.into());
            }
        };
        let at = source.read(&mut block, &self.clock, &self.stop)?;
        Ok((at, block.lease()))
    }
}

impl Source {
    fn read(&mut self, block: &mut AudioBlock, clock: &Clock, stop: &Stop) -> Result<Timestamp> {
        match self {
            Source::Device(device) => device.read(block, clock, stop),
            Source::Wav(wav) => wav.read(block, clock, stop),
            Source::Remote(remote, bytes) => {
                let (at, [length, channels]) = remote.read(bytes, clock, stop)?;
                if (length as usize, channels as usize) != (BLOCK_LENGTH, MICROPHONE_COUNT) {
                    let what = format!("sound of {length} samples and {channels} channels");
                    return Err(NoEvent(what).into());
                }
                let samples = bytes.chunks_exact(4).map(|four| {
                    f32::from_le_bytes(four.try_into().expect("a chunk has four bytes"))
                });
                fill(block, SAMPLE_RATE, samples);
                Ok(at)
            }
            Source::Silent(why) => {
                blocking(|| stop.wait(SILENCE))?;
                Err(NoEvent(why.clone()).into())
            }
        }
    }
}

impl Device {
    fn read(&mut self, block: &mut AudioBlock, clock: &Clock, stop: &Stop) -> Result<Timestamp> {
        let begun = clock.now();
        let mut filled = 0;
        while filled < self.samples.len() {
            stop.check()?;
            if clock.now() - begun > SILENCE {
                // Opened anew it may hear again.
                self.recording = None;
                return Err(NoEvent(format!("microphones {}: nothing comes", self.name)).into());
            }
            let rest = &mut self.samples[filled..];
            match blocking(|| Self::receive(&self.library, &self.name, &mut self.recording, rest)) {
                Ok(count) => filled += count * MICROPHONE_COUNT,
                Err(error) => {
                    // A device that comes back, comes back in a while.
                    self.recording = None;
                    blocking(|| stop.wait(SILENCE))?;
                    return Err(NoEvent(format!("microphones {}: {error}", self.name)).into());
                }
            }
        }
        let unread = self.recording.as_mut().map_or(0, Recording::unread);
        let at = before(clock.now(), unread);
        fill(block, SAMPLE_RATE, self.samples.iter().copied());
        Ok(at)
    }

    /// How many samples of each channel came within [`PATIENCE`].
    fn receive(
        library: &Arc<Library>,
        name: &str,
        recording: &mut Option<Recording>,
        samples: &mut [f32],
    ) -> Result<usize> {
        let recording = match recording {
            Some(recording) => recording,
            None => recording.insert(library.record(name, MICROPHONE_COUNT, SAMPLE_RATE)?),
        };
        recording.read(samples, PATIENCE)
    }
}

/// When the last sample was taken in front of so many that have come since: a device gives several blocks at once.
fn before(now: Timestamp, unread: usize) -> Timestamp {
    let age = unread as u64 * 1_000_000_000 / u64::from(SAMPLE_RATE);
    Timestamp::from_nanos(now.as_nanos().saturating_sub(age))
}

/// Takes interleaved samples apart.
fn fill(block: &mut AudioBlock, sample_rate: u32, samples: impl Iterator<Item = f32>) {
    block.sample_rate = sample_rate;
    for channel in &mut block.channels {
        channel.clear();
    }
    for (index, sample) in samples.enumerate() {
        block.channels[index % MICROPHONE_COUNT].push(sample);
    }
}

impl MicrophoneInterface for Hardware {
    fn read_audio(&self) -> Result<(Timestamp, Leased<AudioBlock>)> {
        self.microphones.read()
    }
}

impl SpeakerInterface for Hardware {
    fn play_tone(&self, tone: &Tone) -> Result<()> {
        if tone.frequency.is_finite() && tone.duration.is_finite() && tone.volume.is_finite() {
            self.speaker.play(*tone);
            Ok(())
        } else {
            Err(Error::new(
                "a tone holds a value that is infinite or no number",
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// Of sound that comes from these settings.
    fn read(settings: &Settings) -> (Result<(Timestamp, Leased<AudioBlock>)>, Speaker) {
        let (clock, stop) = (Clock::wall(), Stop::new());
        let (microphones, speaker) = open(settings, &clock, &stop).unwrap();
        (microphones.read(), speaker)
    }

    #[test]
    fn without_the_library_there_is_one_error_and_silence() {
        let settings = Settings {
            alsa: "libno-such-library.so.7".into(),
            ..Settings::default()
        };
        let error = Library::load(&settings.alsa).err().unwrap().to_string();
        assert!(error.contains("libno-such-library.so.7"), "{error}");
        assert!(error.contains("hardware.nao.alsa"), "{error}");
        let (read, speaker) = read(&settings);
        let error = read.unwrap_err();
        assert!(error.is_no_event(), "{error}");
        assert!(error.to_string().contains("ALSA"), "{error}");
        speaker.play(Tone::default());
    }

    #[test]
    fn a_library_without_the_functions_of_alsa_is_named() {
        // Every program has this one.
        let error = Library::load(Path::new("libc.so.6")).err().unwrap();
        assert!(error.to_string().contains("snd_pcm_open"), "{error}");
    }

    /// A library with ALSA's functions, whose microphones give a ramp and whose loudspeakers write what they get to a file.
    #[test]
    fn samples_go_through_alsas_functions_and_a_device_that_fails_is_opened_again() {
        let folder = tempfile::tempdir().unwrap();
        let source = folder.path().join("fake.rs");
        std::fs::write(&source, include_str!("sound/fake_alsa.rs.txt")).unwrap();
        let library = folder.path().join("libfake.so");
        let built = std::process::Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into()))
            .args(["--edition", "2024", "--crate-type", "cdylib", "-o"])
            .args([&library, &source])
            .output()
            .unwrap();
        assert!(
            built.status.success(),
            "{}",
            String::from_utf8_lossy(&built.stderr)
        );
        let played = folder.path().join("played");
        let settings = Settings {
            alsa: library,
            speaker: settings::Speaker::Device(played.to_str().unwrap().to_owned()),
            ..Settings::default()
        };
        let (clock, stop) = (Clock::wall(), Stop::new());
        // So long ago may be what is heard first.
        std::thread::sleep(Duration::from_millis(300));
        let (microphones, speaker) = open(&settings, &clock, &stop).unwrap();
        let (mut last, block) = microphones.read().unwrap();
        assert_eq!(block.sample_rate, 44_100);
        for (channel, samples) in block.channels.iter().enumerate() {
            assert_eq!(samples.len(), BLOCK_LENGTH);
            // The library's ramp: the number of the sample, and its channel as a fraction.
            assert_eq!(samples[5], 5.0 + channel as f32 / 8.0);
        }
        drop(block);
        // They were given in one burst, and taken one after the other.
        for _ in 0..4 {
            let (at, _) = microphones.read().unwrap();
            assert!(at - last >= Duration::from_micros(46_400), "{last} {at}");
            last = at;
        }
        assert!(last <= clock.now());
        // It has an overrun once, then is unplugged once, and falls silent once.
        microphones.read().unwrap();
        let error = microphones.read().unwrap_err();
        assert!(error.to_string().contains("No such device"), "{error}");
        microphones.read().unwrap();
        let error = microphones.read().unwrap_err();
        assert!(error.to_string().contains("nothing comes"), "{error}");
        microphones.read().unwrap();
        speaker.play(Tone {
            frequency: 1000.0,
            duration: 0.1,
            volume: 0.5,
        });
        drop(speaker);
        let bytes = std::fs::read(played).unwrap();
        let samples: Vec<_> = bytes
            .chunks_exact(4)
            .map(|four| f32::from_ne_bytes(four.try_into().unwrap()))
            .collect();
        assert_eq!(samples.len(), 4_800, "0.1 s of 48 kHz");
        let loudest = samples
            .iter()
            .fold(0.0_f32, |most, sample| most.max(sample.abs()));
        assert!((loudest - 0.5).abs() < 0.01, "{loudest}");
    }

    #[test]
    fn a_file_is_heard_in_its_own_time() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sound.wav");
        let samples: Vec<i16> = (0..BLOCK_LENGTH as i16 * 2).flat_map(|n| [n, -n]).collect();
        std::fs::write(&path, wav::tests::file(2, 44_100, &samples)).unwrap();
        let settings = Settings {
            microphones: settings::Microphones::Wav(path),
            speaker: settings::Speaker::Off,
            ..Settings::default()
        };
        let (at, block) = read(&settings).0.unwrap();
        assert!((at.as_nanos() as f64 / 1e9 - 2048.0 / 44_100.0).abs() < 0.01);
        assert_eq!(block.channels[0][100], 100.0 / 32_768.0);
        assert_eq!(block.channels[3][100], -100.0 / 32_768.0);
    }

    #[test]
    fn a_stop_is_noticed() {
        let settings = Settings {
            microphones: settings::Microphones::Off,
            speaker: settings::Speaker::Off,
            ..Settings::default()
        };
        let stop = Stop::new();
        let (microphones, _) = open(&settings, &Clock::wall(), &stop).unwrap();
        stop.request();
        let error = microphones.read().unwrap_err();
        assert!(error.is_stopped());
        assert!(PATIENCE < Duration::from_millis(100));
    }
}
