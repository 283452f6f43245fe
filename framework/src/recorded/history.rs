//! Own outputs by time: the whole window where nothing stands before the frame, else what came since the last one.

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Loading, Saving};
use crate::error::Result;
use crate::history::{History, Past};
use crate::reflect::Reflect;
use crate::time::Timestamp;

impl<T: Clone + Reflect + Serialize> History<T> {
    /// Saves the values from `since` on, `None` for all of them.
    pub fn save(&self, since: Option<Timestamp>, out: &mut Saving<'_, '_>) {
        let all = self.project(|value| value);
        let is_newer = |index: &usize| since.is_none_or(|since| all.value(*index).0 >= since);
        let newer = (0..all.len()).rev().take_while(is_newer).count();
        let first = all.len() - newer;
        out.put(&since.is_none());
        out.put(&(newer as u32));
        for index in first..all.len() {
            let (timestamp, value) = all.value(index);
            out.put(&timestamp);
            out.output(value);
        }
    }
}

impl<T: Clone + DeserializeOwned> History<T> {
    /// Makes it what was saved; what was saved since some time is added to what is there.
    ///
    /// # Errors
    /// If the bytes are none of a history of this type.
    pub fn load(&mut self, from: &mut Loading<'_>) -> Result<()> {
        // What the cycle before left here in its replay is not what it left when it was recorded.
        self.begin_load();
        if from.take()? {
            self.clear();
        }
        for _ in 0..from.take::<u32>()? {
            let (timestamp, value) = from.take::<(Timestamp, T)>()?;
            self.push(timestamp, &value);
        }
        self.end_load();
        Ok(())
    }
}
