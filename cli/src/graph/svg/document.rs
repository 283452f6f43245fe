//! The text of the picture: title, legend, columns, cards, wires.

use super::card_text::draw_card;
use super::cards::{self, COLUMN_TITLE, Column, MARGIN, TOP};
use super::legend::draw_legend;
use super::text::escape;
use super::wire_text::draw_wire;
use super::wires::Wiring;
use crate::commands::plural;
use crate::graph::Graph;
use crate::graph::lines::line;

/// Around everything.
pub(super) const BORDER: i32 = 20;
/// Of a picture with few columns, so that title and legend have room.
const LEAST_WIDTH: i32 = 640;

pub(super) fn draw(graph: &Graph, columns: &[Column<'_>], wiring: &Wiring<'_>) -> String {
    let rights = right_edges(columns, wiring);
    let bottom = columns
        .iter()
        .map(|column| column.bottom)
        .max()
        .unwrap_or(TOP);
    let last = columns.len().checked_sub(1);
    let columns_end = last.map_or(0, |last| rights[last] + wiring.gap_width(last));
    let width = columns_end.max(LEAST_WIDTH) + BORDER;
    let mut legend = String::new();
    let legend_height = draw_legend(&mut legend, graph, width - BORDER);
    let height = legend_height + bottom.max(wiring.bottom()) + BORDER;

    let mut text = String::new();
    write_head(&mut text, graph, width, height);
    text.push_str(&legend);
    line(
        &mut text,
        format_args!("<g transform=\"translate(0 {legend_height})\">"),
    );
    for (column, &right) in columns.iter().zip(&rights) {
        draw_column(&mut text, column, right - column.width);
    }
    for (column, &right) in columns.iter().zip(&rights) {
        for card in &column.cards {
            draw_card(&mut text, column, card, right - column.width);
        }
    }
    for wire in wiring.back_to_front() {
        draw_wire(&mut text, wire, wiring, columns, &rights);
    }
    text.push_str("</g>\n</svg>\n");
    text
}

/// Where the cards of each column end.
fn right_edges(columns: &[Column<'_>], wiring: &Wiring<'_>) -> Vec<i32> {
    let mut x = BORDER;
    let mut rights = Vec::new();
    for (position, column) in columns.iter().enumerate() {
        rights.push(x + MARGIN + column.width);
        x += MARGIN + column.width + wiring.gap_width(position);
    }
    rights
}

fn write_head(text: &mut String, graph: &Graph, width: i32, height: i32) {
    let name = escape(&graph.robot);
    let nodes = graph.cyclers.iter().map(|cycler| cycler.nodes.len()).sum();
    let content = format!(
        "{}, {}, {}",
        plural(graph.cyclers.len(), "cycler"),
        plural(nodes, "node"),
        plural(graph.edges.len(), "edge"),
    );
    let style = include_str!("style.css");
    line(
        text,
        format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"graph\" role=\"img\" \
         viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\">"
        ),
    );
    line(text, format_args!("<title>Robot {name}: {content}</title>"));
    line(text, format_args!("<style>\n{style}</style>"));
    line(
        text,
        format_args!("<rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>"),
    );
    line(
        text,
        format_args!(
            "<text class=\"robot\" x=\"{BORDER}\" y=\"36\">{name} <tspan class=\"faint\">{content}</tspan></text>"
        ),
    );
}

fn draw_column(text: &mut String, column: &Column<'_>, left: i32) {
    let (x, width) = (left - MARGIN, column.width + 2 * MARGIN);
    let height = column.bottom - TOP;
    let name = escape(&column.cycler.name);
    let subtitle = escape(&cards::subtitle(column.cycler));
    line(
        text,
        format_args!(
            "<rect class=\"column\" x=\"{x}\" y=\"{TOP}\" width=\"{width}\" height=\"{height}\" rx=\"10\"/>"
        ),
    );
    line(
        text,
        format_args!(
            "<text class=\"cycler\" x=\"{left}\" y=\"{}\">{name}</text>\
         <text class=\"faint\" x=\"{left}\" y=\"{}\">{subtitle}</text>",
            TOP + 24,
            TOP + COLUMN_TITLE - 12
        ),
    );
}
