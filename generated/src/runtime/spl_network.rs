//! Cycler `SplNetwork` between its buffers and its nodes.
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
use hardware::NetworkInterface;

use crate::cyclers::spl_network::Nodes;
use crate::databases::spl_network::AdditionalOutputs;
use crate::databases::spl_network::Creation;
use crate::databases::spl_network::Frame;
use crate::databases::spl_network::Injections;
use crate::databases::spl_network::OwnOutputs;
use crate::databases::spl_network::SharedOutputs;
use crate::databases::spl_network::Subscribed;
use crate::parameters::Parameters;

/// What the manifest says about `SplNetwork`.
pub const SPL_NETWORK: InstanceDescription = InstanceDescription {
    name: "SplNetwork",
    cycler: "SplNetwork",
    kind: Kind::Perception,
    on_failure: OnFailure::Restart,
    deadline: Some(Duration::from_millis(20)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(1),
    lockstep_duration: None,
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// What clients can listen to, in the order of `Subscribed`.
pub const ADDITIONAL_OUTPUTS: &[&str] = &[
    "game_controller_parser.refusal",
    "team_message_parser.refusal",
];

/// One instance: its nodes, and its ends of all buffers.
pub struct SplNetwork<Hardware> {
    pub nodes: Nodes,
    pub additional_outputs: AdditionalOutputs,
    pub capture_time: Option<Timestamp>,
    pub hardware_interface: Arc<Hardware>,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
    pub subscribed: Subscribed,
    pub subscriptions: Subscriptions,
}

impl<Hardware> SplNetwork<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(
        &'a mut self,
        slots: Slots<'a, SharedOutputs>,
        cycle: Cycle,
    ) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let parameters = self.parameters.view().value();
        let frame = Frame {
            additional_outputs: &mut self.additional_outputs,
            capture_time: &mut self.capture_time,
            cycle,
            hardware_interface: &self.hardware_interface,
            injections: self.injections.view().value().get(),
            own: self.own.both().0,
            parameters,
            shared: slots.current,
            subscribed: self.subscribed,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: NetworkInterface + Send + Sync> Body for SplNetwork<Hardware> {
    type Shared = SharedOutputs;

    fn create(&mut self) -> Result<()> {
        self.parameters.take();
        let parameters = self.parameters.view().value();
        let mut creation = Creation {
            hardware_interface: &self.hardware_interface,
            parameters,
        };
        self.nodes = Nodes::new(&mut creation)?;
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
        if self.subscriptions.changed() {
            let mut wanted = self.subscriptions.wanted();
            self.subscribed = Subscribed {
                game_controller_parser_refusal: wanted.next_one(),
                team_message_parser_refusal: wanted.next_one(),
            };
        }
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

    fn finish(&mut self, _shared: &SharedOutputs, _cycle: Cycle) {
        self.own.swap();
    }

    fn abandon(&mut self) {}

    fn restore(&mut self) -> Result<()> {
        // The states of all nodes are whole.
        Ok(())
    }

    fn references(&self, visit: &mut dyn FnMut(Reference)) {
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &[
            "datagram",
            "game_controller_counts",
            "game_controller_packet",
            "team_message",
            "team_message_counts",
        ]
    }

    fn main_output<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "datagram" => Some(&self.own.previous().datagram),
            "game_controller_counts" => Some(&self.own.previous().game_controller_counts),
            "game_controller_packet" => Some(&shared.game_controller_packet),
            "team_message" => Some(&shared.team_message),
            "team_message_counts" => Some(&self.own.previous().team_message_counts),
            _ => None,
        }
    }

    fn additional_output(&self, name: &str, cycle: u64) -> Option<&dyn Reflect> {
        match name {
            "game_controller_parser.refusal" => {
                Some(self.additional_outputs.game_controller_parser.refusal.get(cycle)?)
            }
            "team_message_parser.refusal" => {
                Some(self.additional_outputs.team_message_parser.refusal.get(cycle)?)
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
        visitor.output(Some(&self.own.previous().datagram));
        visitor.output(Some(&self.own.previous().game_controller_counts));
        visitor.output(Some(&shared.game_controller_packet));
        visitor.output(Some(&shared.team_message));
        visitor.output(Some(&self.own.previous().team_message_counts));
        visitor
            .output(self.additional_outputs.game_controller_parser.refusal.get(cycle));
        visitor.output(self.additional_outputs.team_message_parser.refusal.get(cycle));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.message_receiver.report());
        visit(self.nodes.game_controller_parser.report());
        visit(self.nodes.team_message_parser.report());
    }

    fn queues(&self, _visit: &mut dyn FnMut(QueueReport)) {}

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("spl_network::message_receiver", &mut self.nodes.message_receiver);
        visit(
            "spl_network::game_controller_parser",
            &mut self.nodes.game_controller_parser,
        );
        visit("spl_network::team_message_parser", &mut self.nodes.team_message_parser);
    }
}
