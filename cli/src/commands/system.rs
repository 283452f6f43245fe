//! Which commands this system can serve: the robot's program and its hardware need Linux, everything that only reads and
//! writes files does not.

use crate::arguments::Command;
use crate::outcome::Refusal;

/// The only system that robots run on, as [`std::env::consts::OS`] names it.
const LINUX: &str = "linux";

/// Refuses what builds or runs a robot's program on a system that it is not for.
pub(super) fn refuse_elsewhere(command: &Command, system: &str) -> Result<(), Refusal> {
    let name = match command {
        Command::Run(_) => "run",
        Command::Build(_) => "build",
        Command::Deploy(_) => "deploy",
        Command::Simulate(_) => "simulate",
        Command::Vision(_) => "vision",
        Command::Replay(_) => "replay",
        Command::Capture(_) => "capture",
        Command::Check(check) if check.cargo => "check --cargo",
        _ => return Ok(()),
    };
    if system == LINUX {
        return Ok(());
    }
    let refusal = format!("`hulkgen {name}` needs Linux, and this is {system}");
    Err(Refusal::wrong_usage(refusal).help(
        "build and run robots on Linux; here `check`, `generate`, `explain`, `graph`, `diff` and `show` work",
    ))
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::*;
    use crate::arguments::Arguments;
    use crate::outcome::Outcome;

    fn refusal(words: &[&str], system: &str) -> Option<Refusal> {
        let words = ["hulkgen"].iter().chain(words);
        let arguments = Arguments::try_parse_from(words).expect("it is a command");
        refuse_elsewhere(&arguments.command, system).err()
    }

    #[test]
    fn what_only_reads_and_writes_files_works_elsewhere() {
        for words in [
            &["check"][..],
            &["generate", "--check"],
            &["graph"],
            &["new", "scout"],
            &["recording", "list"],
        ] {
            assert!(refusal(words, "macos").is_none(), "{words:?}");
        }
    }

    #[test]
    fn what_runs_a_robot_says_so_elsewhere_and_is_wrong_usage() {
        for words in [
            &["run"][..],
            &["build"],
            &["simulate", "stand.toml"],
            &["replay", "recording.mcap", "--verify"],
            &["check", "--cargo"],
        ] {
            let refused = refusal(words, "macos").expect("it needs Linux");
            assert_eq!(refused.outcome, Outcome::WrongUsage, "{words:?}");
            assert!(
                refused.message.contains("this is macos"),
                "{}",
                refused.message
            );
            assert!(refusal(words, "linux").is_none(), "{words:?}");
        }
    }
}
