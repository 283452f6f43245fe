//! Frames of a recording by instance and cycle, in any order.

use std::collections::BTreeMap;

use hulkgen_mcap::layout::Part;
use hulkgen_recording::{Recording, Writing};

use super::carry::composed;
use super::{Needed, OtherParameters, Ran, Replay, Replayable, Setup, types};
use crate::cycler::Instance;
use crate::error::{Error, Result};
use crate::recorded::{
    BEGUN, FINISHED, FRAMES, Head, Loading, SaveError, Saving, Stored, VALUES, VERSION,
};

/// For what the first cycle leaves behind, in bytes; twice as many until it has room.
const ROOM: usize = 1 << 10;

/// All instances of a recording that this robot can replay.
pub struct Players<'r> {
    chunks: Vec<Stored<'r>>,
    /// In manifest order.
    pub players: Vec<Player<'r>>,
    /// Instances of the recording that this robot does not have, or cannot replay.
    pub unknown: Vec<String>,
}

/// One instance and its recorded cycles.
pub struct Player<'r> {
    pub instance: &'static str,
    /// In the order of the file.
    pub frames: Vec<Frame<'r>>,
    /// Whether the recording has a channel for its frames.
    pub is_known: bool,
    /// The only nodes that run; `None`: all.
    nodes: Option<Vec<String>>,
    replayable: Replayable,
    replay: Option<Box<dyn Replay>>,
    /// What is of another type than it was when the recording was made.
    other_types: Option<String>,
    /// Position of the frame that was loaded last.
    loaded: Option<usize>,
    carrying: Option<Carrying>,
}

/// That cycles go on with what the cycle before left behind.
struct Carrying {
    setup: Setup,
    parts: Vec<Part>,
    /// By the last cycle that ran, for the frame at this position.
    left: Option<(usize, Vec<u8>)>,
    /// So many bytes had room for it.
    room: usize,
    /// Cycles that went on so.
    cycles: u64,
}

/// One recorded cycle.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'r> {
    pub head: Head,
    /// Digests of what it wrote; `None`: it was not finished.
    end: Option<&'r [u8]>,
    chunk: usize,
    content: Loading<'r>,
}

impl<'r> Frame<'r> {
    /// Digests in the order in which the outputs were written; `None`: the cycle was not finished.
    pub fn digests(&self) -> Option<impl Iterator<Item = u64> + use<'r>> {
        let (whole, _) = self.end?.as_chunks();
        Some(whole.iter().copied().map(u64::from_le_bytes))
    }
}

/// Channels of a recording.
struct Topics {
    /// Instance by channel.
    frames: BTreeMap<u16, String>,
    values: Vec<(String, u16)>,
}

/// Names and numbers of the channels that hold values.
pub type ValueChannels = Vec<(String, u16)>;

/// Channels of values of a recording, which [`Players::new`] needs to live longer than itself.
///
/// # Errors
/// If the recording was made by another version.
pub fn value_channels(recording: &Recording) -> Result<ValueChannels> {
    topics(recording).map(|topics| topics.values)
}

fn topics(recording: &Recording) -> Result<Topics> {
    let mut topics = Topics {
        frames: BTreeMap::new(),
        values: Vec::new(),
    };
    for (number, channel) in &recording.channels {
        if ![FRAMES, VALUES].contains(&&*channel.encoding) {
            continue;
        }
        let mut metadata = channel.metadata.iter();
        let version = metadata.find(|(key, _)| key == "version");
        let version = version.map_or("", |(_, version)| version);
        if version != VERSION.to_string() {
            return Err(Error::new(format!(
                "the recording is of version `{version}`, this robot reads version {VERSION}"
            )));
        }
        match channel.topic.split_once('/') {
            Some(("frames", instance)) => {
                topics.frames.insert(*number, instance.to_owned());
            }
            Some(("values", instance)) => topics.values.push((instance.to_owned(), *number)),
            _ => {}
        }
    }
    Ok(topics)
}

impl<'r> Players<'r> {
    /// Of a recording whose values lie in these channels.
    ///
    /// # Errors
    /// If a frame cannot be understood.
    pub fn new(
        recording: &'r Recording,
        values: &'r ValueChannels,
        replayables: &[Replayable],
    ) -> Result<Self> {
        let topics = topics(recording)?;
        let players = replayables.iter().map(|one| Player {
            other_types: types::difference(recording, one),
            ..Player::new(*one)
        });
        let mut players: Vec<_> = players.collect();
        let mut chunks = Vec::new();
        for (index, chunk) in recording.chunks.iter().enumerate() {
            let mut stored = Stored::new(values);
            for message in chunk.messages() {
                let Some(instance) = topics.frames.get(&message.channel) else {
                    stored.add(message.channel, message.sequence, message.data);
                    continue;
                };
                if let Some(player) = players.iter_mut().find(|one| one.instance == instance) {
                    player.add(index, message.sequence, message.data)?;
                }
            }
            chunks.push(stored);
        }
        for player in &mut players {
            let mut recorded = topics.frames.values();
            player.is_known = recorded.any(|name| name == player.instance);
        }
        let is_known = |name: &String| replayables.iter().any(|one| one.instance == name);
        let unknown = topics.frames.into_values().filter(|name| !is_known(name));
        Ok(Self {
            chunks,
            players,
            unknown: unknown.collect(),
        })
    }

