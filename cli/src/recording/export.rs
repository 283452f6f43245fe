//! Values of a recording as files of other kinds.

mod png;
mod table;

use std::fs;
use std::io::{BufWriter, Write};

use camino::Utf8Path;
use hulkgen_mcap::RecordingFile;
use hulkgen_mcap::layout::Layouts;
use serde_json::{Value, json};

use super::values::{Found, Selection, Shown, cat};
use crate::outcome::Refusal;
use table::Columns;

/// What is made of the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Export {
    /// A table of one output: a row for each cycle.
    Csv,
    /// An object a line.
    Json,
    /// A file for each image of one output.
    Png,
}

/// What was written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Exported {
    pub files: u64,
    pub values: u64,
    /// Paths that had no value.
    pub silent: Vec<String>,
}

/// Writes values of a recording into a file, or into a folder of images; neither may exist. All that can be read of it or nothing.
///
/// # Errors
/// If nothing could be written; or if chunks of the recording are damaged: then all others are written.
pub fn export(
    path: &Utf8Path,
    selection: &Selection,
    kind: Export,
    into: &Utf8Path,
) -> Result<Exported, Refusal> {
    if kind != Export::Json && selection.paths.len() != 1 {
        return Err(Refusal::wrong_usage("name one output, or a part of one"));
    }
    let file = super::open(path)?;
    let failed = |error: std::io::Error| Refusal::bad(format!("cannot write `{into}`: {error}"));
    if into.exists() {
        return Err(Refusal::wrong_usage(format!("`{into}` exists")).help("name another place"));
    }
    // Whoever looks for it meanwhile finds nothing rather than a part.
    let name = into.file_name().unwrap_or("export");
    let half = into.with_file_name(format!("{name}.{}.half", std::process::id()));
    let written = write(&file, selection, kind, &half)
        .and_then(|written| fs::rename(&half, into).map(|()| written).map_err(failed));
    if written.is_err() {
        let _ = match kind {
            Export::Png => fs::remove_dir_all(&half),
            Export::Csv | Export::Json => fs::remove_file(&half),
        };
    }
    let (mut exported, shown) = written?;
    exported.silent = shown.complete(Some(into))?;
    Ok(exported)
}

fn write(
    file: &RecordingFile,
    selection: &Selection,
    kind: Export,
    into: &Utf8Path,
) -> Result<(Exported, Shown), Refusal> {
    let failed = |error: std::io::Error| Refusal::bad(format!("cannot write `{into}`: {error}"));
    let mut exported = Exported::default();
    if kind == Export::Png {
        let mut count = 0;
        fs::create_dir_all(into).map_err(failed)?;
        let images = Layouts::of(&file.contents().attachments).images;
        let shown = cat(file, selection, &mut |found| {
            if found.value.is_null() {
                // None in this cycle.
                return Ok(true);
            }
            let pixels = images.get(&found.path);
            let image = png::image(&found.value)
                .or_else(|| png::typed(&found.value, pixels?))
                .ok_or_else(|| no_image(&found))?;
            let name = format!("{:08}.{}", found.cycle, image.extension);
            fs::write(into.join(name), image.bytes).map_err(failed)?;
            count += 1;
            Ok(true)
        })?;
        (exported.files, exported.values) = (count, count);
        return Ok((exported, shown));
    }
    let columns = match kind {
        Export::Csv => Some(columns(file, selection)?),
        Export::Json | Export::Png => None,
    };
    let out = fs::File::create_new(into).map_err(failed)?;
    let mut out = BufWriter::new(out);
    exported.files = 1;
    let head = columns.as_ref().map(Columns::head).unwrap_or_default();
    out.write_all(head.as_bytes()).map_err(failed)?;
    let mut values = 0;
    let shown = cat(file, selection, &mut |found| {
        let text = match &columns {
            Some(columns) => columns.row(&found),
            None => format!("{}\n", found.to_json()),
        };
        out.write_all(text.as_bytes()).map_err(failed)?;
        values += 1;
        Ok(true)
    })?;
    exported.values = values;
    out.flush().map_err(failed)?;
    Ok((exported, shown))
}

/// What a table of these values needs: the first of two passes over the file, which holds no values.
fn columns(file: &RecordingFile, selection: &Selection) -> Result<Columns, Refusal> {
    let mut columns = Columns::default();
    let mut output = None;
    // The second pass tells what is damaged or silent.
    let _ = cat(file, selection, &mut |found| {
        columns.observe(&found.value);
        let first = output.get_or_insert_with(|| found.path.clone());
        match *first == found.path {
            true => Ok(true),
            false => Err(several(first, &found.path)),
        }
    })?;
    Ok(columns)
}

fn several(one: &str, other: &str) -> Refusal {
    Refusal::wrong_usage("a table has the values of one output")
        .help(format!("name one: there are `{one}` and `{other}`"))
}

fn no_image(found: &Found) -> Refusal {
    Refusal::wrong_usage(format!("`{}` is no image", found.path)).help(
        "name an output whose type says that it is an image, the whole of it; of recordings of earlier builds `hulkgen run --record-output PATH` is needed",
    )
}

impl Found {
    /// As `cat` and `export` write it.
    pub fn to_json(&self) -> Value {
        json!({
            "path": self.path,
            "cycle": self.cycle,
            "time": self.time as f64 / 1e9,
            "value": self.value,
        })
    }
}
