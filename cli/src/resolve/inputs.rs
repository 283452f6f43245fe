//! Inputs: which output of which instance a field reads, and whether its type agrees.

use grammar::{CycleField, DataPath, Field, Name};
use syn::Type;

use super::paths::{self, Agreement};
use super::robot::{Access, DataType, InstanceId};
use super::scene::{Producer, Scene, SceneNode, written_within};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, listed, nearest, suggestion};
use crate::scan::range;

/// Type as written, position of the node that writes the output, whether the types were compared.
pub(super) type Read = (DataType, usize, bool);

/// Looks for what one field of one node reads.
pub(super) struct Inputs<'a, 'd> {
    pub(super) scene: &'a Scene<'a>,
    pub(super) cycler: usize,
    pub(super) node: SceneNode<'a>,
    pub(super) diagnostics: &'d mut Diagnostics,
}

impl Inputs<'_, '_> {
    /// An output of the own cycler.
    pub(super) fn own(
        &mut self,
        field: &Field<CycleField>,
        path: &DataPath,
        data: &Type,
    ) -> Option<(Access, Read)> {
        let (access, read) = self.from(field, self.cycler, path, data)?;
        let producer = self.scene.cyclers[self.cycler].nodes[read.1];
        if self.node.entry.setup && !producer.entry.setup {
            let output = &access.segments[0].name;
            let message = format!("a setup node reads `{output}`, which is written after it");
            let written = format!("`{}` is no setup node", producer.source.path);
            let outputs = &self.scene.cyclers[self.cycler].outputs;
            let place = outputs
                .get(output)
                .map(|one| one.range.clone())
                .unwrap_or_default();
            let error = Diagnostic::new(Code::SetupOrder, message)
                .at(self.node.source.file(), range(field.span), "")
                .at(producer.source.file(), place, written)
                .help(format!(
                    "move `{}` to `setup_nodes`, or `{}` to `nodes`",
                    producer.source.path, self.node.source.path
                ));
            self.diagnostics.add(error);
            return None;
        }
        Some((access, read))
    }

    /// An output of the instance that is named.
    pub(super) fn of_instance(
        &mut self,
        field: &Field<CycleField>,
        instance: &Name,
        path: &DataPath,
        data: &Type,
    ) -> Option<(InstanceId, Access, Read)> {
        let Some(id) = self.scene.instance(&instance.text) else {
            self.report_unknown_instance(instance, false);
            return None;
        };
        let cycler = &self.scene.cyclers[id.cycler];
        if id.cycler == self.cycler && cycler.declared.instances.len() == 1 {
            let message = format!(
                "`{}` reads its own instance as if it were another",
                field.name
            );
            let error = Diagnostic::new(Code::MisplacedKind, message)
                .at(self.node.source.file(), range(instance.span), "the node runs in this instance")
                .help(format!(
                    "write `Input<T, \"{path}\">` for this cycle or `PreviousInput<T, \"{path}\">` for the cycle before"
                ));
            self.diagnostics.add(error);
            return None;
        }
        let (access, read) = self.from(field, id.cycler, path, data)?;
        Some((id, access, read))
    }

    /// The instances that a `PerceptionInput` reads, and whether it names a cycler.
    pub(super) fn perception_instances(
        &mut self,
        field: &Field<CycleField>,
        name: &Name,
    ) -> Option<(Vec<InstanceId>, bool)> {
        let (instances, interleaved) = match (
            self.scene.instance(&name.text),
            self.scene.cycler(&name.text),
        ) {
            (Some(id), _) => (vec![id], false),
            (None, Some(cycler)) => {
                let count = self.scene.cyclers[cycler].declared.instances.len();
                let ids = (0..count).map(|instance| InstanceId { cycler, instance });
                (ids.collect(), true)
            }
            (None, None) => {
                self.report_unknown_instance(name, true);
                return None;
            }
        };
        let cycler = &self.scene.cyclers[instances.first()?.cycler].declared;
        if cycler.declared.kind != schema::CyclerKind::Perception {
            let message = format!("`{}` is no instance of a perception cycler", name.text);
            let error = Diagnostic::new(Code::MisplacedKind, message)
                .at(self.node.source.file(), range(field.span), "")
                .help(format!(
                    "write `LatestInput<T, \"{}\", …>` or `Input`",
                    name.text
                ));
            self.diagnostics.add(error);
            return None;
        }
        Some((instances, interleaved))
    }

    /// `None` and an error if the node's cycler is no real-time cycler.
    pub(super) fn needs_real_time(&mut self, field: &Field<CycleField>, kind: &str) -> Option<()> {
        let cycler = &self.scene.cyclers[self.cycler].declared;
        if cycler.declared.kind == schema::CyclerKind::RealTime {
            return Some(());
        }
        let name = cycler.name();
        let message = format!("`{kind}` has no meaning in the perception cycler `{name}`");
        let error = Diagnostic::new(Code::MisplacedKind, message)
            .at(
                self.node.source.file(),
                range(field.span),
                format!("`{}` is a node of `{name}`", self.node.source.path),
            )
            .help("read it in a node of a real-time cycler, or use `Input`, `LatestInput` or `PreviousInput`");
        self.diagnostics.add(error);
        None
    }

