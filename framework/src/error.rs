//! What a node or a hardware interface may return instead of a result, and where it happened.

use std::error::Error as StandardError;
use std::fmt;

use crate::guarded::OnFailure;

/// Why something failed, with the node it happened in.
///
/// Everything that converts into a boxed [`std::error::Error`] converts into it, so that `?` works on any error. One
/// pointer wide, so that `Result<MainOutputs>` costs hardly more than `MainOutputs`.
pub struct Error(Box<Inner>);

/// The framework's result; nodes may use any other whose error converts into [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// The robot is being stopped: a blocking hardware call returns it within 100 ms, and the cycle ends in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stopped;

/// Nothing came that a cycle could be about (time-out, rejected packet): the setup nodes start over, counted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoEvent(pub String);

/// Names the node in an error of `new`, `cycle` or `restore`; costs nothing on success.
pub trait InNode<T> {
    /// The same, with `node` as the place of an error.
    fn in_node(self, node: &'static str) -> Result<T>;
}

struct Inner {
    node: Option<&'static str>,
    cycle: Option<u64>,
    on_failure: Option<OnFailure>,
    source: Box<dyn StandardError + Send + Sync>,
}

struct Context {
    message: String,
    source: Box<dyn StandardError + Send + Sync>,
}

impl Error {
    /// An error that is only a message.
    pub fn new(message: impl Into<String>) -> Self {
        Self::from(message.into())
    }

    /// The same error, with what was being done in front of it; the node stays known.
    #[must_use]
    pub fn context(mut self, message: impl Into<String>) -> Self {
        let message = message.into();
        let source = std::mem::replace(&mut self.0.source, Box::new(Stopped));
        self.0.source = Box::new(Context { message, source });
        self
    }

    /// The node that failed: `sensing::edge_finder`.
    pub fn node(&self) -> Option<&'static str> {
        self.0.node
    }

    /// Number of the cycle in which it failed.
    pub fn cycle(&self) -> Option<u64> {
        self.0.cycle
    }

    /// Whether [`Stopped`] is this error or one of its causes.
    pub fn is_stopped(&self) -> bool {
        self.find::<Stopped>().is_some()
    }

    /// Whether [`NoEvent`] is this error or one of its causes.
    pub fn is_no_event(&self) -> bool {
        self.find::<NoEvent>().is_some()
    }

    /// The first of this error and its causes that has the type `E`.
    pub fn find<E: StandardError + 'static>(&self) -> Option<&E> {
        let mut next: Option<&(dyn StandardError + 'static)> = Some(self.0.source.as_ref());
        while let Some(error) = next {
            if let Some(found) = error.downcast_ref() {
                return Some(found);
            }
            next = error.source();
        }
        None
    }

    /// For results of other error types: the cause without the node's name.
    pub fn into_boxed(self) -> Box<dyn StandardError + Send + Sync> {
        self.0.source
    }

    /// What the manifest says about a failure of the node.
    pub(crate) fn on_failure(&self) -> Option<OnFailure> {
        self.0.on_failure
    }

    /// Names the node, unless an inner one is named already, and what the manifest says about its failure.
    pub(crate) fn of_node(mut self, node: &'static str, on_failure: Option<OnFailure>) -> Self {
        self.0.node.get_or_insert(node);
        self.0.on_failure = on_failure.or(self.0.on_failure);
        self
    }

    /// Numbers the cycle, unless it is numbered already.
    pub(crate) fn in_cycle(mut self, number: u64) -> Self {
        self.0.cycle.get_or_insert(number);
        self
    }
}

impl<E: Into<Box<dyn StandardError + Send + Sync>>> From<E> for Error {
    fn from(source: E) -> Self {
        Self(Box::new(Inner {
            node: None,
            cycle: None,
            on_failure: None,
            source: source.into(),
        }))
    }
}

impl fmt::Display for Error {
    /// The node and the cycle, then the error and its causes, joined by colons.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.0.node, self.0.cycle) {
            (Some(node), Some(cycle)) => write!(formatter, "node `{node}` in cycle {cycle}: ")?,
            (Some(node), None) => write!(formatter, "node `{node}`: ")?,
            (None, Some(cycle)) => write!(formatter, "in cycle {cycle}: ")?,
            (None, None) => {}
        }
        write!(formatter, "{}", self.0.source)?;
        let mut next = self.0.source.source();
        while let Some(error) = next {
            write!(formatter, ": {error}")?;
            next = error.source();
        }
        Ok(())
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{self}")
    }
}

impl<T, E: Into<Error>> InNode<T> for std::result::Result<T, E> {
    #[inline]
    fn in_node(self, node: &'static str) -> Result<T> {
        self.map_err(|error| error.into().of_node(node, None))
    }
}

impl fmt::Display for Stopped {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "the robot is being stopped")
    }
}

impl StandardError for Stopped {}

impl fmt::Display for NoEvent {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "no event: {}", self.0)
    }
}

impl StandardError for NoEvent {}

impl fmt::Display for Context {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.message)
    }
}

impl fmt::Debug for Context {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {:?}", self.message, self.source)
    }
}

impl StandardError for Context {
    fn source(&self) -> Option<&(dyn StandardError + 'static)> {
        Some(self.source.as_ref())
    }
}
