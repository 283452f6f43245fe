//! Physics with masses, torques and contacts: rigid bodies in the engine Rapier.
//!
//! Each robot is one articulated body of 25 links in reduced coordinates, so that its joints cannot come
//! apart. Links of the same robot do not touch each other.

mod articulation;
mod ball;
mod convert;
mod mjcf;
mod motor;
mod scenery;
mod shape;
mod soles;

use kinematics::inertial::GRAVITY;
use nalgebra::Isometry3;
use rapier3d_f64::prelude::{PhysicsWorld, RigidBodyHandle, Vector};
use types::motor_commands::MotorCommands;

use self::articulation::Articulation;
pub use self::ball::ROLLING_DECELERATION;
use self::ball::RollingBall;
pub use self::mjcf::mjcf;
use super::{Ball, Body, Disturbance, Physics, STEP, Situation, Start};

/// Parts of a step, each of which moves the bodies. One more costs as much as the first.
const SUBSTEPS: usize = 2;
/// How often all forces are weighed against each other in each part, friction included. Measured: with
/// one sweep, or with friction in half of them, the feet of a standing robot creep by 10° in a minute;
/// so by 0.03°.
const SWEEPS: usize = 4;
/// Tells the engine how small its world is: a tenth of a metre is large for a NAO.
const LENGTH_UNIT: f64 = 0.1;

/// Robots, bystanders and a ball on the carpet between two goals.
pub struct Dynamic {
    world: PhysicsWorld,
    robots: Vec<Articulation>,
    bodies: Vec<Body>,
    bystander_handles: Vec<RigidBodyHandle>,
    bystanders: Vec<Isometry3<f64>>,
    ball: Option<RollingBall>,
}

impl Dynamic {
    /// The robots of a situation on the floor, at rest.
    pub fn new(situation: &Situation) -> Self {
        let mut world = empty_world();
        scenery::insert(&mut world, situation.carpet_friction);
        let robots: Vec<_> = situation
            .robots
            .iter()
            .map(|start| Articulation::insert(&mut world, start))
            .collect();
        let bystander_handles: Vec<_> = situation
            .bystanders
            .iter()
            .map(|start| shape::insert_statue(&mut world, start))
            .collect();
        let bystanders = situation.bystanders.iter();
        Self {
            bodies: situation.robots.iter().map(Body::standing).collect(),
            bystanders: bystanders
                .map(|start| Body::standing(start).torso_to_field)
                .collect(),
            ball: situation
                .ball
                .map(|position| RollingBall::insert(&mut world, position)),
            world,
            robots,
            bystander_handles,
        }
    }

    /// Where the engine has the links of a robot, in the order of [`kinematics::links::LinkName`], in
    /// the field frame.
    pub fn links(&self, robot: usize) -> Vec<Isometry3<f64>> {
        self.robots
            .get(robot)
            .map_or_else(Vec::new, |robot| robot.links(&self.world))
    }

    /// Puts a robot somewhere, at rest: its joints at angles in rad, its torso at a pose in the field
    /// frame.
    pub fn place(
        &mut self,
        robot: usize,
        joints: &types::joints::Joints<f64>,
        torso_to_field: &Isometry3<f64>,
    ) {
        if let (Some(articulation), Some(body)) =
            (self.robots.get_mut(robot), self.bodies.get_mut(robot))
        {
            articulation.place(&mut self.world, joints, torso_to_field);
            *body = Body::new(*joints, *torso_to_field);
        }
    }

    /// Puts a robot at a pose, its joints as they are, as high as `at` says.
    fn put(&mut self, robot: usize, pose: [f64; 3], at: fn(&Start) -> Body) {
        if let Some(body) = self.bodies.get(robot) {
            let joints = body.joints;
            let torso_to_field = at(&Start { joints, pose }).torso_to_field;
            self.place(robot, &joints, &torso_to_field);
        }
    }
}

/// The engine as it is set up here, with nothing in it but gravity.
pub fn empty_world() -> PhysicsWorld {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, 0.0, -GRAVITY);
    world.integration_parameters.dt = STEP.as_secs_f64();
    world.integration_parameters.num_solver_iterations = SUBSTEPS;
    world.integration_parameters.length_unit = LENGTH_UNIT;
    world.integration_parameters.num_internal_pgs_iterations = SWEEPS;
    world.integration_parameters.friction_in_bias_pass = true;
    world
}

impl Physics for Dynamic {
    fn step(&mut self, commands: &[MotorCommands]) {
        for (index, robot) in self.robots.iter_mut().enumerate() {
            robot.drive(&mut self.world, commands.get(index));
        }
        self.world.step();
        if let Some(ball) = &self.ball {
            ball.resist_rolling(&mut self.world);
        }
        for (robot, body) in self.robots.iter_mut().zip(&mut self.bodies) {
            *body = robot.read(&mut self.world);
        }
        for (handle, pose) in self.bystander_handles.iter().zip(&mut self.bystanders) {
            *pose = convert::isometry(self.world.bodies[*handle].position());
        }
    }

    fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    fn ball(&self) -> Option<Ball> {
        self.ball.as_ref().map(|ball| ball.read(&self.world))
    }

    fn bystanders(&self) -> &[Isometry3<f64>] {
        &self.bystanders
    }

    fn disturb(&mut self, disturbance: &Disturbance) {
        match *disturbance {
            Disturbance::Push { robot, impulse } => {
                if let Some(robot) = self.robots.get_mut(robot) {
                    robot.push(&mut self.world, &impulse);
                }
            }
            Disturbance::MoveBall { position, velocity } => {
                if let Some(ball) = &self.ball {
                    ball.place(&mut self.world, &position, &velocity);
                }
            }
            Disturbance::Kidnap { robot, pose } => self.put(robot, pose, Body::standing),
            Disturbance::Hold { robot, pose } => self.put(robot, pose, Body::held),
        }
    }
}
