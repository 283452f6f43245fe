//! Tiny robots in memory, for tests of this crate.

use std::collections::BTreeMap;

use camino::Utf8PathBuf;

use crate::diagnostics::{Diagnostics, render};
use crate::manifest;
use crate::resolve::robot::Robot;
use crate::resolve::{self, parameter_files};
use crate::scan;
use crate::workspace::Workspace;

/// A workspace with a crate `nodes`, a crate `types`, a crate `hardware`, and a manifest.
#[derive(Clone)]
pub(crate) struct Fixture {
    files: BTreeMap<Utf8PathBuf, String>,
}

/// What the stages up to resolve, and the check of parameter files, say about a fixture.
pub(crate) struct Answer {
    pub(crate) robot: Option<Robot>,
    /// Names of codes by place.
    pub(crate) codes: Vec<&'static str>,
    /// All diagnostics as text.
    pub(crate) text: String,
}

/// A node file; every part may be empty.
#[derive(Clone, Copy, Default)]
pub(crate) struct Node<'a> {
    /// Lines above the structs.
    pub(crate) head: &'a str,
    pub(crate) creation: &'a str,
    pub(crate) cycle: &'a str,
    pub(crate) outputs: &'a str,
    /// Fields of the state.
    pub(crate) state: &'a str,
    /// Traits that `cycle` asks for.
    pub(crate) asks: &'a str,
    /// More functions of the node.
    pub(crate) more: &'a str,
}

