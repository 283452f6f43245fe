//! The twelve kinds of mutations, each at every place of the robot.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::reading::{CONTEXTS, Field, File, Part};
use crate::robot::{Cycler, Node, Robot};

/// The kinds, as the table calls them.
pub(crate) const KINDS: [&str; 12] = [
    "delete a node",
    "rename an output",
    "change a type",
    "drop or add `?`",
    "swap the instance",
    "duplicate an output",
    "kind in a wrong context",
    "misspell a path",
    "close a ring",
    "wrong signature",
    "drop a parameter",
    "wrong parameter type",
];

/// One text replaced in one file.
#[derive(Clone, Debug)]
pub(crate) struct Mutant {
    pub(crate) kind: &'static str,
    pub(crate) file: String,
    pub(crate) bytes: Range<usize>,
    pub(crate) text: String,
}

impl Mutant {
    /// The file's text after the mutation.
    pub(crate) fn apply(&self, text: &str) -> String {
        format!(
            "{}{}{}",
            &text[..self.bytes.start],
            self.text,
            &text[self.bytes.end..]
        )
    }
}

/// Makes mutants of a robot.
struct Mutator<'r> {
    robot: &'r Robot,
    texts: &'r BTreeMap<String, String>,
    cyclers: Vec<Cycler>,
    mutants: Vec<Mutant>,
}

/// Every mutant, by kind and place.
pub(crate) fn mutants(robot: &Robot, texts: &BTreeMap<String, String>) -> Vec<Mutant> {
    let cyclers = robot.cyclers();
    let mut mutator = Mutator {
        robot,
        texts,
        cyclers,
        mutants: Vec::new(),
    };
    for cycler in mutator.cyclers.clone() {
        for (index, node) in cycler.nodes.iter().enumerate() {
            let file = robot.files[&node.file].clone();
            mutator.delete(node);
            for field in &file.fields {
                mutator.change_field(node, field);
                mutator.misplace(node, &file, field);
            }
            mutator.duplicate(&cycler, index, &file);
            mutator.close_rings(&cycler, node, &file);
            mutator.change_signatures(node, &file);
        }
    }
    for (file, text) in &robot.layers {
        let table = DeTable::parse(text)
            .expect("the parameters are TOML")
            .into_inner();
        mutator.change_values(file, text, &table);
    }
    mutator.mutants
}

