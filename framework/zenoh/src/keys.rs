//! The side of Zenoh: what is declared there, and what comes from it.
//!
//! Zenoh calls from threads of its own; it only leaves wishes in a queue that has an end.

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};

use crate::Result;
use zenoh::bytes::Encoding;
use zenoh::liveliness::LivelinessToken;
use zenoh::pubsub::{Publisher, Subscriber};
use zenoh::query::{Query, Queryable};
use zenoh::sample::Locality;
use zenoh::{Session, Wait as _};

use crate::edges::{self, Edge, Kind};
use crate::options::Options;
use crate::ros2::announce::{Entity, Node, gid};
use crate::ros2::interface;

/// Wishes that wait for the robot; of more, queries are refused and values are lost.
const WISHES: usize = 256;

/// Longer payloads are refused before anybody reads them.
pub(crate) const LONGEST: usize = 1 << 20;

/// What the other side wants. Numbers are places in the list of edges.
pub(crate) enum Wish {
    /// A value of a parameter, or what became of a cycle of another machine.
    Put(usize, Vec<u8>),
    /// A call of a procedure, a parameter to be read or written, or what became of a cycle of another machine.
    Query(usize, Query),
}

/// A session of Zenoh with what is declared in it.
pub(crate) struct Keys {
    session: Session,
    prefix: String,
    sender: SyncSender<Wish>,
    pub(crate) wishes: Receiver<Wish>,
    edges: Vec<Edge>,
    /// Its name.
    robot: String,
    declared: Vec<Declared>,
    /// The bridge as ROS 2 sees it, in each domain that an edge is in.
    nodes: BTreeMap<u32, LivelinessToken>,
}

/// What an edge has in the session; it is gone with this.
#[derive(Default)]
struct Declared {
    publisher: Option<Publisher<'static>>,
    _subscriber: Option<Subscriber<()>>,
    _queryable: Option<Queryable<()>>,
    _tokens: Vec<LivelinessToken>,
    /// Of who publishes, by rmw_zenoh's rule.
    gid: Option<[u8; 16]>,
    /// Robots come and go, and the key stays as it is.
    is_objected: bool,
}

impl Keys {
    /// Opens the session; who is not there yet is looked for by Zenoh, again and again.
    ///
    /// # Errors
    /// If an endpoint is none, or cannot be listened at.
    pub(crate) fn open(options: &Options) -> Result<Self> {
        let session = hulkgen_zenoh::open(&options.connect, &options.listen);
        let session = session.map_err(|error| error.to_string())?;
        let (sender, wishes) = sync_channel(WISHES);
        Ok(Self {
            session,
            prefix: options.prefix.clone(),
            sender,
            wishes,
            edges: Vec::new(),
            robot: String::new(),
            declared: Vec::new(),
            nodes: BTreeMap::new(),
        })
    }

    /// Whose 16 bytes tell the publisher of this edge from others.
    pub(crate) fn id(&self, index: usize) -> [u8; 16] {
        let gid = self.declared.get(index).and_then(|one| one.gid);
        gid.unwrap_or_else(|| self.session.zid().to_le_bytes())
    }

    /// Whether nobody was told yet what is wrong with the key of this edge; from now on somebody was.
    pub(crate) fn objects_first(&mut self, index: usize) -> bool {
        let declared = self.declared.get_mut(index);
        declared.is_some_and(|one| !std::mem::replace(&mut one.is_objected, true))
    }

    /// What is mapped.
    pub(crate) fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Declares these edges of the robot of this name; those that are there already stay. What was wished before is refused.
    ///
    /// # Errors
    /// If Zenoh refuses a key.
    pub(crate) fn declare(&mut self, edges: Vec<Edge>, robot: &str) -> Result<()> {
        // They are of before: a call from then would move the robot now, and its number may be another edge's.
        self.refuse_wishes("the robot was away");
        if edges == self.edges && robot == self.robot {
            return Ok(());
        }
        self.declared.clear();
        self.nodes.clear();
        // What an edge of before says even now comes nowhere.
        (self.sender, self.wishes) = sync_channel(WISHES);
        self.edges.clear();
        let node = Node::new(&self.session, robot);
        for (index, edge) in edges.iter().enumerate() {
            let key = format!("{}{}", self.prefix, edge.key);
            let wrong = |error| format!("the key `{key}`: {error}");
            let mut declared = self.declare_edge(index, edge, &key).map_err(wrong)?;
            self.announce(&mut declared, index, edge, &node)
                .map_err(wrong)?;
            self.declared.push(declared);
        }
        self.edges = edges;
        robot.clone_into(&mut self.robot);
        Ok(())
    }

