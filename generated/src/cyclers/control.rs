//! Cycler `Control` (real-time), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use control::ball_filter;
use control::behavior;
use control::button_filter;
use control::camera_matrices;
use control::center_of_mass;
use control::client_wishes;
use control::command_sender;
use control::fall_state_filter;
use control::foot_pressure_filter;
use control::forward_kinematics;
use control::game_controller_filter;
use control::game_controller_responder;
use control::game_state_filter;
use control::ground_contact_filter;
use control::head_motion;
use control::led_status;
use control::localization;
use control::look_around;
use control::look_at;
use control::motion_dispatcher;
use control::motion_selector;
use control::motor_commands_collector;
use control::obstacle_filter;
use control::odometry;
use control::orientation_filter;
use control::penalized_pose;
use control::recording_switch;
use control::role_assignment;
use control::scripted_motion;
use control::self_report;
use control::sensor_data_receiver;
use control::sit_down;
use control::sonar_filter;
use control::stand;
use control::support_foot_filter;
use control::team_ball_filter;
use control::team_message_filter;
use control::team_message_sender;
use control::tone_player;
use control::tone_selector;
use control::walking_engine;
use control::whistle_filter;
use control::whose_ball_filter;
use control::world_state_composer;
use framework::AdditionalOutput;
use framework::Clear;
use framework::Guarded;
use framework::HistoricInput;
use framework::InNode;
use framework::Interleaved;
use framework::OnFailure;
use framework::PerceptionInput;
use framework::Result;
use hardware::ActuatorInterface;
use hardware::MessageInterface;
use hardware::SensorInterface;
use hardware::SpeakerInterface;

