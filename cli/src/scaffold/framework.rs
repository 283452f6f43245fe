//! Where a new robot takes the framework from.

use camino::{Utf8Path, Utf8PathBuf};

use crate::outcome::Refusal;
use crate::workspace::{Workspace, normalized, relative};

/// The folder of the framework in a checkout.
const FOLDER: &str = "framework";
/// Name of its package.
const PACKAGE: &str = "hulkgen-framework";
/// What serves the clients of the robot, and where it lies in the folder of the framework.
const COMMUNICATION: (&str, &str) = ("hulkgen-communication", "communication");

/// The framework of a new robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Framework {
    /// A checkout of hulkgen: its root, and the way to its framework as the robot writes it.
    Checkout { root: Utf8PathBuf, written: String },
    /// A version of the registry.
    Version(String),
}

impl Framework {
    /// What is asked for, or the checkout that hulkgen was built from if it still stands.
    ///
    /// A relative path counts from `current`; the robot then writes it relative to its own folder `robot`.
    pub fn choose(
        asked: Option<&str>,
        built_from: &Utf8Path,
        current: &Utf8Path,
        robot: &Utf8Path,
    ) -> Result<Self, Refusal> {
        let help = "give `--framework PATH` of a checkout of hulkgen, or `--framework VERSION`";
        let Some(asked) = asked else {
            return checkout(built_from, None).ok_or_else(|| {
                Refusal::wrong_usage(format!(
                    "hulkgen was built from `{built_from}`, where there is no framework any more"
                ))
                .help(help)
            });
        };
        if is_version(asked) {
            return Ok(Self::Version(asked.to_owned()));
        }
        let asked = Utf8Path::new(asked);
        let absolute = normalized(&current.join(asked));
        let from = asked.is_relative().then_some(robot);
        checkout(&absolute, from).ok_or_else(|| {
            Refusal::wrong_usage(format!("there is no framework in `{asked}`")).help(help)
        })
    }

    /// Its lines in `[workspace.dependencies]`: keys and right sides.
    pub fn dependencies(&self) -> [(&'static str, String); 2] {
        let (package, folder) = COMMUNICATION;
        let source = |folder: &str| {
            let (key, value) = match self {
                Self::Checkout { written, .. } => ("path", format!("{written}{folder}")),
                Self::Version(version) => ("version", version.clone()),
            };
            format!("{key} = {}", toml_edit::Value::from(value))
        };
        let framework = format!("{{ package = \"{PACKAGE}\", {} }}", source(""));
        let communication = format!("{{ {} }}", source(&format!("/{folder}")));
        [("framework", framework), (package, communication)]
    }
}

/// The checkout at a folder, which is its root or the framework in it; written relative to `from` if that is given.
fn checkout(folder: &Utf8Path, from: Option<&Utf8Path>) -> Option<Framework> {
    let above = folder.parent().unwrap_or(folder);
    let root = [folder, above].into_iter().find(|root| is_checkout(root))?;
    let framework = root.join(FOLDER);
    let written = match from {
        Some(robot) => relative(&normalized(robot), &framework),
        None => framework,
    };
    Some(Framework::Checkout {
        root: root.to_owned(),
        written: written.into_string(),
    })
}

fn is_checkout(root: &Utf8Path) -> bool {
    let package = Workspace::at_root(root).read(&Utf8Path::new(FOLDER).join("Cargo.toml"));
    let table = package
        .ok()
        .and_then(|text| text.parse::<toml::Table>().ok());
    let name = table
        .as_ref()
        .and_then(|table| table.get("package")?.get("name")?.as_str());
    name == Some(PACKAGE)
}

/// `0.1`, `^1.2.3` or `>=0.1, <0.3`; a folder of such a name is written `./1`.
fn is_version(text: &str) -> bool {
    let allowed = |letter: char| letter.is_ascii_alphanumeric() || " .,^~=<>*+-".contains(letter);
    let begins = text.trim_start_matches(['^', '~', '=', '<', '>', ' ']);
    begins.starts_with(|letter: char| letter.is_ascii_digit()) && text.chars().all(allowed)
}

#[cfg(test)]
mod tests {
    use camino::Utf8Path;

    use super::{Framework, is_version};
    use crate::outcome::Outcome;

    fn root() -> &'static Utf8Path {
        Utf8Path::new(env!("CARGO_MANIFEST_DIR"))
            .parent()
            .expect("cli lies in the repository")
    }

    #[test]
    fn a_version_is_no_path() {
        for version in ["0.1", "0.1.0", "^1.2", ">=0.1, <0.3", "=0.1.0-alpha.1"] {
            assert!(is_version(version), "{version}");
        }
        for path in ["hulkgen", "../hulkgen", "./1", "/srv/0.1", "v1"] {
            assert!(!is_version(path), "{path}");
        }
    }

    #[test]
    fn a_version_is_written_as_it_is() {
        let nowhere = Utf8Path::new("/nowhere");
        let framework =
            Framework::choose(Some("0.1"), nowhere, nowhere, nowhere).expect("it needs no disk");
        assert_eq!(
            framework.dependencies()[0].1,
            "{ package = \"hulkgen-framework\", version = \"0.1\" }"
        );
    }

    #[test]
    fn the_checkout_is_found_by_its_root_and_by_the_framework() {
        let current = Utf8Path::new("/");
        let robot = root()
            .parent()
            .expect("the repository lies somewhere")
            .join("robot");
        let default = Framework::choose(None, root(), current, &robot).expect("it stands");
        for asked in [root().to_string(), root().join("framework").to_string()] {
            let chosen =
                Framework::choose(Some(&asked), Utf8Path::new("/nowhere"), current, &robot);
            assert_eq!(chosen.as_ref(), Ok(&default));
        }
        let name = root().file_name().expect("the repository has a name");
        let beside = root().parent().expect("the repository lies somewhere");
        let relative = Framework::choose(
            Some(&format!("../{}/{name}", beside.file_name().unwrap_or("."))),
            root(),
            beside,
            &robot,
        );
        assert_eq!(
            relative.expect("it stands").dependencies()[0].1,
            format!("{{ package = \"hulkgen-framework\", path = \"../{name}/framework\" }}")
        );
    }

    #[test]
    fn without_a_framework_it_is_said_what_to_give() {
        let nowhere = Utf8Path::new("/nowhere");
        for asked in [None, Some("there")] {
            let refusal =
                Framework::choose(asked, nowhere, nowhere, nowhere).expect_err("there is none");
            assert_eq!(refusal.outcome, Outcome::WrongUsage);
            assert!(
                refusal
                    .help
                    .is_some_and(|help| help.contains("--framework PATH"))
            );
        }
    }
}
