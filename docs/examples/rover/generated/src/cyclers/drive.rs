//! Cycler `Drive` (real-time), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::HistoricInput;
use framework::InNode;
use framework::OnFailure;
use framework::PerceptionInput;
use framework::Result;
use rover_nodes::drive::motor_sender;
use rover_nodes::drive::odometry;
use rover_nodes::drive::steering;
use rover_nodes::drive::wheel_receiver;
use rover_nodes::interfaces::Encoders;
use rover_nodes::interfaces::Motors;

use crate::databases::drive::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub motor_sender: Guarded<motor_sender::MotorSender>,
    pub odometry: Guarded<odometry::Odometry>,
    pub steering: Guarded<steering::Steering>,
    pub wheel_receiver: Guarded<wheel_receiver::WheelReceiver>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            wheel_receiver: Guarded::new(
                "rover_nodes::drive::wheel_receiver",
                OnFailure::Stop,
                Self::create_wheel_receiver()?,
            ),
            odometry: Guarded::new(
                "rover_nodes::drive::odometry",
                OnFailure::Stop,
                Self::create_odometry()?,
            ),
            steering: Guarded::new(
                "rover_nodes::drive::steering",
                OnFailure::Stop,
                Self::create_steering()?,
            ),
            motor_sender: Guarded::new(
                "rover_nodes::drive::motor_sender",
                OnFailure::Stop,
                Self::create_motor_sender()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl Encoders>) -> Result<()> {
        self.wheel_receiver(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.rolled.replace(&mut frame.own.rolled);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle(&mut self, frame: &mut Frame<'_, impl Motors>) -> Result<()> {
        self.odometry(frame)?;
        self.steering(frame)?;
        self.motor_sender(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely(&mut self, frame: &mut Frame<'_, impl Motors>) -> Result<()> {
        self.cycle(frame)
    }

    /// speeds (required) -> hardware
    #[inline(always)]
    fn motor_sender(&mut self, frame: &mut Frame<'_, impl Motors>) -> Result<()> {
        if let Some(speeds) = frame.own.speeds.as_ref() {
            let context = motor_sender::CycleContext {
                hardware_interface: frame.hardware_interface,
                speeds,
            };
            self.motor_sender.call(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent.
            self.motor_sender.skip();
        }
        Ok(())
    }

    /// rolled -> pose
    #[inline(always)]
    fn odometry<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = odometry::CycleContext {
            rolled: &frame.own.rolled,
            track: &frame.parameters.odometry.track,
        };
        let outputs = self.odometry.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.pose = outputs.pose.value;
        if let Some(injections) = frame.injections {
            injections.pose.replace(&mut frame.own.pose);
        }
        Ok(())
    }

    /// perception Lidar.freeways, historic pose, pose -> speeds
    #[inline(always)]
    fn steering<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let freeways = frame.perception.lidar.project(|outputs| &outputs.freeways);
        let poses = frame.historic.pose.project(|pose| pose);
        let context = steering::CycleContext {
            freeways: PerceptionInput::new(&freeways),
            poses: HistoricInput::new(&poses, frame.cycle.time.start, &frame.own.pose),
            pose: &frame.own.pose,
            goals: &frame.parameters.steering.goals,
            tolerance: &frame.parameters.steering.tolerance,
            look_ahead: &frame.parameters.steering.look_ahead,
            cruising: &frame.parameters.steering.cruising,
            gain: &frame.parameters.steering.gain,
            fastest_turn: &frame.parameters.steering.fastest_turn,
        };
        let outputs = self.steering.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.speeds = outputs.speeds.value;
        if let Some(injections) = frame.injections {
            injections.speeds.replace(&mut frame.own.speeds);
        }
        Ok(())
    }

    /// hardware -> rolled
    #[inline(always)]
    fn wheel_receiver(&mut self, frame: &mut Frame<'_, impl Encoders>) -> Result<()> {
        let context = wheel_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self
            .wheel_receiver
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.rolled = outputs.rolled.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    fn create_motor_sender() -> Result<motor_sender::MotorSender> {
        let context = motor_sender::CreationContext {};
        motor_sender::MotorSender::new(context)
            .in_node("rover_nodes::drive::motor_sender")
    }

    fn create_odometry() -> Result<odometry::Odometry> {
        let context = odometry::CreationContext {};
        odometry::Odometry::new(context).in_node("rover_nodes::drive::odometry")
    }

    fn create_steering() -> Result<steering::Steering> {
        let context = steering::CreationContext {};
        steering::Steering::new(context).in_node("rover_nodes::drive::steering")
    }

    fn create_wheel_receiver() -> Result<wheel_receiver::WheelReceiver> {
        let context = wheel_receiver::CreationContext {};
        wheel_receiver::WheelReceiver::new(context)
            .in_node("rover_nodes::drive::wheel_receiver")
    }
}
