//! How the camera sees that took a photograph: as the robot's parameters say, which belong to images of one size.

use framework::tool::Bench;
use framework::{Error, Result};
use types::camera::{CameraCalibration, CameraPosition};

use crate::hardware::Hardware;

/// By so much an image that was made smaller may be higher or lower than its width says, as a share.
const SHAPE_TOLERANCE: f32 = 0.01;

/// Of a camera, for images with so many pixels along x and y.
///
/// # Errors
/// Where the parameters cannot be read, or are of a camera with images of another shape.
pub(super) fn of(
    bench: &mut dyn Bench<Hardware>,
    hardware: &Hardware,
    camera: CameraPosition,
    size: [f32; 2],
) -> Result<CameraCalibration> {
    let parameter = match camera {
        CameraPosition::Top => "cameras.top",
        CameraPosition::Bottom => "cameras.bottom",
    };
    let calibration = serde_json::from_value(bench.parameter(hardware, parameter)?)?;
    resized(calibration, size, parameter)
}

/// The same camera with other pixels. What somebody cut out of an image has another shape, and no known middle.
fn resized(
    calibration: CameraCalibration,
    [width, height]: [f32; 2],
    parameter: &str,
) -> Result<CameraCalibration> {
    let CameraCalibration {
        focal_x, focal_y, ..
    } = calibration;
    if [focal_x, focal_y]
        .iter()
        .any(|focal| !focal.is_finite() || *focal <= 0.0)
    {
        return Err(Error::new(format!(
            "focal lengths are greater than 0, and `{parameter}` says {focal_x} and {focal_y}"
        )));
    }
    let of_shape = height * calibration.width;
    let off = (of_shape - width * calibration.height).abs();
    if off.is_nan() || off > SHAPE_TOLERANCE * of_shape {
        return Err(Error::new(format!(
            "{width} × {height} pixels have another shape than the {} × {} of `{parameter}`; give the calibration of the \
             camera that took it, for example `--set {parameter}.width={width} --set {parameter}.height={height}` and \
             `{parameter}.focal_y` in such heights",
            calibration.width, calibration.height
        )));
    }
    Ok(CameraCalibration {
        width,
        height,
        ..calibration
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    const CALIBRATION: CameraCalibration = CameraCalibration {
        focal_x: 0.95,
        focal_y: 1.25,
        center_x: 0.5,
        center_y: 0.25,
        width: 640.0,
        height: 480.0,
        roll: 0.0,
        pitch: 0.0,
        yaw: 0.0,
    };

    #[test]
    fn the_same_camera_may_have_other_pixels() {
        for (size, focal, center) in [
            ([640.0, 480.0], [608.0, 600.0], [320.0, 120.0]),
            ([1280.0, 960.0], [1216.0, 1200.0], [640.0, 240.0]),
            ([320.0, 240.0], [304.0, 300.0], [160.0, 60.0]),
        ] {
            let resized = resized(CALIBRATION, size, "cameras.top").unwrap();
            let intrinsics = resized.intrinsics();
            assert!((intrinsics.focal - Vector2::from(focal)).norm() < 1e-3);
            assert!((intrinsics.center - Vector2::from(center)).norm() < 1e-3);
        }
        // Rounded to whole pixels.
        assert!(resized(CALIBRATION, [321.0, 240.0], "cameras.top").is_ok());
    }

    #[test]
    fn what_was_cut_out_and_a_calibration_that_is_none_are_refused_by_name() {
        let cut = resized(CALIBRATION, [640.0, 360.0], "cameras.top").unwrap_err();
        let cut = cut.to_string();
        assert!(
            cut.contains("640 × 360") && cut.contains("--set cameras.top.height=360"),
            "{cut}"
        );
        for focal_y in [0.0, -1.0, f32::NAN] {
            let wrong = CameraCalibration {
                focal_y,
                ..CALIBRATION
            };
            let wrong = resized(wrong, [640.0, 480.0], "cameras.bottom").unwrap_err();
            assert!(wrong.to_string().contains("`cameras.bottom`"), "{wrong}");
        }
        let nowhere = CameraCalibration {
            width: 0.0,
            ..CALIBRATION
        };
        assert!(resized(nowhere, [640.0, 480.0], "cameras.top").is_err());
    }
}
