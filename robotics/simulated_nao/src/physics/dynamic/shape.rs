//! How much room the parts of a robot take, and of what they are made.

use kinematics::feet::{LEFT_SOLE, SOLE_BELOW_ANKLE};
use kinematics::links::{LINKS, LinkName, Mass, TORSO};
use kinematics::{forward_kinematics, shells};
use rapier3d_f64::prelude::{
    CoefficientCombineRule, ColliderBuilder, MassProperties, PhysicsWorld, RigidBodyBuilder,
    RigidBodyHandle, Vector,
};

use super::super::{Body, Start};
use super::convert::{inertia, to_pose};

/// Rubber of the soles on carpet (an estimate; simulators of the NAO have 0.45 to 7).
const SOLE_FRICTION: f64 = 0.9;
/// Plastic on carpet (an estimate).
const SHELL_FRICTION: f64 = 0.5;

/// How far the boxes of thighs and shins reach down, m: a shin's shell ends in a fork around the ankle,
/// and the corners of its box would stand on the floor before the toes do.
const LIMB_ENDS: f64 = -0.085;

/// Every coefficient stands for one partner; the floor has 1.
pub(super) const COMBINATION: CoefficientCombineRule = CoefficientCombineRule::Multiply;

/// How much room a link takes, in its own frame, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Volume {
    Ball { center: [f64; 3], radius: f64 },
    Box { center: [f64; 3], half: [f64; 3] },
}

/// What a link touches others with, in its own frame; `None` for small links within others.
pub(super) fn collider(link: LinkName) -> Option<ColliderBuilder> {
    let (volume, friction) = volume(link)?;
    let part = match volume {
        Volume::Ball { center, radius } => {
            ColliderBuilder::ball(radius).translation(Vector::from_array(center))
        }
        Volume::Box {
            center,
            half: [x, y, z],
        } => ColliderBuilder::cuboid(x, y, z).translation(Vector::from_array(center)),
    };
    Some(finish(part, friction))
}

/// The room of a link and its friction on carpet; `None` for small links within others.
pub(super) fn volume(link: LinkName) -> Option<(Volume, f64)> {
    let (lowest, highest, friction) = match link {
        LinkName::LeftFoot => sole(1.0),
        LinkName::RightFoot => sole(-1.0),
        LinkName::Head => {
            let head = Volume::Ball {
                center: [0.0, 0.0, 0.0565],
                radius: 0.06,
            };
            return Some((head, SHELL_FRICTION));
        }
        LinkName::Neck
        | LinkName::LeftShoulder
        | LinkName::RightShoulder
        | LinkName::LeftPelvis
        | LinkName::RightPelvis
        | LinkName::LeftHip
        | LinkName::RightHip
        | LinkName::LeftAnkle
        | LinkName::RightAnkle => return None,
        _ => {
            let shell = shells::of(link)?;
            let mut lowest = shell.lowest;
            lowest[2] = lowest[2].max(LIMB_ENDS);
            (lowest, shell.highest, SHELL_FRICTION)
        }
    };
    let half: [f64; 3] = std::array::from_fn(|axis| (highest[axis] - lowest[axis]) / 2.0);
    let center = std::array::from_fn(|axis| (highest[axis] + lowest[axis]) / 2.0);
    Some((Volume::Box { center, half }, friction))
}

/// The mass of a link for the engine.
pub(super) fn mass_properties(mass: &Mass) -> MassProperties {
    let center = Vector::from_array(mass.center);
    MassProperties::with_inertia_matrix(center, mass.mass, inertia(mass.inertia))
}

/// A robot whose joints cannot turn: one rigid body with its torso's frame.
pub(super) fn insert_statue(world: &mut PhysicsWorld, start: &Start) -> RigidBodyHandle {
    let poses = forward_kinematics(&start.joints);
    let links = LINKS.iter().map(|link| (link.name, link.mass));
    let links: Vec<_> = links.chain([(LinkName::Torso, TORSO)]).collect();
    let mass = links
        .iter()
        .map(|(link, mass)| mass_properties(mass).transform_by(&to_pose(&poses.link(*link))))
        .fold(MassProperties::default(), |sum, mass| sum + mass);
    let body = RigidBodyBuilder::dynamic()
        .pose(to_pose(&Body::standing(start).torso_to_field))
        .additional_mass_properties(mass);
    let body = world.insert_body(body);
    for (link, _) in links {
        if let Some(part) = collider(link) {
            let place = to_pose(&poses.link(link)) * part.position;
            world.insert_collider(part.position(place), Some(body));
        }
    }
    body
}

/// A box around the sole and the shoe above it: a robot stands on its four corners.
fn sole(outward: f64) -> ([f64; 3], [f64; 3], f64) {
    let xs = LEFT_SOLE.map(|[x, _]| x);
    let ys = LEFT_SOLE.map(|[_, y]| y * outward);
    let least = |values: [f64; 14]| values.into_iter().fold(f64::INFINITY, f64::min);
    let greatest = |values: [f64; 14]| values.into_iter().fold(f64::NEG_INFINITY, f64::max);
    (
        [least(xs), least(ys), -SOLE_BELOW_ANKLE],
        [greatest(xs), greatest(ys), SHOE_HEIGHT - SOLE_BELOW_ANKLE],
        SOLE_FRICTION,
    )
}

/// Of the shoe's box above the sole, m (simulator of B-Human's robots).
const SHOE_HEIGHT: f64 = 0.03;

/// Masses are those of the links, whatever the volume; nothing of a robot bounces.
fn finish(part: ColliderBuilder, friction: f64) -> ColliderBuilder {
    part.density(0.0)
        .friction(friction)
        .friction_combine_rule(COMBINATION)
        .restitution(0.0)
        .restitution_combine_rule(COMBINATION)
}
