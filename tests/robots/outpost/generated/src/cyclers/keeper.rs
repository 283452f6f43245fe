//! Cycler `Keeper` (real-time), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::InNode;
use framework::Interleaved;
use framework::OnFailure;
use framework::PerceptionInput;
use framework::Result;
use outpost_nodes::interfaces::ClockInterface;
use outpost_nodes::keeper::book;
use outpost_nodes::keeper::clock;

use crate::databases::keeper::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub book: Guarded<book::Book>,
    pub clock: Guarded<clock::Clock>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            clock: Guarded::new(
                "outpost_nodes::keeper::clock",
                OnFailure::Stop,
                Self::create_clock()?,
            ),
            book: Guarded::new(
                "outpost_nodes::keeper::book",
                OnFailure::Stop,
                Self::create_book()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl ClockInterface>) -> Result<()> {
        self.clock(frame)?;
        Ok(())
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        self.book(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        self.cycle(frame)
    }

    /// perception Lookout.ship, latest LookoutNorth.ship -> entries, provisional,
    /// newest_in_the_north
    #[inline(always)]
    fn book<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let ships = Interleaved {
            order: &frame.perception.lookout,
            instances: [
                &frame.perception.lookout_north.project(|outputs| &outputs.ship),
                &frame.perception.lookout_south.project(|outputs| &outputs.ship),
            ],
        };
        let context = book::CycleContext {
            ships: PerceptionInput::new(&ships),
            newest: frame
                .latest
                .lookout_north
                .latest(frame.cycle.time.start, |outputs| &outputs.ship),
            pages: &frame.parameters.book.pages,
        };
        let outputs = self.book.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.entries = outputs.entries.value;
        frame.own.provisional = outputs.provisional.value;
        frame.own.newest_in_the_north = outputs.newest_in_the_north.value;
        if let Some(injections) = frame.injections {
            injections.entries.replace(&mut frame.own.entries);
            injections.provisional.replace(&mut frame.own.provisional);
            injections.newest_in_the_north.replace(&mut frame.own.newest_in_the_north);
        }
        Ok(())
    }

    /// hardware -> nothing
    #[inline(always)]
    fn clock(&mut self, frame: &mut Frame<'_, impl ClockInterface>) -> Result<()> {
        let context = clock::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self.clock.call(&frame.cycle, |node| node.cycle(context))?;
        *frame.capture_time = Some(outputs.struck_at.0);
        Ok(())
    }

    fn create_book() -> Result<book::Book> {
        let context = book::CreationContext {};
        book::Book::new(context).in_node("outpost_nodes::keeper::book")
    }

    fn create_clock() -> Result<clock::Clock> {
        let context = clock::CreationContext {};
        clock::Clock::new(context).in_node("outpost_nodes::keeper::clock")
    }
}
