//! From edges to wires: all edges of one kind from one row into one column are one.

use super::cards::{Column, Role, Row};
use super::wires::{End, Way, Wire};
use crate::graph::{EdgeKind, Graph};

pub(super) fn gather<'g>(graph: &'g Graph, columns: &[Column<'g>]) -> Vec<Wire<'g>> {
    let mut wires: Vec<Wire<'g>> = Vec::new();
    for edge in &graph.edges {
        let (from, to) = (&edge.from, &edge.to);
        let from = find(columns, &from.cycler, &from.node, |row| {
            row.role == Role::Writes && written(row, edge.kind) == Some(&from.output)
        });
        let to = find(columns, &to.cycler, &to.node, |row| {
            matches!(row.role, Role::FromLeft | Role::FromRight) && row.field.name == to.field
        });
        let (Some(from), Some(to)) = (from, to) else {
            continue;
        };
        let same = wires.iter_mut().find(|wire| {
            wire.from == from && wire.kind == edge.kind && wire.to[0].column == to.column
        });
        match same {
            Some(wire) if wire.to.contains(&to) => {}
            Some(wire) => wire.to.push(to),
            None => {
                let source = (&*edge.from.cycler, &*edge.from.node, &*edge.from.output);
                let way = Way::Own { lane: 0 };
                wires.push(Wire {
                    kind: edge.kind,
                    source,
                    from,
                    to: vec![to],
                    way,
                });
            }
        }
    }
    wires
}

/// What a row gives to edges of this kind.
fn written<'r>(row: &'r Row<'_>, kind: EdgeKind) -> Option<&'r str> {
    match (row.field.kind == "CyclerState", kind == EdgeKind::State) {
        (true, true) => row.field.path.as_deref(),
        (false, false) => Some(&row.field.name),
        _ => None,
    }
}

fn find(
    columns: &[Column<'_>],
    cycler: &str,
    node: &str,
    is_it: impl Fn(&Row<'_>) -> bool,
) -> Option<End> {
    let column = columns
        .iter()
        .position(|column| column.cycler.name == cycler)?;
    let cards = &columns[column].cards;
    let card = cards.iter().position(|card| card.node.path == node)?;
    let row = cards[card].rows.iter().position(is_it)?;
    Some(End { column, card, row })
}
