//! Turns the head so that a camera shows a point on the floor in the middle of its image.
//!
//! Where the camera is now tells where the point is seen from the neck; from there the angles follow
//! in closed form. A camera that is mounted a little askew is right once the head is there.

use framework::{Input, MainOutput, Parameter, Result, context, math};
use kinematics::cameras::{self, Mount};
use kinematics::limits;
use nalgebra::{Isometry3, Point2, Point3, Vector3};
use serde::{Deserialize, Serialize};
use types::camera::{CameraMatrices, CameraPosition};
use types::head::HeadAngles;
use types::motion::{HeadMotion, MotionCommand};

/// Which camera looks.
#[derive(Debug, Deserialize, Serialize)]
pub struct LookAt {
    camera: CameraPosition,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    motion_command: Input<MotionCommand, "motion_command">,
    camera_matrices: Input<Option<CameraMatrices>, "camera_matrices?">,
    head_to_torso: Input<Isometry3<f32>, "robot_kinematics.head_to_torso">,

    /// The bottom camera looks at what is nearer than this, the top camera at what is farther.
    #[reflect(unit = "m", range = 0.0..)]
    bottom_camera_range: Parameter<f32, "look_at.bottom_camera_range">,
    /// So much beyond that range changes the camera.
    #[reflect(unit = "m", range = 0.0..)]
    hysteresis: Parameter<f32, "look_at.hysteresis">,
}

#[context]
pub struct MainOutputs {
    /// Where the head shall get; `None` while it shall not look at a point, or cannot know where that is.
    look_at: MainOutput<Option<HeadAngles>>,
}

impl LookAt {
    /// Begins with the top camera.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            camera: CameraPosition::Top,
        })
    }

    /// Chooses the camera, then the angles.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let look_at = match (context.motion_command.head, context.camera_matrices) {
            (HeadMotion::LookAt(point), Some(camera_matrices)) => {
                self.choose_camera(point, *context.bottom_camera_range, *context.hysteresis);
                let point =
                    point_in_torso(point, self.camera, camera_matrices, context.head_to_torso);
                let from_neck = point - context.head_to_torso.translation.vector;
                angles(from_neck.coords, cameras::mount(self.camera))
            }
            _ => None,
        };
        Ok(MainOutputs {
            look_at: look_at.map(limits::clamp_head).into(),
        })
    }

    fn choose_camera(&mut self, point: Point2<f32>, range: f32, hysteresis: f32) {
        let distance = point.coords.norm();
        self.camera = match self.camera {
            CameraPosition::Top if distance < range - hysteresis => CameraPosition::Bottom,
            CameraPosition::Bottom if distance > range + hysteresis => CameraPosition::Top,
            camera => camera,
        };
    }
}

/// Where a point on the floor is in the torso frame, as the camera would see it now.
fn point_in_torso(
    point: Point2<f32>,
    camera: CameraPosition,
    camera_matrices: &CameraMatrices,
    head_to_torso: &Isometry3<f32>,
) -> Point3<f32> {
    let on_the_floor = Point3::new(point.x, point.y, 0.0);
    let seen = camera_matrices.of(camera).ground_to_camera * on_the_floor;
    let in_camera = cameras::optical_to_camera() * seen;
    head_to_torso * (cameras::camera_to_head(camera) * in_camera)
}

/// The angles that lay the optical axis through a point around the neck; `None` for what is no point.
///
/// The camera is in the head's plane of symmetry: the yaw turns that plane to the point. In it, the
/// optical axis passes the neck at a fixed `offset`, and so must the line to the point.
fn angles(point: Vector3<f32>, mount: Mount) -> Option<HeadAngles> {
    let [forward, _, up] = mount.position.map(|coordinate| coordinate as f32);
    let tilt = mount.pitch as f32;
    let offset = forward * math::sin(tilt) + up * math::cos(tilt);
    let distance = point.norm();
    let elevation = math::atan2(point.z, point.xy().norm());
    let angles = HeadAngles {
        yaw: math::atan2(point.y, point.x),
        pitch: math::asin((offset / distance).min(1.0)) - tilt - elevation,
    };
    (angles.yaw.is_finite() && angles.pitch.is_finite()).then_some(angles)
}

#[cfg(test)]
mod tests {
    use kinematics::forward_kinematics;
    use nalgebra::{Translation3, UnitQuaternion};
    use types::camera::{CameraMatrix, Intrinsics};
    use types::joints::Joints;
    use types::robot_kinematics::RobotKinematics;

    use super::*;

