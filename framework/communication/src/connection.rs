//! One client's WebSocket, from its first message to its end.

use std::future::ready;
use std::pin::pin;
use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::extract::ws::{CloseCode, CloseFrame, Message, WebSocket, close_code};
use futures_util::SinkExt;
use tokio::sync::Notify;
use tokio::time::{MissedTickBehavior, interval, timeout};

use crate::guest::Guest;
use crate::hub::ClientId;
use crate::server::Shared;

/// A client is asked for a sign of life so many times before it counts as gone.
const PINGS: u32 = 3;

/// What is sent before the client is listened to again: it may want less.
const AT_ONCE: usize = 64 << 10;

/// Serves one client until it leaves, says what it may not, or is silent for too long.
pub(crate) async fn talk(mut socket: WebSocket, guest: Guest, shared: Arc<Shared>) {
    let (client, news) = shared.hub().connect();
    guest.may_change(shared.hub().may_change(client));
    // Whatever ends this, also the end of the server, releases what the client holds.
    let _leaving = Leaving {
        client,
        shared: &shared,
    };
    let mut pings = interval((shared.limits.silence / PINGS).max(Duration::from_millis(1)));
    pings.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let mut heard = Instant::now();
    let mut ending = shared.ending.subscribe();
    let mut why = None;
    loop {
        let begun = Instant::now();
        let Some(is_more) = send_some(&mut socket, client, &guest, &shared).await else {
            break;
        };
        let may_ask = shared.hub().may_ask(client);
        // Who is not listened to is not silent.
        heard = match may_ask {
            true => heard + begun.elapsed(),
            false => Instant::now(),
        };
        tokio::select! {
            _ = ending.changed() => {
                let _ = send_some(&mut socket, client, &guest, &shared).await;
                why = Some((close_code::AWAY, "the robot ends"));
                break;
            }
            received = socket.recv(), if may_ask => {
                let message = match received {
                    Some(Ok(Message::Close(_))) | None => break,
                    Some(Ok(message)) => message,
                    Some(Err(_)) => {
                        let refusal = guest.refusal().map(|why| (close_code::POLICY, why));
                        why = refusal
                            .or(Some((close_code::PROTOCOL, "no message that this server takes")));
                        break;
                    }
                };
                if !receive(message, client, &guest, &shared) {
                    let _ = send_some(&mut socket, client, &guest, &shared).await;
                    why = Some((close_code::POLICY, "too many wrong tokens"));
                    break;
                }
                heard = Instant::now();
            }
            _ = pings.tick() => {
                if heard.max(guest.said()).elapsed() > shared.limits.silence {
                    why = Some((close_code::POLICY, "silent for too long"));
                    break;
                }
                let ping = socket.send(Message::Ping(Vec::new().into()));
                if taken(ping, &guest, shared.limits.taking).await.is_none() {
                    break;
                }
            }
            () = news.notified() => {}
            () = ready(()), if is_more => {}
        }
    }
    if why.is_some() {
        guest.dismiss();
    }
    // So that it knows; whether it still listens is its own matter.
    let _ = timeout(
        Duration::from_millis(100),
        socket.send(Message::Close(why.map(frame))),
    )
    .await;
}

fn frame((code, reason): (CloseCode, &'static str)) -> CloseFrame {
    CloseFrame {
        code,
        reason: reason.into(),
    }
}

/// Whether the client may go on.
fn receive(message: Message, client: ClientId, guest: &Guest, shared: &Shared) -> bool {
    match message {
        Message::Text(text) => {
            let goes_on = shared.hub().receive(client, text.as_str());
            guest.may_change(shared.hub().may_change(client));
            shared.work.notify_one();
            goes_on
        }
        Message::Binary(_) => {
            shared.hub().refuse_binary(client);
            true
        }
        Message::Ping(_) | Message::Pong(_) | Message::Close(_) => true,
    }
}

/// Sends what waits for the client, and says whether more may wait; `None`: it does not take it.
async fn send_some(
    socket: &mut WebSocket,
    client: ClientId,
    guest: &Guest,
    shared: &Shared,
) -> Option<bool> {
    let mut bytes = 0;
    let mut is_more = true;
    while is_more && bytes < AT_ONCE {
        let next = shared.hub().next(client);
        is_more = next.is_some();
        if let Some(message) = next {
            // Short ones take their frame and their turn, too.
            bytes += message_bytes(&message) + 64;
            // Many in one piece: a system call for each would be most of the work.
            taken(socket.feed(message), guest, shared.limits.taking).await?;
        }
    }
    if bytes > 0 {
        taken(socket.flush(), guest, shared.limits.taking).await?;
    }
    Some(is_more)
}

fn message_bytes(message: &Message) -> usize {
    match message {
        Message::Text(text) => text.len(),
        Message::Binary(bytes) | Message::Ping(bytes) | Message::Pong(bytes) => bytes.len(),
        Message::Close(_) => 0,
    }
}

/// Sends as long as the client takes something of it, however little; `None`: it takes nothing for as long as the limit says.
async fn taken(
    sending: impl Future<Output = Result<(), axum::Error>>,
    guest: &Guest,
    limit: Duration,
) -> Option<()> {
    let mut sending = pin!(sending);
    let begun = Instant::now();
    loop {
        let left = limit.saturating_sub(guest.took().max(begun).elapsed());
        match timeout(left, sending.as_mut()).await {
            Ok(sent) => return sent.ok(),
            Err(_) if left.is_zero() => return None,
            Err(_) => {}
        }
    }
}

struct Leaving<'shared> {
    client: ClientId,
    shared: &'shared Shared,
}

impl Drop for Leaving<'_> {
    fn drop(&mut self) {
        self.shared.hub().disconnect(self.client);
    }
}

/// Wakes a connection that has something to send.
pub(crate) type News = Arc<Notify>;
