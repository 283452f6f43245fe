//! Nodes with every field bound.

use grammar::{CreationField, CycleField, FromInstance, FromOutput, OutputField, StatePath};
use syn::Type;

use super::hardware;
use super::inputs::Inputs;
use super::robot::{
    Access, CreationBinding, CycleBinding, DataType, Field, Node, OnFailure, OutputBinding,
};
use super::scene::{Scene, SceneNode, report_unnameable};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, position};
use crate::scan::types::Resolved;
use crate::scan::{NodeSource, range};

/// Binds the fields of one node of one cycler; fields with an error are left out.
pub(super) fn bind(
    scene: &Scene<'_>,
    cycler: usize,
    node: SceneNode<'_>,
    text: &str,
    diagnostics: &mut Diagnostics,
) -> Node {
    let source = node.source;
    let declared = &scene.cyclers[cycler].declared.declared;
    let mut binder = Binder {
        scene,
        cycler,
        node,
        diagnostics,
    };
    let creation = binder.fields(text, &source.creation.fields, Binder::creation);
    let cycle = binder.fields(text, &source.cycle.fields, Binder::cycle);
    let outputs = binder.fields(text, &source.outputs.fields, Binder::output);
    let signatures = &source.signatures;
    let library = &scene.sources.library;
    let mut bounds = |signature: Option<&grammar::Signature>| {
        signature.map_or_else(Vec::new, |signature| {
            hardware::interfaces(library, source, signature, binder.diagnostics)
        })
    };
    Node {
        new_bounds: bounds(Some(&signatures.new)),
        cycle_bounds: bounds(Some(&signatures.cycle)),
        restore_bounds: bounds(signatures.restore.as_ref()),
        markers: hardware::markers(library, source),
        path: source.path.clone(),
        type_name: signatures.node.to_string(),
        setup: node.entry.setup,
        on_failure: on_failure(node.entry.on_failure.unwrap_or(declared.on_failure)),
        file: source.file().to_owned(),
        summary: source.summary.clone(),
        restores: signatures.restore.is_some(),
        creation,
        cycle,
        outputs,
    }
}

/// The manifest's word for it as the robot's.
pub(super) fn on_failure(declared: schema::OnFailure) -> OnFailure {
    match declared {
        schema::OnFailure::Stop => OnFailure::Stop,
        schema::OnFailure::Restart => OnFailure::Restart,
        schema::OnFailure::Skip => OnFailure::Skip,
        schema::OnFailure::Hold => OnFailure::Hold,
    }
}

struct Binder<'a, 'd> {
    scene: &'a Scene<'a>,
    cycler: usize,
    node: SceneNode<'a>,
    diagnostics: &'d mut Diagnostics,
}

impl Binder<'_, '_> {
    fn fields<K, B>(
        &mut self,
        text: &str,
        fields: &[grammar::Field<K>],
        bind: impl Fn(&mut Self, &grammar::Field<K>) -> Option<B>,
    ) -> Vec<Field<B>> {
        let mut bound = Vec::new();
        for field in fields {
            if let Some(binding) = bind(self, field) {
                let range = range(field.span);
                let line = position(text, range.start).line;
                bound.push(Field {
                    name: field.name.to_string(),
                    binding,
                    line,
                    range,
                });
            }
        }
        bound
    }

    fn creation(&mut self, field: &grammar::Field<CreationField>) -> Option<CreationBinding> {
        Some(match &field.kind {
            CreationField::Parameter(parameter) => CreationBinding::Parameter {
                access: Access::of(&parameter.path),
                data: self.data(&parameter.data, field),
            },
            CreationField::CyclerState(state) => CreationBinding::CyclerState {
                access: Access::of(&state.path),
                data: self.data(&state.data, field),
                shared: state.shared,
            },
            CreationField::HardwareInterface => CreationBinding::HardwareInterface,
        })
    }

    fn cycle(&mut self, field: &grammar::Field<CycleField>) -> Option<CycleBinding> {
        if self.node.entry.setup && !is_for_setup(&field.kind) {
            self.report_in_setup(field);
            return None;
        }
        match &field.kind {
            CycleField::Input(input) => self.input(field, input, false),
            CycleField::RequiredInput(input) => self.input(field, input, true),
            CycleField::LatestInput(input) => {
                let (instance, access, read) =
                    self.inputs()
                        .of_instance(field, &input.instance, &input.path, &input.data)?;
                let (data, producer, checked) = read;
                Some(CycleBinding::Latest {
                    instance,
                    access,
                    data,
                    producer,
                    checked,
                })
            }
            CycleField::PreviousInput(input) => {
                let (access, (data, producer, checked)) =
                    self.inputs().own(field, &input.path, &input.data)?;
                Some(CycleBinding::Previous {
                    access,
                    data,
                    producer,
                    checked,
                })
            }
            CycleField::HistoricInput(input) => {
                self.inputs().needs_real_time(field, "HistoricInput")?;
                let (access, (data, producer, checked)) =
                    self.inputs().own(field, &input.path, &input.data)?;
                Some(CycleBinding::Historic {
                    access,
                    data,
                    producer,
                    checked,
                })
            }
            CycleField::PerceptionInput(input) => self.perception(field, input),
            CycleField::Parameter(parameter) => Some(CycleBinding::Parameter {
                access: Access::of(&parameter.path),
                data: self.data(&parameter.data, field),
            }),
            CycleField::CyclerState(state) => Some(self.state(field, state)),
            CycleField::CycleTime => Some(CycleBinding::CycleTime),
            CycleField::AdditionalOutput(output) => Some(CycleBinding::AdditionalOutput {
                access: Access::of(&output.path),
                data: self.data(&output.data, field),
            }),
            CycleField::Procedure(procedure) => Some(CycleBinding::Procedure {
                name: procedure.name.text.clone(),
                request: self.data(&procedure.request, field),
                response: self.data(&procedure.response, field),
            }),
            CycleField::HardwareInterface => Some(CycleBinding::HardwareInterface),
            CycleField::MainOutput(data) => {
                let data = self.resolve(data);
                Some(CycleBinding::MainOutput {
                    data: DataType::from(&data),
                })
            }
        }
    }

