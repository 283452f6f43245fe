//! What a client is told whose path leads nowhere.

use std::cmp::Reverse;
use std::fmt;

use super::{Children, Path, Segment};
use crate::parameters::nearest;

/// Of more names than these the nearest are told alone.
const TOLD: usize = 8;

/// A path that leads to nothing in a value, or to nothing that may be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownPath {
    /// The whole path.
    pub path: Path,
    /// Which of its segments is the first that leads nowhere.
    pub position: usize,
    pub reason: Reason,
    /// What could have stood there.
    pub valid: Children,
}

/// Why a path leads nowhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// There is no such name or index.
    Unknown,
    /// An `Option` on the way has no content now; the path may be right.
    Absent,
    /// It is part of what is only written as a whole.
    OnlyWhole,
}

impl UnknownPath {
    pub(super) fn new(path: &Path, position: usize, valid: Children) -> Self {
        let reason = if valid.absent {
            Reason::Absent
        } else {
            Reason::Unknown
        };
        Self {
            path: path.clone(),
            position,
            reason,
            valid,
        }
    }

    pub(super) fn only_whole(path: &Path, position: usize) -> Self {
        Self {
            reason: Reason::OnlyWhole,
            ..Self::new(path, position, Children::default())
        }
    }

    /// The first segment that leads nowhere.
    pub fn segment(&self) -> Option<&Segment> {
        self.path.segments().get(self.position)
    }

    /// Whether the path only meets an `Option` that has no content now.
    pub fn is_absent(&self) -> bool {
        self.reason == Reason::Absent
    }
}

impl fmt::Display for UnknownPath {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let upper = match self.position {
            0 => "the value".to_owned(),
            position => format!("`{}`", self.path.prefix(position)),
        };
        let segment = self.segment().map(Segment::to_string).unwrap_or_default();
        match self.reason {
            Reason::Absent => write!(formatter, "no `{segment}` now: {upper} is absent"),
            Reason::OnlyWhole => {
                write!(
                    formatter,
                    "`{segment}` cannot be written alone: write {upper} as a whole"
                )
            }
            Reason::Unknown if self.valid.names.len() > TOLD => {
                let more = self.valid.names.len() - TOLD;
                let told = Children::named(self.valid.nearest(&segment));
                write!(
                    formatter,
                    "no `{segment}`: {upper} has {told} and {more} more"
                )
            }
            Reason::Unknown => write!(formatter, "no `{segment}`: {upper} has {}", self.valid),
        }
    }
}

impl std::error::Error for UnknownPath {}

impl Children {
    /// The names that are most likely meant: a slip away, or with the same beginning.
    fn nearest(&self, wanted: &str) -> Vec<String> {
        let mut names: Vec<&str> = self.names.iter().map(AsRef::as_ref).collect();
        let slip = nearest(wanted, names.iter().copied());
        let shared = |name: &str| {
            let pairs = name.chars().zip(wanted.chars());
            pairs.take_while(|(one, other)| one == other).count()
        };
        names.sort_by_key(|name| (slip != Some(*name), Reverse(shared(name))));
        names.truncate(TOLD);
        names.into_iter().map(str::to_owned).collect()
    }
}

impl fmt::Display for Children {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts: Vec<_> = self.names.iter().map(|name| format!("`{name}`")).collect();
        match self.indices {
            0 => {}
            1 => parts.push("`0`".into()),
            indices => parts.push(format!("`0` to `{}`", indices - 1)),
        }
        if parts.is_empty() {
            return formatter.write_str("nothing below it");
        }
        formatter.write_str(&parts.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::{Children, Reason, UnknownPath};

    #[test]
    fn of_many_names_the_nearest_are_told() {
        let mut names: Vec<String> = (0..50).map(|number| format!("other_{number:02}")).collect();
        names.extend(["walking_engine", "walking_feet", "gate"].map(str::to_owned));
        let told = |wanted: &str| {
            let unknown = UnknownPath {
                path: wanted.parse().unwrap(),
                position: 0,
                reason: Reason::Unknown,
                valid: Children::named(names.clone()),
            };
            unknown.to_string()
        };
        let walk = told("walk");
        assert!(
            walk.contains("`walking_engine`, `walking_feet` and 45 more"),
            "{walk}"
        );
        assert!(told("gaet").contains("`gate`"), "{}", told("gaet"));
    }
}
