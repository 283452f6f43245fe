//! Programs and resources of this machine.

use std::ffi::OsString;
use std::process::{Command, Stdio};

use camino::Utf8Path;

use super::Finding;

/// The oldest Rust that builds robots: that of hulkgen's own workspace.
const RUST_VERSION: &str = env!("CARGO_PKG_RUST_VERSION");
const RUSTUP: &str = "install Rust from rustup.rs";

/// Free space below which a build may fail: a robot's debug build and its dependencies.
const SCARCE_GIBIBYTES: u64 = 5;
/// Free space with which no build is finished.
const NO_GIBIBYTES: u64 = 1;

/// rustc, cargo, git, python3, as they answer in the robot's folder: a `rust-toolchain.toml` there chooses among compilers.
pub(super) fn tools(root: &Utf8Path) -> Vec<Finding> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
    let answer = |program: OsString| answer(program, &["--version"], root);
    let git_help = "install git: merges of generated files and `hulkgen diff` ask it";
    let python_help = "install python3: some of the framework's tests read recordings with it";
    vec![
        rustc(answer("rustc".into()).as_deref()),
        match answer(cargo) {
            Some(version) => Finding::ok("cargo", version),
            None => Finding::bad("cargo", "cannot be started", RUSTUP),
        },
        match answer("git".into()) {
            Some(version) => Finding::ok("git", version),
            None => Finding::warning("git", "cannot be started", git_help),
        },
        match answer("python3".into()) {
            Some(version) => Finding::ok("python3", version),
            None => Finding::warning("python3", "cannot be started", python_help),
        },
    ]
}

/// Programs that put robots' programs onto robots.
pub(super) fn tools_of_deploy(root: &Utf8Path) -> Vec<Finding> {
    // ssh tells its version on stderr.
    let ssh = answer("ssh", &["-G", "localhost"], root).is_some();
    let rsync = answer("rsync", &["--version"], root);
    let needed = "`hulkgen deploy` needs it";
    vec![
        if ssh {
            Finding::ok("ssh", "can be started")
        } else {
            let help = format!("install openssh-client: {needed}");
            Finding::warning("ssh", "cannot be started", help)
        },
        match rsync.as_deref().and_then(|said| said.lines().next()) {
            Some(version) => Finding::ok("rsync", version),
            None => {
                let help = format!("install rsync, here and on the robot: {needed}");
                Finding::warning("rsync", "cannot be started", help)
            }
        },
    ]
}

/// What `build` asks to bring compilers for other machines, from PyPI.
pub(super) fn pip(python: &str, root: &Utf8Path) -> Finding {
    let about = "pip";
    match answer(python, &["-m", "pip", "--version"], root) {
        Some(version) => Finding::ok(about, version),
        None => Finding::warning(
            about,
            format!("`{python}` has none"),
            "install python3-pip, or name another Python in the variable PYTHON: `hulkgen build` brings compilers for other machines with it",
        ),
    }
}

/// Free disk in a folder.
pub(super) fn free_space(root: &Utf8Path) -> Finding {
    disk(answer("df", &["-Pk", "."], root).as_deref())
}

fn rustc(said: Option<&str>) -> Finding {
    let about = "rustc";
    let Some(said) = said else {
        return Finding::bad(about, "cannot be started", RUSTUP);
    };
    let version = said.split(' ').nth(1).unwrap_or_default();
    if numbers(version) >= numbers(RUST_VERSION) {
        Finding::ok(about, said)
    } else {
        let message = format!("{said} is older than {RUST_VERSION}");
        Finding::bad(about, message, "run `rustup update`")
    }
}

/// "1.95.0-nightly" as 1, 95, 0; a part that is no number as 0.
fn numbers(version: &str) -> [u32; 3] {
    let version = version.split('-').next().unwrap_or_default();
    let mut parts = version.split('.').map(|part| part.parse().unwrap_or(0));
    [(); 3].map(|()| parts.next().unwrap_or(0))
}

/// What `df -Pk` says: the fourth column of the second line is the free space in KiB.
pub(super) fn disk(said: Option<&str>) -> Finding {
    let about = "disk";
    let line = said.and_then(|said| said.lines().nth(1));
    let free = line.and_then(|line| line.split_whitespace().nth(3));
    let Some(free) = free.and_then(|free| free.parse::<u64>().ok()) else {
        return Finding::warning(about, "cannot tell how much is free", "look yourself");
    };
    let gibibytes = free >> 20;
    let message = format!("{gibibytes} GiB free");
    let help = "make room; `cargo clean` removes what was built";
    match gibibytes {
        free if free < NO_GIBIBYTES => Finding::bad(about, message, help),
        free if free < SCARCE_GIBIBYTES => Finding::warning(about, message, help),
        _ => Finding::ok(about, message),
    }
}

/// What a program prints in a folder; None if it cannot be started or fails.
pub(super) fn answer(
    program: impl Into<OsString>,
    arguments: &[&str],
    folder: &Utf8Path,
) -> Option<String> {
    let output = Command::new(program.into())
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .ok()?;
    let said = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    output.status.success().then_some(said)
}

#[cfg(test)]
mod tests;
