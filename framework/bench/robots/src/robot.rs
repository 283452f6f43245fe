//! A robot: its cyclers, their nodes, and every file of it that people would write.

use std::fmt::Write as _;

use crate::by_hand;
use crate::node::{Field, Node};

/// What is written for one robot.
pub(crate) struct Robot {
    pub(crate) name: &'static str,
    /// The robot whose folder has the nodes: another one may have the same.
    pub(crate) nodes_of: &'static str,
    /// What it is there to show, for the manifest.
    pub(crate) purpose: &'static str,
    pub(crate) cyclers: Vec<Cycler>,
}

/// A cycler as the manifest has it; its first node is its setup node.
pub(crate) struct Cycler {
    pub(crate) name: &'static str,
    /// Further lines of the manifest.
    pub(crate) keys: &'static str,
    pub(crate) nodes: Vec<Node>,
}

impl Cycler {
    pub(crate) fn module(&self) -> String {
        let mut name = String::new();
        for character in self.name.chars() {
            if character.is_uppercase() && !name.is_empty() {
                name.push('_');
            }
            name.extend(character.to_lowercase());
        }
        name
    }
}

impl Robot {
    /// Paths relative to the robot's folder, with their texts.
    pub(crate) fn render_files(&self) -> Vec<(String, String)> {
        let mut files = vec![
            ("hulk.toml".to_owned(), self.manifest()),
            ("parameters/default.toml".to_owned(), self.parameters()),
        ];
        if self.nodes_of != self.name {
            return files;
        }
        files.extend([
            ("nodes/Cargo.toml".to_owned(), self.package()),
            ("nodes/src/lib.rs".to_owned(), self.library()),
            ("by_hand.rs".to_owned(), by_hand::render(self)),
        ]);
        for cycler in &self.cyclers {
            let module = cycler.module();
            let mut modules = format!("//! Nodes of `{}`.\n\n", cycler.name);
            for node in &cycler.nodes {
                writeln!(modules, "pub mod {};", node.name).expect("a String");
                let path = format!("nodes/src/{module}/{}.rs", node.name);
                files.push((path, node.render()));
            }
            files.push((format!("nodes/src/{module}.rs"), modules));
        }
        files
    }

    pub(crate) fn control(&self) -> &Cycler {
        self.cyclers
            .iter()
            .find(|cycler| cycler.name == "Control")
            .expect("every robot that is measured has one")
    }

    fn manifest(&self) -> String {
        let Self {
            name,
            nodes_of,
            purpose,
            ..
        } = self;
        let mut text = format!(
            "# {purpose}\n# Written by the program in `robots`.\n[robot]\nname = \"{name}\"\n\
             generated = \"generated\"\nparameters = \"parameters\"\n"
        );
        for cycler in &self.cyclers {
            let paths: Vec<_> = cycler
                .nodes
                .iter()
                .map(|node| format!("\"{nodes_of}_nodes::{}::{}\"", cycler.module(), node.name))
                .collect();
            let nodes = paths[1..].join(",\n    ");
            write!(
                text,
                "\n[[cycler]]\nname = \"{}\"\n{}setup_nodes = [{}]\nnodes = [\n    {nodes},\n]\n",
                cycler.name, cycler.keys, paths[0]
            )
            .expect("a String");
        }
        text + &format!(
            "\n[[target]]\nname = \"{name}\"\nhardware = \"bench_hardware::Hardware\"\n"
        )
    }

    fn package(&self) -> String {
        format!(
            "[package]\nname = \"{}_nodes\"\nversion.workspace = true\nedition.workspace = true\n\
             rust-version.workspace = true\nlicense.workspace = true\npublish = false\n\n\
             [features]\n# `variants` turns one of them on: without, `cycle` has no attribute.\n\
             called = []\ninlined = []\n\n\
             [dependencies]\nframework.workspace = true\nserde.workspace = true\n\n[lints]\nworkspace = true\n",
            self.name
        )
    }

    fn library(&self) -> String {
        let mut text = format!("//! Nodes of the robot `{}`.\n\n", self.name);
        for cycler in &self.cyclers {
            writeln!(text, "pub mod {};", cycler.module()).expect("a String");
        }
        text
    }

    fn parameters(&self) -> String {
        let mut text = "# Written by the program in `robots`.\n".to_owned();
        for node in self.cyclers.iter().flat_map(|cycler| &cycler.nodes) {
            let mut names = node.fields.iter().filter_map(|field| match field {
                Field::Parameter { name } => Some(name),
                _ => None,
            });
            if let Some(first) = names.next() {
                writeln!(text, "\n[{}]\n{first} = 0.25", node.name).expect("a String");
                names.for_each(|name| writeln!(text, "{name} = 0.25").expect("a String"));
            }
        }
        text + &format!("\n[hardware.{}]\n", self.name)
    }
}
