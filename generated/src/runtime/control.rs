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
use framework::QueueReport;
use framework::Reader;
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
use hardware::SensorInterface;

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
    scheduling: Scheduling {
        policy: None,
        priority: None,
        cores: &[],
    },
};

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

impl<Hardware: ActuatorInterface + SensorInterface + Send + Sync> Body
for Control<Hardware> {
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
                [&mut self.perception.vision_top, &mut self.perception.vision_bottom],
            );
        self.perception
            .vision
            .merge([&self.perception.vision_top, &self.perception.vision_bottom]);
        self.subscribed = Subscribed {
            ball_memory_persistent_ball: self.subscriptions.contains(0),
            foot_pressure_sole_pressures: self.subscriptions.contains(1),
            orientation_filter_innovation: self.subscriptions.contains(2),
        };
        self.procedures.look_at.take();
        let (_, mut frame) = self.frame(slots, cycle);
        Nodes::inject(&mut frame);
    }

    fn run(&mut self, slots: Slots<'_, SharedOutputs>, cycle: Cycle) -> Result<()> {
        let (nodes, mut frame) = self.frame(slots, cycle);
        nodes.cycle(&mut frame)
    }

    fn finish(&mut self, _shared: &SharedOutputs, cycle: Cycle) {
        self.historic
            .orientation
            .push(cycle.time.start, &self.own.current().orientation);
        self.own.swap();
        self.procedures.look_at.close();
    }

    fn abandon(&mut self) {
        self.procedures.look_at.close();
    }

    fn restore(&mut self) -> Result<()> {
        // The states of all nodes are whole.
        Ok(())
    }

    fn references(&self, visit: &mut dyn FnMut(Reference)) {
        self.perception.vision_top.references("VisionTop", visit);
        self.perception.vision_bottom.references("VisionBottom", visit);
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &[
            "sensor_data",
            "orientation",
            "ground_contact",
            "support_side",
            "robot_kinematics",
            "camera_matrices",
            "ball",
            "body_commands",
            "head_command",
            "leds",
            "motor_commands",
        ]
    }

    fn main_output<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "sensor_data" => Some(&self.own.previous().sensor_data),
            "orientation" => Some(&self.own.previous().orientation),
            "ground_contact" => Some(&self.own.previous().ground_contact),
            "support_side" => Some(&self.own.previous().support_side),
            "robot_kinematics" => Some(&self.own.previous().robot_kinematics),
            "camera_matrices" => Some(&shared.camera_matrices),
            "ball" => Some(&self.own.previous().ball),
            "body_commands" => Some(&self.own.previous().body_commands),
            "head_command" => Some(&self.own.previous().head_command),
            "leds" => Some(&self.own.previous().leds),
            "motor_commands" => Some(&self.own.previous().motor_commands),
            _ => None,
        }
    }

    fn additional_output(&self, name: &str, cycle: u64) -> Option<&dyn Reflect> {
        match name {
            "ball_memory.persistent_ball" => {
                Some(self.additional_outputs.ball_memory.persistent_ball.get(cycle)?)
            }
            "foot_pressure.sole_pressures" => {
                Some(self.additional_outputs.foot_pressure.sole_pressures.get(cycle)?)
            }
            "orientation_filter.innovation" => {
                Some(self.additional_outputs.orientation_filter.innovation.get(cycle)?)
            }
            _ => None,
        }
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.sensor_data_receiver.report());
        visit(self.nodes.orientation_filter.report());
        visit(self.nodes.foot_pressure.report());
        visit(self.nodes.forward_kinematics.report());
        visit(self.nodes.camera_matrices.report());
        visit(self.nodes.ball_memory.report());
        visit(self.nodes.ready_pose.report());
        visit(self.nodes.head_scan.report());
        visit(self.nodes.led_status.report());
        visit(self.nodes.motor_commands_collector.report());
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
    }

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("control::sensor_data_receiver", &mut self.nodes.sensor_data_receiver);
        visit("control::orientation_filter", &mut self.nodes.orientation_filter);
        visit("control::foot_pressure", &mut self.nodes.foot_pressure);
        visit("control::forward_kinematics", &mut self.nodes.forward_kinematics);
        visit("control::camera_matrices", &mut self.nodes.camera_matrices);
        visit("control::ball_memory", &mut self.nodes.ball_memory);
        visit("control::ready_pose", &mut self.nodes.ready_pose);
        visit("control::head_scan", &mut self.nodes.head_scan);
        visit("control::led_status", &mut self.nodes.led_status);
        visit(
            "control::motor_commands_collector",
            &mut self.nodes.motor_commands_collector,
        );
        visit("control::command_sender", &mut self.nodes.command_sender);
        visit("cycler_state", &mut self.cycler_state);
    }
}