    /// An output of a cycler by its path, with its type compared.
    pub(super) fn from(
        &mut self,
        field: &Field<CycleField>,
        cycler: usize,
        path: &DataPath,
        data: &Type,
    ) -> Option<(Access, Read)> {
        let access = Access::of(path);
        let first = &access.segments.first()?.name;
        let Some(producer) = self.scene.cyclers[cycler].outputs.get(first) else {
            self.report_unknown_output(cycler, path, first);
            return None;
        };
        let library = &self.scene.sources.library;
        let written = library.resolve(&self.node.source.module, data);
        let agreement = paths::check(library, &producer.data, &access.segments, &written);
        let checked = agreement == Agreement::Same;
        if !checked && agreement != Agreement::Unknown {
            let error = self.disagreement(agreement, field, path, &written.text, producer);
            self.diagnostics.add(error);
            return None;
        }
        let data = DataType::from(&written);
        Some((access, (data, producer.node, checked)))
    }

    fn disagreement(
        &self,
        agreement: Agreement,
        field: &Field<CycleField>,
        path: &DataPath,
        written: &str,
        producer: &Producer<'_>,
    ) -> Diagnostic {
        let output = &producer.data.text;
        let (code, message, help) = match agreement.clone() {
            Agreement::Option { message, help } => (Code::OptionMismatch, message, Some(help)),
            Agreement::Field {
                message,
                names,
                wrong,
            } => {
                let fields = names.iter().map(String::as_str);
                let help = suggestion(&wrong, fields, "its fields are");
                (
                    Code::UnknownOutput,
                    message,
                    (!names.is_empty()).then_some(help),
                )
            }
            Agreement::Private {
                structure, field, ..
            } => (
                Code::NotPublic,
                format!("field `{field}` of `{structure}` is private"),
                Some(format!("write `pub {field}`")),
            ),
            Agreement::Type { expected } => (
                Code::TypeMismatch,
                format!("`{path}` is `{expected}`, but is read as `{written}`"),
                Some(format!(
                    "write `{}` here, or change the type of the output",
                    written_within(self.node.source, &expected)
                )),
            ),
            // Not reached: both are no disagreement.
            Agreement::Same | Agreement::Unknown => (Code::TypeMismatch, String::new(), None),
        };
        let reads = format!("`{}` reads it as `{written}`", self.node.source.path);
        let writes = format!("`{}` writes it as `{output}`", producer.source.path);
        agreement
            .begin(Diagnostic::new(code, message))
            .at(self.node.source.file(), range(field.span), reads)
            .at(producer.source.file(), producer.range.clone(), writes)
            .help_if(help)
    }

    fn report_unknown_instance(&mut self, name: &Name, cyclers_too: bool) {
        let scene = self.scene;
        let message = format!("the robot has no instance `{}`", name.text);
        let mut valid: Vec<&str> = scene.instance_names().collect();
        if cyclers_too {
            valid.extend(scene.cyclers.iter().map(|cycler| cycler.declared.name()));
        }
        let help = match (
            scene.cycler(&name.text),
            nearest(&name.text, valid.iter().copied()),
        ) {
            (Some(cycler), _) => {
                let instances = &scene.cyclers[cycler].declared.instances;
                let names = instances.iter().map(|instance| instance.name.as_str());
                format!(
                    "`{}` is a cycler; name one of its instances: {}",
                    name.text,
                    listed(names)
                )
            }
            (None, Some(near)) => format!("did you mean `{near}`?"),
            (None, None) => format!("it has {}", listed(valid)),
        };
        let error = Diagnostic::new(Code::UnknownInstance, message)
            .at(self.node.source.file(), range(name.span), "")
            .help(help);
        self.diagnostics.add(error);
    }

    fn report_unknown_output(&mut self, cycler: usize, path: &DataPath, first: &str) {
        let name = self.scene.cyclers[cycler].declared.name();
        let message = format!("no node of cycler `{name}` writes `{first}`");
        let help = self.suggest_output(cycler, first);
        let error = Diagnostic::new(Code::UnknownOutput, message)
            .at(
                self.node.source.file(),
                range(path.span),
                format!("read here by `{}`", self.node.source.path),
            )
            .help(help);
        self.diagnostics.add(error);
    }

    fn suggest_output(&self, cycler: usize, wanted: &str) -> String {
        let scene = self.scene;
        let name = scene.cyclers[cycler].declared.name();
        let outputs = &scene.cyclers[cycler].outputs;
        let additional = scene.cyclers[cycler].nodes.iter().any(|node| {
            node.source
                .cycle
                .fields
                .iter()
                .any(|field| match &field.kind {
                    CycleField::AdditionalOutput(output) => {
                        Access::of(&output.path).segments[0].name == wanted
                    }
                    _ => false,
                })
        });
        if additional {
            return format!(
                "`{wanted}` is an additional output, which only clients read: make it a `MainOutput`"
            );
        }
        let elsewhere = scene.cyclers.iter().find_map(|other| {
            let producer = other.outputs.get(wanted)?;
            Some((other, producer.source.path.as_str()))
        });
        if let Some((other, node)) = elsewhere {
            let instances = other.declared.instances.iter().map(|one| one.name.as_str());
            return format!(
                "`{node}` writes it in cycler `{}`: name the instance ({}), or add the node to `{name}`",
                other.declared.name(),
                listed(instances)
            );
        }
        if let Some(node) = scene.sources.unlisted_writer(wanted) {
            let is_read_before = self.node.entry.setup && cycler == self.cycler;
            let list = match node.is_setup || is_read_before {
                true => "`setup_nodes`",
                false => "nodes",
            };
            let node = node.path;
            return format!("`{node}` writes it; add it to the {list} of `{name}` in hulk.toml");
        }
        match nearest(wanted, outputs.keys().map(String::as_str)) {
            Some(near) => format!("did you mean `{near}`?"),
            None if outputs.is_empty() => format!("add a node that writes it to `{name}`"),
            None => format!(
                "`{name}` has {}",
                listed(outputs.keys().map(String::as_str))
            ),
        }
    }
}
