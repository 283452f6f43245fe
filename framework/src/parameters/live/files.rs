//! The files of the layers, and whether somebody has edited them.

use std::fs;
use std::path::{Path, PathBuf};

use super::{Layers, Parameters};
use crate::error::{Error, Result};
use crate::parameters::layers::Texts;

/// What was read, and from where.
pub(super) struct Files {
    pub(super) layers: Layers,
    pub(super) loaded: Parameters,
    /// Every file that could be a layer, with its text at the last look.
    seen: Texts,
    /// Why the layers could not be named at the last look.
    mistake: Option<String>,
}

impl Files {
    /// What was edited since the layers were loaded is still to be found.
    pub(super) fn new(layers: Layers, loaded: Parameters) -> Self {
        Self {
            layers,
            seen: loaded.texts().clone(),
            loaded,
            mistake: None,
        }
    }

    /// Whether a file has another text than at the last look.
    ///
    /// # Errors
    /// If the layers cannot be named; once for all looks that find the same.
    pub(super) fn look(&mut self) -> Result<bool> {
        let (paths, error) = match self.layers.candidates() {
            Ok(candidates) => {
                let choice = [self.layers.choice_file()].into_iter();
                (choice.chain(candidates).collect(), None)
            }
            // Those that are known by now.
            Err(error) => {
                let known = self.seen.iter().map(|(path, _)| path.clone());
                (known.collect::<Vec<_>>(), Some(error))
            }
        };
        let read = paths.into_iter().map(|path| {
            let text = fs::read(&path).ok();
            (path, text)
        });
        let seen: Texts = read.collect();
        let mistake = error.as_ref().map(Error::to_string);
        let is_new = seen != self.seen || mistake != self.mistake;
        self.seen = seen;
        self.mistake = mistake;
        match error {
            Some(error) if is_new => Err(error),
            Some(_) => Ok(false),
            None => Ok(is_new),
        }
    }

    /// The robot has written this text itself, in place of `before`; what others wrote since the last look is still to be
    /// found.
    pub(super) fn wrote(&mut self, path: &Path, before: &str, text: &str) {
        let known = self.seen.iter_mut().find(|(file, _)| file == path);
        if let Some((_, seen)) = known
            && seen.as_deref().unwrap_or_default() == before.as_bytes()
        {
            *seen = Some(text.into());
        }
    }

    /// As they are now.
    pub(super) fn load(&self) -> Result<Parameters> {
        self.layers.load()
    }

    /// Names of the layers, later ones win: paths from the directory without `.toml`.
    pub(super) fn names(&self) -> Vec<String> {
        let candidates = self.layers.candidates().unwrap_or_default();
        candidates.iter().map(|file| self.name(file)).collect()
    }

    /// The file of a layer.
    pub(super) fn file(&self, layer: &str) -> Result<PathBuf, String> {
        let candidates = self
            .layers
            .candidates()
            .map_err(|error| error.to_string())?;
        let name = layer.strip_suffix(".toml").unwrap_or(layer);
        let found = candidates.into_iter().find(|file| self.name(file) == name);
        found.ok_or_else(|| {
            let names = self.names().join("`, `");
            format!("no layer `{layer}`: this robot has `{names}`")
        })
    }

    fn name(&self, file: &Path) -> String {
        let below = file.strip_prefix(&self.layers.directory).unwrap_or(file);
        below.with_extension("").display().to_string()
    }
}

pub(super) fn without() -> Error {
    Error::new("the parameters of this robot come from no files")
}
