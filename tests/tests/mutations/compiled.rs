//! Mutants that `check` accepts, compiled: nothing that rustc finds lies in the generated crate.
//!
//! A mutant may well break the author's own function, and then cargo never comes to the generated crate. Such a mutant is
//! compiled once more with functions that do nothing in its file, so that what check has accepted is compiled against.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use camino::Utf8Path;
use hulkgen::diagnostics::Diagnostics;
use hulkgen::drift::Drift;
use hulkgen::pipeline;
use hulkgen::render::GeneratedFiles;
use hulkgen::workspace::{Changes, Workspace};
use serde_json::Value;
use support::root;
use support::sharing::hand_over_registry;

use crate::mutants::{self, KINDS, Mutant};
use crate::reading::{with_idle_bodies, without_bodies};
use crate::robot::Robot;

/// What the generated crate is compiled of.
// The zoo: tests of the server need it, and cargo reads the manifests of all.
const FOLDERS: [&str; 6] = [
    "framework",
    "generated",
    "robotics",
    "tests/robots/outpost",
    "tests/robots/zoo",
    "web",
];

/// A copy of the robot that is compiled again and again.
///
/// It lies where cargo keeps what tests make: at the same place in the next run, which finds most of it compiled.
struct Copy {
    folder: PathBuf,
    /// Of the robot as it is; it holds every text.
    workspace: Workspace,
    /// Another run of this test waits until this one is done.
    _lock: File,
}

/// Whose an error of rustc is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    /// In what a function of the robot does.
    Body,
    /// In the robot's own files, but in no function.
    Robot,
    /// In the generated crate, or in what only it calls.
    Generated,
}

/// An error of rustc as people see it.
#[derive(Debug)]
struct Error {
    place: Place,
    rendered: String,
}

/// How rustc took a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Taken {
    Compiles,
    /// The robot's own functions do not compile, the rest does.
    BreaksBodies,
    /// Something of the robot's own outside its functions does not compile, so rustc saw nothing of the generated crate.
    BreaksRobot,
    BreaksGenerated,
}

impl Copy {
    fn new() -> Self {
        let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join("compiled");
        let folder = place.join("robot");
        fs::create_dir_all(&folder).expect("the folder is ours");
        let lock = File::open(&place).expect("it was just made");
        lock.lock().expect("nobody locks it for long");
        let mut files = BTreeMap::new();
        for below in FOLDERS {
            collect(&root(), Path::new(below), &mut files);
        }
        let mut there = BTreeMap::new();
        for below in FOLDERS.iter().filter(|below| folder.join(below).is_dir()) {
            collect(&folder, Path::new(below), &mut there);
        }
        for file in ["Cargo.lock", "hulk.toml"] {
            files.insert(file.into(), fs::read(root().join(file)).expect(file));
        }
        files.insert("Cargo.toml".into(), manifest().into());
        for stale in there.keys().filter(|file| !files.contains_key(*file)) {
            fs::remove_file(folder.join(stale)).expect("the folder is ours");
        }
        for (file, content) in files {
            let path = folder.join(file);
            // What is touched is compiled again.
            if fs::read(&path).ok().as_ref() != Some(&content) {
                fs::create_dir_all(path.parent().expect("a file lies in a folder"))
                    .and_then(|()| fs::write(&path, content))
                    .expect("the folder is ours");
            }
        }
        let workspace = Workspace::at_root(Utf8Path::from_path(&folder).expect("UTF-8"));
        let copy = Self {
            folder,
            workspace,
            _lock: lock,
        };
        hand_over_registry(&copy.target()).expect("the folder is ours");
        copy
    }

    /// To cargo its packages are those of the repository: what is compiled here must not take their place.
    fn target(&self) -> PathBuf {
        self.folder.with_file_name("target")
    }

    /// What hulkgen writes after these changes, if `check` accepts them.
    fn accepted(&self, changes: &Changes) -> Option<GeneratedFiles> {
        let mut diagnostics = Diagnostics::new();
        let files = pipeline::generate(&self.workspace.after(changes), &mut diagnostics);
        files.ok().filter(|_| !diagnostics.has_errors())
    }

    fn write_generated(&self, files: &GeneratedFiles) {
        let root = self.workspace.root();
        let drift = Drift::compare(root, "generated".into(), files).expect("the folder is ours");
        drift.write(root, files).expect("the folder is ours");
    }

