//! Who is let in: so many connections at a time, and none for long that does not say what it wants.

use std::cell::Cell;
use std::io;
use std::net::{self, SocketAddr};
use std::os::fd::AsFd;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, ready};
use std::time::Duration;

use axum::extract::connect_info::Connected;
use axum::serve::{IncomingStream, Listener};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::runtime::Handle;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::{Sleep, sleep, timeout};

use crate::frames::{Frames, Request};
use crate::guest::{Guest, Room};
use crate::limits::Limits;

/// How long to wait when the system has no more sockets to give.
const PAUSE: Duration = Duration::from_millis(50);

/// How long a client that was told why it has to go may take to go.
const SEEING_OUT: Duration = Duration::from_secs(1);

/// Takes connections as long as there is room; what is too much is closed at once.
pub(crate) struct Doorman {
    listener: TcpListener,
    places: Arc<Semaphore>,
    room: Arc<Room>,
    head: Duration,
}

/// A connection that was let in.
pub(crate) struct Visitor {
    stream: TcpStream,
    place: Option<OwnedSemaphorePermit>,
    guest: Guest,
    deadline: Pin<Box<Sleep>>,
    request: Request,
    frames: Frames,
}

impl Doorman {
    pub(crate) fn new(listener: TcpListener, limits: &Limits, is_read_only: bool) -> Self {
        Self {
            listener,
            places: Arc::new(Semaphore::new(
                limits.connections.min(Semaphore::MAX_PERMITS),
            )),
            room: Room::new(limits, is_read_only),
            head: limits.head,
        }
    }
}

impl Listener for Doorman {
    type Io = Visitor;
    type Addr = SocketAddr;

    async fn accept(&mut self) -> (Visitor, SocketAddr) {
        loop {
            let Ok((stream, address)) = self.listener.accept().await else {
                sleep(PAUSE).await;
                continue;
            };
            let Ok(place) = self.places.clone().try_acquire_owned() else {
                continue;
            };
            // Updates are small and wanted now; without it they only come later.
            let _ = stream.set_nodelay(true);
            let visitor = Visitor {
                stream,
                place: Some(place),
                guest: Guest::new(self.room.clone()),
                deadline: Box::pin(sleep(self.head)),
                request: Request::default(),
                frames: Frames::default(),
            };
            return (visitor, address);
        }
    }

    fn local_addr(&self) -> io::Result<SocketAddr> {
        self.listener.local_addr()
    }
}

impl Connected<IncomingStream<'_, Doorman>> for Guest {
    fn connect_info(stream: IncomingStream<'_, Doorman>) -> Self {
        stream.io().guest.clone()
    }
}

impl Visitor {
    /// How many of the bytes that are there next may come.
    fn may_come(&self, bytes: &[u8]) -> io::Result<usize> {
        if !self.guest.is_staying() {
            return Ok({ self.request }.follow(bytes));
        }
        let why = Cell::new("");
        let fits = |held| self.guest.fits(held).map_err(|told| why.set(told)).is_ok();
        let most = { self.frames }.follow(bytes, fits);
        if most == 0 && !bytes.is_empty() {
            self.guest.refuse(why.get());
            return Err(io::Error::other(why.get()));
        }
        Ok(most)
    }

    fn came(&mut self, bytes: &[u8]) {
        if self.guest.is_staying() {
            self.guest.say();
            self.frames.follow(bytes, |_| true);
            self.guest.hold(self.frames.held());
        } else {
            self.request.follow(bytes);
        }
    }
}

impl Drop for Visitor {
    /// A socket that is closed before all was read is reset, and its client may lose what it was told last.
    fn drop(&mut self) {
        if !self.guest.is_dismissed() {
            return;
        }
        let again = self.stream.as_fd().try_clone_to_owned();
        if let (Ok(again), Ok(runtime)) = (again, Handle::try_current()) {
            runtime.spawn(see_out(again.into(), self.place.take()));
        }
    }
}

/// Passes over what a client says still, which keeps its place for so long.
async fn see_out(stream: net::TcpStream, _place: Option<OwnedSemaphorePermit>) {
    let is_told = stream.shutdown(net::Shutdown::Write);
    let (Ok(()), Ok(stream)) = (is_told, TcpStream::from_std(stream)) else {
        return;
    };
    let mut bytes = vec![0; 4096];
    let _ = timeout(SEEING_OUT, async {
        while stream.readable().await.is_ok() {
            match stream.try_read(&mut bytes) {
                Ok(1..) => {}
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                Ok(0) | Err(_) => break,
            }
        }
    })
    .await;
}

impl AsyncRead for Visitor {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        if !self.guest.is_staying() {
            if self.deadline.as_mut().poll(context).is_ready() {
                return Poll::Ready(Err(io::ErrorKind::TimedOut.into()));
            }
            // What is behind its only request are frames, if it stays: they are counted from the first on.
            if self.request.is_over() {
                return Poll::Pending;
            }
        }
        if buffer.remaining() == 0 {
            return Poll::Ready(Ok(()));
        }
        let mut next = ReadBuf::new(buffer.initialize_unfilled());
        ready!(self.stream.poll_peek(context, &mut next))?;
        let most = self.may_come(next.filled())?;
        let mut part = ReadBuf::new(buffer.initialize_unfilled_to(most));
        ready!(Pin::new(&mut self.stream).poll_read(context, &mut part))?;
        self.came(part.filled());
        let came = part.filled().len();
        buffer.advance(came);
        Poll::Ready(Ok(()))
    }
}

impl AsyncWrite for Visitor {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let written = ready!(Pin::new(&mut self.stream).poll_write(context, bytes));
        self.guest.take();
        Poll::Ready(written)
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let written = ready!(Pin::new(&mut self.stream).poll_write_vectored(context, slices));
        self.guest.take();
        Poll::Ready(written)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }
}
