//! What a reviewer reads: the diff of the NAO's generated crate for the changes that teams make every day.
//!
//! Kept as snapshots, so that a change to the generator shows what it does to every later review. Nothing unrelated moves.

use hulkgen::diagnostics::{self, Diagnostics};
use hulkgen::drift::{Changed, Drift};
use hulkgen::pipeline;
use hulkgen::render::GeneratedFiles;
use hulkgen::workspace::{Changes, Workspace};
use support::root;

fn nao() -> Workspace {
    let root = root();
    Workspace::at_root(root.as_path().try_into().expect("the path is UTF-8"))
}

fn generate(workspace: &Workspace) -> GeneratedFiles {
    let mut found = Diagnostics::new();
    pipeline::generate(workspace, &mut found)
        .unwrap_or_else(|_| panic!("{}", diagnostics::render(&found, workspace, false)))
}

/// One change of a team: files with what to replace, once each.
struct Edit(Changes);

impl Edit {
    fn new() -> Self {
        Self(Changes::new())
    }

    fn replace(mut self, file: &str, from: &str, to: &str) -> Self {
        let workspace = nao().after(&self.0);
        let text = workspace.read(file.into()).expect("the NAO has this file");
        assert_eq!(text.matches(from).count(), 1, "{from:?} in {file}");
        let text = text.replace(from, to);
        self.0.insert(file.into(), Some(text));
        self
    }

    fn add(mut self, file: &str, text: &str) -> Self {
        self.0.insert(file.into(), Some(text.to_owned()));
        self
    }

    /// Every line that the reviewer of the generated crate sees, after a look at the snapshot of it.
    fn review(self, name: &str) -> Review {
        let workspace = nao();
        let (before, after) = (generate(&workspace), generate(&workspace.after(&self.0)));
        let drift = between(&before, &after);
        let diff = without_numbers(&drift.diff());
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(root().join("snapshots/readable"));
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| insta::assert_snapshot!(name, diff));
        let of = |mark: char| {
            let lines = diff.lines().filter(|line| line.starts_with(mark));
            let lines = lines.filter(|line| !line.starts_with("+++") && !line.starts_with("---"));
            lines.map(|line| line[1..].trim().to_owned()).collect()
        };
        Review {
            added: of('+'),
            removed: of('-'),
        }
    }
}

/// Line numbers of hunks change with every node before them, whatever the change is.
fn without_numbers(diff: &str) -> String {
    let lines = diff.split_inclusive('\n');
    lines
        .map(|line| if line.starts_with("@@") { "@@\n" } else { line })
        .collect()
}

fn between(before: &GeneratedFiles, after: &GeneratedFiles) -> Drift {
    let mut drift = Drift::default();
    for (path, text) in after {
        // What the page reads, DATAFLOW.md tells people; .gitattributes leaves it out of diffs.
        if path.file_name() == Some("graph.json") {
            continue;
        }
        match before.get(path) {
            None => drift.added.push(path.clone()),
            Some(before) if before == text => {}
            Some(before) => drift.changed.push(Changed {
                path: path.clone(),
                before: before.clone(),
                after: text.clone(),
            }),
        }
    }
    let gone = before.keys().filter(|path| !after.contains_key(*path));
    drift.orphaned = gone.cloned().collect();
    drift
}

struct Review {
    added: Vec<String>,
    removed: Vec<String>,
}

impl Review {
    /// Lines are added, and those removed come again in other words: each names one of the words.
    fn only_about(&self, words: &[&str], most_removed: usize) {
        assert!(!self.added.is_empty(), "nobody sees the change");
        assert!(
            self.removed.len() <= most_removed,
            "these lines go: {:#?}",
            self.removed
        );
        for line in &self.removed {
            assert!(
                words.iter().any(|word| line.contains(word)),
                "what has this to do with {words:?}: {line}"
            );
        }
    }
}

const STEP_COUNTER: &str = r#"//! Counts the steps: how often the heavier foot has changed.

use framework::{AdditionalOutput, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::feet::Feet;

#[derive(Debug, Deserialize, Serialize)]
pub struct StepCounter {
    steps: u32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    sole_pressures: Input<Feet<f32>, "sole_pressures">,
    least_pressure: Parameter<f32, "step_counter.least_pressure">,
    difference: AdditionalOutput<f32, "step_counter.difference">,
}

#[context]
pub struct MainOutputs {
    steps: MainOutput<u32>,
}

impl StepCounter {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { steps: 0 })
    }

    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let difference = context.sole_pressures.left - context.sole_pressures.right;
        context.difference.fill_if_subscribed(|| difference);
        self.steps += u32::from(difference.abs() > *context.least_pressure);
        Ok(MainOutputs { steps: self.steps.into() })
    }
}
"#;

#[test]
fn a_node_more() {
    let review = Edit::new()
        .add("robotics/control/src/step_counter.rs", STEP_COUNTER)
        .replace(
            "robotics/control/src/lib.rs",
            "pub mod odometry;\n",
            "pub mod odometry;\npub mod step_counter;\n",
        )
        .replace(
            "hulk.toml",
            "    \"control::odometry\",\n",
            "    \"control::odometry\",\n    \"control::step_counter\",\n",
        )
        .review("a_node_more");
    review.only_about(&[], 0);
}

#[test]
fn an_output_more() {
    let review = Edit::new()
        .replace(
            "robotics/control/src/foot_pressure_filter.rs",
            "    sole_pressures: MainOutput<Feet<f32>>,\n",
            "    sole_pressures: MainOutput<Feet<f32>>,\n    /// The load on both.\n    weight: MainOutput<f32>,\n",
        )
        .review("an_output_more");
    review.only_about(&["sole_pressures"], 2);
}

#[test]
fn an_instance_more() {
    let review = Edit::new()
        .replace(
            "hulk.toml",
            "instances = [\"Top\", \"Bottom\"]",
            "instances = [\"Top\", \"Bottom\", \"Rear\"]",
        )
        .review("an_instance_more");
    review.only_about(&["VisionBottom", "vision_bottom", "4", "3", "5", "6"], 16);
}

#[test]
fn another_type() {
    let file = "robotics/control/src/foot_pressure_filter.rs";
    let mut edit = Edit::new().replace(
        file,
        "sole_pressures: MainOutput<Feet<f32>>",
        "sole_pressures: MainOutput<Feet<f64>>",
    );
    for reader in ["ground_contact_filter", "support_foot_filter"] {
        edit = edit.replace(
            &format!("robotics/control/src/{reader}.rs"),
            "Input<Feet<f32>, \"sole_pressures\">",
            "Input<Feet<f64>, \"sole_pressures\">",
        );
    }
    let review = edit.review("another_type");
    review.only_about(&["sole_pressures"], 3);
}

#[test]
fn another_order() {
    let whistle = "    \"control::whistle_filter\",\n";
    let review = Edit::new()
        .replace("hulk.toml", whistle, "")
        .replace(
            "hulk.toml",
            "    \"control::ball_filter\",\n",
            "    \"control::ball_filter\",\n    \"control::whistle_filter\",\n",
        )
        .review("another_order");
    assert_eq!(review.added.len(), review.removed.len());
}

#[test]
fn comments_change_nothing() {
    let edit = Edit::new()
        .replace("hulk.toml", "    # The game\n", "")
        .replace(
            "robotics/control/src/odometry.rs",
            "#[context]\npub struct CreationContext",
            "// Somebody thought about this for long.\n\n#[context]\npub struct CreationContext",
        );
    let workspace = nao();
    assert_eq!(generate(&workspace), generate(&workspace.after(&edit.0)));
}
