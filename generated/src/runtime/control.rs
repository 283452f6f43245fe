//! Cycler `Control` between its buffers and its nodes.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;
use std::time::Duration;

use framework::Body;
use framework::Cycle;
use framework::Injected;
use framework::InstanceDescription;
use framework::Kind;
use framework::NodeReport;
use framework::OnFailure;
use framework::OutputVisitor;
use framework::QueueReport;
use framework::Reader;
use framework::Record;
use framework::Reference;
use framework::Reflect;
use framework::Result;
use framework::Scheduling;
use framework::Slots;
use framework::State;
use framework::Subscriptions;
use framework::Swap;
use framework::Timestamp;
use hardware::ActuatorInterface;
use hardware::MessageInterface;
use hardware::SensorInterface;
use hardware::SpeakerInterface;

use crate::cyclers::control::Nodes;
use crate::databases::control::AdditionalOutputs;
use crate::databases::control::CyclerState;
use crate::databases::control::Frame;
use crate::databases::control::Historic;
use crate::databases::control::Injections;
use crate::databases::control::OwnOutputs;
use crate::databases::control::Perception;
use crate::databases::control::Previous;
use crate::databases::control::Procedures;
use crate::databases::control::SharedOutputs;
use crate::databases::control::Subscribed;
use crate::parameters::Parameters;

/// What the manifest says about `Control`.
pub const CONTROL: InstanceDescription = InstanceDescription {
    name: "Control",
    cycler: "Control",
    kind: Kind::RealTime,
    on_failure: OnFailure::Stop,
    deadline: Some(Duration::from_millis(12)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(1),
    lockstep_duration: None,
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::While {
        instance: "Control",
        path: "is_recording_wanted",
    },
};

/// What clients can listen to, in the order of `Subscribed`.
pub const ADDITIONAL_OUTPUTS: &[&str] = &[
    "ball_filter.delivered",
    "ball_filter.hypotheses",
    "ball_filter.persistent_ball",
    "fall_state_filter.center_of_mass_overhang",
    "localization.hypotheses",
    "orientation_filter.innovation",
    "plan",
    "whistle_filter.votes",
];

/// One instance: its nodes, and its ends of all buffers.
pub struct Control<Hardware> {
    pub nodes: Nodes,
    pub additional_outputs: AdditionalOutputs,
    pub capture_time: Option<Timestamp>,
    pub cycler_state: CyclerState,
    pub hardware_interface: Arc<Hardware>,
    pub historic: Historic,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
    pub perception: Perception,
    pub procedures: Procedures,
    pub subscribed: Subscribed,
    pub subscriptions: Subscriptions,
}

impl<Hardware> Control<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(
        &'a mut self,
        slots: Slots<'a, SharedOutputs>,
        cycle: Cycle,
    ) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let parameters = self.parameters.view().value();
        let (own, previous_own) = self.own.both();
        let frame = Frame {
            additional_outputs: &mut self.additional_outputs,
            capture_time: &mut self.capture_time,
            cycle,
            cycler_state: &mut self.cycler_state,
            hardware_interface: &self.hardware_interface,
            historic: &self.historic,
            injections: self.injections.view().value().get(),
            own,
            parameters,
            perception: &self.perception,
            previous: Previous { own: previous_own },
            procedures: &mut self.procedures,
            shared: slots.current,
            subscribed: self.subscribed,
        };
        (&mut self.nodes, frame)
    }
}

impl<
    Hardware: ActuatorInterface + MessageInterface + SensorInterface + SpeakerInterface
        + Send + Sync,
