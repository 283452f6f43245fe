//! The server's thread: it listens, hands out the page, and lets clients talk to the robot.

use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use axum::Router;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{ConnectInfo, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, Uri, header};
use axum::middleware::map_response;
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use framework::launch::{Listening, Served};
use framework::link::Link;
use framework::{Error, Result};
use tokio::sync::{Notify, oneshot, watch};
use tokio::time::{sleep, timeout};

use crate::connection;
use crate::doorman::Doorman;
use crate::guest::Guest;
use crate::hub::{Hub, Rules};
use crate::limits::Limits;
use crate::origin;
use crate::page;

/// How often copies of outputs are fetched while somebody wants any.
const LOOK_EVERY: Duration = Duration::from_millis(4);

/// How long clients have to take the news that the server ends.
const GOODBYE: Duration = Duration::from_millis(200);

/// How long nothing is looked at while nobody wants anything.
const REST: Duration = Duration::from_millis(250);

/// The communication server of one robot. Dropping it disconnects everybody.
pub struct Server {
    address: SocketAddr,
    end: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

/// What everything on the server's thread has in common.
pub(crate) struct Shared {
    hub: Mutex<Hub>,
    pub(crate) limits: Limits,
    /// Something is to be looked at.
    pub(crate) work: Notify,
    address: SocketAddr,
    /// Robots whose pages may come, and to which this robot's page may go.
    peers: Vec<String>,
    web_root: Option<PathBuf>,
    /// Becomes true when the server ends.
    pub(crate) ending: watch::Sender<bool>,
}

impl Server {
    /// Listens and serves from now on.
    pub fn start(link: Link, listening: Listening, limits: Limits) -> Result<Self> {
        let listener = listen(&listening)?;
        listener.set_nonblocking(true)?;
        let address = listener.local_addr()?;
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()?;
        let rules = Rules {
            target: listening.target,
            // Whoever reaches the robot over the network may look; to change it takes a token.
            is_read_only: listening.is_read_only
                || (!address.ip().is_loopback() && listening.token.is_none()),
            token: listening.token,
            graph: listening.graph,
            peers: listening.peers.clone(),
        };
        let shared = Arc::new(Shared {
            hub: Mutex::new(Hub::new(link, rules, limits.clone())),
            limits,
            work: Notify::new(),
            address,
            peers: listening.peers,
            web_root: listening.web_root,
            ending: watch::Sender::new(false),
        });
        let (end, is_over) = oneshot::channel();
        let thread = thread::Builder::new()
            .name("communication".to_owned())
            .spawn(move || {
                runtime.block_on(run(listener, shared, is_over));
                // Whatever still talks is cut off here.
                runtime.shutdown_background();
            })?;
        Ok(Self {
            address,
            end: Some(end),
            thread: Some(thread),
        })
    }
}

impl Served for Server {
    fn address(&self) -> SocketAddr {
        self.address
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        drop(self.end.take());
        if let Some(thread) = self.thread.take() {
            // Its panic was told already; the robot goes on without clients.
            let _ = thread.join();
        }
    }
}

impl Shared {
    /// Only this thread comes here, and never while it waits for something.
    pub(crate) fn hub(&self) -> MutexGuard<'_, Hub> {
        self.hub.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// By default this machine alone can connect, and a port that is taken is replaced by a free one.
fn listen(listening: &Listening) -> Result<TcpListener> {
    let local = |port| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    match listening.open()? {
        Some(listener) => Ok(listener),
        None => local(protocol::PORT)
            .or_else(|_| local(0))
            .map_err(Error::from),
    }
}

async fn run(listener: TcpListener, shared: Arc<Shared>, is_over: oneshot::Receiver<()>) {
    let Ok(listener) = tokio::net::TcpListener::from_std(listener) else {
        return;
    };
    let is_read_only = shared.hub().is_read_only();
    let doorman = Doorman::new(listener, &shared.limits, is_read_only);
    let routes = Router::new()
        .route(protocol::SOCKET, get(socket))
        .fallback(get(file))
        .layer(map_response(once))
        .with_state(shared.clone())
        .into_make_service_with_connect_info::<Guest>();
    tokio::select! {
        _ = axum::serve(doorman, routes) => {}
        () = look(&shared) => {}
        // The sender is dropped with the server.
        _ = is_over => {}
    }
    // What was answered until the end is told.
    shared.hub().look_at_last();
    shared.ending.send_replace(true);
    let _ = timeout(GOODBYE, async {
        while shared.hub().has_clients() {
            sleep(LOOK_EVERY).await;
        }
    })
    .await;
}

/// Fetches what instances leave, as long as the server lives.
async fn look(shared: &Shared) {
    loop {
        let is_busy = shared.hub().look();
        if is_busy {
            sleep(LOOK_EVERY).await;
        } else {
            // Over or not, there is something to look at.
            let _ = timeout(REST, shared.work.notified()).await;
        }
    }
}

/// A connection has one request: nothing but what is behind it tells frames from requests.
async fn once(mut response: Response) -> Response {
    if response.status() != StatusCode::SWITCHING_PROTOCOLS {
        let close = HeaderValue::from_static("close");
        response.headers_mut().insert(header::CONNECTION, close);
    }
    response
}

async fn socket(
    State(shared): State<Arc<Shared>>,
    ConnectInfo(guest): ConnectInfo<Guest>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    if let Err(message) = origin::check(&headers, shared.address, &shared.peers) {
        return (StatusCode::FORBIDDEN, message).into_response();
    }
    let bytes = shared.limits.message_bytes;
    upgrade
        .max_message_size(bytes)
        .max_frame_size(bytes)
        .on_upgrade(move |socket| {
            guest.stay();
            connection::talk(socket, guest, shared)
        })
}

async fn file(State(shared): State<Arc<Shared>>, headers: HeaderMap, uri: Uri) -> Response {
    // Pages of other robots have their own files.
    if let Err(message) = origin::check(&headers, shared.address, &[]) {
        return (StatusCode::FORBIDDEN, message).into_response();
    }
    page::file(uri.path(), shared.web_root.as_deref(), &shared.peers)
}
