//! Waits for the next image of the camera that this instance looks through.

use framework::pool::Leased;
use framework::{CaptureTime, HardwareInterface, MainOutput, Parameter, Result, context};
use hardware::CameraInterface;
use serde::{Deserialize, Serialize};
use types::camera::CameraPosition;
use types::image::YuyvImage;

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct ImageReceiver {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    camera_position: Parameter<CameraPosition, "$cycler_instance.camera_position">,
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    captured_at: CaptureTime,
    /// As the camera gave it; whoever keeps it keeps the handle.
    image: MainOutput<Option<Leased<YuyvImage>>>,
}

impl ImageReceiver {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The cycle is about the moment of exposure, not about the arrival of the image.
    pub fn cycle(&mut self, context: CycleContext<impl CameraInterface>) -> Result<MainOutputs> {
        let (captured_at, image) = context
            .hardware_interface
            .read_image(*context.camera_position)?;
        Ok(MainOutputs {
            captured_at: captured_at.into(),
            image: Some(image).into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use framework::testing::at_millis;
    use framework::{NoEvent, Timestamp};

    use super::*;

    /// A bottom camera with one image, and a top camera that is silent.
    struct Cameras {}

    impl CameraInterface for Cameras {
        fn read_image(&self, position: CameraPosition) -> Result<(Timestamp, Leased<YuyvImage>)> {
            match position {
                CameraPosition::Top => Err(NoEvent("no image came".to_owned()).into()),
                CameraPosition::Bottom => Ok((at_millis(25), Leased::of(YuyvImage::new(4, 2)))),
            }
        }
    }

    fn cycle(camera_position: CameraPosition) -> Result<MainOutputs> {
        ImageReceiver::new(CreationContext {})?.cycle(CycleContext {
            camera_position: &camera_position,
            hardware_interface: &Arc::new(Cameras {}),
        })
    }

    #[test]
    fn the_image_of_the_own_camera_comes_with_its_capture_time() {
        let outputs = cycle(CameraPosition::Bottom).unwrap();
        assert_eq!(outputs.captured_at.0, at_millis(25));
        let image = outputs.image.value.unwrap();
        assert_eq!((image.width, image.height), (4, 2));
    }

    #[test]
    fn a_silent_camera_is_no_event() {
        let error = cycle(CameraPosition::Top).err().unwrap();
        assert!(error.is_no_event());
    }
}
