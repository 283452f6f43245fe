//! What another machine says becomes what its readers see, whatever is lost on the way.

use proptest::prelude::*;
use serde::Deserialize;
use serde_json::json;

use super::*;
use crate::Reflect;
use crate::buffer::{Queue, buffer};
use crate::temporal::{Consumer, Horizon, PerceptionInput};

/// What is read of an eye.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
struct Seen {
    distance: f32,
    number: u64,
}

fn time(nanos: u64) -> Timestamp {
    Timestamp::from_nanos(nanos)
}

fn seen(number: u64) -> Value {
    json!({ "distance": 0.5, "number": number })
}

/// An eye in a world where it is `now`, and who consumes it.
fn eye(now: u64) -> (Remote<Seen>, Clock, Queue<Seen>) {
    let (writer, [], [queue]) = buffer([64]);
    let clock = Clock::stepped();
    clock.advance_to(time(now));
    let eye = Remote::new("Eye", writer, Duration::from_nanos(100), clock.clone());
    (eye, clock, queue)
}

fn said(result: Result<()>) -> String {
    result.expect_err("it cannot be").to_string()
}

/// Times of persistent and of transient values of a cycle at `now`.
fn consumed(horizon: &mut Horizon, eye: &mut Consumer<Seen>, now: u64) -> [Vec<(u64, u64)>; 2] {
    horizon.consume(time(now), [&mut *eye]);
    let projection = eye.project(|seen| seen.number);
    let input = PerceptionInput::new(&projection);
    let values = |(at, number): (Timestamp, u64)| (at.as_nanos(), number);
    [
        input.persistent.iter().map(values).collect(),
        input.transient.iter().map(values).collect(),
    ]
}

#[test]
fn what_is_announced_is_waited_for_and_keeps_its_capture_time() {
    let (mut eye, clock, queue) = eye(20);
    let mut consumer = Consumer::new(queue, eye.pending_timeout());
    let mut horizon = Horizon::new();
    eye.announce(time(10)).expect("the time has come");
    assert_eq!(consumed(&mut horizon, &mut consumer, 20), [vec![], vec![]]);
    clock.advance_to(time(60));
    eye.complete(time(10), &seen(1)).expect("it is announced");
    eye.announce(time(30)).expect("the time has come");
    assert_eq!(
        consumed(&mut horizon, &mut consumer, 60),
        [vec![(10, 1)], vec![]]
    );
    eye.abandon(time(30)).expect("it is announced");
    eye.complete(time(40), &seen(2))
        .expect("it begins and ends");
    eye.announce(time(50)).expect("the time has come");
    assert_eq!(
        consumed(&mut horizon, &mut consumer, 70),
        [vec![(40, 2)], vec![]]
    );
    clock.advance_to(time(200));
    eye.complete(time(150), &seen(3))
        .expect("it begins and ends");
    assert_eq!(
        consumed(&mut horizon, &mut consumer, 200),
        [vec![(150, 3)], vec![]],
        "what was announced before is not waited for any more"
    );
    let counts = FeedCounts {
        completed: 3,
        unannounced: 2,
        abandoned: 2,
        refused: 0,
    };
    assert_eq!(eye.counts(), counts);
    assert_eq!(consumer.report().abandoned, 2);
}

#[test]
fn an_announcement_whose_completion_is_lost_is_not_waited_for_longer_than_its_timeout() {
    let (mut eye, clock, queue) = eye(10);
    let mut consumer = Consumer::new(queue, eye.pending_timeout());
    let (mut other, _, other_queue) = self::eye(300);
    let mut other_consumer = Consumer::new(other_queue, other.pending_timeout());
    let mut horizon = Horizon::new();
    eye.announce(time(10)).expect("the time has come");
    other.complete(time(20), &seen(7)).expect("it is later");
    let mut persistent = |now| {
        clock.advance_to(time(now));
        horizon.consume(time(now), [&mut consumer, &mut other_consumer]);
        let projection = other_consumer.project(|seen| seen.number);
        let input = PerceptionInput::new(&projection);
        (input.persistent.len(), input.transient.len())
    };
    assert_eq!(persistent(30), (0, 1), "the announced one comes before it");
    assert_eq!(persistent(110), (0, 1));
    assert_eq!(persistent(111), (1, 0), "101 ns are too long");
}

