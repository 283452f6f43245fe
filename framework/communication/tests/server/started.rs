//! Where a robot's program serves that runs on a thread of the test.

use std::cell::RefCell;
use std::net::SocketAddr;
use std::sync::mpsc::Sender;

use framework::Stop;
use framework::launch::{Listening, Served};
use framework::link::Link;
use hulkgen_communication::{Limits, Server};

thread_local! {
    /// Who is told where the program of this thread can be reached.
    static STARTED: RefCell<Option<Sender<(SocketAddr, Stop)>>> = const { RefCell::new(None) };
}

/// The next program of this thread tells this one where it can be reached, and how it is stopped.
pub(crate) fn tell(started: Sender<(SocketAddr, Stop)>) {
    STARTED.set(Some(started));
}

/// What a program is started with to be served.
pub(crate) fn serve(
    link: Link,
    listening: Listening,
) -> framework::Result<Option<Box<dyn Served>>> {
    let stop = link.stop.clone();
    let server = Server::start(link, listening, Limits::default())?;
    let started = STARTED.take().expect("somebody waits");
    started
        .send((Served::address(&server), stop))
        .expect("it waits still");
    Ok(Some(Box::new(server)))
}