    fn write(&self, file: &str, text: &str) {
        fs::write(self.folder.join(file), text).expect("the folder is ours");
    }

    /// What rustc finds in the generated crate and in what it needs.
    fn check(&self) -> Vec<Error> {
        let messages = self.compile();
        let errors = messages.iter();
        errors.filter_map(|message| self.error(message)).collect()
    }

    /// What cargo says.
    fn compile(&self) -> Vec<Value> {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let output = Command::new(cargo)
            .args(["check", "--offline", "--message-format=json"])
            .args(["--package", "nao_runtime", "--keep-going", "--target-dir"])
            .arg(self.target())
            .current_dir(&self.folder)
            .output()
            .expect("cargo runs these tests, so it is there");
        let lines = output
            .stdout
            .split(|byte| *byte == b'\n')
            .filter(|line| !line.is_empty());
        let messages: Vec<Value> = lines
            .map(|line| serde_json::from_slice(line).expect("cargo writes JSON"))
            .collect();
        assert_ne!(
            output.status.success(),
            messages.iter().any(|message| self.error(message).is_some()),
            "cargo failed otherwise: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        messages
    }

    /// The error that a message of cargo's tells.
    fn error(&self, message: &Value) -> Option<Error> {
        let message = &message["message"];
        if message["level"]
            .as_str()
            .is_none_or(|level| !level.starts_with("error"))
        {
            return None;
        }
        // The summary at the end has no place.
        let spans = message["spans"].as_array()?;
        let span = spans.iter().find(|span| span["is_primary"] == true)?;
        let calls = std::iter::successors(Some(span), |span| span["expansion"].get("span"));
        let places = calls.map(|span| self.place(span));
        Some(Error {
            place: places.max().expect("the span itself is one"),
            rendered: message["rendered"].as_str().unwrap_or_default().to_owned(),
        })
    }

    fn place(&self, span: &Value) -> Place {
        let file = span["file_name"].as_str().unwrap_or_default();
        if !file.starts_with("robotics/") {
            return Place::Generated;
        }
        let text = fs::read_to_string(self.folder.join(file)).expect("rustc has read it");
        let at = span["byte_start"].as_u64().expect("a number") as usize;
        // What the one has and the other has not stands in a function.
        match text.as_bytes()[at] == without_bodies(&text).as_bytes()[at] {
            true => Place::Robot,
            false => Place::Body,
        }
    }

    /// Compiles the robot with one file mutated, and restores it.
    fn take(&self, file: &str, mutated: &str, generated: &GeneratedFiles) -> (Taken, Vec<Error>) {
        let original = self.workspace.read(file.into()).expect("it was mutated");
        self.write(file, mutated);
        self.write_generated(generated);
        let mut errors = self.check();
        let mut taken = Taken::Compiles;
        if errors.iter().any(|error| error.place == Place::Body) && file.ends_with(".rs") {
            taken = Taken::BreaksBodies;
            errors.retain(|error| error.place != Place::Body);
            self.write(file, &with_idle_bodies(mutated));
            errors.extend(self.check());
        }
        self.write(file, &original);
        let worst = errors.iter().map(|error| error.place).max();
        let taken = match worst {
            None => taken,
            Some(Place::Generated) => Taken::BreaksGenerated,
            Some(Place::Body | Place::Robot) => Taken::BreaksRobot,
        };
        (taken, errors)
    }
}

/// Every file in a folder and below, by its path from the root.
fn collect(root: &Path, folder: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(root.join(folder)).expect("the folder is there") {
        let path = folder.join(entry.expect("it was just listed").file_name());
        if root.join(&path).is_dir() {
            collect(root, &path, found);
        } else {
            let content = fs::read(root.join(&path)).expect("it was just listed");
            found.insert(path, content);
        }
    }
}

/// The workspace with the packages that the generated crate needs.
fn manifest() -> String {
    let text = fs::read_to_string(root().join("Cargo.toml")).expect("the root has it");
    let mut manifest: toml::Table = text.parse().expect("cargo reads it, too");
    let workspace = manifest["workspace"].as_table_mut().expect("a workspace");
    workspace.remove("default-members");
    let members = workspace["members"].as_array_mut().expect("its packages");
    members.retain(|member| {
        let member = member.as_str().unwrap_or_default();
        let is_below = |folder: &&str| Path::new(member).starts_with(folder);
        FOLDERS.iter().any(is_below) && member != "framework/loom"
    });
    manifest.to_string()
}

/// Small and the same everywhere: the generator "splitmix64" of Steele, Lea and Flood (2014).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((mixed ^ (mixed >> 31)) % limit as u64) as usize
    }
}

