//! `completions` and `man`: every command is in them, and their readers understand them.

use std::fs;
use std::process::{Command, Stdio};

use support::skip;

use crate::{Ended, answer, commands};

const SHELLS: [&str; 5] = ["bash", "elvish", "fish", "powershell", "zsh"];

fn is_there(program: &str) -> bool {
    let mut command = Command::new(program);
    let command = command.arg("--version").stdin(Stdio::null());
    command.output().is_ok()
}

#[test]
fn every_shell_completes_every_command() {
    for shell in SHELLS {
        let script = answer(&format!("completions {shell}"));
        for command in commands() {
            assert!(
                script.contains(&command),
                "{command} is missing for {shell}"
            );
        }
        for option in ["if-fails", "deny-warnings", "manifest"] {
            assert!(script.contains(option), "{option} is missing for {shell}");
        }
    }
}

#[test]
fn the_shells_that_are_here_read_their_scripts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for shell in ["bash", "fish", "zsh"] {
        if !is_there(shell) {
            // No shell but bash can be asked of everybody.
            assert_ne!(shell, "bash", "bash is on every machine");
            continue;
        }
        let script = folder.path().join(shell);
        fs::write(&script, answer(&format!("completions {shell}"))).expect("the folder is ours");
        let ended = Ended::of(Command::new(shell).arg("-n").arg(&script)).expect(0);
        assert_eq!(ended.stderr, "", "{shell}");
    }
}

#[test]
fn bash_completes_commands_and_stages() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let script = folder.path().join("script");
    fs::write(&script, answer("completions bash")).expect("the folder is ours");
    for (line, expected) in [
        ("hulkgen exp", "explain"),
        ("hulkgen show sch", "schedule"),
        ("hulkgen check --fo", "--format"),
    ] {
        let count = line.split(' ').count();
        let last = line.split(' ').next_back().unwrap_or_default();
        let ask = format!(
            "source '{}'; COMP_WORDS=({line}); COMP_CWORD={}; _hulkgen hulkgen '{last}' x; echo \"${{COMPREPLY[@]}}\"",
            script.display(),
            count - 1,
        );
        let ended = Ended::of(Command::new("bash").args(["--norc", "-c", &ask])).expect(0);
        assert_eq!(ended.stdout.trim(), expected, "{line}: {}", ended.stderr);
    }
}

/// The page of hulkgen, then those of its commands, by name.
fn manual() -> Vec<(String, String)> {
    let own = ("hulkgen".to_owned(), answer("man"));
    let others = commands().into_iter().map(|command| {
        let page = answer(&format!("man {command}"));
        (format!("hulkgen-{command}"), page)
    });
    std::iter::once(own).chain(others).collect()
}

#[test]
fn every_command_has_a_manual_page() {
    for (name, page) in manual() {
        for part in [
            &*format!(".TH {name} 1"),
            ".SH NAME",
            ".SH SYNOPSIS",
            ".SH DESCRIPTION",
        ] {
            let is_there = page.lines().any(|line| line.starts_with(part));
            assert!(is_there, "`{part}` is missing in {name}:\n{page}");
        }
        assert!(page.contains(".SH \"EXIT STATUS\""), "{name}:\n{page}");
        assert!(
            name == "hulkgen" || page.contains(".SH \"EXAMPLE"),
            "{name}:\n{page}"
        );
    }
}

#[test]
fn groff_has_nothing_to_say_about_the_manual() {
    if !is_there("groff") {
        return skip("groff_has_nothing_to_say_about_the_manual", "groff");
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, page) in manual() {
        let file = folder.path().join(&name);
        fs::write(&file, &page).expect("the folder is ours");
        let mut groff = Command::new("groff");
        groff
            .args(["-man", "-Tutf8", "-ww", "-P-c", "-rLL=100n"])
            .arg(&file);
        let ended = Ended::of(&mut groff).expect(0);
        assert_eq!(ended.stderr, "", "{name}");
        // A command line of an example stays on one line.
        let help = match name.strip_prefix("hulkgen-") {
            Some(command) => answer(&format!("{command} --help")),
            None => String::new(),
        };
        let examples = help.split("\nExample").nth(1).unwrap_or_default().lines();
        for line in examples.filter_map(|line| line.split(" # ").next()) {
            if line.trim_start().starts_with("hulkgen") && line.len() < 90 {
                assert!(
                    ended.stdout.contains(line.trim()),
                    "{name}: `{line}` in\n{}",
                    ended.stdout
                );
            }
        }
    }
}
