//! The two cameras of the head, wherever their images come from.

mod device;
mod reset;
mod watched;

use std::sync::{Arc, Mutex, PoisonError};

use framework::{Clock, NoEvent, Result, Stop, Timestamp, blocking};
use hardware::CameraInterface;
use links::senses::Kind;
use types::camera::CameraPosition;
use types::image::YuyvImage;

use self::device::{DeviceMaker, HEIGHT, WIDTH};
use self::reset::ResetLines;
use self::watched::Watched;
use crate::hardware::Hardware;
use crate::remote::Remote;
use crate::settings::{CameraSettings, CameraSource, Settings};

/// Both cameras; each is read by one thread.
pub(crate) struct Cameras {
    top: Mutex<Camera>,
    bottom: Mutex<Camera>,
    clock: Clock,
    stop: Stop,
}

enum Camera {
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

    fn read(&self, position: CameraPosition, image: &mut YuyvImage) -> Result<Timestamp> {
        let camera = match position {
            CameraPosition::Top => &self.top,
            CameraPosition::Bottom => &self.bottom,
        };
        // A reader that panicked left a camera that the next one finds silent, and resets.
        let mut camera = camera.lock().unwrap_or_else(PoisonError::into_inner);
        let at = match &mut *camera {
            Camera::Device(device) => {
                let at = device.read(&mut image.data, &self.clock, &self.stop)?;
                (image.width, image.height) = (WIDTH, HEIGHT);
                at
            }
            Camera::Remote(remote) => {
                let (at, size) = remote.read(&mut image.data, &self.clock, &self.stop)?;
                [image.width, image.height] = size;
                at
            }
            Camera::Off => {
                blocking(|| self.stop.wait(watched::SILENCE))?;
                return Err(NoEvent(format!("camera {position:?} is off")).into());
            }
        };
        if image.is_complete() {
            Ok(at)
        } else {
            Err(NoEvent(format!("the image of camera {position:?} is garbled")).into())
        }
    }
}

impl Camera {
    fn new(position: CameraPosition, settings: &CameraSettings, lines: Arc<ResetLines>) -> Self {
        match &settings.source {
            CameraSource::Device(path) => Self::Device(Watched::new(DeviceMaker {
                position,
                path: path.clone(),
                is_flipped: settings.is_flipped,
                controls: settings.controls,
                lines,
            })),
            CameraSource::Socket(path) => Self::Remote(Remote::new(path.clone(), Kind::Image)),
            CameraSource::Off => Self::Off,
        }
    }
}

impl CameraInterface for Hardware {
    fn read_image(&self, position: CameraPosition, image: &mut YuyvImage) -> Result<Timestamp> {
        self.cameras.read(position, image)
    }
}
