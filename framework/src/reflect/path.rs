//! Paths to parts of values, parsed once and walked often.

use std::fmt;
use std::str::FromStr;

/// One step down: a name or an index.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Segment {
    /// A field, a variant or a key.
    Field(String),
    /// An element, from zero.
    Index(usize),
    /// A field by its place among those of its type, from zero: no text stands for it, only a [`super::ResolvedPath`] has it.
    Position(usize),
}

/// Where a part lies in a value: `balls.0.position.x`. The empty path is the whole value.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Path {
    segments: Vec<Segment>,
}

/// A text that is no [`Path`]: a name between two dots is missing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InvalidPath {
    text: String,
}

impl Segment {
    /// The name, if it is one.
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Field(name) => Some(name),
            Self::Index(_) | Self::Position(_) => None,
        }
    }

    /// The index, if it is one.
    pub fn index(&self) -> Option<usize> {
        match self {
            Self::Field(_) | Self::Position(_) => None,
            Self::Index(index) => Some(*index),
        }
    }

    /// Which of the fields with these names it is.
    pub(crate) fn field(&self, names: &[&str]) -> Option<usize> {
        match self {
            Self::Field(name) => names.iter().position(|candidate| candidate == name),
            Self::Position(position) => Some(*position),
            Self::Index(_) => None,
        }
    }

    /// The whole number that it is the text of, as a key of a map.
    pub(crate) fn number<T: FromStr + TryFrom<usize>>(&self) -> Option<T> {
        match self {
            // What is not negative would be an index.
            Self::Field(name) if name.starts_with('-') && !name.starts_with("-0") => {
                name.parse().ok()
            }
            Self::Field(_) | Self::Position(_) => None,
            Self::Index(index) => T::try_from(*index).ok(),
        }
    }

    /// The position among names, or the index itself: for values whose elements have both.
    pub(crate) fn position(&self, names: &[&str]) -> Option<usize> {
        match self {
            Self::Field(name) => names.iter().position(|candidate| candidate == name),
            Self::Index(index) | Self::Position(index) => Some(*index),
        }
    }
}

impl Path {
    /// The whole value.
    pub const WHOLE: Self = Self {
        segments: Vec::new(),
    };

    /// From the value downwards.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Whether it leads to `other` or to a part of it.
    pub fn starts_with(&self, other: &Self) -> bool {
        self.segments.starts_with(&other.segments)
    }

    /// The path of the first `length` segments.
    pub(crate) fn prefix(&self, length: usize) -> Self {
        self.segments.iter().take(length).cloned().collect()
    }
}

impl FromIterator<Segment> for Path {
    fn from_iter<I: IntoIterator<Item = Segment>>(segments: I) -> Self {
        Self {
            segments: segments.into_iter().collect(),
        }
    }
}

impl FromStr for Path {
    type Err = InvalidPath;

    fn from_str(text: &str) -> Result<Self, InvalidPath> {
        if text.is_empty() {
            return Ok(Self::WHOLE);
        }
        let segments = text.split('.').map(|part| match part {
            "" => Err(InvalidPath { text: text.into() }),
            part => Ok(part.into()),
        });
        segments.collect()
    }
}

impl From<&str> for Segment {
    /// A number as it would be counted is an index, anything else (also `01`) a name.
    fn from(text: &str) -> Self {
        let digits = text.bytes().all(|byte| byte.is_ascii_digit());
        let canonical = digits && (text == "0" || !text.starts_with('0'));
        match text.parse() {
            Ok(index) if canonical => Self::Index(index),
            _ => Self::Field(text.into()),
        }
    }
}

impl fmt::Display for Segment {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Field(name) => formatter.write_str(name),
            Self::Index(index) | Self::Position(index) => write!(formatter, "{index}"),
        }
    }
}

impl fmt::Display for Path {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, segment) in self.segments.iter().enumerate() {
            let separator = if position == 0 { "" } else { "." };
            write!(formatter, "{separator}{segment}")?;
        }
        Ok(())
    }
}

impl fmt::Display for InvalidPath {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            formatter,
            "`{}` is no path: expected names or indices joined by `.`",
            self.text
        )
    }
}

impl std::error::Error for InvalidPath {}