use crate::databases::control::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub ball_filter: Guarded<ball_filter::BallFilter>,
    pub behavior: Guarded<behavior::Behavior>,
    pub button_filter: Guarded<button_filter::ButtonFilter>,
    pub camera_matrices: Guarded<camera_matrices::CameraMatricesProvider>,
    pub center_of_mass: Guarded<center_of_mass::CenterOfMass>,
    pub client_wishes: Guarded<client_wishes::ClientWishes>,
    pub command_sender: Guarded<command_sender::CommandSender>,
    pub fall_state_filter: Guarded<fall_state_filter::FallStateFilter>,
    pub foot_pressure_filter: Guarded<foot_pressure_filter::FootPressureFilter>,
    pub forward_kinematics: Guarded<forward_kinematics::ForwardKinematics>,
    pub game_controller_filter: Guarded<game_controller_filter::GameControllerFilter>,
    pub game_controller_responder: Guarded<
        game_controller_responder::GameControllerResponder,
    >,
    pub game_state_filter: Guarded<game_state_filter::GameStateFilter>,
    pub ground_contact_filter: Guarded<ground_contact_filter::GroundContactFilter>,
    pub head_motion: Guarded<head_motion::HeadMotion>,
    pub led_status: Guarded<led_status::LedStatus>,
    pub localization: Guarded<localization::Localization>,
    pub look_around: Guarded<look_around::LookAround>,
    pub look_at: Guarded<look_at::LookAt>,
    pub motion_dispatcher: Guarded<motion_dispatcher::MotionDispatcher>,
    pub motion_selector: Guarded<motion_selector::MotionSelector>,
    pub motor_commands_collector: Guarded<
        motor_commands_collector::MotorCommandsCollector,
    >,
    pub obstacle_filter: Guarded<obstacle_filter::ObstacleFilter>,
    pub odometry: Guarded<odometry::OdometryProvider>,
    pub orientation_filter: Guarded<orientation_filter::OrientationFilter>,
    pub penalized_pose: Guarded<penalized_pose::PenalizedPose>,
    pub recording_switch: Guarded<recording_switch::RecordingSwitch>,
    pub role_assignment: Guarded<role_assignment::RoleAssignment>,
    pub scripted_motion: Guarded<scripted_motion::ScriptedMotion>,
    pub self_report: Guarded<self_report::SelfReport>,
    pub sensor_data_receiver: Guarded<sensor_data_receiver::SensorDataReceiver>,
    pub sit_down: Guarded<sit_down::SitDown>,
    pub sonar_filter: Guarded<sonar_filter::SonarFilter>,
    pub stand: Guarded<stand::Stand>,
    pub support_foot_filter: Guarded<support_foot_filter::SupportFootFilter>,
    pub team_ball_filter: Guarded<team_ball_filter::TeamBallFilter>,
    pub team_message_filter: Guarded<team_message_filter::TeamMessageFilter>,
    pub team_message_sender: Guarded<team_message_sender::TeamMessageSender>,
    pub tone_player: Guarded<tone_player::TonePlayer>,
    pub tone_selector: Guarded<tone_selector::ToneSelector>,
    pub walking_engine: Guarded<walking_engine::WalkingEngine>,
    pub whistle_filter: Guarded<whistle_filter::WhistleFilter>,
    pub whose_ball_filter: Guarded<whose_ball_filter::WhoseBallFilter>,
    pub world_state_composer: Guarded<world_state_composer::WorldStateComposer>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            sensor_data_receiver: Guarded::new(
                "control::sensor_data_receiver",
                OnFailure::Stop,
                Self::create_sensor_data_receiver()?,
            ),
            button_filter: Guarded::new(
                "control::button_filter",
                OnFailure::Stop,
                Self::create_button_filter()?,
            ),
            sonar_filter: Guarded::new(
                "control::sonar_filter",
                OnFailure::Stop,
                Self::create_sonar_filter()?,
            ),
            orientation_filter: Guarded::new(
                "control::orientation_filter",
                OnFailure::Stop,
                Self::create_orientation_filter()?,
            ),
            foot_pressure_filter: Guarded::new(
                "control::foot_pressure_filter",
                OnFailure::Stop,
                Self::create_foot_pressure_filter()?,
            ),
            ground_contact_filter: Guarded::new(
                "control::ground_contact_filter",
                OnFailure::Stop,
                Self::create_ground_contact_filter()?,
            ),
            support_foot_filter: Guarded::new(
                "control::support_foot_filter",
                OnFailure::Stop,
                Self::create_support_foot_filter()?,
            ),
            forward_kinematics: Guarded::new(
                "control::forward_kinematics",
                OnFailure::Stop,
                Self::create_forward_kinematics()?,
            ),
            center_of_mass: Guarded::new(
                "control::center_of_mass",
                OnFailure::Stop,
                Self::create_center_of_mass()?,
            ),
            fall_state_filter: Guarded::new(
                "control::fall_state_filter",
                OnFailure::Stop,
                Self::create_fall_state_filter()?,
            ),
            odometry: Guarded::new(
                "control::odometry",
                OnFailure::Stop,
                Self::create_odometry()?,
            ),
            camera_matrices: Guarded::new(
                "control::camera_matrices",
                OnFailure::Stop,
                Self::create_camera_matrices()?,
            ),
            game_controller_filter: Guarded::new(
                "control::game_controller_filter",
                OnFailure::Stop,
                Self::create_game_controller_filter()?,
            ),
            team_message_filter: Guarded::new(
                "control::team_message_filter",
                OnFailure::Stop,
                Self::create_team_message_filter()?,
            ),
            whistle_filter: Guarded::new(
                "control::whistle_filter",
                OnFailure::Stop,
                Self::create_whistle_filter()?,
            ),
            game_state_filter: Guarded::new(
                "control::game_state_filter",
                OnFailure::Stop,
                Self::create_game_state_filter()?,
            ),
            whose_ball_filter: Guarded::new(
                "control::whose_ball_filter",
                OnFailure::Stop,
                Self::create_whose_ball_filter()?,
            ),
            localization: Guarded::new(
                "control::localization",
                OnFailure::Stop,
                Self::create_localization()?,
            ),
            ball_filter: Guarded::new(
                "control::ball_filter",
                OnFailure::Stop,
                Self::create_ball_filter()?,
            ),
            obstacle_filter: Guarded::new(
                "control::obstacle_filter",
                OnFailure::Stop,
                Self::create_obstacle_filter()?,
            ),
            team_ball_filter: Guarded::new(
                "control::team_ball_filter",
                OnFailure::Stop,
                Self::create_team_ball_filter()?,
            ),
            role_assignment: Guarded::new(
                "control::role_assignment",
                OnFailure::Stop,
                Self::create_role_assignment()?,
            ),
            world_state_composer: Guarded::new(
                "control::world_state_composer",
                OnFailure::Stop,
                Self::create_world_state_composer()?,
            ),
            client_wishes: Guarded::new(
                "control::client_wishes",
                OnFailure::Stop,
                Self::create_client_wishes()?,
            ),
            behavior: Guarded::new(
                "control::behavior",
                OnFailure::Stop,
                Self::create_behavior()?,
            ),
            recording_switch: Guarded::new(
                "control::recording_switch",
                OnFailure::Stop,
                Self::create_recording_switch()?,
            ),
            motion_selector: Guarded::new(
                "control::motion_selector",
                OnFailure::Stop,
                Self::create_motion_selector()?,
            ),
            motion_dispatcher: Guarded::new(
                "control::motion_dispatcher",
                OnFailure::Stop,
                Self::create_motion_dispatcher()?,
            ),
            stand: Guarded::new(
                "control::stand",
                OnFailure::Stop,
                Self::create_stand()?,
            ),
            penalized_pose: Guarded::new(
                "control::penalized_pose",
                OnFailure::Stop,
                Self::create_penalized_pose()?,
            ),
            sit_down: Guarded::new(
                "control::sit_down",
                OnFailure::Stop,
                Self::create_sit_down()?,
            ),
            walking_engine: Guarded::new(
                "control::walking_engine",
                OnFailure::Stop,
                Self::create_walking_engine()?,
            ),
            scripted_motion: Guarded::new(
                "control::scripted_motion",
                OnFailure::Stop,
                Self::create_scripted_motion()?,
            ),
            look_around: Guarded::new(
                "control::look_around",
                OnFailure::Stop,
                Self::create_look_around()?,
            ),
            look_at: Guarded::new(
                "control::look_at",
                OnFailure::Stop,
                Self::create_look_at()?,
            ),
            head_motion: Guarded::new(
                "control::head_motion",
                OnFailure::Stop,
                Self::create_head_motion()?,
            ),
            motor_commands_collector: Guarded::new(
                "control::motor_commands_collector",
                OnFailure::Stop,
                Self::create_motor_commands_collector()?,
            ),
            led_status: Guarded::new(
                "control::led_status",
                OnFailure::Stop,
                Self::create_led_status()?,
            ),
            tone_selector: Guarded::new(
                "control::tone_selector",
                OnFailure::Stop,
                Self::create_tone_selector()?,
            ),
            tone_player: Guarded::new(
                "control::tone_player",
                OnFailure::Skip,
                Self::create_tone_player()?,
            ),
            self_report: Guarded::new(
                "control::self_report",
                OnFailure::Stop,
                Self::create_self_report()?,
            ),
            game_controller_responder: Guarded::new(
                "control::game_controller_responder",
                OnFailure::Skip,
                Self::create_game_controller_responder()?,
            ),
            team_message_sender: Guarded::new(
                "control::team_message_sender",
                OnFailure::Skip,
                Self::create_team_message_sender()?,
            ),
            command_sender: Guarded::new(
                "control::command_sender",
                OnFailure::Stop,
                Self::create_command_sender()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
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
    #[inline(always)]
    pub fn cycle(
        &mut self,
        frame: &mut Frame<
            '_,
            impl ActuatorInterface + MessageInterface + SpeakerInterface,
        >,
    ) -> Result<()> {
        self.button_filter(frame)?;
        self.sonar_filter(frame)?;
        self.orientation_filter(frame)?;
        self.foot_pressure_filter(frame)?;
        self.ground_contact_filter(frame)?;
        self.support_foot_filter(frame)?;
        self.forward_kinematics(frame)?;
        self.center_of_mass(frame)?;
        self.fall_state_filter(frame)?;
        self.odometry(frame)?;
        self.camera_matrices(frame)?;
        self.game_controller_filter(frame)?;
        self.team_message_filter(frame)?;
        self.whistle_filter(frame)?;
        self.game_state_filter(frame)?;
        self.whose_ball_filter(frame)?;
        self.localization(frame)?;
        self.obstacle_filter(frame)?;
        self.ball_filter(frame)?;
        self.team_ball_filter(frame)?;
        self.role_assignment(frame)?;
        self.world_state_composer(frame)?;
        self.client_wishes(frame)?;
        self.behavior(frame)?;
        self.recording_switch(frame)?;
        self.motion_selector(frame)?;
        self.motion_dispatcher(frame)?;
        self.stand(frame)?;
        self.penalized_pose(frame)?;
        self.sit_down(frame)?;
        self.walking_engine(frame)?;
        self.scripted_motion(frame)?;
        self.look_around(frame)?;
        self.look_at(frame)?;
        self.head_motion(frame)?;
        self.motor_commands_collector(frame)?;
        self.led_status(frame)?;
        self.tone_selector(frame)?;
        self.tone_player(frame)?;
        self.self_report(frame)?;
        self.game_controller_responder(frame)?;
        self.team_message_sender(frame)?;
        self.command_sender(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely(
        &mut self,
        frame: &mut Frame<
            '_,
            impl ActuatorInterface + MessageInterface + SpeakerInterface,
        >,
    ) -> Result<()> {
        self.cycle(frame)
    }

    /// perception Vision.balls, perception Vision.ball_view, perception Vision.field_border,
    /// perception Vision.limb_mask, perception Vision.obstacles, obstacles, historic odometry
    /// -> ball; when subscribed: ball_filter.hypotheses, ball_filter.persistent_ball,
    /// ball_filter.delivered
    #[inline(always)]
    fn ball_filter<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let balls = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.balls),
                &frame.perception.vision_bottom.project(|outputs| &outputs.balls),
            ],
        };
        let ball_views = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.ball_view),
                &frame.perception.vision_bottom.project(|outputs| &outputs.ball_view),
            ],
        };
        let borders = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.field_border),
                &frame.perception.vision_bottom.project(|outputs| &outputs.field_border),
            ],
        };
        let limb_masks = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.limb_mask),
                &frame.perception.vision_bottom.project(|outputs| &outputs.limb_mask),
            ],
        };
        let obstacles_seen = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.obstacles),
                &frame.perception.vision_bottom.project(|outputs| &outputs.obstacles),
            ],
        };
        let odometry = frame.historic.odometry.project(|odometry| odometry);
        let context = ball_filter::CycleContext {
            balls: PerceptionInput::new(&balls),
            ball_views: PerceptionInput::new(&ball_views),
            borders: PerceptionInput::new(&borders),
            limb_masks: PerceptionInput::new(&limb_masks),
            obstacles_seen: PerceptionInput::new(&obstacles_seen),
            obstacles: &frame.own.obstacles,
            odometry: HistoricInput::new(
                &odometry,
                frame.cycle.time.start,
                &frame.own.odometry,
            ),
            cycle_time: frame.cycle.time,
            parameters: &frame.parameters.ball_filter,
            hypotheses: AdditionalOutput::new(
                frame.subscribed.ball_filter_hypotheses,
                frame.cycle.number,
                &mut frame.additional_outputs.ball_filter.hypotheses,
            ),
            persistent_ball: AdditionalOutput::new(
                frame.subscribed.ball_filter_persistent_ball,
                frame.cycle.number,
                &mut frame.additional_outputs.ball_filter.persistent_ball,
            ),
            delivered: AdditionalOutput::new(
                frame.subscribed.ball_filter_delivered,
                frame.cycle.number,
                &mut frame.additional_outputs.ball_filter.delivered,
            ),
        };
        let outputs = self.ball_filter.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.ball = outputs.ball.value;
        if let Some(injections) = frame.injections {
            injections.ball.replace(&mut frame.own.ball);
        }
        Ok(())
    }

    /// world_state, client_wish -> motion_command, activity; when subscribed: plan
    #[inline(always)]
    fn behavior<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = behavior::CycleContext {
            world_state: &frame.own.world_state,
            client_wish: frame.own.client_wish.as_ref(),
            cycle_time: frame.cycle.time,
            parameters: &frame.parameters.behavior,
            plan: AdditionalOutput::new(
                frame.subscribed.plan,
                frame.cycle.number,
                &mut frame.additional_outputs.plan,
            ),
        };
        let outputs = self.behavior.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.motion_command = outputs.motion_command.value;
        frame.own.activity = outputs.activity.value;
        if let Some(injections) = frame.injections {
            injections.motion_command.replace(&mut frame.own.motion_command);
            injections.activity.replace(&mut frame.own.activity);
        }
        Ok(())
    }

    /// sensor_data.touch -> buttons
    #[inline(always)]
    fn button_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = button_filter::CycleContext {
            touch: &frame.own.sensor_data.touch,
            cycle_time: frame.cycle.time,
            bounce_time: &frame.parameters.button_filter.bounce_time,
            head_hold_time: &frame.parameters.button_filter.head_hold_time,
        };
        let outputs = self.button_filter.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.buttons = outputs.buttons.value;
        if let Some(injections) = frame.injections {
            injections.buttons.replace(&mut frame.own.buttons);
        }
        Ok(())
    }

    /// support_side, fall_state, robot_kinematics, sensor_data.inertial -> camera_matrices
    #[inline(always)]
    fn camera_matrices<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = camera_matrices::CycleContext {
            support_side: frame.own.support_side.as_ref(),
            fall_state: &frame.own.fall_state,
            cycle_time: frame.cycle.time,
            robot_kinematics: &frame.shared.robot_kinematics,
            inertial: &frame.own.sensor_data.inertial,
            top: &frame.parameters.cameras.top,
            bottom: &frame.parameters.cameras.bottom,
            steady_after: &frame.parameters.cameras.steady_after,
        };
        let outputs = self
            .camera_matrices
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.shared.camera_matrices = outputs.camera_matrices.value;
        if let Some(injections) = frame.injections {
            injections.camera_matrices.replace(&mut frame.shared.camera_matrices);
        }
        Ok(())
    }

    /// sensor_data.positions -> center_of_mass
    #[inline(always)]
    fn center_of_mass<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = center_of_mass::CycleContext {
            positions: &frame.own.sensor_data.positions,
        };
        let outputs = self
            .center_of_mass
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.center_of_mass = outputs.center_of_mass.value;
        if let Some(injections) = frame.injections {
            injections.center_of_mass.replace(&mut frame.own.center_of_mass);
        }
        Ok(())
    }

    /// primary_state, fall_state, procedure walk, procedure motion -> client_wish
    #[inline(always)]
    fn client_wishes<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = client_wishes::CycleContext {
            primary_state: &frame.own.primary_state,
            fall_state: &frame.own.fall_state,
            cycle_time: frame.cycle.time,
            limits: &frame.parameters.walking_engine.limits,
            walk_duration: &frame.parameters.client_wishes.walk_duration,
            motion_duration: &frame.parameters.client_wishes.motion_duration,
            kick_duration: &frame.parameters.client_wishes.kick_duration,
            walk: frame.procedures.walk.call(),
            motion: frame.procedures.motion.call(),
        };
        let outputs = self.client_wishes.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.client_wish = outputs.client_wish.value;
        if let Some(injections) = frame.injections {
            injections.client_wish.replace(&mut frame.own.client_wish);
        }
        Ok(())
    }

    /// motor_commands (required), leds, sensor_data.positions, sensor_data.is_in_safe_state ->
    /// hardware
    #[inline(always)]
    fn command_sender(
        &mut self,
        frame: &mut Frame<'_, impl ActuatorInterface>,
    ) -> Result<()> {
        if let Some(motor_commands) = frame.own.motor_commands.as_ref() {
            let context = command_sender::CycleContext {
                hardware_interface: frame.hardware_interface,
                motor_commands,
                leds: frame.own.leds.as_ref(),
                positions: &frame.own.sensor_data.positions,
                is_in_safe_state: &frame.own.sensor_data.is_in_safe_state,
                cycle_time: frame.cycle.time,
            };
            self.command_sender.call(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent.
            self.command_sender.skip();
        }
        Ok(())
    }

    /// sensor_data.inertial, orientation, sensor_data.positions, robot_kinematics,
    /// center_of_mass, has_ground_contact -> fall_state; when subscribed:
    /// fall_state_filter.center_of_mass_overhang
    #[inline(always)]
    fn fall_state_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = fall_state_filter::CycleContext {
            inertial: &frame.own.sensor_data.inertial,
            orientation: &frame.own.orientation,
            positions: &frame.own.sensor_data.positions,
            robot_kinematics: &frame.shared.robot_kinematics,
            center_of_mass: &frame.own.center_of_mass,
            has_ground_contact: &frame.own.has_ground_contact,
            cycle_time: frame.cycle.time,
            tilt: &frame.parameters.fall_state_filter.tilt,
            overhang: &frame.parameters.fall_state_filter.overhang,
            tilting_rotation: &frame.parameters.fall_state_filter.tilting_rotation,
            acceleration_time: &frame.parameters.fall_state_filter.acceleration_time,
            resting_deviation: &frame.parameters.fall_state_filter.resting_deviation,
            sitting: &frame.parameters.fall_state_filter.sitting,
            longest_fall: &frame.parameters.fall_state_filter.longest_fall,
            center_of_mass_overhang: AdditionalOutput::new(
                frame.subscribed.fall_state_filter_center_of_mass_overhang,
                frame.cycle.number,
                &mut frame.additional_outputs.fall_state_filter.center_of_mass_overhang,
            ),
        };
        let outputs = self
            .fall_state_filter
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.fall_state = outputs.fall_state.value;
        if let Some(injections) = frame.injections {
            injections.fall_state.replace(&mut frame.own.fall_state);
        }
        Ok(())
    }

    /// sensor_data.force_sensitive_resistors -> sole_pressures
    #[inline(always)]
    fn foot_pressure_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = foot_pressure_filter::CycleContext {
            resistors: &frame.own.sensor_data.force_sensitive_resistors,
            cycle_time: frame.cycle.time,
            smoothing_time: &frame.parameters.foot_pressure_filter.smoothing_time,
        };
        let outputs = self
            .foot_pressure_filter
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.sole_pressures = outputs.sole_pressures.value;
        if let Some(injections) = frame.injections {
            injections.sole_pressures.replace(&mut frame.own.sole_pressures);
        }
        Ok(())
    }

    /// sensor_data.positions -> robot_kinematics
    #[inline(always)]
    fn forward_kinematics<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = forward_kinematics::CycleContext {
            positions: &frame.own.sensor_data.positions,
        };
        let outputs = self
            .forward_kinematics
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.shared.robot_kinematics = outputs.robot_kinematics.value;
        if let Some(injections) = frame.injections {
            injections.robot_kinematics.replace(&mut frame.shared.robot_kinematics);
        }
        Ok(())
    }

    /// perception SplNetwork.game_controller_packet -> game_controller_state
    #[inline(always)]
    fn game_controller_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let packets = frame
            .perception
            .spl_network
            .project(|outputs| &outputs.game_controller_packet);
        let context = game_controller_filter::CycleContext {
            packets: PerceptionInput::new(&packets),
            cycle_time: frame.cycle.time,
            player: &frame.parameters.player,
            forget_after: &frame.parameters.game_controller_filter.forget_after,
        };
        let outputs = self
            .game_controller_filter
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.game_controller_state = outputs.game_controller_state.value;
        if let Some(injections) = frame.injections {
            injections
                .game_controller_state
                .replace(&mut frame.own.game_controller_state);
        }
        Ok(())
    }

    /// game_controller_state (required), self_report (required) -> hardware
    #[inline(always)]
    fn game_controller_responder(
        &mut self,
        frame: &mut Frame<'_, impl MessageInterface>,
    ) -> Result<()> {
        self.game_controller_responder
            .renew_if_broken(Self::create_game_controller_responder)?;
        if let Some(game_controller_state) = frame.own.game_controller_state.as_ref()
            && let Some(report) = frame.own.self_report.as_ref()
        {
            let context = game_controller_responder::CycleContext {
                hardware_interface: frame.hardware_interface,
                game_controller_state,
                report,
                cycle_time: frame.cycle.time,
                player: &frame.parameters.player,
                interval: &frame.parameters.game_controller_responder.interval,
            };
            self.game_controller_responder
                .call_or_skip(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent.
            self.game_controller_responder.skip();
        }
        Ok(())
    }

    /// game_controller_state, buttons, whistle -> primary_state
    #[inline(always)]
    fn game_state_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = game_state_filter::CycleContext {
            game_controller_state: &frame.own.game_controller_state,
            buttons: &frame.own.buttons,
            whistle: &frame.own.whistle,
            cycle_time: frame.cycle.time,
            playing_delay: &frame.parameters.game_state_filter.playing_delay,
            playing_margin: &frame.parameters.game_state_filter.playing_margin,
        };
        let outputs = self
            .game_state_filter
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.primary_state = outputs.primary_state.value;
        if let Some(injections) = frame.injections {
            injections.primary_state.replace(&mut frame.own.primary_state);
        }
        Ok(())
    }

    /// sole_pressures -> has_ground_contact
    #[inline(always)]
    fn ground_contact_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = ground_contact_filter::CycleContext {
            sole_pressures: &frame.own.sole_pressures,
            cycle_time: frame.cycle.time,
            pressure: &frame.parameters.ground_contact_filter.pressure,
            hysteresis: &frame.parameters.ground_contact_filter.hysteresis,
            delay: &frame.parameters.ground_contact_filter.delay,
        };
        let outputs = self
            .ground_contact_filter
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.has_ground_contact = outputs.has_ground_contact.value;
        if let Some(injections) = frame.injections {
            injections.has_ground_contact.replace(&mut frame.own.has_ground_contact);
        }
        Ok(())
    }

    /// motion_command, motion_selection, look_around, look_at, sensor_data.positions, previous
    /// motor_commands, procedure look_at -> head_command
    #[inline(always)]
    fn head_motion<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = head_motion::CycleContext {
            motion_command: &frame.own.motion_command,
            motion_selection: &frame.own.motion_selection,
            around: frame.own.look_around.as_ref(),
            at_point: frame.own.look_at.as_ref(),
            positions: &frame.own.sensor_data.positions,
            previous: frame.previous.own.motor_commands.as_ref(),
            cycle_time: frame.cycle.time,
            velocity: &frame.parameters.head_motion.velocity,
            stiffness: &frame.parameters.head_motion.stiffness,
            look_at: frame.procedures.look_at.call(),
        };
        let outputs = self.head_motion.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.head_command = outputs.head_command.value;
        if let Some(injections) = frame.injections {
            injections.head_command.replace(&mut frame.own.head_command);
        }
        Ok(())
    }

    /// world_state, game_controller_state -> leds
    #[inline(always)]
    fn led_status<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = led_status::CycleContext {
            world_state: &frame.own.world_state,
            game_controller_state: frame.own.game_controller_state.as_ref(),
            cycle_time: frame.cycle.time,
            chest: &frame.parameters.led_status.chest,
            blink_period: &frame.parameters.led_status.blink_period,
            ball_known: &frame.parameters.led_status.ball_known,
            ball_unknown: &frame.parameters.led_status.ball_unknown,
            on_ground: &frame.parameters.led_status.on_ground,
            in_the_air: &frame.parameters.led_status.in_the_air,
            team_color: &frame.parameters.led_status.team_color,
            own_kick_off: &frame.parameters.led_status.own_kick_off,
            ear_brightness: &frame.parameters.led_status.ear_brightness,
        };
        let outputs = self.led_status.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.leds = outputs.leds.value;
        if let Some(injections) = frame.injections {
            injections.leds.replace(&mut frame.own.leds);
        }
        Ok(())
    }

    /// perception Vision.lines, perception Vision.penalty_mark, perception
    /// Vision.center_circle, perception Vision.corners, historic odometry, fall_state,
    /// has_ground_contact, primary_state, game_controller_state -> ground_to_field; when
    /// subscribed: localization.hypotheses
    #[inline(always)]
    fn localization<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let lines = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.lines),
                &frame.perception.vision_bottom.project(|outputs| &outputs.lines),
            ],
        };
        let penalty_mark = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.penalty_mark),
                &frame.perception.vision_bottom.project(|outputs| &outputs.penalty_mark),
            ],
        };
        let center_circle = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.center_circle),
                &frame.perception.vision_bottom.project(|outputs| &outputs.center_circle),
            ],
        };
        let corners = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.corners),
                &frame.perception.vision_bottom.project(|outputs| &outputs.corners),
            ],
        };
        let odometry = frame.historic.odometry.project(|odometry| odometry);
        let context = localization::CycleContext {
            lines: PerceptionInput::new(&lines),
            penalty_mark: PerceptionInput::new(&penalty_mark),
            center_circle: PerceptionInput::new(&center_circle),
            corners: PerceptionInput::new(&corners),
            odometry: HistoricInput::new(
                &odometry,
                frame.cycle.time.start,
                &frame.own.odometry,
            ),
            fall_state: &frame.own.fall_state,
            has_ground_contact: &frame.own.has_ground_contact,
            primary_state: &frame.own.primary_state,
            game_controller_state: &frame.own.game_controller_state,
            cycle_time: frame.cycle.time,
            player: &frame.parameters.player,
            markings: &frame.parameters.field_dimensions.markings,
            parameters: &frame.parameters.localization,
            hypotheses: AdditionalOutput::new(
                frame.subscribed.localization_hypotheses,
                frame.cycle.number,
                &mut frame.additional_outputs.localization.hypotheses,
            ),
        };
        let outputs = self.localization.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.ground_to_field = outputs.ground_to_field.value;
        if let Some(injections) = frame.injections {
            injections.ground_to_field.replace(&mut frame.own.ground_to_field);
        }
        Ok(())
    }

    /// motion_command, previous head_command -> look_around
    #[inline(always)]
    fn look_around<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = look_around::CycleContext {
            motion_command: &frame.own.motion_command,
            previous: frame.previous.own.head_command.as_ref(),
            way_points: &frame.parameters.look_around.way_points,
        };
        let outputs = self.look_around.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.look_around = outputs.look_around.value;
        if let Some(injections) = frame.injections {
            injections.look_around.replace(&mut frame.own.look_around);
        }
        Ok(())
    }

    /// motion_command, camera_matrices, robot_kinematics.head_to_torso -> look_at
    #[inline(always)]
    fn look_at<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = look_at::CycleContext {
            motion_command: &frame.own.motion_command,
            camera_matrices: frame.shared.camera_matrices.as_ref(),
            head_to_torso: &frame.shared.robot_kinematics.head_to_torso,
            bottom_camera_range: &frame.parameters.look_at.bottom_camera_range,
            hysteresis: &frame.parameters.look_at.hysteresis,
        };
        let outputs = self.look_at.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.look_at = outputs.look_at.value;
        if let Some(injections) = frame.injections {
            injections.look_at.replace(&mut frame.own.look_at);
        }
        Ok(())
    }

    /// motion_command, motion_selection, sensor_data.positions, previous motor_commands, state
    /// safe_exits.dispatch -> dispatch_commands
    #[inline(always)]
    fn motion_dispatcher<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = motion_dispatcher::CycleContext {
            motion_command: &frame.own.motion_command,
            motion_selection: &frame.own.motion_selection,
            positions: &frame.own.sensor_data.positions,
            previous: frame.previous.own.motor_commands.as_ref(),
            cycle_time: frame.cycle.time,
            safe_exit: &mut frame.cycler_state.safe_exits.dispatch,
            stand: &frame.parameters.stand.positions,
            penalized_pose: &frame.parameters.penalized_pose.positions,
            crouch: &frame.parameters.sit_down.crouch,
            walk: &frame.parameters.walking_engine,
            motions: &frame.parameters.motions,
            stiffness: &frame.parameters.motion_dispatcher.stiffness,
            velocity_share: &frame.parameters.motion_dispatcher.velocity_share,
            minimum_duration: &frame.parameters.motion_dispatcher.minimum_duration,
        };
        let outputs = self
            .motion_dispatcher
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.dispatch_commands = outputs.dispatch_commands.value;
        if let Some(injections) = frame.injections {
            injections.dispatch_commands.replace(&mut frame.own.dispatch_commands);
        }
        Ok(())
    }

    /// motion_command, sensor_data.is_in_safe_state, state safe_exits -> motion_selection
    #[inline(always)]
    fn motion_selector<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = motion_selector::CycleContext {
            motion_command: &frame.own.motion_command,
            is_in_safe_state: &frame.own.sensor_data.is_in_safe_state,
            safe_exits: &mut frame.cycler_state.safe_exits,
        };
        let outputs = self
            .motion_selector
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.motion_selection = outputs.motion_selection.value;
        if let Some(injections) = frame.injections {
            injections.motion_selection.replace(&mut frame.own.motion_selection);
        }
        Ok(())
    }

    /// motion_selection, dispatch_commands, stand_commands, penalized_commands,
    /// sit_down_commands, walk_commands, script_commands, head_command, previous
    /// motor_commands, sensor_data.positions -> motor_commands
    #[inline(always)]
    fn motor_commands_collector<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = motor_commands_collector::CycleContext {
            motion_selection: &frame.own.motion_selection,
            dispatch_commands: frame.own.dispatch_commands.as_ref(),
            stand_commands: frame.own.stand_commands.as_ref(),
            penalized_commands: frame.own.penalized_commands.as_ref(),
            sit_down_commands: frame.own.sit_down_commands.as_ref(),
            walk_commands: frame.own.walk_commands.as_ref(),
            script_commands: frame.own.script_commands.as_ref(),
            head_command: frame.own.head_command.as_ref(),
            previous: frame.previous.own.motor_commands.as_ref(),
            positions: &frame.own.sensor_data.positions,
            cycle_time: frame.cycle.time,
            velocity_share: &frame.parameters.motor_commands_collector.velocity_share,
        };
        let outputs = self
            .motor_commands_collector
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.motor_commands = outputs.motor_commands.value;
        if let Some(injections) = frame.injections {
            injections.motor_commands.replace(&mut frame.own.motor_commands);
        }
        Ok(())
    }

    /// perception Vision.obstacles, historic odometry, sonar_distances, buttons.bumpers,
    /// fall_state -> obstacles
    #[inline(always)]
    fn obstacle_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.own.obstacles);
        let candidates = Interleaved {
            order: &frame.perception.vision,
            instances: [
                &frame.perception.vision_top.project(|outputs| &outputs.obstacles),
                &frame.perception.vision_bottom.project(|outputs| &outputs.obstacles),
            ],
        };
        let odometry = frame.historic.odometry.project(|odometry| odometry);
        let context = obstacle_filter::CycleContext {
            candidates: PerceptionInput::new(&candidates),
            odometry: HistoricInput::new(
                &odometry,
                frame.cycle.time.start,
                &frame.own.odometry,
            ),
            sonar_distances: &frame.own.sonar_distances,
            bumpers: &frame.own.buttons.bumpers,
            fall_state: &frame.own.fall_state,
            cycle_time: frame.cycle.time,
            parameters: &frame.parameters.obstacle_filter,
            obstacles: &mut frame.own.obstacles,
        };
        self.obstacle_filter.call(&frame.cycle, |node| node.cycle(context))?;
        if let Some(injections) = frame.injections {
            injections.obstacles.replace(&mut frame.own.obstacles);
        }
        Ok(())
    }

    /// robot_kinematics, support_side, orientation, sensor_data.inertial, fall_state ->
    /// odometry
    #[inline(always)]
    fn odometry<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = odometry::CycleContext {
            robot_kinematics: &frame.shared.robot_kinematics,
            support_side: frame.own.support_side.as_ref(),
            orientation: &frame.own.orientation,
            inertial: &frame.own.sensor_data.inertial,
            fall_state: &frame.own.fall_state,
            cycle_time: frame.cycle.time,
            forward_scale: &frame.parameters.odometry.forward_scale,
            left_scale: &frame.parameters.odometry.left_scale,
            still_distance: &frame.parameters.odometry.still_distance,
            still_angle: &frame.parameters.odometry.still_angle,
            still_rotation: &frame.parameters.odometry.still_rotation,
            still_time: &frame.parameters.odometry.still_time,
        };
        let outputs = self.odometry.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.odometry = outputs.odometry.value;
        if let Some(injections) = frame.injections {
            injections.odometry.replace(&mut frame.own.odometry);
        }
        Ok(())
    }

    /// sensor_data.inertial -> orientation; when subscribed: orientation_filter.innovation
    #[inline(always)]
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
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.orientation = outputs.orientation.value;
        if let Some(injections) = frame.injections {
            injections.orientation.replace(&mut frame.own.orientation);
        }
        Ok(())
    }

    /// motion_selection -> penalized_commands
    #[inline(always)]
    fn penalized_pose<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = penalized_pose::CycleContext {
            motion_selection: &frame.own.motion_selection,
            positions: &frame.parameters.penalized_pose.positions,
            stiffness: &frame.parameters.penalized_pose.stiffness,
        };
        let outputs = self
            .penalized_pose
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.penalized_commands = outputs.penalized_commands.value;
        if let Some(injections) = frame.injections {
            injections.penalized_commands.replace(&mut frame.own.penalized_commands);
        }
        Ok(())
    }

    /// primary_state, fall_state -> is_recording_wanted
    #[inline(always)]
    fn recording_switch<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = recording_switch::CycleContext {
            primary_state: &frame.own.primary_state,
            fall_state: &frame.own.fall_state,
            cycle_time: frame.cycle.time,
            states: &frame.parameters.recording_switch.states,
            after_fall: &frame.parameters.recording_switch.after_fall,
        };
        let outputs = self
            .recording_switch
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.is_recording_wanted = outputs.is_recording_wanted.value;
        if let Some(injections) = frame.injections {
            injections.is_recording_wanted.replace(&mut frame.own.is_recording_wanted);
        }
        Ok(())
    }

    /// primary_state, game_controller_state, whose_ball, ball, team_ball, teammates -> role,
    /// goalkeeper
    #[inline(always)]
    fn role_assignment<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = role_assignment::CycleContext {
            primary_state: &frame.own.primary_state,
            game_controller_state: &frame.own.game_controller_state,
            whose_ball: &frame.own.whose_ball,
            ball: &frame.own.ball,
            team_ball: &frame.own.team_ball,
            teammates: &frame.own.teammates,
            player: &frame.parameters.player,
            parameters: &frame.parameters.role_assignment,
            markings: &frame.parameters.field_dimensions.markings,
        };
        let outputs = self
            .role_assignment
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.role = outputs.role.value;
        frame.own.goalkeeper = outputs.goalkeeper.value;
        if let Some(injections) = frame.injections {
            injections.role.replace(&mut frame.own.role);
            injections.goalkeeper.replace(&mut frame.own.goalkeeper);
        }
        Ok(())
    }

    /// motion_selection, sensor_data.positions, previous motor_commands, state
    /// safe_exits.script -> script_commands
    #[inline(always)]
    fn scripted_motion<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = scripted_motion::CycleContext {
            motion_selection: &frame.own.motion_selection,
            positions: &frame.own.sensor_data.positions,
            previous: frame.previous.own.motor_commands.as_ref(),
            cycle_time: frame.cycle.time,
            safe_exit: &mut frame.cycler_state.safe_exits.script,
            motions: &frame.parameters.motions,
        };
        let outputs = self
            .scripted_motion
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.script_commands = outputs.script_commands.value;
        if let Some(injections) = frame.injections {
            injections.script_commands.replace(&mut frame.own.script_commands);
        }
        Ok(())
    }

    /// primary_state, fall_state, ground_to_field, ball, role -> self_report, team_report
    #[inline(always)]
    fn self_report<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = self_report::CycleContext {
            primary_state: &frame.own.primary_state,
            fall_state: &frame.own.fall_state,
            ground_to_field: &frame.own.ground_to_field,
            ball: &frame.own.ball,
            role: &frame.own.role,
            cycle_time: frame.cycle.time,
            player: &frame.parameters.player,
        };
        let outputs = self.self_report.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.self_report = outputs.self_report.value;
        frame.own.team_report = outputs.team_report.value;
        if let Some(injections) = frame.injections {
            injections.self_report.replace(&mut frame.own.self_report);
            injections.team_report.replace(&mut frame.own.team_report);
        }
        Ok(())
    }

    /// hardware -> sensor_data
    #[inline(always)]
    fn sensor_data_receiver(
        &mut self,
        frame: &mut Frame<'_, impl SensorInterface>,
    ) -> Result<()> {
        let context = sensor_data_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self
            .sensor_data_receiver
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.sensor_data = outputs.sensor_data.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    /// motion_selection, state safe_exits.sit_down -> sit_down_commands
    #[inline(always)]
    fn sit_down<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = sit_down::CycleContext {
            motion_selection: &frame.own.motion_selection,
            cycle_time: frame.cycle.time,
            safe_exit: &mut frame.cycler_state.safe_exits.sit_down,
            crouch: &frame.parameters.sit_down.crouch,
            sitting: &frame.parameters.sit_down.sitting,
            stiffness: &frame.parameters.sit_down.stiffness,
            velocity_share: &frame.parameters.sit_down.velocity_share,
            minimum_duration: &frame.parameters.sit_down.minimum_duration,
            release_duration: &frame.parameters.sit_down.release_duration,
        };
        let outputs = self.sit_down.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.sit_down_commands = outputs.sit_down_commands.value;
        if let Some(injections) = frame.injections {
            injections.sit_down_commands.replace(&mut frame.own.sit_down_commands);
        }
        Ok(())
    }

    /// sensor_data.sonar -> sonar_distances
    #[inline(always)]
    fn sonar_filter<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = sonar_filter::CycleContext {
            sonar: &frame.own.sensor_data.sonar,
            cycle_time: frame.cycle.time,
            least_distance: &frame.parameters.sonar_filter.least_distance,
            largest_distance: &frame.parameters.sonar_filter.largest_distance,
            echo_delay: &frame.parameters.sonar_filter.echo_delay,
            smoothing_time: &frame.parameters.sonar_filter.smoothing_time,
        };
        let outputs = self.sonar_filter.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.sonar_distances = outputs.sonar_distances.value;
        if let Some(injections) = frame.injections {
            injections.sonar_distances.replace(&mut frame.own.sonar_distances);
        }
        Ok(())
    }

    /// motion_selection -> stand_commands
    #[inline(always)]
    fn stand<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = stand::CycleContext {
            motion_selection: &frame.own.motion_selection,
            positions: &frame.parameters.stand.positions,
            stiffness: &frame.parameters.stand.stiffness,
        };
        let outputs = self.stand.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.stand_commands = outputs.stand_commands.value;
        if let Some(injections) = frame.injections {
            injections.stand_commands.replace(&mut frame.own.stand_commands);
        }
        Ok(())
    }

    /// sole_pressures, has_ground_contact -> support_side
    #[inline(always)]
    fn support_foot_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = support_foot_filter::CycleContext {
            sole_pressures: &frame.own.sole_pressures,
            has_ground_contact: &frame.own.has_ground_contact,
            hysteresis: &frame.parameters.support_foot_filter.hysteresis,
        };
        let outputs = self
            .support_foot_filter
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.support_side = outputs.support_side.value;
        if let Some(injections) = frame.injections {
            injections.support_side.replace(&mut frame.own.support_side);
        }
        Ok(())
    }

    /// ground_to_field, ball, teammates -> team_ball
    #[inline(always)]
    fn team_ball_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = team_ball_filter::CycleContext {
            ground_to_field: &frame.own.ground_to_field,
            ball: &frame.own.ball,
            teammates: &frame.own.teammates,
            cycle_time: frame.cycle.time,
            player: &frame.parameters.player,
            parameters: &frame.parameters.team_ball_filter,
        };
        let outputs = self
            .team_ball_filter
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.team_ball = outputs.team_ball.value;
        if let Some(injections) = frame.injections {
            injections.team_ball.replace(&mut frame.own.team_ball);
        }
        Ok(())
    }

    /// perception SplNetwork.team_message, game_controller_state -> teammates
    #[inline(always)]
    fn team_message_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.own.teammates);
        let messages = frame
            .perception
            .spl_network
            .project(|outputs| &outputs.team_message);
        let context = team_message_filter::CycleContext {
            messages: PerceptionInput::new(&messages),
            game_controller_state: &frame.own.game_controller_state,
            cycle_time: frame.cycle.time,
            forget_after: &frame.parameters.team_message_filter.forget_after,
            rhythm: &frame.parameters.team_rhythm,
            markings: &frame.parameters.field_dimensions.markings,
            carpet: &frame.parameters.team_message_filter.carpet,
            oldest_ball: &frame.parameters.team_ball_filter.oldest,
            teammates: &mut frame.own.teammates,
        };
        self.team_message_filter.call(&frame.cycle, |node| node.cycle(context))?;
        if let Some(injections) = frame.injections {
            injections.teammates.replace(&mut frame.own.teammates);
        }
        Ok(())
    }

    /// game_controller_state (required), team_report (required) -> hardware
    #[inline(always)]
    fn team_message_sender(
        &mut self,
        frame: &mut Frame<'_, impl MessageInterface>,
    ) -> Result<()> {
        self.team_message_sender.renew_if_broken(Self::create_team_message_sender)?;
        if let Some(game_controller_state) = frame.own.game_controller_state.as_ref()
            && let Some(report) = frame.own.team_report.as_ref()
        {
            let context = team_message_sender::CycleContext {
                hardware_interface: frame.hardware_interface,
                game_controller_state,
                report,
                cycle_time: frame.cycle.time,
                rhythm: &frame.parameters.team_rhythm,
                least_interval: &frame.parameters.team_message_sender.least_interval,
            };
            self.team_message_sender
                .call_or_skip(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent.
            self.team_message_sender.skip();
        }
        Ok(())
    }

    /// tone (required) -> hardware
    #[inline(always)]
    fn tone_player(
        &mut self,
        frame: &mut Frame<'_, impl SpeakerInterface>,
    ) -> Result<()> {
        self.tone_player.renew_if_broken(Self::create_tone_player)?;
        if let Some(tone) = frame.own.tone.as_ref() {
            let context = tone_player::CycleContext {
                hardware_interface: frame.hardware_interface,
                tone,
            };
            self.tone_player.call_or_skip(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent.
            self.tone_player.skip();
        }
        Ok(())
    }

    /// whistle, primary_state -> tone
    #[inline(always)]
    fn tone_selector<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = tone_selector::CycleContext {
            whistle: &frame.own.whistle,
            primary_state: &frame.own.primary_state,
            whistle_tone: &frame.parameters.tone_selector.whistle_tone,
            state_tone: &frame.parameters.tone_selector.state_tone,
            lowest_whistle: &frame.parameters.whistle_detection.lowest_frequency,
            highest_whistle: &frame.parameters.whistle_detection.highest_frequency,
        };
        let outputs = self.tone_selector.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.tone = outputs.tone.value;
        if let Some(injections) = frame.injections {
            injections.tone.replace(&mut frame.own.tone);
        }
        Ok(())
    }

    /// motion_command, motion_selection, sensor_data.inertial.gyroscope, orientation,
    /// sensor_data.force_sensitive_resistors, sensor_data.temperatures, state safe_exits.walk
    /// -> walk_commands
    #[inline(always)]
    fn walking_engine<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = walking_engine::CycleContext {
            motion_command: &frame.own.motion_command,
            motion_selection: &frame.own.motion_selection,
            gyroscope: &frame.own.sensor_data.inertial.gyroscope,
            orientation: &frame.own.orientation,
            resistors: &frame.own.sensor_data.force_sensitive_resistors,
            temperatures: &frame.own.sensor_data.temperatures,
            cycle_time: frame.cycle.time,
            safe_exit: &mut frame.cycler_state.safe_exits.walk,
            parameters: &frame.parameters.walking_engine,
            heat: &frame.parameters.walking_heat,
            least_weight: &frame.parameters.walking_feet.least_weight,
        };
        let outputs = self
            .walking_engine
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.walk_commands = outputs.walk_commands.value;
        if let Some(injections) = frame.injections {
            injections.walk_commands.replace(&mut frame.own.walk_commands);
        }
        Ok(())
    }

    /// perception Audio.whistle_evidence -> whistle; when subscribed: whistle_filter.votes
    #[inline(always)]
    fn whistle_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let whistle_evidence = frame
            .perception
            .audio
            .project(|outputs| &outputs.whistle_evidence);
        let context = whistle_filter::CycleContext {
            whistle_evidence: PerceptionInput::new(&whistle_evidence),
            cycle_time: frame.cycle.time,
            least_microphones: &frame.parameters.whistle_filter.least_microphones,
            least_blocks: &frame.parameters.whistle_filter.least_blocks,
            window: &frame.parameters.whistle_filter.window,
            votes: AdditionalOutput::new(
                frame.subscribed.whistle_filter_votes,
                frame.cycle.number,
                &mut frame.additional_outputs.whistle_filter.votes,
            ),
        };
        let outputs = self
            .whistle_filter
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.whistle = outputs.whistle.value;
        if let Some(injections) = frame.injections {
            injections.whistle.replace(&mut frame.own.whistle);
        }
        Ok(())
    }

    /// primary_state, game_controller_state -> whose_ball
    #[inline(always)]
    fn whose_ball_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let context = whose_ball_filter::CycleContext {
            primary_state: &frame.own.primary_state,
            game_controller_state: &frame.own.game_controller_state,
            cycle_time: frame.cycle.time,
            set_play_lasts: &frame.parameters.whose_ball_filter.set_play_lasts,
        };
        let outputs = self
            .whose_ball_filter
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.whose_ball = outputs.whose_ball.value;
        if let Some(injections) = frame.injections {
            injections.whose_ball.replace(&mut frame.own.whose_ball);
        }
        Ok(())
    }

    /// primary_state, whose_ball, fall_state, has_ground_contact, ground_to_field, ball,
    /// obstacles, teammates, role, goalkeeper, team_ball -> world_state
    #[inline(always)]
    fn world_state_composer<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        Clear::clear(&mut frame.own.world_state);
        let context = world_state_composer::CycleContext {
            primary_state: &frame.own.primary_state,
            whose_ball: &frame.own.whose_ball,
            fall_state: &frame.own.fall_state,
            has_ground_contact: &frame.own.has_ground_contact,
            ground_to_field: &frame.own.ground_to_field,
            ball: &frame.own.ball,
            obstacles: &frame.own.obstacles,
            teammates: &frame.own.teammates,
            role: &frame.own.role,
            goalkeeper: &frame.own.goalkeeper,
            team_ball: &frame.own.team_ball,
            world_state: &mut frame.own.world_state,
        };
        self.world_state_composer.call(&frame.cycle, |node| node.cycle(context))?;
        if let Some(injections) = frame.injections {
            injections.world_state.replace(&mut frame.own.world_state);
        }
        Ok(())
    }

    fn create_ball_filter() -> Result<ball_filter::BallFilter> {
        let context = ball_filter::CreationContext {};
        ball_filter::BallFilter::new(context).in_node("control::ball_filter")
    }

    fn create_behavior() -> Result<behavior::Behavior> {
        let context = behavior::CreationContext {};
        behavior::Behavior::new(context).in_node("control::behavior")
    }

    fn create_button_filter() -> Result<button_filter::ButtonFilter> {
        let context = button_filter::CreationContext {};
        button_filter::ButtonFilter::new(context).in_node("control::button_filter")
    }

    fn create_camera_matrices() -> Result<camera_matrices::CameraMatricesProvider> {
        let context = camera_matrices::CreationContext {};
        camera_matrices::CameraMatricesProvider::new(context)
            .in_node("control::camera_matrices")
    }

    fn create_center_of_mass() -> Result<center_of_mass::CenterOfMass> {
        let context = center_of_mass::CreationContext {};
        center_of_mass::CenterOfMass::new(context).in_node("control::center_of_mass")
    }

    fn create_client_wishes() -> Result<client_wishes::ClientWishes> {
        let context = client_wishes::CreationContext {};
        client_wishes::ClientWishes::new(context).in_node("control::client_wishes")
    }

    fn create_command_sender() -> Result<command_sender::CommandSender> {
        let context = command_sender::CreationContext {};
        command_sender::CommandSender::new(context).in_node("control::command_sender")
    }

    fn create_fall_state_filter() -> Result<fall_state_filter::FallStateFilter> {
        let context = fall_state_filter::CreationContext {};
        fall_state_filter::FallStateFilter::new(context)
            .in_node("control::fall_state_filter")
    }

    fn create_foot_pressure_filter() -> Result<
        foot_pressure_filter::FootPressureFilter,
    > {
        let context = foot_pressure_filter::CreationContext {};
        foot_pressure_filter::FootPressureFilter::new(context)
            .in_node("control::foot_pressure_filter")
    }

    fn create_forward_kinematics() -> Result<forward_kinematics::ForwardKinematics> {
        let context = forward_kinematics::CreationContext {};
        forward_kinematics::ForwardKinematics::new(context)
            .in_node("control::forward_kinematics")
    }

    fn create_game_controller_filter() -> Result<
        game_controller_filter::GameControllerFilter,
    > {
        let context = game_controller_filter::CreationContext {};
        game_controller_filter::GameControllerFilter::new(context)
            .in_node("control::game_controller_filter")
    }

    fn create_game_controller_responder() -> Result<
        game_controller_responder::GameControllerResponder,
    > {
        let context = game_controller_responder::CreationContext {};
        game_controller_responder::GameControllerResponder::new(context)
            .in_node("control::game_controller_responder")
    }

    fn create_game_state_filter() -> Result<game_state_filter::GameStateFilter> {
        let context = game_state_filter::CreationContext {};
        game_state_filter::GameStateFilter::new(context)
            .in_node("control::game_state_filter")
    }

    fn create_ground_contact_filter() -> Result<
        ground_contact_filter::GroundContactFilter,
    > {
        let context = ground_contact_filter::CreationContext {};
        ground_contact_filter::GroundContactFilter::new(context)
            .in_node("control::ground_contact_filter")
    }

    fn create_head_motion() -> Result<head_motion::HeadMotion> {
        let context = head_motion::CreationContext {};
        head_motion::HeadMotion::new(context).in_node("control::head_motion")
    }

    fn create_led_status() -> Result<led_status::LedStatus> {
        let context = led_status::CreationContext {};
        led_status::LedStatus::new(context).in_node("control::led_status")
    }

    fn create_localization() -> Result<localization::Localization> {
        let context = localization::CreationContext {};
        localization::Localization::new(context).in_node("control::localization")
    }

    fn create_look_around() -> Result<look_around::LookAround> {
        let context = look_around::CreationContext {};
        look_around::LookAround::new(context).in_node("control::look_around")
    }

    fn create_look_at() -> Result<look_at::LookAt> {
        let context = look_at::CreationContext {};
        look_at::LookAt::new(context).in_node("control::look_at")
    }

    fn create_motion_dispatcher() -> Result<motion_dispatcher::MotionDispatcher> {
        let context = motion_dispatcher::CreationContext {};
        motion_dispatcher::MotionDispatcher::new(context)
            .in_node("control::motion_dispatcher")
    }

    fn create_motion_selector() -> Result<motion_selector::MotionSelector> {
        let context = motion_selector::CreationContext {};
        motion_selector::MotionSelector::new(context).in_node("control::motion_selector")
    }

    fn create_motor_commands_collector() -> Result<
        motor_commands_collector::MotorCommandsCollector,
    > {
        let context = motor_commands_collector::CreationContext {};
        motor_commands_collector::MotorCommandsCollector::new(context)
            .in_node("control::motor_commands_collector")
    }

    fn create_obstacle_filter() -> Result<obstacle_filter::ObstacleFilter> {
        let context = obstacle_filter::CreationContext {};
        obstacle_filter::ObstacleFilter::new(context).in_node("control::obstacle_filter")
    }

    fn create_odometry() -> Result<odometry::OdometryProvider> {
        let context = odometry::CreationContext {};
        odometry::OdometryProvider::new(context).in_node("control::odometry")
    }

    fn create_orientation_filter() -> Result<orientation_filter::OrientationFilter> {
        let context = orientation_filter::CreationContext {};
        orientation_filter::OrientationFilter::new(context)
            .in_node("control::orientation_filter")
    }

    fn create_penalized_pose() -> Result<penalized_pose::PenalizedPose> {
        let context = penalized_pose::CreationContext {};
        penalized_pose::PenalizedPose::new(context).in_node("control::penalized_pose")
    }

    fn create_recording_switch() -> Result<recording_switch::RecordingSwitch> {
        let context = recording_switch::CreationContext {};
        recording_switch::RecordingSwitch::new(context)
            .in_node("control::recording_switch")
    }

    fn create_role_assignment() -> Result<role_assignment::RoleAssignment> {
        let context = role_assignment::CreationContext {};
        role_assignment::RoleAssignment::new(context).in_node("control::role_assignment")
    }

    fn create_scripted_motion() -> Result<scripted_motion::ScriptedMotion> {
        let context = scripted_motion::CreationContext {};
        scripted_motion::ScriptedMotion::new(context).in_node("control::scripted_motion")
    }

    fn create_self_report() -> Result<self_report::SelfReport> {
        let context = self_report::CreationContext {};
        self_report::SelfReport::new(context).in_node("control::self_report")
    }

    fn create_sensor_data_receiver() -> Result<
        sensor_data_receiver::SensorDataReceiver,
    > {
        let context = sensor_data_receiver::CreationContext {};
        sensor_data_receiver::SensorDataReceiver::new(context)
            .in_node("control::sensor_data_receiver")
    }

    fn create_sit_down() -> Result<sit_down::SitDown> {
        let context = sit_down::CreationContext {};
        sit_down::SitDown::new(context).in_node("control::sit_down")
    }

    fn create_sonar_filter() -> Result<sonar_filter::SonarFilter> {
        let context = sonar_filter::CreationContext {};
        sonar_filter::SonarFilter::new(context).in_node("control::sonar_filter")
    }

    fn create_stand() -> Result<stand::Stand> {
        let context = stand::CreationContext {};
        stand::Stand::new(context).in_node("control::stand")
    }

    fn create_support_foot_filter() -> Result<support_foot_filter::SupportFootFilter> {
        let context = support_foot_filter::CreationContext {};
        support_foot_filter::SupportFootFilter::new(context)
            .in_node("control::support_foot_filter")
    }

    fn create_team_ball_filter() -> Result<team_ball_filter::TeamBallFilter> {
        let context = team_ball_filter::CreationContext {};
        team_ball_filter::TeamBallFilter::new(context)
            .in_node("control::team_ball_filter")
    }

    fn create_team_message_filter() -> Result<team_message_filter::TeamMessageFilter> {
        let context = team_message_filter::CreationContext {};
        team_message_filter::TeamMessageFilter::new(context)
            .in_node("control::team_message_filter")
    }

    fn create_team_message_sender() -> Result<team_message_sender::TeamMessageSender> {
        let context = team_message_sender::CreationContext {};
        team_message_sender::TeamMessageSender::new(context)
            .in_node("control::team_message_sender")
    }

    fn create_tone_player() -> Result<tone_player::TonePlayer> {
        let context = tone_player::CreationContext {};
        tone_player::TonePlayer::new(context).in_node("control::tone_player")
    }

    fn create_tone_selector() -> Result<tone_selector::ToneSelector> {
        let context = tone_selector::CreationContext {};
        tone_selector::ToneSelector::new(context).in_node("control::tone_selector")
    }

    fn create_walking_engine() -> Result<walking_engine::WalkingEngine> {
        let context = walking_engine::CreationContext {};
        walking_engine::WalkingEngine::new(context).in_node("control::walking_engine")
    }

    fn create_whistle_filter() -> Result<whistle_filter::WhistleFilter> {
        let context = whistle_filter::CreationContext {};
        whistle_filter::WhistleFilter::new(context).in_node("control::whistle_filter")
    }

    fn create_whose_ball_filter() -> Result<whose_ball_filter::WhoseBallFilter> {
        let context = whose_ball_filter::CreationContext {};
        whose_ball_filter::WhoseBallFilter::new(context)
            .in_node("control::whose_ball_filter")
    }

    fn create_world_state_composer() -> Result<
        world_state_composer::WorldStateComposer,
    > {
        let context = world_state_composer::CreationContext {};
        world_state_composer::WorldStateComposer::new(context)
            .in_node("control::world_state_composer")
    }
}
