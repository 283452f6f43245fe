//! A robot as another machine sees it through the bridge: values that the manifest maps, and instances to be fed.

use std::marker::PhantomData;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use zenoh::pubsub::Subscriber;
use zenoh::query::Reply;
use zenoh::{Session, Wait as _};

use crate::{Error, Feeder, open};

/// The bridge gives the robot so long for an answer.
pub(crate) const PATIENCE: Duration = Duration::from_secs(10);

/// A robot behind a bridge.
#[derive(Clone, Debug)]
pub struct Robot {
    session: Session,
    prefix: String,
}

/// The newest value of a key, kept up to date.
#[derive(Debug)]
pub struct Watched<T> {
    key: String,
    newest: Arc<Mutex<Option<Sample>>>,
    _subscriber: Subscriber<()>,
    _type: PhantomData<fn() -> T>,
}

/// A value with the cycle that wrote it.
#[derive(Clone, Debug, PartialEq)]
pub struct Newest<T> {
    /// The robot's number of the cycle.
    pub cycle: u64,
    /// Its timestamp in nanoseconds of the robot's clock.
    pub time: u64,
    /// What it wrote.
    pub value: T,
}

/// As it came; read when somebody wants it.
#[derive(Clone, Debug)]
struct Sample {
    value: Vec<u8>,
    attachment: Vec<u8>,
}

/// What the bridge puts beside a value.
#[derive(Deserialize)]
struct Beside {
    cycle: u64,
    time: u64,
}

impl Robot {
    /// Looks for the bridge there (`tcp/ADDRESS:PORT`, its `--listen`; or that of a router), again and again, and does not wait
    /// for it. `prefix` is that of the bridge, or empty.
    ///
    /// # Errors
    /// If the endpoint is none.
    pub fn connect(endpoint: &str, prefix: &str) -> Result<Self, Error> {
        let prefix = match prefix {
            "" => String::new(),
            prefix => format!("{prefix}/"),
        };
        Ok(Self {
            session: open(&[endpoint.to_owned()], &[])?,
            prefix,
        })
    }

    /// Feeds the instance that the manifest maps to this key.
    ///
    /// # Errors
    /// If it is no key.
    pub fn feeder(&self, key: &str) -> Result<Feeder, Error> {
        Feeder::new(self.session.clone(), self.key(key))
    }

    /// The value of a parameter now.
    ///
    /// # Errors
    /// If nobody answers within 10 s, the robot refuses, or the value is no `T`.
    pub fn read<T: DeserializeOwned>(&self, key: &str) -> Result<T, Error> {
        let key = self.key(key);
        let replies = self
            .session
            .get(&key)
            .timeout(PATIENCE)
            .wait()
            .map_err(of_zenoh)?;
        let Ok(reply) = replies.recv() else {
            return Err(Error::Unanswered(key));
        };
        match answer(&reply) {
            Ok(value) => read(&key, &value),
            Err(message) => Err(Error::Refused { key, message }),
        }
    }

    /// Keeps the newest value of an output, or of a parameter that changes from now on. A robot computes an additional output
    /// while a bridge names it.
    ///
    /// # Errors
    /// If it is no key.
    pub fn watch<T: DeserializeOwned>(&self, key: &str) -> Result<Watched<T>, Error> {
        let key = self.key(key);
        let newest = Arc::new(Mutex::new(None));
        let heard = newest.clone();
        let subscriber = self.session.declare_subscriber(key.clone());
        let subscriber = subscriber.callback(move |sample| {
            // What others put under the key has none.
            if let Some(attachment) = sample.attachment() {
                *lock(&heard) = Some(Sample {
                    value: sample.payload().to_bytes().into_owned(),
                    attachment: attachment.to_bytes().into_owned(),
                });
            }
        });
        Ok(Watched {
            key,
            newest,
            _subscriber: subscriber.wait().map_err(of_zenoh)?,
            _type: PhantomData,
        })
    }

    fn key(&self, key: &str) -> String {
        format!("{}{key}", self.prefix)
    }
}

impl<T: DeserializeOwned> Watched<T> {
    /// `None`: nothing came yet.
    ///
    /// # Errors
    /// If the value is no `T`.
    pub fn newest(&self) -> Result<Option<Newest<T>>, Error> {
        let sample = lock(&self.newest).clone();
        let newest = |Sample { value, attachment }: Sample| {
            let Beside { cycle, time } = read(&self.key, &attachment)?;
            let value = read(&self.key, &value)?;
            Ok(Newest { cycle, time, value })
        };
        sample.map(newest).transpose()
    }
}

/// The answer, or the words of who refuses.
pub(crate) fn answer(reply: &Reply) -> Result<Vec<u8>, String> {
    match reply.result() {
        Ok(sample) => Ok(sample.payload().to_bytes().into_owned()),
        Err(error) => Err(String::from_utf8_lossy(&error.payload().to_bytes()).into_owned()),
    }
}

pub(crate) fn of_zenoh(error: zenoh::Error) -> Error {
    Error::Zenoh(error.to_string())
}

/// Nothing behind a lock of this crate can be half done.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn read<T: DeserializeOwned>(key: &str, bytes: &[u8]) -> Result<T, Error> {
    serde_json::from_slice(bytes).map_err(|error| Error::Unreadable {
        key: key.to_owned(),
        message: error.to_string(),
    })
}
