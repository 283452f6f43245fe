//! 61 nodes that do next to nothing; everything they write is published, and four perception instances have no news.

use crate::node::{Field, Node, Output, Type};
use crate::robot::{Cycler, Robot};

const NODES: usize = 61;

pub(crate) fn robot() -> Robot {
    Robot {
        name: "trivial",
        nodes_of: "trivial",
        purpose: "61 trivial nodes, all of whose outputs others read, beside four perception instances.",
        cyclers: vec![
            perception(
                "Vision",
                "kind = \"perception\"\ninstances = [\"Top\", \"Bottom\"]\n",
                Vec::new(),
            ),
            perception("Audio", "kind = \"perception\"\n", Vec::new()),
            perception(
                "Network",
                "kind = \"perception\"\n",
                (0..NODES).map(foreign).collect(),
            ),
            Cycler {
                name: "Control",
                keys: "kind = \"real-time\"\n",
                nodes: (0..NODES).map(node).collect(),
            },
        ],
    }
}

fn block(name: String) -> Output {
    Output {
        name,
        kind: Type::Block(16),
    }
}

fn output(index: usize) -> Output {
    block(format!("block{index:02}"))
}

/// Reads the one before it and another one.
fn node(index: usize) -> Node {
    let input = |name: &str, of| Field::Input {
        name: name.to_owned(),
        of: output(of),
    };
    let mut fields = Vec::new();
    if index > 0 {
        fields.push(input("left", index - 1));
        fields.push(input("right", index / 2));
    }
    let instances = ["VisionTop", "VisionBottom", "Audio", "Network"];
    if index > 0 && index.is_multiple_of(15) {
        let instance = instances[index / 15 - 1];
        fields.push(Field::Perception {
            name: "perceived".to_owned(),
            instance,
            of: seen(match index / 15 {
                1 | 2 => "Vision",
                _ => instance,
            }),
        });
    }
    Node {
        name: format!("node{index:02}"),
        fields,
        outputs: vec![output(index)],
    }
}

fn seen(cycler: &str) -> Output {
    block(format!("seen_by_{}", cycler.to_lowercase()))
}

/// A setup node, and a node whose output `Control` consumes.
fn perception(name: &'static str, keys: &'static str, mut fields: Vec<Field>) -> Cycler {
    let start = block(format!("start_of_{}", name.to_lowercase()));
    fields.push(Field::Input {
        name: "start".to_owned(),
        of: start.clone(),
    });
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
                outputs: vec![seen(name)],
            },
        ],
    }
}

fn foreign(index: usize) -> Field {
    Field::Foreign {
        name: format!("of_control{index:02}"),
        instance: "Control",
        of: output(index),
    }
}
