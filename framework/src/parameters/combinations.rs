//! Every robot that the files know, by its identities.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::Layers;

impl Layers {
    /// These layers for every combination of identities that files of the directory or of the location name, at most one
    /// of each name; the first is a robot that no file names.
    ///
    /// The names are those of the manifest, in its order.
    pub fn combinations(&self, names: &[&str]) -> Vec<Self> {
        let at_location = self.location().ok().flatten();
        let mut folders = vec![self.directory.clone()];
        folders.extend(at_location.map(|location| self.directory.join(location)));
        let mut combinations = vec![Vec::new()];
        for name in names {
            let ids: BTreeSet<String> = folders.iter().flat_map(|it| ids(it, name)).collect();
            let with = |one: &Vec<(String, String)>| {
                let named = ids.iter().map(|id| {
                    let mut one = one.clone();
                    one.push(((*name).to_owned(), id.clone()));
                    one
                });
                std::iter::once(one.clone())
                    .chain(named)
                    .collect::<Vec<_>>()
            };
            combinations = combinations.iter().flat_map(with).collect();
        }
        let layers = combinations.into_iter().map(|identities| Self {
            identities,
            ..self.clone()
        });
        layers.collect()
    }
}

/// `P1` of `head.P1.toml`; nothing if the folder cannot be read: then its layers cannot either, which is told.
fn ids(folder: &Path, name: &str) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let ids = entries.filter_map(|entry| {
        let file = entry.file_name();
        let rest = file.to_str()?.strip_prefix(name)?.strip_prefix('.')?;
        let id = rest.strip_suffix(".toml")?;
        (!id.is_empty()).then(|| id.to_owned())
    });
    ids.collect()
}
