//! `simulate`: generate, build, and let the robot's program play scenarios, one after the other.

use std::ffi::OsString;

use camino::Utf8Path;

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
    let mut outcome = Outcome::Good;
    for scenario in &simulate.scenarios {
        let arguments = arguments(simulate, scenario)?;
        match end_of_robot(&executable, &arguments, session.workspace.root())? {
            Ended::ByItself(Some(0)) => {}
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

    use super::arguments;
    use crate::arguments::{Arguments, Command};

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
