//! The recording of a run.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use super::Target;
use super::options::{Options, Record};
use crate::data::ParameterData;
use crate::error::{Error, Result};
use crate::recorded::{About, Recording, Settings};
use crate::report::tell;
use crate::robot::Robot;

/// What the recording of a run is called in its folder, without `.mcap`.
const NAME: &str = "recording";

/// The variable in which `hulkgen deploy` hands over what it sent: where a robot runs is no checkout.
const REVISION: &str = "HULKGEN_REVISION";

/// Starts it, if one is wanted. Where the disk has no place even for its beginning the robot goes on without one, unless
/// somebody named its file: an earlier half may have filled the disk.
///
/// # Errors
/// If it cannot be started for another reason.
pub(super) fn start<P: ParameterData>(
    target: &Target,
    options: &Options,
    robot: &Robot<P>,
    is_simulated: bool,
    identities: &[(String, String)],
) -> Result<Option<Recording>> {
    let path = match &options.record {
        Record::Off => return Ok(None),
        Record::Simulated if !is_simulated => return Ok(None),
        Record::Simulated | Record::On => free_place(&options.run_folder, NAME),
        Record::Into(path) => {
            return start_into(path, target, options, robot, identities).map(Some);
        }
    };
    match start_into(&path, target, options, robot, identities) {
        Err(error) if has_no_place(&error) => {
            // What it has of a beginning is of use to nobody, nor is a folder with nothing else in it.
            let _ = fs::remove_file(&path);
            let _ = fs::remove_dir(&options.run_folder);
            tell(format_args!(
                "{error}; this run is not recorded: remove folders of earlier runs beside {}, or name another one with --run-folder",
                options.run_folder.display()
            ));
            Ok(None)
        }
        started => started.map(Some),
    }
}

/// Whether no byte can be written where a recording would be.
fn has_no_place(error: &Error) -> bool {
    let kind = error.find::<io::Error>().map(io::Error::kind);
    matches!(
        kind,
        Some(ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::ReadOnlyFilesystem)
    )
}

/// Starts it there.
pub(super) fn start_into<P: ParameterData>(
    path: &Path,
    target: &Target,
    options: &Options,
    robot: &Robot<P>,
    identities: &[(String, String)],
) -> Result<Recording> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(|error| {
            Error::from(error).context(format!("cannot create {}", folder.display()))
        })?;
    }
    let settings = Settings {
        budget: options.recording_budget.unwrap_or(target.recording_budget),
        ..Settings::default()
    };
    let about = about(target, options, robot, identities);
    let recording = Recording::start(path, robot, about, settings)?;
    tell(format_args!("recording into {}", path.display()));
    Ok(recording)
}

/// For a recording of this name in a run folder: after an earlier one there, beside it.
pub(super) fn free_place(folder: &Path, name: &str) -> PathBuf {
    let first = folder.join(format!("{name}.mcap"));
    let again = (2_u32..).map(|number| folder.join(format!("{name}-{number}.mcap")));
    let mut places = std::iter::once(first.clone()).chain(again);
    places.find(|place| !place.exists()).unwrap_or(first)
}

fn about<P: ParameterData>(
    target: &Target,
    options: &Options,
    robot: &Robot<P>,
    identities: &[(String, String)],
) -> About {
    let since_epoch = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap_or_default();
    let run = options.run_folder.file_name().unwrap_or_default();
    let mut entries = vec![
        ("run".to_owned(), run.to_string_lossy().into_owned()),
        ("robot".to_owned(), target.robot.to_owned()),
        ("target".to_owned(), target.name.to_owned()),
        ("started".to_owned(), since_epoch.as_secs().to_string()),
        ("git".to_owned(), git_revision()),
        ("graph".to_owned(), digest_of(target.dataflow)),
    ];
    let identities = identities.iter();
    entries.extend(identities.map(|(name, id)| (format!("identity.{name}"), id.clone())));
    let parameters = robot.parameters.read("");
    let parameters = parameters
        .ok()
        .and_then(|reading| serde_json::to_string_pretty(&reading.value).ok());
    let file = |name: &str, media_type: &str, text: &str| {
        (name.to_owned(), media_type.to_owned(), text.to_owned())
    };
    About {
        outputs: options.record_outputs.clone(),
        run: entries,
        files: vec![
            file("hulk.toml", "application/toml", target.manifest),
            file("DATAFLOW.md", "text/markdown", target.dataflow),
            file(
                "parameters.json",
                "application/json",
                &parameters.unwrap_or_default(),
            ),
        ],
    }
}

/// What was deployed; else of the folder in which the robot was started. Empty where there is none.
fn git_revision() -> String {
    if let Ok(revision) = std::env::var(REVISION) {
        return revision;
    }
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    let Some(revision) = git(&["rev-parse", "HEAD"]) else {
        return String::new();
    };
    match git(&["status", "--porcelain", "--untracked-files=no"]) {
        Some(changes) if !changes.is_empty() => format!("{revision} with changes"),
        _ => revision,
    }
}

/// As the metadata `graph` has it.
pub(super) fn digest_of(text: &str) -> String {
    let mut digest = crate::digest::Digest::new();
    // A text can always be part of a digest.
    let _ = digest.add(text);
    digest.to_string()
}
