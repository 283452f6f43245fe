//! The mix of fields of a real body's cycler, with nodes that do next to nothing.
//!
//! `Control` has 58 nodes, 188 inputs of which 8 are required, 88 outputs of which 10 are lists, 62 additional outputs,
//! 165 parameters, 20 fields of cycler states, 15 perception and 8 historic inputs.

use crate::node::{Field, Node, Output, Type};
use crate::robot::{Cycler, Robot};

const NODES: usize = 58;
/// Nodes with a second output, ...
const SECOND_OUTPUTS: usize = 30;
/// ... a fourth input, a third parameter, a second additional output.
const FOURTH_INPUTS: usize = 17;
const THIRD_PARAMETERS: usize = 51;
const SECOND_ADDITIONAL: usize = 5;
/// Cycler states, each written by one node and read by another.
const STATES: usize = 10;
const REQUIRED: usize = 8;
/// Nodes that perceive or remember, and how many such fields each has.
const PERCEIVING: [(usize, usize); 6] = [(10, 3), (16, 3), (22, 3), (28, 2), (34, 2), (40, 2)];
const REMEMBERING: [(usize, usize); 4] = [(12, 2), (24, 2), (36, 2), (48, 2)];
/// Outputs that others read, as a few of a real robot are.
const READ_BY_VISION: [usize; 6] = [0, 6, 12, 18, 24, 57];

/// For a hot loop: history reaches as many cycles back as a robot's does in a second.
pub(crate) fn robot() -> Robot {
    of(
        "mix",
        "The mix of fields of a real body's cycler, beside four perception instances.",
        "kind = \"real-time\"\ndeadline = \"12ms\"\nhistory = \"400us\"\n",
    )
}

/// For the pace of a robot.
pub(crate) fn robot_at_83_hz() -> Robot {
    of(
        "mix_at_83_hz",
        "The robot `mix` with a second of history.",
        "kind = \"real-time\"\ndeadline = \"12ms\"\nhistory = \"1s\"\n",
    )
}

fn of(name: &'static str, purpose: &'static str, keys: &'static str) -> Robot {
    Robot {
        name,
        nodes_of: "mix",
        purpose,
        cyclers: vec![
            vision(),
            perception("Audio", "kind = \"perception\"\n", Vec::new()),
            perception("Network", "kind = \"perception\"\n", Vec::new()),
            Cycler {
                name: "Control",
                keys,
                nodes: (0..NODES).map(node).collect(),
            },
        ],
    }
}

fn named(name: String, kind: Type) -> Output {
    Output { name, kind }
}

/// Lists are every sixth first output, three of them returned by value.
fn first_output(index: usize) -> Output {
    let kind = match (index % 6, index) {
        (5, 11 | 29 | 47) => Type::ReturnedList,
        (5, _) => Type::List,
        (1, _) => Type::Maybe,
        (2, _) => Type::Block(24),
        (3, _) => Type::Block(8),
        _ => Type::Block(16),
    };
    named(format!("first{index:02}"), kind)
}

fn second_output(index: usize) -> Output {
    let kind = match index {
        // The tenth list; nine first outputs are lists.
        29 => Type::List,
        index if index % 3 == 0 => Type::Block(20),
        _ => Type::Block(12),
    };
    named(format!("second{index:02}"), kind)
}

fn node(index: usize) -> Node {
    let mut fields = Vec::new();
    if index > 0 {
        add_inputs(index, &mut fields);
        add_others(index, &mut fields);
    }
    let mut outputs = vec![first_output(index)];
    if index < SECOND_OUTPUTS {
        outputs.push(second_output(index));
    }
    Node {
        name: format!("node{index:02}"),
        fields,
        outputs,
    }
}

fn add_inputs(index: usize, fields: &mut Vec<Field>) {
    let inputs = 3 + usize::from(index <= FOURTH_INPUTS);
    for number in 0..inputs {
        let name = format!("input{number}");
        // From near and from far, as real nodes do.
        let from = match number {
            0 => index - 1,
            1 => index / 2,
            2 => index * 2 / 3,
            _ => index.saturating_sub(3),
        };
        let second = number == 2 && from < SECOND_OUTPUTS;
        let of = if second {
            second_output(from)
        } else {
            first_output(from)
        };
        let is_required = number == 0 && of.kind == Type::Maybe && index / 6 < REQUIRED;
        fields.push(match is_required {
            true => Field::Required { name, of },
            false => Field::Input { name, of },
        });
    }
}

