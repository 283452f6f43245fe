//! Copies of outputs that an instance leaves for the communication server, so that nobody disturbs its cycles.
//!
//! A tap is a small buffer per output ([`mod@crate::buffer`]): the instance copies the output in place at the end of a cycle while
//! the tap is open, the server takes the copies in order whenever it comes by. Neither waits; what the server is too late
//! for is counted. With all taps closed a cycle pays for one atomic load.
//!
//! Invariant: in the steady state nothing is allocated on the instance's thread ([`Clone::clone_from`] keeps heap capacity).

use std::any::Any;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};

use crate::buffer::{Queue, Writer, buffer};
use crate::cycler::Cycle;
use crate::data::Data;
use crate::reflect::{Reflect, Shape};
use crate::report::InstanceReport;
use crate::subscriptions::Subscriptions;
use crate::time::Timestamp;
use crate::timing::{Span, Spans};

/// Copies of one output that wait for the server: at 83 Hz it may come a quarter of a second late.
pub const WINDOW: usize = 20;

/// Sees every output of a finished cycle: main outputs in the order of `main_outputs`, then additional outputs in that of
/// their [`Subscriptions`].
pub trait OutputVisitor<'a> {
    /// The next output; `None` if this cycle has no value for it.
    fn output<T: Data>(&mut self, value: Option<&'a T>);
}

/// Main, or computed only while somebody listens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputKind {
    Main,
    Additional,
}

/// The server's end for one output.
pub struct Tap {
    name: &'static str,
    kind: OutputKind,
    shape: fn() -> Shape,
    index: usize,
    opened: usize,
    wishes: Arc<Wishes>,
    /// Of the instance, where it has to be told to compute the output.
    subscriptions: Option<Subscriptions>,
    queue: Box<dyn AnyQueue>,
}

/// A copy as the server finds it.
#[derive(Clone, Copy)]
pub struct Tapped<'a> {
    /// Number of the cycle.
    pub cycle: u64,
    /// Timestamp of the cycle.
    pub timestamp: Timestamp,
    pub value: &'a dyn Reflect,
}

/// The server's end for what an instance did.
pub struct Reports {
    wishes: Arc<Wishes>,
    receiver: Receiver<Box<InstanceReport>>,
    /// What the instance may write on.
    blanks: SyncSender<Box<InstanceReport>>,
    spans: Spans,
}

/// The instance's end of all its taps.
pub(crate) struct Taps {
    wishes: Arc<Wishes>,
    /// How many changes were seen.
    seen: u32,
    is_open: bool,
    ends: Vec<End>,
    reports: SyncSender<Box<InstanceReport>>,
    blanks: Receiver<Box<InstanceReport>>,
}

/// What the server wants of one instance.
#[derive(Debug)]
struct Wishes {
    /// Mostly nothing changes: then this is all that an instance looks at.
    changes: AtomicU32,
    open: Box<[AtomicBool]>,
    report: AtomicBool,
}

struct End {
    is_open: bool,
    /// A `Writer` of the output's type.
    writer: Box<dyn Any + Send>,
}

trait AnyQueue: Send {
    fn take(&mut self, seen: &mut dyn FnMut(Tapped<'_>)) -> bool;
    fn skip(&mut self);
    fn dropped(&self) -> u64;
}

/// What an output looks like.
type ShapeOf = fn() -> Shape;

/// Sees the outputs once, to make both ends for their types.
pub(crate) struct TapBuilder<'names> {
    main: &'names [&'static str],
    subscriptions: &'names Subscriptions,
    ends: Vec<End>,
    queues: Vec<(Box<dyn AnyQueue>, ShapeOf)>,
}

/// Copies what is wanted.
struct Copying<'taps> {
    ends: std::slice::IterMut<'taps, End>,
    cycle: Cycle,
}

