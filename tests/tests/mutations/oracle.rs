//! Which rules of the contract (sections 2 to 4) a robot breaks, and where each can be told.
//!
//! It says less than hulkgen (no codes, no help) and goes other ways: types are texts, a ring is whatever reaches itself.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::parameters;
use crate::reading::{CONTEXTS, Definition, Field, File, Function, argument};
use crate::robot::{Cycler, Node, Robot};

/// A rule that is broken: the bytes of any of these places may be named. No bytes: anywhere in the file.
#[derive(Clone, Debug)]
pub(crate) struct Breach {
    pub(crate) rule: &'static str,
    pub(crate) places: Vec<(String, Option<Range<usize>>)>,
}

/// A path such as `camera.matrix?.x`.
pub(crate) type Path = Vec<Segment>;

/// One name of a path and whether `?` stands behind it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Segment {
    pub(crate) name: String,
    pub(crate) optional: bool,
}

/// The type at the end of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum End {
    Type(String),
    /// It leads into a type that the oracle does not know.
    Unseen,
    Broken,
}

/// A field and the node whose file it stands in.
pub(crate) type Declared<'r> = (&'r Node, &'r Field);

/// What every rule looks at.
pub(crate) struct Oracle<'r> {
    pub(crate) robot: &'r Robot,
    pub(crate) cyclers: &'r [Cycler],
    pub(crate) breaches: Vec<Breach>,
}

/// Every broken rule.
pub(crate) fn breaches(robot: &Robot) -> Vec<Breach> {
    let cyclers = robot.cyclers();
    let mut oracle = Oracle {
        robot,
        cyclers: &cyclers,
        breaches: Vec::new(),
    };
    for cycler in &cyclers {
        oracle.check_nodes(cycler);
        oracle.check_outputs(cycler);
        oracle.check_states(cycler);
        oracle.check_rings(cycler);
        oracle.check_record(cycler);
    }
    parameters::check(&mut oracle);
    oracle.breaches
}

/// Splits a path; `None` if it is none.
pub(crate) fn path(text: &str) -> Option<Path> {
    let segment = |part: &str| {
        let name = part.strip_suffix('?').unwrap_or(part);
        let first = name.chars().next()?;
        let letters = name.chars().all(|one| one.is_alphanumeric() || one == '_');
        let is_name = letters && !first.is_numeric() && name != "_" || name == "$cycler_instance";
        let is_marked_instance = name.starts_with('$') && part.ends_with('?');
        (is_name && !is_marked_instance).then(|| Segment {
            name: name.to_owned(),
            optional: part.ends_with('?'),
        })
    };
    text.split('.').map(segment).collect()
}

/// Whether one of two paths leads through the other.
pub(crate) fn overlap(a: &[Segment], b: &[Segment]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.name == b.name)
}

impl<'r> Oracle<'r> {
    pub(crate) fn add(&mut self, rule: &'static str, file: &str, bytes: &Range<usize>) {
        self.add_at(rule, &[(file, bytes)]);
    }

    pub(crate) fn add_at(&mut self, rule: &'static str, places: &[(&str, &Range<usize>)]) {
        let places = places
            .iter()
            .map(|(file, bytes)| ((*file).to_owned(), Some((*bytes).clone())));
        self.breaches.push(Breach {
            rule,
            places: places.collect(),
        });
    }

