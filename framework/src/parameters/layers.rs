//! Which files are layers, and what they are merged to.

use std::ffi::OsString;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::error::{Fault, Origin, ParameterError};
use super::nearest::nearest;
use super::tree::{self, Removed, Tree, UNSET, Value};
use super::{deserialize, exact, from_text};
use crate::error::{Error, Result};
use crate::reflect::{Reflect, Shape};

/// What environment variables that set parameters start with.
const ENVIRONMENT_PREFIX: &str = "HULK_PARAMETERS__";
/// `HULK_PARAMETERS__a__b` is `a.b`.
const ENVIRONMENT_SEPARATOR: &str = "__";

/// Everything that decides which value wins.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layers {
    /// Holds the files.
    pub directory: PathBuf,
    /// As on the command line or of the target, where an empty one is none; else what the directory's `parameters.toml` says.
    pub location: Option<String>,
    /// (name, id) in the order of the layers; none are known before the hardware is.
    pub identities: Vec<(String, String)>,
    /// Environment variables; those with another prefix do not matter.
    pub environment: Vec<(String, String)>,
    /// What stands above all these, in order.
    pub above: Vec<Above>,
    /// (path, value) of every `--set`.
    pub settings: Vec<(String, String)>,
}

/// One layer more, above the files and the environment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Above {
    /// (path, value), each as of a `--set`.
    Settings(Vec<(String, String)>),
    /// What a text of TOML, that of a file, has at this path; nothing where it has none.
    Part {
        file: String,
        text: Arc<str>,
        path: String,
    },
}

/// Every file that could be a layer, and the one that chooses the location, with its text if it is there.
pub(super) type Texts = Vec<(PathBuf, Option<Vec<u8>>)>;

/// The merged values of one robot.
#[derive(Clone, Debug)]
pub struct Parameters {
    pub(super) tree: Tree,
    /// The files that were read, in order.
    files: Vec<PathBuf>,
    /// As they were when they were read.
    texts: Texts,
    /// What a layer says `unset` of.
    removed: Removed,
}

/// `parameters.toml` beside the layers.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Choice {
    location: Option<String>,
}

impl Layers {
    /// Reads and merges all layers that are there.
    pub fn load(&self) -> Result<Parameters> {
        self.load_with(None)
    }

    /// As [`Layers::load`], with another text in place of that of one file.
    pub(super) fn load_with(&self, replaced: Option<(&Path, &str)>) -> Result<Parameters> {
        let mut parameters = self.load_files(replaced, None)?;
        let mut variables: Vec<_> = self.environment.iter().collect();
        // The system has them in any order.
        variables.sort_unstable();
        parameters.overlay_one_by_one(variables.into_iter().filter_map(|(variable, value)| {
            let path = variable.strip_prefix(ENVIRONMENT_PREFIX)?;
            let origin = Origin::Environment(variable.as_str().into());
            let setting = tree::parse_setting(value, &origin);
            Some(setting.below(path, ENVIRONMENT_SEPARATOR))
        }));
        for above in &self.above {
            match above {
                Above::Settings(settings) => parameters.set(settings),
                Above::Part { file, text, path } => {
                    if let Some(part) = tree::parse(file, text)?.get(path) {
                        parameters.overlay(part.clone());
                    }
                }
            }
        }
        parameters.set(&self.settings);
        Ok(parameters)
    }

    /// Those of a process's environment variables that are a layer.
    ///
    /// # Errors
    /// If one is not UTF-8: it would be no parameter, and nobody would be told.
    pub(crate) fn environment_of(
        variables: impl IntoIterator<Item = (OsString, OsString)>,
    ) -> Result<Vec<(String, String)>> {
        let variables = variables.into_iter();
        let ours = variables.filter(|(variable, _)| {
            let name = variable.as_encoded_bytes();
            name.starts_with(ENVIRONMENT_PREFIX.as_bytes())
        });
        let read = ours.map(|(variable, value)| {
            let origin = Origin::Environment(variable.to_string_lossy().into());
            let wrong = |what| ParameterError::new(origin.clone(), "", what);
            let variable = variable.into_string();
            let variable = variable.map_err(|_| wrong("the name of the variable is not UTF-8"))?;
            let value = value.into_string();
            let value = value.map_err(|_| wrong("the value of the variable is not UTF-8"))?;
            Ok((variable, value))
        });
        read.collect()
    }

