//! What the recordings of the tests say of themselves.

use std::time::Duration;

use hulkgen_recording::{Attachment, Channel, ChannelId, Description, Metadata, Schema, Settings};

pub(crate) const FRAMES: ChannelId = ChannelId(0);
pub(crate) const VALUES: ChannelId = ChannelId(1);

pub(crate) fn description() -> Description {
    let channel = |topic: &str, once_per_chunk| Channel {
        topic: topic.to_owned(),
        schema: Some(0),
        encoding: "json".to_owned(),
        metadata: vec![("instance".to_owned(), "Control".to_owned())],
        once_per_chunk,
    };
    Description {
        library: "test".to_owned(),
        schemas: vec![Schema {
            name: "number".to_owned(),
            encoding: "jsonschema".to_owned(),
            data: br#"{"type":"number"}"#.to_vec(),
        }],
        channels: vec![channel("/frames", false), channel("/values", true)],
        metadata: vec![Metadata {
            name: "run".to_owned(),
            entries: vec![("id".to_owned(), "1".to_owned())],
        }],
        attachments: vec![Attachment {
            name: "hulk.toml".to_owned(),
            media_type: "application/toml".to_owned(),
            data: b"[robot]".to_vec(),
        }],
    }
}

pub(crate) fn settings() -> Settings {
    Settings {
        budget: 1 << 30,
        blocks: 8,
        block_bytes: 4096,
        late: 3,
        chunk_bytes: 8192,
        longest: Duration::from_secs(60),
    }
}
