//! A run as a picture: the cycles along the time, and below them what each cycle of Localization was given.

use std::fmt::Write;

use timing_nodes::types::{Sets, Span};

use crate::story::{CONSUMER, PERCEPTION, Story};

/// Seconds of the run that are drawn.
const END: f64 = 5.2;
/// Of a second, pixels.
const SCALE: f64 = 150.0;
/// Where the time begins, pixels.
const LEFT: f64 = 110.0;
const LANE: f64 = 34.0;
const TOP: f64 = 34.0;
/// Height of a row of the lower part, pixels.
const ROW: f64 = 24.0;

const COLOURS: [&str; 3] = ["#8250df", "#1f6feb", "#bf8700"];
const INK: &str = "#1f2328";
const FAINT: &str = "#8c959f";

/// The picture.
pub(crate) fn of(story: &Story) -> String {
    let rows: Vec<&Sets> = story.sets.iter().filter(|sets| sets.at < END).collect();
    let below = TOP + LANE * 4.0 + 46.0;
    let height = below + ROW * rows.len() as f64 + 34.0;
    let width = x(END) + 16.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <title>Timing of four cyclers, from a recording</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    seconds(&mut svg, below - 40.0);
    for (lane, instance) in PERCEPTION.iter().chain([&CONSUMER]).enumerate() {
        let y = TOP + LANE * lane as f64;
        text(&mut svg, 8.0, y + 16.0, INK, instance);
        let colour = COLOURS.get(lane).copied().unwrap_or(INK);
        let begins = story.begins.get(*instance).into_iter().flatten();
        for begin in begins.filter(|begin| **begin < END) {
            // What takes no virtual time is a stroke.
            let duration = story.durations.get(*instance).copied().unwrap_or_default();
            let end = (begin + duration).min(END);
            let width = (x(end) - x(*begin)).max(0.8);
            bar(&mut svg, (x(*begin), y + 4.0), (width, 16.0), colour, 0.85);
        }
    }
    let heading = "What Localization was given in each of its cycles, by the time of capture: persistent (full), transient (pale)";
    text(&mut svg, 8.0, below - 10.0, INK, heading);
    for (row, sets) in rows.into_iter().enumerate() {
        given(&mut svg, sets, below + ROW * row as f64);
    }
    svg.push_str("</svg>\n");
    svg
}

/// One row: the entries as bars below each other, the moment itself as a stroke.
fn given(svg: &mut String, sets: &Sets, y: f64) {
    text(svg, 8.0, y + 14.0, INK, &format!("t0 = {:.3} s", sets.at));
    for (cycler, colour) in COLOURS.iter().enumerate() {
        let y = y + 2.0 + 6.0 * cycler as f64;
        for (span, opacity) in [
            (sets.persistent[cycler], 1.0),
            (sets.transient[cycler], 0.35),
        ] {
            entries(svg, span, y, colour, opacity);
        }
    }
    let at = x(sets.at);
    let (top, bottom) = (y, y + ROW - 4.0);
    let _ = writeln!(
        svg,
        "<path d=\"M{at:.1} {top:.1}V{bottom:.1}\" stroke=\"{INK}\" stroke-width=\"1.5\"/>"
    );
}

fn entries(svg: &mut String, span: Span, y: f64, colour: &str, opacity: f64) {
    if span.count == 0 || span.first >= END {
        return;
    }
    let width = (x(span.last.min(END)) - x(span.first)).max(4.0);
    bar(svg, (x(span.first), y), (width, 5.0), colour, opacity);
}

/// The axis, with a line through everything at every half second.
fn seconds(svg: &mut String, bottom: f64) {
    let mut half = 0.0;
    while half <= END {
        let at = x(half);
        let _ = writeln!(
            svg,
            "<path d=\"M{at:.1} {TOP}V{bottom:.1}\" stroke=\"#d0d7de\" stroke-width=\"0.6\"/>"
        );
        text(svg, at - 9.0, TOP - 10.0, FAINT, &format!("{half:.1} s"));
        half += 0.5;
    }
}

fn bar(
    svg: &mut String,
    (x, y): (f64, f64),
    (width, height): (f64, f64),
    colour: &str,
    opacity: f64,
) {
    let _ = writeln!(
        svg,
        "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height}\" fill=\"{colour}\" fill-opacity=\"{opacity}\"/>"
    );
}

fn text(svg: &mut String, x: f64, y: f64, colour: &str, text: &str) {
    let _ = writeln!(
        svg,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{colour}\">{text}</text>"
    );
}

fn x(seconds: f64) -> f64 {
    LEFT + SCALE * seconds
}
