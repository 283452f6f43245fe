//! Rust files that were parsed before: what was not changed is not parsed again.
//!
//! Invariant: spans are places in the source map of `proc_macro2`, which is a thread's. Nothing that was parsed before the
//! map was last cleared is given out.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};

thread_local! {
    /// How often this thread's source map was cleared.
    static CLEARED: Cell<u64> = const { Cell::new(0) };
}

/// A file, with the text that it had.
type File = (Arc<str>, Rc<syn::File>);

/// Files by their path.
#[derive(Clone, Debug, Default)]
pub(super) struct Parsed {
    files: RefCell<BTreeMap<Utf8PathBuf, File>>,
    /// When they were parsed.
    cleared: Cell<u64>,
}

impl Parsed {
    /// Has to be called before files are looked for: forgets what cannot be used any more, and clears the source map where
    /// nothing is left that needs it, so that it does not grow as long as hulkgen runs.
    pub(super) fn begin(&self) {
        let is_current = self.cleared.get() == CLEARED.get();
        if is_current && !self.files.borrow().is_empty() {
            return;
        }
        self.files.take();
        proc_macro2::extra::invalidate_current_thread_spans();
        CLEARED.set(CLEARED.get() + 1);
        self.cleared.set(CLEARED.get());
    }

    /// The file, if it had this text when it was parsed.
    pub(super) fn get(&self, file: &Utf8Path, text: &str) -> Option<Rc<syn::File>> {
        let files = self.files.borrow();
        let (before, syntax) = files.get(file)?;
        let is_current = self.cleared.get() == CLEARED.get();
        (is_current && **before == *text).then(|| syntax.clone())
    }

    pub(super) fn keep(&self, file: &Utf8Path, text: &Arc<str>, syntax: &Rc<syn::File>) {
        let kept = (text.clone(), syntax.clone());
        self.files.borrow_mut().insert(file.to_owned(), kept);
    }
}
