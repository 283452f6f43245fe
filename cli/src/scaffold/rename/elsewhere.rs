//! Where an output is named outside of the manifest and the files of nodes: scenarios, captured tests, whatever else.
//!
//! Invariant: only what is certainly the output is changed; all else that may be it is listed.

use std::collections::BTreeSet;
use std::ops::Range;

use camino::{Utf8Path, Utf8PathBuf};
use serde_json::Value;
use syn::visit::{self, Visit};
use toml::de::{DeTable, DeValue};

use super::super::{leftovers, uses};
use super::{Edits, MAIN_OUTPUTS, Rename, behind_name};
use crate::diagnostics::position;
use crate::manifest::without_dots;
use crate::resolve::robot::Robot;
use crate::scan::{parse, range};
use crate::workspace::{MANIFEST, RUNS, Workspace, says_generated};

/// Endings of files in which people write paths of clients.
const ENDINGS: [&str; 11] = [
    "html", "ipynb", "js", "json", "md", "py", "rs", "sh", "toml", "ts", "yaml",
];

/// What the head of a captured test says.
const CAPTURED: &str = "Written by `hulkgen capture`";

/// The output that is looked for.
pub(super) struct Sought<'a> {
    pub(super) workspace: &'a Workspace,
    pub(super) robot: &'a Robot,
    pub(super) rename: &'a Rename<'a>,
    /// Path of the node that writes it, and its struct that has the field.
    pub(super) producer: &'a str,
    pub(super) structure: &'a str,
    /// Names of the instances that have it.
    pub(super) instances: Vec<&'a str>,
    /// The files of the node itself, which are done.
    pub(super) own: BTreeSet<Utf8PathBuf>,
}

/// Files and lines that may name the output.
pub(super) type Unclear = BTreeSet<(Utf8PathBuf, usize)>;

