//! `vision`: generate, build, and let the tool `vision` of the robot's hardware look at images.

use std::ffi::OsString;

use super::Failure;
use super::run::{Wanted, absolute, build, end_of_robot};
use super::session::Session;
use crate::arguments::{TextOrJson, Vision};
use crate::interrupt::Ended;
use crate::outcome::{Outcome, Refusal};

pub(super) fn run(session: &mut Session<'_>, vision: &Vision) -> Result<Outcome, Failure> {
    // Before anything is built.
    if let Some(missing) = vision.images.iter().find(|file| !file.is_file()) {
        let refusal = Refusal::wrong_usage(format!("there is no image `{missing}`"));
        return Err(refusal.into());
    }
    let wanted = Wanted {
        target: vision.target.as_deref(),
        build: &vision.build,
    };
    let Some(executable) = build(session, &wanted)? else {
        return Ok(Outcome::Bad);
    };
    let arguments = arguments(vision)?;
    let ended = end_of_robot(&executable, &arguments, session.workspace.root())?;
    Ok(match ended {
        Ended::ByItself(Some(0)) => Outcome::Good,
        Ended::ByItself(Some(2)) => Outcome::WrongUsage,
        Ended::ByItself(_) => Outcome::Bad,
        Ended::ByInterrupt => Outcome::Interrupted,
    })
}

/// The options of the robot's program, and behind `--` those of the tool.
fn arguments(vision: &Vision) -> Result<Vec<OsString>, Refusal> {
    let mut arguments: Vec<OsString> = vec!["--tool".into(), "vision".into()];
    for assignment in &vision.set {
        arguments.extend(["--set".into(), assignment.into()]);
    }
    arguments.push("--".into());
    let options = [
        ("--camera-pose", &vision.camera_pose),
        ("--instance", &vision.instance),
    ];
    for (name, value) in options {
        arguments.extend([name.into(), value.into()]);
    }
    if vision.ycbcr {
        arguments.push("--ycbcr".into());
    }
    if vision.format == TextOrJson::Json {
        arguments.push("--json".into());
    }
    if let Some(folder) = &vision.overlay {
        arguments.extend(["--overlay".into(), absolute(folder)?]);
    }
    for image in &vision.images {
        arguments.push(absolute(image)?);
    }
    Ok(arguments)
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::arguments;
    use crate::arguments::{Arguments, Command};

    #[test]
    fn the_tool_gets_what_is_its_own_and_finds_the_files() {
        let line = "hulkgen vision a.png b.png --camera-pose 0.5,-0.3 --ycbcr --overlay o --set c=1 --format json";
        let parsed = Arguments::try_parse_from(line.split(' ')).expect("it is right usage");
        let Command::Vision(vision) = parsed.command else {
            panic!("it is `vision`")
        };
        let folder = std::env::current_dir().expect("tests run somewhere");
        let folder = folder.display();
        let words = arguments(&vision).expect("the current folder is known");
        let words: Vec<_> = words.iter().map(|word| word.to_string_lossy()).collect();
        assert_eq!(
            words.join(" "),
            format!(
                "--tool vision --set c=1 -- --camera-pose 0.5,-0.3 --instance VisionTop --ycbcr --json \
                 --overlay {folder}/o {folder}/a.png {folder}/b.png"
            )
        );
    }

    #[test]
    fn a_pose_that_is_none_is_wrong_usage() {
        for pose in ["0.5", "0.5,up", "1,2,3,4", "nan,0", ""] {
            let line = ["hulkgen", "vision", "a.png", "--camera-pose", pose];
            let error = Arguments::try_parse_from(line).expect_err("it is no pose");
            assert!(
                error.to_string().contains("2, 3 or 6 numbers") || pose.is_empty(),
                "{error}"
            );
        }
    }
}
