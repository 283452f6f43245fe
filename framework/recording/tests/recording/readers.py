"""Reads recordings with the package `mcap`: one line of JSON for each file.

`FILE:OFFSET,…` is read as if it broke off at each of the offsets.
"""

import io
import json
import sys

from mcap.reader import make_reader
from mcap.records import Channel, Chunk, Message
from mcap.stream_reader import StreamReader, breakup_chunk


def whole(path):
    """What the index finds, with all check sums."""
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        messages = [
            (channel.topic, message.sequence, message.log_time, message.data.decode())
            for _, channel, message in reader.iter_messages()
        ]
        return {
            "messages": len(messages),
            "statistics": summary.statistics.message_count,
            "chunks": len(summary.chunk_indexes),
            "frames": [int(data) for topic, _, _, data in messages if topic == "/frames"],
            "attachments": [attachment.name for attachment in reader.iter_attachments()],
            "metadata": {entry.name: entry.metadata for entry in reader.iter_metadata()},
        }


def streamed(data):
    """Frames of all chunks up to where the file breaks off."""
    topics, frames, chunks = {}, [], 0
    try:
        for record in StreamReader(io.BytesIO(data), emit_chunks=True, validate_crcs=True).records:
            if isinstance(record, Channel):
                topics[record.id] = record.topic
            if isinstance(record, Chunk):
                found = breakup_chunk(record, validate_crc=True)
                chunks += 1
                frames += [
                    int(message.data)
                    for message in found
                    if isinstance(message, Message) and topics[message.channel_id] == "/frames"
                ]
    except Exception:  # whatever a reader makes of a file that breaks off
        pass
    return {"chunks": chunks, "frames": frames}


for argument in sys.argv[1:]:
    path, _, offsets = argument.partition(":")
    if not offsets:
        print(json.dumps(whole(path)))
        continue
    with open(path, "rb") as file:
        data = file.read()
    for offset in offsets.split(","):
        print(json.dumps(streamed(data[: int(offset)])))
