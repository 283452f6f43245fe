//! The two cameras of the head, wherever their images come from.

mod device;
mod reset;
mod watched;

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use framework::{Clock, Leased, NoEvent, Pool, Result, Stop, Timestamp, blocking};
use hardware::{CameraInterface, MOST_IMAGES};
use links::senses::Kind;
use types::camera::CameraPosition;
use types::image::YuyvImage;

use self::device::{DeviceMaker, HEIGHT, WIDTH};
use self::reset::ResetLines;
use self::watched::Watched;
use crate::hardware::Hardware;
use crate::remote::Remote;
use crate::settings::{CameraSettings, CameraSource, Settings};

/// From one image to the next.
const PERIOD: Duration = Duration::from_millis(33);

/// Both cameras; each is read by one thread.
pub(crate) struct Cameras {
    top: Mutex<Camera>,
    bottom: Mutex<Camera>,
    clock: Clock,
    stop: Stop,
}

struct Camera {
    source: Source,
    images: Pool<YuyvImage>,
}

enum Source {
    Device(Watched<DeviceMaker>),
    Remote(Remote),
    Off,
}

impl Cameras {
    /// Opens nothing yet: whoever reads first does.
    pub(crate) fn new(settings: &Settings, clock: &Clock, stop: &Stop) -> Self {
        let lines = Arc::new(ResetLines::new(settings.reset_bus.clone()));
        let camera = |position| {
            let camera = settings.camera(position);
            Mutex::new(Camera::new(position, camera, Arc::clone(&lines)))
        };
        Self {
            top: camera(CameraPosition::Top),
            bottom: camera(CameraPosition::Bottom),
            clock: clock.clone(),
            stop: stop.clone(),
        }
    }

    fn read(&self, position: CameraPosition) -> Result<(Timestamp, Leased<YuyvImage>)> {
        let camera = match position {
            CameraPosition::Top => &self.top,
            CameraPosition::Bottom => &self.bottom,
        };
        // A reader that panicked left a camera that the next one finds silent, and resets.
        let mut camera = camera.lock().unwrap_or_else(PoisonError::into_inner);
        let Camera { source, images } = &mut *camera;
        let mut image = match images.free() {
            Ok(image) => image,
            Err(held) => {
                // Not as often as the processor can ask.
                blocking(|| self.stop.wait(PERIOD))?;
                return Err(held.into());
            }
        };
        let at = match source {
            Source::Device(device) => {
                let at = device.read(&mut image.data, &self.clock, &self.stop)?;
                (image.width, image.height) = (WIDTH, HEIGHT);
                at
            }
            Source::Remote(remote) => {
                let (at, size) = remote.read(&mut image.data, &self.clock, &self.stop)?;
                [image.width, image.height] = size;
                at
            }
            Source::Off => {
                blocking(|| self.stop.wait(watched::SILENCE))?;
                return Err(NoEvent(format!("camera {position:?} is off")).into());
            }
        };
        if image.is_complete() {
            Ok((at, image.lease()))
        } else {
            Err(NoEvent(format!("the image of camera {position:?} is garbled")).into())
        }
    }
}

impl Camera {
    fn new(position: CameraPosition, settings: &CameraSettings, lines: Arc<ResetLines>) -> Self {
        let source = match &settings.source {
            CameraSource::Device(path) => Source::Device(Watched::new(DeviceMaker {
                position,
                path: path.clone(),
                is_flipped: settings.is_flipped,
                controls: settings.controls,
                lines,
            })),
            CameraSource::Socket(path) => Source::Remote(Remote::new(path.clone(), Kind::Image)),
            CameraSource::Off => Source::Off,
        };
        Self {
            source,
            images: Pool::new(MOST_IMAGES, YuyvImage::default),
        }
    }
}

impl CameraInterface for Hardware {
    fn read_image(&self, position: CameraPosition) -> Result<(Timestamp, Leased<YuyvImage>)> {
        self.cameras.read(position)
    }
}