impl Sought<'_> {
    /// Adds every certain place to the edits; answers with all others.
    pub(super) fn find(&self, edits: &mut Edits) -> Unclear {
        let mut unclear = Unclear::new();
        for file in self.code() {
            self.look_at_code(&file, edits, &mut unclear);
        }
        for file in self.texts() {
            self.look_at_text(&file, edits, &mut unclear);
        }
        unclear
    }

    /// Files of the robot in which paths may stand; below a folder with a manifest of its own is another robot. What runs
    /// left behind stays as it was, and so do packages of others.
    fn texts(&self) -> Vec<Utf8PathBuf> {
        let mut files = self.workspace.files_below(Utf8Path::new(""));
        let manifests = files
            .iter()
            .filter(|file| file.file_name() == Some(MANIFEST));
        let others: Vec<Utf8PathBuf> = manifests
            .filter_map(|file| file.parent())
            .filter(|folder| !folder.as_str().is_empty())
            .map(Utf8Path::to_owned)
            .collect();
        files.retain(|file| {
            let is_other = |folder: &Utf8PathBuf| file.starts_with(folder);
            let ending = file.extension().unwrap_or_default();
            let is_foreign = file
                .components()
                .any(|part| part.as_str() == "node_modules");
            ENDINGS.contains(&ending)
                && !is_foreign
                && !file.starts_with(RUNS)
                && file.as_str() != MANIFEST
                && !file.starts_with(&self.robot.generated)
                && !others.iter().any(is_other)
        });
        files
    }

    /// Other code of the workspace's crates.
    fn code(&self) -> BTreeSet<Utf8PathBuf> {
        let members = self.workspace.members().libraries();
        let folders = members.map(|member| without_dots(&member.folder));
        let files = folders.flat_map(|folder| self.workspace.files_below(&folder));
        let is_other = |file: &Utf8PathBuf| {
            file.extension() == Some("rs")
                && !file.starts_with(&self.robot.generated)
                && !self.own.contains(file)
        };
        files.filter(is_other).collect()
    }

    fn look_at_code(&self, file: &Utf8Path, edits: &mut Edits, unclear: &mut Unclear) {
        let Ok(text) = self.workspace.read(file) else {
            return;
        };
        // Most files do not even have the word.
        if !text.contains(self.rename.old) || says_generated(&text) {
            return;
        }
        let Ok(syntax) = parse(&text) else {
            return;
        };
        let runtime = format!("{}_runtime", self.robot.name);
        let of_node = leftovers::names(self.workspace, file, &syntax, self.producer);
        if !of_node && !text.contains(&runtime) {
            return;
        }
        let uses = uses::find(&syntax, self.structure, self.rename.old);
        let data = text.contains(CAPTURED).then(|| self.captured_data(file));
        if let Some(Some((data, place))) = data {
            let mut edit = |file: &Utf8Path, place: Range<usize>, text: String| {
                let edits = edits.entry(file.to_owned()).or_default();
                edits.insert((place.start, place.end), text);
            };
            let new = self.rename.new;
            let asserted = asserted(&syntax, self.rename.old);
            for place in uses.names.into_iter().chain(asserted) {
                edit(file, place, new.to_owned());
            }
            for start in uses.shorthands {
                edit(file, start..start, format!("{new}: "));
            }
            edit(&data, place, new.to_owned());
            return;
        }
        let names = uses.names.into_iter().map(|name| name.start);
        let places = names.chain(uses.shorthands).chain(uses.unclear);
        let lines = places.map(|start| (file.to_owned(), position(&text, start).line));
        unclear.extend(lines);
    }

    /// The data of a captured test of the node, and the place of the output's name in it.
    fn captured_data(&self, test: &Utf8Path) -> Option<(Utf8PathBuf, Range<usize>)> {
        let name = format!("captured/{}.json", test.file_stem()?);
        let file = test.parent()?.join(name);
        let text = self.workspace.read(&file).ok()?;
        let data: Value = serde_json::from_str(&text).ok()?;
        if data["node"] != self.producer {
            return None;
        }
        data["outputs"].get(self.rename.old)?;
        // As hulkgen writes it: keys of the first and of the second level, each on its line.
        let outputs = text.find("\n  \"outputs\": {\n")?;
        let key = format!("\n    \"{}\":", self.rename.old);
        let start = outputs + text[outputs..].find(&key)? + "\n    \"".len();
        let end = outputs + text[outputs..].find("\n  }")?;
        (start < end).then(|| (file, start..start + self.rename.old.len()))
    }

    /// `INSTANCE.main_outputs.NAME`: values of TOML are changed, whatever else says so is listed.
    fn look_at_text(&self, file: &Utf8Path, edits: &mut Edits, unclear: &mut Unclear) {
        let Ok(text) = self.workspace.read(file) else {
            return;
        };
        let named = self.named(&text);
        if named.is_empty() || says_generated(&text) {
            return;
        }
        let certain = match file.extension() {
            Some("toml") => self.values(&text),
            _ => BTreeSet::new(),
        };
        for start in named {
            if certain.contains(&start) {
                let place = (start, start + self.rename.old.len());
                let edits = edits.entry(file.to_owned()).or_default();
                edits.insert(place, self.rename.new.to_owned());
            } else {
                unclear.insert((file.to_owned(), position(&text, start).line));
            }
        }
    }

    /// Where the output's name begins in every path of clients to it, wherever that stands.
    fn named(&self, text: &str) -> Vec<usize> {
        let is_word = |one: char| one.is_alphanumeric() || one == '_';
        let mut found = Vec::new();
        for (start, _) in text.match_indices(MAIN_OUTPUTS) {
            let name = start + MAIN_OUTPUTS.len();
            let is_whole = text[name..]
                .strip_prefix(self.rename.old)
                .is_some_and(|rest| !rest.starts_with(is_word));
            let instance = text[..start].rsplit(|one| !is_word(one)).next();
            let instance = instance.unwrap_or_default();
            if is_whole && self.instances.contains(&instance) {
                found.push(name);
            }
        }
        found
    }

    /// Those of them that begin a value of TOML that is such a path and nothing else.
    fn values(&self, text: &str) -> BTreeSet<usize> {
        let Ok(table) = DeTable::parse(text) else {
            return BTreeSet::new();
        };
        let mut values = Vec::new();
        for value in table.get_ref().values() {
            texts_of(value.get_ref(), value.span(), &mut values);
        }
        let starts = values.into_iter().filter_map(|(value, place)| {
            let (instance, path) = value.split_once(MAIN_OUTPUTS)?;
            behind_name(path, self.rename.old)?;
            let before = format!("{instance}{MAIN_OUTPUTS}");
            // Behind the quote; written in another way it is listed.
            let quotes = text[place.clone()].find(&before)?;
            Some(place.start + quotes + before.len())
        });
        starts.collect()
    }
}

/// Every text among the values, with its place.
fn texts_of<'v>(
    value: &'v DeValue<'_>,
    place: Range<usize>,
    found: &mut Vec<(&'v str, Range<usize>)>,
) {
    match value {
        DeValue::String(text) => found.push((text, place)),
        DeValue::Array(list) => {
            for one in list {
                texts_of(one.get_ref(), one.span(), found);
            }
        }
        DeValue::Table(table) => {
            for one in table.values() {
                texts_of(one.get_ref(), one.span(), found);
            }
        }
        _ => {}
    }
}

/// Names in `captured.assert_output("NAME", …)`, without their quotes.
fn asserted(syntax: &syn::File, name: &str) -> Vec<Range<usize>> {
    struct Asserted<'a> {
        name: &'a str,
        found: Vec<Range<usize>>,
    }
    impl<'ast> Visit<'ast> for Asserted<'_> {
        fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
            if call.method == "assert_output"
                && let Some(syn::Expr::Lit(literal)) = call.args.first()
                && let syn::Lit::Str(text) = &literal.lit
                && text.value() == self.name
            {
                let place = range(text.span());
                self.found.push(place.start + 1..place.end - 1);
            }
            visit::visit_expr_method_call(self, call);
        }
    }
    let mut asserted = Asserted {
        name,
        found: Vec::new(),
    };
    asserted.visit_file(syntax);
    asserted.found
}
