//! A parameter file of a robot, for tests that take what the robot takes.

use serde::de::DeserializeOwned;

use crate::parameters;

/// A whole parameter file, read once.
#[derive(Clone, Debug)]
pub struct ParameterFile {
    values: toml::Value,
}

impl ParameterFile {
    /// The file with this text.
    ///
    /// # Panics
    /// If the text is no TOML, with the place.
    pub fn new(text: &str) -> Self {
        let table = parameters::from_text("file", text).unwrap_or_else(|error| panic!("{error}"));
        Self {
            values: toml::Value::Table(table),
        }
    }

    /// The value at a path, as a node's `Parameter` names it: `filter.gate`.
    ///
    /// # Panics
    /// If the file has no such value, or one of another type.
    pub fn get<T: DeserializeOwned>(&self, path: &str) -> T {
        let value = path
            .split('.')
            .try_fold(&self.values, |table, key| table.get(key));
        let value = value.unwrap_or_else(|| panic!("there is no `{path}`"));
        let value: Result<T, _> = value.clone().try_into();
        value.unwrap_or_else(|error| panic!("`{path}`: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_found_by_their_paths() {
        let file = ParameterFile::new("[filter.top]\nsteps = [1, 2]\n[filter.bottom]\ngate = 0.5");
        assert_eq!(file.get::<[u32; 2]>("filter.top.steps"), [1, 2]);
        assert_eq!(file.get::<f32>("filter.bottom.gate"), 0.5);
    }
}
