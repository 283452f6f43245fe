//! Keys as rmw_zenoh makes them of a topic or a service: `DOMAIN/NAME/PACKAGE::msg::dds_::TYPE_/HASH`.

use super::names;

/// A key of that form.
#[derive(Clone, Debug, Eq, PartialEq)]
pub(crate) struct Key {
    /// `ROS_DOMAIN_ID` of those who hear it.
    pub(crate) domain: u32,
    /// Without a `/` in front.
    pub(crate) name: String,
    pub(crate) package: String,
    pub(crate) group: Group,
    /// Of the message or the service.
    pub(crate) type_name: String,
    /// As it stands there, right or wrong.
    pub(crate) hash: String,
}

/// Where in its package a type lies.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(crate) enum Group {
    Message,
    Service,
}

impl Group {
    pub(crate) fn folder(self) -> &'static str {
        match self {
            Self::Message => "msg",
            Self::Service => "srv",
        }
    }
}

impl Key {
    /// `None`: it is a key of another form, or with names that ROS 2 does not have.
    pub(crate) fn read(key: &str) -> Option<Self> {
        let mut chunks: Vec<&str> = key.split('/').collect();
        let (hash, full_type) = (chunks.pop()?, chunks.pop()?);
        let (domain, name) = chunks.split_first()?;
        let is_number = !domain.is_empty() && domain.bytes().all(|byte| byte.is_ascii_digit());
        if !is_number || name.is_empty() || !name.iter().all(|chunk| names::is_of_topic(chunk)) {
            return None;
        }
        let (package, rest) = full_type.split_once("::")?;
        let (folder, type_name) = rest.split_once("::dds_::")?;
        let type_name = type_name.strip_suffix('_')?;
        let group = match folder {
            "msg" => Group::Message,
            "srv" => Group::Service,
            _ => return None,
        };
        if !names::is_package(package) || !names::is_message(type_name) {
            return None;
        }
        Some(Self {
            domain: domain.parse().ok()?,
            name: name.join("/"),
            package: package.to_owned(),
            group,
            type_name: type_name.to_owned(),
            hash: hash.to_owned(),
        })
    }

    /// `zoo_interfaces/msg/Pose`.
    pub(crate) fn full_name(&self) -> String {
        let folder = self.group.folder();
        format!("{}/{folder}/{}", self.package, self.type_name)
    }

    /// `zoo_interfaces::msg::dds_::Pose_`.
    pub(crate) fn full_type(&self) -> String {
        let folder = self.group.folder();
        format!("{}::{folder}::dds_::{}_", self.package, self.type_name)
    }

    /// The key with this hash.
    pub(crate) fn with_hash(&self, hash: &str) -> String {
        format!("{}/{}/{}/{hash}", self.domain, self.name, self.full_type())
    }
}
