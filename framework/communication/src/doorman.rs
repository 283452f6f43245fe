//! Who is let in: so many connections at a time, and none for long that does not say what it wants.

use std::io;
use std::net::SocketAddr;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, ready};
use std::time::Duration;

use axum::extract::connect_info::Connected;
use axum::serve::{IncomingStream, Listener};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::{Sleep, sleep};

use crate::guest::{Guest, Room};
use crate::limits::Limits;

/// How long to wait when the system has no more sockets to give.
const PAUSE: Duration = Duration::from_millis(50);

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
    _place: OwnedSemaphorePermit,
    guest: Guest,
    deadline: Pin<Box<Sleep>>,
}

impl Doorman {
    pub(crate) fn new(listener: TcpListener, limits: &Limits) -> Self {
        Self {
            listener,
            places: Arc::new(Semaphore::new(
                limits.connections.min(Semaphore::MAX_PERMITS),
            )),
            room: Room::new(limits),
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
                _place: place,
                guest: Guest::new(self.room.clone()),
                deadline: Box::pin(sleep(self.head)),
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
            // How long a head may be is known to who reads it.
            return Pin::new(&mut self.stream).poll_read(context, buffer);
        }
        let most = self.guest.may_come();
        if most == 0 {
            return Poll::Ready(Err(io::Error::other("too long a message")));
        }
        let most = most.min(buffer.remaining());
        let mut part = ReadBuf::new(buffer.initialize_unfilled_to(most));
        ready!(Pin::new(&mut self.stream).poll_read(context, &mut part))?;
        let came = part.filled().len();
        buffer.advance(came);
        self.guest.came(came);
        Poll::Ready(Ok(()))
    }
}

impl AsyncWrite for Visitor {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.stream).poll_write(context, bytes)
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
        Pin::new(&mut self.stream).poll_write_vectored(context, slices)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }
}
