//! The text of every generated file: stage ⑥, from [`RuntimeModel`] to [`GeneratedFiles`].
//!
//! Functions are called after what they return: `quote_*` tokens, `render_*` text.
//!
//! Invariant: decides nothing. What a file says is in the model; here it is only written down.

mod binary;
mod body;
mod context;
mod database;
mod drift_test;
mod imports;
mod instance;
mod layout;
mod nodes;
mod parameters;
mod recording;
mod runtime;
mod spelling;
mod step;
mod structs;
mod templates;

use std::collections::BTreeMap;

use camino::Utf8PathBuf;
use quote::quote;

use crate::model::RuntimeModel;
use spelling::ident;

pub use recording::render_stand_in;
pub use templates::render_template;

/// Text by path relative to the workspace root.
pub type GeneratedFiles = BTreeMap<Utf8PathBuf, String>;

/// Renders every file of the generated crate.
pub fn render(model: &RuntimeModel) -> GeneratedFiles {
    let running = || model.cyclers.iter().map(|cycler| cycler.module.as_str());
    let mut files = BTreeMap::from([
        (
            "Cargo.toml".to_owned(),
            templates::render_package(&model.package),
        ),
        (
            "DATAFLOW.md".to_owned(),
            templates::render_dataflow(&model.dataflow),
        ),
        ("src/lib.rs".to_owned(), render_library(model)),
        (
            "src/parameters.rs".to_owned(),
            parameters::render_parameters(&model.parameters),
        ),
        (
            "src/databases.rs".to_owned(),
            render_modules(
                "What the cyclers write and what their nodes see.",
                running().chain(model.outside.iter().map(|cycler| cycler.module.as_str())),
            ),
        ),
        (
            "src/cyclers.rs".to_owned(),
            render_modules("The nodes of every cycler in order.", running()),
        ),
        ("src/runtime.rs".to_owned(), runtime::render_runtime(model)),
        (
            "src/recording.rs".to_owned(),
            recording::render_recording(model),
        ),
        (
            "tests/drift.rs".to_owned(),
            drift_test::render_drift_test(&model.folder, &model.options),
        ),
    ]);
    for cycler in &model.cyclers {
        let module = &cycler.module;
        files.insert(
            format!("src/databases/{module}.rs"),
            database::render_database(cycler),
        );
        files.insert(
            format!("src/cyclers/{module}.rs"),
            nodes::render_nodes(cycler),
        );
        files.insert(
            format!("src/runtime/{module}.rs"),
            body::render_body(cycler, &model.runtime),
        );
        files.insert(
            format!("src/recording/{module}.rs"),
            recording::render_recorded(model, cycler),
        );
    }
    for cycler in &model.outside {
        files.insert(
            format!("src/databases/{}.rs", cycler.module),
            database::render_outside(cycler),
        );
    }
    if !model.binaries.is_empty() {
        files.insert("graph.json".to_owned(), model.graph.clone());
    }
    for binary in &model.binaries {
        files.insert(
            format!("src/bin/{}.rs", binary.name),
            binary::render_binary(binary),
        );
    }
    files
        .into_iter()
        .map(|(path, text)| (model.folder.join(path), text))
        .collect()
}

/// `lib.rs`: modules in the order in which one reads them.
fn render_library(model: &RuntimeModel) -> String {
    let modules = quote! {
        #[rustfmt::skip]
        pub mod parameters;
        #[rustfmt::skip]
        pub mod databases;
        #[rustfmt::skip]
        pub mod cyclers;
        #[rustfmt::skip]
        pub mod runtime;
        #[rustfmt::skip]
        pub mod recording;
    };
    layout::rust_file(&model.title, &[], modules)
}

/// A file that only lists one module for each cycler, sorted.
fn render_modules<'a>(title: &str, modules: impl Iterator<Item = &'a str>) -> String {
    let mut modules: Vec<&str> = modules.collect();
    modules.sort_unstable();
    let modules = modules.into_iter().map(ident);
    layout::rust_file(title, &[], quote!(#(pub mod #modules;)*))
}

#[cfg(test)]
mod tests;
