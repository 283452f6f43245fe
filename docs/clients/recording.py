#!/usr/bin/env python3
"""Reads a recording: lists its channels, prints values of outputs, states, parameters and all else that frames hold.

    pip install mcap
    python3 recording.py list recording.mcap
    python3 recording.py cat recording.mcap Control.main_outputs.ball Control.states.control::walk --cycles 100..110
    python3 recording.py cat recording.mcap parameters

Also a module:

    with Recording("recording.mcap") as recording:
        for message in recording.messages(["frames/Control"]):
            print(message.cycle, message.values["Control.states.control::walk"])

What stands in the file and how it is laid out: docs/recording.md.
"""

import argparse
import json
import math
import os
import struct
import sys
from collections import namedtuple

from mcap.exceptions import EndOfFile, McapError
from mcap.records import Attachment, Channel, Message as Record, Metadata
from mcap.stream_reader import StreamReader

# What a message holds, by path, in the order of its bytes. `kind`: `begun` and `finished` of frames, `values`, `json`.
# `cycle` is the instance's (of parameters their version), `time` is in nanoseconds of the run.
Message = namedtuple("Message", "topic kind cycle time values")

FRAMES = "hulkgen-frames"
VALUES = "hulkgen-values"
VERSION = "2"

# Where parts of a frame lie by what they are to their cycle.
PLACES = {
    "output": "main_outputs.",
    "node": "states.",
    "state": "",
    "previous": "previous.",
    "history": "history.",
    "input": "inputs.",
    "other": "frame.",
}

# Points, vectors and quaternions are lists when they are written.
AXES = {"x": 0, "i": 0, "re": 0, "y": 1, "j": 1, "im": 1, "z": 2, "k": 2, "w": 3}


class Malformed(Exception):
    """Bytes and layout do not fit each other, or the file breaks off."""


