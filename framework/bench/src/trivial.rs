//! 61 trivial nodes published as latest, beside four perception instances without news.

use framework::timing::{self, Timing};
use framework::{CycleTime, Result};

use crate::floor::Floor;
use crate::measure::{Row, timed};
use crate::recorded::Recorder;
use crate::report::{Limit, Report, Section};
use crate::turn::{robot, take, turn};

const PARAMETERS: &str = include_str!("../written/trivial/parameters/default.toml");

/// The robot `trivial` as one of its variants compiles it, and the same nodes by hand.
macro_rules! variant {
    ($name:ident, $nodes:ident, $runtime:ident) => {
        mod $name {
            use super::*;

            #[expect(dead_code, reason = "trivial nodes keep nothing")]
            mod by_hand {
                use $nodes as nodes;
                include!("../written/trivial/by_hand.rs");
            }

            pub(super) fn by_hand(name: &'static str) -> Result<Row<'static>> {
                let mut hand = by_hand::Hand::new(by_hand::Remembered::new(&[]))?;
                let perceived = by_hand::Perceived::new(|_| Vec::new());
                Ok(Row::new(name, move || {
                    let cycled = hand.cycle(&perceived, CycleTime::default());
                    assert!(cycled.is_ok(), "no node fails");
                }))
            }

            pub(super) fn ours(name: &'static str, timing: Timing) -> Result<Row<'static>> {
                let mut robot = robot($runtime::runtime::create, PARAMETERS)?;
                let mut control = take(&mut robot, "Control");
                Ok(Row::timed(name, move |times| {
                    // The others are there and have no news.
                    let _robot = &robot;
                    timing::set(timing);
                    timed(times, || turn(control.as_mut()))
                }))
            }
        }
    };
}

variant!(called, trivial_nodes_called, trivial_runtime_called);
variant!(inlined, trivial_nodes_inlined, trivial_runtime_inlined);
variant!(plain, trivial_nodes, trivial_runtime);

/// With a recording of every cycle.
fn recorded(name: &'static str) -> Result<Row<'static>> {
    let mut robot = robot(trivial_runtime_called::runtime::create, PARAMETERS)?;
    let mut recorder = Recorder::of(&robot, "Control")?;
    let mut control = take(&mut robot, "Control");
    Ok(Row::timed(name, move |times| {
        let _robot = &robot;
        timing::set(Timing::Off);
        let took = timed(times, || recorder.turn(control.as_mut()));
        recorder.rest();
        took
    }))
}

/// The rows, in the order of the table.
pub(crate) fn rows() -> Result<Vec<Row<'static>>> {
    let mut floor = Floor::new();
    let mut rows = vec![
        Row::new("F", move || floor.cycle()),
        called::by_hand("HAND, called")?,
        called::ours("ours, called", Timing::Off)?,
        recorded("ours, called, recorded")?,
        inlined::by_hand("HAND, inlined")?,
        inlined::ours("ours, inlined", Timing::Off)?,
        inlined::ours("ours, inlined, timing sampled", Timing::Sampled)?,
        inlined::ours("ours, inlined, timing on", Timing::Complete)?,
        plain::by_hand("HAND, as written")?,
        plain::ours("ours, as written", Timing::Off)?,
        plain::ours("ours, as written, timing on", Timing::Complete)?,
    ];
    rows.extend(copper_rows()?);
    Ok(rows)
}

const COPPER: &str = "copper, no log";
const COPPER_LOGGING: &str = "copper, log on";

#[cfg(feature = "copper")]
fn copper_rows() -> Result<[Row<'static>; 2]> {
    let mut quiet = bench_copper::Quiet::start().map_err(framework::Error::new)?;
    let mut logging = bench_copper::Logging::start().map_err(framework::Error::new)?;
    Ok([
        Row::new(COPPER, move || assert!(quiet.iterate(), "no task fails")),
        Row::new(COPPER_LOGGING, move || {
            assert!(logging.iterate(), "no task fails");
        }),
    ])
}

#[cfg(not(feature = "copper"))]
fn copper_rows() -> Result<[Row<'static>; 0]> {
    Ok([])
}

/// What is asked of the rows.
pub(crate) fn section(report: &Report) -> Section {
    let floor = report.nanos("F");
    let beside_copper = cfg!(feature = "copper").then(|| {
        let ours = report.nanos("ours, called");
        Limit::new(
            "total beside copper without log, nodes called",
            ours / report.nanos(COPPER),
            0.35,
            "x",
        )
    });
    let last = match cfg!(feature = "copper") {
        true => COPPER_LOGGING,
        false => "ours, as written, timing on",
    };
    let limits = limits(report, floor);
    Section {
        title: "61 trivial nodes published as latest, four perception instances without news",
        unit: ("F", floor),
        rows: report.rows_until("F", last),
        limits: limits.into_iter().chain(beside_copper).collect(),
    }
}

fn limits(report: &Report, floor: f64) -> [Limit; 4] {
    let over = |ours, hand| report.nanos(ours) - report.nanos(hand);
    [
        Limit::new(
            "framework over HAND, nodes inlined",
            over("ours, inlined", "HAND, inlined") / floor,
            0.25,
            "F",
        ),
        Limit::new(
            "total, nodes inlined",
            report.nanos("ours, inlined") / floor,
            0.8,
            "F",
        ),
        Limit::new(
            "total, nodes called",
            report.nanos("ours, called") / floor,
            2.0,
            "F",
        ),
        Limit::new(
            "allocations",
            report.allocations("ours, called") + report.allocations("ours, inlined"),
            0.0,
            "",
        ),
    ]
}
