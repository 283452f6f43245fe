//! A camera of the NAO behind V4L2: its format, what its sensor is told, its stream.

use std::fs::{File, OpenOptions};
use std::io;
use std::os::unix::fs::OpenOptionsExt;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use framework::{Result, Stop};
use rustix::fs::OFlags;
use types::camera::CameraPosition;

use super::reset::ResetLines;
use super::watched::{Eye, Maker};
use crate::kernel::{self, CameraControl, ExtensionRequest, Stream};
use crate::settings::Controls;

/// Of the images, in px.
pub(super) const WIDTH: u32 = 640;
/// Of the images, in px.
pub(super) const HEIGHT: u32 = 480;
/// Images a second.
const RATE: u32 = 30;
/// One is being filled, one waits, one is spare.
const BUFFERS: u32 = 3;

/// Extension of these cameras: how much each part of the image counts for its exposure.
const EXPOSURE_WEIGHTS: u8 = 0x09;
/// Extensions of these cameras: left and right, top and bottom exchanged. Sources disagree on which is which; here both are set alike.
const FLIPS: [u8; 2] = [0x0c, 0x0d];
/// V4L2_EXPOSURE_AUTO and V4L2_EXPOSURE_MANUAL.
const AUTOMATIC: i32 = 0;
const MANUAL: i32 = 1;

/// Which camera, and what it shall do.
pub(super) struct DeviceMaker {
    pub(super) position: CameraPosition,
    pub(super) path: PathBuf,
    pub(super) is_flipped: bool,
    pub(super) controls: Controls,
    pub(super) lines: Arc<ResetLines>,
}

impl Maker for DeviceMaker {
    type Eye = Stream;

    fn open(&self) -> io::Result<Stream> {
        let camera = OpenOptions::new()
            .read(true)
            .write(true)
            .custom_flags(OFlags::NONBLOCK.bits() as i32)
            .open(&self.path)?;
        kernel::set_format(&camera, WIDTH, HEIGHT)?;
        kernel::set_rate(&camera, RATE)?;
        for (what, set) in self.settings(&camera) {
            // A darker image is better than none.
            if let Err(error) = set {
                eprintln!("{}: {what} cannot be set: {error}", self.name());
            }
        }
        Stream::start(camera, (WIDTH * HEIGHT * 2) as usize, BUFFERS)
    }

    fn reset(&self, stop: &Stop) -> Result<()> {
        self.lines.reset(self.position, &self.path, stop)
    }

    fn name(&self) -> String {
        format!("camera {:?} ({})", self.position, self.path.display())
    }
}

impl DeviceMaker {
    /// Sets everything, in an order in which it is accepted: automatic modes before what they would overwrite.
    fn settings(&self, camera: &File) -> Vec<(String, io::Result<()>)> {
        let mut done = Vec::new();
        for (control, value) in standard_controls(&self.controls) {
            let set = kernel::set_control(camera, control, value);
            done.push((format!("{control:?} = {value}"), set));
        }
        let mut extend = |what: &str, selector, data: &mut [u8]| {
            let set = kernel::ask_extension(camera, selector, ExtensionRequest::Set, data);
            done.push((what.to_owned(), set));
        };
        let mut weights = weight_table(&self.controls.exposure_weights);
        extend(
            "the weights of the exposure",
            EXPOSURE_WEIGHTS,
            &mut weights,
        );
        for selector in FLIPS {
            let mut is_flipped = u16::from(self.is_flipped).to_le_bytes();
            extend("the flip of the image", selector, &mut is_flipped);
        }
        done
    }
}

fn standard_controls(controls: &Controls) -> Vec<(CameraControl, i32)> {
    use CameraControl as C;
    let white_balance = controls.white_balance_temperature;
    let mut settings = vec![
        (C::Brightness, controls.brightness),
        (C::Contrast, controls.contrast),
        (C::Saturation, controls.saturation),
        (C::Hue, controls.hue),
        (C::AutoWhiteBalance, i32::from(white_balance.is_none())),
    ];
    settings.extend(white_balance.map(|kelvin| (C::WhiteBalanceTemperature, kelvin)));
    settings.push((C::Gain, controls.gain));
    settings.push((C::Sharpness, controls.sharpness));
    let mode = controls.exposure.map_or(AUTOMATIC, |_| MANUAL);
    settings.push((C::ExposureMode, mode));
    settings.extend(controls.exposure.map(|exposure| (C::Exposure, exposure)));
    settings.push((C::AutoFocus, 0));
    settings.push((C::Focus, controls.focus));
    settings
}

/// Enabled; the window is the whole image; sixteen weights of four bits, the first of two in the low ones.
fn weight_table(weights: &[u8; 16]) -> [u8; 17] {
    let mut table = [0; 17];
    table[0] = 1;
    table[5..7].copy_from_slice(&(WIDTH as u16).to_be_bytes());
    table[7..9].copy_from_slice(&(HEIGHT as u16).to_be_bytes());
    for (byte, two) in table[9..].iter_mut().zip(weights.chunks_exact(2)) {
        *byte = two[0].min(15) | two[1].min(15) << 4;
    }
    table
}

impl Eye for Stream {
    fn take(&mut self, patience: Duration, image: &mut Vec<u8>) -> io::Result<Option<Duration>> {
        Self::take(self, patience, image)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_packed_two_in_a_byte() {
        let table = weight_table(&[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 99]);
        assert_eq!(table[..9], [1, 0, 0, 0, 0, 2, 0x80, 1, 0xe0]);
        assert_eq!(table[9..], [0x21, 0x43, 0x65, 0x87, 0xa9, 0xcb, 0xed, 0xff]);
    }

    #[test]
    fn modes_are_set_before_what_they_leave_to_us() {
        let controls = Controls {
            exposure: Some(512),
            white_balance_temperature: Some(2500),
            ..Controls::default()
        };
        let settings = standard_controls(&controls);
        let place = |wanted| settings.iter().position(|(control, _)| *control == wanted);
        assert!(place(CameraControl::ExposureMode) < place(CameraControl::Exposure));
        assert!(settings.contains(&(CameraControl::ExposureMode, MANUAL)));
        assert!(settings.contains(&(CameraControl::AutoWhiteBalance, 0)));
        let automatic = standard_controls(&Controls::default());
        assert!(automatic.contains(&(CameraControl::ExposureMode, AUTOMATIC)));
        assert!(
            !automatic
                .iter()
                .any(|(control, _)| *control == CameraControl::Exposure)
        );
    }

    #[test]
    fn what_is_no_camera_is_an_error_and_no_crash() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        std::fs::write(&path, "no camera").unwrap();
        let maker = |path| DeviceMaker {
            position: CameraPosition::Top,
            path,
            is_flipped: true,
            controls: Controls::default(),
            lines: Arc::new(ResetLines::new("/nowhere".into())),
        };
        assert!(maker(path).open().is_err());
        assert!(maker("/dev/null".into()).open().is_err());
        let gone = maker("/dev/no-such-camera".into());
        assert!(gone.open().is_err());
        let error = gone.reset(&Stop::new()).unwrap_err().to_string();
        assert!(error.contains("/nowhere"), "{error}");
    }
}
