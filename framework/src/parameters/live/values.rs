//! The values behind a handle that does not know their type.

use serde_json::Value;

use super::refusal::Refusal;
use super::{Parameters, Version};
use crate::buffer::Writer;
use crate::clock::Clock;
use crate::data::ParameterData;
use crate::error::{Error, Result};
use crate::parameters::{Given, exact};
use crate::recorded::Loading;
use crate::reflect::{self, Path, Reflect};

/// All parameters: as they are, as the layers have them, and as they may be next.
pub(super) trait Values: Send {
    fn current(&self) -> &dyn Reflect;

    /// As the layers have them.
    fn stored(&self) -> &dyn Reflect;

    /// As they will be; the current ones where nothing was written since the last [`Values::discard`].
    fn draft(&self) -> &dyn Reflect;

    fn discard(&mut self);

    /// Gives a part of the draft another value.
    fn write(&mut self, path: &str, value: &Given<'_>) -> Result<Path, Refusal>;

    /// The draft becomes what was loaded; the same, for [`Values::set_stored`].
    fn load(&mut self, loaded: &Parameters) -> Result<Box<dyn std::any::Any>>;

    /// The draft becomes what a recording has, and so does what the layers have.
    fn load_recorded(&mut self, recorded: &[u8]) -> Result<()>;

    /// What the layers have, as it was loaded.
    fn set_stored(&mut self, loaded: Box<dyn std::any::Any>);

    /// At these paths the layers have what was loaded; where they had nothing, the nearest part above that they had is adopted.
    fn adopt(&mut self, loaded: &Parameters, paths: &[Path]) -> Result<()>;

    /// The draft becomes current, also for the cyclers.
    fn publish(&mut self, version: Version);
}

pub(super) struct Typed<P> {
    writer: Writer<P>,
    clock: Clock,
    current: P,
    stored: P,
    draft: Option<P>,
}

impl<P: ParameterData> Typed<P> {
    pub(super) fn new(writer: Writer<P>, start: P, clock: Clock) -> Self {
        Self {
            writer,
            clock,
            stored: start.clone(),
            current: start,
            draft: None,
        }
    }
}

impl<P: ParameterData> Values for Typed<P> {
    fn current(&self) -> &dyn Reflect {
        &self.current
    }

    fn stored(&self) -> &dyn Reflect {
        &self.stored
    }

    fn draft(&self) -> &dyn Reflect {
        self.draft.as_ref().unwrap_or(&self.current)
    }

    fn discard(&mut self) {
        self.draft = None;
    }

    fn write(&mut self, path: &str, value: &Given<'_>) -> Result<Path, Refusal> {
        let parsed = Refusal::parse(path)?;
        let draft = self.draft.get_or_insert_with(|| self.current.clone());
        let part = reflect::at_mut(draft, &parsed)
            .map_err(|unknown| Refusal::new(path, unknown.to_string()))?;
        part.deserialize_from(value)
            .map_err(|error| refused(path, &error))?;
        let held = exact::of(part).map_err(|error| Refusal::new(path, error.to_string()))?;
        match exact::too_large(value.tree(), &held) {
            Some((below, number)) => {
                let message = exact::is_too_large(number);
                Err(Refusal::new(&joined(path, &below), message))
            }
            None => Ok(parsed),
        }
    }

    fn load(&mut self, loaded: &Parameters) -> Result<Box<dyn std::any::Any>> {
        let loaded: P = loaded.deserialize()?;
        self.draft = Some(loaded.clone());
        Ok(Box::new(loaded))
    }

    fn load_recorded(&mut self, recorded: &[u8]) -> Result<()> {
        let recorded: P = Loading::new(recorded).take()?;
        self.stored = recorded.clone();
        self.draft = Some(recorded);
        Ok(())
    }

    fn set_stored(&mut self, loaded: Box<dyn std::any::Any>) {
        if let Ok(loaded) = loaded.downcast() {
            self.stored = *loaded;
        }
    }

    fn adopt(&mut self, loaded: &Parameters, paths: &[Path]) -> Result<()> {
        let loaded: P = loaded.deserialize()?;
        let adopted = paths.iter().map(|path| {
            let path = &nearest(&mut self.stored, &loaded, path);
            let value = exact::of(reflect::at(&loaded, path)?)?;
            let part = reflect::at_mut(&mut self.stored, path)?;
            part.deserialize_from(&Given::of(&value))
        });
        // One that fails is no reason against the others.
        adopted.fold(Ok(()), Result::and)
    }

    fn publish(&mut self, version: Version) {
        if let Some(draft) = self.draft.take() {
            self.current = draft;
        }
        let (writing, _) = self.writer.slots();
        writing.clone_from(&self.current);
        self.writer.complete(version.0, self.clock.now());
    }
}

/// Of a part of what stands at this path.
fn refused(path: &str, error: &Error) -> Refusal {
    match error.find::<Refusal>() {
        Some(below) => Refusal::new(&joined(path, &below.path), &below.message),
        None => Refusal::new(path, error.to_string()),
    }
}

fn joined(path: &str, below: &str) -> String {
    let parts = [path, below].into_iter();
    let parts: Vec<_> = parts.filter(|part| !part.is_empty()).collect();
    parts.join(".")
}

/// The longest beginning of a path at which both have something that can be replaced: in the end all.
fn nearest(stored: &mut dyn Reflect, loaded: &dyn Reflect, path: &Path) -> Path {
    let segments = path.segments();
    let lengths = (0..=segments.len()).rev();
    let mut beginnings = lengths.map(|length| segments[..length].iter().cloned().collect());
    let is_in_both =
        |path: &Path| reflect::at(loaded, path).is_ok() && reflect::at_mut(stored, path).is_ok();
    let nearest = beginnings.find(is_in_both);
    nearest.unwrap_or(Path::WHOLE)
}

/// A part as JSON, with as many digits as it was written with; `None` where it is not there.
pub(super) fn plain(value: &dyn Reflect, path: &Path) -> Option<Value> {
    let part = reflect::at(value, path).ok()?;
    // By way of text: `0.1` of 32 bits stays `0.1`.
    let text = serde_json::to_string(part.as_serialize()).ok()?;
    serde_json::from_str(&text).ok()
}
