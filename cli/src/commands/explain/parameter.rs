//! A parameter: who reads it, and which files give it a value.

use camino::Utf8PathBuf;
use serde::Serialize;

use crate::diagnostics::{Diagnostics, Reported};
use crate::graph::Graph;
use crate::manifest;
use crate::pipeline::Understood;
use crate::resolve::parameter_files::{self, Answer, Asked, Robots, Value, Winner};
use crate::resolve::robot::{Access, CreationBinding, CycleBinding, Cycler, Node, Robot};
use crate::scan;
use crate::workspace::Workspace;

/// A declared parameter, or fields of one.
#[derive(Debug, PartialEq, Eq, Serialize)]
pub(super) struct ParameterSubject {
    /// The declared path.
    pub(super) path: String,
    /// The declared type.
    #[serde(rename = "type")]
    pub(super) data: String,
    pub(super) readers: Vec<Reader>,
    pub(super) values: Vec<ExplainedValue>,
}

/// A field of a context that reads it, something above it or something below it.
#[derive(Debug, PartialEq, Eq, Serialize)]
pub(super) struct Reader {
    pub(super) cycler: String,
    pub(super) node: String,
    /// `creation` or `cycle`.
    pub(super) context: &'static str,
    pub(super) file: Utf8PathBuf,
    pub(super) line: usize,
    /// As written.
    pub(super) path: String,
    /// What the node says about its field.
    pub(super) docs: Option<String>,
}

#[derive(Debug, PartialEq, Eq, Serialize)]
pub(super) struct ExplainedValue {
    #[serde(flatten)]
    pub(super) value: Value,
    pub(super) winners: Vec<Winner>,
}

/// A declared parameter and the way below it that a name leads.
struct Match<'a> {
    path: &'a str,
    data: &'a str,
    node: &'a str,
    below: Vec<&'a str>,
}

/// Every parameter of this name: a path, one with `$cycler_instance`, or the folder that paths begin with.
pub(super) fn find(
    workspace: &Workspace,
    understood: &Understood,
    graph: &Graph,
    name: &str,
) -> Result<Vec<ParameterSubject>, Reported> {
    let name = name.strip_prefix("parameters.").unwrap_or(name);
    let names = expanded(&understood.robot, name);
    let matches: Vec<Match<'_>> = (graph.parameters.iter())
        .flat_map(|parameter| names.iter().map(move |name| (parameter, name)))
        .filter_map(|(parameter, name)| {
            Some(Match {
                below: below(name, &parameter.path)?,
                path: &parameter.path,
                data: &parameter.data,
                node: parameter.readers.first()?,
            })
        })
        .collect();
    if matches.is_empty() {
        return Ok(Vec::new());
    }
    // What is wrong was said before.
    let mut said = Diagnostics::new();
    let manifest = manifest::load(workspace, &mut said)?;
    let sources = scan::scan(workspace, &manifest, &mut said)?;
    let subjects = matches.iter().filter_map(|found| {
        let asked = Asked {
            declared: found.path,
            data: found.data,
            node: found.node,
            below: &found.below,
            hints: understood.robot.parameter_hints.get(found.path),
        };
        let answer = parameter_files::given(workspace, &manifest, &sources, asked)?;
        Some(describe(workspace, &understood.robot, found, answer))
    });
    Ok(subjects.collect())
}

/// Instances in place of `$cycler_instance`.
fn expanded(robot: &Robot, name: &str) -> Vec<String> {
    let placeholder = "$cycler_instance";
    if !name.contains(placeholder) {
        return vec![name.to_owned()];
    }
    let instances = robot.cyclers.iter().flat_map(|cycler| &cycler.instances);
    instances
        .map(|instance| name.replace(placeholder, &schema::snake_case(&instance.name)))
        .collect()
}

/// How `name` goes on behind `path`; None: neither lies below the other.
fn below<'a>(name: &'a str, path: &str) -> Option<Vec<&'a str>> {
    let (names, declared): (Vec<_>, Vec<_>) =
        (name.split('.').collect(), path.split('.').collect());
    let shared = names.len().min(declared.len());
    (names[..shared] == declared[..shared]).then(|| names[shared..].to_vec())
}

fn describe(
    workspace: &Workspace,
    robot: &Robot,
    found: &Match<'_>,
    answer: Answer,
) -> ParameterSubject {
    // Nodes name fields as code does, whatever files call them.
    let fields = answer.fields.iter().map(String::as_str);
    let whole: Vec<&str> = found.path.split('.').chain(fields).collect();
    let mut readers = Vec::new();
    for cycler in &robot.cyclers {
        for node in &cycler.nodes {
            for (context, access, line) in reads(node) {
                if overlap(cycler, access, &whole) {
                    let text = workspace.text(&node.file).unwrap_or_default();
                    readers.push(Reader {
                        cycler: cycler.name.clone(),
                        node: node.path.clone(),
                        context,
                        file: node.file.clone(),
                        line,
                        path: access.written.clone(),
                        docs: docs_above(&text, line),
                    });
                }
            }
        }
    }
    let values = answer.values.into_iter().map(|value| ExplainedValue {
        winners: value.winners(),
        value,
    });
    ParameterSubject {
        path: found.path.to_owned(),
        data: found.data.to_owned(),
        readers,
        values: values.collect(),
    }
}

/// Parameters of a node: the context, the path, the line.
fn reads(node: &Node) -> impl Iterator<Item = (&'static str, &Access, usize)> {
    let creation = node
        .creation
        .iter()
        .filter_map(|field| match &field.binding {
            CreationBinding::Parameter { access, .. } => Some(("creation", access, field.line)),
            _ => None,
        });
    let cycle = node.cycle.iter().filter_map(|field| match &field.binding {
        CycleBinding::Parameter { access, .. } => Some(("cycle", access, field.line)),
        _ => None,
    });
    creation.chain(cycle)
}

