//! What a communication server holds of a running robot: everything it may see and change, and nothing that a cycle waits for.

use std::sync::Arc;

use crate::clock::Clock;
use crate::cycler::{Counters, InstanceDescription};
use crate::parameters::Live;
use crate::rearm::Rearm;
use crate::recorded::Counts;
use crate::remote::Feed;
use crate::robot::{Access, Robot};
use crate::stop::Stop;
use crate::tap::{Reports, Tap};
use crate::world::Named;

/// A running robot, for its clients. Dropping it closes all taps.
pub struct Link {
    /// As in the manifest.
    pub robot: &'static str,
    /// The clock of the robot.
    pub clock: Clock,
    /// Requested when the robot ends.
    pub stop: Stop,
    /// Gives the nodes the actuators back after a safe state that lasts.
    pub rearm: Rearm,
    /// Beside those of nodes, as `framework.procedures.NAME`: what a simulated world answers.
    pub procedures: Vec<Named>,
    /// Read, change, store, reload.
    pub parameters: Live,
    /// In manifest order.
    pub instances: Vec<InstanceLink>,
    /// Instances that other machines run, in manifest order.
    pub remotes: Vec<Box<dyn Feed>>,
    /// What became of the frames of a recording, as [`Recording::shared_counts`](crate::recorded::Recording::shared_counts)
    /// tells it; empty where nothing is recorded.
    pub recorded: Vec<(String, Arc<Counts>)>,
}

/// One instance, for clients.
pub struct InstanceLink {
    /// What the manifest says about it.
    pub description: InstanceDescription,
    /// Paths of its nodes, in manifest order.
    pub nodes: Vec<&'static str>,
    /// Its counts, to be read while it runs.
    pub counters: Arc<Counters>,
    /// Its main outputs, then its additional outputs.
    pub taps: Vec<Tap>,
    /// What it did so far.
    pub reports: Reports,
    /// Replaces outputs, calls procedures.
    pub access: Access,
}

impl<P> Robot<P> {
    /// What a server needs of this robot, before a driver turns it. [`Robot::access`] and [`Robot::remotes`] are
    /// empty afterwards: there is one server.
    pub fn link(&mut self, stop: &Stop, rearm: Rearm) -> Link {
        let access = std::mem::take(&mut self.access);
        let instances = self.instances.iter_mut().zip(access);
        let instances = instances.map(|(instance, access)| {
            let (taps, reports) = instance.tap(&access.subscriptions);
            InstanceLink {
                description: *instance.description(),
                nodes: instance
                    .report()
                    .nodes
                    .iter()
                    .map(|node| node.node)
                    .collect(),
                counters: instance.counters().clone(),
                taps,
                reports,
                access,
            }
        });
        Link {
            robot: self.name,
            clock: self.clock.clone(),
            stop: stop.clone(),
            rearm,
            procedures: Vec::new(),
            parameters: self.parameters.live(),
            instances: instances.collect(),
            remotes: std::mem::take(&mut self.remotes),
            recorded: Vec::new(),
        }
    }
}
