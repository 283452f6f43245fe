//! What a binary and its communication server know of each other.
//!
//! The server is a crate of its own, which needs the framework; the generated `main` brings them together.

use std::io;
use std::net::{SocketAddr, TcpListener, ToSocketAddrs as _};
use std::path::PathBuf;
use std::sync::Arc;

use crate::error::{Error, Result};
use crate::link::Link;

/// Starts to serve the clients of a robot, on a thread of its own; `None`: nobody is served.
pub type Serve = fn(Link, Listening) -> Result<Option<Box<dyn Served>>>;

/// What the command line says about clients.
#[derive(Clone, Debug, Default)]
pub struct Listening {
    /// The target that runs.
    pub target: &'static str,
    /// The data-flow graph as JSON; empty where the binary does not have it.
    pub graph: &'static str,
    /// `ADDRESS:PORT`; by default this machine alone may connect.
    pub address: Option<String>,
    /// The socket at `address`, where it is open already.
    pub socket: Option<Arc<TcpListener>>,
    /// What clients have to know before they may change anything.
    pub token: Option<String>,
    /// Nobody may change anything.
    pub is_read_only: bool,
    /// Other robots as browsers name them, `HOST:PORT`: their pages may show this robot, and its page may show them.
    pub peers: Vec<String>,
    /// Files of the page from here instead of those in the program.
    pub web_root: Option<PathBuf>,
}

impl Listening {
    /// Opens the socket at [`address`](Self::address), or gives the one that is open; `None`: nobody said which.
    ///
    /// # Errors
    /// If it is no address of this machine, or its port is taken.
    pub fn open(&self) -> Result<Option<TcpListener>> {
        let Some(address) = self.address.as_deref() else {
            return Ok(None);
        };
        let failed = |error: io::Error| {
            Error::from(error).context(format!(
                "--listen {address}: expected an address of this machine with a free port, as 0.0.0.0:4857, or off"
            ))
        };
        if let Some(socket) = &self.socket {
            return socket.try_clone().map(Some).map_err(failed);
        }
        let addresses: Vec<_> = address.to_socket_addrs().map_err(failed)?.collect();
        TcpListener::bind(&addresses[..]).map(Some).map_err(failed)
    }

    /// With its socket open: from here on nobody else has the port.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub(crate) fn opened(self) -> Result<Self> {
        let socket = self.open()?.map(Arc::new);
        Ok(Self { socket, ..self })
    }
}

/// A server that runs until it is dropped.
pub trait Served {
    /// Where clients find it.
    fn address(&self) -> SocketAddr;
}

/// Serves nobody, for binaries without a server.
pub fn nobody(_: Link, _: Listening) -> Result<Option<Box<dyn Served>>> {
    Ok(None)
}
