//! The nodes as text: what each asks for and gives, as its author wrote it.

use grammar::{Field, Signature};
use quote::ToTokens as _;

use crate::manifest::Manifest;
use crate::scan::{self, NodeSource, Sources};
use crate::workspace::Workspace;

/// Node by node in manifest order; one that stands in several cyclers once.
pub fn text(workspace: &Workspace, manifest: &Manifest, sources: &Sources<'_>) -> String {
    let mut sections: Vec<String> = Vec::new();
    let mut seen: Vec<&str> = Vec::new();
    for entry in manifest.cyclers.iter().flat_map(|cycler| &cycler.nodes) {
        let path = entry.path.as_str();
        if seen.contains(&path) {
            continue;
        }
        seen.push(path);
        if let Some(node) = sources.nodes.get(path) {
            sections.push(node_text(workspace, node));
        }
    }
    sections.join("\n")
}

fn node_text(workspace: &Workspace, node: &NodeSource) -> String {
    let source = workspace.text(&node.module.file).unwrap_or_default();
    let signatures = &node.signatures;
    let mut text = format!(
        "node {}: {} in {}\n",
        node.path, signatures.node, node.module.file
    );
    if let Some(summary) = &node.summary {
        text.push_str(&format!("  {summary}\n"));
    }
    write_section(
        &mut text,
        &source,
        "new",
        Some(&signatures.new),
        &node.creation.fields,
    );
    write_section(
        &mut text,
        &source,
        "cycle",
        Some(&signatures.cycle),
        &node.cycle.fields,
    );
    write_section(&mut text, &source, "outputs", None, &node.outputs.fields);
    if let Some(restore) = &signatures.restore {
        text.push_str(&format!("  restore{}\n", bounds(restore)));
    }
    text
}

fn write_section<K>(
    text: &mut String,
    source: &str,
    title: &str,
    signature: Option<&Signature>,
    fields: &[Field<K>],
) {
    let bounds = signature.map(bounds).unwrap_or_default();
    if fields.is_empty() && bounds.is_empty() {
        return;
    }
    text.push_str(&format!("  {title}{bounds}\n"));
    for field in fields {
        let written = source.get(scan::range(field.span)).unwrap_or_default();
        text.push_str(&format!("    {}: {}\n", field.name, on_one_line(written)));
    }
}

/// A type that its file may break into lines.
fn on_one_line(written: &str) -> String {
    let words: Vec<&str> = written.split_whitespace().collect();
    words
        .join(" ")
        .replace("< ", "<")
        .replace(", >", ">")
        .replace(" >", ">")
}

/// Traits that a function asks of the hardware.
fn bounds(signature: &Signature) -> String {
    let bounds: Vec<String> = (signature.bounds.iter())
        .map(|path| path.to_token_stream().to_string().replace(' ', ""))
        .collect();
    if bounds.is_empty() {
        String::new()
    } else {
        format!(" asks {}", bounds.join(" + "))
    }
}
