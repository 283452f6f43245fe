//! What one node needs: the nodes that run before it in its instances. What others wrote stands in the frames.

use std::collections::BTreeMap;

use super::graph::Graph;
use crate::error::{Error, Result};
use crate::parameters::nearest;

/// The instances that run a node, and which of their nodes are run for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Needed {
    /// The node's path.
    pub node: String,
    /// By instance: the nodes up to and with it, in the order of their calls.
    instances: BTreeMap<String, Vec<String>>,
}

impl Needed {
    /// Of the node with this path, or whose path ends with this name, in the graph that `hulkgen graph --format json` prints.
    ///
    /// # Errors
    /// If there is no such node, more than one, or it is a setup node: what it wrote stands in the frames.
    pub fn new(name: &str, graph: &str) -> Result<Self> {
        let graph = Graph::read(graph)?;
        let node = graph.node(name)?.to_owned();
        let mut instances = BTreeMap::new();
        for cycler in graph.cyclers {
            let Some(last) = cycler.nodes.iter().find(|one| one.path == node) else {
                continue;
            };
            if last.setup {
                return Err(Error::new(format!(
                    "`{node}` is a setup node: a replay does not call it, what it wrote stands in the recording; name a node that reads it"
                )));
            }
            let order = last.order;
            let mut before: Vec<_> = cycler.nodes.into_iter().collect();
            before.retain(|one| !one.setup && one.order <= order);
            before.sort_by_key(|one| one.order);
            let before: Vec<_> = before.into_iter().map(|one| one.path).collect();
            let names = cycler.instances.into_iter();
            instances.extend(names.map(|instance| (instance, before.clone())));
        }
        Ok(Self { node, instances })
    }

    /// The nodes of an instance that are run; `None`: it does not run the node.
    pub fn of(&self, instance: &str) -> Option<&[String]> {
        self.instances.get(instance).map(Vec::as_slice)
    }

    /// All of them.
    pub fn all(&self) -> impl Iterator<Item = (&str, &[String])> {
        let all = self.instances.iter();
        all.map(|(instance, nodes)| (instance.as_str(), nodes.as_slice()))
    }
}

impl Graph {
    fn node(&self, name: &str) -> Result<&str> {
        let nodes = self.cyclers.iter().flat_map(|cycler| &cycler.nodes);
        let mut paths: Vec<_> = nodes.map(|node| node.path.as_str()).collect();
        paths.sort_unstable();
        paths.dedup();
        if let Some(exact) = paths.iter().find(|path| **path == name) {
            return Ok(exact);
        }
        let ending = format!("::{name}");
        let found: Vec<_> = paths
            .iter()
            .copied()
            .filter(|path| path.ends_with(&ending))
            .collect();
        match found.as_slice() {
            [only] => Ok(only),
            [] => {
                let last = |path: &&str| path.rsplit("::").next().unwrap_or_default().to_owned();
                let names: Vec<_> = paths.iter().map(last).collect();
                let all = paths
                    .iter()
                    .copied()
                    .chain(names.iter().map(String::as_str));
                let hint = match nearest(name, all) {
                    Some(nearest) => format!("did you mean `{nearest}`?"),
                    None => format!("the nodes are `{}`", paths.join("`, `")),
                };
                Err(Error::new(format!(
                    "the robot has no node `{name}`: {hint}"
                )))
            }
            several => Err(Error::new(format!(
                "`{name}` is the end of several paths, name one of them: `{}`",
                several.join("`, `")
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Needed;

    const GRAPH: &str = r#"{"cyclers": [
        {"instances": ["Top", "Bottom"], "nodes": [
            {"path": "a::eye", "setup": true, "order": 0, "fields": []},
            {"path": "a::second", "setup": false, "order": 2, "fields": []},
            {"path": "a::first", "setup": false, "order": 1, "fields": []},
            {"path": "a::third", "setup": false, "order": 3, "fields": []}]},
        {"instances": ["Body"], "nodes": [{"path": "b::first", "setup": false, "order": 0, "fields": []}]}]}"#;

    #[test]
    fn all_that_runs_before_a_node_is_needed_in_the_order_of_the_calls() {
        let needed = Needed::new("second", GRAPH).expect("there is one");
        assert_eq!(needed.node, "a::second");
        let first = ["a::first".to_owned(), "a::second".to_owned()];
        assert_eq!(
            needed.all().collect::<Vec<_>>(),
            [("Bottom", &first[..]), ("Top", &first[..])]
        );
        assert_eq!(needed.of("Body"), None);
    }

    #[test]
    fn what_cannot_be_replayed_says_what_to_name_instead() {
        for (name, message) in [
            ("first", "name one of them: `a::first`, `b::first`"),
            (
                "thrid",
                "the robot has no node `thrid`: did you mean `third`?",
            ),
            ("eye", "`a::eye` is a setup node"),
        ] {
            let error = Needed::new(name, GRAPH).expect_err("it is no such node");
            assert!(error.to_string().contains(message), "{error}");
        }
        assert!(Needed::new("a::first", "").is_err());
    }
}