    /// The same, with other values in place of the parameters that were recorded.
    pub fn under(mut self, other: &'r OtherParameters) -> Self {
        for (chunk, channel, version, bytes) in other.all() {
            self.chunks[chunk].add(channel, version, bytes);
        }
        self
    }

    /// The same, without what this node does not need: instances that do not run it, and nodes that come after it.
    pub fn only(mut self, needed: &Needed) -> Self {
        self.players.retain_mut(|player| {
            player.nodes = needed.of(player.instance).map(<[String]>::to_vec);
            player.nodes.is_some()
        });
        self
    }

    /// The same, with all nodes, where each cycle goes on with what the one before it left behind: states, what nodes share,
    /// previous outputs and histories. What setup nodes left, other instances wrote and clients did is as it was recorded.
    ///
    /// # Errors
    /// If this is not the graph of the robot.
    pub fn carrying(mut self, graph: &str) -> Result<Self> {
        for player in &mut self.players {
            player.nodes = None;
            player.carrying = Some(Carrying {
                setup: Setup::of(player.instance, graph)?,
                parts: (player.replayable.types)().parts,
                left: None,
                room: ROOM,
                cycles: 0,
            });
        }
        Ok(self)
    }

    /// As [`Self::of`].
    ///
    /// # Errors
    /// If there is no such instance.
    pub fn find(&mut self, instance: &str) -> Result<(&mut Player<'r>, &[Stored<'r>])> {
        let names: Vec<_> = self.players.iter().map(|one| one.instance).collect();
        self.of(instance).ok_or_else(|| {
            Error::new(format!(
                "the robot has no instance `{instance}`: the instances are `{}`",
                names.join("`, `")
            ))
        })
    }

    /// What an instance wrote in a cycle, as a chunk has it.
    pub(super) fn bytes(&self, chunk: usize, instance: &str, cycle: u64) -> Option<&'r [u8]> {
        self.chunks.get(chunk)?.bytes(instance, cycle)
    }

    /// The player of an instance, with the values that it needs.
    pub fn of(&mut self, instance: &str) -> Option<(&mut Player<'r>, &[Stored<'r>])> {
        let mut players = self.players.iter_mut();
        let player = players.find(|player| player.instance == instance)?;
        Some((player, &self.chunks))
    }

    /// All of them.
    pub fn each(&mut self) -> impl Iterator<Item = (&mut Player<'r>, &[Stored<'r>])> {
        self.players
            .iter_mut()
            .map(|player| (player, &*self.chunks))
    }
}

impl<'r> Player<'r> {
    fn new(replayable: Replayable) -> Self {
        Self {
            instance: replayable.instance,
            frames: Vec::new(),
            is_known: false,
            nodes: None,
            replayable,
            replay: None,
            other_types: None,
            loaded: None,
            carrying: None,
        }
    }

    fn add(&mut self, chunk: usize, sequence: u32, data: &'r [u8]) -> Result<()> {
        let damaged = || Error::new(format!("a frame of `{}` is damaged", self.instance));
        let (kind, content) = data.split_first().ok_or_else(damaged)?;
        match *kind {
            BEGUN => {
                let mut content = Loading::new(content);
                let head: Head = content.take()?;
                self.frames.push(Frame {
                    head,
                    end: None,
                    chunk,
                    content,
                });
                Ok(())
            }
            FINISHED => {
                // It may stand alone in a chunk, and the one before, where its beginning stood, may be gone.
                let begun = self.frames.last_mut();
                if let Some(begun) = begun.filter(|frame| frame.head.number as u32 == sequence) {
                    begun.end = Some(content);
                }
                Ok(())
            }
            _ => Err(damaged()),
        }
    }

