//! Frames of a recording by instance and cycle, in any order.

use hulkgen_mcap::layout::Part;
use hulkgen_recording::Writing;

use super::carry::composed;
use super::{Frame, Needed, OtherParameters, Ran, Replay, Replayable, Setup, Shelf, types};
use crate::cycler::Instance;
use crate::error::{Error, Result};
use crate::recorded::{Loading, SaveError, Saving};

/// For what the first cycle leaves behind, in bytes; twice as many until it has room.
const ROOM: usize = 1 << 10;

/// All instances of a recording that this robot can replay.
pub struct Players<'r> {
    chunks: Chunks<'r>,
    /// In manifest order.
    pub players: Vec<Player<'r>>,
    /// Instances of the recording that this robot does not have, or cannot replay.
    pub unknown: Vec<String>,
}

/// Where players take their frames from.
#[derive(Clone, Copy, Debug)]
pub struct Chunks<'r> {
    pub(super) shelf: &'r Shelf,
    /// In place of the parameters that were recorded.
    other: Option<&'r OtherParameters>,
}

/// One instance and its recorded cycles.
pub struct Player<'r> {
    pub instance: &'static str,
    /// In the order of the file.
    pub frames: &'r [Frame],
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

impl<'r> Players<'r> {
    /// Of a recording.
    ///
    /// # Errors
    /// If a frame cannot be understood.
    pub fn new(recording: &'r Shelf, replayables: &[Replayable]) -> Result<Self> {
        let players = replayables.iter().map(|one| Player::new(*one, recording));
        let topics = recording.index().topics.values();
        let is_known = |name: &&String| replayables.iter().any(|one| one.instance == **name);
        Ok(Self {
            chunks: Chunks {
                shelf: recording,
                other: None,
            },
            players: players.collect::<Result<_>>()?,
            unknown: topics.filter(|name| !is_known(name)).cloned().collect(),
        })
    }

    /// The same, with other values in place of the parameters that were recorded.
    pub fn under(mut self, other: &'r OtherParameters) -> Self {
        self.chunks.other = Some(other);
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
    pub fn find(&mut self, instance: &str) -> Result<(&mut Player<'r>, Chunks<'r>)> {
        let names: Vec<_> = self.players.iter().map(|one| one.instance).collect();
        self.of(instance).ok_or_else(|| {
            Error::new(format!(
                "the robot has no instance `{instance}`: the instances are `{}`",
                names.join("`, `")
            ))
        })
    }

    /// Where they take their frames from.
    pub(super) fn chunks(&self) -> Chunks<'r> {
        self.chunks
    }

    /// All cycles, those of one chunk after each other, by the place among the players and the position.
    pub(super) fn in_file_order(&self) -> Vec<(usize, usize)> {
        let players = self.players.iter().enumerate();
        let cycles = players.flat_map(|(index, player)| {
            let positions = 0..player.frames.len();
            positions.map(move |position| (index, position))
        });
        let mut cycles: Vec<_> = cycles.collect();
        cycles.sort_by_key(|(index, position)| self.players[*index].chunk_of(*position));
        cycles
    }

    /// The player of an instance, with the values that it needs.
    pub fn of(&mut self, instance: &str) -> Option<(&mut Player<'r>, Chunks<'r>)> {
        let mut players = self.players.iter_mut();
        let player = players.find(|player| player.instance == instance)?;
        Some((player, self.chunks))
    }

    /// All of them.
    pub fn each(&mut self) -> impl Iterator<Item = (&mut Player<'r>, Chunks<'r>)> {
        let chunks = self.chunks;
        self.players.iter_mut().map(move |player| (player, chunks))
    }
}

impl Chunks<'_> {
    /// What an instance wrote in a cycle, as a chunk has it.
    pub(super) fn bytes(
        &self,
        number: usize,
        instance: &str,
        cycle: u64,
    ) -> Result<Option<Vec<u8>>> {
        let chunk = self.shelf.chunk(number)?;
        let stored = self.shelf.stored(number, &chunk, self.other);
        Ok(stored.bytes(instance, cycle).map(<[u8]>::to_vec))
    }
}

impl<'r> Player<'r> {
    fn new(replayable: Replayable, recording: &'r Shelf) -> Result<Self> {
        let recorded = recording.index().of(replayable.instance);
        if let Some(damaged) = recorded.and_then(|recorded| recorded.damaged.as_ref()) {
            return Err(Error::new(damaged));
        }
        Ok(Self {
            instance: replayable.instance,
            frames: recorded.map_or(&[], |recorded| &recorded.frames),
            is_known: recorded.is_some(),
            nodes: None,
            replayable,
            replay: None,
            other_types: types::difference(recording.contents(), &replayable),
            loaded: None,
            carrying: None,
        })
    }

    /// Digests of a cycle in the order in which the outputs were written; `None`: it was not finished.
    ///
    /// # Errors
    /// If its chunk can no longer be read.
    pub fn digests(&self, position: usize, chunks: Chunks<'_>) -> Result<Option<Vec<u64>>> {
        let Some(end) = self.frames[position].end else {
            return Ok(None);
        };
        let chunk = chunks.shelf.chunk(end.chunk())?;
        let (whole, _) = end.part(&chunk)?.as_chunks();
        Ok(Some(
            whole.iter().copied().map(u64::from_le_bytes).collect(),
        ))
    }

    /// Runs the cycle at this position again, whichever ran before.
    ///
    /// # Errors
    /// If its frame, or one that it needs, does not fit this robot.
    pub fn play(&mut self, position: usize, chunks: Chunks<'_>) -> Result<Ran> {
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
    fn carry_to(&mut self, position: usize, chunks: Chunks<'_>) -> Result<bool> {
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
        let number = frame.content.chunk();
        let chunk = chunks.shelf.chunk(number)?;
        let recorded = frame.content.part(&chunk)?;
        let content = composed(&carrying.parts, &carrying.setup, recorded, &left)?;
        let stored = chunks.shelf.stored(number, &chunk, chunks.other);
        replay.load(frame.head, &mut Loading::new(&content), &stored)?;
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
    pub fn load_at(&mut self, position: usize, chunks: Chunks<'_>) -> Result<()> {
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
    pub(super) fn parameters_version(&self, position: usize) -> Option<u64> {
        self.frames[position].version
    }

    /// The chunk in which the frame at this position stands.
    pub(super) fn chunk_of(&self, position: usize) -> usize {
        self.frames[position].content.chunk()
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

    fn load(&mut self, at: usize, chunks: Chunks<'_>) -> Result<()> {
        if let Some(difference) = &self.other_types {
            return Err(Error::new(format!(
                "the recording is of other types: {difference}"
            )));
        }
        // Until it is there, nothing can go on from it.
        self.loaded = None;
        let Frame {
            head,
            content: place,
            ..
        } = self.frames[at];
        let number = place.chunk();
        let chunk = chunks.shelf.chunk(number)?;
        let stored = chunks.shelf.stored(number, &chunk, chunks.other);
        let mut content = Loading::new(place.part(&chunk)?);
        let mut states = content;
        let replay = match &mut self.replay {
            Some(replay) => replay,
            none => none.insert((self.replayable.create)(&mut states, &stored)?),
        };
        replay.load(head, &mut content, &stored)?;
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
