//! Waits for the next image of the camera that this instance looks through.

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
    image: MainOutput<YuyvImage>,
}

#[context]
pub struct MainOutputs {
    captured_at: CaptureTime,
}

impl ImageReceiver {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The cycle is about the moment of exposure, not about the arrival of the image.
    pub fn cycle(&mut self, context: CycleContext<impl CameraInterface>) -> Result<MainOutputs> {
        let captured_at = context
            .hardware_interface
            .read_image(*context.camera_position, context.image)?;
        Ok(MainOutputs {
            captured_at: captured_at.into(),
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
        fn read_image(&self, position: CameraPosition, image: &mut YuyvImage) -> Result<Timestamp> {
            match position {
                CameraPosition::Top => Err(NoEvent("no image came".to_owned()).into()),
                CameraPosition::Bottom => {
                    image.resize(4, 2);
                    Ok(at_millis(25))
                }
            }
        }
    }

    fn cycle(camera_position: CameraPosition, image: &mut YuyvImage) -> Result<MainOutputs> {
        ImageReceiver::new(CreationContext {})?.cycle(CycleContext {
            camera_position: &camera_position,
            hardware_interface: &Arc::new(Cameras {}),
            image,
        })
    }

    #[test]
    fn the_image_of_the_own_camera_comes_with_its_capture_time() {
        let mut image = YuyvImage::default();
        let outputs = cycle(CameraPosition::Bottom, &mut image).unwrap();
        assert_eq!(outputs.captured_at.0, at_millis(25));
        assert_eq!((image.width, image.height), (4, 2));
    }

    #[test]
    fn a_silent_camera_is_no_event() {
        let error = cycle(CameraPosition::Top, &mut YuyvImage::default())
            .err()
            .unwrap();
        assert!(error.is_no_event());
    }
}
