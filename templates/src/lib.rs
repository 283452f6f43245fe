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