    fn declare_edge(&self, index: usize, edge: &Edge, key: &str) -> zenoh::Result<Declared> {
        let mut declared = Declared::default();
        if edge.goes_out() {
            let publisher = self.session.declare_publisher(key.to_owned());
            declared.publisher = Some(publisher.encoding(encoding(edge)).wait()?);
        }
        if edge.comes_in() {
            let sender = self.sender.clone();
            let subscriber = self.session.declare_subscriber(key.to_owned());
            let subscriber = subscriber
                // What goes out under the key comes not back in.
                .allowed_origin(Locality::Remote)
                .callback(move |sample| {
                    if sample.payload().len() <= LONGEST {
                        let value = sample.payload().to_bytes().into_owned();
                        // Of too many values the newest are lost: the robot is away or busy.
                        let _ = sender.try_send(Wish::Put(index, value));
                    }
                });
            declared._subscriber = Some(subscriber.wait()?);
        }
        if edge.answers() {
            let sender = self.sender.clone();
            let queryable = self.session.declare_queryable(key.to_owned());
            // Clients of ROS 2 ask those alone who say that they have all that is under a key.
            let is_service = edge.kind == Kind::Procedure && edge.encoding == edges::Encoding::Cdr;
            let queryable = queryable.complete(is_service).callback(move |query| {
                match sender.try_send(Wish::Query(index, query)) {
                    Err(TrySendError::Full(Wish::Query(_, query))) => {
                        refuse(&query, "the bridge has too many queries to answer");
                    }
                    Err(TrySendError::Disconnected(Wish::Query(_, query))) => {
                        refuse(&query, "the robot has this key no longer");
                    }
                    _ => {}
                }
            });
            declared._queryable = Some(queryable.wait()?);
        }
        Ok(declared)
    }

    /// Shows the edge to ROS 2, where its key is one of ROS 2.
    fn announce(
        &mut self,
        declared: &mut Declared,
        index: usize,
        edge: &Edge,
        node: &Node,
    ) -> zenoh::Result<()> {
        let Some(key) = interface::key(edge) else {
            return Ok(());
        };
        if !self.nodes.contains_key(&key.domain) {
            let token = self.token(&node.token(key.domain))?;
            self.nodes.insert(key.domain, token);
        }
        let entities = [
            (Entity::Publisher, edge.goes_out()),
            (Entity::Subscription, edge.comes_in()),
            (Entity::Service, edge.kind == Kind::Procedure),
        ];
        // The node itself is 0.
        let first = u32::try_from(index).unwrap_or_default() * 3 + 1;
        for (id, (entity, is_there)) in (first..).zip(entities) {
            if is_there {
                let token = node.token_of(entity, &key, id);
                declared._tokens.push(self.token(&token)?);
                if entity == Entity::Publisher {
                    declared.gid = Some(gid(&token));
                }
            }
        }
        Ok(())
    }

    fn token(&self, token: &str) -> zenoh::Result<LivelinessToken> {
        let key = format!("{}{token}", self.prefix);
        self.session.liveliness().declare_token(key).wait()
    }

    /// Publishes a value; nobody waits for those who read it.
    pub(crate) fn publish(&self, index: usize, value: Vec<u8>, attachment: Vec<u8>) -> Result<()> {
        let declared = self.declared.get(index);
        let Some(publisher) = declared.and_then(|one| one.publisher.as_ref()) else {
            return Ok(());
        };
        let put = publisher.put(value).attachment(attachment).wait();
        put.map_err(|error| format!("the key `{}`: {error}", publisher.key_expr()))
    }

    /// Answers a query; JSON has nothing beside it.
    pub(crate) fn answer(&self, index: usize, query: &Query, value: Vec<u8>, attachment: Vec<u8>) {
        let Some(edge) = self.edges.get(index) else {
            return refuse(query, "the robot has this key no longer");
        };
        let key = format!("{}{}", self.prefix, edge.key);
        let reply = query.reply(key, value).encoding(encoding(edge));
        // Who asked has gone: nobody else is to be told.
        let _ = match edge.encoding {
            edges::Encoding::Json => reply.wait(),
            edges::Encoding::Cdr => reply.attachment(attachment).wait(),
        };
    }

    /// Nobody is there who could do it.
    pub(crate) fn refuse_wishes(&self, reason: &str) {
        while let Ok(wish) = self.wishes.try_recv() {
            if let Wish::Query(_, query) = wish {
                refuse(&query, reason);
            }
        }
    }
}

fn encoding(edge: &Edge) -> Encoding {
    match edge.encoding {
        edges::Encoding::Json => Encoding::APPLICATION_JSON,
        edges::Encoding::Cdr => Encoding::APPLICATION_CDR,
    }
}

/// Tells who asked why there is no answer.
pub(crate) fn refuse(query: &Query, reason: &str) {
    // Who asked has gone: nobody else is to be told.
    let _ = query.reply_err(reason).wait();
}
