//! The command line.

use std::path::PathBuf;

use lexopt::prelude::{Long, Short, ValueExt as _};

use crate::Result;

pub(crate) const HELP: &str = "\
Maps what `[[bridge]]` of a robot's manifest names to keys of Zenoh.

  --host ADDRESS       where the robot is [default: 127.0.0.1:4857]
  --token TOKEN        the robot's, to change parameters and to call [default: HULKGEN_TOKEN of the environment]
  --connect ENDPOINT   of Zenoh, for example tcp/192.168.1.5:7447; may stand several times
  --listen ENDPOINT    where Zenoh finds the bridge, for example tcp/127.0.0.1:7447; may stand several times
  --prefix PREFIX      stands before every key, for example the robot's name: PREFIX/KEY
  --messages FOLDER    write packages of ROS 2 for what is mapped as CDR, print the keys with the right hashes, and end
  --help";

/// What the command line says.
pub(crate) struct Options {
    pub(crate) host: String,
    pub(crate) token: Option<String>,
    pub(crate) connect: Vec<String>,
    pub(crate) listen: Vec<String>,
    /// Ends with `/`, or is empty.
    pub(crate) prefix: String,
    /// Where packages of ROS 2 are wanted instead of a bridge.
    pub(crate) messages: Option<PathBuf>,
}

/// `None`: somebody wants help.
///
/// # Errors
/// If an option is none, lacks its value, or none says where Zenoh is.
pub(crate) fn read() -> Result<Option<Options>> {
    let mut options = Options {
        host: format!("127.0.0.1:{}", protocol::PORT),
        token: std::env::var("HULKGEN_TOKEN").ok(),
        connect: Vec::new(),
        listen: Vec::new(),
        prefix: String::new(),
        messages: None,
    };
    let mut arguments = lexopt::Parser::from_env();
    let wrong = |error: lexopt::Error| format!("{error}; see --help");
    while let Some(argument) = arguments.next().map_err(wrong)? {
        let name = match argument {
            Short('h') | Long("help") => return Ok(None),
            Long(name) => name.to_owned(),
            other => return Err(wrong(other.unexpected())),
        };
        let value = |arguments: &mut lexopt::Parser| {
            let value = arguments.value().and_then(|value| value.string());
            value.map_err(wrong)
        };
        match name.as_str() {
            "host" => options.host = value(&mut arguments)?,
            "token" => options.token = Some(value(&mut arguments)?),
            "connect" => options.connect.push(value(&mut arguments)?),
            "listen" => options.listen.push(value(&mut arguments)?),
            "prefix" => options.prefix = format!("{}/", value(&mut arguments)?),
            "messages" => options.messages = Some(value(&mut arguments)?.into()),
            _ => return Err(format!("invalid option '--{name}'; see --help")),
        }
    }
    if options.messages.is_none() && options.connect.is_empty() && options.listen.is_empty() {
        return Err(
            "nobody says where Zenoh is: give `--connect ENDPOINT` or `--listen ENDPOINT`; see --help"
                .to_owned(),
        );
    }
    Ok(Some(options))
}