    fn output(&mut self, field: &grammar::Field<OutputField>) -> Option<OutputBinding> {
        match &field.kind {
            OutputField::MainOutput(data) => {
                let data = self.resolve(data);
                Some(OutputBinding::MainOutput {
                    data: DataType::from(&data),
                })
            }
            OutputField::CaptureTime if self.node.entry.setup => Some(OutputBinding::CaptureTime),
            OutputField::CaptureTime => {
                let path = &self.node.source.path;
                let error = Diagnostic::new(
                    Code::CaptureTime,
                    format!("`{path}` gives the capture time but is no setup node"),
                );
                let error = error
                    .at(self.node.source.file(), range(field.span), "")
                    .help("move the node to `setup_nodes`, or remove this field");
                self.diagnostics.add(error);
                None
            }
        }
    }

    fn input(
        &mut self,
        field: &grammar::Field<CycleField>,
        input: &FromOutput,
        required: bool,
    ) -> Option<CycleBinding> {
        let Some(instance) = &input.instance else {
            let (access, (data, producer, checked)) =
                self.inputs().own(field, &input.path, &input.data)?;
            return Some(match required {
                false => CycleBinding::OwnOutput {
                    access,
                    data,
                    producer,
                    checked,
                },
                true => CycleBinding::RequiredOwnOutput {
                    access,
                    data,
                    producer,
                    checked,
                },
            });
        };
        let (instance, access, (data, producer, checked)) =
            self.inputs()
                .of_instance(field, instance, &input.path, &input.data)?;
        Some(match required {
            false => CycleBinding::OutputOf {
                instance,
                access,
                data,
                producer,
                checked,
            },
            true => CycleBinding::RequiredOutputOf {
                instance,
                access,
                data,
                producer,
                checked,
            },
        })
    }

    fn perception(
        &mut self,
        field: &grammar::Field<CycleField>,
        input: &FromInstance,
    ) -> Option<CycleBinding> {
        self.inputs().needs_real_time(field, "PerceptionInput")?;
        let (instances, interleaved) =
            self.inputs().perception_instances(field, &input.instance)?;
        let cycler = instances.first()?.cycler;
        let (access, (data, producer, checked)) =
            self.inputs()
                .from(field, cycler, &input.path, &input.data)?;
        Some(CycleBinding::Perception {
            instances,
            interleaved,
            access,
            data,
            producer,
            checked,
        })
    }

    fn state(&mut self, field: &grammar::Field<CycleField>, state: &StatePath) -> CycleBinding {
        CycleBinding::CyclerState {
            access: Access::of(&state.path),
            data: self.data(&state.data, field),
            shared: state.shared,
        }
    }

    fn inputs(&mut self) -> Inputs<'_, '_> {
        Inputs {
            scene: self.scene,
            cycler: self.cycler,
            node: self.node,
            diagnostics: self.diagnostics,
        }
    }

    fn resolve(&self, data: &Type) -> Resolved {
        self.scene
            .sources
            .library
            .resolve(&self.node.source.module, data)
    }

    /// A type that is declared here, so it has to be public.
    fn data<K>(&mut self, data: &Type, field: &grammar::Field<K>) -> DataType {
        let data = self.resolve(data);
        let place = range(field.span);
        let source: &NodeSource = self.node.source;
        report_unnameable(&data, source, &place, self.scene.sources, self.diagnostics);
        DataType::from(&data)
    }

    fn report_in_setup(&mut self, field: &grammar::Field<CycleField>) {
        let kind = field
            .kind_path
            .segments
            .last()
            .map(|last| last.ident.to_string());
        let kind = kind.unwrap_or_default();
        let message = format!("`{kind}` has no meaning in a setup node");
        let error = Diagnostic::new(Code::MisplacedKind, message)
            .at(
                self.node.source.file(),
                range(field.span),
                format!(
                    "`{}` is a setup node of `{}`",
                    self.node.source.path,
                    self.cycler_name()
                ),
            )
            .help("setup nodes run before the inputs of a cycle are taken: read it in a node");
        self.diagnostics.add(error);
    }

    fn cycler_name(&self) -> &str {
        self.scene.cyclers[self.cycler].declared.name()
    }
}

fn is_for_setup(field: &CycleField) -> bool {
    match field {
        CycleField::Input(input) => input.instance.is_none(),
        CycleField::Parameter(_)
        | CycleField::CyclerState(_)
        | CycleField::AdditionalOutput(_)
        | CycleField::HardwareInterface
        | CycleField::MainOutput(_) => true,
        _ => false,
    }
}
