//! Sound of a file in place of the microphones: RIFF WAVE with 16-bit integers or 32-bit floats.

use std::path::Path;
use std::time::Duration;

use framework::{Clock, Error, NoEvent, Result, Stop, Timestamp};
use types::audio::{AudioBlock, MICROPHONE_COUNT};

use super::{BLOCK_LENGTH, SAMPLE_RATE, SILENCE};

/// A file that is heard, once and in its own time.
#[derive(Debug)]
pub(super) struct Wav {
    /// Of all microphones, interleaved.
    samples: Vec<f32>,
    begun: Timestamp,
    /// Blocks that were heard.
    blocks: usize,
}

/// What the chunk `fmt ` says.
#[derive(Clone, Copy)]
struct Format {
    /// 1: integers, 3: floats.
    coding: u16,
    channels: usize,
    bits: u16,
}

impl Wav {
    /// A file that begins to be heard at a time; microphones that it has no channel for hear its last one.
    ///
    /// # Errors
    /// Names the file that cannot be read, and what is wrong with it.
    pub(super) fn load(path: &Path, begun: Timestamp) -> Result<Self> {
        let told = |error: Error| error.context(format!("cannot hear {}", path.display()));
        let bytes = std::fs::read(path).map_err(|error| told(error.into()))?;
        Ok(Self {
            samples: samples(&bytes).map_err(|reason| told(Error::new(reason)))?,
            begun,
            blocks: 0,
        })
    }

    /// Waits for the time at which the next block has been heard.
    pub(super) fn read(
        &mut self,
        block: &mut AudioBlock,
        clock: &Clock,
        stop: &Stop,
    ) -> Result<Timestamp> {
        let from = self.blocks * BLOCK_LENGTH * MICROPHONE_COUNT;
        let Some(samples) = self
            .samples
            .get(from..from + BLOCK_LENGTH * MICROPHONE_COUNT)
        else {
            framework::blocking(|| stop.wait(SILENCE))?;
            return Err(NoEvent("the file of the microphones is over".to_owned()).into());
        };
        self.blocks += 1;
        let heard = (self.blocks * BLOCK_LENGTH) as f64 / f64::from(SAMPLE_RATE);
        let at = self.begun + Duration::from_secs_f64(heard);
        clock.wait_until(at, stop)?;
        super::fill(block, SAMPLE_RATE, samples.iter().copied());
        Ok(at)
    }
}

fn samples(bytes: &[u8]) -> Result<Vec<f32>, &'static str> {
    let riff = (bytes.get(..4), bytes.get(8..12));
    if riff != (Some(b"RIFF"), Some(b"WAVE")) {
        return Err("it is no WAVE file");
    }
    let (mut format, mut rest) = (None, &bytes[12..]);
    while let Some((head, after)) = rest.split_at_checked(8) {
        let length = u32::from_le_bytes([head[4], head[5], head[6], head[7]]) as usize;
        let data = after.get(..length).ok_or("it is cut off")?;
        match (&head[..4], format) {
            (b"fmt ", _) => format = Some(read_format(data)?),
            (b"data", Some(format)) => return Ok(spread(data, format)),
            (b"data", None) => return Err("its data come before their format"),
            _ => {}
        }
        // Chunks are padded to even lengths.
        rest = after.get(length + length % 2..).unwrap_or_default();
    }
    Err("it has no sound")
}

fn read_format(data: &[u8]) -> Result<Format, &'static str> {
    let number = |at: usize| {
        let bytes = data.get(at..at + 2).ok_or("its format is cut off")?;
        Ok::<_, &'static str>(u16::from_le_bytes([bytes[0], bytes[1]]))
    };
    let rate = u32::from(number(4)?) | u32::from(number(6)?) << 16;
    let mut coding = number(0)?;
    if coding == 0xfffe {
        // Extensible: the coding stands in front of its GUID.
        coding = number(24)?;
    }
    let format = Format {
        coding,
        channels: number(2)?.into(),
        bits: number(14)?,
    };
    if rate != SAMPLE_RATE {
        return Err("it does not have 44100 samples per second");
    }
    if !(1..=MICROPHONE_COUNT).contains(&format.channels) {
        return Err("it does not have one to four channels");
    }
    if ![(1, 16), (3, 32)].contains(&(format.coding, format.bits)) {
        return Err("its samples are neither 16-bit integers nor 32-bit floats");
    }
    Ok(format)
}

/// Samples for all microphones.
fn spread(data: &[u8], format: Format) -> Vec<f32> {
    let decoded: Vec<f32> = if format.coding == 1 {
        let integers = data.chunks_exact(2);
        let to_float = |two: &[u8]| f32::from(i16::from_le_bytes([two[0], two[1]])) / 32_768.0;
        integers.map(to_float).collect()
    } else {
        let floats = data.chunks_exact(4);
        let to_float = |four: &[u8]| f32::from_le_bytes([four[0], four[1], four[2], four[3]]);
        floats.map(to_float).collect()
    };
    let frames = decoded.chunks_exact(format.channels);
    let microphones = 0..MICROPHONE_COUNT;
    frames
        .flat_map(|frame| {
            let last = frame.len() - 1;
            microphones
                .clone()
                .map(move |microphone| frame[microphone.min(last)])
        })
        .collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A file with 16-bit integers.
    pub(crate) fn file(channels: u16, rate: u32, samples: &[i16]) -> Vec<u8> {
        let data: Vec<u8> = samples
            .iter()
            .flat_map(|sample| sample.to_le_bytes())
            .collect();
        let mut bytes = b"RIFF\0\0\0\0WAVEfmt \x10\0\0\0\x01\0".to_vec();
        bytes.extend(channels.to_le_bytes());
        bytes.extend(rate.to_le_bytes());
        bytes.extend((rate * u32::from(channels) * 2).to_le_bytes());
        bytes.extend((channels * 2).to_le_bytes());
        bytes.extend(16_u16.to_le_bytes());
        bytes.extend(b"LIST\x03\0\0\0abc\0data");
        bytes.extend((data.len() as u32).to_le_bytes());
        bytes.extend(data);
        bytes
    }

    #[test]
    fn microphones_without_a_channel_hear_the_last_one() {
        let heard = samples(&file(2, 44_100, &[16_384, -16_384])).unwrap();
        assert_eq!(heard, [0.5, -0.5, -0.5, -0.5]);
    }

    #[test]
    fn what_cannot_be_heard_is_refused() {
        assert!(
            samples(&file(5, 44_100, &[0; 5]))
                .unwrap_err()
                .contains("channels")
        );
        assert!(
            samples(&file(1, 8_000, &[0]))
                .unwrap_err()
                .contains("44100")
        );
        assert!(samples(b"MThd").unwrap_err().contains("WAVE"));
        let whole = file(1, 44_100, &[1, 2, 3]);
        for length in 0..whole.len() {
            assert!(samples(&whole[..length]).is_err(), "{length} bytes");
        }
    }
}
