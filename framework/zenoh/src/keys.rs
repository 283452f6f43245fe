//! The side of Zenoh: what is declared there, and what comes from it.
//!
//! Zenoh calls from threads of its own; it only leaves wishes in a queue that has an end.

use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};

use crate::Result;
use zenoh::bytes::Encoding;
use zenoh::pubsub::{Publisher, Subscriber};
use zenoh::query::{Query, Queryable};
use zenoh::sample::Locality;
use zenoh::{Session, Wait as _};

use crate::edges::{self, Edge};
use crate::options::Options;

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
    declared: Vec<Declared>,
}

/// What an edge has in the session; it is gone with this.
#[derive(Default)]
struct Declared {
    publisher: Option<Publisher<'static>>,
    _subscriber: Option<Subscriber<()>>,
    _queryable: Option<Queryable<()>>,
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
            declared: Vec::new(),
        })
    }

    /// Whose 16 bytes tell this bridge from others.
    pub(crate) fn id(&self) -> [u8; 16] {
        self.session.zid().to_le_bytes()
    }

    /// What is mapped.
    pub(crate) fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Declares these edges; those that are there already stay. What was wished before is refused.
    ///
    /// # Errors
    /// If Zenoh refuses a key.
    pub(crate) fn declare(&mut self, edges: Vec<Edge>) -> Result<()> {
        // They are of before: a call from then would move the robot now, and its number may be another edge's.
        self.refuse_wishes("the robot was away");
        if edges == self.edges {
            return Ok(());
        }
        self.declared.clear();
        // What an edge of before says even now comes nowhere.
        (self.sender, self.wishes) = sync_channel(WISHES);
        self.edges.clear();
        for (index, edge) in edges.iter().enumerate() {
            let key = format!("{}{}", self.prefix, edge.key);
            let declared = self.declare_edge(index, edge, &key);
            self.declared
                .push(declared.map_err(|error| format!("the key `{key}`: {error}"))?);
        }
        self.edges = edges;
        Ok(())
    }

    fn declare_edge(&self, index: usize, edge: &Edge, key: &str) -> zenoh::Result<Declared> {
        let mut declared = Declared::default();
        if edge.goes_out() {
            let encoding = match edge.encoding {
                edges::Encoding::Json => Encoding::APPLICATION_JSON,
                edges::Encoding::Cdr => Encoding::APPLICATION_CDR,
            };
            let publisher = self.session.declare_publisher(key.to_owned());
            declared.publisher = Some(publisher.encoding(encoding).wait()?);
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
            let queryable =
                queryable.callback(
                    move |query| match sender.try_send(Wish::Query(index, query)) {
                        Err(TrySendError::Full(Wish::Query(_, query))) => {
                            refuse(&query, "the bridge has too many queries to answer");
                        }
                        Err(TrySendError::Disconnected(Wish::Query(_, query))) => {
                            refuse(&query, "the robot has this key no longer");
                        }
                        _ => {}
                    },
                );
            declared._queryable = Some(queryable.wait()?);
        }
        Ok(declared)
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

    /// Answers a query.
    pub(crate) fn answer(&self, index: usize, query: &Query, value: &serde_json::Value) {
        let Some(edge) = self.edges.get(index) else {
            return refuse(query, "the robot has this key no longer");
        };
        let key = format!("{}{}", self.prefix, edge.key);
        let reply = query.reply(key, value.to_string());
        let reply = reply.encoding(Encoding::APPLICATION_JSON);
        // Who asked has gone: nobody else is to be told.
        let _ = reply.wait();
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

/// Tells who asked why there is no answer.
pub(crate) fn refuse(query: &Query, reason: &str) {
    // Who asked has gone: nobody else is to be told.
    let _ = query.reply_err(reason).wait();
}
