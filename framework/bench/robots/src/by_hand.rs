//! The same nodes with the same contexts, called one after the other without any framework.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::node::{Field, LIST, Node, Output, Type};
use crate::robot::Robot;

/// A file for `include!`, where `nodes` is the crate of the nodes.
pub(crate) fn render(robot: &Robot) -> String {
    let nodes = &robot.control().nodes;
    let modules: Vec<_> = nodes.iter().map(|node| node.name.as_str()).collect();
    let mut text = format!(
        "// The cycler `Control` of the robot `{}`, by hand. Written by the program in `robots`.\n\n\
         use nodes::control::{{{}}};\n\n",
        robot.name,
        modules.join(", ")
    );
    text += &structure(
        "Nodes",
        "its nodes",
        nodes.iter().map(|node| {
            (
                node.name.clone(),
                format!("{}::{}", node.name, node.structure()),
            )
        }),
    );
    let outputs = nodes.iter().flat_map(|node| &node.outputs);
    text += "#[derive(Default)]\n";
    text += &structure(
        "Outputs",
        "what they write",
        outputs.map(|output| (output.name.clone(), output.kind.name())),
    );
    text += "#[derive(Default)]\n";
    text += &structure(
        "Additional",
        "what they write for listeners",
        kept(nodes, "additional"),
    );
    text += "#[derive(Default)]\n";
    text += &structure("States", "what they keep", kept(nodes, "state"));
    text += &structure("Parameters", "what sets them", kept(nodes, "parameter"));
    let timed = |kind: Type| format!("Vec<(framework::Timestamp, &'static {})>", kind.name());
    let perceived = perceived(nodes);
    text += &structure(
        "Perceived",
        "what one cycle perceives",
        perceived
            .iter()
            .map(|(name, (_, kind))| (name.clone(), timed(*kind))),
    );
    let remembered = remembered(nodes);
    text += &structure(
        "Remembered",
        "what was in the past",
        remembered
            .iter()
            .map(|(name, kind)| (name.clone(), timed(*kind))),
    );
    text += "/// The cycler by hand.\npub(crate) struct Hand {\n\
             nodes: Nodes,\noutputs: Outputs,\nadditional: Additional,\nstates: States,\n\
             parameters: Parameters,\nremembered: Remembered,\nnumber: u64,\n}\n\n";
    text += &creation(nodes, &perceived, &remembered);
    text += "impl Hand {\n/// One cycle.\n#[inline(never)]\n\
             pub(crate) fn cycle(&mut self, perceived: &Perceived, cycle_time: framework::CycleTime) -> framework::Result<()> {\n\
             self.number += 1;\n";
    for node in nodes {
        writeln!(text, "self.{}(perceived, cycle_time)?;", node.name).expect("a String");
    }
    text += "Ok(())\n}\n";
    for node in nodes {
        write!(
            text,
            "\n#[inline]\nfn {}(&mut self, perceived: &Perceived, cycle_time: framework::CycleTime) -> framework::Result<()> {{\n\
             let _ = (perceived, cycle_time);\n{}Ok(())\n}}\n",
            node.name,
            call(node)
        )
        .expect("a String");
    }
    text + "}\n"
}

fn structure(name: &str, what: &str, fields: impl Iterator<Item = (String, String)>) -> String {
    let mut text = format!("/// By hand: {what}.\npub(crate) struct {name} {{\n");
    for (field, kind) in fields {
        writeln!(text, "pub(crate) {field}: {kind},").expect("a String");
    }
    text + "}\n\n"
}

/// Fields of one sort as `node_field` and their types.
fn kept<'a>(nodes: &'a [Node], sort: &'a str) -> impl Iterator<Item = (String, String)> + 'a {
    nodes.iter().flat_map(move |node| {
        node.fields.iter().filter_map(move |field| {
            let (own, name, kind) = match field {
                Field::Parameter { name } => ("parameter", name, "f32"),
                Field::State { name } => ("state", name, "f32"),
                Field::Additional { name } => {
                    ("additional", name, "framework::AdditionalSlot<[f32; 16]>")
                }
                _ => return None,
            };
            (own == sort).then(|| (format!("{}_{name}", node.name), kind.to_owned()))
        })
    })
}

fn perceived_name(instance: &str, of: &Output) -> String {
    format!("{}_{}", instance.to_lowercase(), of.name)
}

fn perceived(nodes: &[Node]) -> BTreeMap<String, (&'static str, Type)> {
    let fields = nodes.iter().flat_map(|node| &node.fields);
    fields
        .filter_map(|field| match field {
            Field::Perception { instance, of, .. } => {
                Some((perceived_name(instance, of), (*instance, of.kind)))
            }
            _ => None,
        })
        .collect()
}

fn remembered(nodes: &[Node]) -> BTreeMap<String, Type> {
    let fields = nodes.iter().flat_map(|node| &node.fields);
    fields
        .filter_map(|field| match field {
            Field::Historic { of, .. } => Some((of.name.clone(), of.kind)),
            _ => None,
        })
        .collect()
}

