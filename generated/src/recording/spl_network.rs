//! Cycler `SplNetwork` in a recording: what its cycles take, saved and given back.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Clock;
use framework::Cycler;
use framework::Guarded;
use framework::Injected;
use framework::OnFailure;
use framework::Result;
use framework::Slots;
use framework::Subscriptions;
use framework::Swap;
use framework::Timestamp;
use framework::Writer;
use framework::buffer;
use framework::buffer_of;
use framework::recorded::Describing;
use framework::recorded::Digests;
use framework::recorded::Loaded;
use framework::recorded::Loading;
use framework::recorded::Recorded;
use framework::recorded::SaveError;
use framework::recorded::Saving;
use framework::recorded::Stored;
use framework::recorded::Values;
use framework::replay::Alone;
use framework::replay::Replay;
use hardware::NetworkInterface;

use crate::cyclers::spl_network::Nodes;
use crate::databases::spl_network::AdditionalOutputs;
use crate::databases::spl_network::Injections;
use crate::databases::spl_network::SharedOutputs;
use crate::databases::spl_network::Subscribed;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::spl_network::ADDITIONAL_OUTPUTS;
use crate::runtime::spl_network::SPL_NETWORK;
use crate::runtime::spl_network::SplNetwork;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
}

impl<Hardware: NetworkInterface + Send + Sync> Recorded for SplNetwork<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("spl_network::game_controller_parser", "game_controller_counts"),
        ("spl_network::game_controller_parser", "game_controller_packet"),
        ("spl_network::team_message_parser", "team_message"),
        ("spl_network::team_message_parser", "team_message_counts"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        Ok(())
    }

    fn save(
        &self,
        _cycle: u64,
        _slots: Slots<'_, SharedOutputs>,
        _since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.parameters.save_version(out);
        self.nodes.message_receiver.record(out);
        self.nodes.game_controller_parser.record(out);
        self.nodes.team_message_parser.record(out);
        self.injections.save_injected(out);
        out.output(&self.own.current().datagram);
        out.put(&self.subscribed);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("spl_network::message_receiver", |body| &body.nodes.message_receiver);
        types
            .node(
                "spl_network::game_controller_parser",
                |body| &body.nodes.game_controller_parser,
            );
        types
            .node(
                "spl_network::team_message_parser",
                |body| &body.nodes.team_message_parser,
            );
        types.injections(|body| &body.injections);
        types.output("datagram", |body| &body.own.current().datagram);
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
        self.injections.load_injected(from, &mut outside.injections)?;
        self.own.both_to_load().0.datagram = from.take()?;
        let recorded: Subscribed = from.take()?;
        let mut wanted = self.subscriptions.wanted();
        self.subscribed = Subscribed {
            game_controller_parser_refusal: wanted.next_one()
                || recorded.game_controller_parser_refusal,
            team_message_parser_refusal: wanted.next_one()
                || recorded.team_message_parser_refusal,
        };
        Ok(())
    }

    fn digests(&self, shared: &SharedOutputs, digests: &mut Digests<'_, '_>) {
        digests.add(&self.own.previous().game_controller_counts);
        digests.add(&shared.game_controller_packet);
        digests.add(&shared.team_message);
        digests.add(&self.own.previous().team_message_counts);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        message_receiver: Guarded::recorded(
            "spl_network::message_receiver",
            OnFailure::Restart,
            from,
        )?,
        game_controller_parser: Guarded::recorded(
            "spl_network::game_controller_parser",
            OnFailure::Restart,
            from,
        )?,
        team_message_parser: Guarded::recorded(
            "spl_network::team_message_parser",
            OnFailure::Restart,
            from,
        )?,
    })
}

/// `SplNetwork` alone, with the nodes of the frame that is loaded first.
pub fn replay_spl_network(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_spl_network], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [spl_network_injected], []) = buffer([]);
    let spl_network_subscriptions = Subscriptions::new(ADDITIONAL_OUTPUTS);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        SPL_NETWORK,
        SplNetwork {
            nodes: load_nodes(from)?,
            additional_outputs: AdditionalOutputs::default(),
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: spl_network_injected,
            own: Swap::default(),
            parameters: parameters_for_spl_network,
            subscribed: Subscribed::default(),
            subscriptions: spl_network_subscriptions.clone(),
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
                },
                spl_network_subscriptions,
            ),
        ),
    )
}
