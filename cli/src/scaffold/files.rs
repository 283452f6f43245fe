//! Files that hulkgen writes once and people own from then on, from templates.

use serde::Serialize;

use crate::outcome::Refusal;
use crate::render::render_template;

/// What the template of a node is told.
#[derive(Serialize)]
pub(super) struct NodeFile<'a> {
    /// Name of its struct.
    pub(super) type_name: &'a str,
    /// Name of its main output.
    pub(super) output: &'a str,
    /// Nothing else paces its cycler yet.
    pub(super) paces: bool,
}

/// The text of a node's file.
pub(super) fn render_node(node: &NodeFile<'_>, setup: bool) -> String {
    let template = if setup {
        templates::node::SETUP_NODE_RS
    } else {
        templates::node::NODE_RS
    };
    render_template("node", template, node)
}

/// Refuses what cannot be the name of a module that people like to read.
pub(super) fn check_module_name(name: &str) -> Result<(), Refusal> {
    let is_plain = name
        .chars()
        .all(|letter| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '_');
    let begins = name.starts_with(|letter: char| letter.is_ascii_lowercase());
    if is_plain
        && begins
        && schema::is_identifier(name)
        && !["tests", "main", "lib", "mod"].contains(&name)
    {
        return Ok(());
    }
    let refusal = Refusal::wrong_usage(format!("`{name}` cannot be the name of a node's module"));
    Err(if schema::is_identifier(name) && !is_plain {
        refusal.help(format!("write `{}`", schema::snake_case(name)))
    } else {
        refusal.help(
            "write it in snake_case, beginning with a letter, and let it be no keyword of Rust",
        )
    })
}
