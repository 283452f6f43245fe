//! What stands where in a recorded value, enough to read it without its type.
//!
//! Recorded values are [postcard](https://postcard.jamesmunns.com/wire-format), which tells nothing of itself. A layout names
//! what a type's own `Deserialize` asks for, in its order; it stands in the recording as JSON.

mod difference;
mod read;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::file::Attachment;
use crate::fnv::fnv;

pub use difference::first_difference;
pub use read::{Unreadable, Values};

/// What a value consists of.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Layout {
    /// It could not be found out: nothing from here on can be read.
    #[default]
    Unknown,
    Unit,
    Bool,
    /// Of so many bits; more than 8 are a zigzag varint.
    Signed(u8),
    /// Of so many bits; more than 8 are a varint.
    Unsigned(u8),
    /// Of 32 or 64 bits, little-endian.
    Float(u8),
    /// A text of one character.
    Character,
    /// Behind its length.
    Text,
    /// Behind their number.
    Bytes,
    /// Behind a byte that tells whether it is there.
    Option(Box<Layout>),
    /// Behind their number.
    List(Box<Layout>),
    /// Keys and values, behind the number of both.
    Map(Box<(Layout, Layout)>),
    Tuple(Vec<Layout>),
    Struct(Struct),
    /// Behind the number of its variant.
    Enum(Enum),
    /// As what it stands in: 1 is the innermost struct or enum around it.
    Again(usize),
}

/// Fields in the order of the bytes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Struct {
    /// The type's own name.
    pub name: String,
    pub fields: Vec<(String, Layout)>,
}

/// Variants by number.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Enum {
    /// The type's own name.
    pub name: String,
    /// What follows the number of each; a struct without a name has its fields.
    pub variants: Vec<(String, Layout)>,
}

/// A named part of a frame, or a value.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Part {
    /// As nodes and manifest name it.
    pub name: String,
    pub kind: PartKind,
    pub layout: Layout,
}

/// What a part is to its cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PartKind {
    /// The state of a node, and what its failures left behind.
    Node,
    /// What nodes of a cycler share.
    State,
    /// An output of this cycle, as setup nodes wrote it.
    Output,
    /// An output of the cycle before.
    Previous,
    /// Values of an output by time.
    History,
    /// Which cycles of another instance were seen.
    Input,
    /// Anything else: version of parameters, injections, calls, who listens.
    Other,
}

/// The attachment that holds [`Layouts`].
pub const ATTACHMENT: &str = "types.json";

/// Everything that a recording tells of its types.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Layouts {
    /// Parts of frames, by the metadata `types` of their channel.
    pub frames: BTreeMap<String, Vec<Part>>,
    /// What others read of an instance, and the parameters, by name.
    pub values: BTreeMap<String, Layout>,
    /// What the ends of an instance's frames have digests of: node and output, in their order. Recordings of earlier builds have
    /// none.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub digests: BTreeMap<String, Vec<(String, String)>>,
    /// Outputs whose values are images, as clients name them, and of which pixels: `gray`, `rgb` or `yuyv`, rows from the top
    /// without gaps, in the fields `width`, `height` and `data`. Recordings of earlier builds have none.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub images: BTreeMap<String, String>,
}

impl Layouts {
    /// Those of a recording; none where it has none.
    pub fn of(attachments: &[Attachment]) -> Self {
        let mut attachments = attachments.iter();
        let found = attachments.find(|attachment| attachment.name == ATTACHMENT);
        found
            .and_then(|found| serde_json::from_slice(&found.data).ok())
            .unwrap_or_default()
    }
}

impl Layout {
    /// Whether all of it is known.
    pub fn is_known(&self) -> bool {
        match self {
            Self::Unknown => false,
            Self::Option(inner) | Self::List(inner) => inner.is_known(),
            Self::Map(both) => both.0.is_known() && both.1.is_known(),
            Self::Tuple(items) => items.iter().all(Self::is_known),
            Self::Struct(Struct { fields: parts, .. })
            | Self::Enum(Enum {
                variants: parts, ..
            }) => parts.iter().all(|(_, layout)| layout.is_known()),
            _ => true,
        }
    }

    /// Whether a part of it is as something around it that is not part of it.
    pub fn is_recursive(&self) -> bool {
        self.reaches(0)
    }

    fn reaches(&self, around: usize) -> bool {
        match self {
            Self::Again(up) => *up > around,
            Self::Option(inner) | Self::List(inner) => inner.reaches(around),
            Self::Map(both) => both.0.reaches(around) || both.1.reaches(around),
            Self::Tuple(items) => items.iter().any(|item| item.reaches(around)),
            Self::Struct(Struct { fields: parts, .. })
            | Self::Enum(Enum {
                variants: parts, ..
            }) => parts.iter().any(|(_, layout)| layout.reaches(around + 1)),
            _ => false,
        }
    }

    /// FNV-1a (64 bit) of all that it says, so that two of them can be compared by a number.
    pub fn digest(parts: &[Part]) -> u64 {
        let text = serde_json::to_string(parts).unwrap_or_default();
        fnv(text.as_bytes())
    }
}
