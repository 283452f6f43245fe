//! The constants in Rust are those of `nao.toml`.

use kinematics::cameras::{self, FOCAL_LENGTH, IMAGE_RATE, IMAGE_SIZE, OPTICAL_CENTER};
use kinematics::links::{LINKS, Link, LinkName, TORSO};
use kinematics::{chains, feet, inertial, limits, motors, shells};
use serde::Deserialize;
use types::camera::CameraPosition;
use types::joints::JointName;

#[derive(Deserialize)]
struct Nao {
    ball: Ball,
    cameras: Vec<Camera>,
    dimensions: Dimensions,
    fsr: Vec<Resistor>,
    head_collision: HeadCollision,
    imu: Inertial,
    joints: Vec<Joint>,
    links: Vec<LinkMass>,
    lola: Lola,
    meta: Meta,
    sole: Sole,
}

#[derive(Deserialize)]
struct Meta {
    total_mass: f64,
}

#[derive(Deserialize)]
struct Ball {
    radius: f64,
}

#[derive(Deserialize)]
struct Lola {
    joint_order: Vec<String>,
}

#[derive(Deserialize)]
struct Dimensions {
    foot_height: f64,
    hand_offset_x: f64,
    hand_offset_z: f64,
}

#[derive(Deserialize)]
struct Joint {
    name: String,
    parent: String,
    child: String,
    lola_index: usize,
    origin: [f64; 3],
    axis: [f64; 3],
    lower: f64,
    upper: f64,
    max_velocity: f64,
    stall_torque: f64,
    gear_ratio: f64,
    kind: Option<String>,
}