impl Taps {
    /// Both ends of the taps of one instance, all closed.
    ///
    /// `visit` shows the outputs of any cycle; `main` and `subscriptions` have their names; `first` is what the instance may
    /// write its first report on.
    pub(crate) fn new(
        main: &[&'static str],
        subscriptions: &Subscriptions,
        first: Box<InstanceReport>,
        visit: impl FnOnce(&mut TapBuilder<'_>),
    ) -> (Self, Vec<Tap>, Reports) {
        let mut builder = TapBuilder {
            main,
            subscriptions,
            ends: Vec::new(),
            queues: Vec::new(),
        };
        visit(&mut builder);
        builder.finish(first)
    }

    /// Whether this cycle has to be copied: one atomic load while nothing changes.
    #[inline]
    pub(crate) fn look(&mut self) -> Look {
        // Acquire: with the change come the wishes before it.
        let changes = self.wishes.changes.load(Ordering::Acquire);
        let mut wants_report = false;
        if changes != self.seen {
            self.seen = changes;
            wants_report = self.update();
        }
        Look {
            is_open: self.is_open,
            wants_report,
        }
    }

    /// Sees the outputs of the cycle that has just finished.
    #[inline]
    pub(crate) fn copying(&mut self, cycle: Cycle) -> impl for<'a> OutputVisitor<'a> {
        Copying {
            ends: self.ends.iter_mut(),
            cycle,
        }
    }

    /// Gives the server what it asked for, on what it gave for that; if it gave nothing, it has not fetched the last one.
    pub(crate) fn report(&self, fill: impl FnOnce(&mut InstanceReport)) {
        if let Ok(mut report) = self.blanks.try_recv() {
            fill(&mut report);
            let _ = self.reports.try_send(report);
        }
    }

    #[cold]
    fn update(&mut self) -> bool {
        for (end, open) in self.ends.iter_mut().zip(&self.wishes.open) {
            end.is_open = open.load(Ordering::Relaxed);
        }
        self.is_open = self.ends.iter().any(|end| end.is_open);
        self.wishes.report.swap(false, Ordering::Relaxed)
    }
}

/// What the server wants of a cycle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    pub(crate) is_open: bool,
    pub(crate) wants_report: bool,
}

impl<'a> OutputVisitor<'a> for TapBuilder<'_> {
    fn output<T: Data>(&mut self, _: Option<&'a T>) {
        let (writer, [], [queue]) = buffer::<T, 0, 1>([WINDOW]);
        self.ends.push(End {
            is_open: false,
            writer: Box::new(writer),
        });
        self.queues.push((Box::new(queue), T::shape));
    }
}

impl TapBuilder<'_> {
    fn finish(self, first: Box<InstanceReport>) -> (Taps, Vec<Tap>, Reports) {
        let wishes = Arc::new(Wishes::for_outputs(self.queues.len()));
        let main = self.main.iter().map(|name| (*name, OutputKind::Main));
        let additional = self.subscriptions.names().iter();
        let names = main.chain(additional.map(|name| (*name, OutputKind::Additional)));
        let queues = self.queues.into_iter().enumerate();
        let taps = names
            .zip(queues)
            .map(|((name, kind), (index, (queue, shape)))| Tap {
                name,
                kind,
                shape,
                index,
                opened: 0,
                wishes: wishes.clone(),
                subscriptions: (kind == OutputKind::Additional).then(|| self.subscriptions.clone()),
                queue,
            });
        let taps = taps.collect();
        let (reports, receiver) = sync_channel(1);
        let (blanks, given) = sync_channel(1);
        // There is room for one.
        let _ = blanks.try_send(first);
        let instance = Taps {
            wishes: wishes.clone(),
            seen: 0,
            is_open: false,
            ends: self.ends,
            reports,
            blanks: given,
        };
        let reports = Reports {
            wishes,
            receiver,
            blanks,
            spans: Spans::new(),
        };
        (instance, taps, reports)
    }
}

impl<'a> OutputVisitor<'a> for Copying<'_> {
    #[inline]
    fn output<T: Data>(&mut self, value: Option<&'a T>) {
        let Some(end) = self.ends.next().filter(|end| end.is_open) else {
            return;
        };
        if let Some((value, writer)) = value.zip(end.writer.downcast_mut::<Writer<T>>()) {
            writer.slots().0.clone_from(value);
            writer.complete(self.cycle.number, self.cycle.time.start);
        }
    }
}

