//! How much one client, or all of them, may ask of the server.

use std::time::Duration;

/// Every socket is hostile until it has shown otherwise: what it may take is counted.
#[derive(Clone, Debug)]
pub struct Limits {
    /// Connections at the same time, of pages and files, too.
    pub connections: usize,
    /// Until a connection has become a WebSocket; what is none by then is closed.
    pub head: Duration,
    /// Until a client that says nothing, not even to a ping, counts as gone; only while it is listened to and takes what it is sent.
    pub silence: Duration,
    /// Until a client that takes nothing, no part of a message either, counts as gone.
    pub taking: Duration,
    /// Bytes of one message of a client: an image as JSON has a few million.
    pub message_bytes: usize,
    /// As `message_bytes`, of a client that may change nothing: it has to say little.
    pub stranger_bytes: usize,
    /// Bytes beyond `stranger_bytes` of messages that have not come as a whole, of all clients.
    pub arriving_bytes: usize,
    /// Lists and objects within each other in one message.
    pub nesting: usize,
    /// Bytes of a path.
    pub path_bytes: usize,
    /// Subscriptions of one client.
    pub subscriptions: usize,
    /// Images that are compressed at the same time, of all clients; those with the same image and quality share one.
    pub jpegs: usize,
    /// As `jpegs`, of those that one client takes: so that others can have theirs.
    pub jpegs_of_client: usize,
    /// Requests of one client that wait for a cycle or a node.
    pub waiting: usize,
    /// Updates of one subscription that wait to be sent: at 83 Hz a third of a second.
    pub queued_updates: usize,
    /// Bytes of updates, of log messages, and of answers that wait to be sent to one client.
    pub queued_bytes: usize,
    /// Bytes of values that clients put in place of outputs, and that others took the place of since, of all clients.
    pub passed_over_bytes: usize,
    /// Wrong tokens of one connection.
    pub wrong_tokens: u32,
    /// Entries in one answer to `paths`.
    pub entries: usize,
    /// Spans in one answer to `trace`: the newest.
    pub spans: usize,
    /// Log messages of one module in a second; more are left out.
    pub logs_per_second: usize,
    /// Log messages that are kept for clients who come late.
    pub kept_logs: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            connections: 64,
            head: Duration::from_secs(20),
            silence: Duration::from_secs(60),
            taking: Duration::from_secs(20),
            message_bytes: 8 << 20,
            stranger_bytes: 64 << 10,
            arriving_bytes: 32 << 20,
            nesting: 64,
            path_bytes: 1024,
            subscriptions: 1024,
            jpegs: 16,
            jpegs_of_client: 8,
            waiting: 64,
            queued_updates: 32,
            queued_bytes: 16 << 20,
            passed_over_bytes: 16 << 20,
            wrong_tokens: 5,
            entries: 20_000,
            spans: 20_000,
            logs_per_second: 200,
            kept_logs: 2000,
        }
    }
}
