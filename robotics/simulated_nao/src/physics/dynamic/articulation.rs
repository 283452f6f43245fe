//! One robot in the engine: its links, its joints, its motors, and what its sensors would feel.

use kinematics::inertial::ACCELEROMETER;
use kinematics::inertial::GRAVITY;
use kinematics::links::{LINKS, Link, LinkName, TORSO};
use kinematics::{forward_kinematics, limits};
use nalgebra::{Isometry3, Vector3};
use rapier3d_f64::prelude::{
    ColliderHandle, JointAxis, MotorModel, MultibodyDofCoupling, MultibodyJointHandle,
    PhysicsWorld, RevoluteJointBuilder, RigidBodyBuilder, RigidBodyHandle, Vector,
};
use types::feet::{Feet, Side};
use types::joints::{JointName, Joints};
use types::motor_commands::MotorCommands;

use super::super::{Body, STEP, Start};
use super::convert::{isometry, to_pose, to_vector, vector};
use super::motor::Servo;
use super::{shape, soles};

/// Where the engine keeps the angle of a hinge among the coordinates of a joint.
const ANGLE: usize = JointAxis::AngX as usize;

/// The handles of one robot, and what the engine does not keep.
pub(super) struct Articulation {
    torso: RigidBodyHandle,
    links: Vec<RigidBodyHandle>,
    /// In the order of [`LINKS`].
    hinges: Vec<MultibodyJointHandle>,
    soles: Feet<ColliderHandle>,
    /// Angles in rad; hands, which are no links, from 0 to 1.
    joints: Joints<f64>,
    /// Of the accelerometer in the field frame after the last step, m/s.
    velocity: Vector3<f64>,
}

impl Articulation {
    /// A robot at rest on the floor.
    pub(super) fn insert(world: &mut PhysicsWorld, start: &Start) -> Self {
        let mut links = Vec::with_capacity(LINKS.len() + 1);
        let mut colliders = Vec::with_capacity(LINKS.len() + 1);
        let masses = LINKS.iter().map(|link| (link.name, link.mass));
        for (link, mass) in [(LinkName::Torso, TORSO)].into_iter().chain(masses) {
            let body = RigidBodyBuilder::dynamic()
                .additional_mass_properties(shape::mass_properties(&mass))
                .can_sleep(false);
            let body = world.insert_body(body);
            let collider = shape::collider(link);
            colliders.push(collider.map(|part| world.insert_collider(part, Some(body))));
            links.push(body);
        }
        let hinges = LINKS.iter().map(|link| {
            let parent = links[link.parent as usize];
            world
                .insert_multibody_joint(parent, links[link.name as usize], hinge(link))
                .expect("links form a tree, parents first")
        });
        let hinges: Vec<_> = hinges.collect();
        let sole = |foot| colliders[foot as usize].expect("feet have soles");
        let mut articulation = Self {
            torso: links[LinkName::Torso as usize],
            soles: Feet {
                left: sole(LinkName::LeftFoot),
                right: sole(LinkName::RightFoot),
            },
            links,
            hinges,
            joints: start.joints,
            velocity: Vector3::zeros(),
        };
        articulation.set_up_gears(world);
        let torso_to_field = Body::standing(start).torso_to_field;
        articulation.place(world, &start.joints, &torso_to_field);
        articulation
    }

    /// Rotors, friction, and the one motor of both hips.
    fn set_up_gears(&self, world: &mut PhysicsWorld) {
        let (multibody, _) = world
            .multibody_joints
            .get_mut(self.hinges[0])
            .expect("the hinge was inserted");
        multibody.set_self_contacts_enabled(false);
        multibody.damping_mut().fill(0.0);
        let mut pelvises = Vec::new();
        for (index, link) in LINKS.iter().enumerate() {
            // The engine numbers links as they came; the torso is the first.
            let number = index + 1;
            let place = multibody.link(number).map(|link| link.assembly_id());
            let place = place.expect("every hinge has a link");
            let servo = Servo::of(link.joint);
            let share = share(link.joint);
            multibody.armature_mut()[place] = servo.armature * share;
            multibody.frictions_mut()[place] = servo.friction * share;
            if link.joint == JointName::HipYawPitch {
                pelvises.push(number);
            }
        }
        if let [left, right] = pelvises[..] {
            multibody.add_dof_coupling(MultibodyDofCoupling {
                link1: left,
                dof1: 0,
                axis1: ANGLE,
                link2: right,
                dof2: 0,
                axis2: ANGLE,
                coeff: 1.0,
                offset: 0.0,
            });
        }
    }

    /// Puts the robot somewhere, at rest.
    pub(super) fn place(
        &mut self,
        world: &mut PhysicsWorld,
        joints: &Joints<f64>,
        torso_to_field: &Isometry3<f64>,
    ) {
        world.bodies[self.torso].set_position(to_pose(torso_to_field), true);
        let (multibody, _) = world
            .multibody_joints
            .get_mut(self.hinges[0])
            .expect("the hinge was inserted");
        multibody.forward_kinematics(&world.bodies, true);
        let mut turns = vec![0.0; multibody.ndofs()];
        for (index, link) in LINKS.iter().enumerate() {
            let place = multibody.link(index + 1).expect("every hinge has a link");
            let angle = place.joint.coords()[ANGLE];
            turns[place.assembly_id()] = joints[link.joint] - angle;
        }
        multibody.apply_displacements(&turns);
        multibody.generalized_velocity_mut().fill(0.0);
        multibody.forward_kinematics(&world.bodies, false);
        multibody.update_rigid_bodies(&mut world.bodies, true);
        for link in &self.links {
            let body = &mut world.bodies[*link];
            body.set_linvel(Vector::ZERO, true);
            body.set_angvel(Vector::ZERO, true);
        }
        self.joints = *joints;
        self.velocity = Vector3::zeros();
    }

