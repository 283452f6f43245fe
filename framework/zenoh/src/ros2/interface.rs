//! What carries the values of an edge to ROS 2.

use super::hash::hash;
use super::key::{Group, Key};
use super::messages::Definition;
use super::service::Service;
use crate::Result;
use crate::edges::{Edge, Encoding, Kind};
use crate::forms::Form;

/// A message or a service.
pub(crate) enum Interface {
    Message(Definition),
    Service(Service),
}

impl Interface {
    /// # Errors
    /// If ROS 2 has none of that kind for it.
    pub(crate) fn new(key: &Key, form: &Form) -> Result<Self> {
        let name = key.full_name();
        Ok(match form {
            Form::Value(layout) => Self::Message(Definition::new(layout, &name, &key.type_name)?),
            Form::Call { request, response } => {
                Self::Service(Service::new(request, response, &name)?)
            }
        })
    }

    pub(crate) fn hash(&self) -> String {
        match self {
            Self::Message(Definition { root, nested }) => hash(root, nested),
            Self::Service(service) => service.hash(),
        }
    }
}

/// What ROS 2 has for the values of an edge.
pub(crate) fn group(edge: &Edge) -> Group {
    match edge.kind {
        Kind::Procedure => Group::Service,
        _ => Group::Message,
    }
}

/// The key of an edge that ROS 2 can know: CDR under a key of its form, a message of a value or a service of a procedure.
pub(crate) fn key(edge: &Edge) -> Option<Key> {
    let key = Key::read(&edge.key).filter(|key| key.group == group(edge));
    key.filter(|_| edge.encoding == Encoding::Cdr)
}

/// What is to be said of a key before anybody wonders why nobody hears it.
pub(crate) fn objection(edge: &Edge, form: &Form) -> Option<String> {
    let wrong_group = Key::read(&edge.key).map(|key| key.group);
    let Some(key) = key(edge) else {
        return wrong_group.map(|group| match group {
            Group::Message => {
                "the key is that of a topic: behind the package of a service stands `::srv::`"
                    .to_owned()
            }
            Group::Service => {
                "the key is that of a service: behind the package of a message stands `::msg::`"
                    .to_owned()
            }
        });
    };
    let hash = match Interface::new(&key, form) {
        Ok(interface) => interface.hash(),
        Err(message) => return Some(message),
    };
    (hash != key.hash).then(|| {
        format!(
            "the hash in the key is not that of these fields, so ROS 2 hears nothing unless `{}` is somebody else's and has the same bytes under other names; with `--messages` goes the key `{}`",
            key.full_name(),
            key.with_hash(&hash)
        )
    })
}
