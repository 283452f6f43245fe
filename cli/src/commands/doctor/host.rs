//! A robot behind ssh: whether it answers, fits its target, and is fit for real time.

use super::{Finding, machine, running, system};
use crate::arguments::Reached;
use crate::commands::deploy;
use crate::commands::{Failure, session::Session};
use crate::deploy::script::quoted;
use crate::deploy::{Fit, fit_of_triple};
use crate::workspace::Workspace;

/// Before every file, and before the name of what is no file.
const MARK: &str = "@@hulkgen@@ ";

pub(super) fn look(
    session: &mut Session<'_>,
    host: &str,
    reached: &Reached,
) -> Result<Vec<Finding>, Failure> {
    let about = "reached";
    let (remote, reached) = deploy::remote(session, host, reached)?;
    let said = match remote.shell(&script(reached.folder())) {
        Ok(said) => said,
        Err(failed) => {
            let help = format!(
                "try `{}`: network, key, and the host's key",
                remote.as_typed()
            );
            return Ok(vec![Finding::bad(about, failed.message, help)]);
        }
    };
    let files = Workspace::in_memory(parts(&said));
    let read = |name: &str| {
        files
            .read(name.into())
            .map(|text| text.trim().to_owned())
            .unwrap_or_default()
    };
    let mut findings = vec![
        Finding::ok(
            about,
            format!("`{host}` answers at `{}`", remote.destination),
        ),
        fit(
            &read("hulkgen/machine"),
            &read("hulkgen/libc"),
            reached.triple(),
        ),
        rsync(&read("hulkgen/rsync")),
        version(&read("hulkgen/current")),
    ];
    if reached.is_of_a_user() {
        findings.push(lingering(&read("hulkgen/lingers")));
    }
    findings.push(machine::disk(Some(&read("hulkgen/disk"))));
    findings.extend(system::look(&files, "this user there"));
    // The robot's program listens where ssh does, if the destination is an address.
    findings.extend(running::look(Some(remote.destination.host())));
    Ok(findings)
}

/// Prints the files that [`system::look`] reads, and answers of programs as files of `hulkgen/`.
fn script(folder: &str) -> String {
    let files: Vec<String> = system::FILES
        .iter()
        .map(|file| format!("/{file}"))
        .collect();
    let folder = quoted(folder);
    format!(
        r#"part() {{ echo; echo "{MARK}$1"; }}
for file in {}; do [ -r "$file" ] && part "${{file#/}}" && cat "$file"; done
part hulkgen/machine; uname -m
part hulkgen/libc; getconf GNU_LIBC_VERSION 2>/dev/null
part hulkgen/rsync; rsync --version 2>/dev/null | head -n 1
part hulkgen/current; [ -e {folder}/current ] && basename "$(readlink {folder}/current)"
part hulkgen/lingers; id -un; [ -e "/var/lib/systemd/linger/$(id -un)" ] && echo lingers
part hulkgen/disk; if [ -d {folder} ]; then df -Pk {folder}; else df -Pk .; fi
exit 0
"#,
        files.join(" ")
    )
}

/// (path, text) of every part.
fn parts(said: &str) -> Vec<(String, String)> {
    let parts = said
        .split(MARK)
        .skip(1)
        .filter_map(|part| part.split_once('\n'));
    parts
        .map(|(name, text)| (name.trim().to_owned(), text.to_owned()))
        .collect()
}

/// Whether programs for the target's triple start there: `x86_64-unknown-linux-gnu.2.28`.
fn fit(machine: &str, libc: &str, triple: Option<&str>) -> Finding {
    let about = "machine";
    let libc_version = libc.strip_prefix("glibc ");
    let said = match libc_version {
        Some(version) => format!("{machine}, glibc {version}"),
        None => format!("{machine}, without glibc"),
    };
    let Some(triple) = triple else {
        return Finding::ok(about, said);
    };
    let (plain, needed) = triple
        .split_once('.')
        .map_or((triple, None), |(plain, version)| (plain, Some(version)));
    let fit = fit_of_triple(plain, machine);
    if fit == Fit::Fails {
        let message = format!("{said}: programs for `{triple}` do not start");
        return Finding::bad(
            about,
            message,
            "name the robot's machine: `triple` of the target in hulk.toml",
        );
    }
    let is_older = needed
        .zip(libc_version)
        .is_some_and(|(needed, has)| numbers(has) < numbers(needed));
    if is_older {
        let message = format!("{said}: programs for `{triple}` need a newer one");
        return Finding::bad(
            about,
            message,
            "name the robot's glibc behind the triple of the target in hulk.toml",
        );
    }
    match fit {
        Fit::StartsAsSmaller => Finding::warning(
            about,
            format!("{said}: programs for `{triple}` start if the system has libraries for them"),
            "deploy and see, or name the robot's machine: `triple` of the target in hulk.toml",
        ),
        _ => Finding::ok(about, said),
    }
}

