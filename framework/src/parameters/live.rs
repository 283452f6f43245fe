//! The parameters of a running robot: read with their provenance, changed, stored, loaded anew.
//!
//! Changes are made in a draft; only a draft in which everything is valid is published, whole, with the next version.
//! Every instance takes the newest version at its `begin`, so no cycle sees half of a change.

mod files;
mod provenance;
mod refusal;
mod store;
mod values;

use std::marker::PhantomData;
use std::ops::Deref;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde::Serialize;
use serde_json::Value;

use super::error::Origin;
use super::exact;
use super::given::Given;
use super::layers::{Layers, Parameters};
use super::tree::{self, Tree};
use crate::buffer::Writer;
use crate::clock::Clock;
use crate::data::ParameterData;
use crate::error::Result;
use crate::logs::tell_warning;
use crate::reflect::{Content, Path, Shape};
use files::Files;
use values::{Typed, Values, plain};

pub use provenance::{Leaf, Provenance, Reading};
pub use refusal::{Refusal, Refusals};
pub use store::Stored;

/// Why nobody changes the parameters of a recording.
const FROZEN: &str = "this is a recording, and its parameters are what they were: `hulkgen replay FILE --set PATH=VALUE` \
                      says what others would change";

/// Which set of parameters: 0 at the start, one more with every change and every reload.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(transparent)]
pub struct Version(pub u64);

/// A change that no file has.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unstored {
    pub path: String,
    pub value: Value,
    /// What the layers say; null where they say nothing.
    pub stored: Value,
    /// The version that brought it.
    pub version: Version,
}

/// The parameters of a running robot, for everybody but its cyclers. A clone is another handle of the same parameters.
#[derive(Clone)]
pub struct Live {
    shape: Arc<Shape>,
    state: Arc<Mutex<State>>,
}

/// As [`Live`], which it derefs to, of a robot whose parameters are of type `P`.
pub struct LiveParameters<P> {
    live: Live,
    of: PhantomData<fn() -> P>,
}

/// What one handle at a time may touch.
struct State {
    values: Box<dyn Values>,
    /// `None`: the values came from elsewhere.
    files: Option<Files>,
    /// Neither is within the other.
    changes: Vec<(Path, Version)>,
    /// Changes for which the files leave no place: an editor may be in the middle of a save.
    homeless: Vec<(String, Tree)>,
    version: Version,
    /// They are those of a recording: they stay what they were.
    is_frozen: bool,
}

impl<P: ParameterData> LiveParameters<P> {
    /// Those that `writer` gives to the cyclers; `start` is what it was created with.
    pub fn new(writer: Writer<P>, start: P, clock: Clock) -> Self {
        let live = Live {
            shape: Arc::new(P::shape()),
            state: Arc::new(Mutex::new(State {
                values: Box::new(Typed::new(writer, start, clock)),
                files: None,
                changes: Vec::new(),
                homeless: Vec::new(),
                version: Version::default(),
                is_frozen: false,
            })),
        };
        Self {
            live,
            of: PhantomData,
        }
    }
}

impl<P> LiveParameters<P> {
    /// A handle without the type.
    pub fn live(&self) -> Live {
        self.live.clone()
    }
}

impl<P> Deref for LiveParameters<P> {
    type Target = Live;

    fn deref(&self) -> &Live {
        &self.live
    }
}

impl Live {
    /// Tells where the values at the start came from: from then on they have a provenance, can be stored and reloaded.
    pub fn came_from(&self, layers: Layers, loaded: Parameters) -> Result<()> {
        self.state().files = Some(Files::new(layers, loaded));
        Ok(())
    }

    /// What all parameters look like: types, documentation, units, ranges.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The newest version.
    pub fn version(&self) -> Version {
        self.state().version
    }

    /// The value at a path, of the newest version, with the provenance of everything in it.
    pub fn read(&self, path: &str) -> Result<Reading, Refusal> {
        self.state().read(path)
    }

    /// Gives all of these paths these values, at once, or none of them.
    ///
    /// Instances see it from their next `begin` on. Paths that lie in each other are written in this order.
    pub fn change<T: AsRef<str>>(&self, changes: &[(T, Value)]) -> Result<Version, Refusals> {
        let changes: Vec<_> = changes
            .iter()
            .map(|(path, value)| (path.as_ref(), Given::from(value)))
            .collect();
        self.state().change(&self.shape, &changes)
    }

