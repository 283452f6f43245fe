//! What shows the bridge to the graph of ROS 2: tokens of Zenoh that live as long as what they name, in the form of rmw_zenoh.
//!
//! ```text
//! @ros2_lv/DOMAIN/SESSION/NODE/ENTITY/KIND/ENCLAVE/NAMESPACE/NODE NAME/TOPIC/TYPE/HASH/QOS
//! ```
//! A `/` within a part is written `%`, what is empty as well.

use twox_hash::XxHash3_128;

use super::key::Key;
use super::names;

/// The bridge's only node in its session.
const NODE: u32 = 0;

/// Reliable, volatile, the last ten kept: what most nodes of ROS 2 ask for. What is left out is rmw_zenoh's default.
const QOS: &str = "::,10:,:,:,,";

/// Something that a node has.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(crate) enum Entity {
    Publisher,
    Subscription,
    Service,
}

impl Entity {
    fn code(self) -> &'static str {
        match self {
            Self::Publisher => "MP",
            Self::Subscription => "MS",
            Self::Service => "SS",
        }
    }
}

/// A bridge as ROS 2 sees it.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    session: String,
    name: String,
}

impl Node {
    /// Of this session of Zenoh and the robot of this name.
    pub(crate) fn new(session: &zenoh::Session, robot: &str) -> Self {
        Self {
            session: session.zid().to_string(),
            name: names::node(robot),
        }
    }

    /// The token of the node itself.
    pub(crate) fn token(&self, domain: u32) -> String {
        self.begin(domain, NODE, "NN")
    }

    /// The token of something that the node has; `id` is of it alone.
    pub(crate) fn token_of(&self, entity: Entity, key: &Key, id: u32) -> String {
        let node = self.begin(key.domain, id, entity.code());
        let name = key.name.replace('/', "%");
        format!("{node}/%{name}/{}/{}/{QOS}", key.full_type(), key.hash)
    }

    fn begin(&self, domain: u32, entity: u32, kind: &str) -> String {
        let Self { session, name } = self;
        format!("@ros2_lv/{domain}/{session}/{NODE}/{entity}/{kind}/%/%/{name}")
    }
}

/// Who made a message, as rmw_zenoh derives it of who announced itself with this token.
pub(crate) fn gid(token: &str) -> [u8; 16] {
    XxHash3_128::oneshot(token.as_bytes()).to_le_bytes()
}