    pub(crate) fn file(&self, node: &Node) -> Option<&'r File> {
        self.robot.files.get(&node.file).map(|file| &**file)
    }

    /// Files and fields of a cycler's cycle contexts that have one of these kinds.
    pub(crate) fn fields(&self, cycler: &'r Cycler, kinds: &[&str]) -> Vec<Declared<'r>> {
        let nodes = cycler
            .nodes
            .iter()
            .filter_map(|node| Some((node, self.file(node)?)));
        let fields =
            nodes.flat_map(|(node, file)| file.fields.iter().map(move |field| (node, field)));
        fields
            .filter(|(_, field)| kinds.contains(&field.kind.text.as_str()))
            .collect()
    }

    fn check_nodes(&mut self, cycler: &'r Cycler) {
        for node in &cycler.nodes {
            let Some(file) = self.file(node) else {
                self.breaches.push(Breach {
                    rule: "node exists",
                    places: vec![("hulk.toml".to_owned(), None), (node.file.clone(), None)],
                });
                continue;
            };
            for context in CONTEXTS {
                if !file.ends.contains_key(context) {
                    self.breaches.push(Breach {
                        rule: "three contexts",
                        places: vec![(node.file.clone(), None)],
                    });
                }
                for field in file.of(context) {
                    if let Some(rule) =
                        misplaced(field).or_else(|| self.misread(cycler, node, field))
                    {
                        let producer = self.producer_place(cycler, field);
                        let own = (node.file.as_str(), &field.bytes);
                        match &producer {
                            Some((file, bytes)) => self.add_at(rule, &[own, (file, bytes)]),
                            None => self.add_at(rule, &[own]),
                        }
                    }
                }
            }
            self.check_functions(node, file);
        }
    }

    fn check_functions(&mut self, node: &Node, file: &File) {
        if file.functions.is_empty() {
            let heads: Vec<_> = file
                .heads
                .iter()
                .map(|head| (node.file.as_str(), head))
                .collect();
            self.add_at("new and cycle", &heads);
        }
        for function in &file.functions {
            let context = if function.name == "cycle" {
                "CycleContext"
            } else {
                "CreationContext"
            };
            let hardware = file
                .of(context)
                .find(|field| field.kind.text == "HardwareInterface");
            if !is_right(function, context, hardware.is_some()) {
                let field = hardware.map_or(&function.bytes, |field| &field.bytes);
                self.add_at(
                    "signature",
                    &[(&node.file, &function.bytes), (&node.file, field)],
                );
            }
        }
    }

    /// What is wrong with what a field of the right context reads.
    fn misread(&self, cycler: &'r Cycler, node: &Node, field: &Field) -> Option<&'static str> {
        let kind = field.kind.text.as_str();
        let reads = [
            "Input",
            "RequiredInput",
            "LatestInput",
            "PreviousInput",
            "HistoricInput",
            "PerceptionInput",
        ];
        if node.setup && reads.contains(&kind) && !(kind == "Input" && field.literals.len() == 1)
            || node.setup && ["CycleTime", "Procedure"].contains(&kind)
        {
            return Some("setup node");
        }
        if kind == "CaptureTime" && !node.setup {
            return Some("capture time");
        }
        if ["HistoricInput", "PerceptionInput"].contains(&kind) && !cycler.real_time {
            return Some("real-time");
        }
        let literal = field.literals.last()?;
        if kind == "Procedure" {
            let name = path(&literal.text).unwrap_or_default();
            let is_name = matches!(&name[..], [one] if !one.optional && !one.name.starts_with('$'));
            return (!is_name).then_some("procedure");
        }
        let Some(path) = path(&literal.text) else {
            return Some("path");
        };
        let data = &field.types.first()?.text;
        if path.iter().any(|one| one.optional) && argument(data, "Option").is_none() {
            return Some("option");
        }
        let instances = path.iter().filter(|one| one.name.starts_with('$')).count();
        match kind {
            "Parameter" => {
                return (instances > 1 || path[0].name == "hardware").then_some("parameter path");
            }
            "AdditionalOutput" if instances == 1 && path.iter().all(|one| !one.optional) => {
                return None;
            }
            "AdditionalOutput" | "CyclerState" => {
                return (instances > 0 || path.iter().any(|one| one.optional))
                    .then_some("path without `?`");
            }
            _ if instances > 0 => return Some("path"),
            _ => {}
        }
        if kind == "RequiredInput"
            && field.literals.len() == 1
            && path.iter().all(|one| !one.optional)
        {
            return Some("required");
        }
        let producer = match self.read_cycler(cycler, field) {
            Ok(producer) => producer,
            Err(rule) => return Some(rule),
        };
        let Some((writer, output)) = self.producer(producer, &path[0].name) else {
            return Some("output exists");
        };
        if node.setup && !writer.setup {
            return Some("setup order");
        }
        let end = self.end(&writer.file, &output.types.first()?.text, &path);
        (!agrees(data, &end, &path)).then_some("type")
    }

    /// The cycler that a field reads, if it may.
    fn read_cycler(&self, own: &'r Cycler, field: &Field) -> Result<&'r Cycler, &'static str> {
        if field.literals.len() < 2 {
            return Ok(own);
        }
        let name = &field.literals[0].text;
        let perception = field.kind.text == "PerceptionInput";
        let named = |cycler: &&Cycler| {
            cycler.instances.contains(name) || perception && cycler.name == *name
        };
        let cycler = self.cyclers.iter().find(named).ok_or("instance exists")?;
        if perception && cycler.real_time {
            return Err("perception instance");
        }
        if cycler.name == own.name && cycler.instances.len() == 1 {
            return Err("another instance");
        }
        Ok(cycler)
    }

    fn producer(&self, cycler: &'r Cycler, output: &str) -> Option<Declared<'r>> {
        let outputs = self.fields(cycler, &["MainOutput"]);
        outputs
            .into_iter()
            .find(|(_, field)| field.name.text == output)
    }

    fn producer_place(&self, cycler: &'r Cycler, field: &Field) -> Option<(String, Range<usize>)> {
        let cycler = self.read_cycler(cycler, field).ok()?;
        let path = path(&field.literals.last()?.text)?;
        let (node, output) = self.producer(cycler, &path[0].name)?;
        Some((node.file.clone(), output.bytes.clone()))
    }

    /// The type at the end of a path that starts with a value of this type, behind its marks.
    pub(crate) fn end(&self, file: &str, start: &str, path: &[Segment]) -> End {
        let mut current = start.to_owned();
        for (index, segment) in path.iter().enumerate() {
            if index > 0 {
                match self.field(file, &current, &segment.name) {
                    End::Type(data) => current = data,
                    other => return other,
                }
            }
            if segment.optional {
                match argument(&current, "Option") {
                    Some(inner) => current = inner.to_owned(),
                    None => return End::Broken,
                }
            }
        }
        End::Type(current)
    }

    fn field(&self, file: &str, data: &str, name: &str) -> End {
        let (head, arguments) = data.split_once('<').unwrap_or((data, ""));
        let primitive = [
            "Option", "Vec", "bool", "f32", "f64", "i16", "String", "u8", "u16", "u32", "u64",
            "usize",
        ];
        match self.robot.definition(file, head) {
            Some(Definition::Struct {
                generics, fields, ..
            }) => {
                let Some((_, data, true)) = fields.iter().find(|(field, ..)| field == name) else {
                    return End::Broken;
                };
                // Types of the NAO have one parameter at most.
                match generics.first() {
                    Some(generic) if data == generic => {
                        End::Type(arguments.trim_end_matches('>').to_owned())
                    }
                    _ => End::Type(data.clone()),
                }
            }
            Some(Definition::Enum { .. }) => End::Broken,
            None if primitive.contains(&head) || data.starts_with(['(', '[']) => End::Broken,
            None => of_nalgebra(head, arguments.trim_end_matches('>'), name),
        }
    }

    fn check_outputs(&mut self, cycler: &'r Cycler) {
        let outputs = self.fields(cycler, &["MainOutput"]);
        for (index, (node, field)) in outputs.iter().enumerate() {
            let twin = outputs[..index]
                .iter()
                .find(|(_, other)| other.name.text == field.name.text);
            if let Some((other, twin)) = twin {
                self.add_at(
                    "output is unique",
                    &[(&node.file, &field.bytes), (&other.file, &twin.bytes)],
                );
            }
        }
        for (_, twins) in repeated(self.fields(cycler, &["CaptureTime"]), |_| String::new()) {
            self.add_all("one capture time", &twins);
        }
        for (_, twins) in repeated(self.fields(cycler, &["Procedure"]), |field| {
            field.literals[0].text.clone()
        }) {
            self.add_all("procedure is unique", &twins);
        }
        let additional = self.fields(cycler, &["AdditionalOutput"]);
        self.check_overlaps("additional output is unique", &additional, |_, _| true);
    }

    fn check_states(&mut self, cycler: &'r Cycler) {
        let states = self.fields(cycler, &["CyclerState"]);
        let shared = |field: &Field| {
            field
                .types
                .first()
                .is_some_and(|data| data.text.starts_with('&'))
        };
        for (node, reader) in states.iter().filter(|(_, field)| shared(field)) {
            let is_written = states
                .iter()
                .any(|(_, writer)| !shared(writer) && paths_overlap(writer, reader));
            if !is_written {
                self.add("state is written", &node.file, &reader.bytes);
            }
        }
        self.check_overlaps(
            "states of one context",
            &states,
            |(a, first), (b, second)| {
                a.path == b.path
                    && first.context == second.context
                    && !(shared(first) && shared(second))
            },
        );
        self.check_tree("states agree", &states);
    }

    fn check_overlaps(
        &mut self,
        rule: &'static str,
        fields: &[Declared<'_>],
        together: impl Fn(&Declared<'_>, &Declared<'_>) -> bool,
    ) {
        for (index, first) in fields.iter().enumerate() {
            for second in &fields[index + 1..] {
                if paths_overlap(first.1, second.1) && together(first, second) {
                    self.add_all(rule, &[*first, *second]);
                }
            }
        }
    }

    /// Declarations at or below each other's paths have types that agree.
    pub(crate) fn check_tree(&mut self, rule: &'static str, fields: &[Declared<'_>]) {
        let paths: Vec<_> = fields
            .iter()
            .filter_map(|one| Some((one, path(&last(one.1))?)))
            .collect();
        for ((node, lower), below) in &paths {
            for ((other, upper), above) in &paths {
                if below.len() < above.len()
                    || !overlap(below, above)
                    || lower.types.is_empty()
                    || upper.types.is_empty()
                {
                    continue;
                }
                let data = |field: &Field| field.types[0].text.trim_start_matches('&').to_owned();
                let end = self.end(&other.file, &data(upper), &below[above.len() - 1..]);
                if !agrees(&data(lower), &end, &below[above.len() - 1..]) {
                    self.add_at(
                        rule,
                        &[(&node.file, &lower.bytes), (&other.file, &upper.bytes)],
                    );
                }
            }
        }
    }

    /// Every field on a ring of nodes that wait for each other.
    fn check_rings(&mut self, cycler: &'r Cycler) {
        let mut edges: BTreeMap<&str, Vec<Declared<'_>>> = BTreeMap::new();
        for (node, field) in self.fields(cycler, &["Input", "RequiredInput", "HistoricInput"]) {
            let Some(start) = path(&last(field)).filter(|_| field.literals.len() == 1) else {
                continue;
            };
            if let Some((writer, _)) = self.producer(cycler, &start[0].name)
                && (writer.setup || !node.setup)
            {
                edges.entry(&writer.path).or_default().push((node, field));
            }
        }
        for (from, readers) in &edges {
            for (node, field) in readers {
                let mut seen = BTreeSet::new();
                let mut open = vec![node.path.as_str()];
                while let Some(next) = open.pop() {
                    if seen.insert(next) {
                        let readers = edges.get(next).into_iter().flatten();
                        open.extend(readers.map(|(reader, _)| reader.path.as_str()));
                    }
                }
                if seen.contains(from) {
                    self.add("ring", &node.file, &field.bytes);
                }
            }
        }
    }

    fn check_record(&mut self, cycler: &'r Cycler) {
        let Some(path) = cycler.recorded_while.as_deref().and_then(path) else {
            return;
        };
        let line = self.robot.manifest.find("record =").unwrap_or_default();
        match self.producer(cycler, &path[0].name) {
            None => self.add("record while", "hulk.toml", &(line..line)),
            Some((node, output)) if output.types.first().is_none_or(|data| data.text != "bool") => {
                self.add_at(
                    "record while",
                    &[("hulk.toml", &(line..line)), (&node.file, &output.bytes)],
                );
            }
            _ => {}
        }
    }

    fn add_all(&mut self, rule: &'static str, fields: &[Declared<'_>]) {
        let places: Vec<_> = fields
            .iter()
            .map(|(node, field)| (node.file.as_str(), &field.bytes))
            .collect();
        self.add_at(rule, &places);
    }
}

/// Whether what is written is right for the value at the end of a path.
pub(crate) fn agrees(data: &str, end: &End, path: &[Segment]) -> bool {
    let marked = path.iter().any(|one| one.optional);
    match end {
        End::Unseen => true,
        End::Broken => false,
        End::Type(end) if marked => argument(data, "Option") == Some(end),
        End::Type(end) => data == end,
    }
}

/// Parts of points, vectors and poses.
fn of_nalgebra(head: &str, element: &str, name: &str) -> End {
    let size = head.chars().last().and_then(|last| last.to_digit(10));
    let axes = &["x", "y", "z", "w"][..size.unwrap_or_default().min(4) as usize];
    let of_element = |kind: &str| End::Type(format!("{kind}<{element}>"));
    match (head.trim_end_matches(|one: char| one.is_numeric()), name) {
        ("Point" | "Vector" | "Translation", axis) if axes.contains(&axis) => {
            End::Type(element.to_owned())
        }
        ("Point", "coords") | ("Translation", "vector") => {
            of_element(&format!("Vector{}", axes.len()))
        }
        ("Vector", "data") => End::Unseen,
        ("Isometry", "translation") => of_element(&format!("Translation{}", axes.len())),
        ("Isometry", "rotation") if axes.len() == 2 => of_element("UnitComplex"),
        ("Isometry", "rotation") => of_element("UnitQuaternion"),
        ("UnitQuaternion", "i" | "j" | "k" | "w") | ("UnitComplex", "re" | "im") => {
            End::Type(element.to_owned())
        }
        ("UnitQuaternion", "coords") => of_element("Vector4"),
        ("Point" | "Vector" | "Translation" | "Isometry" | "UnitQuaternion" | "UnitComplex", _) => {
            End::Broken
        }
        _ => End::Unseen,
    }
}

fn last(field: &Field) -> String {
    field
        .literals
        .last()
        .map(|literal| literal.text.clone())
        .unwrap_or_default()
}

fn paths_overlap(a: &Field, b: &Field) -> bool {
    match (path(&last(a)), path(&last(b))) {
        (Some(a), Some(b)) => overlap(&a, &b),
        _ => false,
    }
}

/// Fields of which there is more than one, by a key.
fn repeated<'r>(
    fields: Vec<Declared<'r>>,
    key: impl Fn(&Field) -> String,
) -> BTreeMap<String, Vec<Declared<'r>>> {
    let mut by_key: BTreeMap<String, Vec<Declared<'_>>> = BTreeMap::new();
    for (node, field) in fields {
        by_key.entry(key(field)).or_default().push((node, field));
    }
    by_key.retain(|_, twins| twins.len() > 1);
    by_key
}

