//! Templates of everything that hulkgen writes and that is no Rust, embedded so that the binary needs no files.
//!
//! Rendered by minijinja; a template that names something unknown is an error, and only `{% %}` lines vanish.

/// Files of the generated crate.
pub mod generated {
    /// `Cargo.toml`, from hulkgen's model of the package.
    pub const CARGO_TOML: &str = include_str!("../generated/Cargo.toml.jinja");
    /// `DATAFLOW.md`, from hulkgen's model of the data flow.
    pub const DATAFLOW_MD: &str = include_str!("../generated/DATAFLOW.md.jinja");
}

/// Files of nodes that `hulkgen add-node` writes.
pub mod node {
    /// A node that runs in every cycle.
    pub const NODE_RS: &str = include_str!("../node/node.rs.jinja");
    /// A node that waits for the data of a cycle.
    pub const SETUP_NODE_RS: &str = include_str!("../node/setup_node.rs.jinja");
    /// A test from one cycle of a recording.
    pub const CAPTURED_RS: &str = include_str!("../node/captured.rs.jinja");
}

/// Files of a new robot, by path from its root, from its name and where its framework comes from.
pub mod robot {
    /// Of every robot.
    pub const SHARED: &[(&str, &str)] = &[
        (
            ".gitattributes",
            include_str!("../robot/gitattributes.jinja"),
        ),
        (".gitignore", include_str!("../robot/gitignore.jinja")),
        ("README.md", include_str!("../robot/README.md.jinja")),
    ];

    /// Of a robot that begins with a simulated vehicle.
    pub const BLANK: &[(&str, &str)] = &[
        (
            "Cargo.toml",
            include_str!("../robot/blank/Cargo.toml.jinja"),
        ),
        ("hulk.toml", include_str!("../robot/blank/hulk.toml.jinja")),
        (
            "nodes/Cargo.toml",
            include_str!("../robot/blank/nodes/Cargo.toml.jinja"),
        ),
        (
            "nodes/src/control.rs",
            include_str!("../robot/blank/nodes/src/control.rs.jinja"),
        ),
        (
            "nodes/src/control/odometry_receiver.rs",
            include_str!("../robot/blank/nodes/src/control/odometry_receiver.rs.jinja"),
        ),
        (
            "nodes/src/control/speed_choice.rs",
            include_str!("../robot/blank/nodes/src/control/speed_choice.rs.jinja"),
        ),
        (
            "nodes/src/control/wheel_sender.rs",
            include_str!("../robot/blank/nodes/src/control/wheel_sender.rs.jinja"),
        ),
        (
            "nodes/src/interfaces.rs",
            include_str!("../robot/blank/nodes/src/interfaces.rs.jinja"),
        ),
        (
            "nodes/src/lib.rs",
            include_str!("../robot/blank/nodes/src/lib.rs.jinja"),
        ),
        (
            "nodes/src/perception.rs",
            include_str!("../robot/blank/nodes/src/perception.rs.jinja"),
        ),
        (
            "nodes/src/perception/obstacle_detection.rs",
            include_str!("../robot/blank/nodes/src/perception/obstacle_detection.rs.jinja"),
        ),
        (
            "nodes/src/perception/range_receiver.rs",
            include_str!("../robot/blank/nodes/src/perception/range_receiver.rs.jinja"),
        ),
        (
            "nodes/src/types.rs",
            include_str!("../robot/blank/nodes/src/types.rs.jinja"),
        ),
        (
            "parameters/default.toml",
            include_str!("../robot/blank/parameters/default.toml.jinja"),
        ),
        (
            "simulation/Cargo.toml",
            include_str!("../robot/blank/simulation/Cargo.toml.jinja"),
        ),
        (
            "simulation/src/lib.rs",
            include_str!("../robot/blank/simulation/src/lib.rs.jinja"),
        ),
        (
            "simulation/src/vehicle.rs",
            include_str!("../robot/blank/simulation/src/vehicle.rs.jinja"),
        ),
        (
            "simulation/tests/lockstep.rs",
            include_str!("../robot/blank/simulation/tests/lockstep.rs.jinja"),
        ),
    ];
}
