//! Explanations of nodes and outputs as text.

use super::parameter;
use super::subject::{Endpoint, NodeSubject, OutputSubject, Subject};
use crate::graph::{Bridge, BridgeKind, Cycler, Edge};

/// A section for each node, output, procedure and parameter of the name.
pub(super) fn of_subject(subject: &Subject<'_>) -> String {
    let nodes = subject.nodes.iter().map(of_node);
    let outputs = subject.outputs.iter().map(of_output);
    let endpoints = subject.endpoints.iter().map(of_endpoint);
    let parameters = subject.parameters.iter().map(parameter::text);
    let bridges = subject.bridges.iter().map(|bridge| of_bridge(bridge));
    let sections = nodes.chain(outputs).chain(endpoints).chain(parameters);
    let sections = sections.chain(bridges);
    sections.collect::<Vec<_>>().join("\n")
}

fn of_node(subject: &NodeSubject<'_>) -> String {
    let NodeSubject { cycler, node, .. } = subject;
    let kind = if node.setup { "setup node" } else { "node" };
    let (place, all) = (node.order, cycler.nodes.len());
    let elsewhere = elsewhere(cycler);
    let mut text = format!(
        "{}: {kind} of {}, runs as {place} of {all} from 0{elsewhere}\n  {} in {}\n",
        node.path, cycler.name, node.type_name, node.file
    );
    if !node.interfaces.is_empty() {
        text.push_str(&format!(
            "  asks the hardware for {}\n",
            node.interfaces.join(", ")
        ));
    }
    for field in node.fields.iter().filter(|field| field.kind == "Parameter") {
        let path = field.path.as_deref().unwrap_or_default();
        text.push_str(&format!("  reads the parameter {path}\n"));
    }
    for edge in &subject.reads {
        let checked = if edge.checked {
            ""
        } else {
            ", type left to rustc"
        };
        let required = if is_required(subject, edge) {
            "required "
        } else {
            ""
        };
        text.push_str(&format!(
            "  reads {} of {}{checked}\n",
            source(edge, required),
            edge.from.node
        ));
    }
    let outputs = node
        .fields
        .iter()
        .filter(|field| field.kind == "MainOutput");
    for field in outputs {
        let readers: Vec<&Edge> = (subject.writes.iter().copied())
            .filter(|edge| edge.from.output == field.name && edge.kind.word() != "state")
            .collect();
        text.push_str(&format!("  writes {}, {}\n", field.name, read_by(&readers)));
    }
    for edge in subject
        .writes
        .iter()
        .filter(|edge| edge.kind.word() == "state")
    {
        let state = &edge.from.output;
        text.push_str(&format!(
            "  writes the state {state}, read by {}\n",
            edge.to.node
        ));
    }
    for field in &node.fields {
        let path = field.path.as_deref().unwrap_or_default();
        match field.kind {
            "AdditionalOutput" => text.push_str(&format!("  writes {path} while subscribed\n")),
            "Procedure" => text.push_str(&format!("  answers the procedure {path}\n")),
            _ => {}
        }
    }
    text
}

fn of_endpoint(endpoint: &Endpoint<'_>) -> String {
    let Endpoint {
        cycler,
        node,
        field,
        name,
    } = endpoint;
    let data = field.data.as_deref().unwrap_or("of unknown type");
    let (what, deed) = match field.kind {
        "Procedure" => ("procedure", "answered"),
        _ => ("additional output", "written while subscribed"),
    };
    format!(
        "{}.{name}: {what}, {data}\n  {deed} by {} ({}:{})\n",
        cycler.name, node.path, node.file, field.line
    )
}

fn of_bridge(bridge: &Bridge) -> String {
    let encoding = match bridge.encoding {
        schema::BridgeEncoding::Json => "JSON",
        schema::BridgeEncoding::Cdr => "CDR",
    };
    let way = match bridge.direction {
        _ if bridge.kind == BridgeKind::Remote => "whoever has the key feeds it".to_owned(),
        None => "queries of it are calls".to_owned(),
        Some(schema::Direction::Out) => format!("its values go out as {encoding}"),
        Some(schema::Direction::In) => format!("it is written from outside, as {encoding}"),
        Some(schema::Direction::Both) => {
            format!("it goes out and is written from outside, as {encoding}")
        }
    };
    let rate =
        (bridge.rate).map_or_else(String::new, |rate| format!(", at most {rate} in a second"));
    format!(
        "{}: bridged to the key {}\n  {way}{rate}\n",
        bridge.path, bridge.key
    )
}