    /// Of a torso 0.3 m above the floor that leans forward a little, and a camera that is askew.
    fn matrices(head_to_torso: &Isometry3<f32>, askew: f32) -> CameraMatrices {
        let lean = UnitQuaternion::from_euler_angles(0.02, 0.05, 0.0);
        let torso_to_ground = Isometry3::from_parts(Translation3::new(0.01, 0.0, 0.3), lean);
        let correction = UnitQuaternion::from_euler_angles(0.0, askew, askew);
        let matrix = |camera| {
            let mount = cameras::camera_to_head(camera);
            let optical_to_head = Isometry3::from_parts(
                mount.translation,
                correction * mount.rotation * cameras::optical_to_camera(),
            );
            CameraMatrix {
                ground_to_camera: (torso_to_ground * head_to_torso * optical_to_head).inverse(),
                intrinsics: Intrinsics {
                    focal: nalgebra::Vector2::new(608.0, 609.6),
                    center: nalgebra::Vector2::new(320.0, 240.0),
                },
            }
        };
        CameraMatrices {
            top: matrix(CameraPosition::Top),
            bottom: matrix(CameraPosition::Bottom),
        }
    }

    fn head_to_torso(angles: HeadAngles) -> Isometry3<f32> {
        let mut positions = Joints::filled(0.0);
        positions.head_yaw = angles.yaw;
        positions.head_pitch = angles.pitch;
        RobotKinematics::from(&forward_kinematics(&positions)).head_to_torso
    }

    fn look(
        node: &mut LookAt,
        head: HeadMotion,
        from: HeadAngles,
        askew: Option<f32>,
    ) -> Option<HeadAngles> {
        let head_to_torso = head_to_torso(from);
        let camera_matrices = askew.map(|askew| matrices(&head_to_torso, askew));
        let motion_command = MotionCommand {
            head,
            ..MotionCommand::default()
        };
        let context = CycleContext {
            motion_command: &motion_command,
            camera_matrices: camera_matrices.as_ref(),
            head_to_torso: &head_to_torso,
            bottom_camera_range: &1.2,
            hysteresis: &0.1,
        };
        node.cycle(context).unwrap().look_at.value
    }

    fn node() -> LookAt {
        LookAt::new(CreationContext {}).unwrap()
    }

    /// Where the chosen camera shows the point once the head is at the angles, from the middle.
    fn pixels_off(node: &LookAt, point: Point2<f32>, angles: HeadAngles, askew: f32) -> f32 {
        let matrices = matrices(&head_to_torso(angles), askew);
        let matrix = matrices.of(node.camera);
        let pixel = matrix.ground_to_pixel(Point3::new(point.x, point.y, 0.0));
        (pixel.unwrap().coords - matrix.intrinsics.center).norm()
    }

    #[test]
    fn the_point_is_shown_in_the_middle_of_the_image() {
        let from = HeadAngles {
            yaw: 0.4,
            pitch: 0.1,
        };
        for (x, y) in [(3.0, 0.5), (1.5, -1.0), (0.6, 0.2), (0.4, -0.3), (8.0, 0.0)] {
            let (mut node, point) = (node(), Point2::new(x, y));
            let angles = look(&mut node, HeadMotion::LookAt(point), from, Some(0.0)).unwrap();
            let off = pixels_off(&node, point, angles, 0.0);
            assert!(off < 0.1, "{point}: {off} px");
        }
    }

    #[test]
    fn a_camera_that_is_askew_gets_there_in_steps() {
        let (mut node, point) = (node(), Point2::new(2.0, 0.7));
        let mut angles = HeadAngles::default();
        for _ in 0..5 {
            angles = look(&mut node, HeadMotion::LookAt(point), angles, Some(0.05)).unwrap();
        }
        let off = pixels_off(&node, point, angles, 0.05);
        assert!(off < 1.0, "{off} px");
    }

    #[test]
    fn near_points_are_for_the_bottom_camera_and_the_choice_does_not_flicker() {
        let mut node = node();
        let mut camera_at = |x: f32| {
            let head = HeadMotion::LookAt(Point2::new(x, 0.0));
            look(&mut node, head, HeadAngles::default(), Some(0.0));
            node.camera
        };
        let (top, bottom) = (CameraPosition::Top, CameraPosition::Bottom);
        let cameras = [2.0, 1.15, 1.0, 1.25, 1.35].map(&mut camera_at);
        assert_eq!(cameras, [top, top, bottom, bottom, top]);
    }

    #[test]
    fn what_the_head_cannot_reach_it_approaches() {
        let behind = HeadMotion::LookAt(Point2::new(-1.0, 0.1));
        let angles = look(&mut node(), behind, HeadAngles::default(), Some(0.0)).unwrap();
        assert_eq!(limits::clamp_head(angles), angles);
        assert!(angles.yaw > 2.0, "{angles:?}");
    }

    #[test]
    fn without_a_point_or_a_floor_there_is_no_answer() {
        let ahead = HeadAngles::default();
        let point = HeadMotion::LookAt(Point2::new(1.0, 0.0));
        let nowhere = HeadMotion::LookAt(Point2::new(f32::NAN, 0.0));
        let around = HeadMotion::LookAround;
        assert_eq!(look(&mut node(), point, ahead, None), None);
        assert_eq!(look(&mut node(), nowhere, ahead, Some(0.0)), None);
        assert_eq!(look(&mut node(), around, ahead, Some(0.0)), None);
    }
}