const TYPES: &str = "
    mod hidden;
    pub mod shapes;
    pub use hidden::Shown;
    pub use hidden::Buried as Found;
    pub use shapes::*;
    pub type Distance = f32;
    pub type Listed<T> = Vec<T>;
    pub const COUNT: usize = 3;
    pub struct Ball { pub x: f32, pub position: Option<Point>, secret: u8 }
    pub struct Point { pub x: f32 }
    pub struct Wrapper<T> { pub value: T }
    #[derive(Deserialize)]
    pub struct Limits { pub low: f32, pub high: Option<f32>, #[serde(default)] pub step: u8 }
    #[derive(Deserialize)]
    pub enum Side { Left, Right }
";

const HARDWARE: &str = "
    pub struct Hardware;
    pub trait Camera { fn read(&self) -> Result<u8>; fn stop(&self); }
    pub trait Motors: Send { fn write(&self, value: u8) -> Result<()>; }
    pub trait Both: Camera + Motors {}
    trait Secret { fn write(&self); }
    impl framework::Hardware for Hardware {}
    impl Camera for Hardware {}
    impl Motors for Hardware {}
    impl Both for Hardware {}
    impl Secret for Hardware {}
";

const NODES_MANIFEST: &str = r#"
    [package]
    name = "nodes"
    [dependencies]
    framework = "1"
    nalgebra = "0.35"
    ordered-float = "5"
    serde = "1"
"#;

impl Fixture {
    pub(crate) fn new(manifest: &str) -> Self {
        let mut fixture = Self {
            files: BTreeMap::new(),
        };
        fixture.add(
            "hulk.toml",
            &format!("[robot]\nname = \"test\"\n{manifest}"),
        );
        fixture.add(
            "Cargo.toml",
            "[workspace]\nmembers = [\"crates/*\", \"generated\"]\n",
        );
        fixture.add("crates/nodes/Cargo.toml", NODES_MANIFEST);
        fixture.add("crates/nodes/src/lib.rs", "");
        fixture.add("crates/types/Cargo.toml", "[package]\nname = \"types\"\n");
        fixture.add("crates/types/src/lib.rs", TYPES);
        fixture.add(
            "crates/types/src/hidden.rs",
            "pub struct Shown;\npub struct Buried;\npub struct Lost;\n",
        );
        fixture.add(
            "crates/types/src/shapes.rs",
            "pub struct Line;\npub enum Shape { Round }\n",
        );
        fixture.add(
            "crates/hardware/Cargo.toml",
            "[package]\nname = \"hardware\"\n",
        );
        fixture.add("crates/hardware/src/lib.rs", HARDWARE);
        fixture
    }

    /// One real-time cycler `Control` with these nodes.
    pub(crate) fn control(nodes: &[&str]) -> Self {
        Self::new(&cycler("Control", "real-time", "", &[], nodes))
    }

    pub(crate) fn add(&mut self, path: &str, text: &str) {
        self.files.insert(path.into(), text.to_owned());
    }

    /// A node in the crate `nodes`.
    pub(crate) fn node(mut self, name: &str, node: Node<'_>) -> Self {
        let Node {
            head,
            creation,
            cycle,
            outputs,
            state,
            asks,
            more,
        } = node;
        let interface = if asks.is_empty() {
            String::new()
        } else {
            format!("<impl {asks}>")
        };
        let text = format!(
            "//! Test. More.\nuse framework::*;\nuse serde::{{Deserialize, Serialize}};\n{head}\n\
             #[derive(Deserialize, Serialize)]\npub struct Node {{\n{state}\n}}\n\
             #[context]\npub struct CreationContext {{\n{creation}\n}}\n\
             #[context]\npub struct CycleContext {{\n{cycle}\n}}\n\
             #[context]\npub struct MainOutputs {{\n{outputs}\n}}\n\
             impl Node {{\npub fn new(context: CreationContext) -> Result<Self> {{}}\n\
             pub fn cycle(&mut self, context: CycleContext{interface}) -> Result<MainOutputs> {{}}\n{more}\n}}\n"
        );
        self.add(&format!("crates/nodes/src/{name}.rs"), &text);
        let library = self
            .files
            .entry("crates/nodes/src/lib.rs".into())
            .or_default();
        library.push_str(&format!("pub mod {name};\n"));
        self
    }

    /// A file, on top of what is there.
    pub(crate) fn file(mut self, path: &str, text: &str) -> Self {
        self.add(path, text);
        self
    }

    pub(crate) fn text(&self, path: &str) -> String {
        self.files[camino::Utf8Path::new(path)].clone()
    }

    pub(crate) fn files(&self) -> BTreeMap<Utf8PathBuf, String> {
        self.files.clone()
    }

    pub(crate) fn answer(&self) -> Answer {
        let workspace = Workspace::in_memory(self.files.clone());
        let mut diagnostics = Diagnostics::new();
        let robot = resolve_all(&workspace, &mut diagnostics);
        diagnostics.silence(&workspace);
        Answer {
            robot,
            codes: diagnostics
                .sorted()
                .iter()
                .map(|one| one.code.name())
                .collect(),
            text: render(&diagnostics, &workspace, false),
        }
    }

    /// Exactly one diagnostic with this code, and these parts in its text.
    #[track_caller]
    pub(crate) fn expect(&self, code: &str, parts: &[&str]) -> Answer {
        let answer = self.answer();
        answer.expect_all(&[code], parts);
        answer
    }

    /// No diagnostic at all.
    #[track_caller]
    pub(crate) fn robot(&self) -> Robot {
        let answer = self.answer();
        assert!(answer.codes.is_empty(), "{}", answer.text);
        answer.robot.expect("there are no errors")
    }
}

fn resolve_all(workspace: &Workspace, diagnostics: &mut Diagnostics) -> Option<Robot> {
    let manifest = manifest::load(workspace, diagnostics).ok()?;
    let sources = scan::scan(workspace, &manifest, diagnostics).ok()?;
    let robot = resolve::resolve(workspace, &manifest, &sources, diagnostics).ok()?;
    if !robot.parameter_tree.branches.is_empty() {
        parameter_files::check(workspace, &manifest, &sources, &robot, diagnostics);
    }
    Some(robot)
}

impl Answer {
    /// This code is among the diagnostics, and these parts in their text.
    #[track_caller]
    pub(crate) fn expect_error(&self, code: &str, parts: &[&str]) {
        assert!(self.codes.contains(&code), "{}", self.text);
        let errors = self.text.matches("error[").count();
        assert_eq!(errors, 1, "{}", self.text);
        self.expect_parts(parts);
    }

    /// Exactly these codes, and these parts in their text.
    #[track_caller]
    pub(crate) fn expect_all(&self, codes: &[&str], parts: &[&str]) {
        assert_eq!(self.codes, codes, "{}", self.text);
        self.expect_parts(parts);
    }

    #[track_caller]
    fn expect_parts(&self, parts: &[&str]) {
        for part in parts {
            assert!(
                self.text.contains(part),
                "{part:?} is not in\n{}",
                self.text
            );
        }
    }
}

/// A `[[cycler]]` of the manifest; nodes without `::` are of the crate `nodes`.
pub(crate) fn cycler(name: &str, kind: &str, rest: &str, setup: &[&str], nodes: &[&str]) -> String {
    let list = |nodes: &[&str]| {
        let quoted: Vec<String> = nodes
            .iter()
            .map(|node| {
                if node.contains("::") {
                    format!("{node:?}")
                } else {
                    format!("\"nodes::{node}\"")
                }
            })
            .collect();
        quoted.join(", ")
    };
    format!(
        "[[cycler]]\nname = \"{name}\"\nkind = \"{kind}\"\nsetup_nodes = [{}]\nnodes = [{}]\n{rest}\n",
        list(setup),
        list(nodes)
    )
}
