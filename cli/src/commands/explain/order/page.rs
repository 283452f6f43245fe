//! The order of two nodes as text.

use super::{Answer, Apart, Order, Step, Why};

/// A section for each cycler that has both nodes, or what lies between their cyclers.
pub(in crate::commands::explain) fn text(answer: &Answer) -> String {
    let orders = answer.orders.iter().map(order);
    let apart = answer.apart.iter().map(apart);
    orders.chain(apart).collect::<Vec<_>>().join("\n")
}

fn order(order: &Order) -> String {
    let Order {
        cycler,
        first,
        second,
        steps,
    } = order;
    let mut text = format!(
        "{} runs before {} in {cycler}, as {} and {}\n",
        first.node, second.node, first.order, second.order
    );
    text.extend(steps.iter().map(step));
    text
}

fn step(step: &Step) -> String {
    let Step { before, after, why } = step;
    match why {
        Why::Field {
            field,
            kind,
            path,
            file,
            line,
        } => {
            let noun = if *kind == "CyclerState" {
                "the state "
            } else {
                ""
            };
            format!("  {after} reads {noun}{path} of {before}: {field} ({kind}, {file}:{line})\n")
        }
        Why::Writers {
            field,
            path,
            file,
            line,
        } => format!(
            "  {after} writes the state {path} as {before} does: {field} (CyclerState, {file}:{line}); \
             {before} stands first in hulk.toml\n"
        ),
        Why::Setup => {
            format!("  {before} is a setup node, {after} is none: setup nodes run first\n")
        }
        Why::Manifest => {
            format!("  nothing orders {before} and {after}: {before} stands first in hulk.toml\n")
        }
    }
}

fn apart(apart: &Apart) -> String {
    let [a, b] = &apart.nodes;
    let [first, second] = &apart.cyclers;
    let mut text = format!(
        "{a} is in {first} and {b} in {second}: nothing orders nodes of different cyclers\n"
    );
    for edge in &apart.edges {
        let owner = edge.from.instance.as_ref().unwrap_or(&edge.from.cycler);
        text.push_str(&format!(
            "  {} reads {owner}.{} ({}): {}\n",
            edge.to.node,
            edge.from.output,
            edge.kind.word(),
            edge.to.field
        ));
    }
    text
}
