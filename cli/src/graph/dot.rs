//! The graph in the language of Graphviz: a cluster for each cycler, nodes in run order.

use super::lines::line;
use super::{Cycler, EdgeKind, Graph, Node};

/// The text for `dot -Tsvg`.
pub fn render(graph: &Graph) -> String {
    let mut text = String::new();
    line(
        &mut text,
        format_args!("digraph {} {{", quote(&graph.robot)),
    );
    text.push_str(
        "    rankdir=TB;\n    node [shape=box, style=rounded, fontname=\"monospace\"];\n    \
         edge [fontname=\"monospace\", fontsize=10];\n",
    );
    for cycler in &graph.cyclers {
        write_cycler(&mut text, cycler);
    }
    for bundle in graph.bundles() {
        let (from, to) = (identifier(bundle.from), identifier(bundle.to));
        let label = quote(&bundle.labels.join("\n"));
        let style = style(bundle.kind);
        line(
            &mut text,
            format_args!("    {from} -> {to} [label={label}, {style}];"),
        );
    }
    text.push_str("}\n");
    text
}

fn write_cycler(text: &mut String, cycler: &Cycler) {
    let label = format!(
        "{} ({})\n{}",
        cycler.name,
        cycler.kind_in_words(),
        cycler.instances.join(", ")
    );
    line(
        text,
        format_args!(
            "    subgraph {} {{",
            quote(&format!("cluster_{}", cycler.name))
        ),
    );
    line(text, format_args!("        label={};", quote(&label)));
    for node in cycler.in_run_order() {
        let identifier = identifier((cycler, node));
        let label = quote(&format!("{} {}", node.order, node.path));
        let style = if node.setup {
            ", style=\"rounded,bold\""
        } else {
            ""
        };
        line(
            text,
            format_args!("        {identifier} [label={label}{style}];"),
        );
    }
    line(text, format_args!("    }}"));
}

fn style(kind: EdgeKind) -> &'static str {
    match kind {
        EdgeKind::Input => "style=solid",
        EdgeKind::Previous => "style=dashed, constraint=false",
        EdgeKind::Historic => "style=solid, color=teal",
        EdgeKind::Latest => "style=bold, color=darkorange",
        EdgeKind::Perception => "style=bold, color=forestgreen",
        EdgeKind::State => "style=dotted, color=purple",
    }
}

fn identifier((cycler, node): (&Cycler, &Node)) -> String {
    quote(&format!("{}/{}", cycler.name, node.path))
}

fn quote(text: &str) -> String {
    format!(
        "\"{}\"",
        text.replace('\\', "\\\\")
            .replace('"', "\\\"")
            .replace('\n', "\\n")
    )
}
