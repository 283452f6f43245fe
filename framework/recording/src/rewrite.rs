//! Messages that become others on the writer's thread.

use std::collections::BTreeMap;
use std::sync::Arc;

use hulkgen_mcap::{ChannelId, MESSAGE_HEAD, RECORD_HEAD, opcode};

/// Makes the data of a message out of that which a cycler wrote, at a time in nanoseconds of the run. A frame with such a message
/// has no other one.
pub type Rewrite = Arc<dyn Fn(u64, &[u8], &mut Vec<u8>) -> Rewritten + Send + Sync>;

/// What became of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rewritten {
    /// It is another one.
    Whole,
    /// It has nothing to become, and is left out.
    Absent,
    /// It should have become another one, and is lost.
    Lost,
}

/// By channel.
pub type Rewrites = BTreeMap<ChannelId, Rewrite>;

/// The messages of a block, rewritten; how many of them are lost.
pub(crate) fn rewritten(block: &[u8], rewrites: &Rewrites, into: &mut Vec<u8>) -> u64 {
    into.clear();
    let mut lost = 0;
    let mut rest = block;
    while let Some((head, behind)) = rest.split_at_checked(RECORD_HEAD + MESSAGE_HEAD) {
        let number = |place: usize| -> u64 {
            let bytes = head
                .get(place..place + 8)
                .and_then(|bytes| bytes.first_chunk());
            u64::from_le_bytes(*bytes.unwrap_or(&[0; 8]))
        };
        let length = (number(1) as usize).saturating_sub(MESSAGE_HEAD);
        let Some((data, behind)) = behind.split_at_checked(length) else {
            break;
        };
        rest = behind;
        let channel = u16::from_le_bytes([head[RECORD_HEAD], head[RECORD_HEAD + 1]]);
        let rewrite = channel.checked_sub(1).map(ChannelId);
        let rewrite = rewrite.and_then(|channel| rewrites.get(&channel));
        let start = into.len();
        into.extend_from_slice(head);
        let rewritten = match rewrite {
            // The time stands behind channel and sequence.
            Some(rewrite) => rewrite(number(RECORD_HEAD + 6), data, into),
            None => {
                into.extend_from_slice(data);
                Rewritten::Whole
            }
        };
        if rewritten != Rewritten::Whole {
            lost += u64::from(rewritten == Rewritten::Lost);
            into.truncate(start);
            continue;
        }
        let content = (into.len() - start - RECORD_HEAD) as u64;
        into[start] = opcode::MESSAGE;
        into[start + 1..start + RECORD_HEAD].copy_from_slice(&content.to_le_bytes());
    }
    lost
}
