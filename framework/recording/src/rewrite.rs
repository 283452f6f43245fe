//! Messages that become others on the writer's thread.

use std::collections::BTreeMap;

use hulkgen_mcap::{ChannelId, MESSAGE_HEAD, RECORD_HEAD, opcode};

/// Makes the data of a message out of that which a cycler wrote, at a time in nanoseconds of the run; false: there is none.
pub type Rewrite = fn(u64, &[u8], &mut Vec<u8>) -> bool;

/// By channel.
pub type Rewrites = BTreeMap<ChannelId, Rewrite>;

/// The messages of a block, rewritten; those that have nothing to become are left out.
pub(crate) fn rewritten(block: &[u8], rewrites: &Rewrites, into: &mut Vec<u8>) {
    into.clear();
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
        let is_written = match rewrite {
            // The time stands behind channel and sequence.
            Some(rewrite) => rewrite(number(RECORD_HEAD + 6), data, into),
            None => {
                into.extend_from_slice(data);
                true
            }
        };
        if !is_written {
            into.truncate(start);
            continue;
        }
        let content = (into.len() - start - RECORD_HEAD) as u64;
        into[start] = opcode::MESSAGE;
        into[start + 1..start + RECORD_HEAD].copy_from_slice(&content.to_le_bytes());
    }
}
