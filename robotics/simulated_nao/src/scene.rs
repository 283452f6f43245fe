//! What stands on the field beside the ball, and how the cameras take it.
//!
//! | key of `[hardware.simulated]` | says |
//! |---|---|
//! | `[[robots]]` | another robot: where it stands, its team and number |
//! | `[images]` | noise, exposure, white balance and blur of the cameras, colour of the carpet |

use framework::{Error, Result};
use kinematics::forward_kinematics;
use nalgebra::{Isometry3, Point2, Point3};
use serde::Deserialize;
use types::feet::{Feet, Side};
use types::game::PLAYER_COUNT;
use types::joints::Joints;

use crate::camera::figure::{self, Capsule, PARTS};
use crate::field::{GOAL_POST_RADIUS, goal_posts};
use crate::physics::{Body, Start, heading};
use crate::posture;

/// Two teams of seven without this robot.
pub const MOST_ROBOTS: usize = 13;
/// Of a circle around the shoulders and feet of a standing NAO, m.
const ROBOT_RADIUS: f64 = 0.15;

/// Another robot of the world.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotSettings {
    /// Where it stands in the field frame, m.
    pub position: [f64; 2],
    /// Where it looks in the field frame, rad; left out: to the goal at positive x.
    #[serde(default)]
    pub heading: f64,
    /// Whose it is.
    pub team: Team,
    /// Number of its shirt, from 1 to 20.
    pub number: u8,
}

/// Whose robot it is.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum Team {
    /// In blue.
    Own,
    /// In red.
    Opponent,
}

/// How the cameras turn light into bytes; every key may be left out.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct ImageSettings {
    /// Standard deviation of the luminance, of 255; the chrominances have half of it.
    pub noise: f32,
    /// Factor on all light; 1 takes the carpet at a luminance of 92 and lines at 205.
    pub exposure: f32,
    /// Factors on red, green and blue.
    pub white_balance: [f32; 3],
    /// Standard deviation of what optics and motion smear, px.
    pub blur: f32,
    /// Red, green and blue of the carpet in the light for which the cameras are balanced.
    pub carpet: [f32; 3],
    /// Images of another seed have other noise.
    pub seed: u32,
}

/// Another robot: it stands as long as nobody knocks it over.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// On the floor midway between its soles, in the field frame, m.
    pub position: Point2<f64>,
    /// Where it looks in the field frame, rad.
    pub heading: f64,
    /// Whose it is.
    pub team: Team,
    /// Number of its shirt.
    pub number: u8,
    /// The frames' origins of its soles in the field frame, m.
    pub soles: Feet<Point3<f32>>,
    /// From its torso frame to the field frame.
    pub torso_to_field: Isometry3<f64>,
    /// Its body in the field frame.
    pub(crate) parts: [Capsule; PARTS],
}

impl Default for ImageSettings {
    fn default() -> Self {
        Self {
            noise: 1.2,
            exposure: 1.0,
            white_balance: [1.0; 3],
            blur: 0.0,
            carpet: [38.0, 127.95, 52.0],
            seed: 0,
        }
    }
}

impl RobotSettings {
    /// How it begins.
    pub fn start(&self) -> Start {
        let [x, y] = self.position;
        Start {
            joints: posture::standing(),
            pose: [x, y, self.heading],
        }
    }
}

impl Robot {
    /// A robot with its torso at a pose in the field frame.
    pub fn new(settings: &RobotSettings, torso_to_field: &Isometry3<f64>) -> Self {
        let joints = settings.start().joints;
        Self::posed(settings.team, settings.number, &joints, torso_to_field)
    }

    /// A robot with joints at angles in rad and its torso at a pose in the field frame.
    pub fn posed(
        team: Team,
        number: u8,
        joints: &Joints<f64>,
        torso_to_field: &Isometry3<f64>,
    ) -> Self {
        let body = Body::new(*joints, *torso_to_field);
        let ground = body.ground_to_field();
        let poses = forward_kinematics(&joints.map(|angle| angle as f32));
        let parts = figure::parts(&poses, figure::shirt(team));
        let sole = |side| Point3::from(body.soles_to_field.on(side).translation.vector).cast();
        Self {
            position: ground.translation.vector.xy().into(),
            heading: heading(&ground),
            team,
            number,
            soles: Feet {
                left: sole(Side::Left),
                right: sole(Side::Right),
            },
            torso_to_field: *torso_to_field,
            parts: parts.map(|part| part.transformed(&torso_to_field.cast())),
        }
    }
}

