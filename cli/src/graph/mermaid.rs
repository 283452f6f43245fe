//! The graph as a Mermaid flowchart: a box for each cycler, nodes in run order, edges with names.

use super::lines::line;
use super::{Cycler, EdgeKind, Graph, Node};

/// The text for a Markdown block of language `mermaid`.
pub fn render(graph: &Graph) -> String {
    let mut text = String::from("flowchart TB\n");
    for cycler in &graph.cyclers {
        write_cycler(&mut text, cycler);
    }
    for bundle in graph.bundles() {
        let label = escape(&bundle.labels.join(", "));
        let arrow = match bundle.kind {
            EdgeKind::Input | EdgeKind::Historic => "-->",
            EdgeKind::Previous | EdgeKind::State => "-.->",
            EdgeKind::Latest | EdgeKind::Perception => "==>",
        };
        let (from, to) = (identifier(bundle.from), identifier(bundle.to));
        line(
            &mut text,
            format_args!("    {from} {arrow}|\"{label}\"| {to}"),
        );
    }
    line(
        &mut text,
        format_args!("    classDef setup stroke-width:3px"),
    );
    text
}

fn write_cycler(text: &mut String, cycler: &Cycler) {
    let (name, kind) = (&cycler.name, cycler.kind_in_words());
    let instances = match cycler.instances.as_slice() {
        [instance] if instance == name => String::new(),
        instances => format!(": {}", instances.join(", ")),
    };
    line(
        text,
        format_args!("    subgraph {name}[\"{name} ({kind}){instances}\"]"),
    );
    for node in cycler.in_run_order() {
        let identifier = identifier((cycler, node));
        let class = if node.setup { ":::setup" } else { "" };
        line(
            text,
            format_args!("        {identifier}[\"{}\"]{class}", escape(&node.path)),
        );
    }
    line(text, format_args!("    end"));
}

fn identifier((cycler, node): (&Cycler, &Node)) -> String {
    format!("{}__{}", cycler.name, node.path.replace("::", "__"))
}

/// Mermaid reads `#…;` inside quotes as a character.
fn escape(text: &str) -> String {
    text.replace('#', "#35;")
        .replace('"', "#quot;")
        .replace('<', "#lt;")
        .replace('>', "#gt;")
}