    /// The layers that are files, all of them or up to one: what nobody adds at the start.
    pub(super) fn load_files(
        &self,
        replaced: Option<(&Path, &str)>,
        last: Option<&Path>,
    ) -> Result<Parameters> {
        let choice = self.choice_file();
        let chosen = fs::read(&choice).ok();
        let location = self.location()?;
        if let Some(location) = &location {
            self.check_location(location)?;
        }
        let mut parameters = Parameters {
            tree: Tree::empty(Origin::File {
                path: display(&self.directory).into(),
                line: 1,
            }),
            files: Vec::new(),
            texts: vec![(choice, chosen)],
            removed: Vec::new(),
        };
        for (file, required) in self.files(location.as_deref()) {
            let text = match replaced {
                Some((path, text)) if path == file => Some(text.to_owned()),
                _ => read(&file)?,
            };
            let is_last = last == Some(&file);
            let read = text.clone().map(String::into_bytes);
            parameters.texts.push((file.clone(), read));
            parameters.add(file, text, required)?;
            if is_last {
                break;
            }
        }
        Ok(parameters)
    }

    /// Every file that is a layer of this robot, later ones win, whether it is there or not.
    pub(super) fn candidates(&self) -> Result<Vec<PathBuf>> {
        let location = self.location()?;
        let files = self.files(location.as_deref()).into_iter();
        Ok(files.map(|(file, _)| file).collect())
    }

    /// Chooses the location where nobody else does.
    pub(super) fn choice_file(&self) -> PathBuf {
        self.directory.join("parameters.toml")
    }

    /// In the order of merging; only the first has to be there.
    fn files(&self, location: Option<&str>) -> Vec<(PathBuf, bool)> {
        let at_location = location.map(|location| self.directory.join(location));
        let identified = |folder: &Path| -> Vec<(PathBuf, bool)> {
            let names = self
                .identities
                .iter()
                .map(|(name, id)| format!("{name}.{id}.toml"));
            names.map(|name| (folder.join(name), false)).collect()
        };
        let mut files = vec![(self.directory.join("default.toml"), true)];
        files.extend(
            at_location
                .iter()
                .map(|folder| (folder.join("default.toml"), false)),
        );
        files.extend(identified(&self.directory));
        files.extend(at_location.iter().flat_map(|folder| identified(folder)));
        files
    }

    /// As it is given, or else as the directory says; an empty one is none.
    pub(super) fn location(&self) -> Result<Option<String>> {
        let is_named = |location: &String| !location.is_empty();
        if let Some(location) = &self.location {
            return Ok(Some(location.clone()).filter(is_named));
        }
        let path = self.choice_file();
        let text = read(&path)?;
        let choice: Option<Choice> = text
            .map(|text| from_text(&display(&path), &text))
            .transpose()?;
        Ok(choice.and_then(|choice| choice.location).filter(is_named))
    }

    /// A location is a folder beside the layers; a misspelt one would change nothing and tell nobody.
    fn check_location(&self, location: &str) -> Result<()> {
        // Without the directory the first layer is missing, which says more.
        if self.directory.join(location).is_dir() || !self.directory.is_dir() {
            return Ok(());
        }
        let directory = display(&self.directory);
        let known = self.known_locations();
        let there_are = match known.as_slice() {
            [] => "it has none".to_owned(),
            _ => format!("there are {}", known.join(", ")),
        };
        let near = nearest(location, known.iter().map(String::as_str));
        let hint = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        Err(Error::new(format!(
            "{directory} has no location `{location}`: {there_are}{hint}"
        )))
    }