fn of_output(subject: &OutputSubject<'_>) -> String {
    let OutputSubject {
        cycler,
        node,
        field,
        reads,
    } = subject;
    let data = field.data.as_deref().unwrap_or("of unknown type");
    format!(
        "{}.{}: {data}\n  written by {} ({}:{}){}\n  {}\n",
        cycler.name,
        field.name,
        node.path,
        node.file,
        field.line,
        elsewhere(cycler),
        read_by(reads)
    )
}

/// Where it runs, if not on the robot.
fn elsewhere(cycler: &Cycler) -> &'static str {
    if cycler.remote {
        ", on another machine"
    } else {
        ""
    }
}

/// "read by `node` (kind)", each node once for each kind.
fn read_by(edges: &[&Edge]) -> String {
    let mut readers: Vec<String> = Vec::new();
    for edge in edges {
        let reader = format!("{} ({})", edge.to.node, edge.kind.word());
        if !readers.contains(&reader) {
            readers.push(reader);
        }
    }
    match readers.as_slice() {
        [] => "read by no node".to_owned(),
        readers => format!("read by {}", readers.join(", ")),
    }
}

/// Whether the node is skipped where the value is not there.
fn is_required(subject: &NodeSubject<'_>, edge: &Edge) -> bool {
    let mut fields = subject.node.fields.iter();
    fields.any(|field| field.kind == "RequiredInput" && field.name == edge.to.field)
}

fn source(edge: &Edge, required: &str) -> String {
    let output = &edge.from.output;
    let kind = edge.kind.word();
    match &edge.from.instance {
        Some(instance) => format!("{instance}.{output} ({required}{kind})"),
        None => format!("{output} ({required}{kind})"),
    }
}

#[cfg(test)]
mod tests {
    use super::of_subject;
    use crate::commands::explain::Subject;
    use crate::graph::{describe, fixture};

    #[test]
    fn an_input_without_which_a_node_is_skipped_says_so() {
        let mut graph = describe(&fixture::robot(), &fixture::schedule());
        for node in graph
            .cyclers
            .iter_mut()
            .flat_map(|cycler| &mut cycler.nodes)
        {
            let fields = node.fields.iter_mut();
            for field in fields.filter(|field| field.kind == "Input") {
                field.kind = "RequiredInput";
            }
        }
        let page = of_subject(&Subject::find(&graph, "head"));
        assert!(page.contains("reads ball (required input) of"), "{page}");
    }

    fn page(name: &str) -> String {
        let graph = describe(&fixture::robot(), &fixture::schedule());
        of_subject(&Subject::find(&graph, name))
    }

    #[test]
    fn a_node_is_explained_by_path_and_by_module() {
        assert_eq!(page("control::ball_filter"), page("ball_filter"));
        assert_eq!(
            page("ball_filter"),
            "\
control::ball_filter: node of Control, runs as 1 of 4 from 0
  BallFilter in control/src/ball_filter.rs
  reads sensors (historic) of control::sensor_receiver
  reads VisionTop.balls (perception) of vision::ball_detection
  reads VisionBottom.balls (perception) of vision::ball_detection
  writes ball, read by control::head (input)
  writes matrix, read by vision::ball_detection (latest)
  writes the state calibration, read by control::head
"
        );
    }

    #[test]
    fn an_output_is_explained_by_name_cycler_and_instance() {
        let text = "\
Vision.image: types::Image
  written by vision::image_receiver (vision/src/image_receiver.rs:7)
  read by vision::ball_detection (input), control::command_sender (latest)
";
        assert_eq!(page("image"), text);
        assert_eq!(page("Vision.image"), text);
        assert_eq!(page("VisionTop.image"), text);
        assert_eq!(page("Control.image"), "");
    }
}
