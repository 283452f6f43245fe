//! The NAO in lockstep: the whole generated robot on the simulated body, with the truth beside it.

use std::sync::Arc;

use framework::driver::lockstep::{Lockstep, Paused};
use framework::parameters::Layers;
use framework::procedure::PendingAny;
use framework::robot::{Robot, Start};
use framework::{Clock, Given, Hardware as _, HardwareContext, Instance, Stop, Timestamp};
use nao_runtime::parameters::Parameters;
use nao_runtime::runtime;
use simulated_nao::Hardware;
use types::ball::BallCandidate;
use types::camera::{CameraMatrix, CameraPosition};

use crate::root;

/// The instances of Vision and the camera of each.
pub const CAMERAS: [(&str, CameraPosition); 2] = [
    ("VisionTop", CameraPosition::Top),
    ("VisionBottom", CameraPosition::Bottom),
];

/// A robot in its world, before its first cycle.
pub struct Nao {
    pub hardware: Arc<Hardware>,
    pub robot: Robot<Parameters>,
    /// Where the last run ended.
    paused: Option<Paused>,
}

impl Nao {
    /// With these options of the simulated hardware and these settings of parameters (`a.b`, `value`), on kinematic physics: tests
    /// of what the robot knows are not about its balance.
    pub fn new(options: &[&str], settings: &[(&str, &str)]) -> Self {
        let options: Vec<_> = options.iter().chain(&["--physics", "kinematic"]).collect();
        Self::with_physics_of(&options, settings)
    }

    /// The same with masses, torques and contacts: the robot can fall.
    pub fn dynamic(options: &[&str], settings: &[(&str, &str)]) -> Self {
        let options: Vec<_> = options.iter().chain(&["--physics", "dynamic"]).collect();
        Self::with_physics_of(&options, settings)
    }

    fn with_physics_of(options: &[&&str], settings: &[(&str, &str)]) -> Self {
        let parameters = Layers {
            directory: root().join("robotics/parameters"),
            location: Some("simulated".to_owned()),
            settings: settings
                .iter()
                .map(|(path, value)| ((*path).to_owned(), (*value).to_owned()))
                .collect(),
            ..Layers::default()
        }
        .load()
        .expect("the parameters of the repository are complete");
        let (clock, stop) = (Clock::stepped(), Stop::default());
        let hardware = Hardware::new(HardwareContext {
            // Tests run side by side, so none may take the ports of a real game.
            options: options
                .iter()
                .chain(&[&"--free-ports"])
                .map(|option| (**option).to_owned())
                .collect(),
            table: parameters
                .hardware("simulated")
                .expect("a table or nothing"),
            run_folder: std::env::temp_dir(),
            clock: clock.clone(),
            stop: stop.clone(),
        })
        .expect("the simulated NAO needs nothing but a socket");
        let hardware = Arc::new(hardware);
        let parameters = parameters
            .deserialize()
            .expect("the parameters fit the nodes");
        let robot = runtime::create(
            &hardware,
            Start {
                clock,
                stop,
                parameters,
            },
        )
        .expect("every node can be created");
        Self {
            hardware,
            robot,
            paused: None,
        }
    }

    /// Runs until `seconds` of virtual time; `observe` sees every instance after each finished cycle.
    /// No node fails and no event is missed.
    pub fn run(&mut self, seconds: f64, observe: impl FnMut(&Hardware, &dyn Instance)) {
        self.drive(None, seconds, observe);
    }

    /// The same under chaos, where events may be missed.
    pub fn run_in_chaos(
        &mut self,
        seed: u64,
        seconds: f64,
        observe: impl FnMut(&Hardware, &dyn Instance),
    ) {
        self.drive(Some(seed), seconds, observe);
    }

    fn drive(
        &mut self,
        chaos: Option<u64>,
        seconds: f64,
        mut observe: impl FnMut(&Hardware, &dyn Instance),
    ) {
        let end = Timestamp::from_nanos((seconds * 1e9) as u64);
        let hardware = self.hardware.clone();
        let lockstep = Lockstep::new(&mut self.robot, &*self.hardware);
        let lockstep = match self.paused.take() {
            Some(paused) => lockstep.after(paused),
            None => lockstep,
        };
        let mut lockstep = match chaos {
            Some(seed) => lockstep.chaotic(seed),
            None => lockstep,
        };
        lockstep
            .run_until(end, |instance| observe(&hardware, instance))
            .expect("the robot does not stop");
        self.paused = Some(lockstep.pause());
        for instance in &self.robot.instances {
            let (name, counts) = (instance.description().name, instance.report().counts);
            assert_eq!(counts.failures, 0, "calls of nodes failed in {name}");
            // Under chaos cycles take so long that events are missed. A datagram that comes while another one waits is an
            // event less and read all the same.
            if chaos.is_none() && name != "SplNetwork" {
                assert_eq!(counts.missed, 0, "events were missed by {name}");
            }
        }
    }
}

/// Calls a procedure of Control, which sees it in its next cycle.
pub fn call(
    robot: &mut Robot<Parameters>,
    procedure: &str,
    request: serde_json::Value,
) -> Box<dyn PendingAny> {
    let access = robot.access("Control").expect("the robot has Control");
    let mut procedures = access.procedures.iter();
    let (_, caller) = procedures
        .find(|(name, _)| *name == procedure)
        .unwrap_or_else(|| panic!("Control has no procedure `{procedure}`"));
    caller
        .call_any(&Given::from(&request))
        .expect("it is a request of this procedure")
}

/// A main output of the instance's last finished cycle.
pub fn output<T: serde::de::DeserializeOwned>(instance: &dyn Instance, name: &str) -> T {
    let value = instance
        .main_output(name)
        .unwrap_or_else(|| panic!("{} has no `{name}`", instance.description().name));
    let value = serde_json::to_value(value.as_serialize()).expect("outputs serialise");
    serde_json::from_value(value).expect("what was written can be read")
}

/// The camera matrix that Vision used in its last cycle.
pub fn camera_matrix(instance: &dyn Instance) -> Option<CameraMatrix> {
    output(instance, "camera_matrix")
}

/// The balls that Vision saw in its last cycle, best first.
pub fn balls(instance: &dyn Instance) -> Vec<BallCandidate> {
    output(instance, "balls")
}

/// The camera of an instance of Vision.
pub fn camera_of(instance: &dyn Instance) -> Option<CameraPosition> {
    let name = instance.description().name;
    CAMERAS
        .iter()
        .find(|(instance, _)| *instance == name)
        .map(|(_, camera)| *camera)
}