    /// As [`Live::change`], with values as `--set` has them.
    pub(crate) fn set(&self, settings: &[(String, String)]) -> Result<Version, Refusals> {
        let values = settings.iter().map(|(path, text)| {
            let value = tree::parse_setting(text, &Origin::Unknown);
            (path.as_str(), value)
        });
        let values: Vec<_> = values.collect();
        let changes = values.iter();
        let changes: Vec<_> = changes
            .map(|(path, value)| (*path, Given::of(value)))
            .collect();
        self.state().change(&self.shape, &changes)
    }

    /// What was changed and would be gone after a restart, by path.
    pub fn changed_not_stored(&self) -> Vec<Unstored> {
        self.state().unstored()
    }

    /// Names of the layers that [`Live::store`] takes, later ones win; without a file as yet, too.
    pub fn layers(&self) -> Vec<String> {
        self.state()
            .files
            .as_ref()
            .map_or_else(Vec::new, Files::names)
    }

    /// Writes the values at these paths (without any: all that were changed and not stored) into the file of a layer, where
    /// comments and everything else stay as they are.
    pub fn store<T: AsRef<str>>(&self, layer: &str, paths: &[T]) -> Result<Stored, Refusals> {
        let paths: Vec<_> = paths.iter().map(AsRef::as_ref).collect();
        self.state().store(&self.shape, layer, &paths)
    }

    /// Takes what the files say now. Changes that were not stored are gone.
    pub fn reload(&self) -> Result<Version> {
        self.state().reload(&self.shape)
    }

    /// As somebody may have edited the files: takes what they say now, and keeps changes that were not stored, which are
    /// the last layer; one for which they leave no place is told, and waits for it. `None` if the files are as they were.
    ///
    /// A mistake in the files is told once; the robot goes on with the values it has.
    pub fn poll(&self) -> Option<Result<Version>> {
        self.state().poll(&self.shape)
    }

    /// Paths of parameters that nodes only read when they are created: a change waits for the next creation.
    pub fn creation_only(&self) -> Vec<String> {
        let mut paths = Vec::new();
        collect_creation_only(&self.shape, "", &mut paths);
        paths
    }

    /// They are those of a recording: from now on nobody changes, stores or reloads them.
    pub(crate) fn freeze(&self) {
        self.state().is_frozen = true;
    }