    /// Runs the cycle at this position again, whichever ran before.
    ///
    /// # Errors
    /// If its frame, or one that it needs, does not fit this robot.
    pub fn play(&mut self, position: usize, chunks: &[Stored<'_>]) -> Result<Ran> {
        if !self.carry_to(position, chunks)? {
            self.load_at(position, chunks)?;
        }
        let Some(replay) = self.replay.as_mut() else {
            return Ok(Ran::NeedsHardware);
        };
        let ran = replay.run(self.nodes.as_deref());
        if let Some(carrying) = &mut self.carrying {
            carrying.left = match ran {
                Ran::Finished => {
                    let left = left_behind(replay.instance_mut(), &mut carrying.room)?;
                    Some((position + 1, left))
                }
                // Nobody knows what it would have left.
                Ran::NeedsHardware | Ran::Failed(_) => None,
            };
        }
        Ok(ran)
    }

    /// Makes the cycle at this position the one that has just begun, with what the one before it left behind, if that is
    /// wanted and the one before it is the one that ran last; gives whether.
    fn carry_to(&mut self, position: usize, chunks: &[Stored<'_>]) -> Result<bool> {
        let Some(carrying) = &mut self.carrying else {
            return Ok(false);
        };
        let left = carrying.left.take().filter(|(at, _)| *at == position);
        let (Some((_, left)), Some(replay)) = (left, &mut self.replay) else {
            return Ok(false);
        };
        let (before, frame) = (self.frames[position - 1], self.frames[position]);
        if frame.head.restarted || before.head.number + 1 != frame.head.number {
            return Ok(false);
        }
        self.loaded = None;
        let content = composed(
            &carrying.parts,
            &carrying.setup,
            frame.content.rest(),
            &left,
        )?;
        replay.load(
            frame.head,
            &mut Loading::new(&content),
            &chunks[frame.chunk],
        )?;
        carrying.cycles += 1;
        Ok(true)
    }

    /// How many cycles went on with what the one before them left behind; `None`: that was not wanted.
    pub fn carried(&self) -> Option<u64> {
        self.carrying.as_ref().map(|carrying| carrying.cycles)
    }

    /// Makes the cycle at this position the one that has just begun.
    ///
    /// # Errors
    /// As [`Self::play`].
    pub fn load_at(&mut self, position: usize, chunks: &[Stored<'_>]) -> Result<()> {
        let whole = (0..=position)
            .rev()
            .find(|at| self.frames[*at].head.whole)
            .ok_or_else(|| Error::new("the frame that it goes on from is missing"))?;
        // What was loaded before may lead here, too.
        let first = match self.loaded {
            Some(loaded) if loaded >= whole && loaded < position => loaded + 1,
            _ => whole,
        };
        for at in first..=position {
            self.load(at, chunks)?;
        }
        Ok(())
    }

    /// The version of the parameters that a frame begins with, of an instance that reads any.
    pub(super) fn parameters_version(&self, position: usize) -> Result<u64> {
        let mut content = self.frames[position].content;
        content.take()
    }

    /// The chunk in which the frame at this position stands.
    pub(super) fn chunk_of(&self, position: usize) -> usize {
        self.frames[position].chunk
    }

    /// The instance, which has a frame.
    pub(super) fn replay_mut(&mut self) -> Result<&mut (dyn Replay + 'static)> {
        let replay = self.replay.as_deref_mut();
        replay.ok_or_else(|| Error::new(format!("no frame of `{}` was loaded", self.instance)))
    }

    /// Whether this node is run.
    pub fn runs(&self, node: &str) -> bool {
        let mut nodes = self.nodes.iter();
        nodes.all(|nodes| nodes.iter().any(|one| one == node))
    }

    fn load(&mut self, at: usize, chunks: &[Stored<'_>]) -> Result<()> {
        if let Some(difference) = &self.other_types {
            return Err(Error::new(format!(
                "the recording is of other types: {difference}"
            )));
        }
        // Until it is there, nothing can go on from it.
        self.loaded = None;
        let Frame {
            head,
            chunk,
            mut content,
            ..
        } = self.frames[at];
        let mut states = content;
        let replay = match &mut self.replay {
            Some(replay) => replay,
            none => none.insert((self.replayable.create)(&mut states, &chunks[chunk])?),
        };
        replay.load(head, &mut content, &chunks[chunk])?;
        if !content.is_empty() {
            return Err(Error::new(
                "the frame has more than this robot takes: the recording is of another robot, or of another version of it",
            ));
        }
        self.loaded = Some(at);
        Ok(())
    }

    /// The instance, once a frame was loaded.
    pub fn replay(&self) -> Option<&dyn Replay> {
        self.replay.as_deref()
    }
}

/// What a next cycle would find, as the content of a frame that needs none before it.
fn left_behind(instance: &mut dyn Instance, room: &mut usize) -> Result<Vec<u8>> {
    loop {
        let mut bytes = vec![0; *room];
        let mut writing = Writing::new(&mut bytes);
        let mut saving = Saving::new(&mut writing);
        instance.save_alone(None, &mut saving);
        match saving.end() {
            Err(SaveError::Full) => *room *= 2,
            saved => {
                saved.map_err(|error| Error::new(error.to_string()))?;
                let length = writing.length();
                bytes.truncate(length);
                return Ok(bytes);
            }
        }
    }
}
