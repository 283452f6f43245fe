//! Who reads what between instances, and how many slots that takes.

use super::{InstanceText, OutputText, duration};
use crate::resolve::robot::{Access, CycleBinding, Cycler, InstanceId, Robot};

/// Facts of one instance, and how many slots its buffer has.
pub(super) fn instance_text(robot: &Robot, id: InstanceId) -> InstanceText {
    let cycler = &robot.cyclers[id.cycler];
    let instance = &cycler.instances[id.instance];
    let mut facts = Vec::new();
    if let Some(deadline) = instance.deadline {
        facts.push(format!("deadline {}", duration(deadline)));
    }
    if let Some(policy) = &instance.scheduling.policy {
        let priority = instance.scheduling.priority;
        facts.push(match priority {
            Some(priority) => format!("scheduled {policy} {priority}"),
            None => format!("scheduled {policy}"),
        });
    }
    if !instance.scheduling.cores.is_empty() {
        let cores: Vec<String> = instance
            .scheduling
            .cores
            .iter()
            .map(ToString::to_string)
            .collect();
        facts.push(format!("on cores {}", cores.join(", ")));
    }
    InstanceText {
        name: instance.name.clone(),
        facts,
        slots: slots(robot, id),
    }
}

/// 2 (being written, newest) and one per reader, and the window of each consumer.
fn slots(robot: &Robot, id: InstanceId) -> String {
    let count = |reads: &dyn Fn(&CycleBinding) -> bool| {
        let reading = robot.cyclers.iter().filter(|cycler| {
            cycler
                .nodes
                .iter()
                .flat_map(|node| &node.cycle)
                .any(|field| reads(&field.binding))
        });
        reading.map(|cycler| cycler.instances.len()).sum::<usize>()
    };
    let readers = count(&|binding| latest_of(binding).is_some_and(|(read, _)| *read == id));
    let consumers = count(
        &|binding| matches!(binding, CycleBinding::Perception { instances, .. } if instances.contains(&id)),
    );
    let queue = robot.cyclers[id.cycler].queue;
    let total = 2 + readers + consumers * queue;
    let mut sum = "2".to_owned();
    if readers > 0 {
        sum.push_str(&format!(" + {}", counted(readers, "reader")));
    }
    if consumers > 0 {
        sum.push_str(&format!(" + {} of {queue}", counted(consumers, "window")));
    }
    if sum == "2" {
        sum
    } else {
        format!("{total} = {sum}")
    }
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 {
        format!("1 {what}")
    } else {
        format!("{count} {what}s")
    }
}

/// The newest cycle of which instance is read, and what of it.
fn latest_of(binding: &CycleBinding) -> Option<(&InstanceId, &Access)> {
    match binding {
        CycleBinding::OutputOf {
            instance, access, ..
        }
        | CycleBinding::RequiredOutputOf {
            instance, access, ..
        }
        | CycleBinding::Latest {
            instance, access, ..
        } => Some((instance, access)),
        _ => None,
    }
}

/// Every output that other instances read, with its readers.
pub(super) fn shared_outputs(robot: &Robot, position: usize, cycler: &Cycler) -> Vec<OutputText> {
    let outputs = cycler.outputs.iter().filter(|output| output.shared);
    outputs
        .map(|output| OutputText {
            name: output.name.clone(),
            data: output.data.text.clone(),
            writer: cycler.nodes[output.producer].path.clone(),
            readers: readers(robot, position, &output.name),
        })
        .collect()
}

fn readers(robot: &Robot, producing: usize, output: &str) -> Vec<String> {
    let mut readers = Vec::new();
    for cycler in &robot.cyclers {
        for node in &cycler.nodes {
            let reads = node.cycle.iter().filter_map(|field| match &field.binding {
                CycleBinding::Perception {
                    instances, access, ..
                } => Some((instances.first()?.cycler, access, "in order of time")),
                binding => latest_of(binding).map(|(id, access)| (id.cycler, access, "latest")),
            });
            for (from, access, how) in reads {
                let reader = format!("`{}` in `{}` ({how})", node.path, cycler.name);
                if from == producing
                    && access.segments[0].name == output
                    && !readers.contains(&reader)
                {
                    readers.push(reader);
                }
            }
        }
    }
    readers
}