/// A kind where it has no meaning, or with arguments or hints that it does not take.
fn misplaced(field: &Field) -> Option<&'static str> {
    let (contexts, types, literals): (&[&str], _, _) = match field.kind.text.as_str() {
        "Input" | "RequiredInput" => (&CONTEXTS[1..2], 1, 1..=2),
        "LatestInput" | "PerceptionInput" => (&CONTEXTS[1..2], 1, 2..=2),
        "PreviousInput" | "HistoricInput" | "AdditionalOutput" => (&CONTEXTS[1..2], 1, 1..=1),
        "Parameter" | "CyclerState" => (&CONTEXTS[..2], 1, 1..=1),
        "Procedure" => (&CONTEXTS[1..2], 2, 1..=1),
        "CycleTime" => (&CONTEXTS[1..2], 0, 0..=0),
        "HardwareInterface" => (&CONTEXTS[..2], 0, 0..=0),
        "MainOutput" => (&CONTEXTS[1..], 1, 0..=0),
        "CaptureTime" => (&CONTEXTS[2..], 0, 0..=0),
        _ => return Some("kind"),
    };
    if field.has_hints && field.kind.text != "Parameter" {
        return Some("hints");
    }
    let fits = contexts.contains(&field.context)
        && field.types.len() == types
        && literals.contains(&field.literals.len());
    let reference = field.types.iter().any(|data| data.text.starts_with('&'))
        && field.kind.text != "CyclerState";
    (!fits || reference).then_some("kind in context")
}

fn is_right(function: &Function, context: &str, hardware: bool) -> bool {
    let (receiver, returned) = match function.name.as_str() {
        "new" => (None, "Self"),
        "cycle" => (Some("&mut self"), "MainOutputs"),
        _ => (Some("&mut self"), "()"),
    };
    let [(data, generic)] = &function.arguments[..] else {
        return false;
    };
    function.public
        && !function.qualified
        && function.receiver.as_deref() == receiver
        && data == context
        && *generic == hardware
        && argument(&function.returns, "Result") == Some(returned)
}