    /// Sorted; nothing if the directory cannot be read.
    fn known_locations(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.directory).into_iter().flatten();
        let folders = entries.flatten().filter(|entry| entry.path().is_dir());
        let mut known: Vec<_> = folders
            .map(|entry| entry.file_name().display().to_string())
            .collect();
        known.sort_unstable();
        known
    }
}

impl Parameters {
    /// As the robot's type, with every number in the range of its field. `hardware` does not belong to it.
    pub fn deserialize<P: DeserializeOwned + Reflect>(&self) -> Result<P> {
        let mut tree = self.tree.clone();
        if let Value::Table(entries) = &mut tree.value {
            entries.remove("hardware");
        }
        let values: P = deserialize::deserialize(&tree).map_err(|error| self.with_layers(error))?;
        if let Some((path, number)) = exact::too_large(&tree, &exact::of(&values)?) {
            let message = exact::is_too_large(number);
            return Err(ParameterError::new(self.nearest_origin(&path), path, message).into());
        }
        self.check_ranges(&P::shape(), &values)?;
        Ok(values)
    }

    /// The first number that is not in the range of its field is an error, with its place.
    pub(super) fn check_ranges(&self, shape: &Shape, values: &dyn Reflect) -> Result<()> {
        let json = exact::of(values)?.to_json();
        let Some(outside) = shape.out_of_range(&json, None).into_iter().next() else {
            return Ok(());
        };
        let origin = self.nearest_origin(&outside.path);
        Err(ParameterError::new(origin, outside.path.clone(), outside.to_string()).into())
    }

    /// Where the value at this path was written, or what it lies in: a part of an array may have no place of its own.
    fn nearest_origin(&self, mut path: &str) -> Origin {
        loop {
            match (self.origin(path), path.rfind('.')) {
                (Some(origin), _) => return origin.clone(),
                (None, Some(end)) => path = &path[..end],
                (None, None) => return Origin::Unknown,
            }
        }
    }

    /// `[hardware.<target>]`, empty if no layer has it.
    pub fn hardware(&self, target: &str) -> Result<toml::Table> {
        let key = format!("hardware.{target}");
        match self.tree.get(&key).map(|tree| (tree, tree.to_value())) {
            None => Ok(toml::Table::new()),
            Some((_, toml::Value::Table(table))) => Ok(table),
            Some((tree, _)) => {
                let message = format!("expected a table, found {}", tree.kind());
                Err(ParameterError::new(tree.origin.clone(), key, message).into())
            }
        }
    }

    /// A table of a target that is none would change nothing and tell nobody.
    ///
    /// # Errors
    /// If there is one.
    pub(crate) fn check_targets(&self, targets: &[&str]) -> Result<()> {
        let tables = self.tree.get("hardware").map(|tree| &tree.value);
        let Some(Value::Table(tables)) = tables else {
            return Ok(());
        };
        let mut names = tables.keys().map(|name| &**name);
        let Some(name) = names.find(|name| !targets.contains(name)) else {
            return Ok(());
        };
        let near = nearest(name, targets.iter().copied());
        let hint = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        let key = format!("hardware.{name}");
        Err(Error::from(ParameterError {
            fault: Fault::Unknown,
            origin: self.nearest_origin(&key),
            message: format!("the robot has no target `{name}`{hint}"),
            key,
        }))
    }

    /// Where the value at this path was written last.
    pub fn origin(&self, path: &str) -> Option<&Origin> {
        self.tree.get(path).map(|tree| &tree.origin)
    }

    /// The files that were read, later ones win.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// What was read, also where nothing is there.
    pub(super) fn texts(&self) -> &Texts {
        &self.texts
    }

    /// Gives an error of `[hardware.<target>]` the place that the hardware could not know.
    pub(crate) fn locate(&self, target: &str, error: Error) -> Error {
        let Some(found) = error.find::<ParameterError>() else {
            return error;
        };
        if found.origin != Origin::Unknown {
            return error;
        }
        let mut located = found.clone();
        located.key = format!("hardware.{target}.{}", found.key);
        // A missing key has no place of its own, its table has.
        let mut path = located.key.as_str();
        loop {
            if let Some(origin) = self.origin(path) {
                located.origin = origin.clone();
                return located.into();
            }
            match path.rfind('.') {
                Some(end) => path = &path[..end],
                None => return located.into(),
            }
        }
    }

