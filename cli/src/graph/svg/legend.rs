//! The legend: what each kind of wire means.

use super::cards;
use super::document::BORDER;
use crate::graph::lines::line;
use crate::graph::{EdgeKind, Graph};

/// Middle of the legend's first line, and from line to line.
const LEGEND_TOP: i32 = 62;
const LEGEND_LINE: i32 = 20;

const KINDS: [(EdgeKind, &str); 6] = [
    (EdgeKind::Input, "this cycle's value"),
    (EdgeKind::Previous, "value of the cycle before"),
    (EdgeKind::Historic, "this and earlier values"),
    (EdgeKind::Latest, "newest value of another instance"),
    (EdgeKind::Perception, "perception in order of time"),
    (EdgeKind::State, "cycler state"),
];

/// In as many lines as its width asks for; gives their height.
pub(super) fn draw_legend(text: &mut String, graph: &Graph, width: i32) -> i32 {
    let (mut x, mut y) = (BORDER, LEGEND_TOP);
    line(text, format_args!("<g class=\"legend\">"));
    let kinds = KINDS
        .iter()
        .filter(|(kind, _)| graph.edges.iter().any(|edge| edge.kind == *kind));
    let entries = kinds.map(|(kind, meaning)| (Some(*kind), *meaning));
    let has_clients = (graph.cyclers.iter().flat_map(|cycler| &cycler.nodes))
        .flat_map(|node| &node.fields)
        .any(|field| matches!(field.kind, "AdditionalOutput" | "Procedure"));
    let clients = has_clients.then_some((None, "only for clients"));
    for (kind, meaning) in entries.chain(clients) {
        // A dot needs less room than a wire.
        let sample = if kind.is_some() { 36 } else { 8 };
        let entry_width = sample + 6 + cards::text_width(meaning);
        if x + entry_width > width && x > BORDER {
            (x, y) = (BORDER, y + LEGEND_LINE);
        }
        let head = x + sample;
        match kind.map(EdgeKind::word) {
            Some(class) => line(
                text,
                format_args!(
                    "<g class=\"wire {class}\"><path d=\"M{x} {y}h26\"/>\
                     <path class=\"head\" d=\"M{head} {y}l-9 -4v8z\"/></g>"
                ),
            ),
            None => line(
                text,
                format_args!(
                    "<circle class=\"client\" cx=\"{}\" cy=\"{y}\" r=\"3.5\"/>",
                    x + 4
                ),
            ),
        }
        line(
            text,
            format_args!("<text x=\"{}\" y=\"{}\">{meaning}</text>", head + 6, y + 4),
        );
        x += entry_width + 22;
    }
    line(text, format_args!("</g>"));
    y - LEGEND_TOP + LEGEND_LINE
}