fn sample(kind: Type) -> String {
    match kind {
        Type::Block(length) => format!("[0.25; {length}]"),
        Type::Maybe => "Some([0.25; 4])".to_owned(),
        Type::List | Type::ReturnedList => format!("vec![0.25; {LIST}]"),
    }
}

fn creation(
    nodes: &[Node],
    perceived: &BTreeMap<String, (&str, Type)>,
    remembered: &BTreeMap<String, Type>,
) -> String {
    let leaked = |kind: &Type| format!("&*Box::leak(Box::new({}))", sample(*kind));
    let mut text = "impl Perceived {\n/// So many values of each instance, at these times.\n\
                    pub(crate) fn new(times: impl Fn(&str) -> Vec<framework::Timestamp>) -> Self {\nlet _ = &times;\nSelf {\n".to_owned();
    for (name, (instance, kind)) in perceived {
        let value = leaked(kind);
        writeln!(
            text,
            "{name}: times(\"{instance}\").into_iter().map(|time| (time, {value})).collect(),"
        )
        .expect("a String");
    }
    text += "}\n}\n}\n\nimpl Remembered {\n/// One value for each of these times, oldest first.\n\
             pub(crate) fn new(times: &[framework::Timestamp]) -> Self {\nlet _ = times;\nSelf {\n";
    for (name, kind) in remembered {
        let value = leaked(kind);
        writeln!(
            text,
            "{name}: times.iter().map(|time| (*time, {value})).collect(),"
        )
        .expect("a String");
    }
    text += "}\n}\n}\n\nimpl Hand {\n/// Nodes that were just created.\n\
             pub(crate) fn new(remembered: Remembered) -> framework::Result<Self> {\nOk(Self {\nnodes: Nodes {\n";
    for node in nodes {
        let (name, structure) = (&node.name, node.structure());
        writeln!(
            text,
            "{name}: {name}::{structure}::new({name}::CreationContext {{}})?,"
        )
        .expect("a String");
    }
    text += "},\noutputs: Outputs::default(),\nadditional: Additional::default(),\nstates: States::default(),\nparameters: Parameters {\n";
    for (name, _) in kept(nodes, "parameter") {
        writeln!(text, "{name}: 0.25,").expect("a String");
    }
    text + "},\nremembered,\nnumber: 0,\n})\n}\n}\n\n"
}

/// One node of `Hand::cycle`.
fn call(node: &Node) -> String {
    let name = &node.name;
    let mut text = String::new();
    let mut fields = String::new();
    let mut required = Vec::new();
    for output in node
        .outputs
        .iter()
        .filter(|output| output.kind == Type::List)
    {
        let output = &output.name;
        writeln!(text, "self.outputs.{output}.clear();").expect("a String");
        writeln!(fields, "{output}: &mut self.outputs.{output},").expect("a String");
    }
    if node.reads_time() {
        fields += "cycle_time,\n";
    }
    for field in &node.fields {
        let (field, value) = match field {
            Field::Input { name, of } | Field::Foreign { name, of, .. } => {
                (name, format!("&self.outputs.{}", of.name))
            }
            Field::Required { name, of } => {
                required.push(format!(
                    "let Some({name}) = self.outputs.{}.as_ref()",
                    of.name
                ));
                (name, name.clone())
            }
            Field::Perception { name, instance, of } => {
                let values = perceived_name(instance, of);
                (
                    name,
                    format!("framework::testing::perception(&perceived.{values}, &[])"),
                )
            }
            Field::Historic { name, of } => {
                let of = &of.name;
                (
                    name,
                    format!(
                        "framework::testing::history(&self.remembered.{of}, cycle_time.start, &self.outputs.{of})"
                    ),
                )
            }
            Field::Parameter { name } => (name, format!("&self.parameters.{}_{name}", node.name)),
            Field::State { name } => (name, format!("&mut self.states.{}_{name}", node.name)),
            Field::StateOf { name, node } => (name, format!("&self.states.{node}_{name}")),
            Field::Additional { name } => (
                name,
                format!(
                    "framework::AdditionalOutput::new(false, self.number, &mut self.additional.{}_{name})",
                    node.name
                ),
            ),
        };
        match *field == value {
            true => writeln!(fields, "{field},"),
            false => writeln!(fields, "{field}: {value},"),
        }
        .expect("a String");
    }
    let call = format!("self.nodes.{name}.cycle({name}::CycleContext {{\n{fields}}})?");
    let returned: Vec<_> = node
        .outputs
        .iter()
        .filter(|output| output.kind != Type::List)
        .collect();
    let mut body = match returned.is_empty() {
        true => format!("{call};\n"),
        false => format!("let outputs = {call};\n"),
    };
    for Output { name, .. } in returned {
        writeln!(body, "self.outputs.{name} = outputs.{name}.value;").expect("a String");
    }
    match required.is_empty() {
        true => text + &body,
        false => format!("{text}if {} {{\n{body}}}\n", required.join(" && ")),
    }
}
