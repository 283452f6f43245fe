//! Which part of the robot a place of the generated crate comes from.

use std::ops::Range;

use camino::{Utf8Path, Utf8PathBuf};

use super::Home;
use super::rustc::Message;
use super::surroundings::Surroundings;
use crate::diagnostics::{Diagnostic, byte, listed};
use crate::resolve::robot::{CreationBinding, CycleBinding, Cycler, Field, Node, Target};
use crate::workspace::MANIFEST;

/// A field of one of a node's contexts.
#[derive(Clone)]
struct Origin<'a> {
    node: &'a Node,
    in_creation: bool,
    name: &'a str,
    range: Range<usize>,
    /// The node that writes what the field reads.
    writer: Option<&'a Node>,
    /// What it writes.
    output: &'a str,
}

/// A place in a file of the robot's authors, and what rustc says about it.
struct Seen {
    file: Utf8PathBuf,
    range: Range<usize>,
    text: String,
}

impl<'a> Origin<'a> {
    /// Of a field that names nothing but itself.
    fn of<B>(node: &'a Node, field: &'a Field<B>) -> Self {
        Self {
            node,
            in_creation: false,
            name: &field.name,
            range: field.range.clone(),
            writer: None,
            output: &field.name,
        }
    }
}

impl Home<'_> {
    /// Adds the places where an error of a generated file is mended, and the deed.
    pub(super) fn at_origin(
        &self,
        error: Diagnostic,
        file: &Utf8Path,
        surroundings: &Surroundings,
        message: &Message,
    ) -> Diagnostic {
        let below = file.strip_prefix(&self.robot.generated).unwrap_or(file);
        let folder = below.parent().and_then(Utf8Path::file_name);
        let stem = below.file_stem().unwrap_or_default();
        if folder == Some("bin")
            && let Some(target) = self.robot.targets.iter().find(|one| one.name == stem)
        {
            return self.at_target(error, target, message);
        }
        let models = self.model.cyclers.iter();
        let position = models.clone().position(|one| one.module == stem);
        let cycler = position.and_then(|position| self.robot.cyclers.get(position));
        let node = position.and_then(|position| self.node(position, surroundings));
        let mut nodes: Vec<(&Cycler, &Node)> = match (cycler, node) {
            (Some(cycler), Some(node)) => vec![(cycler, node)],
            _ => self.named_nodes(cycler, surroundings),
        };
        let seen = self.of_authors(message);
        if nodes.is_empty() {
            nodes = self.noted_nodes(seen.as_ref(), message);
        }
        let field = nodes
            .iter()
            .find_map(|(cycler, node)| self.field(cycler, node, surroundings));
        match (field, nodes.first(), cycler) {
            (Some(origin), ..) => self.at_field(error, &origin),
            (None, Some((cycler, node)), _) => self.at_node(at_seen(error, seen), cycler, node),
            (None, None, Some(cycler)) => self.at_cycler(at_seen(error, seen), cycler),
            (None, None, None) => at_seen(error, seen)
                .at(Utf8Path::new(MANIFEST), self.manifest.generated_range.clone(), "in what is generated from it")
                .help("look at rustc's words below; if neither a node nor the hardware is to blame, report a bug in hulkgen"),
        }
    }

    /// The node whose function this is.
    fn node(&self, cycler: usize, surroundings: &Surroundings) -> Option<&Node> {
        let function = surroundings.function.as_deref()?;
        let models = &self.model.cyclers[cycler].nodes;
        let position = models.iter().position(|node| {
            function == node.name || function.strip_prefix("create_") == Some(&node.name)
        })?;
        let path = &models[position].path;
        let mut nodes = self.robot.cyclers[cycler].nodes.iter();
        nodes.find(|node| node.path == *path)
    }

    /// Nodes whose paths stand around the place.
    fn named_nodes(
        &self,
        cycler: Option<&Cycler>,
        surroundings: &Surroundings,
    ) -> Vec<(&Cycler, &Node)> {
        let all = self.robot.cyclers.iter();
        let of_file = all.filter(|one| cycler.is_none_or(|cycler| cycler.name == one.name));
        of_file
            .flat_map(|cycler| cycler.nodes.iter().map(move |node| (cycler, node)))
            .filter(|(_, node)| surroundings.texts.contains(&node.path))
            .collect()
    }

    /// The place in a file of the robot's authors that rustc names besides the generated one; one in a node's file goes
    /// before others. The framework's own bounds are no place to mend.
    fn of_authors(&self, message: &Message) -> Option<Seen> {
        let members = self.workspace.members();
        let framework = members.library("framework");
        let mut seen = message.others().filter_map(|(span, text)| {
            let (file, span) = self.place(span)?;
            let is_foreign = self.files.contains_key(&file)
                || framework.is_some_and(|member| file.starts_with(&member.folder));
            if is_foreign {
                return None;
            }
            let code = self.workspace.read(&file).ok()?;
            let start = byte(&code, span.line_start, span.column_start);
            let length = span.byte_end.saturating_sub(span.byte_start);
            Some(Seen {
                file,
                range: start..start + length,
                text: text.to_owned(),
            })
        });
        let first = seen.next()?;
        let is_in_node = |seen: &Seen| self.nodes().any(|(_, node)| node.file == seen.file);
        if is_in_node(&first) {
            return Some(first);
        }
        Some(seen.find(is_in_node).unwrap_or(first))
    }

    /// Nodes whose file rustc names, else whose state its notes name.
    fn noted_nodes(&self, seen: Option<&Seen>, message: &Message) -> Vec<(&Cycler, &Node)> {
        let in_file = |node: &Node| seen.is_some_and(|seen| seen.file == node.file);
        let of_file: Vec<_> = self.nodes().filter(|(_, node)| in_file(node)).collect();
        if !of_file.is_empty() {
            return of_file;
        }
        let names = |node: &Node| {
            let (plain, full) = (
                format!("`{}`", node.type_name),
                format!("{}::{}`", node.path, node.type_name),
            );
            let mut notes = message.notes().map(|note| note.message.as_str());
            notes.any(|note| note.contains(&plain) || note.contains(&full))
        };
        let named: Vec<_> = self.nodes().filter(|(_, node)| names(node)).collect();
        // Several nodes may be called alike: then none of them is surely meant.
        let first = named.first().map(|(_, node)| &node.path);
        if named.iter().all(|(_, node)| Some(&node.path) == first) {
            return named;
        }
        Vec::new()
    }

    fn nodes(&self) -> impl Iterator<Item = (&Cycler, &Node)> {
        let cyclers = self.robot.cyclers.iter();
        cyclers.flat_map(|cycler| cycler.nodes.iter().map(move |node| (cycler, node)))
    }

    /// The field of the node that the surroundings name.
    fn field<'a>(
        &'a self,
        cycler: &'a Cycler,
        node: &'a Node,
        surroundings: &Surroundings,
    ) -> Option<Origin<'a>> {
        let fields = self.fields(cycler, node);
        let creates = surroundings
            .function
            .as_deref()
            .is_some_and(|function| function == "restore" || function.starts_with("create_"));
        surroundings.names.iter().find_map(|name| {
            let plain = name.strip_prefix("r#").unwrap_or(name);
            // A variable that another of the function would hide is called so behind its field's name, once or more often.
            let field = plain.trim_end_matches("_input");
            [name, plain, field].into_iter().find_map(|name| {
                let is_it = |origin: &&Origin<'a>| {
                    let is_named = origin.name == name || origin.output == name;
                    is_named && (origin.in_creation == creates || surroundings.function.is_none())
                };
                fields.iter().find(is_it).cloned()
            })
        })
    }

    /// Every field of a node.
    fn fields<'a>(&'a self, own: &'a Cycler, node: &'a Node) -> Vec<Origin<'a>> {
        let creation = node.creation.iter().map(|field| {
            let path = match &field.binding {
                CreationBinding::Parameter { access, .. }
                | CreationBinding::CyclerState { access, .. } => access.segments.last(),
                CreationBinding::HardwareInterface => None,
            };
            Origin {
                in_creation: true,
                output: path.map_or(field.name.as_str(), |last| &last.name),
                ..Origin::of(node, field)
            }
        });
        let cycle = node.cycle.iter().map(|field| {
            let writer = field.binding.read().and_then(|read| {
                let cycler = match read.instances.first() {
                    Some(id) => self.robot.cyclers.get(id.cycler)?,
                    None => own,
                };
                cycler.nodes.get(read.producer)
            });
            let path = match &field.binding {
                CycleBinding::Parameter { access, .. }
                | CycleBinding::CyclerState { access, .. }
                | CycleBinding::AdditionalOutput { access, .. } => access.segments.last(),
                binding => binding.read().and_then(|read| read.access.segments.first()),
            };
            Origin {
                writer,
                output: path.map_or(field.name.as_str(), |last| &last.name),
                ..Origin::of(node, field)
            }
        });
        let outputs = node.outputs.iter().map(|field| Origin::of(node, field));
        // What a node is given by name goes before what it names by path.
        outputs.chain(cycle).chain(creation).collect()
    }

    fn at_field(&self, error: Diagnostic, origin: &Origin<'_>) -> Diagnostic {
        let Origin {
            node,
            name,
            range,
            writer,
            output,
            ..
        } = origin;
        let text = format!("what is generated from `{name}` does not compile");
        let error = error.at(&node.file, range.clone(), text);
        let written = writer.and_then(|writer| Some((writer, output_range(writer, output)?)));
        match written {
            Some((writer, range)) => error
                .at(&writer.file, range, format!("`{}` writes it", writer.path))
                .help(format!(
                    "let `{name}` have the type that `{}` writes; hulkgen could not follow both types to their end",
                    writer.path
                )),
            None => error.help(format!("change the type of `{name}` as rustc says below")),
        }
    }

    fn at_node(&self, error: Diagnostic, cycler: &Cycler, node: &Node) -> Diagnostic {
        let entry = self.manifest.cyclers.iter();
        let mut entries = entry
            .filter(|one| one.name() == cycler.name)
            .flat_map(|one| &one.nodes);
        let range = entries
            .find(|entry| entry.path.as_str() == node.path)
            .map_or(0..0, |entry| entry.range.clone());
        let text = "what is generated for this node does not compile";
        error
            .at(Utf8Path::new(MANIFEST), range, text)
            .help(format!("mend `{}` as rustc says below", node.file))
    }

    fn at_cycler(&self, error: Diagnostic, cycler: &Cycler) -> Diagnostic {
        let mut cyclers = self.manifest.cyclers.iter();
        let range = cyclers
            .find(|one| one.name() == cycler.name)
            .map_or(0..0, |one| one.name_range.clone());
        let text = "what is generated for this cycler does not compile";
        error
            .at(Utf8Path::new(MANIFEST), range, text)
            .help("mend the node or the type that rustc names below; if it names none, report a bug in hulkgen")
    }

    /// A hardware that lacks what nodes ask for.
    fn at_target(&self, error: Diagnostic, target: &Target, message: &Message) -> Diagnostic {
        let mut targets = self.manifest.targets.iter();
        let range = targets
            .find(|one| one.declared.name.as_str() == target.name)
            .map_or(0..0, |one| one.hardware_range.clone());
        let text = format!("the hardware of target `{}`", target.name);
        let error = error.at(Utf8Path::new(MANIFEST), range, text);
        let words: Vec<&str> = message
            .message
            .split(|letter: char| !letter.is_alphanumeric() && letter != '_')
            .collect();
        let nodes = self.robot.cyclers.iter().flat_map(|cycler| &cycler.nodes);
        let mut asking: Vec<(&str, &str)> = nodes
            .flat_map(|node| {
                let bounds = [&node.new_bounds, &node.cycle_bounds, &node.restore_bounds];
                let names = bounds.into_iter().flatten();
                names.map(|bound| (bound.name(), node.path.as_str()))
            })
            .filter(|(name, _)| words.contains(name))
            .collect();
        asking.sort_unstable();
        asking.dedup();
        let Some((name, _)) = asking.first() else {
            return error;
        };
        let nodes = asking.iter().filter(|(other, _)| other == name);
        error.help(format!(
            "implement `{name}` for `{}`: it is asked for by {}",
            target.hardware,
            listed(nodes.map(|(_, node)| *node))
        ))
    }
}

fn at_seen(error: Diagnostic, seen: Option<Seen>) -> Diagnostic {
    match seen {
        Some(seen) => error.at(&seen.file, seen.range, seen.text),
        None => error,
    }
}

/// Where a node declares an output.
fn output_range(writer: &Node, output: &str) -> Option<Range<usize>> {
    let returned = writer
        .outputs
        .iter()
        .map(|field| (&field.name, &field.range));
    let in_place = writer
        .cycle
        .iter()
        .filter(|field| matches!(field.binding, CycleBinding::MainOutput { .. }))
        .map(|field| (&field.name, &field.range));
    let mut all = returned.chain(in_place);
    all.find(|(name, _)| *name == output)
        .map(|(_, range)| range.clone())
}