/// A number from the environment.
fn number(variable: &str, default: u64) -> u64 {
    let given = std::env::var(variable).ok();
    given.map_or(default, |given| given.parse().expect("it is a number"))
}

/// Mutants of what is compiled; parameter files are not.
fn candidates() -> Vec<Mutant> {
    let texts = crate::without_bodies(crate::texts());
    let mutants = mutants::mutants(&Robot::new(&texts), &texts).into_iter();
    let is_compiled = |mutant: &Mutant| !mutant.file.starts_with("robotics/parameters/");
    mutants.filter(is_compiled).collect()
}

#[test]
fn what_check_accepts_leaves_no_error_in_the_generated_crate() {
    let (count, seed) = (number("HULKGEN_COMPILED", 3), number("HULKGEN_SEED", 1));
    let started = Instant::now();
    let copy = Copy::new();
    let unchanged = copy
        .accepted(&Changes::new())
        .expect("the robot is accepted");
    copy.write_generated(&unchanged);
    let messages = copy.compile();
    let errors: Vec<_> = messages
        .iter()
        .filter_map(|message| copy.error(message))
        .collect();
    assert!(errors.is_empty(), "the robot itself compiles: {errors:#?}");
    // Build scripts and macros at least: tests are compiled with them.
    let is_fresh = |message: &Value| message["fresh"] == true;
    assert!(
        messages.iter().any(is_fresh),
        "everything was compiled anew"
    );
    println!("the robot in {:.1?}", started.elapsed());

    // A mistake of hulkgen would be seen.
    let mut broken = unchanged;
    let library = broken.get_mut(Utf8Path::new("generated/src/lib.rs"));
    library
        .expect("every package has one")
        .push_str("pub const BROKEN: u32 = true;\n");
    copy.write_generated(&broken);
    let errors = copy.check();
    let places: Vec<_> = errors.iter().map(|error| error.place).collect();
    assert_eq!(places, [Place::Generated], "{errors:#?}");

    let mut candidates = candidates();
    let mut random = Random(seed);
    let mut taken = Vec::new();
    let started = Instant::now();
    while taken.len() < count as usize {
        let mutant = candidates.swap_remove(random.below(candidates.len()));
        let original = copy.workspace.read(mutant.file.as_str().into());
        let mutated = mutant.apply(&original.expect("it is mutated"));
        let changes = Changes::from([(mutant.file.clone().into(), Some(mutated.clone()))]);
        if let Some(generated) = copy.accepted(&changes) {
            let (how, errors) = copy.take(&mutant.file, &mutated, &generated);
            taken.push((mutant, how, errors));
        }
    }
    println!(
        "{count} mutants of seed {seed} in {:.1?}",
        started.elapsed()
    );
    report(&taken);
    let is_wrong = |how: Taken| how == Taken::BreaksGenerated;
    let wrong = taken.iter().filter(|(_, how, _)| is_wrong(*how)).count();
    assert_eq!(wrong, 0, "errors in the generated crate, seed {seed}");
}

fn report(taken: &[(Mutant, Taken, Vec<Error>)]) {
    let hows = [
        Taken::Compiles,
        Taken::BreaksBodies,
        Taken::BreaksRobot,
        Taken::BreaksGenerated,
    ];
    println!("| kind | compiles | but for bodies | but for the robot's own | generated |");
    for kind in KINDS.iter().map(Some).chain([None]) {
        let count = |wanted: Taken| {
            let of_kind = |mutant: &Mutant| kind.is_none_or(|kind| mutant.kind == *kind);
            let all = taken.iter();
            all.filter(|(mutant, how, _)| *how == wanted && of_kind(mutant))
                .count()
        };
        let counts = hows.map(|how| count(how).to_string());
        println!("| {} | {} |", kind.unwrap_or(&"all"), counts.join(" | "));
    }
    for (mutant, how, errors) in taken.iter().filter(|(.., errors)| !errors.is_empty()) {
        println!("{how:?} {mutant:?}");
        errors
            .iter()
            .for_each(|error| println!("{}", error.rendered));
    }
}
