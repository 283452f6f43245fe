//! What one node took and wrote in one recorded cycle, for a test of it.

use serde_json::{Map, Value, json};

use super::{Needed, Players, Ran, Replay, as_json, listen, noted};
use crate::cycler::{Reference, ReferenceKind};
use crate::digest::Digest;
use crate::error::{Error, Result};
use crate::guarded::State;

/// Version of what [`snapshot`] gives; that of version 1 said nothing of the state after the call.
pub const SNAPSHOT_VERSION: u32 = 3;

/// Which call of a node.
#[derive(Clone, Copy, Debug)]
pub struct Call<'a> {
    pub instance: &'a str,
    pub cycle: u64,
    /// In its instances, all that runs before it.
    pub needed: &'a Needed,
}

/// Parameters as they were recorded, as JSON.
pub type ParametersAsJson<'a> = &'a dyn Fn(&[u8]) -> Result<Value>;

/// All that the node could read in a cycle, its state before it and its outputs after it.
///
/// # Errors
/// If the cycle is not in the recording, the node was not called in it, or it failed.
pub fn snapshot(
    players: &mut Players<'_>,
    call: Call<'_>,
    parameters: ParametersAsJson<'_>,
) -> Result<Value> {
    let Call {
        instance,
        cycle,
        needed,
    } = call;
    let nodes = needed.of(instance).ok_or_else(|| {
        let node = &needed.node;
        Error::new(format!("`{node}` is no node of `{instance}`"))
    })?;
    let position = position(players, instance, cycle)?;
    let before = seen_before(players, instance, position)?;

    // Up to the call: its inputs.
    let (_, inputs) = nodes.split_last().unwrap_or((&needed.node, &[]));
    let (player, chunks) = players.find(instance)?;
    player.load_at(position, chunks)?;
    let head = player.frames[position].head;
    let chunk = player.chunk_of(position);
    let replay = player.replay_mut()?;
    let previous = outputs(replay.instance());
    let (state, _) = state_of(replay, &needed.node)?;
    // `restore` sees what nodes share as the cycle found it.
    let cycler_state_at_begin = shared_state(replay);
    let references = references(replay.instance());
    let taken = replay.taken();
    listen();
    finished(replay.run(Some(inputs)))?;
    let commands_before = noted().len();
    let cycler_state = shared_state(replay);
    let own = outputs(replay.instance());

    // And with it: its outputs.
    player.load_at(position, chunks)?;
    listen();
    let written = written(player.replay_mut()?, call, nodes)?;
    let mut commands = noted();
    commands.drain(..commands_before.min(commands.len()));

    let mut others = Vec::new();
    let mut parameters_read = Value::Null;
    for reference in references {
        let name = reference.instance;
        if name == crate::recorded::PARAMETERS {
            // In a replay the buffer of the parameters counts frames.
            let version = players.find(instance)?.0.parameters_version(position);
            let version = version.ok_or_else(|| missing(name))?;
            let bytes = players.chunks().bytes(chunk, name, version)?;
            parameters_read = parameters(&bytes.ok_or_else(|| missing(name))?)?;
        } else if reference.cycle > 0 {
            let is_new = !before.contains(&(name, reference.cycle));
            others.push(other(players, chunk, reference, is_new)?);
        }
    }
    Ok(json!({
        "version": SNAPSHOT_VERSION,
        "node": needed.node,
        "instance": instance,
        "cycle": cycle,
        "start_ns": head.start.as_nanos(),
        "since_last_ns": head.since_last.as_nanos() as u64,
        "state": state,
        "state_after": written.state,
        "cycler_state_at_begin": cycler_state_at_begin,
        "cycler_state": cycler_state,
        "histories": taken.histories,
        "calls": taken.calls,
        "answers": written.answers,
        "commands": commands,
        "parameters": parameters_read,
        "own": own,
        "previous": previous,
        "others": others,
        "outputs": written.outputs,
    }))
}

/// What a node left behind.
struct Written {
    /// Value and digest, by name.
    outputs: Map<String, Value>,
    /// Value and digest.
    state: Value,
    /// By procedure.
    answers: Map<String, Value>,
}

/// Runs the loaded cycle up to and with the node.
fn written(replay: &mut dyn Replay, call: Call<'_>, nodes: &[String]) -> Result<Written> {
    let Call {
        instance,
        cycle,
        needed,
    } = call;
    let (calls, failures) = counted(replay.instance(), &needed.node);
    finished(replay.run(Some(nodes)))?;
    let (calls_after, failures_after) = counted(replay.instance(), &needed.node);
    if calls_after == calls {
        return Err(Error::new(format!(
            "`{}` was not called in cycle {cycle} of `{instance}`: a required input was absent",
            needed.node
        )));
    }
    if failures_after > failures {
        return Err(Error::new(format!(
            "`{}` failed in cycle {cycle} of `{instance}`: name a cycle in which it did not",
            needed.node
        )));
    }
    let mut outputs = Map::new();
    let digested = replay.instance().digests(&mut |node, output, digest| {
        if node == needed.node {
            let value = value_of(replay.instance(), output);
            outputs.insert(output.to_owned(), with_digest(value, digest));
        }
    });
    digested.map_err(|error| Error::new(error.to_string()))?;
    let (state, digest) = state_of(replay, &needed.node)?;
    Ok(Written {
        outputs,
        state: with_digest(state, digest),
        answers: replay.taken().answers,
    })
}

