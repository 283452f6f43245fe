//! A neighbour in Zenoh, for the bridge and for those who come to it.

use zenoh::{Session, Wait as _};

use crate::Error;

/// A peer that finds others only where it is told to. Who is not there yet, or went away, is looked for again and again.
///
/// # Errors
/// If an endpoint is none, or cannot be listened at.
pub fn open(connect: &[String], listen: &[String]) -> Result<Session, Error> {
    let mut config = zenoh::Config::default();
    let list = |endpoints: &[String]| serde_json::to_string(endpoints).expect("texts are JSON");
    for (key, value) in [
        ("mode", "\"peer\"".to_owned()),
        ("connect/endpoints", list(connect)),
        // A robot is looked for by hand: who finds others by itself finds those of the next field.
        ("scouting/multicast/enabled", "false".to_owned()),
        ("listen/endpoints", list(listen)),
    ] {
        let set = config.insert_json5(key, &value);
        set.map_err(|error| Error::Zenoh(format!("{key} = {value}: {error}")))?;
    }
    let session = zenoh::open(config).wait();
    session.map_err(|error| Error::Zenoh(format!("Zenoh cannot be opened: {error}")))
}
