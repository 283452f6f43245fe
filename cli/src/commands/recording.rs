//! `recording`: what recordings say, without a robot and its types.
//!
//! Invariant: these commands read no manifest; `pull`, which does, is that of `deploy`.

#[cfg(test)]
mod tests;

use camino::{Utf8Path, Utf8PathBuf};
use serde_json::{Value, json};

use super::plural;
use super::session::Session;
use super::terminal::Terminal;
use crate::arguments::{ExportKind, Global, Recording, RecordingCommand, Selection, TextOrJson};
use crate::outcome::{Outcome, Refusal};
use crate::recording::{self, Export, Info, Run, Span};
use crate::workspace::RUNS;

/// Parts of the frames of an instance that a text names; JSON has all.
const PARTS: usize = 8;

pub(super) fn run(
    global: &Global,
    terminal: &Terminal,
    recording: &Recording,
) -> Result<Outcome, Refusal> {
    match &recording.command {
        RecordingCommand::Info { file, format } => {
            let info = recording::info(file)?;
            terminal.data(&match format {
                TextOrJson::Text => info_text(&info),
                TextOrJson::Json => line(&with_version(json!(info))),
            })?;
        }
        RecordingCommand::List { folder, format } => {
            let folder = folder.clone().map_or_else(|| runs(global, terminal), Ok)?;
            terminal.data(&list(&folder, *format)?)?;
        }
        RecordingCommand::Cat {
            file,
            selection,
            format,
        } => {
            let file = recording::open(file)?;
            let shown = recording::cat(&file, &wanted(selection), &mut |found| {
                terminal.more_data(&match format {
                    TextOrJson::Json => line(&found.to_json()),
                    TextOrJson::Text => {
                        format!("{} {} {}\n", found.path, found.cycle, found.value)
                    }
                })
            })?;
            note_silent(terminal, &shown.complete(None)?);
        }
        RecordingCommand::Recover { file, into, format } => {
            let recovered = recording::recover(file, into.as_deref())?;
            let (into, chunks, lost) = (recovered.into, recovered.chunks, recovered.lost);
            let (damaged, unreadable) = (recovered.damaged, recovered.unreadable);
            terminal.data(&match format {
                TextOrJson::Text => format!(
                    "{into}: {}, {} behind them lost\n{}",
                    plural(chunks as usize, "chunk"),
                    plural(lost as usize, "byte"),
                    damaged_lines(&damaged, &unreadable)
                ),
                TextOrJson::Json => line(&json!({
                    "version": 1, "file": into, "chunks": chunks, "lost_bytes": lost, "damaged": damaged,
                    "unreadable": unreadable,
                })),
            })?;
        }
        RecordingCommand::Pull(_) => unreachable!("needs a session"),
        RecordingCommand::Export {
            file,
            selection,
            kind,
            into,
            format,
        } => {
            let kind = match kind {
                ExportKind::Csv => Export::Csv,
                ExportKind::Json => Export::Json,
                ExportKind::Png => Export::Png,
            };
            let exported = recording::export(file, &wanted(selection), kind, into)?;
            note_silent(terminal, &exported.silent);
            let (files, values) = (exported.files, exported.values);
            terminal.data(&match format {
                TextOrJson::Text => format!(
                    "{into}: {} in {}\n",
                    plural(values as usize, "value"),
                    plural(files as usize, "file")
                ),
                TextOrJson::Json => line(&json!({
                    "version": 1, "into": into, "files": files, "values": values,
                })),
            })?;
        }
    }
    Ok(Outcome::Good)
}

/// Those of the robot around; where there is none, of the current folder.
fn runs(global: &Global, terminal: &Terminal) -> Result<Utf8PathBuf, Refusal> {
    match Session::open(global, terminal) {
        Ok(session) => Ok(session.runs()),
        Err(refusal) if global.manifest.is_some() => Err(refusal),
        Err(_) => Ok(RUNS.into()),
    }
}

fn list(folder: &Utf8Path, format: TextOrJson) -> Result<String, Refusal> {
    let runs = recording::list(folder)?;
    Ok(match format {
        TextOrJson::Text => list_text(&runs),
        TextOrJson::Json => line(&json!({ "version": 1, "recordings": runs })),
    })
}

/// One for each chunk that is lost.
fn damaged_lines(chunks: &[u64], others: &[u64]) -> String {
    let chunks = chunks.iter().map(|offset| {
        format!(
            "the chunk at byte {offset} is damaged (its check sum is wrong): what it had is lost\n"
        )
    });
    let others = others.iter().map(|offset| {
        format!(
            "the record at byte {offset} (metadata, or an attachment) is damaged: what it had is lost\n"
        )
    });
    chunks.chain(others).collect()
}

