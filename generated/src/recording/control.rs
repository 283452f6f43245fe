//! Cycler `Control` in a recording: what its cycles take, saved and given back.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;
use std::time::Duration;

use framework::Clock;
use framework::Consumer;
use framework::Cycler;
use framework::Guarded;
use framework::History;
use framework::Horizon;
use framework::Injected;
use framework::Interleaving;
use framework::OnFailure;
use framework::Result;
use framework::Slots;
use framework::Subscriptions;
use framework::Swap;
use framework::Timestamp;
use framework::Writer;
use framework::buffer;
use framework::buffer_of;
use framework::procedure;
use framework::recorded::Describing;
use framework::recorded::Digests;
use framework::recorded::Foreign;
use framework::recorded::Loaded;
use framework::recorded::Loading;
use framework::recorded::Recorded;
use framework::recorded::SaveError;
use framework::recorded::Saving;
use framework::recorded::Stored;
use framework::recorded::Values;
use framework::replay::Alone;
use framework::replay::Replay;
use hardware::ActuatorInterface;
use hardware::MessageInterface;
use hardware::SensorInterface;
use hardware::SpeakerInterface;

use crate::cyclers::control::Nodes;
use crate::databases::audio;
use crate::databases::control::AdditionalOutputs;
use crate::databases::control::CyclerState;
use crate::databases::control::Historic;
use crate::databases::control::Injections;
use crate::databases::control::Perception;
use crate::databases::control::Procedures;
use crate::databases::control::SharedOutputs;
use crate::databases::control::Subscribed;
use crate::databases::spl_network;
use crate::databases::vision;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::control::ADDITIONAL_OUTPUTS;
use crate::runtime::control::CONTROL;
use crate::runtime::control::Control;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
    pub vision_top: Writer<vision::SharedOutputs>,
    pub vision_bottom: Writer<vision::SharedOutputs>,
    pub spl_network: Writer<spl_network::SharedOutputs>,
    pub audio: Writer<audio::SharedOutputs>,
}

impl<
    Hardware: ActuatorInterface + MessageInterface + SensorInterface + SpeakerInterface
        + Send + Sync,