/// Whether one path leads through the other.
fn overlap(cycler: &Cycler, access: &Access, path: &[&str]) -> bool {
    access.segments.iter().zip(path).all(|(segment, name)| {
        let mut instances = cycler.instances.iter();
        segment.name == *name
            || segment.instance && instances.any(|one| schema::snake_case(&one.name) == *name)
    })
}

/// The text of the `///` lines directly above a line.
fn docs_above(text: &str, line: usize) -> Option<String> {
    let above: Vec<&str> = text.lines().take(line.saturating_sub(1)).collect();
    let docs = above
        .iter()
        .rev()
        .map(|line| line.trim())
        .skip_while(|line| line.starts_with("#["))
        .map_while(|line| line.strip_prefix("///"));
    let mut docs: Vec<&str> = docs.map(str::trim).collect();
    docs.reverse();
    (!docs.is_empty()).then(|| docs.join(" "))
}

/// The explanation for people.
pub(super) fn text(subject: &ParameterSubject) -> String {
    let own = subject
        .values
        .iter()
        .find(|value| value.value.path == subject.path);
    let hints = own.map_or_else(String::new, |own| hints(&own.value));
    let mut text = format!("{}: {}{hints}\n", subject.path, subject.data);
    for reader in &subject.readers {
        let context = match reader.context {
            "creation" => ", when it is created",
            _ => "",
        };
        let path = if reader.path == subject.path {
            String::new()
        } else {
            format!(" as {}", reader.path)
        };
        text.push_str(&format!(
            "  read by {} of {}{path}{context} ({}:{})\n",
            reader.node, reader.cycler, reader.file, reader.line
        ));
    }
    // Several nodes may say the same about the same parameter.
    let mut docs: Vec<&str> = Vec::new();
    for reader in &subject.readers {
        if let Some(said) = reader.docs.as_deref().filter(|said| !docs.contains(said)) {
            docs.push(said);
        }
    }
    text.extend(docs.iter().map(|docs| format!("  {docs}\n")));
    for value in &subject.values {
        text.push_str(&value_text(subject, value));
    }
    text
}

/// Unit and range, behind a type.
fn hints(value: &Value) -> String {
    let unit = value.unit.as_ref().map(|unit| format!(" in {unit}"));
    let range = value
        .range
        .as_ref()
        .map(|range| format!(", within {range}"));
    unit.unwrap_or_default() + &range.unwrap_or_default()
}

fn value_text(subject: &ParameterSubject, explained: &ExplainedValue) -> String {
    let value = &explained.value;
    let mut text = String::new();
    if value.path != subject.path {
        let data = value.data.as_deref();
        let data = data.map_or(String::new(), |data| format!(": {data}"));
        text.push_str(&format!("  {}{data}{}\n", value.path, hints(value)));
        text.extend(value.docs.iter().map(|docs| format!("    {docs}\n")));
    }
    if value.given.is_empty() {
        text.push_str("    no file gives it a value\n");
    }
    for given in &value.given {
        let comment = given.comment.as_deref();
        let comment = comment.map_or(String::new(), |comment| format!("  # {comment}"));
        let robots = robots(&given.robots);
        text.push_str(&format!(
            "    {}:{}{robots}: {}{comment}\n",
            given.file, given.line, given.value
        ));
    }
    if value.given.len() > 1 {
        text.extend(explained.winners.iter().map(|winner| {
            let (place, value) = (combination(winner, &explained.winners), &winner.value);
            format!(
                "    {place}: {value} wins ({}:{})\n",
                winner.file, winner.line
            )
        }));
    }
    text
}

fn robots(robots: &Robots) -> String {
    let location = robots.location.iter().map(|it| format!(" at `{it}`"));
    let identity = robots
        .identity
        .iter()
        .map(|it| format!(" for {} {}", it.name, it.id));
    location.chain(identity).collect()
}

/// "at `field` for head P1", "elsewhere for any other robot".
fn combination(winner: &Winner, all: &[Winner]) -> String {
    let has_locations = all.iter().any(|one| one.location.is_some());
    let has_identities = all.iter().any(|one| !one.identities.is_empty());
    let mut parts = Vec::new();
    match &winner.location {
        Some(location) => parts.push(format!("at `{location}`")),
        None if has_locations => parts.push("elsewhere".to_owned()),
        None => {}
    }
    if has_identities {
        let identities = winner
            .identities
            .iter()
            .map(|it| format!("{} {}", it.name, it.id));
        let identities: Vec<String> = identities.collect();
        parts.push(match identities.as_slice() {
            [] => "for any other robot".to_owned(),
            identities => format!("for {}", identities.join(" and ")),
        });
    }
    parts.join(" ")
}

#[cfg(test)]
mod tests {
    use super::{below, docs_above};

    #[test]
    fn a_name_may_lead_above_or_below_a_parameter() {
        assert_eq!(below("a.b", "a.b"), Some(vec![]));
        assert_eq!(below("a.b.c", "a.b"), Some(vec!["c"]));
        assert_eq!(below("a", "a.b"), Some(vec![]));
        assert_eq!(below("a.c", "a.b"), None);
        assert_eq!(below("ab", "a.b"), None);
    }

    #[test]
    fn the_docs_of_a_field_stand_directly_above_it() {
        let text =
            "/// Struct.\nstruct A {\n    /// One\n    /// two.\n    a: u8,\n    b: u8,\n}\n";
        assert_eq!(docs_above(text, 5).as_deref(), Some("One two."));
        assert_eq!(docs_above(text, 6), None);
    }
}
