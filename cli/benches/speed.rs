//! How long `check` and `generate` take for the NAO, beside what cannot be done without.
//!
//! `cargo bench -p hulkgen --bench speed`. All rows are measured one after another in every round, so that whatever else
//! the machine does falls on all of them; only ratios within one run mean something. docs/performance.md has a table.

use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use camino::Utf8PathBuf;
use hulkgen::diagnostics::Diagnostics;
use hulkgen::digest::Digest;
use hulkgen::manifest;
use hulkgen::pipeline;
use hulkgen::workspace::Workspace;

/// Rounds that count, after one that does not.
const ROUNDS: usize = 31;

/// What is measured.
struct Row {
    name: &'static str,
    deed: Box<dyn Fn()>,
    times: Vec<Duration>,
}

/// The robot of this repository, and a cache folder of its own.
struct Scene {
    root: PathBuf,
    cache: tempfile::TempDir,
    /// Of the nodes, once each.
    nodes: Vec<PathBuf>,
    /// All that a `generate` reads, what it has generated included.
    all: Vec<PathBuf>,
}

fn main() {
    let scene = Scene::of_the_nao();
    println!("{}", scene.describe());
    let mut rows = rows(scene);
    for round in 0..=ROUNDS {
        for row in &mut rows {
            let start = Instant::now();
            (row.deed)();
            if round > 0 {
                row.times.push(start.elapsed());
            }
        }
    }
    print(&mut rows);
}

impl Scene {
    fn of_the_nao() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
        let root = root.expect("the crate lies in the repository").to_owned();
        let own = Utf8PathBuf::try_from(root.clone()).expect("the repository has a plain name");
        let workspace = Workspace::at_root(&own);
        let mut found = Diagnostics::new();
        let manifest = manifest::load(&workspace, &mut found).expect("the NAO has no errors");
        let files = pipeline::generate(&workspace, &mut found).expect("the NAO has no errors");
        let understood = pipeline::understand(&workspace, &mut found);
        let robot = understood.expect("the NAO has no errors").robot;
        let nodes = robot.cyclers.iter().flat_map(|cycler| &cycler.nodes);
        let mut nodes: Vec<_> = nodes.map(|node| root.join(&node.file)).collect();
        nodes.sort();
        nodes.dedup();
        assert!(nodes.len() > 20 && !manifest.cyclers.is_empty());
        let read = workspace.read_files();
        let all = read.iter().chain(files.keys()).map(|file| root.join(file));
        Self {
            nodes,
            all: all.filter(|file| file.is_file()).collect(),
            cache: tempfile::tempdir().expect("a folder can be made"),
            root,
        }
    }

    fn describe(&self) -> String {
        let bytes = |files: &[PathBuf]| -> u64 {
            let sizes = files
                .iter()
                .map(|file| fs::metadata(file).map_or(0, |it| it.len()));
            sizes.sum::<u64>() / 1000
        };
        format!(
            "{} node files ({} kB); {} files read by `generate` ({} kB)",
            self.nodes.len(),
            bytes(&self.nodes),
            self.all.len(),
            bytes(&self.all),
        )
    }

    fn hulkgen(&self, arguments: &'static [&str]) -> Box<dyn Fn()> {
        let (root, cache) = (self.root.clone(), self.cache.path().to_owned());
        Box::new(move || {
            let mut command = Command::new(env!("CARGO_BIN_EXE_hulkgen"));
            command.args(arguments).env("XDG_CACHE_HOME", &cache);
            succeed(command.current_dir(&root));
        })
    }
}

fn rows(scene: Scene) -> Vec<Row> {
    let row = |name, deed| Row {
        name,
        deed,
        times: Vec::new(),
    };
    // What differs would be written; a benchmark writes nothing.
    scene.hulkgen(&["generate", "--check", "--no-cache"])();
    let mut rows = vec![
        row("hulkgen --version", scene.hulkgen(&["--version"])),
        row("check --no-cache", scene.hulkgen(&["check", "--no-cache"])),
        row("check", scene.hulkgen(&["check"])),
        row(
            "generate --no-cache",
            scene.hulkgen(&["generate", "--no-cache"]),
        ),
        row("generate", scene.hulkgen(&["generate"])),
    ];
    let Scene {
        root,
        cache,
        nodes,
        all,
    } = scene;
    let parse = move || nodes.iter().for_each(|file| parse(file));
    let metadata = move || {
        let mut command = Command::new(env!("CARGO"));
        command.args(["metadata", "--format-version", "1", "--locked"]);
        succeed(command.current_dir(&root));
    };
    rows.push(row("parse the node files", Box::new(parse)));
    rows.push(row("cargo metadata", Box::new(metadata)));
    let hash = move || {
        // It is there as long as the rows are.
        let _ = &cache;
        all.iter().for_each(|file| hash(file));
    };
    rows.push(row("stat + read + hash", Box::new(hash)));
    rows
}

fn succeed(command: &mut Command) {
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let status = command.stdin(Stdio::null()).status();
    let status = status.expect("it can be started");
    assert!(status.success(), "{command:?} ends with {status}");
}

fn parse(file: &Path) {
    let text = fs::read_to_string(file).expect("it was read before");
    black_box(syn::parse_file(&text).expect("it was parsed before"));
}

fn hash(file: &Path) {
    black_box(fs::metadata(file).expect("it is there"));
    let content = fs::read(file).expect("it was read before");
    black_box(Digest::of(&content));
}

fn print(rows: &mut [Row]) {
    println!("\n{:24}{:>10}{:>10}{:>10}", "ms", "median", "p10", "p90");
    for row in rows.iter_mut() {
        row.times.sort();
        let [median, low, high] = [50, 10, 90].map(|percent| at(&row.times, percent));
        println!("{:24}{median:10.2}{low:10.2}{high:10.2}", row.name);
    }
    let median = |name: &str| {
        let row = rows.iter().find(|row| row.name == name);
        at(&row.expect("every row has a name").times, 50)
    };
    let parsed = median("parse the node files") + median("cargo metadata");
    let hashed = median("stat + read + hash");
    println!("\n{:48}{:>8}{:>8}", "ratio of medians", "is", "limit");
    for (name, floor, words, limit) in [
        ("check --no-cache", parsed, "parsing + metadata", 1.5),
        ("check", parsed, "parsing + metadata", 1.5),
        ("generate", hashed, "stat + read + hash", 10.0),
        ("check", hashed, "stat + read + hash", 10.0),
    ] {
        let words = format!("{name} / {words}");
        println!("{words:48}{:8.2}{limit:8.1}", median(name) / floor);
    }
}

/// Milliseconds that so many percent of the sorted times do not exceed.
fn at(times: &[Duration], percent: usize) -> f64 {
    times[(times.len() - 1) * percent / 100].as_secs_f64() * 1e3
}
