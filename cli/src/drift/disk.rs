//! Reading the generated folder, and writing in a way that never leaves half a file.

use std::fs;
use std::io::{self, Write as _};

use camino::{Utf8Path, Utf8PathBuf};

use super::DriftError;
use crate::interrupt;

/// What cargo puts into the folder of a package.
const CARGOS_OWN: [&str; 2] = ["target", "Cargo.lock"];

/// The content of a file, if there is one.
pub(super) fn read(path: &Utf8Path) -> Result<Option<Vec<u8>>, DriftError> {
    match fs::read(path) {
        Ok(content) => Ok(Some(content)),
        // The second: a file stands where a folder above it would have to.
        Err(error)
            if matches!(
                error.kind(),
                io::ErrorKind::NotFound | io::ErrorKind::NotADirectory
            ) =>
        {
            Ok(None)
        }
        Err(source) => Err(failed("read", path, source)),
    }
}

/// Every file in a folder and below, relative to the root, sorted; links count as files.
pub(super) fn files(root: &Utf8Path, folder: &Utf8Path) -> Result<Vec<Utf8PathBuf>, DriftError> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(current) = folders.pop() {
        let entries = match root.join(&current).read_dir_utf8() {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
            Err(source) => return Err(failed("list", &current, source)),
        };
        for entry in entries {
            let entry = entry.map_err(|source| failed("list", &current, source))?;
            let kind = entry
                .file_type()
                .map_err(|source| failed("list", &current, source))?;
            if current == folder && CARGOS_OWN.contains(&entry.file_name()) {
                continue;
            }
            let path = current.join(entry.file_name());
            if kind.is_dir() {
                folders.push(path);
            } else {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

/// Replaces a file whole or not at all, and creates the folders it needs.
pub fn write_file(path: &Utf8Path, text: &str) -> Result<(), DriftError> {
    interrupt::postpone(|| write_bytes(path, text.as_bytes()))
}

/// As [`write_file`], also for what is no text; a signal does not wait for it.
pub(super) fn write_bytes(path: &Utf8Path, content: &[u8]) -> Result<(), DriftError> {
    // A link stays one: what it leads to is replaced.
    let place = path.canonicalize_utf8().unwrap_or_else(|_| path.to_owned());
    let folder = place.parent().unwrap_or(Utf8Path::new("."));
    fs::create_dir_all(folder).map_err(|source| failed("create", folder, source))?;
    let write = || -> io::Result<()> {
        let known = fs::metadata(&place).map(|known| known.permissions());
        // Beside the file, so that it can be moved there in one step.
        let mut file = tempfile::Builder::new()
            .permissions(permissions())
            .tempfile_in(folder)?;
        file.write_all(content)?;
        if let Ok(known) = known {
            file.as_file().set_permissions(known)?;
        }
        file.persist(&place).map_err(|error| error.error)?;
        Ok(())
    };
    write().map_err(|source| failed("write", path, source))
}

/// Waits until nobody else writes below this folder; free again when the answer is dropped.
pub(super) fn lock(root: &Utf8Path) -> Result<Option<fs::File>, DriftError> {
    // The folder itself, so that no file is left behind; a root that does not exist yet has nobody else.
    let folder = match fs::File::open(root) {
        Ok(folder) => folder,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(source) => return Err(failed("open", root, source)),
    };
    match folder.lock() {
        Ok(()) => Ok(Some(folder)),
        // Some network disks have no locks; every single file is still replaced whole.
        Err(error) if error.kind() == io::ErrorKind::Unsupported => Ok(None),
        Err(source) => Err(failed("lock", root, source)),
    }
}

/// Those of an ordinary file; a temporary file would be its owner's alone.
fn permissions() -> fs::Permissions {
    use std::os::unix::fs::PermissionsExt as _;
    fs::Permissions::from_mode(0o666)
}

/// Removes a file, and the folders above it that are empty then.
pub(super) fn remove(root: &Utf8Path, path: &Utf8Path) -> Result<(), DriftError> {
    fs::remove_file(root.join(path)).map_err(|source| failed("remove", path, source))?;
    for folder in path
        .ancestors()
        .skip(1)
        .take_while(|folder| !folder.as_str().is_empty())
    {
        if fs::remove_dir(root.join(folder)).is_err() {
            break;
        }
    }
    Ok(())
}

pub(super) fn failed(deed: &'static str, path: &Utf8Path, source: io::Error) -> DriftError {
    DriftError::Io {
        deed,
        path: path.to_owned(),
        source,
    }
}
