//! The nodes as text and JSON: what each asks for and gives, as its author wrote it.

use grammar::{Field, Signature};
use quote::ToTokens as _;
use serde_json::{Value, json};

use crate::manifest::Manifest;
use crate::scan::{self, NodeSource, Sources};
use crate::workspace::Workspace;

/// Node by node in manifest order; one that stands in several cyclers once.
pub fn text(workspace: &Workspace, manifest: &Manifest, sources: &Sources<'_>) -> String {
    let sections = once_each(manifest, sources);
    let sections = sections.into_iter().map(|node| node_text(workspace, node));
    sections.collect::<Vec<_>>().join("\n")
}

/// The same nodes with the same fields.
pub fn to_json(workspace: &Workspace, manifest: &Manifest, sources: &Sources<'_>) -> Value {
    let nodes = once_each(manifest, sources).into_iter().map(|node| {
        let source = workspace.text(&node.module.file).unwrap_or_default();
        let signatures = &node.signatures;
        json!({
            "node": node.path,
            "type": signatures.node.to_string(),
            "file": node.module.file,
            "summary": node.summary,
            "new": fields_to_json(&source, &node.creation.fields),
            "cycle": fields_to_json(&source, &node.cycle.fields),
            "outputs": fields_to_json(&source, &node.outputs.fields),
            "asks": {
                "new": bound_names(&signatures.new),
                "cycle": bound_names(&signatures.cycle),
                "restore": signatures.restore.as_ref().map(bound_names),
            },
        })
    });
    nodes.collect()
}

fn fields_to_json<K>(source: &str, fields: &[Field<K>]) -> Vec<Value> {
    let fields = fields.iter().map(|field| {
        let written = source.get(scan::range(field.span)).unwrap_or_default();
        json!({ "name": field.name.to_string(), "type": on_one_line(written) })
    });
    fields.collect()
}

fn once_each<'s>(manifest: &Manifest, sources: &'s Sources<'_>) -> Vec<&'s NodeSource> {
    let mut nodes: Vec<&NodeSource> = Vec::new();
    for entry in manifest.cyclers.iter().flat_map(|cycler| &cycler.nodes) {
        let node = sources.nodes.get(entry.path.as_str());
        nodes.extend(node.filter(|node| !nodes.iter().any(|one| one.path == node.path)));
    }
    nodes
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
    let bounds = bound_names(signature);
    if bounds.is_empty() {
        String::new()
    } else {
        format!(" asks {}", bounds.join(" + "))
    }
}

fn bound_names(signature: &Signature) -> Vec<String> {
    (signature.bounds.iter())
        .map(|path| path.to_token_stream().to_string().replace(' ', ""))
        .collect()
}
