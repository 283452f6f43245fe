//! The mix of a real body's cycler: 58 nodes with all kinds of fields, and four producers.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use framework::timing::{self, Timing};
use framework::{CycleTime, Instance, Result, Robot, Timestamp};
use mix_runtime::parameters::Parameters;
use mix_runtime::runtime;

use crate::measure::Row;
use crate::recorded::Recorder;
use crate::report::{Limit, Report, Section};
use crate::turn::{robot, take, turn};

pub(crate) mod by_hand {
    use mix_nodes as nodes;
    include!("../written/mix/by_hand.rs");
}

pub(crate) const PARAMETERS: &str = include_str!("../written/mix/parameters/default.toml");
/// Every how many cycles of `Control` an instance has news: cameras, microphones, network.
pub(crate) const EVERY: [(&str, u64); 4] = [
    ("VisionTop", 3),
    ("VisionBottom", 3),
    ("Audio", 4),
    ("Network", 8),
];
const WATCHED: [&str; 4] = [
    "node05.detail",
    "node20.detail",
    "node35.detail",
    "node50.detail",
];

/// The robot `mix`, and what turns it.
pub(crate) struct Mix {
    robot: Robot<Parameters>,
    recorder: Option<Recorder>,
    pub(crate) control: Box<dyn Instance>,
    pub(crate) producers: Vec<(Box<dyn Instance>, u64)>,
    cycle: u64,
}

impl Mix {
    pub(crate) fn new() -> Result<Self> {
        Ok(Self::of(robot(runtime::create, PARAMETERS)?))
    }

    /// With a recording of every cycle of `Control`.
    fn recorded() -> Result<Self> {
        let robot = robot(runtime::create, PARAMETERS)?;
        let recorder = Some(Recorder::of(&robot, "Control")?);
        Ok(Self {
            recorder,
            ..Self::of(robot)
        })
    }

    fn of(mut robot: Robot<Parameters>) -> Self {
        let control = take(&mut robot, "Control");
        let producers = EVERY.map(|(name, every)| (take(&mut robot, name), every));
        Self {
            robot,
            recorder: None,
            control,
            producers: producers.into(),
            cycle: 0,
        }
    }

    fn watch(&mut self) -> Result<()> {
        let access = self.robot.access("Control")?;
        for name in WATCHED {
            assert!(access.subscriptions.subscribe(name), "no output `{name}`");
        }
        Ok(())
    }

    /// One cycle of `Control` after the cycles of producers that are due; how long the one of `Control` took.
    fn cycle(&mut self) -> Duration {
        self.cycle += 1;
        for (producer, every) in &mut self.producers {
            if self.cycle.is_multiple_of(*every) {
                turn(producer.as_mut());
            }
        }
        let started = Instant::now();
        match &mut self.recorder {
            Some(recorder) => recorder.turn(self.control.as_mut()),
            None => turn(self.control.as_mut()),
        }
        started.elapsed()
    }
}

/// The nodes by hand, with as much news in the same cycles.
pub(crate) struct ByHand {
    hand: by_hand::Hand,
    /// What is perceived, by which of the cameras, the microphones and the network have news.
    perceived: Vec<by_hand::Perceived>,
    cycle: u64,
}

/// As many values of the past as ours has.
const PAST: u64 = 80;
const PAST_PERIOD: u64 = 5_000;
const NOW: Timestamp = Timestamp::from_nanos(1_000_000_000);

impl ByHand {
    pub(crate) fn new() -> Result<Self> {
        let past: Vec<_> = (1..=PAST)
            .rev()
            .map(|age| Timestamp::from_nanos(NOW.as_nanos() - age * PAST_PERIOD))
            .collect();
        let perceived = (0..8).map(|news| {
            by_hand::Perceived::new(|instance| {
                let (bit, values) = match instance {
                    "Vision" => (1, 2),
                    "VisionTop" | "VisionBottom" => (1, 1),
                    "Audio" => (2, 1),
                    _ => (4, 1),
                };
                vec![NOW; if news & bit == 0 { 0 } else { values }]
            })
        });
        Ok(Self {
            hand: by_hand::Hand::new(by_hand::Remembered::new(&past))?,
            perceived: perceived.collect(),
            cycle: 0,
        })
    }

    pub(crate) fn cycle(&mut self) -> Duration {
        self.cycle += 1;
        let news = |every: u64, bit: usize| {
            if self.cycle.is_multiple_of(every) {
                bit
            } else {
                0
            }
        };
        let perceived = &self.perceived[news(3, 1) | news(4, 2) | news(8, 4)];
        let time = CycleTime {
            start: NOW,
            since_last: Duration::from_nanos(PAST_PERIOD),
        };
        let started = Instant::now();
        let cycled = self.hand.cycle(perceived, time);
        let took = started.elapsed();
        assert!(cycled.is_ok(), "no node fails");
        took
    }
}

fn sum(times: u64, mut once: impl FnMut() -> Duration) -> Duration {
    (0..times).map(|_| once()).sum()
}

fn ours(name: &'static str, mix: &Rc<RefCell<Mix>>, timing: Timing) -> Row<'static> {
    let mix = mix.clone();
    Row::timed(name, move |times| {
        timing::set(timing);
        let mut mix = mix.borrow_mut();
        let took = sum(times, || mix.cycle());
        if let Some(recorder) = &mix.recorder {
            recorder.rest();
        }
        took
    })
}

/// The rows, in the order of the table.
pub(crate) fn rows() -> Result<Vec<Row<'static>>> {
    let mut hand = ByHand::new()?;
    let mix = Rc::new(RefCell::new(Mix::new()?));
    let mut watched = Mix::new()?;
    watched.watch()?;
    let watched = Rc::new(RefCell::new(watched));
    let recorded = Rc::new(RefCell::new(Mix::recorded()?));
    Ok(vec![
        Row::timed("mix: HAND", move |times| sum(times, || hand.cycle())),
        ours("mix: ours", &mix, Timing::Off),
        ours("mix: ours, timing sampled", &mix, Timing::Sampled),
        ours("mix: ours, timing on", &mix, Timing::Complete),
        ours("mix: ours, four watched", &watched, Timing::Off),
        ours("mix: ours, recorded", &recorded, Timing::Off),
    ])
}

/// What is asked of the rows.
pub(crate) fn section(report: &Report) -> Section {
    let floor = report.nanos("F");
    let over = |ours, hand| (report.nanos(ours) - report.nanos(hand)) / floor;
    Section {
        title: "The mix of a real body's cycler, with news from four producers",
        unit: ("F", floor),
        rows: report.rows_until("mix: HAND", "mix: ours, recorded"),
        limits: vec![
            Limit::new(
                "overhead over HAND",
                over("mix: ours", "mix: HAND"),
                2.5,
                "F",
            ),
            Limit::new(
                "four watched outputs",
                over("mix: ours, four watched", "mix: ours"),
                1.1,
                "F",
            ),
            Limit::new(
                "allocations over HAND's",
                report.allocations("mix: ours") - report.allocations("mix: HAND"),
                0.0,
                "",
            ),
            Limit::new(
                "allocations of a recording",
                report.allocations("mix: ours, recorded") - report.allocations("mix: ours"),
                0.0,
                "",
            ),
        ],
    }
}
