//! Profiles of cargo, as far as files of the robot say which there are.

use std::collections::BTreeSet;

use camino::{Utf8Path, Utf8PathBuf};

use super::Workspace;

/// Those that cargo has without being told.
const BUILT_IN: [&str; 4] = ["bench", "dev", "release", "test"];
/// Where cargo looks for its configuration, in every folder from that of the robot upwards.
const CONFIGURATIONS: [&str; 2] = [".cargo/config.toml", ".cargo/config"];

impl Workspace {
    /// The profiles that cargo would know; variables and a configuration elsewhere may add to them.
    /// `None`: Cargo.toml cannot be read.
    pub fn profiles(&self) -> Option<BTreeSet<String>> {
        let mut profiles: BTreeSet<String> = BUILT_IN.map(str::to_owned).into();
        profiles.extend(self.profiles_of(&self.below_cargo_root(Utf8Path::new("Cargo.toml")))?);
        let mut way = Utf8PathBuf::new();
        for _ in self.root().ancestors() {
            let files = CONFIGURATIONS.map(|file| way.join(file));
            let files = files.iter().filter(|file| self.is_file(file));
            profiles.extend(files.filter_map(|file| self.profiles_of(file)).flatten());
            way.push("..");
        }
        Some(profiles)
    }

    fn profiles_of(&self, file: &Utf8Path) -> Option<Vec<String>> {
        let table: toml::Table = toml::from_str(&self.read(file).ok()?).ok()?;
        let profiles = table.get("profile").and_then(toml::Value::as_table);
        Some(profiles.map_or_else(Vec::new, |profiles| profiles.keys().cloned().collect()))
    }
}
