//! Images that a running robot sends, as files of a folder.

use std::fs::{self, File};
use std::io::Write as _;

use camino::{Utf8Path, Utf8PathBuf};

use crate::outcome::Refusal;

/// A folder that images of one output are kept in.
pub struct Images<'a> {
    folder: &'a Utf8Path,
}

impl<'a> Images<'a> {
    /// Into this folder, which is made where it is missing.
    pub fn into(folder: &'a Utf8Path) -> Result<Self, Refusal> {
        fs::create_dir_all(folder).map_err(|error| failed(folder, &error))?;
        Ok(Self { folder })
    }

    /// Keeps the JPEG file of this cycle; where it lies. A file that is there already stays as it is.
    pub fn keep(&self, cycle: u64, bytes: &[u8]) -> Result<Utf8PathBuf, Refusal> {
        // As `recording export` names them.
        let path = self.folder.join(format!("{cycle:08}.jpg"));
        let mut file = File::create_new(&path).map_err(|error| failed(&path, &error))?;
        let written = file.write_all(bytes);
        written.map_err(|error| failed(&path, &error))?;
        Ok(path)
    }
}

fn failed(path: &Utf8Path, error: &std::io::Error) -> Refusal {
    Refusal::bad(format!("cannot write `{path}`: {error}")).help("name another folder")
}

#[cfg(test)]
mod tests {
    use camino::Utf8Path;

    use super::Images;

    #[test]
    fn images_lie_in_order_and_none_takes_the_place_of_another() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let folder = Utf8Path::from_path(folder.path()).expect("it is text");
        let images = folder.join("new/images");
        let images = Images::into(&images).expect("it can be made");
        let path = images.keep(812, b"first").expect("there is room");
        assert_eq!(path, folder.join("new/images/00000812.jpg"));
        let refusal = images.keep(812, b"second").expect_err("it is there");
        assert!(refusal.message.contains("00000812.jpg"), "{refusal:?}");
        assert_eq!(std::fs::read(path).expect("it is there"), b"first");
    }
}
