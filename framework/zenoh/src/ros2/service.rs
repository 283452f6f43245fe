//! Services: what is asked, what is answered, and the message about both that ROS 2 has for whoever listens in.

use super::hash::hash;
use super::messages::{Definition, Field, Kind, Many, Message};
use crate::Result;
use crate::layout::Layout;

/// A service with the messages that it is made of.
pub(crate) struct Service {
    /// `zoo_interfaces/srv/Walk`.
    pub(crate) name: String,
    pub(crate) request: Definition,
    pub(crate) response: Definition,
}

impl Service {
    /// # Errors
    /// If request or response contain their own type.
    pub(crate) fn new(request: &Layout, response: &Layout, name: &str) -> Result<Self> {
        let stem = name.rsplit('/').next().unwrap_or_default();
        let definition = |layout, part: &str| {
            Definition::new(layout, &format!("{name}_{part}"), &format!("{stem}{part}"))
        };
        Ok(Self {
            name: name.to_owned(),
            request: definition(request, "Request")?,
            response: definition(response, "Response")?,
        })
    }

    pub(crate) fn hash(&self) -> String {
        let of_service = |part: &str| Kind::Message(format!("{}_{part}", self.name));
        let field = |name: &str, kind, many| Field {
            name: name.to_owned(),
            kind,
            many,
        };
        let message = |name: &str, fields: Vec<Field>| Message {
            name: name.to_owned(),
            constants: Vec::new(),
            fields,
        };
        let service = message(
            &self.name,
            vec![
                field("request_message", of_service("Request"), Many::One),
                field("response_message", of_service("Response"), Many::One),
                field("event_message", of_service("Event"), Many::One),
            ],
        );
        let time = "builtin_interfaces/msg/Time";
        let info = "service_msgs/msg/ServiceEventInfo";
        let known = |name: &str| Kind::Message(name.to_owned());
        let mut nested = vec![
            message(
                &format!("{}_Event", self.name),
                vec![
                    field("info", known(info), Many::One),
                    field("request", of_service("Request"), Many::AtMost(1)),
                    field("response", of_service("Response"), Many::AtMost(1)),
                ],
            ),
            message(
                info,
                vec![
                    field("event_type", Kind::Base("uint8"), Many::One),
                    field("stamp", known(time), Many::One),
                    field("client_gid", Kind::Base("uint8"), Many::Array(16)),
                    field("sequence_number", Kind::Base("int64"), Many::One),
                ],
            ),
            message(
                time,
                vec![
                    field("sec", Kind::Base("int32"), Many::One),
                    field("nanosec", Kind::Base("uint32"), Many::One),
                ],
            ),
        ];
        for Definition {
            root,
            nested: below,
        } in [&self.request, &self.response]
        {
            nested.push(root.clone());
            nested.extend_from_slice(below);
        }
        hash(&service, &nested)
    }
}