fn add_others(index: usize, fields: &mut Vec<Field>) {
    let parameters = 2 + usize::from(index <= THIRD_PARAMETERS);
    for name in ["gain", "limit", "rate"].into_iter().take(parameters) {
        fields.push(Field::Parameter {
            name: name.to_owned(),
        });
    }
    let name = "phase".to_owned();
    match index % 4 {
        2 if index / 4 < STATES => fields.push(Field::State { name }),
        3 if index / 4 < STATES => fields.push(Field::StateOf {
            name,
            node: format!("node{:02}", index - 1),
        }),
        _ => {}
    }
    let sources = [
        ("VisionTop", ball()),
        ("VisionBottom", ball()),
        ("Vision", lines()),
        ("Audio", perceived("Audio")),
        ("Network", perceived("Network")),
        ("Vision", ball()),
    ];
    let count = |table: &[(usize, usize)]| {
        let found = table.iter().find(|(node, _)| *node == index);
        found.map_or(0, |(_, count)| *count)
    };
    for number in 0..count(&PERCEIVING) {
        let (instance, of) = sources[(index / 6 * 3 + number) % sources.len()].clone();
        fields.push(Field::Perception {
            name: format!("perceived{number}"),
            instance,
            of,
        });
    }
    for number in 0..count(&REMEMBERING) {
        fields.push(Field::Historic {
            name: format!("past{number}"),
            of: first_output([4, 10][number]),
        });
    }
    fields.push(Field::Additional {
        name: "detail".to_owned(),
    });
    if index <= SECOND_ADDITIONAL {
        fields.push(Field::Additional {
            name: "residual".to_owned(),
        });
    }
}

fn ball() -> Output {
    named("candidate".to_owned(), Type::Maybe)
}

fn lines() -> Output {
    named("lines".to_owned(), Type::List)
}

fn perceived(cycler: &str) -> Output {
    named(
        format!("seen_by_{}", cycler.to_lowercase()),
        Type::Block(16),
    )
}

/// A setup node, and a node that others consume.
fn perception(name: &'static str, keys: &'static str, mut fields: Vec<Field>) -> Cycler {
    let start = named(format!("start_of_{}", name.to_lowercase()), Type::Block(16));
    fields.push(Field::Input {
        name: "start".to_owned(),
        of: start.clone(),
    });
    let outputs = match name {
        "Vision" => vec![ball(), lines()],
        _ => vec![perceived(name)],
    };
    Cycler {
        name,
        keys,
        nodes: vec![
            Node {
                name: "start".to_owned(),
                fields: Vec::new(),
                outputs: vec![start],
            },
            Node {
                name: "perceive".to_owned(),
                fields,
                outputs,
            },
        ],
    }
}

fn vision() -> Cycler {
    let of_control = READ_BY_VISION.map(|index| Field::Foreign {
        name: format!("of_control{index:02}"),
        instance: "Control",
        of: first_output(index),
    });
    perception(
        "Vision",
        "kind = \"perception\"\ninstances = [\"Top\", \"Bottom\"]\n",
        of_control.into(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mix_is_that_of_a_real_cycler() {
        let robot = robot();
        let nodes = &robot.control().nodes;
        let fields: Vec<_> = nodes.iter().flat_map(|node| &node.fields).collect();
        let outputs: Vec<_> = nodes.iter().flat_map(|node| &node.outputs).collect();
        let count = |is: fn(&Field) -> bool| fields.iter().filter(|field| is(field)).count();
        let lists = outputs
            .iter()
            .filter(|output| matches!(output.kind, Type::List | Type::ReturnedList));
        assert_eq!((nodes.len(), outputs.len(), lists.count()), (58, 88, 10));
        assert_eq!(count(|field| matches!(field, Field::Required { .. })), 8);
        assert_eq!(count(|field| matches!(field, Field::Input { .. })), 180);
        assert_eq!(count(|field| matches!(field, Field::Additional { .. })), 62);
        assert_eq!(count(|field| matches!(field, Field::Parameter { .. })), 165);
        assert_eq!(count(|field| matches!(field, Field::Perception { .. })), 15);
        assert_eq!(count(|field| matches!(field, Field::Historic { .. })), 8);
        let states = |field: &Field| matches!(field, Field::State { .. } | Field::StateOf { .. });
        assert_eq!(count(states), 20);
    }
}