impl From<&RobotSettings> for Robot {
    /// Where it begins.
    fn from(settings: &RobotSettings) -> Self {
        let body = Body::standing(&settings.start());
        Self::new(settings, &body.torso_to_field)
    }
}

/// Refuses robots and images that cannot be.
///
/// # Errors
/// Names the key.
pub fn check(robots: &[RobotSettings], images: &ImageSettings) -> Result<()> {
    let wrong = |message: String| Err(Error::new(format!("hardware.simulated.{message}")));
    if robots.len() > MOST_ROBOTS {
        let count = robots.len();
        return wrong(format!(
            "robots: the field holds at most {MOST_ROBOTS} others, not {count}"
        ));
    }
    for (index, robot) in robots.iter().enumerate() {
        let [x, y] = robot.position;
        if !(x.is_finite() && y.is_finite() && robot.heading.is_finite()) {
            return wrong(format!(
                "robots[{index}]: ({x}, {y}) with heading {} is no place on the field",
                robot.heading
            ));
        }
        if !(1..=PLAYER_COUNT).contains(&robot.number.into()) {
            return wrong(format!(
                "robots[{index}].number: shirts have numbers from 1 to {PLAYER_COUNT}, not {}",
                robot.number
            ));
        }
    }
    let [red, green, blue] = images.white_balance;
    let [carpet_red, carpet_green, carpet_blue] = images.carpet;
    for (key, value, most) in [
        ("noise", images.noise, 64.0),
        ("exposure", images.exposure, 16.0),
        ("white_balance[0]", red, 16.0),
        ("white_balance[1]", green, 16.0),
        ("white_balance[2]", blue, 16.0),
        ("blur", images.blur, 8.0),
        ("carpet[0]", carpet_red, 255.0),
        ("carpet[1]", carpet_green, 255.0),
        ("carpet[2]", carpet_blue, 255.0),
    ] {
        if !(0.0..=most).contains(&value) {
            return wrong(format!(
                "images.{key}: must be from 0 to {most}, not {value}"
            ));
        }
    }
    Ok(())
}

/// What a robot can run into: the middle of each obstacle in the field frame and its radius, m.
pub fn obstacles(robots: &[Robot]) -> impl Iterator<Item = (Point2<f64>, f64)> + Clone {
    let posts = goal_posts().map(|post| (post.cast(), f64::from(GOAL_POST_RADIUS)));
    let robots = robots.iter().map(|robot| (robot.position, ROBOT_RADIUS));
    robots.chain(posts)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot(text: &str) -> std::result::Result<RobotSettings, toml::de::Error> {
        toml::from_str(text)
    }

    #[test]
    fn a_robot_has_a_place_a_team_and_a_number() {
        let settings =
            robot("position = [1.0, 2.0]\nheading = 3.0\nteam = \"opponent\"\nnumber = 4").unwrap();
        let robot = Robot::from(&settings);
        assert_eq!(robot.team, Team::Opponent);
        let middle = nalgebra::center(&robot.soles.left, &robot.soles.right);
        assert!((middle - Point3::new(1.0, 2.0, 0.0)).norm() < 1e-4);
        let lowest = robot.parts.iter().map(|part| part.lowest());
        let lowest = lowest.fold(f32::MAX, f32::min);
        assert!(lowest.abs() < 0.003, "{lowest}");
    }

    #[test]
    fn a_robot_of_no_team_is_refused() {
        for (text, expected) in [
            ("position = [1.0, 2.0]\nnumber = 1", "`team`"),
            (
                "position = [1.0, 2.0]\nnumber = 1\nteam = \"blue\"",
                "`own` or `opponent`",
            ),
        ] {
            let message = robot(text).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
    }

    #[test]
    fn what_cannot_be_is_named() {
        let somebody = RobotSettings {
            position: [0.0, 1.0],
            heading: 0.0,
            team: Team::Own,
            number: 2,
        };
        let nowhere = RobotSettings {
            position: [f64::NAN, 1.0],
            ..somebody.clone()
        };
        let nobody = RobotSettings {
            number: 0,
            ..somebody.clone()
        };
        let images = ImageSettings::default();
        let bright = ImageSettings {
            exposure: f32::NAN,
            ..images
        };
        for (robots, images, expected) in [
            (vec![nowhere], images, "robots[0]: (NaN, 1)"),
            (vec![somebody.clone(), nobody], images, "robots[1].number"),
            (vec![somebody.clone(); 14], images, "at most 13"),
            (vec![], bright, "images.exposure"),
        ] {
            let message = check(&robots, &images).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
        assert!(check(&[somebody], &images).is_ok());
    }
}
