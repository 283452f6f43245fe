//! `simulate`: generate, build, and let the robot's program play scenarios, one after the other.

use std::ffi::OsString;

use camino::{Utf8Path, Utf8PathBuf};

use super::Failure;
use super::run::{Wanted, absolute, build, end_of_robot};
use super::session::Session;
use crate::arguments::{Simulate, TextOrJson};
use crate::interrupt::Ended;
use crate::outcome::{Outcome, Refusal};

pub(super) fn run(session: &mut Session<'_>, simulate: &Simulate) -> Result<Outcome, Failure> {
    // Before anything is built.
    if let Some(missing) = simulate.scenarios.iter().find(|file| !file.is_file()) {
        let refusal = Refusal::wrong_usage(format!("there is no scenario `{missing}`"));
        return Err(refusal.into());
    }
    let wanted = Wanted {
        target: simulate.target.as_deref(),
        build: &simulate.build,
    };
    let Some(executable) = build(session, &wanted)? else {
        return Ok(Outcome::Bad);
    };
    let root = session.workspace.root();
    let outcome = play_all(&simulate.scenarios, |scenario| {
        end_of_robot(&executable, &arguments(simulate, scenario)?, root)
    })?;
    Ok(outcome)
}

/// One after the other, as long as it can help to play the next.
fn play_all(
    scenarios: &[Utf8PathBuf],
    mut play: impl FnMut(&Utf8Path) -> Result<Ended, Refusal>,
) -> Result<Outcome, Refusal> {
    let mut outcome = Outcome::Good;
    for scenario in scenarios {
        match play(scenario)? {
            Ended::ByItself(Some(0)) => {}
            // The program gets the same options for each of them.
            Ended::ByItself(Some(2)) => return Ok(Outcome::WrongUsage),
            // Ctrl-C is meant for all of them.
            Ended::ByInterrupt => return Ok(Outcome::Interrupted),
            Ended::ByItself(_) => outcome = Outcome::Bad,
        }
    }
    Ok(outcome)
}

/// The options of the robot's program.
fn arguments(simulate: &Simulate, scenario: &Utf8Path) -> Result<Vec<OsString>, Refusal> {
    let mut arguments = vec!["--scenario".into(), absolute(scenario)?];
    let mut add = |name: &str, value: &str| arguments.extend([name.into(), value.into()]);
    add("--seed", &simulate.seed.to_string());
    add("--repeat", &simulate.repeat.to_string());
    if let Some(threads) = simulate.threads {
        add("--threads", &threads.to_string());
    }
    for assignment in &simulate.set {
        add("--set", assignment);
    }
    if let Some(address) = &simulate.listen {
        add("--listen", address);
    }
    if simulate.format == TextOrJson::Json {
        add("--format", "json");
    }
    if simulate.digests {
        arguments.push("--digests".into());
    }
    if !simulate.options.is_empty() {
        arguments.push("--".into());
        arguments.extend(simulate.options.iter().cloned());
    }
    Ok(arguments)
}

#[cfg(test)]
mod tests {
    use camino::Utf8Path;
    use clap::Parser as _;

    use super::{arguments, play_all};
    use crate::arguments::{Arguments, Command};
    use crate::interrupt::Ended;
    use crate::outcome::Outcome;

    #[test]
    fn wrong_usage_is_told_once_and_a_scenario_that_fails_stops_no_other() {
        for (statuses, expected, played) in [
            ([0, 0], Outcome::Good, 2),
            ([1, 0], Outcome::Bad, 2),
            ([2, 0], Outcome::WrongUsage, 1),
            ([1, 2], Outcome::WrongUsage, 2),
        ] {
            let mut next = statuses.into_iter();
            let outcome = play_all(&["a.toml".into(), "b.toml".into()], |_| {
                Ok(Ended::ByItself(next.next()))
            });
            assert_eq!(outcome, Ok(expected), "{statuses:?}");
            assert_eq!(next.len(), 2 - played, "{statuses:?}");
        }
    }

    #[test]
    fn the_program_plays_the_file_wherever_it_runs() {
        let line = "hulkgen simulate a.toml b.toml --seed 3 --repeat 4 --threads 2 --digests --headless --set c=1 --listen [::1]:5 --format json -- --imperfect 2";
        let parsed = Arguments::try_parse_from(line.split(' ')).expect("it is right usage");
        let Command::Simulate(simulate) = parsed.command else {
            panic!("it is `simulate`")
        };
        assert_eq!(simulate.scenarios, ["a.toml", "b.toml"]);
        let folder = std::env::current_dir().expect("tests run somewhere");
        let words =
            arguments(&simulate, Utf8Path::new("a.toml")).expect("the current folder is known");
        let words: Vec<_> = words.iter().map(|word| word.to_string_lossy()).collect();
        assert_eq!(
            words.join(" "),
            format!(
                "--scenario {} --seed 3 --repeat 4 --threads 2 --set c=1 --listen [::1]:5 --format json --digests -- --imperfect 2",
                folder.join("a.toml").display()
            )
        );
    }
}
