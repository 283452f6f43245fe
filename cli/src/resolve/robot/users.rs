//! Who uses what is declared in a tree.

use serde::Serialize;

/// Who reads a parameter: a node of a cycler, by path.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Reader {
    pub cycler: usize,
    pub node: String,
}

/// Who writes an additional output.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Writer {
    pub node: String,
}

/// Who uses a cycler state, and how.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct StateUse {
    pub node: String,
    pub shared: bool,
}