#[derive(Deserialize)]
struct LinkMass {
    name: String,
    joint: Option<String>,
    mass: f64,
    com: [f64; 3],
    inertia_com: [f64; 6],
    aabb_min: Option<[f64; 3]>,
    aabb_max: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct Resistor {
    lola_index: usize,
    position: [f64; 3],
}

#[derive(Deserialize)]
struct Sole {
    left_polygon: Vec<[f64; 2]>,
    z: f64,
}

#[derive(Deserialize)]
struct Inertial {
    gyroscope_position: [f64; 3],
    accelerometer_position: [f64; 3],
}

#[derive(Deserialize)]
struct HeadCollision {
    table_deg: Vec<[f64; 3]>,
}

#[derive(Deserialize)]
struct Camera {
    name: String,
    position: [f64; 3],
    pitch: f64,
    width_px: u32,
    height_px: u32,
    rate_hz: f64,
    focal: [f64; 2],
    center: [f64; 2],
}

fn nao() -> Nao {
    toml::from_str(include_str!("../nao.toml")).unwrap()
}

fn snake_case(camel: &str) -> String {
    let mut snake = String::new();
    for letter in camel.chars() {
        if letter.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}

/// A link as the file names it.
fn file_name(link: &Link) -> String {
    snake_case(&format!("{:?}", link.name))
}

#[test]
fn joints_have_the_names_and_the_order_of_the_wire() {
    let names = JointName::ALL.map(JointName::manufacturer_name);
    assert_eq!(names.to_vec(), nao().lola.joint_order);
}

#[test]
fn limits_are_those_of_the_file() {
    for joint in nao().joints {
        let limits = limits::of(JointName::ALL[joint.lola_index]);
        let expected = (joint.lower, joint.upper, joint.max_velocity);
        assert_eq!(
            (limits.lower, limits.upper, limits.velocity),
            expected,
            "{}",
            joint.name
        );
    }
}

#[test]
fn motors_are_those_of_the_file() {
    for joint in nao().joints {
        let motor = motors::of(JointName::ALL[joint.lola_index]);
        let expected = (joint.stall_torque, joint.gear_ratio);
        assert_eq!(
            (motor.stall_torque, motor.gear_ratio),
            expected,
            "{}",
            joint.name
        );
    }
}

#[test]
fn shells_are_those_of_the_file() {
    for link in nao().links {
        let name = LINKS.iter().find(|other| file_name(other) == link.name);
        let shell = shells::of(name.map_or(LinkName::Torso, |link| link.name));
        let (lowest, highest) = (
            shell.map(|shell| shell.lowest),
            shell.map(|shell| shell.highest),
        );
        assert_eq!(
            (lowest, highest),
            (link.aabb_min, link.aabb_max),
            "{}",
            link.name
        );
    }
}

#[test]
fn links_turn_where_the_file_says() {
    let joints = nao().joints;
    let angles: Vec<_> = joints.iter().filter(|joint| joint.kind.is_none()).collect();
    assert_eq!(angles.len(), LINKS.len());
    for link in &LINKS {
        let joint = angles
            .iter()
            .find(|joint| joint.child == file_name(link))
            .unwrap_or_else(|| panic!("{:?}", link.name));
        assert_eq!(joint.parent, snake_case(&format!("{:?}", link.parent)));
        assert_eq!(JointName::ALL[joint.lola_index], link.joint);
        assert_eq!(joint.origin, link.origin);
        for (in_file, in_code) in joint.axis.iter().zip(link.axis) {
            assert!((in_file - in_code).abs() < 1e-9, "{:?}", link.name);
        }
    }
}

#[test]
fn parents_stand_before_their_children() {
    for (place, link) in LINKS.iter().enumerate() {
        assert_eq!(link.name as usize, place + 1);
        assert!((link.parent as usize) < link.name as usize);
    }
}

#[test]
fn masses_are_those_of_the_file() {
    let file = nao();
    let mut total = 0.0;
    for expected in &file.links {
        let link = LINKS.iter().find(|link| file_name(link) == expected.name);
        assert_eq!(link.is_none(), expected.joint.is_none());
        let mass = link.map_or(TORSO, |link| link.mass);
        assert_eq!(
            (mass.mass, mass.center, mass.inertia),
            (expected.mass, expected.com, expected.inertia_com),
            "{}",
            expected.name
        );
        total += mass.mass;
    }
    assert_eq!(file.links.len(), LINKS.len() + 1);
    assert!((total - file.meta.total_mass).abs() < 1e-9);
}

#[test]
fn feet_and_hands_are_those_of_the_file() {
    let file = nao();
    let resistors = [
        feet::FORCE_SENSITIVE_RESISTORS.left,
        feet::FORCE_SENSITIVE_RESISTORS.right,
    ];
    for resistor in &file.fsr {
        let [x, y] = resistors[resistor.lola_index / 4][resistor.lola_index % 4];
        assert_eq!(resistor.position, [x, y, -feet::SOLE_BELOW_ANKLE]);
    }
    assert_eq!(file.sole.left_polygon, feet::LEFT_SOLE);
    assert_eq!(file.sole.z, -feet::SOLE_BELOW_ANKLE);
    assert_eq!(file.dimensions.foot_height, feet::SOLE_BELOW_ANKLE);
    let hand = [
        file.dimensions.hand_offset_x,
        0.0,
        file.dimensions.hand_offset_z,
    ];
    assert_eq!(chains::HAND_CENTER, hand);
}

#[test]
fn sensors_sit_where_the_file_says() {
    let file = nao();
    assert_eq!(file.imu.gyroscope_position, inertial::GYROSCOPE);
    assert_eq!(file.imu.accelerometer_position, inertial::ACCELEROMETER);
    assert_eq!(
        file.head_collision.table_deg,
        limits::HEAD_PITCH_BY_YAW_DEGREES
    );
}

#[test]
fn cameras_are_those_of_the_file() {
    for camera in nao().cameras {
        let position = match camera.name.as_str() {
            "top" => CameraPosition::Top,
            _ => CameraPosition::Bottom,
        };
        let mount = cameras::mount(position);
        assert_eq!(
            (mount.position, mount.pitch),
            (camera.position, camera.pitch)
        );
        assert_eq!([camera.width_px, camera.height_px], IMAGE_SIZE);
        assert_eq!(
            (camera.focal, camera.center),
            (FOCAL_LENGTH, OPTICAL_CENTER)
        );
        assert_eq!(camera.rate_hz, IMAGE_RATE);
    }
}

#[test]
fn the_parameters_know_the_same_field_and_ball() {
    let parameters: toml::Table =
        toml::from_str(include_str!("../../parameters/default.toml")).unwrap();
    let radius = parameters["field_dimensions"]["ball_radius"]
        .as_float()
        .unwrap();
    assert_eq!(radius, nao().ball.radius);
}
