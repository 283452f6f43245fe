//! Cycler `Control` (real-time), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use control::ball_memory;
use control::camera_matrices;
use control::command_sender;
use control::foot_pressure;
use control::forward_kinematics;
use control::head_scan;
use control::led_status;
use control::motor_commands_collector;
use control::orientation_filter;
use control::ready_pose;
use control::sensor_data_receiver;
use framework::AdditionalOutput;
use framework::Guarded;
use framework::HistoricInput;
use framework::InNode;
use framework::Interleaved;
use framework::OnFailure;
use framework::PerceptionInput;
use framework::Result;
use hardware::ActuatorInterface;
use hardware::SensorInterface;

use crate::databases::control::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub sensor_data_receiver: Guarded<sensor_data_receiver::SensorDataReceiver>,
    pub orientation_filter: Guarded<orientation_filter::OrientationFilter>,
    pub foot_pressure: Guarded<foot_pressure::FootPressure>,
    pub forward_kinematics: Guarded<forward_kinematics::ForwardKinematics>,
    pub camera_matrices: Guarded<camera_matrices::CameraMatricesProvider>,
    pub ball_memory: Guarded<ball_memory::BallMemory>,
    pub ready_pose: Guarded<ready_pose::ReadyPose>,
    pub head_scan: Guarded<head_scan::HeadScan>,
    pub led_status: Guarded<led_status::LedStatus>,
    pub motor_commands_collector: Guarded<
        motor_commands_collector::MotorCommandsCollector,
    >,
    pub command_sender: Guarded<command_sender::CommandSender>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            sensor_data_receiver: Guarded::new(
                "control::sensor_data_receiver",
                OnFailure::Stop,
                Self::create_sensor_data_receiver()?,
            ),
            orientation_filter: Guarded::new(
                "control::orientation_filter",
                OnFailure::Stop,
                Self::create_orientation_filter()?,
            ),
            foot_pressure: Guarded::new(
                "control::foot_pressure",
                OnFailure::Stop,
                Self::create_foot_pressure()?,
            ),
            forward_kinematics: Guarded::new(
                "control::forward_kinematics",
                OnFailure::Stop,
                Self::create_forward_kinematics()?,
            ),
            camera_matrices: Guarded::new(
                "control::camera_matrices",
                OnFailure::Stop,
                Self::create_camera_matrices()?,
            ),
            ball_memory: Guarded::new(
                "control::ball_memory",
                OnFailure::Stop,
                Self::create_ball_memory()?,
            ),
            ready_pose: Guarded::new(
                "control::ready_pose",
                OnFailure::Stop,
                Self::create_ready_pose()?,
            ),
            head_scan: Guarded::new(
                "control::head_scan",
                OnFailure::Stop,
                Self::create_head_scan()?,
            ),
            led_status: Guarded::new(
                "control::led_status",
                OnFailure::Stop,
                Self::create_led_status()?,
            ),
            motor_commands_collector: Guarded::new(
                "control::motor_commands_collector",
                OnFailure::Stop,
                Self::create_motor_commands_collector()?,
            ),
            command_sender: Guarded::new(
                "control::command_sender",
                OnFailure::Stop,
                Self::create_command_sender()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    pub fn setup(&mut self, frame: &mut Frame<'_, impl SensorInterface>) -> Result<()> {
        self.sensor_data_receiver(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.sensor_data.replace(&mut frame.own.sensor_data);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    pub fn cycle(
        &mut self,
        frame: &mut Frame<'_, impl ActuatorInterface>,
    ) -> Result<()> {
        self.orientation_filter(frame)?;
        self.foot_pressure(frame)?;
        self.forward_kinematics(frame)?;
        self.camera_matrices(frame)?;
        self.ball_memory(frame)?;
        self.ready_pose(frame)?;
        self.head_scan(frame)?;
        self.led_status(frame)?;
        self.motor_commands_collector(frame)?;
        self.command_sender(frame)?;
        Ok(())
    }

    /// hardware -> sensor_data
    fn sensor_data_receiver(
        &mut self,
        frame: &mut Frame<'_, impl SensorInterface>,
    ) -> Result<()> {
        let context = sensor_data_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self
            .sensor_data_receiver
            .call(frame.cycle, |node| node.cycle(context))?;
        frame.own.sensor_data = outputs.sensor_data.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    /// sensor_data.inertial -> orientation; when subscribed: orientation_filter.innovation
    fn orientation_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = orientation_filter::CycleContext {
            inertial: &frame.own.sensor_data.inertial,
            cycle_time: frame.cycle.time,
            gravity_time: &frame.parameters.orientation_filter.gravity_time,
            trusted_deviation: &frame.parameters.orientation_filter.trusted_deviation,
            refused_deviation: &frame.parameters.orientation_filter.refused_deviation,
            bias_time: &frame.parameters.orientation_filter.bias_time,
            still_rotation: &frame.parameters.orientation_filter.still_rotation,
            innovation: AdditionalOutput::new(
                frame.subscribed.orientation_filter_innovation,
                frame.cycle.number,
                &mut frame.additional_outputs.orientation_filter.innovation,
            ),
        };
        let outputs = self
            .orientation_filter
            .call(frame.cycle, |node| node.cycle(context))?;
        frame.own.orientation = outputs.orientation.value;
        if let Some(injections) = frame.injections {
            injections.orientation.replace(&mut frame.own.orientation);
        }
        Ok(())
    }

    /// sensor_data.force_sensitive_resistors -> ground_contact, support_side; when subscribed:
    /// foot_pressure.sole_pressures
    fn foot_pressure<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = foot_pressure::CycleContext {
            resistors: &frame.own.sensor_data.force_sensitive_resistors,
            cycle_time: frame.cycle.time,
            smoothing_time: &frame.parameters.foot_pressure.smoothing_time,
            contact_pressure: &frame.parameters.foot_pressure.contact_pressure,
            contact_hysteresis: &frame.parameters.foot_pressure.contact_hysteresis,
            contact_delay: &frame.parameters.foot_pressure.contact_delay,
            side_hysteresis: &frame.parameters.foot_pressure.side_hysteresis,
            sole_pressures: AdditionalOutput::new(
                frame.subscribed.foot_pressure_sole_pressures,
                frame.cycle.number,
                &mut frame.additional_outputs.foot_pressure.sole_pressures,
            ),
        };
        let outputs = self.foot_pressure.call(frame.cycle, |node| node.cycle(context))?;
        frame.own.ground_contact = outputs.ground_contact.value;
        frame.own.support_side = outputs.support_side.value;
        if let Some(injections) = frame.injections {
            injections.ground_contact.replace(&mut frame.own.ground_contact);
            injections.support_side.replace(&mut frame.own.support_side);
        }
        Ok(())
    }

    /// sensor_data.positions -> robot_kinematics
    fn forward_kinematics<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = forward_kinematics::CycleContext {
            positions: &frame.own.sensor_data.positions,
        };
        let outputs = self
            .forward_kinematics
            .call(frame.cycle, |node| node.cycle(context))?;
        frame.own.robot_kinematics = outputs.robot_kinematics.value;
        if let Some(injections) = frame.injections {
            injections.robot_kinematics.replace(&mut frame.own.robot_kinematics);
        }
        Ok(())
    }

    /// support_side (required), robot_kinematics, orientation -> camera_matrices
    fn camera_matrices<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        if let Some(support_side) = frame.own.support_side.as_ref() {
            let context = camera_matrices::CycleContext {
                support_side,
                robot_kinematics: &frame.own.robot_kinematics,
                orientation: &frame.own.orientation,
                top: &frame.parameters.cameras.top,
                bottom: &frame.parameters.cameras.bottom,
            };
            let outputs = self
                .camera_matrices
                .call(frame.cycle, |node| node.cycle(context))?;
            frame.shared.camera_matrices = outputs.camera_matrices.value;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.camera_matrices.skip();
            frame.shared.camera_matrices = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.camera_matrices.replace(&mut frame.shared.camera_matrices);
        }
        Ok(())
    }

    /// perception Vision.balls, historic orientation -> ball; when subscribed:
    /// ball_memory.persistent_ball
    fn ball_memory<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let balls = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.balls),
                &frame.perception.vision_bottom.project(|outputs| &outputs.balls),
            ],
        };
        let orientation = frame.historic.orientation.project(|orientation| orientation);
        let context = ball_memory::CycleContext {
            balls: PerceptionInput::new(&balls),
            orientation: HistoricInput::new(
                &orientation,
                frame.cycle.time.start,
                &frame.own.orientation,
            ),
            cycle_time: frame.cycle.time,
            gain: &frame.parameters.ball_memory.gain,
            same_place: &frame.parameters.ball_memory.same_place,
            forget_after: &frame.parameters.ball_memory.forget_after,
            persistent_ball: AdditionalOutput::new(
                frame.subscribed.ball_memory_persistent_ball,
                frame.cycle.number,
                &mut frame.additional_outputs.ball_memory.persistent_ball,
            ),
        };
        let outputs = self.ball_memory.call(frame.cycle, |node| node.cycle(context))?;
        frame.own.ball = outputs.ball.value;
        if let Some(injections) = frame.injections {
            injections.ball.replace(&mut frame.own.ball);
        }
        Ok(())
    }

    /// sensor_data.positions, state motion_phase -> body_commands
    fn ready_pose<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = ready_pose::CycleContext {
            positions: &frame.own.sensor_data.positions,
            cycle_time: frame.cycle.time,
            motion_phase: &mut frame.cycler_state.motion_phase,
            ready_positions: &frame.parameters.ready_pose.positions,
            stiffness: &frame.parameters.ready_pose.stiffness,
            velocity_share: &frame.parameters.ready_pose.velocity_share,
            minimum_duration: &frame.parameters.ready_pose.minimum_duration,
        };
        let outputs = self.ready_pose.call(frame.cycle, |node| node.cycle(context))?;
        frame.own.body_commands = outputs.body_commands.value;
        if let Some(injections) = frame.injections {
            injections.body_commands.replace(&mut frame.own.body_commands);
        }
        Ok(())
    }

    /// sensor_data.positions, state motion_phase, procedure look_at -> head_command
    fn head_scan<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = head_scan::CycleContext {
            positions: &frame.own.sensor_data.positions,
            cycle_time: frame.cycle.time,
            motion_phase: &frame.cycler_state.motion_phase,
            way_points: &frame.parameters.head_scan.way_points,
            velocity: &frame.parameters.head_scan.velocity,
            stiffness: &frame.parameters.head_scan.stiffness,
            look_at: frame.procedures.look_at.call(),
        };
        let outputs = self.head_scan.call(frame.cycle, |node| node.cycle(context))?;
        frame.own.head_command = outputs.head_command.value;
        if let Some(injections) = frame.injections {
            injections.head_command.replace(&mut frame.own.head_command);
        }
        Ok(())
    }

    /// ball, ground_contact -> leds
    fn led_status<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = led_status::CycleContext {
            ball: &frame.own.ball,
            ground_contact: &frame.own.ground_contact,
            ball_known: &frame.parameters.led_status.ball_known,
            ball_unknown: &frame.parameters.led_status.ball_unknown,
            on_ground: &frame.parameters.led_status.on_ground,
            in_the_air: &frame.parameters.led_status.in_the_air,
        };
        let outputs = self.led_status.call(frame.cycle, |node| node.cycle(context))?;
        frame.own.leds = outputs.leds.value;
        if let Some(injections) = frame.injections {
            injections.leds.replace(&mut frame.own.leds);
        }
        Ok(())
    }

    /// body_commands (required), head_command, previous motor_commands, sensor_data.positions
    /// -> motor_commands
    fn motor_commands_collector<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        if let Some(body_commands) = frame.own.body_commands.as_ref() {
            let context = motor_commands_collector::CycleContext {
                body_commands,
                head_command: frame.own.head_command.as_ref(),
                previous: frame.previous.own.motor_commands.as_ref(),
                positions: &frame.own.sensor_data.positions,
                cycle_time: frame.cycle.time,
                velocity_share: &frame.parameters.motor_commands_collector.velocity_share,
            };
            let outputs = self
                .motor_commands_collector
                .call(frame.cycle, |node| node.cycle(context))?;
            frame.own.motor_commands = outputs.motor_commands.value;
        } else {
            // A required input is absent: the main outputs take their defaults.
            self.motor_commands_collector.skip();
            frame.own.motor_commands = Default::default();
        }
        if let Some(injections) = frame.injections {
            injections.motor_commands.replace(&mut frame.own.motor_commands);
        }
        Ok(())
    }

    /// motor_commands (required), leds -> hardware
    fn command_sender(
        &mut self,
        frame: &mut Frame<'_, impl ActuatorInterface>,
    ) -> Result<()> {
        if let Some(motor_commands) = frame.own.motor_commands.as_ref() {
            let context = command_sender::CycleContext {
                hardware_interface: frame.hardware_interface,
                motor_commands,
                leds: frame.own.leds.as_ref(),
            };
            self.command_sender.call(frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent.
            self.command_sender.skip();
        }
        Ok(())
    }

    fn create_sensor_data_receiver() -> Result<
        sensor_data_receiver::SensorDataReceiver,
    > {
        let context = sensor_data_receiver::CreationContext {};
        sensor_data_receiver::SensorDataReceiver::new(context)
            .in_node("control::sensor_data_receiver")
    }

    fn create_orientation_filter() -> Result<orientation_filter::OrientationFilter> {
        let context = orientation_filter::CreationContext {};
        orientation_filter::OrientationFilter::new(context)
            .in_node("control::orientation_filter")
    }

    fn create_foot_pressure() -> Result<foot_pressure::FootPressure> {
        let context = foot_pressure::CreationContext {};
        foot_pressure::FootPressure::new(context).in_node("control::foot_pressure")
    }

    fn create_forward_kinematics() -> Result<forward_kinematics::ForwardKinematics> {
        let context = forward_kinematics::CreationContext {};
        forward_kinematics::ForwardKinematics::new(context)
            .in_node("control::forward_kinematics")
    }

    fn create_camera_matrices() -> Result<camera_matrices::CameraMatricesProvider> {
        let context = camera_matrices::CreationContext {};
        camera_matrices::CameraMatricesProvider::new(context)
            .in_node("control::camera_matrices")
    }

    fn create_ball_memory() -> Result<ball_memory::BallMemory> {
        let context = ball_memory::CreationContext {};
        ball_memory::BallMemory::new(context).in_node("control::ball_memory")
    }

    fn create_ready_pose() -> Result<ready_pose::ReadyPose> {
        let context = ready_pose::CreationContext {};
        ready_pose::ReadyPose::new(context).in_node("control::ready_pose")
    }

    fn create_head_scan() -> Result<head_scan::HeadScan> {
        let context = head_scan::CreationContext {};
        head_scan::HeadScan::new(context).in_node("control::head_scan")
    }

    fn create_led_status() -> Result<led_status::LedStatus> {
        let context = led_status::CreationContext {};
        led_status::LedStatus::new(context).in_node("control::led_status")
    }

    fn create_motor_commands_collector() -> Result<
        motor_commands_collector::MotorCommandsCollector,
    > {
        let context = motor_commands_collector::CreationContext {};
        motor_commands_collector::MotorCommandsCollector::new(context)
            .in_node("control::motor_commands_collector")
    }

    fn create_command_sender() -> Result<command_sender::CommandSender> {
        let context = command_sender::CreationContext {};
        command_sender::CommandSender::new(context).in_node("control::command_sender")
    }
}
