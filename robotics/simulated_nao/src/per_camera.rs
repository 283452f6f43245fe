//! Owns `PerCamera`: what there is once for the top and once for the bottom camera.

use types::camera::CameraPosition;

/// One value for each camera.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PerCamera<T> {
    pub(crate) top: T,
    pub(crate) bottom: T,
}

impl<T> PerCamera<T> {
    pub(crate) fn each(make: impl Fn() -> T) -> Self {
        Self {
            top: make(),
            bottom: make(),
        }
    }

    pub(crate) fn of(&self, camera: CameraPosition) -> &T {
        match camera {
            CameraPosition::Top => &self.top,
            CameraPosition::Bottom => &self.bottom,
        }
    }

    pub(crate) fn of_mut(&mut self, camera: CameraPosition) -> &mut T {
        match camera {
            CameraPosition::Top => &mut self.top,
            CameraPosition::Bottom => &mut self.bottom,
        }
    }
}
