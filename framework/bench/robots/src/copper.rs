//! The same work as a graph of copper: two sources, 57 tasks that read two blocks and write one, a sink.

use std::fmt::Write as _;

const TASKS: usize = 60;

/// Its configurations, by their paths in the folder of the crate that compiles them.
pub(crate) fn files() -> [(&'static str, String); 2] {
    [
        ("quiet.ron", configuration(false)),
        ("logging.ron", configuration(true)),
    ]
}

fn configuration(logs: bool) -> String {
    let mut text = format!(
        "// Written by the program in `robots`.\n(\n    \
         logging: (enable_task_logging: {logs}, enable_keyframe_logging: {logs}),\n    tasks: [\n"
    );
    for index in 0..TASKS {
        let kind = match index {
            0 | 1 => "Source",
            index if index + 1 == TASKS => "Sink",
            _ => "Node",
        };
        writeln!(text, "        (id: \"task{index:02}\", type: \"{kind}\"),").expect("a String");
    }
    text += "    ],\n    cnx: [\n";
    for index in 2..TASKS {
        // As the nodes do; where both would be the same one, copper needs another.
        let left = index - 1;
        let right = if index / 2 == left { 0 } else { index / 2 };
        for from in [left, right] {
            writeln!(
                text,
                "        (src: \"task{from:02}\", dst: \"task{index:02}\", msg: \"Block\"),"
            )
            .expect("a String");
        }
    }
    text + "    ],\n)\n"
}
