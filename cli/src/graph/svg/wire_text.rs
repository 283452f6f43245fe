//! The text of a wire: its lines with round corners, arrowheads, and the dot that it begins at.

use super::cards::Column;
use super::text::escape;
use super::wires::{Wire, Wiring};
use crate::graph::lines::line;

/// Of a wire's corners.
const RADIUS: i32 = 5;

pub(super) fn draw_wire(
    text: &mut String,
    wire: &Wire<'_>,
    wiring: &Wiring<'_>,
    columns: &[Column<'_>],
    rights: &[i32],
) {
    let mut path = String::new();
    let mut heads = String::new();
    let mut readers: Vec<String> = Vec::new();
    let mut start = (0, 0);
    for &end in &wire.to {
        let mut corners = wiring.corners(wire, end, columns, rights);
        start = corners[0];
        let (x, y) = corners.pop().expect("a wire ends somewhere");
        let direction = if wire.from.column < end.column { -1 } else { 1 };
        corners.push((x + 7 * direction, y));
        write_rounded(&mut path, &corners);
        heads.push_str(&format!("M{x} {y}l{} -4v8z", 9 * direction));
        let column = &columns[end.column];
        readers.push(format!(
            "{}/{}",
            column.cycler.name, column.cards[end.card].node.path
        ));
    }
    let (cycler, node, output) = wire.source;
    let class = wire.kind.word();
    let from = escape(&format!("{cycler}/{node}"));
    let to = escape(&readers.join(" "));
    let about = escape(&format!("{output}: {node} to {}", readers.join(", ")));
    line(
        text,
        format_args!(
            "<g class=\"wire {class}\" data-from=\"{from}\" data-to=\"{to}\">\
             <title>{about}</title><path class=\"halo\" d=\"{path}\"/><path d=\"{path}\"/>\
             <path class=\"head\" d=\"{heads}\"/>\
             <circle class=\"source {class}\" cx=\"{}\" cy=\"{}\" r=\"3.5\"/></g>",
            start.0, start.1
        ),
    );
}

/// Horizontal and vertical lines with round corners.
fn write_rounded(path: &mut String, corners: &[(i32, i32)]) {
    let mut corners = corners.to_vec();
    corners.dedup();
    let mut append = |text: std::fmt::Arguments<'_>| path.push_str(&text.to_string());
    for (index, &(x, y)) in corners.iter().enumerate() {
        if index == 0 {
            append(format_args!("M{x} {y}"));
            continue;
        }
        let (before, after) = (corners[index - 1], corners.get(index + 1));
        let Some(&after) = after else {
            append(format_args!("L{x} {y}"));
            continue;
        };
        let room = |other: (i32, i32)| (other.0 - x).abs().max((other.1 - y).abs()) / 2;
        let radius = RADIUS.min(room(before)).min(room(after));
        let toward = |other: (i32, i32)| {
            (
                x + (other.0 - x).signum() * radius,
                y + (other.1 - y).signum() * radius,
            )
        };
        let (start, end) = (toward(before), toward(after));
        append(format_args!(
            "L{} {}Q{x} {y} {} {}",
            start.0, start.1, end.0, end.1
        ));
    }
}
