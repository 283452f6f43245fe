//! Cycler `Control` (real-time), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use k1_nodes::body_receiver;
use k1_nodes::interfaces::BodyInterface;
use k1_nodes::interfaces::MotorInterface;
use k1_nodes::look_around;
use k1_nodes::motor_sender;
use k1_nodes::prepare;
use k1_nodes::wave;

use crate::databases::control::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub body_receiver: Guarded<body_receiver::BodyReceiver>,
    pub look_around: Guarded<look_around::LookAround>,
    pub motor_sender: Guarded<motor_sender::MotorSender>,
    pub prepare: Guarded<prepare::Prepare>,
    pub wave: Guarded<wave::Wave>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            body_receiver: Guarded::new(
                "k1_nodes::body_receiver",
                OnFailure::Stop,
                Self::create_body_receiver()?,
            ),
            prepare: Guarded::new(
                "k1_nodes::prepare",
                OnFailure::Stop,
                Self::create_prepare()?,
            ),
            look_around: Guarded::new(
                "k1_nodes::look_around",
                OnFailure::Stop,
                Self::create_look_around()?,
            ),
            wave: Guarded::new("k1_nodes::wave", OnFailure::Stop, Self::create_wave()?),
            motor_sender: Guarded::new(
                "k1_nodes::motor_sender",
                OnFailure::Stop,
                Self::create_motor_sender()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl BodyInterface>) -> Result<()> {
        self.body_receiver(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.body.replace(&mut frame.own.body);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle(&mut self, frame: &mut Frame<'_, impl MotorInterface>) -> Result<()> {
        self.prepare(frame)?;
        self.look_around(frame)?;
        self.wave(frame)?;
        self.motor_sender(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely(
        &mut self,
        frame: &mut Frame<'_, impl MotorInterface>,
    ) -> Result<()> {
        self.cycle(frame)
    }

    /// hardware -> body
    #[inline(always)]
    fn body_receiver(
        &mut self,
        frame: &mut Frame<'_, impl BodyInterface>,
    ) -> Result<()> {
        let context = body_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self.body_receiver.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.body = outputs.body.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    /// -> head_yaw
    #[inline(always)]
    fn look_around<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = look_around::CycleContext {
            cycle_time: frame.cycle.time,
            amplitude: &frame.parameters.look_around.amplitude,
            period: &frame.parameters.look_around.period,
        };
        let outputs = self.look_around.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.head_yaw = outputs.head_yaw.value;
        if let Some(injections) = frame.injections {
            injections.head_yaw.replace(&mut frame.own.head_yaw);
        }
        Ok(())
    }

    /// standing (required), head_yaw (required), arm_pitch (required) -> motor_commands,
    /// hardware
    #[inline(always)]
    fn motor_sender(
        &mut self,
        frame: &mut Frame<'_, impl MotorInterface>,
    ) -> Result<()> {
        if let Some(standing) = frame.own.standing.as_ref()
            && let Some(head_yaw) = frame.own.head_yaw.as_ref()
            && let Some(arm_pitch) = frame.own.arm_pitch.as_ref()
        {
            let context = motor_sender::CycleContext {
                hardware_interface: frame.hardware_interface,
                standing,
                head_yaw,
                arm_pitch,
                leg: &frame.parameters.motor_sender.leg,
                ankle: &frame.parameters.motor_sender.ankle,
                arm: &frame.parameters.motor_sender.arm,
                head: &frame.parameters.motor_sender.head,
            };
            let outputs = self
                .motor_sender
                .call(&frame.cycle, |node| node.cycle(context))?;
            frame.own.motor_commands = outputs.motor_commands.value;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.motor_sender.skip();
            frame.own.motor_commands = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.motor_commands.replace(&mut frame.own.motor_commands);
        }
        Ok(())
    }

    /// body -> standing
    #[inline(always)]
    fn prepare<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = prepare::CycleContext {
            body: &frame.own.body,
            cycle_time: frame.cycle.time,
            duration: &frame.parameters.prepare.duration,
            pose: &frame.parameters.prepare.pose,
        };
        let outputs = self.prepare.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.standing = outputs.standing.value;
        if let Some(injections) = frame.injections {
            injections.standing.replace(&mut frame.own.standing);
        }
        Ok(())
    }

    /// -> arm_pitch
    #[inline(always)]
    fn wave<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = wave::CycleContext {
            cycle_time: frame.cycle.time,
            amplitude: &frame.parameters.wave.amplitude,
            period: &frame.parameters.wave.period,
        };
        let outputs = self.wave.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.arm_pitch = outputs.arm_pitch.value;
        if let Some(injections) = frame.injections {
            injections.arm_pitch.replace(&mut frame.own.arm_pitch);
        }
        Ok(())
    }

    fn create_body_receiver() -> Result<body_receiver::BodyReceiver> {
        let context = body_receiver::CreationContext {};
        body_receiver::BodyReceiver::new(context).in_node("k1_nodes::body_receiver")
    }

    fn create_look_around() -> Result<look_around::LookAround> {
        let context = look_around::CreationContext {};
        look_around::LookAround::new(context).in_node("k1_nodes::look_around")
    }

    fn create_motor_sender() -> Result<motor_sender::MotorSender> {
        let context = motor_sender::CreationContext {};
        motor_sender::MotorSender::new(context).in_node("k1_nodes::motor_sender")
    }

    fn create_prepare() -> Result<prepare::Prepare> {
        let context = prepare::CreationContext {};
        prepare::Prepare::new(context).in_node("k1_nodes::prepare")
    }

    fn create_wave() -> Result<wave::Wave> {
        let context = wave::CreationContext {};
        wave::Wave::new(context).in_node("k1_nodes::wave")
    }
}