    /// Lets the motors pull for one step; without commands they are limp.
    pub(super) fn drive(&mut self, world: &mut PhysicsWorld, commands: Option<&MotorCommands>) {
        let (multibody, _) = world
            .multibody_joints
            .get_mut(self.hinges[0])
            .expect("the hinge was inserted");
        for (index, link) in LINKS.iter().enumerate() {
            let joint = link.joint;
            let servo = Servo::of(joint);
            let (target, stiffness) = target(commands, joint, self.joints[joint]);
            let hinge = multibody.link(index + 1).expect("every hinge has a link");
            let (angle, speed) = (
                hinge.joint.coords()[ANGLE],
                multibody.joint_velocity(hinge)[0],
            );
            let share = share(joint);
            let limit = servo.limit(stiffness, speed, target - angle) * share;
            let hinge = multibody
                .link_mut(index + 1)
                .expect("every hinge has a link");
            let data = &mut hinge.joint.data;
            data.set_motor(
                JointAxis::AngX,
                target,
                0.0,
                servo.proportional * share,
                servo.derivative * share,
            );
            data.set_motor_max_force(JointAxis::AngX, limit);
        }
        for hand in [JointName::LeftHand, JointName::RightHand] {
            let (target, stiffness) = target(commands, hand, self.joints[hand]);
            let reach = limits::of(hand).velocity * stiffness * STEP.as_secs_f64();
            let opening = &mut self.joints[hand];
            *opening += (target - *opening).clamp(-reach, reach);
        }
    }

    /// Adds an impulse (field frame, N s) at the origin of the torso; it comes within the next step.
    pub(super) fn push(&mut self, world: &mut PhysicsWorld, impulse: &Vector3<f64>) {
        let torso = &mut world.bodies[self.torso];
        let place = torso.translation();
        torso.add_force_at_point(to_vector(&(impulse / STEP.as_secs_f64())), place, true);
    }

    /// The body after a step.
    pub(super) fn read(&mut self, world: &mut PhysicsWorld) -> Body {
        let (multibody, _) = world
            .multibody_joints
            .get(self.hinges[0])
            .expect("the hinge was inserted");
        for (index, link) in LINKS.iter().enumerate() {
            let hinge = multibody.link(index + 1).expect("every hinge has a link");
            self.joints[link.joint] = hinge.joint.coords()[ANGLE];
        }
        let torso = &mut world.bodies[self.torso];
        // A push lasts one step.
        torso.reset_forces(false);
        torso.reset_torques(false);
        let torso = &world.bodies[self.torso];
        let torso_to_field = isometry(torso.position());
        let to_torso = torso_to_field.rotation.inverse();
        let sensor = torso_to_field * nalgebra::Point3::from(ACCELEROMETER);
        let velocity = vector(torso.velocity_at_point(to_vector(&sensor.coords)));
        let acceleration = (velocity - self.velocity) / STEP.as_secs_f64();
        self.velocity = velocity;
        let poses = forward_kinematics(&self.joints);
        Body {
            contact_forces: Feet {
                left: soles::contact_forces(world, self.soles.left, Side::Left),
                right: soles::contact_forces(world, self.soles.right, Side::Right),
            },
            angular_velocity: to_torso * vector(torso.angvel()),
            proper_acceleration: to_torso * (acceleration + Vector3::z() * GRAVITY),
            ..Body::from_poses(self.joints, &poses, torso_to_field)
        }
    }

    /// Where the engine has the links, in the field frame.
    pub(super) fn links(&self, world: &PhysicsWorld) -> Vec<Isometry3<f64>> {
        let poses = self.links.iter().map(|link| world.bodies[*link].position());
        poses.map(isometry).collect()
    }
}

/// Where a joint shall turn, and with which share of its current.
fn target(commands: Option<&MotorCommands>, joint: JointName, angle: f64) -> (f64, f64) {
    commands.map_or((angle, 0.0), |commands| {
        (
            f64::from(limits::clamp(joint, commands.positions[joint])),
            f64::from(commands.stiffnesses[joint]).clamp(0.0, 1.0),
        )
    })
}

/// One motor turns two hinges at the hips: each gets half of it.
pub(super) fn share(joint: JointName) -> f64 {
    if joint == JointName::HipYawPitch {
        0.5
    } else {
        1.0
    }
}

fn hinge(link: &Link) -> RevoluteJointBuilder {
    let limits = limits::of(link.joint);
    RevoluteJointBuilder::new(Vector::from_array(link.axis))
        .local_anchor1(Vector::from_array(link.origin))
        .limits([limits.lower, limits.upper])
        .motor_model(MotorModel::ForceBased)
}