fn note_silent(terminal: &Terminal, silent: &[String]) {
    for path in silent {
        terminal.note(&format!(
            "`{path}` has no value in the cycles that were asked for\n"
        ));
    }
}

fn wanted(selection: &Selection) -> recording::Selection {
    let nanoseconds = |duration: &schema::Duration| {
        let whole = std::time::Duration::from(*duration).as_nanos();
        u64::try_from(whole).unwrap_or(u64::MAX)
    };
    let from = selection.from.as_ref().map(nanoseconds);
    let to = selection.to.as_ref().map(nanoseconds);
    recording::Selection {
        paths: selection.paths.clone(),
        span: Span {
            cycles: selection.cycles.map(|(from, to)| from..to),
            times: (from.is_some() || to.is_some())
                .then(|| from.unwrap_or_default()..to.unwrap_or(u64::MAX)),
        },
    }
}

fn line(answer: &Value) -> String {
    format!("{answer}\n")
}

fn with_version(answer: Value) -> Value {
    let mut versioned = json!({ "version": 1 });
    if let (Some(versioned), Value::Object(answer)) = (versioned.as_object_mut(), answer) {
        versioned.extend(answer);
    }
    versioned
}

fn list_text(runs: &[Run]) -> String {
    let width = runs.iter().map(|run| run.file.as_str().len()).max();
    let width = width.unwrap_or_default();
    let lines = runs.iter().map(|run| {
        format!(
            "{:width$}  {:10}  {:>8.1} s  {:>9}\n",
            run.file.as_str(),
            run.state,
            run.duration_s,
            size(run.bytes)
        )
    });
    lines.collect()
}

fn info_text(info: &Info) -> String {
    let run = |key: &str| info.run.get(key).map_or("", String::as_str);
    let mut text = format!(
        "run        {} of {} on {}\n",
        run("run"),
        run("robot"),
        run("target")
    );
    for (key, value) in &info.run {
        if !["run", "robot", "target"].contains(&&**key) && !value.is_empty() {
            text += &format!("{key:<10} {value}\n");
        }
    }
    text += &format!("state      {}", info.state);
    if let Some(behind) = info.cut_behind {
        text += &format!(": it breaks off behind byte {behind} (`hulkgen recording recover`)");
    }
    for line in damaged_lines(&info.damaged, &info.unreadable).lines() {
        text += &format!("\n           {line}");
    }
    text += &format!(
        "\nduration   {:.3} s\nsize       {} ({} before compression), {}",
        info.duration_s,
        size(info.bytes),
        size(info.uncompressed),
        plural(info.chunks as usize, "chunk")
    );
    if info.gone > 0 {
        text += &format!(", {} older ones gone", info.gone);
    }
    text +=
        "\n\ninstance              frames  dropped  bytes per cycle  types             record\n";
    for one in &info.instances {
        text += &format!(
            "{:<20} {:>7} {:>8} {:>16.1}  {:<16}  {}\n",
            one.instance, one.frames, one.dropped, one.bytes_per_cycle, one.types, one.record
        );
    }
    text += &parts_text(info);
    text += "\nchannel                            messages       size  encoding\n";
    for one in info.channels.iter().filter(|one| one.messages > 0) {
        text += &format!(
            "{:<34} {:>8}  {:>9}  {}\n",
            one.topic,
            one.messages,
            size(one.bytes),
            one.encoding
        );
    }
    if !info.largest_states.is_empty() {
        text += "\nlargest states\n";
    }
    for one in &info.largest_states {
        let what = format!("{} {}", one.instance, one.node);
        text += &format!("{what:<44} {:>9}\n", size(one.bytes));
    }
    text
}

/// What frames consist of, node by node.
fn parts_text(info: &Info) -> String {
    let mut text =
        "\npart of frames                                  bytes per cycle      most\n".to_owned();
    for one in &info.instances {
        let (shown, rest) = one.parts.split_at(one.parts.len().min(PARTS));
        for part in shown.iter().filter(|part| part.most_bytes > 0) {
            let what = format!("{} {}", one.instance, part.name);
            text += &format!(
                "{what:<46} {:>16.1} {:>9}\n",
                part.bytes_per_cycle,
                size(part.most_bytes)
            );
        }
        if !rest.is_empty() {
            let bytes: f64 = rest.iter().map(|part| part.bytes_per_cycle).sum();
            let what = format!("{} {} others", one.instance, rest.len());
            text += &format!("{what:<46} {bytes:>16.1}\n");
        }
    }
    text
}

/// Three digits or four, in powers of 1024.
fn size(bytes: u64) -> String {
    let mut number = bytes as f64;
    for unit in ["B", "KiB", "MiB"] {
        if number < 1000.0 {
            return match unit {
                "B" => format!("{bytes} B"),
                unit => format!("{number:.1} {unit}"),
            };
        }
        number /= 1024.0;
    }
    format!("{number:.1} GiB")
}
