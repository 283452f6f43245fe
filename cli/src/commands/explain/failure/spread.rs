//! How a failure spreads from output to reader to output.

use super::{Becomes, Effect, outputs};
use crate::commands::explain::nodes::Place;
use crate::graph::fields::kind;
use crate::resolve::robot::{Access, CycleBinding, Cycler, Field, InstanceId, Node, Robot};
use crate::schedule::overlap;

pub(super) struct Spread<'r> {
    robot: &'r Robot,
    pub(super) effects: Vec<Effect>,
    /// Nodes whose outputs are defaults, as positions of cycler and node.
    defaults: Vec<(usize, usize)>,
}

impl<'r> Spread<'r> {
    pub(super) fn new(robot: &'r Robot) -> Self {
        Self {
            robot,
            effects: Vec::new(),
            defaults: Vec::new(),
        }
    }

    /// The node's outputs are defaults, and so are those of every node that is skipped for them.
    pub(super) fn defaults(&mut self, place: Place<'r>) {
        self.defaults.push((place.cycler, place.node));
        let mut next = 0;
        while let Some(&(cycler, node)) = self.defaults.get(next) {
            next += 1;
            for (reader, position, field) in self.fields() {
                if let Some((becomes, from, access)) =
                    self.read_default(reader, field, cycler, node)
                {
                    self.add(reader, position, field, becomes, from, access);
                }
            }
        }
        self.held_states(place);
    }

    /// Others see nothing of this cycle: `latest` of their reads, `entry` of their perception inputs.
    pub(super) fn without_cycle(&mut self, place: Place<'r>, latest: Becomes, entry: Becomes) {
        for (reader, position, field) in self.fields() {
            let Some(read) = field.binding.read() else {
                continue;
            };
            let is_perception = matches!(field.binding, CycleBinding::Perception { .. });
            for id in read.instances.iter().filter(|id| id.cycler == place.cycler) {
                let becomes = if is_perception { entry } else { latest };
                let from = self.instance(*id);
                self.add(reader, position, field, becomes, from, read.access);
            }
        }
    }

    /// Every field of every cycle context: cycler, node, field.
    fn fields(&self) -> Vec<(usize, usize, &'r Field<CycleBinding>)> {
        let robot = self.robot;
        let mut fields = Vec::new();
        for (cycler, declared) in robot.cyclers.iter().enumerate() {
            for (position, node) in declared.nodes.iter().enumerate() {
                fields.extend(node.cycle.iter().map(|field| (cycler, position, field)));
            }
        }
        fields
    }

    /// What a field sees that reads an output of a node whose outputs are defaults.
    fn read_default(
        &self,
        reader: usize,
        field: &'r Field<CycleBinding>,
        cycler: usize,
        node: usize,
    ) -> Option<(Becomes, String, &'r Access)> {
        let read = field.binding.read()?;
        let is_own = read.instances.is_empty();
        let instance = read.instances.iter().find(|id| id.cycler == cycler);
        if read.producer != node || !(is_own && reader == cycler || instance.is_some()) {
            return None;
        }
        let from = match instance {
            Some(id) if read.instances.len() == 1 => self.instance(*id),
            _ => self.robot.cyclers[cycler].name.clone(),
        };
        let required = matches!(
            field.binding,
            CycleBinding::RequiredOwnOutput { .. } | CycleBinding::RequiredOutputOf { .. }
        );
        let mut segments = read.access.segments.iter();
        let becomes = if !required {
            Becomes::Default
        } else if read.access.segments.first().is_some_and(|one| one.optional) {
            // The output is an `Option`, and its default is `None`.
            Becomes::Absent
        } else if segments.any(|segment| segment.optional) {
            Becomes::PerhapsAbsent
        } else {
            Becomes::Default
        };
        Some((becomes, from, read.access))
    }

    /// Readers of states that the node does not change this time.
    fn held_states(&mut self, place: Place<'r>) {
        for field in &place.node().cycle {
            let CycleBinding::CyclerState {
                access: written,
                shared: false,
                ..
            } = &field.binding
            else {
                continue;
            };
            for (reader, position, other) in self.fields() {
                if let CycleBinding::CyclerState {
                    access,
                    shared: true,
                    ..
                } = &other.binding
                    && reader == place.cycler
                    && overlap(access, written)
                {
                    let from = place.cycler().name.clone();
                    self.add(reader, position, other, Becomes::Held, from, access);
                }
            }
        }
    }

    fn add(
        &mut self,
        cycler: usize,
        node: usize,
        field: &Field<CycleBinding>,
        becomes: Becomes,
        from: String,
        access: &Access,
    ) {
        let reader: &Node = &self.robot.cyclers[cycler].nodes[node];
        let skipped = matches!(becomes, Becomes::Absent | Becomes::PerhapsAbsent)
            && !matches!(field.binding, CycleBinding::Perception { .. });
        let effect = Effect {
            cycler: self.robot.cyclers[cycler].name.clone(),
            node: reader.path.clone(),
            field: field.name.clone(),
            kind: kind(&field.binding),
            from,
            output: access.written.clone(),
            becomes,
            skipped,
            file: reader.file.clone(),
            line: field.line,
        };
        if !self.effects.contains(&effect) {
            self.effects.push(effect);
        }
        let has_outputs = !outputs(reader).is_empty();
        if skipped && has_outputs && !self.defaults.contains(&(cycler, node)) {
            self.defaults.push((cycler, node));
        }
    }

    fn instance(&self, id: InstanceId) -> String {
        let cycler: &Cycler = &self.robot.cyclers[id.cycler];
        cycler.instances[id.instance].name.clone()
    }
}
