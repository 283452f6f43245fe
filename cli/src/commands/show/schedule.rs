//! The order of nodes as text, and why each does not run earlier.

use crate::resolve::robot::Robot;
use crate::schedule::{Reason, Schedule};

/// Each cycler's nodes in the order they run; under a node what it waits for.
pub fn text(robot: &Robot, schedule: &Schedule) -> String {
    let mut text = String::new();
    for (cycler, order) in robot.cyclers.iter().zip(&schedule.cyclers) {
        text.push_str(&format!("{}\n", cycler.name));
        for (place, &position) in order.order.iter().enumerate() {
            let node = &cycler.nodes[position];
            let mark = if node.setup { " (setup)" } else { "" };
            text.push_str(&format!("  {place} {}{mark}\n", node.path));
            for edge in order.reasons(position) {
                let (before, field) = (&cycler.nodes[edge.from], &node.cycle[edge.field]);
                let kind = match edge.reason {
                    Reason::Input => "Input",
                    Reason::RequiredInput => "RequiredInput",
                    Reason::HistoricInput => "HistoricInput",
                    Reason::CyclerState => "CyclerState",
                };
                let (name, path) = (&field.name, &edge.path);
                text.push_str(&format!(
                    "      after {}: {name} ({kind} \"{path}\")\n",
                    before.path
                ));
            }
        }
    }
    text
}
