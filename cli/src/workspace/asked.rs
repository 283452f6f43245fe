//! What the disk was asked and what it answered, so that it can be asked again.
//!
//! Invariant: every question of a workspace to the disk is here. What was made of the answers is made of the same answers
//! again, so whoever knows them all need not make it twice.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use camino::{Utf8Path, Utf8PathBuf};
use serde::{Deserialize, Serialize};

use crate::digest::Digest;

/// What can be asked about a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) enum Question {
    /// What it is called when every link is followed.
    Canonical,
    IsFile,
    IsLink,
    /// What is in the folder.
    List,
    /// What the file says.
    Read,
}

/// Every question to the disk, with the digest of its answer. Paths are relative to the workspace root.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Answers(pub(super) Vec<(Question, Utf8PathBuf, Digest)>);

/// Questions as they are asked.
#[derive(Clone, Debug, Default)]
pub(super) struct Asked {
    answers: RefCell<BTreeMap<(Question, Utf8PathBuf), Answer>>,
}

#[derive(Clone, Copy, Debug)]
enum Answer {
    Is(Digest),
    /// Somebody changed it between two questions.
    Changed,
}

impl Asked {
    pub(super) fn note(&self, question: Question, path: &Utf8Path, answer: Digest) {
        match self.answers.borrow_mut().entry((question, path.to_owned())) {
            Entry::Vacant(entry) => drop(entry.insert(Answer::Is(answer))),
            Entry::Occupied(mut entry) => {
                if !matches!(entry.get(), Answer::Is(before) if *before == answer) {
                    entry.insert(Answer::Changed);
                }
            }
        }
    }

    /// Every path that was asked for so far, with what was asked.
    pub(super) fn paths(&self) -> Vec<(Question, Utf8PathBuf)> {
        self.answers.borrow().keys().cloned().collect()
    }

    /// All answers so far; `None` if one question had two.
    pub(super) fn answers(&self) -> Option<Answers> {
        let asked = self.answers.borrow();
        let answers = asked.iter().map(|((question, path), answer)| match answer {
            Answer::Is(digest) => Some((*question, path.clone(), *digest)),
            Answer::Changed => None,
        });
        answers.collect::<Option<_>>().map(Answers)
    }
}
