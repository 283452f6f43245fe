//! The graph as a picture: a column of cards for each cycler, values as wires beside the columns.
//!
//! A card lists what its node reads and writes, so every wire is named at both ends and needs no
//! label of its own. Wires of one cycler run in the gap on its right, wires between cyclers in the
//! gap between them. Cards stand in run order: a wire upwards is a value of the cycle before.

mod card_text;
mod cards;
mod document;
mod gather;
mod lanes;
mod legend;
mod text;
mod wire_text;
mod wires;

use super::Graph;
use cards::Column;
use wires::Wiring;

/// A self-contained SVG file for browsers and viewers, light or dark like its surroundings.
pub fn render(graph: &Graph) -> String {
    let columns: Vec<Column<'_>> = (0..graph.cyclers.len())
        .map(|position| cards::arrange(graph, position))
        .collect();
    let wiring = Wiring::new(graph, &columns);
    document::draw(graph, &columns, &wiring)
}