> Recorded for Control<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("control::button_filter", "buttons"),
        ("control::sonar_filter", "sonar_distances"),
        ("control::orientation_filter", "orientation"),
        ("control::foot_pressure_filter", "sole_pressures"),
        ("control::ground_contact_filter", "has_ground_contact"),
        ("control::support_foot_filter", "support_side"),
        ("control::forward_kinematics", "robot_kinematics"),
        ("control::center_of_mass", "center_of_mass"),
        ("control::fall_state_filter", "fall_state"),
        ("control::odometry", "odometry"),
        ("control::camera_matrices", "camera_matrices"),
        ("control::game_controller_filter", "game_controller_state"),
        ("control::team_message_filter", "teammates"),
        ("control::whistle_filter", "whistle"),
        ("control::game_state_filter", "primary_state"),
        ("control::whose_ball_filter", "whose_ball"),
        ("control::localization", "ground_to_field"),
        ("control::obstacle_filter", "obstacles"),
        ("control::ball_filter", "ball"),
        ("control::team_ball_filter", "team_ball"),
        ("control::role_assignment", "goalkeeper"),
        ("control::role_assignment", "role"),
        ("control::world_state_composer", "world_state"),
        ("control::client_wishes", "client_wish"),
        ("control::behavior", "activity"),
        ("control::behavior", "motion_command"),
        ("control::recording_switch", "is_recording_wanted"),
        ("control::motion_selector", "motion_selection"),
        ("control::motion_dispatcher", "dispatch_commands"),
        ("control::stand", "stand_commands"),
        ("control::penalized_pose", "penalized_commands"),
        ("control::sit_down", "sit_down_commands"),
        ("control::walking_engine", "walk_commands"),
        ("control::scripted_motion", "script_commands"),
        ("control::look_around", "look_around"),
        ("control::look_at", "look_at"),
        ("control::head_motion", "head_command"),
        ("control::motor_commands_collector", "motor_commands"),
        ("control::led_status", "leds"),
        ("control::tone_selector", "tone"),
        ("control::self_report", "self_report"),
        ("control::self_report", "team_report"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        values.of("VisionTop", &self.perception.vision_top)?;
        values.of("VisionBottom", &self.perception.vision_bottom)?;
        values.of("SplNetwork", &self.perception.spl_network)?;
        values.of("Audio", &self.perception.audio)?;
        Ok(())
    }

    fn save(
        &self,
        _cycle: u64,
        _slots: Slots<'_, SharedOutputs>,
        since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.parameters.save_version(out);
        self.nodes.sensor_data_receiver.record(out);
        self.nodes.button_filter.record(out);
        self.nodes.sonar_filter.record(out);
        self.nodes.orientation_filter.record(out);
        self.nodes.foot_pressure_filter.record(out);
        self.nodes.ground_contact_filter.record(out);
        self.nodes.support_foot_filter.record(out);
        self.nodes.forward_kinematics.record(out);
        self.nodes.center_of_mass.record(out);
        self.nodes.fall_state_filter.record(out);
        self.nodes.odometry.record(out);
        self.nodes.camera_matrices.record(out);
        self.nodes.game_controller_filter.record(out);
        self.nodes.team_message_filter.record(out);
        self.nodes.whistle_filter.record(out);
        self.nodes.game_state_filter.record(out);
        self.nodes.whose_ball_filter.record(out);
        self.nodes.localization.record(out);
        self.nodes.ball_filter.record(out);
        self.nodes.obstacle_filter.record(out);
        self.nodes.team_ball_filter.record(out);
        self.nodes.role_assignment.record(out);
        self.nodes.world_state_composer.record(out);
        self.nodes.client_wishes.record(out);
        self.nodes.behavior.record(out);
        self.nodes.recording_switch.record(out);
        self.nodes.motion_selector.record(out);
        self.nodes.motion_dispatcher.record(out);
        self.nodes.stand.record(out);
        self.nodes.penalized_pose.record(out);
        self.nodes.sit_down.record(out);
        self.nodes.walking_engine.record(out);
        self.nodes.scripted_motion.record(out);
        self.nodes.look_around.record(out);
        self.nodes.look_at.record(out);
        self.nodes.head_motion.record(out);
        self.nodes.motor_commands_collector.record(out);
        self.nodes.led_status.record(out);
        self.nodes.tone_selector.record(out);
        self.nodes.tone_player.record(out);
        self.nodes.self_report.record(out);
        self.nodes.game_controller_responder.record(out);
        self.nodes.team_message_sender.record(out);
        self.nodes.command_sender.record(out);
        out.put(&self.cycler_state);
        self.historic.odometry.save(since, out);
        self.injections.save_injected(out);
        out.output(&self.own.current().sensor_data);
        Foreign::save(&self.perception.vision_top, out);
        Foreign::save(&self.perception.vision_bottom, out);
        Foreign::save(&self.perception.spl_network, out);
        Foreign::save(&self.perception.audio, out);
        out.output(&self.own.previous().head_command);
        out.output(&self.own.previous().motor_commands);
        self.procedures.look_at.save(out);
        self.procedures.motion.save(out);
        self.procedures.walk.save(out);
        out.put(&self.subscribed);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types
            .node(
                "control::sensor_data_receiver",
                |body| &body.nodes.sensor_data_receiver,
            );
        types.node("control::button_filter", |body| &body.nodes.button_filter);
        types.node("control::sonar_filter", |body| &body.nodes.sonar_filter);
        types.node("control::orientation_filter", |body| &body.nodes.orientation_filter);
        types
            .node(
                "control::foot_pressure_filter",
                |body| &body.nodes.foot_pressure_filter,
            );
        types
            .node(
                "control::ground_contact_filter",
                |body| &body.nodes.ground_contact_filter,
            );
        types
            .node(
                "control::support_foot_filter",
                |body| &body.nodes.support_foot_filter,
            );
        types.node("control::forward_kinematics", |body| &body.nodes.forward_kinematics);
        types.node("control::center_of_mass", |body| &body.nodes.center_of_mass);
        types.node("control::fall_state_filter", |body| &body.nodes.fall_state_filter);
        types.node("control::odometry", |body| &body.nodes.odometry);
        types.node("control::camera_matrices", |body| &body.nodes.camera_matrices);
        types
            .node(
                "control::game_controller_filter",
                |body| &body.nodes.game_controller_filter,
            );
        types
            .node(
                "control::team_message_filter",
                |body| &body.nodes.team_message_filter,
            );
        types.node("control::whistle_filter", |body| &body.nodes.whistle_filter);
        types.node("control::game_state_filter", |body| &body.nodes.game_state_filter);
        types.node("control::whose_ball_filter", |body| &body.nodes.whose_ball_filter);
        types.node("control::localization", |body| &body.nodes.localization);
        types.node("control::ball_filter", |body| &body.nodes.ball_filter);
        types.node("control::obstacle_filter", |body| &body.nodes.obstacle_filter);
        types.node("control::team_ball_filter", |body| &body.nodes.team_ball_filter);
        types.node("control::role_assignment", |body| &body.nodes.role_assignment);
        types
            .node(
                "control::world_state_composer",
                |body| &body.nodes.world_state_composer,
            );
        types.node("control::client_wishes", |body| &body.nodes.client_wishes);
        types.node("control::behavior", |body| &body.nodes.behavior);
        types.node("control::recording_switch", |body| &body.nodes.recording_switch);
        types.node("control::motion_selector", |body| &body.nodes.motion_selector);
        types.node("control::motion_dispatcher", |body| &body.nodes.motion_dispatcher);
        types.node("control::stand", |body| &body.nodes.stand);
        types.node("control::penalized_pose", |body| &body.nodes.penalized_pose);
        types.node("control::sit_down", |body| &body.nodes.sit_down);
        types.node("control::walking_engine", |body| &body.nodes.walking_engine);
        types.node("control::scripted_motion", |body| &body.nodes.scripted_motion);
        types.node("control::look_around", |body| &body.nodes.look_around);
        types.node("control::look_at", |body| &body.nodes.look_at);
        types.node("control::head_motion", |body| &body.nodes.head_motion);
        types
            .node(
                "control::motor_commands_collector",
                |body| &body.nodes.motor_commands_collector,
            );
        types.node("control::led_status", |body| &body.nodes.led_status);
        types.node("control::tone_selector", |body| &body.nodes.tone_selector);
        types.node("control::tone_player", |body| &body.nodes.tone_player);
        types.node("control::self_report", |body| &body.nodes.self_report);
        types
            .node(
                "control::game_controller_responder",
                |body| &body.nodes.game_controller_responder,
            );
        types
            .node(
                "control::team_message_sender",
                |body| &body.nodes.team_message_sender,
            );
        types.node("control::command_sender", |body| &body.nodes.command_sender);
        types.state(|body| &body.cycler_state);
        types.history("odometry", |body| &body.historic.odometry);
        types.injections(|body| &body.injections);
        types.output("sensor_data", |body| &body.own.current().sensor_data);
        types.foreign("VisionTop", |body| &body.perception.vision_top);
        types.foreign("VisionBottom", |body| &body.perception.vision_bottom);
        types.foreign("SplNetwork", |body| &body.perception.spl_network);
        types.foreign("Audio", |body| &body.perception.audio);
        types.previous("head_command", |body| &body.own.previous().head_command);
        types.previous("motor_commands", |body| &body.own.previous().motor_commands);
        types.procedure("look_at", |body| &body.procedures.look_at);
        types.procedure("motion", |body| &body.procedures.motion);
        types.procedure("walk", |body| &body.procedures.walk);
        types.subscribed(|body| &body.subscribed);
    }

    fn load(
        &mut self,
        _cycle: u64,
        _slots: Loaded<'_, SharedOutputs>,
        outside: &mut Outside,
        from: &mut Loading<'_>,
        stored: &Stored<'_>,
    ) -> Result<()> {
        self.parameters.load_version(from, &mut outside.parameters, stored)?;
        self.nodes = load_nodes(from)?;
        self.cycler_state = from.take()?;
        self.historic.odometry.load(from)?;
        self.injections.load_injected(from, &mut outside.injections)?;
        self.own.both_to_load().0.sensor_data = from.take()?;
        Foreign::load(
            &mut self.perception.vision_top,
            from,
            &mut outside.vision_top,
            &mut |cycle| stored.value("VisionTop", cycle),
        )?;
        Foreign::load(
            &mut self.perception.vision_bottom,
            from,
            &mut outside.vision_bottom,
            &mut |cycle| stored.value("VisionBottom", cycle),
        )?;
        Foreign::load(
            &mut self.perception.spl_network,
            from,
            &mut outside.spl_network,
            &mut |cycle| stored.value("SplNetwork", cycle),
        )?;
        Foreign::load(
            &mut self.perception.audio,
            from,
            &mut outside.audio,
            &mut |cycle| stored.value("Audio", cycle),
        )?;
        self.perception
            .vision
            .merge([&self.perception.vision_top, &self.perception.vision_bottom]);
        self.own.both_to_load().1.head_command = from.take()?;
        self.own.both_to_load().1.motor_commands = from.take()?;
        self.procedures.look_at.load(from)?;
        self.procedures.motion.load(from)?;
        self.procedures.walk.load(from)?;
        let recorded: Subscribed = from.take()?;
        let mut wanted = self.subscriptions.wanted();
        self.subscribed = Subscribed {
            ball_filter_delivered: wanted.next_one() || recorded.ball_filter_delivered,
            ball_filter_hypotheses: wanted.next_one() || recorded.ball_filter_hypotheses,
            ball_filter_persistent_ball: wanted.next_one()
                || recorded.ball_filter_persistent_ball,
            fall_state_filter_center_of_mass_overhang: wanted.next_one()
                || recorded.fall_state_filter_center_of_mass_overhang,
            localization_hypotheses: wanted.next_one()
                || recorded.localization_hypotheses,
            orientation_filter_innovation: wanted.next_one()
                || recorded.orientation_filter_innovation,
            plan: wanted.next_one() || recorded.plan,
            whistle_filter_votes: wanted.next_one() || recorded.whistle_filter_votes,
        };
        Ok(())
    }

    fn digests(&self, shared: &SharedOutputs, digests: &mut Digests<'_, '_>) {
        digests.add(&self.own.previous().buttons);
        digests.add(&self.own.previous().sonar_distances);
        digests.add(&self.own.previous().orientation);
        digests.add(&self.own.previous().sole_pressures);
        digests.add(&self.own.previous().has_ground_contact);
        digests.add(&self.own.previous().support_side);
        digests.add(&shared.robot_kinematics);
        digests.add(&self.own.previous().center_of_mass);
        digests.add(&self.own.previous().fall_state);
        digests.add(&self.own.previous().odometry);
        digests.add(&shared.camera_matrices);
        digests.add(&self.own.previous().game_controller_state);
        digests.add(&self.own.previous().teammates);
        digests.add(&self.own.previous().whistle);
        digests.add(&self.own.previous().primary_state);
        digests.add(&self.own.previous().whose_ball);
        digests.add(&self.own.previous().ground_to_field);
        digests.add(&self.own.previous().obstacles);
        digests.add(&self.own.previous().ball);
        digests.add(&self.own.previous().team_ball);
        digests.add(&self.own.previous().goalkeeper);
        digests.add(&self.own.previous().role);
        digests.add(&self.own.previous().world_state);
        digests.add(&self.own.previous().client_wish);
        digests.add(&self.own.previous().activity);
        digests.add(&self.own.previous().motion_command);
        digests.add(&self.own.previous().is_recording_wanted);
        digests.add(&self.own.previous().motion_selection);
        digests.add(&self.own.previous().dispatch_commands);
        digests.add(&self.own.previous().stand_commands);
        digests.add(&self.own.previous().penalized_commands);
        digests.add(&self.own.previous().sit_down_commands);
        digests.add(&self.own.previous().walk_commands);
        digests.add(&self.own.previous().script_commands);
        digests.add(&self.own.previous().look_around);
        digests.add(&self.own.previous().look_at);
        digests.add(&self.own.previous().head_command);
        digests.add(&self.own.previous().motor_commands);
        digests.add(&self.own.previous().leds);
        digests.add(&self.own.previous().tone);
        digests.add(&self.own.previous().self_report);
        digests.add(&self.own.previous().team_report);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        sensor_data_receiver: Guarded::recorded(
            "control::sensor_data_receiver",
            OnFailure::Stop,
            from,
        )?,
        button_filter: Guarded::recorded(
            "control::button_filter",
            OnFailure::Stop,
            from,
        )?,
        sonar_filter: Guarded::recorded("control::sonar_filter", OnFailure::Stop, from)?,
        orientation_filter: Guarded::recorded(
            "control::orientation_filter",
            OnFailure::Stop,
            from,
        )?,
        foot_pressure_filter: Guarded::recorded(
            "control::foot_pressure_filter",
            OnFailure::Stop,
            from,
        )?,
        ground_contact_filter: Guarded::recorded(
            "control::ground_contact_filter",
            OnFailure::Stop,
            from,
        )?,
        support_foot_filter: Guarded::recorded(
            "control::support_foot_filter",
            OnFailure::Stop,
            from,
        )?,
        forward_kinematics: Guarded::recorded(
            "control::forward_kinematics",
            OnFailure::Stop,
            from,
        )?,
        center_of_mass: Guarded::recorded(
            "control::center_of_mass",
            OnFailure::Stop,
            from,
        )?,
        fall_state_filter: Guarded::recorded(
            "control::fall_state_filter",
            OnFailure::Stop,
            from,
        )?,
        odometry: Guarded::recorded("control::odometry", OnFailure::Stop, from)?,
        camera_matrices: Guarded::recorded(
            "control::camera_matrices",
            OnFailure::Stop,
            from,
        )?,
        game_controller_filter: Guarded::recorded(
            "control::game_controller_filter",
            OnFailure::Stop,
            from,
        )?,
        team_message_filter: Guarded::recorded(
            "control::team_message_filter",
            OnFailure::Stop,
            from,
        )?,
        whistle_filter: Guarded::recorded(
            "control::whistle_filter",
            OnFailure::Stop,
            from,
        )?,
        game_state_filter: Guarded::recorded(
            "control::game_state_filter",
            OnFailure::Stop,
            from,
        )?,
        whose_ball_filter: Guarded::recorded(
            "control::whose_ball_filter",
            OnFailure::Stop,
            from,
        )?,
        localization: Guarded::recorded("control::localization", OnFailure::Stop, from)?,
        ball_filter: Guarded::recorded("control::ball_filter", OnFailure::Stop, from)?,
        obstacle_filter: Guarded::recorded(
            "control::obstacle_filter",
            OnFailure::Stop,
            from,
        )?,
        team_ball_filter: Guarded::recorded(
            "control::team_ball_filter",
            OnFailure::Stop,
            from,
        )?,
        role_assignment: Guarded::recorded(
            "control::role_assignment",
            OnFailure::Stop,
            from,
        )?,
        world_state_composer: Guarded::recorded(
            "control::world_state_composer",
            OnFailure::Stop,
            from,
        )?,
        client_wishes: Guarded::recorded(
            "control::client_wishes",
            OnFailure::Stop,
            from,
        )?,
        behavior: Guarded::recorded("control::behavior", OnFailure::Stop, from)?,
        recording_switch: Guarded::recorded(
            "control::recording_switch",
            OnFailure::Stop,
            from,
        )?,
        motion_selector: Guarded::recorded(
            "control::motion_selector",
            OnFailure::Stop,
            from,
        )?,
        motion_dispatcher: Guarded::recorded(
            "control::motion_dispatcher",
            OnFailure::Stop,
            from,
        )?,
        stand: Guarded::recorded("control::stand", OnFailure::Stop, from)?,
        penalized_pose: Guarded::recorded(
            "control::penalized_pose",
            OnFailure::Stop,
            from,
        )?,
        sit_down: Guarded::recorded("control::sit_down", OnFailure::Stop, from)?,
        walking_engine: Guarded::recorded(
            "control::walking_engine",
            OnFailure::Stop,
            from,
        )?,
        scripted_motion: Guarded::recorded(
            "control::scripted_motion",
            OnFailure::Stop,
            from,
        )?,
        look_around: Guarded::recorded("control::look_around", OnFailure::Stop, from)?,
        look_at: Guarded::recorded("control::look_at", OnFailure::Stop, from)?,
        head_motion: Guarded::recorded("control::head_motion", OnFailure::Stop, from)?,
        motor_commands_collector: Guarded::recorded(
            "control::motor_commands_collector",
            OnFailure::Stop,
            from,
        )?,
        led_status: Guarded::recorded("control::led_status", OnFailure::Stop, from)?,
        tone_selector: Guarded::recorded(
            "control::tone_selector",
            OnFailure::Stop,
            from,
        )?,
        tone_player: Guarded::recorded("control::tone_player", OnFailure::Skip, from)?,
        self_report: Guarded::recorded("control::self_report", OnFailure::Stop, from)?,
        game_controller_responder: Guarded::recorded(
            "control::game_controller_responder",
            OnFailure::Skip,
            from,
        )?,
        team_message_sender: Guarded::recorded(
            "control::team_message_sender",
            OnFailure::Skip,
            from,
        )?,
        command_sender: Guarded::recorded(
            "control::command_sender",
            OnFailure::Stop,
            from,
        )?,
    })
}

