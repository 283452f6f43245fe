//! The order of nodes as text and JSON, and why each does not run earlier.

use serde_json::{Value, json};

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
                let kind = edge.reason.kind();
                let (name, path) = (&field.name, &edge.path);
                let why = match edge.reason {
                    Reason::Manifest => ", both write it: by the order of the manifest",
                    _ => "",
                };
                text.push_str(&format!(
                    "      after {}: {name} ({kind} \"{path}\"{why})\n",
                    before.path
                ));
            }
        }
    }
    text
}

/// Each cycler's nodes in the order they run, each with the fields that make it wait.
pub fn to_json(robot: &Robot, schedule: &Schedule) -> Value {
    let cyclers = robot.cyclers.iter().zip(&schedule.cyclers);
    let cyclers = cyclers.map(|(cycler, order)| {
        let nodes = order.order.iter().enumerate().map(|(place, &position)| {
            let node = &cycler.nodes[position];
            let after = order.reasons(position).map(|edge| {
                let mut after = json!({
                    "node": cycler.nodes[edge.from].path,
                    "field": node.cycle[edge.field].name,
                    "kind": edge.reason.kind(),
                    "path": edge.path,
                });
                if edge.reason == Reason::Manifest {
                    after["by"] = "manifest".into();
                }
                after
            });
            json!({
                "node": node.path,
                "order": place,
                "setup": node.setup,
                "after": after.collect::<Vec<_>>(),
            })
        });
        json!({ "cycler": cycler.name, "nodes": nodes.collect::<Vec<_>>() })
    });
    cyclers.collect()
}