    /// Everybody sees what a recording has of this version.
    ///
    /// # Errors
    /// If the bytes are no such parameters; then nothing changed.
    pub(crate) fn show(&self, version: Version, recorded: &[u8]) -> Result<()> {
        let mut state = self.state();
        state.values.discard();
        state.values.load_recorded(recorded)?;
        state.version = version;
        state.values.publish(version);
        Ok(())
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // A panic between two operations leaves a draft, which the next one throws away.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn collect_creation_only(shape: &Shape, prefix: &str, paths: &mut Vec<String>) {
    if let Content::Struct(fields) = &shape.content {
        for field in fields {
            let path = format!("{prefix}{}", field.name);
            if field.creation_only {
                paths.push(path);
            } else {
                collect_creation_only(&field.shape, &format!("{path}."), paths);
            }
        }
    }
}

impl State {
    fn change(
        &mut self,
        shape: &Shape,
        changes: &[(&str, Given<'_>)],
    ) -> Result<Version, Refusals> {
        self.check_frozen()?;
        if changes.is_empty() {
            return Ok(self.version);
        }
        let mut refusals = Vec::new();
        let mut paths = Vec::new();
        self.values.discard();
        for (path, value) in changes {
            match self.values.write(path, value) {
                Ok(path) => paths.push(path),
                Err(refusal) => refusals.push(refusal),
            }
        }
        if refusals.is_empty() {
            refusals.extend(refusal::out_of_range(shape, self.values.draft()));
        }
        if !refusals.is_empty() {
            self.values.discard();
            return Err(Refusals(refusals));
        }
        let version = self.publish();
        for path in paths {
            self.note(path, version);
        }
        Ok(version)
    }

    fn check_frozen(&self) -> Result<(), Refusal> {
        match self.is_frozen {
            true => Err(Refusal::new("", FROZEN)),
            false => Ok(()),
        }
    }

    /// The draft becomes what everybody sees.
    fn publish(&mut self) -> Version {
        self.version = Version(self.version.0 + 1);
        self.values.publish(self.version);
        self.version
    }

    /// Remembers that a path was changed, unless it is again as the layers have it.
    fn note(&mut self, path: Path, version: Version) {
        let text = path.to_string();
        self.homeless.retain(|(known, _)| {
            let rest = known.strip_prefix(&text);
            rest.is_none_or(|rest| !rest.is_empty() && !rest.starts_with('.'))
        });
        self.changes.retain(|(known, _)| !known.starts_with(&path));
        let upper = self
            .changes
            .iter_mut()
            .find(|(known, _)| path.starts_with(known));
        match upper {
            Some((_, changed)) => *changed = version,
            None => self.changes.push((path, version)),
        }
        self.forget_what_is_stored();
    }

    fn forget_what_is_stored(&mut self) {
        let values = &self.values;
        self.changes.retain(|(path, _)| {
            let current = exact::part(values.current(), path);
            match (current, exact::part(values.stored(), path)) {
                (Some(current), Some(stored)) => !current.is_same(&stored),
                (current, stored) => current.is_some() || stored.is_some(),
            }
        });
        self.changes.sort_unstable();
    }

    fn unstored(&self) -> Vec<Unstored> {
        let unstored = self.changes.iter().map(|(path, version)| Unstored {
            path: path.to_string(),
            value: plain(self.values.current(), path).unwrap_or_default(),
            stored: plain(self.values.stored(), path).unwrap_or_default(),
            version: *version,
        });
        unstored.collect()
    }

    /// A change, to be made again.
    fn kept(&self, path: &Path) -> (String, Tree) {
        let value = exact::part(self.values.current(), path);
        let value = value.unwrap_or_else(|| tree::Value::Absent.into());
        (path.to_string(), value)
    }

    fn reload(&mut self, shape: &Shape) -> Result<Version> {
        self.check_frozen()?;
        let files = self.files.as_mut().ok_or_else(files::without)?;
        files.look()?;
        self.take_files(shape, false)
    }

    fn poll(&mut self, shape: &Shape) -> Option<Result<Version>> {
        match self.files.as_mut()?.look() {
            Ok(true) => Some(self.take_files(shape, true)),
            Ok(false) => None,
            Err(error) => Some(Err(error)),
        }
    }

    /// Makes what the files say the newest version, with or without the changes that they do not have.
    fn take_files(&mut self, shape: &Shape, with_changes: bool) -> Result<Version> {
        let files = self.files.as_mut().ok_or_else(files::without)?;
        let loaded = files.load()?;
        let kept: Vec<_> = match with_changes {
            true => self
                .changes
                .iter()
                .map(|(path, _)| self.kept(path))
                .collect(),
            false => Vec::new(),
        };
        self.values.discard();
        let stored = self.values.load(&loaded)?;
        loaded.check_ranges(shape, self.values.draft())?;
        let homeless = std::mem::take(&mut self.homeless);
        for (path, value) in kept {
            if let Err(refusal) = self.values.write(&path, &Given::of(&value)) {
                // What it was a part of is gone from the files; that must not hold up what else they say.
                self.changes.retain(|(known, _)| known.to_string() != path);
                self.homeless.push((path, value));
                tell_warning(
                    module_path!(),
                    &format_args!(
                        "a change that was not stored waits until the files leave a place for it again: {refusal}"
                    ),
                );
            }
        }
        let mut returning = Vec::new();
        for (path, value) in homeless.into_iter().filter(|_| with_changes) {
            match self.values.write(&path, &Given::of(&value)) {
                Ok(place) => returning.push(place),
                Err(_) => self.homeless.push((path, value)),
            }
        }
        self.values.set_stored(stored);
        if let Some(files) = &mut self.files {
            files.loaded = loaded;
        }
        let version = self.publish();
        if !with_changes {
            self.changes.clear();
        }
        for path in returning {
            self.note(path, version);
        }
        self.forget_what_is_stored();
        Ok(version)
    }
}
