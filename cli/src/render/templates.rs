//! Files that are no Rust: `Cargo.toml` and `DATAFLOW.md`, from templates.

use minijinja::syntax::SyntaxConfig;
use minijinja::value::Serde;
use minijinja::{Environment, UndefinedBehavior};
use serde::Serialize;

use crate::model::{Dataflow, Package};

/// `Cargo.toml` of the generated crate.
pub(super) fn render_package(package: &Package) -> String {
    render_template("Cargo.toml", templates::generated::CARGO_TOML, package)
}

/// `DATAFLOW.md`.
pub(super) fn render_dataflow(dataflow: &Dataflow) -> String {
    render_template("DATAFLOW.md", templates::generated::DATAFLOW_MD, dataflow)
}

/// A text from a template.
///
/// # Panics
/// On a template that names what is not there: templates are part of hulkgen.
pub fn render_template(name: &str, template: &str, context: &impl Serialize) -> String {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    let syntax = SyntaxConfig::builder()
        .keep_trailing_newline(true)
        .trim_blocks(true)
        .lstrip_blocks(true)
        .build()
        .expect("only white space differs from the default syntax");
    environment.set_syntax(syntax);
    environment.set_auto_escape_callback(|_| minijinja::AutoEscape::None);
    environment
        .render_named_str(name, template, Serde(context))
        .unwrap_or_else(|error| panic!("hulkgen's own template is wrong: {error:#}"))
}