/// `Control` alone, with the nodes of the frame that is loaded first.
pub fn replay_control(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_control], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [control_injected], []) = buffer([]);
    let (vision_top_writer, [], [vision_top_queue_for_control]) = buffer([32]);
    let (vision_bottom_writer, [], [vision_bottom_queue_for_control]) = buffer([32]);
    let (spl_network_writer, [], [spl_network_queue_for_control]) = buffer([32]);
    let (audio_writer, [], [audio_queue_for_control]) = buffer([32]);
    let control_subscriptions = Subscriptions::new(ADDITIONAL_OUTPUTS);
    let (_, control_look_at_answerer) = procedure();
    let (_, control_motion_answerer) = procedure();
    let (_, control_walk_answerer) = procedure();
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        CONTROL,
        Control {
            nodes: load_nodes(from)?,
            additional_outputs: AdditionalOutputs::default(),
            capture_time: None,
            cycler_state: CyclerState::default(),
            hardware_interface: hardware.clone(),
            historic: Historic {
                odometry: History::new(Duration::from_secs(1)),
            },
            injections: control_injected,
            own: Swap::default(),
            parameters: parameters_for_control,
            perception: Perception {
                horizon: Horizon::new(),
                vision: Interleaving::new(),
                vision_top: Consumer::new(
                    vision_top_queue_for_control,
                    Duration::from_secs(1),
                ),
                vision_bottom: Consumer::new(
                    vision_bottom_queue_for_control,
                    Duration::from_secs(1),
                ),
                spl_network: Consumer::new(
                    spl_network_queue_for_control,
                    Duration::from_secs(1),
                ),
                audio: Consumer::new(audio_queue_for_control, Duration::from_secs(1)),
            },
            procedures: Procedures {
                look_at: control_look_at_answerer,
                motion: control_motion_answerer,
                walk: control_walk_answerer,
            },
            subscribed: Subscribed::default(),
            subscriptions: control_subscriptions.clone(),
        },
        writer,
        Clock::stepped(),
    );
    Ok(
        Box::new(
            Alone::new(
                cycler,
                Outside {
                    injections: injections_writer,
                    parameters: parameters_writer,
                    vision_top: vision_top_writer,
                    vision_bottom: vision_bottom_writer,
                    spl_network: spl_network_writer,
                    audio: audio_writer,
                },
                control_subscriptions,
            ),
        ),
    )
}
