//! The cameras: what is in front of them at the moment of exposure, and the image it gives.

mod ball;
mod blur;
mod color;
mod development;
mod exposure;
pub(crate) mod figure;
mod ground;
mod hall;
mod net;
mod row;
mod scenery;
mod sprite;

pub use exposure::{Exposure, OwnBody};

use nalgebra::Point2;
use types::image::YuyvImage;

use self::blur::Blur;
use self::development::Development;
use self::row::Row;
use self::scenery::Scenery;
use crate::field::Field;

/// Width of an image, pixels.
pub const WIDTH: usize = 640;
/// Height of an image, pixels.
pub const HEIGHT: usize = 480;

const BYTES_PER_PIXEL: usize = 2;

/// Draws what the camera saw at the exposure. The same exposure gives the same bits.
pub fn render(exposure: &Exposure, field: &Field, image: &mut YuyvImage) {
    image.width = WIDTH as u32;
    image.height = HEIGHT as u32;
    image.data.resize(WIDTH * HEIGHT * BYTES_PER_PIXEL, 0);
    let scenery = Scenery::new(exposure);
    let development = Development::new(&exposure.images);
    let paint = |number: usize, row: &mut Row| {
        ground::paint(exposure, field, number, row);
        scenery.paint(exposure, number, row);
    };
    let blurred = Blur::new(exposure.images.blur).map(|blur| blur.apply(paint));
    let mut row = Row::new();
    let rows = image.data.chunks_exact_mut(WIDTH * BYTES_PER_PIXEL);
    for (number, bytes) in rows.enumerate() {
        match &blurred {
            Some(rows) => development.develop(exposure.number, number, &rows[number], bytes),
            None => {
                paint(number, &mut row);
                development.develop(exposure.number, number, &row, bytes);
            }
        }
    }
}

/// What of the ground and the ball an exposure cannot show.
pub(crate) struct Cover(Scenery);

impl Cover {
    pub(crate) fn new(exposure: &Exposure) -> Self {
        Self(Scenery::new(exposure))
    }

    /// How far away along the optical axis the nearest robot, own limb or goal post of a pixel is, m.
    pub(crate) fn depth_at(&self, pixel: Point2<f32>) -> Option<f32> {
        self.0.depth_at(pixel)
    }
}

#[cfg(test)]
mod tests;
