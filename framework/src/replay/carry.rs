//! Cycles that go on with what the cycle before left behind, in place of what was recorded there.
//!
//! A frame is made of two: states of nodes, what they share, previous outputs and histories of the replay's own last cycle;
//! everything that came from elsewhere as it was recorded. To the latter belongs what setup nodes left, which a replay
//! does not call.

use std::collections::BTreeSet;

use hulkgen_mcap::Layout;
use hulkgen_mcap::layout::{Part, PartKind, Unreadable, Values};

use super::graph::{Field, Graph};
use crate::error::{Error, Result};

/// What setup nodes of an instance leave behind.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Setup {
    /// Paths of the nodes.
    nodes: BTreeSet<String>,
    /// Of the states that they may write.
    states: Vec<String>,
}

impl Setup {
    /// Of an instance in the graph that `hulkgen graph --format json` prints.
    ///
    /// # Errors
    /// If it is no such graph.
    pub fn of(instance: &str, graph: &str) -> Result<Self> {
        let mut cyclers = Graph::read(graph)?.cyclers.into_iter();
        let cycler = cyclers.find(|one| one.instances.iter().any(|name| name == instance));
        let mut setup = Self::default();
        for node in cycler.into_iter().flat_map(|cycler| cycler.nodes) {
            if !node.setup {
                continue;
            }
            let is_written = |field: &Field| {
                let is_read_alone = |data: &String| data.starts_with('&');
                field.kind == "CyclerState" && !field.data.as_ref().is_some_and(is_read_alone)
            };
            let states = node.fields.into_iter().filter(is_written);
            setup.states.extend(states.filter_map(|field| field.path));
            setup.nodes.insert(node.path);
        }
        Ok(setup)
    }
}

/// The content of a frame, of what was recorded of the cycle and what the cycle before it left behind; both are of these
/// parts.
pub(super) fn composed(
    parts: &[Part],
    setup: &Setup,
    recorded: &[u8],
    left: &[u8],
) -> Result<Vec<u8>> {
    let mut both = Both {
        recorded: Side::new(recorded),
        left: Side::new(left),
        out: Vec::with_capacity(recorded.len()),
    };
    // The head is read before the content.
    for part in parts.iter().filter(|part| part.name != "head") {
        let unreadable = |error: Unreadable| {
            Error::new(format!("`{}` cannot be carried on: {error}", part.name))
        };
        match part.kind {
            PartKind::Node if setup.nodes.contains(&part.name) => both.take(&part.layout, false),
            PartKind::State => both.state(&part.layout, "", &setup.states),
            PartKind::Node | PartKind::Previous | PartKind::History => {
                both.take(&part.layout, true)
            }
            PartKind::Output | PartKind::Input | PartKind::Other => both.take(&part.layout, false),
        }
        .map_err(unreadable)?;
    }
    Ok(both.out)
}

/// Two contents of the same parts, and the one that is made of them.
struct Both<'bytes> {
    recorded: Side<'bytes>,
    left: Side<'bytes>,
    out: Vec<u8>,
}

struct Side<'bytes> {
    bytes: &'bytes [u8],
    values: Values<'bytes>,
}

impl<'bytes> Side<'bytes> {
    fn new(bytes: &'bytes [u8]) -> Self {
        let values = Values::new(bytes);
        Self { bytes, values }
    }

    fn next(&mut self, layout: &Layout) -> Result<&'bytes [u8], Unreadable> {
        let start = self.values.position();
        self.values.skip(layout)?;
        Ok(&self.bytes[start..self.values.position()])
    }
}

impl Both<'_> {
    fn take(&mut self, layout: &Layout, is_carried: bool) -> Result<(), Unreadable> {
        let (recorded, left) = (self.recorded.next(layout)?, self.left.next(layout)?);
        let taken = if is_carried { left } else { recorded };
        self.out.extend_from_slice(taken);
        Ok(())
    }

    /// What nodes share, apart from what setup nodes write of it.
    fn state(&mut self, layout: &Layout, path: &str, setup: &[String]) -> Result<(), Unreadable> {
        let is_below = |path: &str, above: &str| {
            let rest = path.strip_prefix(above);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.') || above.is_empty())
        };
        if setup
            .iter()
            .any(|written| !path.is_empty() && is_below(path, written))
        {
            return self.take(layout, false);
        }
        let Layout::Struct(of) = layout else {
            return self.take(layout, true);
        };
        if !setup.iter().any(|written| is_below(written, path)) {
            return self.take(layout, true);
        }
        for (name, layout) in &of.fields {
            let path = match path {
                "" => name.clone(),
                path => format!("{path}.{name}"),
            };
            self.state(layout, &path, setup)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use hulkgen_mcap::Layout;
    use hulkgen_mcap::layout::{Part, PartKind, Struct};

    use super::{Setup, composed};

    const GRAPH: &str = r#"{"cyclers": [{"instances": ["Top", "Bottom"], "nodes": [
        {"path": "a::eye", "setup": true, "order": 0, "fields": [
            {"kind": "CyclerState", "type": "u8", "path": "both.eye"},
            {"kind": "CyclerState", "type": "&u8", "path": "both.node"},
            {"kind": "Parameter", "type": "u8", "path": "gain"}]},
        {"path": "a::node", "setup": false, "order": 1, "fields": [
            {"kind": "CyclerState", "type": "u8", "path": "both.node"}]}]}]}"#;

    fn structure(fields: &[&str]) -> Layout {
        let fields = fields.iter();
        Layout::Struct(Struct {
            name: "S".to_owned(),
            fields: fields
                .map(|name| ((*name).to_owned(), Layout::Unsigned(8)))
                .collect(),
        })
    }

    #[test]
    fn what_setup_nodes_left_stays_as_it_was_recorded() {
        let setup = Setup::of("Bottom", GRAPH).expect("it is a graph");
        let part = |name: &str, kind, layout| Part {
            name: name.to_owned(),
            kind,
            layout,
        };
        let byte = || Layout::Unsigned(8);
        let shared = Layout::Struct(Struct {
            name: "CyclerState".to_owned(),
            fields: vec![
                ("alone".to_owned(), byte()),
                ("both".to_owned(), structure(&["eye", "node"])),
            ],
        });
        let parts = [
            part("head", PartKind::Other, byte()),
            part("parameters", PartKind::Other, byte()),
            part("a::eye", PartKind::Node, byte()),
            part("a::node", PartKind::Node, byte()),
            part("cycler_state", PartKind::State, shared),
            part("pose", PartKind::History, byte()),
            part("image", PartKind::Output, byte()),
            part("Other", PartKind::Input, byte()),
            part("speed", PartKind::Previous, byte()),
            part("width", PartKind::Other, Layout::Option(Box::new(byte()))),
        ];
        let mut left = [2; 11];
        left[10] = 0;
        let made = composed(&parts, &setup, &[1; 12], &left).expect("both are of these parts");
        assert_eq!(made, [1, 1, 2, 2, 1, 2, 2, 1, 1, 2, 1, 1]);
        assert!(composed(&parts, &setup, &[1; 9], &[2; 8]).is_err());
        assert!(Setup::of("Bottom", "").is_err());
    }
}