#[test]
fn what_cannot_be_is_refused_and_changes_nothing() {
    let (mut eye, _, mut queue) = eye(20);
    let refused = [
        (
            eye.announce(time(21)),
            "`Eye` cannot have data of 0.000000021 s: it is 0.000000020 s here; is the clock of the other machine ahead?",
        ),
        (
            eye.complete(time(u64::MAX), &seen(1)),
            "`Eye` cannot have data of 18446744073.709551615 s: it is 0.000000020 s here; is the clock of the other machine ahead?",
        ),
        (
            eye.abandon(time(10)),
            "`Eye` has announced no cycle of 0.000000010 s to abandon",
        ),
        (
            eye.complete(time(10), &json!([1])),
            "outputs of `Eye`: expected an object of main outputs by their names",
        ),
        (
            eye.complete(time(10), &json!({ "number": 1 })),
            "outputs of `Eye`: missing field `distance`",
        ),
        (
            eye.complete(time(10), &json!({ "distance": 1, "number": -1 })),
            "outputs of `Eye`: `number`: invalid value: integer `-1`, expected u64",
        ),
    ];
    let all = refused.len() as u64;
    for (result, expected) in refused {
        assert_eq!(said(result), expected);
    }
    assert!(queue.announced().is_none() && queue.take().is_none());

    eye.announce(time(15)).expect("nothing was before");
    assert!(said(eye.complete(time(15), &Value::Null)).starts_with("outputs of `Eye`"));
    assert_eq!(
        said(eye.announce(time(15))),
        "`Eye` cannot have data of 0.000000015 s after that of 0.000000015 s: feed it in order of time, each cycle once"
    );
    assert_eq!(queue.announced(), Some(time(15)), "it is announced still");
    eye.complete(time(15), &seen(1)).expect("it is announced");
    assert!(said(eye.complete(time(15), &seen(1))).contains("each cycle once"));
    assert!(said(eye.complete(time(14), &seen(1))).contains("in order of time"));
    let counts = FeedCounts {
        completed: 1,
        refused: all + 4,
        ..FeedCounts::default()
    };
    assert_eq!(eye.counts(), counts);
    let of_shape = format!("{:?}", eye.shape());
    assert!(of_shape.contains("distance") && of_shape.contains("number"));
}

/// What another machine says, some of it out of order.
#[derive(Clone, Debug)]
enum Said {
    Announce(u64),
    Complete(u64),
    Abandon(u64),
    LetGo,
    Waits(u64),
}

fn anything_said() -> impl Strategy<Value = Said> {
    prop_oneof![
        (0..80_u64).prop_map(Said::Announce),
        (0..80_u64).prop_map(Said::Complete),
        (0..80_u64).prop_map(Said::Abandon),
        Just(Said::LetGo),
        (0..20_u64).prop_map(Said::Waits),
    ]
}

/// The rules again, as plainly as possible.
#[derive(Default)]
struct Model {
    now: u64,
    newest: Option<u64>,
    announced: Option<u64>,
    completed: Vec<(u64, u64)>,
    counts: FeedCounts,
}

impl Model {
    fn may_begin(&self, at: u64) -> bool {
        at <= self.now && self.newest.is_none_or(|newest| at > newest)
    }

    fn let_go(&mut self) {
        self.counts.abandoned += u64::from(self.announced.take().is_some());
    }

    /// Whether it is taken.
    fn hear(&mut self, said: &Said) -> bool {
        let is_taken = match *said {
            Said::Waits(nanos) => {
                self.now += nanos;
                true
            }
            Said::LetGo => {
                self.let_go();
                true
            }
            Said::Announce(at) if self.may_begin(at) => {
                self.let_go();
                (self.newest, self.announced) = (Some(at), Some(at));
                true
            }
            Said::Complete(at) if self.announced == Some(at) => {
                self.announced = None;
                self.complete(at);
                true
            }
            Said::Complete(at) if self.may_begin(at) => {
                self.let_go();
                self.newest = Some(at);
                self.counts.unannounced += 1;
                self.complete(at);
                true
            }
            Said::Abandon(at) if self.announced == Some(at) => {
                self.let_go();
                true
            }
            Said::Announce(_) | Said::Complete(_) | Said::Abandon(_) => false,
        };
        self.counts.refused += u64::from(!is_taken);
        is_taken
    }

    fn complete(&mut self, at: u64) {
        self.counts.completed += 1;
        self.completed.push((at, at));
    }
}

proptest! {
    #[test]
    fn whatever_is_said_is_what_the_rules_say(all in prop::collection::vec(anything_said(), 0..60)) {
        let (mut eye, clock, queue) = eye(0);
        let mut consumer = Consumer::new(queue, eye.pending_timeout());
        let (mut horizon, mut model) = (Horizon::new(), Model::default());
        let mut delivered = Vec::new();
        for said in &all {
            let is_taken = match *said {
                Said::Announce(at) => eye.announce(time(at)).is_ok(),
                Said::Complete(at) => eye.complete(time(at), &seen(at)).is_ok(),
                Said::Abandon(at) => eye.abandon(time(at)).is_ok(),
                Said::LetGo => {
                    eye.let_go();
                    true
                }
                Said::Waits(nanos) => {
                    clock.advance_to(clock.now() + Duration::from_nanos(nanos));
                    true
                }
            };
            prop_assert_eq!(is_taken, model.hear(said));
            prop_assert_eq!(eye.counts(), model.counts);
            let [persistent, transient] = consumed(&mut horizon, &mut consumer, model.now);
            delivered.extend(persistent);
            prop_assert!(transient.is_empty(), "nothing is announced before what is complete");
            prop_assert_eq!(&delivered, &model.completed);
        }
    }
}
