//! Whether vision sees somebody who lies right before the robot, where the lower camera cuts him, and takes nothing else for that.

#[path = "support/scene.rs"]
#[expect(dead_code, reason = "the scenes here have nobody upright")]
mod scene;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Isometry3, Point2, Point3, Translation3, UnitQuaternion, Vector3};
use scene::{Look, Vision};
use simulated_nao::camera::Exposure;
use simulated_nao::scene::{Robot, RobotSettings, Team};
use types::camera::CameraPosition;

/// From the torso's origin up to the head and down to the feet along the torso, m (links of the NAO, Aldebaran's documentation).
const HEAD: f64 = 0.2;
const FEET: f64 = -0.33;

/// Somebody on his back or on his face, the middle of his body so far ahead, lying that way as the robot sees it.
struct Lying {
    ahead: f64,
    turned: f64,
    is_on_back: bool,
}

/// As the robot looks at a ball that lies at its feet or a step ahead.
fn looks() -> impl Iterator<Item = Look> {
    [-0.3, 0.0, 0.3].into_iter().flat_map(|yaw| {
        [0.1, 0.25, 0.4].map(|pitch| Look {
            robot: [-1.3, 0.9, 0.4],
            yaw,
            pitch,
            camera: CameraPosition::Bottom,
        })
    })
}

impl Lying {
    /// Where its torso is in the field frame.
    fn torso(&self, look: &Look) -> Isometry3<f64> {
        let [x, y, heading] = look.robot;
        let robot = Isometry3::new(Vector3::new(x, y, 0.0), Vector3::z() * heading);
        let tilt = if self.is_on_back {
            -FRAC_PI_2
        } else {
            FRAC_PI_2
        };
        let middle = (HEAD + FEET) / 2.0;
        let torso = UnitQuaternion::from_euler_angles(0.0, 0.0, self.turned)
            * UnitQuaternion::from_euler_angles(0.0, tilt, 0.0);
        let place = Translation3::new(self.ahead, 0.0, 0.06);
        robot * place * torso * Translation3::new(0.0, 0.0, -middle)
    }

    /// How far a place on the floor is from the line through its body, m.
    fn distance(&self, look: &Look, exposure: &Exposure, place: Point2<f32>) -> f32 {
        let torso = self.torso(look).cast::<f32>();
        let end = |along: f64| {
            let end = torso * Point3::new(0.0, 0.0, along as f32);
            exposure.ground_to_field.inverse_transform_point(&end).xy()
        };
        let (feet, head) = (end(FEET), end(HEAD));
        let along = head - feet;
        let share = (place - feet).dot(&along) / along.norm_squared();
        nalgebra::distance(&place, &(feet + along * share.clamp(0.0, 1.0)))
    }
}

#[test]
fn somebody_who_lies_before_the_robot_is_an_obstacle_there() {
    let mut vision = Vision::new();
    let (mut shown, mut found, mut wrong) = (0, 0, 0);
    for look in looks() {
        for number in 0..32_u32 {
            let lying = Lying {
                ahead: [0.4, 0.5][number as usize % 2],
                turned: f64::from(number / 4) / 8.0 * TAU + 0.1,
                is_on_back: number / 2 % 2 == 0,
            };
            let settings = RobotSettings {
                position: [0.0, 0.0],
                heading: 0.0,
                team: Team::Opponent,
                number: 3,
            };
            let robot = Robot::new(&settings, &lying.torso(&look));
            let exposure = look.expose_among(number.into(), None, &[robot]);
            let obstacles = vision.see(&look, &exposure).obstacles;
            let off = |place| lying.distance(&look, &exposure, place);
            shown += 1;
            found += u32::from(obstacles.iter().any(|seen| off(seen.position) < 0.2));
            wrong += obstacles
                .iter()
                .filter(|seen| off(seen.position) > 0.3)
                .count();
        }
    }
    println!("{found} of {shown} who lie are found, {wrong} obstacles elsewhere");
    assert!(found * 10 >= shown * 9, "{found} of {shown}");
    assert!(wrong * 50 <= shown as usize, "{wrong} of {shown}");
}

#[test]
fn neither_a_ball_at_the_feet_nor_lines_are_somebody_who_lies() {
    let mut vision = Vision::new();
    let (mut images, mut wrong) = (0, 0);
    for look in looks() {
        for number in 0..40_u32 {
            // Every other one beside a line, or on it.
            let robot = match number % 2 {
                0 => look.robot,
                _ => [0.02 * f64::from(number), 3.0, 0.3 * f64::from(number) % PI],
            };
            let look = Look { robot, ..look };
            let ground = look.expose(0, None).ground_to_field;
            let (ahead, aside) = (
                0.12 + 0.01 * (number / 2) as f32,
                0.08 * ((number % 5) as f32 - 2.0),
            );
            let ball = ground * Point3::new(ahead, aside, 0.05);
            let ball = Some(ball).filter(|_| number % 4 != 3);
            let exposure = look.expose_among(number.into(), ball, &[]);
            let obstacles = vision.see(&look, &exposure).obstacles;
            images += 1;
            wrong += u32::from(
                obstacles
                    .iter()
                    .any(|seen| seen.position.coords.norm() < 0.5),
            );
        }
    }
    println!("an obstacle in {wrong} of {images} images without one");
    assert!(wrong * 100 <= images, "{wrong} of {images}");
}
