//! Gives the matrix of this instance's camera at the moment when its image was exposed.
//!
//! Control knows the camera's pose every 12 ms, an image is some 20 ms old when it arrives: with a
//! turning head the newest pose would be off by tens of pixels. Between the poses of this cycle and
//! the cycle before lies the exposure, so the pose at that moment is interpolated.

use framework::{
    CycleTime, LatestInput, MainOutput, Parameter, Reflect, Result, Timestamp, context,
};
use serde::{Deserialize, Serialize};
use types::camera::{CameraMatrices, CameraMatrix, CameraPosition};

/// Between which poses a camera's movement is known.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CameraMatrixExtractorParameters {
    /// Poses further apart than this say nothing about the time between them.
    #[reflect(unit = "s", range = 0.0..)]
    pub longest_gap: f32,
    /// How far beyond the newer pose its movement goes on, in parts of the time between the poses counted from the older.
    #[reflect(range = 1.0..)]
    pub furthest: f32,
}

/// Remembers the newest pose of the cycle before.
#[derive(Debug, Deserialize, Serialize)]
pub struct CameraMatrixExtractor {
    previous: Option<(Timestamp, CameraMatrix)>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    camera_position: Parameter<CameraPosition, "$cycler_instance.camera_position">,
    camera_matrices: LatestInput<Option<CameraMatrices>, "Control", "camera_matrices">,
    cycle_time: CycleTime,
    parameters: Parameter<CameraMatrixExtractorParameters, "camera_matrix_extractor">,
}

#[context]
pub struct MainOutputs {
    camera_matrix: MainOutput<Option<CameraMatrix>>,
}

impl CameraMatrixExtractor {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { previous: None })
    }

    /// Absent while Control does not know the pose.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let newest = context.camera_matrices.and_then(|latest| {
            let matrices = latest.value.as_ref()?;
            Some((latest.timestamp, *matrices.of(*context.camera_position)))
        });
        let camera_matrix = newest.map(|newest| match self.previous {
            Some(previous) => matrix_at(
                context.cycle_time.start,
                previous,
                newest,
                context.parameters,
            ),
            None => newest.1,
        });
        self.previous = newest;
        Ok(MainOutputs {
            camera_matrix: camera_matrix.into(),
        })
    }
}

fn matrix_at(
    time: Timestamp,
    (earlier, from): (Timestamp, CameraMatrix),
    (later, to): (Timestamp, CameraMatrix),
    parameters: &CameraMatrixExtractorParameters,
) -> CameraMatrix {
    let gap = later - earlier;
    if gap.is_zero() || gap.as_secs_f32() > parameters.longest_gap {
        return to;
    }
    let part = ((time - earlier).as_secs_f32() / gap.as_secs_f32()).min(parameters.furthest);
    // Around the camera's own place, which moves in a line where the camera turns.
    let (from, to_pose) = (
        from.ground_to_camera.inverse(),
        to.ground_to_camera.inverse(),
    );
    let between = from.try_lerp_slerp(&to_pose, part, 1e-6).unwrap_or(to_pose);
    CameraMatrix {
        ground_to_camera: between.inverse(),
        ..to
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{at_millis, cycle_time, latest};
    use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector2, Vector3};
    use types::camera::Intrinsics;

    use super::*;

    /// Half a metre up, looking down a little, while the head turns at 2 rad/s.
    fn turning(millis: u64) -> CameraMatrices {
        let yaw = 2.0 * millis as f32 / 1000.0;
        let neck = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw);
        let optical = UnitQuaternion::from_euler_angles(-1.57 - 0.3, 0.0, -1.57);
        let camera = Isometry3::from_parts(Translation3::new(0.06, 0.0, 0.0), optical);
        let camera_to_ground = Translation3::new(0.0, 0.0, 0.5) * neck * camera;
        let matrix = CameraMatrix {
            ground_to_camera: camera_to_ground.inverse(),
            intrinsics: Intrinsics {
                focal: Vector2::new(608.0, 609.6),
                center: Vector2::new(320.0, 240.0),
            },
        };
        CameraMatrices {
            top: matrix,
            bottom: CameraMatrix::default(),
        }
    }

    fn cycle(
        node: &mut CameraMatrixExtractor,
        captured: u64,
        newest: u64,
        matrices: &Option<CameraMatrices>,
    ) -> Option<CameraMatrix> {
        let context = CycleContext {
            camera_position: &CameraPosition::Top,
            camera_matrices: latest(at_millis(newest), matrices, at_millis(captured)),
            cycle_time: cycle_time(captured, 33),
            parameters: &CameraMatrixExtractorParameters {
                longest_gap: 0.15,
                furthest: 1.5,
            },
        };
        node.cycle(context).unwrap().camera_matrix.value
    }

    fn pixels_apart(one: &CameraMatrix, other: &CameraMatrix) -> f32 {
        let point = Point3::new(1.2, 0.1, 0.0);
        let pixel = |matrix: &CameraMatrix| matrix.ground_to_pixel(point).unwrap();
        nalgebra::distance(&pixel(one), &pixel(other))
    }

    #[test]
    fn the_matrix_is_that_of_the_exposure_while_the_head_turns() {
        let mut node = CameraMatrixExtractor::new(CreationContext {}).unwrap();
        cycle(&mut node, 35, 60, &Some(turning(60)));
        for (captured, newest) in [(68, 84), (101, 120), (135, 132)] {
            let matrix = cycle(&mut node, captured, newest, &Some(turning(newest))).unwrap();
            let off = pixels_apart(&matrix, &turning(captured).top);
            assert!(off < 1.0, "{off} px at {captured} ms");
            let uncorrected = pixels_apart(&turning(newest).top, &turning(captured).top);
            assert!(uncorrected > 2.0, "{uncorrected} px");
        }
    }

    #[test]
    fn the_first_matrix_is_taken_as_it_is() {
        let mut node = CameraMatrixExtractor::new(CreationContext {}).unwrap();
        let matrix = cycle(&mut node, 35, 60, &Some(turning(60)));
        assert_eq!(matrix, Some(turning(60).top));
    }

    #[test]
    fn an_unknown_pose_gives_no_matrix_and_is_not_interpolated_later() {
        let mut node = CameraMatrixExtractor::new(CreationContext {}).unwrap();
        cycle(&mut node, 35, 60, &Some(turning(60)));
        assert_eq!(cycle(&mut node, 68, 84, &None), None);
        let matrix = cycle(&mut node, 101, 120, &Some(turning(120)));
        assert_eq!(matrix, Some(turning(120).top));
    }

    #[test]
    fn what_lies_too_far_back_says_nothing() {
        let mut node = CameraMatrixExtractor::new(CreationContext {}).unwrap();
        cycle(&mut node, 35, 60, &Some(turning(60)));
        let matrix = cycle(&mut node, 1000, 1020, &Some(turning(1020)));
        assert_eq!(matrix, Some(turning(1020).top));
    }
}
