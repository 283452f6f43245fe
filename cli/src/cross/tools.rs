//! Brings the tools once, with pip, into the user's cache folder.

use std::fs;
use std::process::{Command, Stdio};

use camino::{Utf8Path, Utf8PathBuf};

use super::requirements::REQUIREMENTS;
use crate::digest::Digest;
use crate::outcome::Refusal;

/// Whole tools.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tools {
    /// Stands in for cargo and links through zig.
    pub zigbuild: Utf8PathBuf,
    /// The linker, and the compiler for C.
    pub zig: Utf8PathBuf,
}

impl Tools {
    /// The tools in the folder of the user's caches, brought there if they are not; `tell` hears that this takes a while.
    ///
    /// # Errors
    /// If there is no cache folder, no Python with pip, no network, or what comes has other digests.
    pub fn bring(caches: Option<Utf8PathBuf>, tell: impl FnOnce(&str)) -> Result<Self, Refusal> {
        let caches = caches.ok_or_else(|| {
            Refusal::bad("there is no cache folder for the tools that build for other machines")
                .help("set XDG_CACHE_HOME")
        })?;
        Self::bring_into(&caches.join("cross"), &python(), tell)
    }

    fn bring_into(
        folder: &Utf8Path,
        python: &str,
        tell: impl FnOnce(&str),
    ) -> Result<Self, Refusal> {
        // Other requirements are another folder; both may be in use.
        let digest = Digest::of(REQUIREMENTS.as_bytes()).to_string();
        let whole = folder.join(&digest);
        if !whole.is_dir() {
            tell(&format!("bringing zig and cargo-zigbuild into {whole}\n"));
            fs::create_dir_all(folder).map_err(|error| impossible(folder, &error))?;
            let half = tempfile::Builder::new()
                .prefix("half-")
                .tempdir_in(folder)
                .map_err(|error| impossible(folder, &error))?;
            let half_path = Utf8Path::from_path(half.path())
                .ok_or_else(|| Refusal::bad("the name of the cache folder is no UTF-8"))?;
            install(python, half_path)?;
            // Whole or not at all; another hulkgen may have been quicker.
            if let Err(error) = fs::rename(half_path, &whole)
                && !whole.is_dir()
            {
                return Err(impossible(&whole, &error));
            }
        }
        let tools = Self {
            zigbuild: whole.join("bin/cargo-zigbuild"),
            zig: whole.join("ziglang/zig"),
        };
        for tool in [&tools.zigbuild, &tools.zig] {
            if !tool.is_file() {
                return Err(Refusal::bad(format!("{tool} is missing"))
                    .help(format!("delete {whole}, so that it is brought again")));
            }
        }
        Ok(tools)
    }
}

/// The Python that brings them: the variable names another than the system's.
pub(crate) fn python() -> String {
    std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned())
}

fn install(python: &str, folder: &Utf8Path) -> Result<(), Refusal> {
    let requirements = folder.join("requirements.txt");
    fs::write(&requirements, REQUIREMENTS).map_err(|error| impossible(&requirements, &error))?;
    let run = |arguments: &[&str]| {
        Command::new(python)
            .args(["-m", "pip", "--disable-pip-version-check"])
            .args(arguments)
            .stdin(Stdio::null())
            .output()
    };
    let has_pip = run(&["--version"]).map_err(|error| {
        Refusal::bad(format!("cannot start `{python}`: {error}"))
            .help("install Python 3 with pip, or name it in the variable PYTHON")
    })?;
    if !has_pip.status.success() {
        return Err(Refusal::bad(format!("`{python}` has no pip"))
            .help("install it (Debian: `apt install python3-pip`), or name another Python in the variable PYTHON"));
    }
    let installed = run(&[
        "install",
        "--quiet",
        "--require-hashes",
        "--no-deps",
        "--only-binary",
        ":all:",
        "--target",
        folder.as_str(),
        "--requirement",
        requirements.as_str(),
    ]);
    let installed =
        installed.map_err(|error| Refusal::bad(format!("cannot start `{python}`: {error}")))?;
    if installed.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&installed.stderr);
    Err(Refusal::bad(format!(
        "pip cannot bring the tools that build for other machines:\n{}",
        said.trim()
    ))
    .help("they come from PyPI once: connect to it, or let pip know a mirror (PIP_INDEX_URL)"))
}

fn impossible(path: &Utf8Path, error: &std::io::Error) -> Refusal {
    Refusal::bad(format!("cannot write {path}: {error}")).help("make room, or set XDG_CACHE_HOME")
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::PermissionsExt as _;

    use super::*;

    /// A folder, and a Python that does what a script says.
    fn with_python(script: &str) -> (tempfile::TempDir, Utf8PathBuf, Utf8PathBuf) {
        let folder = tempfile::tempdir().expect("there is room");
        let path = Utf8Path::from_path(folder.path()).expect("it is UTF-8");
        let (python, cross) = (path.join("python"), path.join("cross"));
        fs::write(&python, format!("#!/bin/sh\n{script}")).expect("there is room");
        fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).expect("it is ours");
        (folder, python, cross)
    }

    /// `$9` is the folder for `--target`: `-m pip --disable… install --quiet --require-hashes …`.
    const WORKS: &str = r#"
case "$*" in *--version) exit 0 ;; esac
while [ "$1" != --target ]; do shift; done
mkdir -p "$2/bin" "$2/ziglang" && touch "$2/bin/cargo-zigbuild" "$2/ziglang/zig"
echo once >> "$2/../count"
"#;

    #[test]
    fn tools_are_brought_once() {
        let (_folder, python, cross) = with_python(WORKS);
        let first = Tools::bring_into(&cross, python.as_str(), |_| {}).expect("pip works");
        let again = Tools::bring_into(&cross, python.as_str(), |_| panic!("it is there"));
        assert_eq!(again, Ok(first));
        let count = fs::read_to_string(cross.join("count")).expect("it was brought");
        assert_eq!(count, "once\n");
    }

    #[test]
    fn what_is_missing_is_named_with_the_deed() {
        let help = |refusal: Refusal| refusal.help.unwrap_or_default();
        let (_folder, python, cross) = with_python("exit 1");
        let refusal = Tools::bring_into(&cross, python.as_str(), |_| {}).expect_err("no pip");
        assert!(refusal.message.ends_with("has no pip"), "{refusal:?}");
        assert!(help(refusal).contains("python3-pip"));
        let refusal = Tools::bring_into(&cross, "/no/python", |_| {}).expect_err("no Python");
        assert!(refusal.message.contains("/no/python"), "{refusal:?}");
        let script = "case \"$*\" in *--version) exit 0 ;; esac\necho no route >&2; exit 1";
        let (_folder, python, cross) = with_python(script);
        let refusal = Tools::bring_into(&cross, python.as_str(), |_| {}).expect_err("no network");
        assert!(refusal.message.contains("no route"), "{refusal:?}");
        assert!(help(refusal).contains("PyPI"));
        // Nothing half is left.
        assert_eq!(fs::read_dir(&cross).map(Iterator::count).ok(), Some(0));
    }
}
