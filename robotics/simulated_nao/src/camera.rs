//! The cameras: what is in front of them at the moment of exposure, and the image it gives.

mod ball;
mod color;
mod exposure;
mod ground;

pub use exposure::Exposure;

use types::image::YuyvImage;

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
    for (row, bytes) in image
        .data
        .chunks_exact_mut(WIDTH * BYTES_PER_PIXEL)
        .enumerate()
    {
        ground::paint_row(exposure, field, row, bytes);
    }
    if let Some(center) = exposure.ball_in_camera() {
        ball::paint(exposure, &center, &mut image.data);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Settings;
    use crate::world::World;
    use types::camera::CameraPosition;

    fn image(number: u64, pose: [f64; 3]) -> YuyvImage {
        let settings = Settings {
            robot_pose: pose,
            ..Settings::default()
        };
        let world = World::new(&settings);
        let mut image = YuyvImage::default();
        render(
            &world.expose(CameraPosition::Top, number),
            &world.field,
            &mut image,
        );
        image
    }

    #[test]
    fn the_same_exposure_gives_the_same_bits() {
        let once = image(3, [2.0, 0.0, 0.0]);
        assert!(once.is_complete());
        assert!(once == image(3, [2.0, 0.0, 0.0]));
        assert!(
            once != image(4, [2.0, 0.0, 0.0]),
            "every image has its own noise"
        );
        assert!(once != image(3, [2.001, 0.0, 0.0]));
    }

    #[test]
    fn the_penalty_mark_is_white_where_the_truth_projects_it() {
        let settings = Settings {
            robot_pose: [1.9, 0.0, 0.0],
            ..Settings::default()
        };
        let world = World::new(&settings);
        let mut image = YuyvImage::default();
        for camera in [CameraPosition::Top, CameraPosition::Bottom] {
            let exposure = world.expose(camera, 0);
            render(&exposure, &world.field, &mut image);
            let mark = crate::ground_truth::ImageTruth::penalty_marks()[0];
            let Some(pixel) = crate::ground_truth::ImageTruth::from(&exposure).project(mark) else {
                continue;
            };
            let luminance = image.luminance(pixel.x.round() as u32, pixel.y.round() as u32);
            assert!(
                luminance > Some(150),
                "{camera:?}: {luminance:?} at {pixel}"
            );
            return;
        }
        panic!("no camera sees the mark");
    }
}