fn numbers(version: &str) -> Vec<u32> {
    version
        .split('.')
        .map_while(|part| part.parse().ok())
        .collect()
}

fn rsync(said: &str) -> Finding {
    if said.is_empty() {
        return Finding::bad(
            "rsync",
            "the robot has none",
            "install rsync there: `hulkgen deploy` needs it at both ends",
        );
    }
    Finding::ok("rsync", said)
}

fn version(said: &str) -> Finding {
    if said.is_empty() {
        return Finding::warning(
            "version",
            "nothing was deployed yet",
            "run `hulkgen deploy`",
        );
    }
    Finding::ok("version", said)
}

/// Whether the user's systemd outlives ssh, by what its file says of it: the user's name, and `lingers` if it does.
fn lingering(said: &str) -> Finding {
    let about = "lingering";
    let mut lines = said.lines();
    let user = lines.next().unwrap_or_default();
    if lines.next() == Some("lingers") {
        return Finding::ok(
            about,
            format!("units of `{user}` run while nobody is logged in"),
        );
    }
    Finding::warning(
        about,
        format!("units of `{user}` end with its last connection, and do not start with the robot"),
        format!("run `sudo loginctl enable-linger {user}` there, once"),
    )
}

#[cfg(test)]
mod tests {
    use super::{fit, lingering, parts, script};
    use crate::commands::doctor::State;

    #[test]
    fn a_program_for_another_machine_is_bad() {
        let triple = Some("x86_64-unknown-linux-gnu.2.28");
        assert_eq!(fit("x86_64", "glibc 2.41", triple).state, State::Ok);
        assert_eq!(fit("x86_64", "glibc 2.28", triple).state, State::Ok);
        assert_eq!(fit("x86_64", "glibc 2.9", triple).state, State::Bad);
        assert_eq!(fit("aarch64", "glibc 2.41", triple).state, State::Bad);
        assert_eq!(fit("aarch64", "", None).message, "aarch64, without glibc");
        assert_eq!(
            fit("i686", "", Some("i586-unknown-linux-musl")).state,
            State::Ok
        );
        let arm = Some("armv7-unknown-linux-gnueabihf");
        assert_eq!(fit("armv7l", "glibc 2.41", arm).state, State::Ok);
        assert_eq!(fit("aarch64", "glibc 2.41", arm).state, State::Warning);
        let riscv = Some("riscv64gc-unknown-linux-gnu");
        assert_eq!(fit("riscv64", "glibc 2.41", riscv).state, State::Ok);
    }

    #[test]
    fn a_users_units_that_end_with_the_connection_are_warned_of() {
        assert_eq!(lingering("nao\nlingers").state, State::Ok);
        let finding = lingering("nao");
        assert_eq!(finding.state, State::Warning);
        let help = finding.help.expect("a warning has one");
        assert!(help.contains("`sudo loginctl enable-linger nao`"), "{help}");
    }

    #[test]
    fn files_come_in_parts() {
        let said = "Welcome!\n\n@@hulkgen@@ etc/os-release\nNAME=x\n\n@@hulkgen@@ hulkgen/machine\nx86_64\n";
        let expected = [
            ("etc/os-release", "NAME=x\n\n"),
            ("hulkgen/machine", "x86_64\n"),
        ];
        let expected = expected.map(|(name, text)| (name.to_owned(), text.to_owned()));
        assert_eq!(parts(said), expected);
    }

    #[test]
    fn a_shell_reads_the_script_and_gives_the_parts() {
        let output = std::process::Command::new("sh")
            .args(["-c", &script("/nowhere, it's")])
            .output();
        let output = output.expect("there is a shell");
        assert!(
            output.stderr.is_empty(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        let parts = parts(&said);
        for name in [
            "proc/self/limits",
            "proc/self/status",
            "hulkgen/machine",
            "hulkgen/disk",
        ] {
            let part = parts.iter().find(|(part, _)| part == name);
            assert!(
                part.is_some_and(|(_, text)| text.trim().len() > 2),
                "{name}: {said}"
            );
        }
    }
}