    fn set(&mut self, settings: &[(String, String)]) {
        self.overlay_one_by_one(settings.iter().map(|(path, value)| {
            let origin = Origin::Setting(format!("{path}={value}").into());
            tree::parse_setting(value, &origin).below(path, ".")
        }));
    }

    /// They are one layer: of one variant of an enum, each may have a part.
    fn overlay_one_by_one(&mut self, mut later: impl Iterator<Item = Tree>) {
        if let Some(first) = later.next() {
            self.overlay(first);
        }
        for tree in later {
            self.tree.overlay_more(tree, &mut self.removed);
        }
    }

    fn overlay(&mut self, later: Tree) {
        self.tree.overlay(later, &mut self.removed);
    }

    fn add(&mut self, file: PathBuf, text: Option<String>, required: bool) -> Result<()> {
        match text {
            Some(text) => {
                self.overlay(tree::parse(&display(&file), &text)?);
                self.files.push(file);
                Ok(())
            }
            None if required => Err(Error::new(format!(
                "{} is missing: it holds the default of every parameter",
                file.display()
            ))),
            None => Ok(()),
        }
    }

    /// Where a value is missing, the layers that could have it help more than the line of the table.
    fn with_layers(&self, mut error: ParameterError) -> Error {
        let mut removed = self.removed.iter().rev();
        if error.fault == Fault::Missing
            && let Some((path, origin)) = removed.find(|(path, _)| is_within(&error.key, path))
        {
            error.origin = origin.clone();
            error.message = match *path == error.key {
                true => format!("is missing: `{UNSET} = true` takes it away here"),
                false => format!("is missing: `{UNSET} = true` takes `{path}` away here"),
            };
            return error.into();
        }
        let is_missing = self.tree.get(&error.key).is_none();
        let error = Error::from(error);
        if !is_missing || self.files.is_empty() {
            return error;
        }
        let files: Vec<_> = self.files.iter().map(|file| display(file)).collect();
        error.context(format!("parameters of {}", files.join(", ")))
    }
}

/// `None` if there is no such file.
fn read(path: &Path) -> Result<Option<String>> {
    match fs::read_to_string(path) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Error::from(error).context(format!("cannot read {}", path.display()))),
    }
}

/// Whether a path is `upper` or below it.
fn is_within(path: &str, upper: &str) -> bool {
    let rest = path.strip_prefix(upper);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

fn display(path: &Path) -> String {
    path.display().to_string()
}

#[cfg(all(test, unix))]
mod tests {
    use std::ffi::OsString;
    use std::os::unix::ffi::OsStringExt;

    use super::Layers;

    fn read(name: &[u8], value: &[u8]) -> Result<Vec<(String, String)>, String> {
        let variable = (
            OsString::from_vec(name.to_vec()),
            OsString::from_vec(value.to_vec()),
        );
        Layers::environment_of([variable]).map_err(|error| error.to_string())
    }

    #[test]
    fn a_variable_that_is_not_utf_8_is_an_error_where_it_is_a_layer() {
        let one = vec![("HULK_PARAMETERS__a__b".to_owned(), "1".to_owned())];
        assert_eq!(read(b"HULK_PARAMETERS__a__b", b"1"), Ok(one));
        let error = "environment HULK_PARAMETERS__a__b: the value of the variable is not UTF-8";
        assert_eq!(
            read(b"HULK_PARAMETERS__a__b", b"\xff"),
            Err(error.to_owned())
        );
        let error = "environment HULK_PARAMETERS__a\u{fffd}: the name of the variable is not UTF-8";
        assert_eq!(read(b"HULK_PARAMETERS__a\xff", b"1"), Err(error.to_owned()));
        for (name, value) in [(b"OTHER", b"\xff"), (b"OTH\xff ", b"1")] {
            assert_eq!(read(name, value), Ok(Vec::new()));
        }
    }
}
