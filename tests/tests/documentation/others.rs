//! Commands of other programs than hulkgen, as far as they can be judged without running them: whether what they name is there.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use support::root;

/// Programs that a page may call, with nothing in their arguments that this repository decides on.
const KNOWN: [&str; 6] = ["cat", "cd", "cp", "jq", "rsync", "ssh"];
const CARGO: [&str; 9] = [
    "bench", "build", "clippy", "fmt", "fuzz", "install", "package", "run", "test",
];
const GIT: [&str; 7] = [
    "add", "apply", "checkout", "commit", "config", "diff", "init",
];

/// What commands may name: packages with their folders, and scripts of npm.
pub(crate) struct Named {
    packages: BTreeMap<String, PathBuf>,
    scripts: serde_json::Value,
}

impl Named {
    pub(crate) fn load() -> Self {
        let read = |path: &str| fs::read_to_string(root().join(path)).expect("it is there");
        let table = |path: &str| read(path).parse::<toml::Table>().expect("it is TOML");
        let workspace = table("Cargo.toml");
        let members = workspace["workspace"]["members"].as_array();
        let members = members.expect("there are members").iter();
        let packages = members.filter_map(|member| {
            let member = member.as_str()?;
            let package = table(&format!("{member}/Cargo.toml"));
            let name = package["package"]["name"].as_str()?.to_owned();
            Some((name, root().join(member)))
        });
        let page: serde_json::Value =
            serde_json::from_str(&read("web/page/package.json")).expect("it is JSON");
        Self {
            packages: packages.collect(),
            scripts: page["scripts"].clone(),
        }
    }

    /// What is wrong with a command.
    pub(crate) fn objection(&self, command: &[String]) -> Option<String> {
        let words: Vec<&str> = command.iter().map(String::as_str).collect();
        let (program, arguments) = words.split_first()?;
        let first = arguments.first().copied().unwrap_or_default();
        match *program {
            "cargo" if !CARGO.contains(&first) => {
                Some(format!("`cargo {first}` is not known here"))
            }
            "cargo" => self.objection_to_cargo(arguments),
            "git" => (!GIT.contains(&first)).then(|| format!("`git {first}` is not known here")),
            "npm" => match arguments {
                ["ci"] => None,
                ["run", script] if self.scripts[script].is_string() => None,
                _ => Some("web/page/package.json has no such script".to_owned()),
            },
            "python3" | "node" => missing(first),
            program if KNOWN.contains(&program) => None,
            // What cargo builds.
            program if program.starts_with("target/") => None,
            program if program.contains('/') => missing(program),
            _ => Some("no test knows this program".to_owned()),
        }
    }

    fn objection_to_cargo(&self, arguments: &[&str]) -> Option<String> {
        // Else cargo takes the newest versions there are: compiled anew, untested, and not what is at hand offline.
        if arguments.first() == Some(&"install") && !arguments.contains(&"--locked") {
            return Some("add `--locked`, or Cargo.lock does not count".to_owned());
        }
        let own = arguments.split(|word| *word == "--").next()?;
        let of = |option: &str| {
            let at = own.iter().position(|word| *word == option)?;
            own.get(at + 1).copied()
        };
        let paths = ["--manifest-path", "--path", "--fuzz-dir"];
        if let Some(objection) = paths.into_iter().find_map(|option| missing(of(option)?)) {
            return Some(objection);
        }
        let package = of("-p")?;
        let Some(folder) = self.packages.get(package) else {
            return Some(format!("there is no package `{package}`"));
        };
        let kinds = [
            ("--test", "tests"),
            ("--bench", "benches"),
            ("--example", "examples"),
            ("--bin", "src/bin"),
        ];
        kinds.into_iter().find_map(|(option, below)| {
            let name = of(option)?;
            let file = folder.join(below).join(format!("{name}.rs"));
            let is_there = file.exists() || folder.join(below).join(name).is_dir();
            (!is_there).then(|| format!("`{package}` has no {option} {name}"))
        })
    }
}

fn missing(path: &str) -> Option<String> {
    (!root().join(path).exists()).then(|| format!("there is no {path}"))
}
