//! Whose turn it is: hulkgens that write below one folder go one after the other.

use std::fs::File;

use camino::{Utf8Path, Utf8PathBuf};

use super::{DriftError, disk};

/// The turn of this hulkgen below a folder; all others wait until it is dropped.
///
/// Whoever takes it before it reads writes nothing that was made of what another hulkgen has changed since. It is to be
/// short: nobody is asked and nothing is compiled meanwhile. A process has one at a time, or it would wait for itself.
#[derive(Debug)]
pub struct Turn {
    root: Utf8PathBuf,
    /// `None` where nobody else can be.
    _lock: Option<File>,
}

impl Turn {
    /// Waits until no other hulkgen has its turn.
    pub fn wait_for(root: &Utf8Path) -> Result<Self, DriftError> {
        Ok(Self {
            root: root.to_owned(),
            _lock: disk::lock(root)?,
        })
    }

    pub(super) fn root(&self) -> &Utf8Path {
        &self.root
    }
}
