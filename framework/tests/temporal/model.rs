//! What the contract says about cycles in order, as plain as possible.

/// One completed cycle.
#[derive(Clone, Debug)]
pub(crate) struct Cycle {
    pub(crate) number: u64,
    pub(crate) timestamp: u64,
    /// Given in the first `begin` that sees it.
    pub(crate) order: Option<u64>,
    pub(crate) expired: bool,
}

/// What a consumer shows of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shown {
    pub(crate) order: u64,
    pub(crate) timestamp: u64,
    pub(crate) instance: usize,
    pub(crate) number: u64,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) delivered: u64,
    pub(crate) late: u64,
    pub(crate) expired: u64,
    pub(crate) abandoned: u64,
    pub(crate) dropped: u64,
}

/// One perception instance as one consumer sees it.
#[derive(Debug)]
pub(crate) struct Instance {
    pub(crate) window: usize,
    pub(crate) pending_timeout: u64,
    pub(crate) pending: Option<u64>,
    pub(crate) given_up: bool,
    /// Completed and not yet persistent.
    pub(crate) completed: Vec<Cycle>,
    /// How many of `completed` have a place in the window.
    pub(crate) taken: usize,
    /// Delivered in the last `begin`: they are in the window until the next.
    pub(crate) leaving: usize,
    pub(crate) newest_order: u64,
    pub(crate) announced: u64,
    pub(crate) counts: Counts,
}

impl Instance {
    pub(crate) fn new(window: usize, pending_timeout: u64) -> Self {
        Self {
            window,
            pending_timeout,
            pending: None,
            given_up: false,
            completed: Vec::new(),
            taken: 0,
            leaving: 0,
            newest_order: 0,
            announced: 0,
            counts: Counts::default(),
        }
    }

    pub(crate) fn announce(&mut self, timestamp: u64) {
        self.announced += 1;
        self.pending = Some(timestamp);
        self.given_up = false;
    }

    pub(crate) fn complete(&mut self, number: u64) {
        let Some(timestamp) = self.pending.take() else {
            return;
        };
        let expired = std::mem::take(&mut self.given_up);
        self.completed.push(Cycle {
            number,
            timestamp,
            order: None,
            expired,
        });
        // What is not taken waits in the room of the window, and one more as the newest.
        let room = self.window - self.taken - self.leaving + 1;
        if self.completed.len() - self.taken > room {
            self.completed.remove(self.taken);
            self.counts.dropped += 1;
        }
    }

    pub(crate) fn abandon(&mut self) {
        self.pending = None;
        self.counts.abandoned += 1;
    }

    /// Sees announcement and completed cycles for the first time, and gives them their order.
    /// Returns what the pending announcement counts at.
    fn see(&mut self, t0: u64, horizon: u64) -> Option<u64> {
        self.leaving = 0;
        self.taken = self.completed.len().min(self.window);
        for cycle in &mut self.completed[..self.taken] {
            let order = cycle.timestamp.max(horizon).max(self.newest_order);
            self.newest_order = *cycle.order.get_or_insert(order);
        }
        if self.taken < self.completed.len() {
            // No room yet: completed cycles come after the newest that was seen.
            return Some(self.newest_order.max(horizon) + 1);
        }
        let pending = self.pending?;
        self.given_up = t0.saturating_sub(pending) > self.pending_timeout;
        (!self.given_up).then_some(pending.max(horizon).max(self.newest_order))
    }

    /// The order up to which a full window turns its oldest cycles persistent.
    fn pressed(&self, t0: u64) -> Option<u64> {
        let mut full = self.completed.len();
        let mut pressed = None;
        for cycle in &self.completed[..self.taken] {
            let order = cycle.order.expect("taken cycles are seen");
            if full < self.window || order > t0 {
                break;
            }
            full -= 1;
            pressed = Some(order);
        }
        pressed
    }
}

/// By order, timestamp, instance and number; but of one order and instance, by number alone.
fn sort(shown: &mut [Shown]) {
    shown.sort_by_key(|one| (one.order, one.instance, one.number));
    let mut latest = (0, 0, 0);
    let keys: Vec<_> = shown
        .iter()
        .map(|one| {
            let before = match latest {
                (order, instance, timestamp) if (order, instance) == (one.order, one.instance) => {
                    timestamp
                }
                _ => 0,
            };
            latest = (one.order, one.instance, one.timestamp.max(before));
            (one.order, latest.2, one.instance, one.number)
        })
        .collect();
    let mut keyed: Vec<_> = keys.into_iter().zip(shown.to_vec()).collect();
    keyed.sort_by_key(|(key, _)| *key);
    for (place, (_, one)) in shown.iter_mut().zip(keyed) {
        *place = one;
    }
}

#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) instances: Vec<Instance>,
    pub(crate) horizon: u64,
}

impl Model {
    /// Persistent and transient.
    pub(crate) fn consume(&mut self, t0: u64) -> (Vec<Shown>, Vec<Shown>) {
        let horizon = self.horizon;
        let pending = self
            .instances
            .iter_mut()
            .filter_map(|each| each.see(t0, horizon))
            .min();
        let pressed = self
            .instances
            .iter()
            .filter_map(|each| each.pressed(t0))
            .max();
        let (mut persistent, mut transient) = (Vec::new(), Vec::new());
        for (instance, each) in self.instances.iter_mut().enumerate() {
            let seen: Vec<_> = each.completed.drain(..each.taken).collect();
            for cycle in seen.into_iter().rev() {
                let order = cycle.order.expect("taken cycles are seen");
                let shown = Shown {
                    order,
                    instance,
                    number: cycle.number,
                    timestamp: cycle.timestamp,
                };
                let is_final = pending.is_none_or(|pending| order < pending)
                    || pressed.is_some_and(|pressed| order <= pressed);
                if order <= t0 && is_final {
                    each.counts.delivered += 1;
                    each.counts.late += u64::from(order > cycle.timestamp);
                    each.counts.expired += u64::from(cycle.expired);
                    each.taken -= 1;
                    each.leaving += 1;
                    persistent.push(shown);
                    continue;
                }
                if order <= t0 {
                    transient.push(shown);
                }
                each.completed.insert(0, cycle);
            }
        }
        sort(&mut persistent);
        sort(&mut transient);
        self.horizon = persistent
            .last()
            .map_or(horizon, |last| last.order.max(horizon));
        (persistent, transient)
    }
}