impl Mutator<'_> {
    fn add(&mut self, kind: usize, file: &str, bytes: &Range<usize>, text: impl Into<String>) {
        self.mutants.push(Mutant {
            kind: KINDS[kind],
            file: file.to_owned(),
            bytes: bytes.clone(),
            text: text.into(),
        });
    }

    fn delete(&mut self, node: &Node) {
        let manifest = &self.texts["hulk.toml"];
        let quoted = format!("\"{}\"", node.path);
        let name = manifest
            .find(&quoted)
            .expect("the node stands in the manifest");
        let line = manifest[..name].rfind('\n').map_or(0, |end| end + 1);
        let start = manifest[line..name]
            .find("{ node")
            .map_or(name, |at| line + at);
        let mut end = name + quoted.len();
        if start < name {
            end += manifest[end..].find('}').expect("a table ends") + 1;
        }
        end += usize::from(manifest[end..].starts_with(','));
        self.add(0, "hulk.toml", &(start..end), "");
    }

    fn change_field(&mut self, node: &Node, field: &Field) {
        let file = &node.file;
        let is_parameter = field.kind.text == "Parameter";
        if field.kind.text == "MainOutput" {
            self.add(
                1,
                file,
                &field.name.bytes,
                format!("{}_renamed", field.name.text),
            );
        }
        for data in &field.types {
            let kind = if is_parameter { 11 } else { 2 };
            for (replacement, wrapped) in [
                ("u8", false),
                ("String", false),
                ("Option", true),
                ("Vec", true),
            ] {
                let source = &self.texts[file][data.bytes.clone()];
                let text = if wrapped {
                    format!("{replacement}<{source}>")
                } else {
                    replacement.to_owned()
                };
                if text != data.text {
                    self.add(kind, file, &data.bytes, text);
                }
            }
            if let Some(inner) = crate::reading::argument(&data.text, "Option") {
                self.add(kind, file, &data.bytes, inner);
            }
        }
        let Some(path) = field.literals.last() else {
            return;
        };
        self.mark(file, path);
        self.misspell(file, path);
        let names: Vec<String> = self
            .cyclers
            .iter()
            .flat_map(|one| one.instances.clone())
            .collect();
        let cyclers = self.cyclers.iter().map(|one| one.name.clone());
        let others: Vec<String> = names
            .into_iter()
            .chain(cyclers)
            .chain(["Elsewhere".to_owned()])
            .collect();
        for other in others {
            match &field.literals[..] {
                [instance, _] if instance.text != other => {
                    self.add(4, file, &instance.bytes, other)
                }
                [path] if field.kind.text.ends_with("Input") => {
                    let at = path.bytes.start - 1;
                    self.add(4, file, &(at..at), format!("\"{other}\", "));
                }
                _ => {}
            }
        }
    }

    /// Toggles the `?` behind each segment.
    fn mark(&mut self, file: &str, path: &Part) {
        let mut end = path.bytes.start;
        for segment in path.text.split('.') {
            end += segment.len();
            match segment.ends_with('?') {
                true => self.add(3, file, &(end - 1..end), ""),
                false => self.add(3, file, &(end..end), "?"),
            }
            end += 1;
        }
    }

    /// Each segment with its last letter twice, without its first, and in capitals; the path without its last segment.
    fn misspell(&mut self, file: &str, path: &Part) {
        let mut start = path.bytes.start;
        for segment in path.text.split('.') {
            let name = segment.trim_end_matches('?');
            let bytes = start..start + name.len();
            let last = &name[name.len() - 1..];
            self.add(7, file, &bytes, format!("{name}{last}"));
            self.add(7, file, &bytes, &name[1..]);
            self.add(7, file, &bytes, name.to_uppercase());
            start += segment.len() + 1;
        }
        if let Some(dot) = path.text.rfind('.') {
            self.add(7, file, &(path.bytes.start + dot..path.bytes.end), "");
        }
        self.add(7, file, &(path.bytes.end..path.bytes.end), ".x");
    }

    /// The field in the two other contexts, and every other kind with the same arguments.
    fn misplace(&mut self, node: &Node, file: &File, field: &Field) {
        let written = self.texts[&node.file][field.bytes.clone()].to_owned();
        for context in CONTEXTS.iter().filter(|context| **context != field.context) {
            let other =
                written.replacen(&field.name.text, &format!("{}_moved", field.name.text), 1);
            let end = file.ends[context];
            self.add(6, &node.file, &(end..end), format!(" {other}, "));
        }
        let kinds: &[&str] = match (field.types.len(), field.literals.len()) {
            (0, 0) => &["CycleTime", "HardwareInterface", "CaptureTime"],
            (1, 0) => &["MainOutput", "Parameter"],
            (1, 1) => &[
                "AdditionalOutput",
                "CyclerState",
                "HistoricInput",
                "Input",
                "LatestInput",
                "Parameter",
                "PreviousInput",
                "RequiredInput",
            ],
            (1, 2) => &[
                "Input",
                "LatestInput",
                "PerceptionInput",
                "PreviousInput",
                "RequiredInput",
            ],
            _ => &["Input"],
        };
        for kind in kinds.iter().filter(|kind| **kind != field.kind.text) {
            self.add(
                6,
                &node.file,
                &field.kind.bytes,
                format!("framework::{kind}"),
            );
        }
    }

    /// An output of this name in each struct of the next nodes of its own cycler, and in every other cycler.
    fn duplicate(&mut self, cycler: &Cycler, index: usize, file: &File) {
        let names: Vec<String> = file
            .outputs()
            .map(|field| field.name.text.clone())
            .collect();
        let next = cycler.nodes.iter().cycle().skip(index + 1).take(2).cloned();
        let others = self
            .cyclers
            .iter()
            .filter(|other| other.name != cycler.name);
        let strangers = others.filter_map(|other| other.nodes.last()).cloned();
        let targets: Vec<Node> = next
            .chain(strangers)
            .filter(|node| node.path != cycler.nodes[index].path)
            .collect();
        for target in targets {
            for name in &names {
                for context in ["MainOutputs", "CycleContext"] {
                    let end = self.robot.files[&target.file].ends[context];
                    let text = format!(" {name}: framework::MainOutput<bool>, ");
                    self.add(5, &target.file, &(end..end), text);
                }
            }
        }
    }

    /// The node reads an output of each node of its cycler, also its own.
    fn close_rings(&mut self, cycler: &Cycler, node: &Node, file: &File) {
        for writer in &cycler.nodes {
            let of_writer = self.robot.files[&writer.file].clone();
            for output in of_writer.outputs() {
                let end = file.ends["CycleContext"];
                let data = self.absolute(&writer.file, output);
                let name = &output.name.text;
                let text = format!(" ring: framework::Input<{data}, \"{name}\">, ");
                self.add(8, &node.file, &(end..end), text);
            }
        }
    }

    /// The type of an output with the paths that its file imports, so that any file can name it.
    fn absolute(&self, file: &str, output: &Field) -> String {
        let text = &self.texts[file];
        let data = &text[output.types[0].bytes.clone()];
        let mut absolute = String::new();
        let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
        for word in data.split_inclusive(|letter| !is_word(letter)) {
            let name = word.trim_end_matches(|letter| !is_word(letter));
            absolute.push_str(&imported(text, file, name));
            absolute.push_str(&word[name.len()..]);
        }
        absolute
    }

    fn change_signatures(&mut self, node: &Node, file: &File) {
        for function in &file.functions {
            let written = self.texts[&node.file][function.bytes.clone()].to_owned();
            let name = format!("fn {}", function.name);
            for (right, wrong) in [
                ("pub ", ""),
                ("pub ", "pub(crate) "),
                ("pub fn", "pub async fn"),
                ("pub fn", "pub unsafe fn"),
                ("&mut self, ", ""),
                ("&mut self", "&self"),
                ("&mut self", "mut self"),
                (name.as_str(), &format!("fn other_{}", function.name)),
                ("CreationContext", "CycleContext"),
                ("CycleContext", "CreationContext"),
                ("CycleContext<", "Context<"),
                ("Result<Self>", "Self"),
                ("Result<Self>", "Option<Self>"),
                ("Result<Self>", "Result<()>"),
                ("Result<MainOutputs>", "MainOutputs"),
                ("Result<MainOutputs>", "Result<()>"),
                ("Result<()>", "()"),
                (") ->", ", second: u8) ->"),
                ("(", "(second: u8, "),
                ("context: CycleContext", "context: &CycleContext"),
                ("CycleContext)", "CycleContext<impl Send>)"),
                ("CreationContext)", "CreationContext<impl Send>)"),
            ] {
                let text = written.replacen(right, wrong, 1);
                if text != written {
                    self.add(9, &node.file, &function.bytes, text);
                }
            }
            if function.name == "new" {
                for restore in [
                    "pub fn restore(&mut self, _context: CreationContext) -> Result<()> { Ok(()) }",
                    "fn restore(&mut self, _context: CreationContext) -> Result<()> { Ok(()) }",
                    "pub fn restore(&self, _context: CreationContext) -> Result<()> { Ok(()) }",
                    "pub fn restore(&mut self, _context: CycleContext) -> Result<()> { Ok(()) }",
                    "pub fn restore(&mut self, _context: CreationContext) -> Result<Self> { todo() }",
                    "pub fn restore(&mut self, _context: CreationContext) {}",
                    "pub fn restore(_context: CreationContext) -> Result<()> { Ok(()) }",
                ] {
                    let at = function.bytes.start;
                    if !file.functions.iter().any(|other| other.name == "restore") {
                        self.add(9, &node.file, &(at..at), format!("{restore} "));
                    }
                }
            }
        }
    }

    fn change_values(&mut self, file: &str, text: &str, table: &DeTable<'_>) {
        for (key, value) in table {
            let is_header = text[..key.span().start]
                .trim_end_matches(|one| one != '[')
                .ends_with("\n[")
                && text[..key.span().start]
                    .rsplit('\n')
                    .next()
                    .is_some_and(|line| line.starts_with('['));
            if !is_header && !text[value.span()].starts_with("[[") {
                let mut bytes = key.span().start..value.span().end;
                if text[bytes.end..].starts_with(',') {
                    bytes.end += 1;
                } else if text[..bytes.start].trim_end().ends_with(',') {
                    bytes.start = text[..bytes.start].trim_end().len() - 1;
                }
                self.add(10, file, &bytes, "");
            }
            if !text[value.span()].starts_with("[[") {
                self.change_value(file, text, value);
            }
        }
    }

    fn change_value(&mut self, file: &str, text: &str, value: &Spanned<DeValue<'_>>) {
        match value.get_ref() {
            DeValue::Table(table) => self.change_values(file, text, table),
            other => {
                // Numbers lie within every range of the NAO's parameters: the oracle knows types alone.
                for wrong in [
                    "\"wrong\"",
                    "true",
                    "[]",
                    "[0.5]",
                    "0.5",
                    "1",
                    "{}",
                    "{ x = 1 }",
                ] {
                    self.add(11, file, &value.span(), wrong);
                }
                for item in other.as_array().into_iter().flatten() {
                    self.change_value(file, text, item);
                }
            }
        }
    }
}

/// A name with the path that a file imports it by.
fn imported(text: &str, file: &str, name: &str) -> String {
    let is_own =
        text.contains(&format!("struct {name} ")) || text.contains(&format!("enum {name} "));
    if is_own {
        let module = file.trim_start_matches("robotics/").trim_end_matches(".rs");
        return format!(
            "{}::{name}",
            module.replace("/src/", "::").replace('/', "::")
        );
    }
    let mut rest = text;
    while let Some(start) = rest.find("\nuse ") {
        rest = &rest[start + 5..];
        let line = rest.split(';').next().unwrap_or_default();
        let (path, names) = match line.split_once("::{") {
            Some((path, names)) => (path, names.trim_end_matches('}')),
            None => line.rsplit_once("::").unwrap_or((line, "")),
        };
        if names.split(',').any(|one| one.trim() == name) {
            return format!("{path}::{name}");
        }
    }
    name.to_owned()
}
