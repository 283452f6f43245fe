//! The robot as the oracle knows it: cyclers from the manifest, files of nodes, types by name, parameter files.

use std::collections::BTreeMap;
use std::sync::Arc;

use toml::{Table, Value};

use crate::reading::{Definition, File};

/// Where parameter files lie.
pub(crate) const PARAMETERS: &str = "robotics/parameters/";

/// Everything that the rules are about. Clones share their files.
#[derive(Clone, Debug)]
pub(crate) struct Robot {
    /// The manifest's text.
    pub(crate) manifest: String,
    /// Every Rust file that can be read, by path.
    pub(crate) files: BTreeMap<String, Arc<File>>,
    /// Parameter files in the order of merging, by path.
    pub(crate) layers: Vec<(String, String)>,
    /// Where a type of this name is defined, and how.
    types: Arc<BTreeMap<String, Vec<(String, Definition)>>>,
}

/// A cycler of the manifest.
#[derive(Clone, Debug)]
pub(crate) struct Cycler {
    pub(crate) name: String,
    pub(crate) real_time: bool,
    /// Full names.
    pub(crate) instances: Vec<String>,
    pub(crate) nodes: Vec<Node>,
    /// `record = { while = "…" }`.
    pub(crate) recorded_while: Option<String>,
}

/// A node of a cycler.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) path: String,
    /// Where its file must lie.
    pub(crate) file: String,
    pub(crate) setup: bool,
}

impl Robot {
    /// Of a whole workspace: path and text of each file.
    pub(crate) fn new(texts: &BTreeMap<String, String>) -> Self {
        let mut robot = Self {
            manifest: String::new(),
            files: BTreeMap::new(),
            layers: Vec::new(),
            types: Arc::default(),
        };
        let mut types: BTreeMap<String, Vec<(String, Definition)>> = BTreeMap::new();
        for (path, text) in texts {
            robot.take(path, text);
            let file = robot.files.get(path);
            for (name, definition) in file.iter().flat_map(|file| &file.types) {
                let place = (path.clone(), definition.clone());
                types.entry(name.clone()).or_default().push(place);
            }
        }
        robot.types = Arc::new(types);
        robot
    }

    /// The robot with another text of one file.
    pub(crate) fn with(&self, path: &str, text: &str) -> Self {
        let mut robot = self.clone();
        robot.take(path, text);
        robot
    }

    fn take(&mut self, path: &str, text: &str) {
        if path == "hulk.toml" {
            self.manifest = text.to_owned();
        } else if path.starts_with(PARAMETERS) {
            match self.layers.iter_mut().find(|(layer, _)| layer == path) {
                Some((_, old)) => *old = text.to_owned(),
                None => self.layers.push((path.to_owned(), text.to_owned())),
            }
        } else if path.starts_with("robotics/") && path.ends_with(".rs") {
            match File::read(text) {
                Some(file) => self.files.insert(path.to_owned(), Arc::new(file)),
                None => self.files.remove(path),
            };
        }
    }

    fn table(&self) -> Table {
        let table = self.manifest.parse();
        table.expect("mutants of the manifest are TOML")
    }

    /// The cyclers in the manifest's order.
    pub(crate) fn cyclers(&self) -> Vec<Cycler> {
        let manifest = self.table();
        let cyclers = manifest["cycler"].as_array().expect("the NAO has cyclers");
        cyclers
            .iter()
            .filter_map(Value::as_table)
            .map(cycler)
            .collect()
    }

    /// Of each target: the folder of its location, whose files lie above those beside it.
    pub(crate) fn locations(&self) -> Vec<String> {
        let manifest = self.table();
        let targets = manifest["target"].as_array().expect("the NAO has targets");
        let locations = targets.iter().filter_map(|target| target.get("location"));
        let folder = |location: &Value| {
            let location = location.as_str().unwrap_or_default();
            format!("{PARAMETERS}{location}/")
        };
        locations.map(folder).collect()
    }

    /// The type of this name as a file sees it: its own, else the only one, else that of the crate `types`.
    pub(crate) fn definition(&self, file: &str, name: &str) -> Option<&Definition> {
        let found = self.types.get(name)?;
        let own = found.iter().find(|(place, _)| place == file);
        let shared = || {
            found
                .iter()
                .find(|(place, _)| place.starts_with("robotics/types/"))
        };
        let only = || found.first().filter(|_| found.len() == 1);
        own.or_else(shared)
            .or_else(only)
            .map(|(_, definition)| definition)
    }
}

/// As hulkgen names the field of an instance in the parameters.
pub(crate) fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}

fn cycler(table: &Table) -> Cycler {
    let name = table["name"]
        .as_str()
        .expect("a cycler has a name")
        .to_owned();
    let suffixes = table.get("instances").and_then(Value::as_array);
    let instances = suffixes.map_or_else(
        || vec![name.clone()],
        |suffixes| {
            suffixes
                .iter()
                .map(|one| format!("{name}{}", text(one, "name")))
                .collect()
        },
    );
    let listed = |key: &str, setup: bool| {
        let list = table
            .get(key)
            .and_then(Value::as_array)
            .cloned()
            .unwrap_or_default();
        list.into_iter()
            .map(move |one| node(text(&one, "node"), setup))
    };
    let recorded = table.get("record").and_then(|record| record.get("while"));
    Cycler {
        real_time: table["kind"].as_str() == Some("real-time"),
        nodes: listed("setup_nodes", true)
            .chain(listed("nodes", false))
            .collect(),
        recorded_while: recorded.and_then(Value::as_str).map(str::to_owned),
        name,
        instances,
    }
}

/// A string, or a table with this key.
fn text(value: &Value, key: &str) -> String {
    let inner = value.get(key).unwrap_or(value);
    inner.as_str().unwrap_or_default().to_owned()
}

fn node(path: String, setup: bool) -> Node {
    let (library, module) = path.split_once("::").unwrap_or((&path, ""));
    let file = format!("robotics/{library}/src/{}.rs", module.replace("::", "/"));
    Node { file, setup, path }
}