fn with_digest(value: Value, digest: u64) -> Value {
    json!({ "value": value, "digest": format!("{digest:016x}") })
}

fn missing(name: &str) -> Error {
    Error::new(format!(
        "the recording does not have what the cycle read of `{name}`"
    ))
}

fn position(players: &mut Players<'_>, instance: &str, cycle: u64) -> Result<usize> {
    let (player, _) = players.find(instance)?;
    let mut heads = player.frames.iter().map(|frame| frame.head.number);
    if let Some(position) = heads.clone().position(|number| number == cycle) {
        return Ok(position);
    }
    let range = heads
        .next()
        .map(|first| (first, heads.next_back().unwrap_or(first)));
    Err(Error::new(match range {
        Some((first, last)) => format!(
            "cycle {cycle} of `{instance}` is not in the recording, which has cycles {first} to {last}"
        ),
        None => format!("the recording has no cycles of `{instance}`"),
    }))
}

/// What the cycle before this one saw as the newest of each instance.
fn seen_before(
    players: &mut Players<'_>,
    instance: &str,
    position: usize,
) -> Result<Vec<(&'static str, u64)>> {
    let (player, chunks) = players.find(instance)?;
    let number = |at: usize| player.frames[at].head.number;
    if position == 0 || number(position - 1) + 1 != number(position) {
        return Ok(Vec::new());
    }
    player.load_at(position - 1, chunks)?;
    let references = references(player.replay_mut()?.instance());
    let seen = references.into_iter();
    Ok(seen.map(|one| (one.instance, one.cycle)).collect())
}

/// What another instance wrote.
fn other(
    players: &mut Players<'_>,
    chunk: usize,
    reference: Reference,
    is_new: bool,
) -> Result<Value> {
    let name = reference.instance;
    let bytes = players.chunks().bytes(chunk, name, reference.cycle)?;
    let bytes = bytes.ok_or_else(|| missing(name))?;
    let (player, chunks) = players.find(name)?;
    let frame = player
        .frames
        .iter()
        .find(|frame| frame.head.number == reference.cycle);
    let start = frame.map(|frame| frame.head.start).ok_or_else(|| {
        Error::new(format!(
            "cycle {} of `{name}`, which the node reads, was not recorded itself: its time is not known; name a later cycle, or record all of `{name}`",
            reference.cycle
        ))
    })?;
    if player.replay().is_none() {
        player.load_at(0, chunks)?;
    }
    let outputs = player.replay_mut()?.shared(&bytes)?;
    let outputs: Map<String, Value> = outputs.into_iter().collect();
    let (kind, order) = match reference.kind {
        ReferenceKind::Latest => ("latest", None),
        ReferenceKind::Persistent { order } => ("persistent", Some(order.as_nanos())),
        ReferenceKind::Transient { order } => ("transient", Some(order.as_nanos())),
    };
    Ok(json!({
        "instance": name,
        "kind": kind,
        "cycle": reference.cycle,
        "timestamp_ns": start.as_nanos(),
        "order_ns": order,
        "is_new": is_new,
        "outputs": outputs,
    }))
}

fn references(instance: &dyn crate::cycler::Instance) -> Vec<Reference> {
    let mut references = Vec::new();
    instance.references(&mut |reference| references.push(reference));
    references
}

fn finished(ran: Ran) -> Result<()> {
    match ran {
        Ran::Finished => Ok(()),
        Ran::NeedsHardware => Err(Error::new(
            "a node asked the hardware for something in this cycle",
        )),
        Ran::Failed(reason) => Err(Error::new(format!("the cycle fails: {reason}"))),
    }
}

fn outputs(instance: &dyn crate::cycler::Instance) -> Map<String, Value> {
    let names = instance.main_outputs().iter();
    names
        .map(|name| ((*name).to_owned(), value_of(instance, name)))
        .collect()
}

fn value_of(instance: &dyn crate::cycler::Instance, output: &str) -> Value {
    let value = instance.main_output(output);
    let value = value.and_then(|value| as_json(value.as_serialize()));
    value.unwrap_or_default()
}

fn shared_state(replay: &mut dyn Replay) -> Value {
    state_of(replay, "cycler_state").map_or(Value::Null, |(state, _)| state)
}

/// A state and its digest.
fn state_of(replay: &mut dyn Replay, wanted: &str) -> Result<(Value, u64)> {
    let mut found = None;
    replay.instance_mut().states(&mut |name, state| {
        if name == wanted {
            found = Some(saved(state));
        }
    });
    found.unwrap_or_else(|| Err(Error::new(format!("there is no state of `{wanted}`"))))
}

fn saved(state: &dyn State) -> Result<(Value, u64)> {
    let (mut json, mut digest) = (Vec::new(), Digest::new());
    let mut serializer = serde_json::Serializer::new(&mut json);
    state.save(&mut <dyn erased_serde::Serializer>::erase(&mut serializer))?;
    state.save(&mut <dyn erased_serde::Serializer>::erase(&mut digest))?;
    Ok((serde_json::from_slice(&json)?, digest.value()))
}

fn counted(instance: &dyn crate::cycler::Instance, node: &str) -> (u64, u64) {
    let nodes = instance.report().nodes;
    let found = nodes.iter().find(|report| report.node == node);
    found.map_or((0, 0), |report| (report.calls, report.failures))
}