class Values:
    """Values one after the other, as postcard writes them."""

    DEEPEST = 200
    # Parts may have no bytes, and a damaged file may count any number of them.
    FREE_PARTS = 1 << 16
    PARTS_PER_BYTE = 32

    def __init__(self, data):
        self.data = data
        self.at = 0
        self.parts = 0
        self.depth = 0

    def next(self, layout):
        """The next value, laid out like this: dict, list, str, bytes, number, bool or None."""
        self.depth = 0
        return self.value(layout, ())

    def end(self):
        if self.at < len(self.data):
            raise Malformed(f"byte {self.at}: there are bytes behind the last value")

    def value(self, layout, around):
        """`around` has the structs and enums that the part stands in."""
        self.depth += 1
        self.parts += 1
        if self.depth > self.DEEPEST:
            raise self.malformed("too many parts inside of each other")
        if self.parts > self.FREE_PARTS + self.PARTS_PER_BYTE * self.at:
            raise self.malformed("too many parts for so few bytes")
        kind, content = (layout, None) if isinstance(layout, str) else next(iter(layout.items()))
        read = self.READ.get(kind)
        if read is None:
            raise self.malformed(f"a layout of an unknown kind: {kind}")
        # What it stands in is the layout itself, not what is in it.
        value = read(self, layout if kind in ("struct", "enum") else content, around)
        self.depth -= 1
        return value

    def malformed(self, why):
        return Malformed(f"byte {self.at}: {why}")

    def take(self, length):
        if self.at + length > len(self.data):
            raise self.malformed("it goes beyond the end")
        self.at += length
        return self.data[self.at - length : self.at]

    def varint(self, bits):
        """Seven bits a byte, the lowest first; all but the last byte have the eighth."""
        number = 0
        for place in range(-(-min(bits, 128) // 7)):
            (byte,) = self.take(1)
            number |= (byte & 0x7F) << (7 * place)
            if byte < 0x80:
                return number & (2**128 - 1)
        raise self.malformed("the number is too long")

    def unknown(self, _, __):
        raise self.malformed("how it is laid out is not known")

    def unit(self, _, __):
        return None

    def flag(self, _=None, __=None):
        (byte,) = self.take(1)
        if byte > 1:
            raise self.malformed("expected 0 or 1")
        return byte == 1

    def signed(self, bits, _):
        if bits == 8:
            return int.from_bytes(self.take(1), "little", signed=True)
        number = self.varint(bits)
        return (number >> 1) ^ -(number & 1)

    def unsigned(self, bits, _):
        return self.take(1)[0] if bits == 8 else self.varint(bits)

    def float(self, bits, _):
        (number,) = struct.unpack("<f" if bits == 32 else "<d", self.take(4 if bits == 32 else 8))
        return number

    def text(self, _, __):
        try:
            return str(self.bytes(), "utf-8")
        except UnicodeDecodeError as error:
            raise self.malformed("the text is no UTF-8") from error

    def bytes(self, _=None, __=None):
        return bytes(self.take(self.varint(64)))

    def option(self, inner, around):
        return self.value(inner, around) if self.flag() else None

    def list(self, item, around):
        # Images: at once.
        if item == {"unsigned": 8}:
            return self.bytes()
        return [self.value(item, around) for _ in range(self.varint(64))]

    def map(self, both, around):
        entries = {}
        for _ in range(self.varint(64)):
            key = self.value(both[0], around)
            key = key if isinstance(key, str) else dump(key, (",", ":"))
            entries[key] = self.value(both[1], around)
        return entries

    def tuple(self, items, around):
        return [self.value(item, around) for item in items]

    def struct(self, layout, around):
        around += (layout,)
        return {name: self.value(field, around) for name, field in layout["struct"]["fields"]}

    def enum(self, layout, around):
        number, variants = self.varint(32), layout["enum"]["variants"]
        if number >= len(variants):
            raise self.malformed("it has no such variant")
        name, content = variants[number]
        around += (layout,)
        if content == "unit":
            return name
        # Its fields stand in the variant: it is no part of its own.
        is_struct = isinstance(content, dict) and "struct" in content
        return {name: self.struct(content, around) if is_struct else self.value(content, around)}

    def again(self, up, around):
        if not 0 < up <= len(around):
            raise self.malformed("its layout goes beyond itself")
        return self.value(around[-up], around[:-up])

    READ = {
        "unknown": unknown,
        "unit": unit,
        "bool": flag,
        "signed": signed,
        "unsigned": unsigned,
        "float": float,
        "character": text,
        "text": text,
        "bytes": bytes,
        "option": option,
        "list": list,
        "map": map,
        "tuple": tuple,
        "struct": struct,
        "enum": enum,
        "again": again,
    }


def decode(layout, data):
    """The one value that all of these bytes are."""
    values = Values(data)
    value = values.next(layout)
    values.end()
    return value


def to_json(value):
    """As `hulkgen recording cat` prints it: bytes as a list, no number that JSON lacks, and those beyond 64 bits as text."""
    if isinstance(value, dict):
        return {name: to_json(part) for name, part in value.items()}
    if isinstance(value, list):
        return [to_json(part) for part in value]
    if isinstance(value, bytes):
        return list(value)
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, int) and not -(2**63) <= value < 2**64:
        return str(value)
    return value


def dump(value, separators=None):
    return json.dumps(to_json(value), ensure_ascii=False, allow_nan=False, separators=separators)


def from_json(data, what):
    try:
        return json.loads(data)
    except ValueError as error:
        raise Malformed(f"{what} is no JSON: {error}") from error


class Recording:
    """A file, read from its beginning to its end, one chunk in memory."""

    def __init__(self, path):
        self.file = open(path, "rb")
        # Those read so far: `run`, `record`, and at the end how the run ended.
        self.metadata = {}
        self.attachments = {}
        self.types = {"frames": {}, "values": {}}
        self.channels = {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()

    def messages(self, topics=None):
        """All messages, or those of these channels, in the order of the file; check sums are looked at on the way.

        A value that several chunks refer to stands in each of them.
        """
        self.file.seek(0)
        try:
            for record in StreamReader(self.file, validate_crcs=True).records:
                if isinstance(record, Attachment):
                    self.attachments[record.name] = record.data
                    if record.name == "types.json":
                        self.types = from_json(record.data, "`types.json`")
                elif isinstance(record, Metadata):
                    self.metadata[record.name] = record.metadata
                elif isinstance(record, Channel):
                    self.channels[record.id] = record
                elif isinstance(record, Record):
                    channel = self.channels.get(record.channel_id)
                    if channel is None:
                        raise Malformed(f"a message of channel {record.channel_id}, which the file does not tell")
                    if topics is None or channel.topic in topics:
                        yield self.message(channel, record)
        except EndOfFile as error:
            raise Malformed("the file breaks off here; `hulkgen recording recover` makes a whole one of it") from error

    def message(self, channel, record):
        try:
            kind, values = self.decoded(channel, record.data)
        # The others: `types.json` is JSON, and no layouts.
        except (Malformed, AttributeError, IndexError, KeyError, TypeError) as error:
            raise Malformed(f"cycle {record.sequence} of `{channel.topic}` cannot be read: {error}") from error
        return Message(channel.topic, kind, record.sequence, record.log_time, values)

    def decoded(self, channel, data):
        if channel.message_encoding == "json":
            return "json", {channel.topic: from_json(data, "the message")}
        if channel.message_encoding not in (FRAMES, VALUES):
            raise Malformed(f"messages of an unknown encoding: {channel.message_encoding}")
        version = channel.metadata.get("version")
        if version != VERSION:
            raise Malformed(f"it is of version {version}, this program reads {VERSION}")
        instance = channel.topic.partition("/")[2]
        if channel.message_encoding == VALUES:
            return "values", self.shared(instance, data)
        kind, rest = data[:1], data[1:]
        if kind == b"\0":
            return "begun", self.frame(instance, channel.metadata.get("types"), rest)
        if kind == b"\1":
            return "finished", self.digests(instance, rest)
        raise Malformed("a message of an unknown kind")

    def frame(self, instance, types, data):
        """All that a cycle had when it began."""
        parts = self.types["frames"].get(types)
        if parts is None:
            raise Malformed("the file does not tell its types")
        values = Values(data)
        found = {f"{instance}.{PLACES[part['kind']]}{part['name']}": values.next(part["layout"]) for part in parts}
        values.end()
        return found

    def shared(self, instance, data):
        """What others read of an instance; the parameters."""
        layout = self.types["values"].get(instance)
        if layout is None:
            raise Malformed("the file does not tell its types")
        value = decode(layout, data)
        if instance == "parameters":
            return {instance: value}
        return {f"{instance}.main_outputs.{name}": part for name, part in value.items()}

    def digests(self, instance, data):
        """Of what the nodes wrote, by node and output. Files from before they were named have their numbers."""
        if len(data) % 8:
            raise Malformed("a digest has 8 bytes")
        digests = struct.unpack(f"<{len(data) // 8}Q", data)
        names = self.types.get("digests", {}).get(instance)
        if names is None:
            names = [["", str(number)] for number in range(len(digests))]
        if len(names) != len(digests):
            raise Malformed(f"{len(digests)} digests of {len(names)} outputs")
        return {
            f"{instance}.digests.{'.'.join(filter(None, name))}": f"{digest:016x}"
            for name, digest in zip(names, digests)
        }


def is_below(path, above):
    return path == above or path.startswith(above + ".")


def part(value, names):
    """What lies below a value; raises KeyError where it is absent."""
    for name in names:
        if isinstance(value, dict):
            value = value[name]
        elif isinstance(value, (list, bytes)):
            place = AXES.get(name, int(name) if name.isdecimal() else len(value))
            if place >= len(value):
                raise KeyError(name)
            value = value[place]
        else:
            raise KeyError(name)
    return value


def selected(values, paths):
    """Parts of a message's values that are asked for, with their paths; all without any."""
    for path, value in values.items():
        if not paths or any(is_below(path, asked) for asked in paths):
            yield path, value
            continue
        for asked in paths:
            if is_below(asked, path):
                try:
                    yield asked, part(value, asked[len(path) + 1 :].split("."))
                except KeyError:
                    # Absent in this cycle.
                    pass


def cat(recording, paths, cycles):
    # What other chunks have, too.
    seen = set()
    for message in recording.messages():
        if cycles is not None and message.cycle not in cycles:
            continue
        if message.kind == "values":
            if (message.topic, message.cycle) in seen:
                continue
            seen.add((message.topic, message.cycle))
        values = message.values
        if message.kind != "json":
            # What has a channel of its own is not printed twice.
            own = {channel.topic for channel in recording.channels.values() if channel.message_encoding == "json"}
            values = {path: value for path, value in values.items() if path not in own}
        for path, value in selected(values, paths):
            head = {"path": path, "cycle": message.cycle, "time": message.time / 1e9}
            print(dump({**head, "value": value}))


def list_channels(recording):
    """Reads everything."""
    found = {}
    for message in recording.messages():
        count, first, _ = found.get(message.topic, (0, message.cycle, None))
        found[message.topic] = (count + 1, first, message.cycle)
    for channel in recording.channels.values():
        count, first, last = found.get(channel.topic, (0, None, None))
        one = {"topic": channel.topic, "encoding": channel.message_encoding, "messages": count}
        print(dump({**one, "first_cycle": first, "last_cycle": last}))


def parse_cycles(text):
    first, dots, end = text.partition("..")
    if not (dots and first.isdecimal() and end.isdecimal()):
        raise argparse.ArgumentTypeError("write FROM..TO; TO itself is left out")
    return range(int(first), int(end))


def parse_arguments():
    parser = argparse.ArgumentParser(description="Reads a recording.")
    commands = parser.add_subparsers(dest="command", required=True)
    listing = commands.add_parser("list", help="channels, all of whose messages are decoded, one JSON object a line")
    listing.add_argument("file")
    printing = commands.add_parser("cat", help="values, one JSON object a line")
    printing.add_argument("file")
    printing.add_argument("paths", nargs="*", metavar="PATH")
    printing.add_argument("--cycles", type=parse_cycles, metavar="FROM..TO")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    try:
        with Recording(arguments.file) as recording:
            if arguments.command == "list":
                list_channels(recording)
            else:
                cat(recording, arguments.paths, arguments.cycles)
    except BrokenPipeError:
        # Whoever reads our output (`| head`) has what it wanted.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (Malformed, McapError, OSError) as error:
        raise SystemExit(f"error: {arguments.file}: {error}") from error
    except KeyboardInterrupt:
        raise SystemExit(130) from None


if __name__ == "__main__":
    main()