impl Tap {
    /// As nodes and manifest name it.
    pub fn name(&self) -> &'static str {
        self.name
    }

    pub fn kind(&self) -> OutputKind {
        self.kind
    }

    /// What its values look like.
    pub fn shape(&self) -> Shape {
        (self.shape)()
    }

    /// One more wants its values: those of the cycles that finish from now on are copied.
    pub fn open(&mut self) {
        self.opened += 1;
        if self.opened == 1 {
            // What was left over from the last time is old.
            self.queue.skip();
            if let Some(subscriptions) = &self.subscriptions {
                subscriptions.subscribe(self.name);
            }
            self.wishes.wish(self.index, true);
        }
    }

    /// One less wants its values; harmless where there is none.
    pub fn close(&mut self) {
        if self.opened == 1 {
            self.wishes.wish(self.index, false);
            if let Some(subscriptions) = &self.subscriptions {
                subscriptions.unsubscribe(self.name);
            }
        }
        self.opened = self.opened.saturating_sub(1);
    }

    /// Whether anybody wants its values.
    pub fn is_open(&self) -> bool {
        self.opened > 0
    }

    /// Shows the next copy, in order of the cycles; whether there was one.
    pub fn take(&mut self, mut seen: impl FnMut(Tapped<'_>)) -> bool {
        self.queue.take(&mut seen)
    }

    /// Copies that were overwritten before they were taken.
    pub fn dropped(&self) -> u64 {
        self.queue.dropped()
    }
}

impl Drop for Tap {
    fn drop(&mut self) {
        self.opened = self.opened.min(1);
        self.close();
    }
}

impl Reports {
    /// Of an instance that tells nothing.
    pub fn silent() -> Self {
        Self {
            wishes: Arc::new(Wishes::for_outputs(0)),
            receiver: sync_channel(1).1,
            blanks: sync_channel(1).0,
            spans: Spans::new(),
        }
    }

    /// The instance's next finished cycle tells what it did so far, on the report that it gave before: so that it need not
    /// allocate one.
    pub fn ask(&self, last: Option<Box<InstanceReport>>) {
        if let Some(last) = last {
            // There is room, unless it is of another instance.
            let _ = self.blanks.try_send(last);
        }
        self.wishes.report.store(true, Ordering::Relaxed);
        self.wishes.change();
    }

    /// What was asked for, once.
    pub fn take(&self) -> Option<Box<InstanceReport>> {
        self.receiver.try_recv().ok()
    }

    /// The oldest span that is kept of it, once. All of timed cycles are kept, as many as there is room for.
    pub fn take_span(&self) -> Option<Span> {
        self.spans.take()
    }

    pub(crate) fn spans(&self) -> &Spans {
        &self.spans
    }
}

impl Wishes {
    /// Nobody wants anything of so many outputs.
    fn for_outputs(count: usize) -> Self {
        Self {
            changes: AtomicU32::new(0),
            open: (0..count).map(|_| AtomicBool::new(false)).collect(),
            report: AtomicBool::new(false),
        }
    }

    fn wish(&self, index: usize, is_open: bool) {
        if let Some(open) = self.open.get(index) {
            open.store(is_open, Ordering::Relaxed);
        }
        self.change();
    }

    fn change(&self) {
        // Release: who sees it sees the wish.
        self.changes.fetch_add(1, Ordering::Release);
    }
}

impl<T: Data> AnyQueue for Queue<T> {
    fn take(&mut self, seen: &mut dyn FnMut(Tapped<'_>)) -> bool {
        let found = Queue::take(self).map(|entry| {
            seen(Tapped {
                cycle: entry.cycle,
                timestamp: entry.timestamp,
                value: &entry.value,
            });
        });
        self.release(1);
        found.is_some()
    }

    fn skip(&mut self) {
        while Queue::take(self).is_some() {
            self.release(1);
        }
    }

    fn dropped(&self) -> u64 {
        Queue::dropped(self)
    }
}