> Body for Control<Hardware> {
    type Shared = SharedOutputs;

    fn create(&mut self) -> Result<()> {
        self.parameters.take();
        self.cycler_state = CyclerState::default();
        self.nodes = Nodes::new()?;
        Ok(())
    }

    fn wait(
        &mut self,
        slots: Slots<'_, SharedOutputs>,
        cycle: Cycle,
    ) -> Result<Option<Timestamp>> {
        self.parameters.take();
        self.capture_time = None;
        let (nodes, mut frame) = self.frame(slots, cycle);
        nodes.setup(&mut frame)?;
        Ok(self.capture_time)
    }

    fn begin(&mut self, slots: Slots<'_, SharedOutputs>, cycle: Cycle) {
        self.parameters.take();
        self.injections.take();
        self.perception
            .horizon
            .consume(
                cycle.time.start,
                [
                    &mut self.perception.vision_top,
                    &mut self.perception.vision_bottom,
                    &mut self.perception.spl_network,
                    &mut self.perception.audio,
                ],
            );
        self.perception
            .vision
            .merge([&self.perception.vision_top, &self.perception.vision_bottom]);
        if self.subscriptions.changed() {
            let mut wanted = self.subscriptions.wanted();
            self.subscribed = Subscribed {
                ball_filter_delivered: wanted.next_one(),
                ball_filter_hypotheses: wanted.next_one(),
                ball_filter_persistent_ball: wanted.next_one(),
                fall_state_filter_center_of_mass_overhang: wanted.next_one(),
                localization_hypotheses: wanted.next_one(),
                orientation_filter_innovation: wanted.next_one(),
                plan: wanted.next_one(),
                whistle_filter_votes: wanted.next_one(),
            };
        }
        self.procedures.look_at.take();
        self.procedures.motion.take();
        self.procedures.walk.take();
        let (_, mut frame) = self.frame(slots, cycle);
        Nodes::inject(&mut frame);
    }

    fn run(&mut self, slots: Slots<'_, SharedOutputs>, cycle: Cycle) -> Result<()> {
        if cycle.timed || self.injections.view().get().is_some() {
            let (nodes, mut frame) = self.frame(slots, cycle);
            return nodes.cycle_closely(&mut frame);
        }
        let (nodes, mut frame) = self.frame(slots, cycle);
        nodes.cycle(&mut frame)
    }

    fn finish(&mut self, _shared: &SharedOutputs, cycle: Cycle) {
        self.historic.odometry.push(cycle.time.start, &self.own.current().odometry);
        self.own.swap();
        self.procedures.look_at.close();
        self.procedures.motion.close();
        self.procedures.walk.close();
    }

    fn abandon(&mut self) {
        self.procedures.look_at.close();
        self.procedures.motion.close();
        self.procedures.walk.close();
    }

    fn restore(&mut self) -> Result<()> {
        // The states of all nodes are whole.
        Ok(())
    }

    fn references(&self, visit: &mut dyn FnMut(Reference)) {
        self.perception.vision_top.references("VisionTop", visit);
        self.perception.vision_bottom.references("VisionBottom", visit);
        self.perception.spl_network.references("SplNetwork", visit);
        self.perception.audio.references("Audio", visit);
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &[
            "sensor_data",
            "buttons",
            "sonar_distances",
            "orientation",
            "sole_pressures",
            "has_ground_contact",
            "support_side",
            "robot_kinematics",
            "center_of_mass",
            "fall_state",
            "odometry",
            "camera_matrices",
            "game_controller_state",
            "teammates",
            "whistle",
            "primary_state",
            "whose_ball",
            "ground_to_field",
            "ball",
            "obstacles",
            "team_ball",
            "goalkeeper",
            "role",
            "world_state",
            "client_wish",
            "activity",
            "motion_command",
            "is_recording_wanted",
            "motion_selection",
            "dispatch_commands",
            "stand_commands",
            "penalized_commands",
            "sit_down_commands",
            "walk_commands",
            "script_commands",
            "look_around",
            "look_at",
            "head_command",
            "motor_commands",
            "leds",
            "tone",
            "self_report",
            "team_report",
        ]
    }

    fn main_output<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "sensor_data" => Some(&self.own.previous().sensor_data),
            "buttons" => Some(&self.own.previous().buttons),
            "sonar_distances" => Some(&self.own.previous().sonar_distances),
            "orientation" => Some(&self.own.previous().orientation),
            "sole_pressures" => Some(&self.own.previous().sole_pressures),
            "has_ground_contact" => Some(&self.own.previous().has_ground_contact),
            "support_side" => Some(&self.own.previous().support_side),
            "robot_kinematics" => Some(&shared.robot_kinematics),
            "center_of_mass" => Some(&self.own.previous().center_of_mass),
            "fall_state" => Some(&self.own.previous().fall_state),
            "odometry" => Some(&self.own.previous().odometry),
            "camera_matrices" => Some(&shared.camera_matrices),
            "game_controller_state" => Some(&self.own.previous().game_controller_state),
            "teammates" => Some(&self.own.previous().teammates),
            "whistle" => Some(&self.own.previous().whistle),
            "primary_state" => Some(&self.own.previous().primary_state),
            "whose_ball" => Some(&self.own.previous().whose_ball),
            "ground_to_field" => Some(&self.own.previous().ground_to_field),
            "ball" => Some(&self.own.previous().ball),
            "obstacles" => Some(&self.own.previous().obstacles),
            "team_ball" => Some(&self.own.previous().team_ball),
            "goalkeeper" => Some(&self.own.previous().goalkeeper),
            "role" => Some(&self.own.previous().role),
            "world_state" => Some(&self.own.previous().world_state),
            "client_wish" => Some(&self.own.previous().client_wish),
            "activity" => Some(&self.own.previous().activity),
            "motion_command" => Some(&self.own.previous().motion_command),
            "is_recording_wanted" => Some(&self.own.previous().is_recording_wanted),
            "motion_selection" => Some(&self.own.previous().motion_selection),
            "dispatch_commands" => Some(&self.own.previous().dispatch_commands),
            "stand_commands" => Some(&self.own.previous().stand_commands),
            "penalized_commands" => Some(&self.own.previous().penalized_commands),
            "sit_down_commands" => Some(&self.own.previous().sit_down_commands),
            "walk_commands" => Some(&self.own.previous().walk_commands),
            "script_commands" => Some(&self.own.previous().script_commands),
            "look_around" => Some(&self.own.previous().look_around),
            "look_at" => Some(&self.own.previous().look_at),
            "head_command" => Some(&self.own.previous().head_command),
            "motor_commands" => Some(&self.own.previous().motor_commands),
            "leds" => Some(&self.own.previous().leds),
            "tone" => Some(&self.own.previous().tone),
            "self_report" => Some(&self.own.previous().self_report),
            "team_report" => Some(&self.own.previous().team_report),
            _ => None,
        }
    }

    fn additional_output(&self, name: &str, cycle: u64) -> Option<&dyn Reflect> {
        match name {
            "ball_filter.delivered" => {
                Some(self.additional_outputs.ball_filter.delivered.get(cycle)?)
            }
            "ball_filter.hypotheses" => {
                Some(self.additional_outputs.ball_filter.hypotheses.get(cycle)?)
            }
            "ball_filter.persistent_ball" => {
                Some(self.additional_outputs.ball_filter.persistent_ball.get(cycle)?)
            }
            "fall_state_filter.center_of_mass_overhang" => {
                Some(
                    self
                        .additional_outputs
                        .fall_state_filter
                        .center_of_mass_overhang
                        .get(cycle)?,
                )
            }
            "localization.hypotheses" => {
                Some(self.additional_outputs.localization.hypotheses.get(cycle)?)
            }
            "orientation_filter.innovation" => {
                Some(self.additional_outputs.orientation_filter.innovation.get(cycle)?)
            }
            "plan" => Some(self.additional_outputs.plan.get(cycle)?),
            "whistle_filter.votes" => {
                Some(self.additional_outputs.whistle_filter.votes.get(cycle)?)
            }
            _ => None,
        }
    }

    fn outputs<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        cycle: u64,
        visitor: &mut impl OutputVisitor<'a>,
    ) {
        visitor.output(Some(&self.own.previous().sensor_data));
        visitor.output(Some(&self.own.previous().buttons));
        visitor.output(Some(&self.own.previous().sonar_distances));
        visitor.output(Some(&self.own.previous().orientation));
        visitor.output(Some(&self.own.previous().sole_pressures));
        visitor.output(Some(&self.own.previous().has_ground_contact));
        visitor.output(Some(&self.own.previous().support_side));
        visitor.output(Some(&shared.robot_kinematics));
        visitor.output(Some(&self.own.previous().center_of_mass));
        visitor.output(Some(&self.own.previous().fall_state));
        visitor.output(Some(&self.own.previous().odometry));
        visitor.output(Some(&shared.camera_matrices));
        visitor.output(Some(&self.own.previous().game_controller_state));
        visitor.output(Some(&self.own.previous().teammates));
        visitor.output(Some(&self.own.previous().whistle));
        visitor.output(Some(&self.own.previous().primary_state));
        visitor.output(Some(&self.own.previous().whose_ball));
        visitor.output(Some(&self.own.previous().ground_to_field));
        visitor.output(Some(&self.own.previous().ball));
        visitor.output(Some(&self.own.previous().obstacles));
        visitor.output(Some(&self.own.previous().team_ball));
        visitor.output(Some(&self.own.previous().goalkeeper));
        visitor.output(Some(&self.own.previous().role));
        visitor.output(Some(&self.own.previous().world_state));
        visitor.output(Some(&self.own.previous().client_wish));
        visitor.output(Some(&self.own.previous().activity));
        visitor.output(Some(&self.own.previous().motion_command));
        visitor.output(Some(&self.own.previous().is_recording_wanted));
        visitor.output(Some(&self.own.previous().motion_selection));
        visitor.output(Some(&self.own.previous().dispatch_commands));
        visitor.output(Some(&self.own.previous().stand_commands));
        visitor.output(Some(&self.own.previous().penalized_commands));
        visitor.output(Some(&self.own.previous().sit_down_commands));
        visitor.output(Some(&self.own.previous().walk_commands));
        visitor.output(Some(&self.own.previous().script_commands));
        visitor.output(Some(&self.own.previous().look_around));
        visitor.output(Some(&self.own.previous().look_at));
        visitor.output(Some(&self.own.previous().head_command));
        visitor.output(Some(&self.own.previous().motor_commands));
        visitor.output(Some(&self.own.previous().leds));
        visitor.output(Some(&self.own.previous().tone));
        visitor.output(Some(&self.own.previous().self_report));
        visitor.output(Some(&self.own.previous().team_report));
        visitor.output(self.additional_outputs.ball_filter.delivered.get(cycle));
        visitor.output(self.additional_outputs.ball_filter.hypotheses.get(cycle));
        visitor.output(self.additional_outputs.ball_filter.persistent_ball.get(cycle));
        visitor
            .output(
                self
                    .additional_outputs
                    .fall_state_filter
                    .center_of_mass_overhang
                    .get(cycle),
            );
        visitor.output(self.additional_outputs.localization.hypotheses.get(cycle));
        visitor.output(self.additional_outputs.orientation_filter.innovation.get(cycle));
        visitor.output(self.additional_outputs.plan.get(cycle));
        visitor.output(self.additional_outputs.whistle_filter.votes.get(cycle));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.sensor_data_receiver.report());
        visit(self.nodes.button_filter.report());
        visit(self.nodes.sonar_filter.report());
        visit(self.nodes.orientation_filter.report());
        visit(self.nodes.foot_pressure_filter.report());
        visit(self.nodes.ground_contact_filter.report());
        visit(self.nodes.support_foot_filter.report());
        visit(self.nodes.forward_kinematics.report());
        visit(self.nodes.center_of_mass.report());
        visit(self.nodes.fall_state_filter.report());
        visit(self.nodes.odometry.report());
        visit(self.nodes.camera_matrices.report());
        visit(self.nodes.game_controller_filter.report());
        visit(self.nodes.team_message_filter.report());
        visit(self.nodes.whistle_filter.report());
        visit(self.nodes.game_state_filter.report());
        visit(self.nodes.whose_ball_filter.report());
        visit(self.nodes.localization.report());
        visit(self.nodes.ball_filter.report());
        visit(self.nodes.obstacle_filter.report());
        visit(self.nodes.team_ball_filter.report());
        visit(self.nodes.role_assignment.report());
        visit(self.nodes.world_state_composer.report());
        visit(self.nodes.client_wishes.report());
        visit(self.nodes.behavior.report());
        visit(self.nodes.recording_switch.report());
        visit(self.nodes.motion_selector.report());
        visit(self.nodes.motion_dispatcher.report());
        visit(self.nodes.stand.report());
        visit(self.nodes.penalized_pose.report());
        visit(self.nodes.sit_down.report());
        visit(self.nodes.walking_engine.report());
        visit(self.nodes.scripted_motion.report());
        visit(self.nodes.look_around.report());
        visit(self.nodes.look_at.report());
        visit(self.nodes.head_motion.report());
        visit(self.nodes.motor_commands_collector.report());
        visit(self.nodes.led_status.report());
        visit(self.nodes.tone_selector.report());
        visit(self.nodes.tone_player.report());
        visit(self.nodes.self_report.report());
        visit(self.nodes.game_controller_responder.report());
        visit(self.nodes.team_message_sender.report());
        visit(self.nodes.command_sender.report());
    }

    fn queues(&self, visit: &mut dyn FnMut(QueueReport)) {
        visit(QueueReport {
            from: "VisionTop",
            counts: self.perception.vision_top.report(),
        });
        visit(QueueReport {
            from: "VisionBottom",
            counts: self.perception.vision_bottom.report(),
        });
        visit(QueueReport {
            from: "SplNetwork",
            counts: self.perception.spl_network.report(),
        });
        visit(QueueReport {
            from: "Audio",
            counts: self.perception.audio.report(),
        });
    }

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("control::sensor_data_receiver", &mut self.nodes.sensor_data_receiver);
        visit("control::button_filter", &mut self.nodes.button_filter);
        visit("control::sonar_filter", &mut self.nodes.sonar_filter);
        visit("control::orientation_filter", &mut self.nodes.orientation_filter);
        visit("control::foot_pressure_filter", &mut self.nodes.foot_pressure_filter);
        visit("control::ground_contact_filter", &mut self.nodes.ground_contact_filter);
        visit("control::support_foot_filter", &mut self.nodes.support_foot_filter);
        visit("control::forward_kinematics", &mut self.nodes.forward_kinematics);
        visit("control::center_of_mass", &mut self.nodes.center_of_mass);
        visit("control::fall_state_filter", &mut self.nodes.fall_state_filter);
        visit("control::odometry", &mut self.nodes.odometry);
        visit("control::camera_matrices", &mut self.nodes.camera_matrices);
        visit("control::game_controller_filter", &mut self.nodes.game_controller_filter);
        visit("control::team_message_filter", &mut self.nodes.team_message_filter);
        visit("control::whistle_filter", &mut self.nodes.whistle_filter);
        visit("control::game_state_filter", &mut self.nodes.game_state_filter);
        visit("control::whose_ball_filter", &mut self.nodes.whose_ball_filter);
        visit("control::localization", &mut self.nodes.localization);
        visit("control::ball_filter", &mut self.nodes.ball_filter);
        visit("control::obstacle_filter", &mut self.nodes.obstacle_filter);
        visit("control::team_ball_filter", &mut self.nodes.team_ball_filter);
        visit("control::role_assignment", &mut self.nodes.role_assignment);
        visit("control::world_state_composer", &mut self.nodes.world_state_composer);
        visit("control::client_wishes", &mut self.nodes.client_wishes);
        visit("control::behavior", &mut self.nodes.behavior);
        visit("control::recording_switch", &mut self.nodes.recording_switch);
        visit("control::motion_selector", &mut self.nodes.motion_selector);
        visit("control::motion_dispatcher", &mut self.nodes.motion_dispatcher);
        visit("control::stand", &mut self.nodes.stand);
        visit("control::penalized_pose", &mut self.nodes.penalized_pose);
        visit("control::sit_down", &mut self.nodes.sit_down);
        visit("control::walking_engine", &mut self.nodes.walking_engine);
        visit("control::scripted_motion", &mut self.nodes.scripted_motion);
        visit("control::look_around", &mut self.nodes.look_around);
        visit("control::look_at", &mut self.nodes.look_at);
        visit("control::head_motion", &mut self.nodes.head_motion);
        visit(
            "control::motor_commands_collector",
            &mut self.nodes.motor_commands_collector,
        );
        visit("control::led_status", &mut self.nodes.led_status);
        visit("control::tone_selector", &mut self.nodes.tone_selector);
        visit("control::tone_player", &mut self.nodes.tone_player);
        visit("control::self_report", &mut self.nodes.self_report);
        visit(
            "control::game_controller_responder",
            &mut self.nodes.game_controller_responder,
        );
        visit("control::team_message_sender", &mut self.nodes.team_message_sender);
        visit("control::command_sender", &mut self.nodes.command_sender);
        visit("cycler_state", &mut self.cycler_state);
    }
}
