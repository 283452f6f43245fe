//! Parameter files against the parameters that nodes declare.
//!
//! Every target starts from `default.toml`, its location's `default.toml`, and files of identities that only the robot
//! chooses: a value that some identity's file gives there or for all may be there, so it is not missed.

mod choice;
mod expected;
mod form;
mod given;
mod keys;
mod layer;
mod missing;
mod opaque;
mod other_names;
pub(super) mod shown;
mod unset;
mod unused;
mod values;
mod variants;
mod winners;

use std::collections::BTreeSet;

use camino::Utf8Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::robot::{Robot, Target};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, nearest};
use crate::manifest::Manifest;
use crate::scan::Sources;
use crate::workspace::Workspace;

use expected::{Child, Expected};
use layer::Layer;

pub use given::{Answer, Asked, Given, Identity, Robots, Value, given};
pub use winners::Winner;

/// What the files of a robot cannot be asked without its program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Unchecked {
    /// Parameters, and fields of them, whose types only serde can read; as files write them.
    pub opaque: Vec<String>,
    /// Where targets run: there every value must be given. `None`: at no location.
    pub locations: BTreeSet<Option<String>>,
    /// Other locations that have files.
    pub other_locations: BTreeSet<String>,
}

/// Checks the files of every target, and says what is left to its program.
pub fn check(
    workspace: &Workspace,
    manifest: &Manifest,
    sources: &Sources<'_>,
    robot: &Robot,
    diagnostics: &mut Diagnostics,
) -> Unchecked {
    let choice = choice::load(workspace, &robot.parameters, diagnostics);
    let texts = layer::find(workspace, manifest, choice.as_ref(), diagnostics);
    unused::check(workspace, manifest, diagnostics);
    let mut layers = Vec::new();
    for (file, text) in &texts {
        let (table, errors) = DeTable::parse_recoverable(text);
        for error in &errors {
            let place = error.span().unwrap_or(0..0);
            diagnostics.add(Diagnostic::new(Code::Syntax, error.message()).at(file, place, ""));
        }
        if errors.is_empty() {
            let path = file.strip_prefix(&robot.parameters).ok();
            layers.push(Layer {
                file,
                robots: path.and_then(Robots::of).unwrap_or_default(),
                table: table.into_inner(),
            });
        }
    }
    let checker = Checker {
        default_location: choice.map(|choice| choice.location),
        sources,
        robot,
    };
    for layer in &layers {
        checker.check_hardware(layer, diagnostics);
        let root = Child::tree(&robot.parameter_tree);
        checker.check_table(
            layer.file,
            &layer.table,
            &root,
            &mut Vec::new(),
            diagnostics,
        );
    }
    missing::check(&checker, &layers, diagnostics);
    other_names::check(&layers, robot, sources, diagnostics);
    sources.library.report_problems(diagnostics);
    let locations = checker.locations();
    let folders = texts.iter().filter_map(|(file, _)| {
        let folder = file.parent()?.strip_prefix(&robot.parameters).ok()?;
        (!folder.as_str().is_empty()).then(|| folder.to_string())
    });
    Unchecked {
        opaque: opaque::opaque(&Expected::Tree(&robot.parameter_tree), sources),
        other_locations: folders
            .filter(|folder| !locations.contains(&Some(folder.clone())))
            .collect(),
        locations,
    }
}

struct Checker<'a> {
    /// Of targets that name none.
    default_location: Option<String>,
    sources: &'a Sources<'a>,
    robot: &'a Robot,
}

impl Checker<'_> {
    /// `[hardware.<target>]` is the hardware's own; only the target has to be there.
    fn check_hardware(&self, layer: &Layer<'_>, diagnostics: &mut Diagnostics) {
        let Some(hardware) = layer
            .table
            .get("hardware")
            .and_then(|value| value.get_ref().as_table())
        else {
            return;
        };
        let targets: Vec<&str> = self
            .robot
            .targets
            .iter()
            .map(|target| target.name.as_str())
            .collect();
        for key in hardware
            .keys()
            .filter(|key| !targets.contains(&key.get_ref().as_ref()))
        {
            let name = key.get_ref();
            let help = nearest(name, targets.iter().copied())
                .map(|near| format!("did you mean `{near}`?"));
            let error = Diagnostic::new(
                Code::UnknownParameter,
                format!("the robot has no target `{name}`"),
            )
            .at(layer.file, key.span(), "")
            .help_if(help);
            diagnostics.add(error);
        }
    }

    /// Keys that nobody declares, and values that cannot be what a node reads.
    fn check_table(
        &self,
        file: &Utf8Path,
        table: &DeTable<'_>,
        place: &Child<'_>,
        path: &mut Vec<String>,
        diagnostics: &mut Diagnostics,
    ) {
        let Some(children) = place.expected.children(self.sources) else {
            return;
        };
        for (key, value) in table {
            let name = key.get_ref();
            if path.is_empty() && name == "hardware" {
                continue;
            }
            path.push(name.to_string());
            match children.get(name) {
                Some(_) if unset::is_unset(value.get_ref()) => {}
                Some(child) => {
                    let child = child.within(self.declared_limits(path).or(place.limits));
                    self.check_value(file, value, &child, path, diagnostics);
                }
                None => {
                    let help = nearest(name, children.names())
                        .map(|near| format!("did you mean `{near}`?"));
                    let message = format!("nobody declares the parameter `{}`", path.join("."));
                    let error = Diagnostic::new(Code::UnknownParameter, message)
                        .at(file, key.span(), "")
                        .help(help.unwrap_or_else(|| "remove it".to_owned()));
                    diagnostics.add(error);
                }
            }
            path.pop();
        }
    }

    /// What the fields of nodes say about a parameter.
    fn declared_limits(&self, path: &[String]) -> Option<grammar::Range> {
        let hints = self.robot.parameter_hints.get(&path.join("."))?;
        hints.range.as_ref()?.parse().ok()
    }

    fn check_value(
        &self,
        file: &Utf8Path,
        value: &Spanned<DeValue<'_>>,
        place: &Child<'_>,
        path: &mut Vec<String>,
        diagnostics: &mut Diagnostics,
    ) {
        if let (DeValue::Table(table), true) = (
            value.get_ref(),
            place.expected.children(self.sources).is_some(),
        ) {
            return self.check_table(file, table, place, path, diagnostics);
        }
        if let Some(wrong) = values::mistake(value, place, self.sources) {
            let message = format!("`{}` {}", path.join("."), wrong.message);
            let error = Diagnostic::new(Code::MistypedParameter, message)
                .at(file, wrong.place, "")
                .help_if(wrong.help);
            diagnostics.add(error);
        }
    }

    /// Where the targets run.
    fn locations(&self) -> BTreeSet<Option<String>> {
        let targets = self.robot.targets.iter();
        let mut locations: BTreeSet<Option<String>> =
            targets.map(|target| self.location(target)).collect();
        if locations.is_empty() {
            locations.insert(self.default_location.clone());
        }
        locations
    }

    /// Where a target runs.
    fn location(&self, target: &Target) -> Option<String> {
        target.location.clone().or(self.default_location.clone())
    }
}

#[cfg(test)]
mod tests;
