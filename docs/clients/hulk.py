#!/usr/bin/env python3
"""Asks a running robot: lists its paths, prints and plots values, reads and changes parameters.

    pip install websockets
    python3 hulk.py list
    python3 hulk.py echo Control.main_outputs.ball --binary
    python3 hulk.py plot Control.main_outputs.level --seconds 5
    python3 hulk.py get walk.speed
    python3 hulk.py set walk.speed=0.2 walk.step_height=0.015

Also a module: `with Robot() as robot: robot.read("Control.main_outputs.level")`. Messages are those of
docs/protocol/request.schema.json and message.schema.json, binary values those of docs/protocol/binary.md.
"""

import argparse
import json
import math
import os
import struct
import sys
from collections import deque, namedtuple

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

PORT = 4857
VERSION = 1
# Longer answers than any robot's, shorter than what a broken one could fill the memory with.
LARGEST_MESSAGE = 64 * 1024 * 1024

# `time` is in nanoseconds of the robot's clock.
Sample = namedtuple("Sample", "cycle time value")


class Refused(Exception):
    """The robot says no, and why."""


class Malformed(Exception):
    """Bytes and layout do not fit each other."""


class Reader:
    """Reads values by their layout, as docs/protocol/binary.md says."""

    DEEPEST = 128
    FLOATS = {32: "<f", 64: "<d"}

    def __init__(self, described, data):
        self.root = described["root"]
        self.definitions = described.get("definitions", {})
        self.data = memoryview(data)
        self.at = 0
        self.parts = 65536 + 64 * len(data)

    def whole(self):
        """The value; there is nothing behind it."""
        value = self.value(self.root, 0)
        if self.at != len(self.data):
            raise Malformed("there are bytes behind the value")
        return value

    def take(self, length):
        if self.at + length > len(self.data):
            raise Malformed("the bytes end early")
        self.at += length
        return self.data[self.at - length : self.at]

    def count(self):
        return int.from_bytes(self.take(4), "little")

    def flag(self):
        byte = self.take(1)[0]
        if byte > 1:
            raise Malformed("a byte is neither 0 nor 1")
        return byte == 1

    def text(self):
        try:
            return str(self.take(self.count()), "utf-8")
        except UnicodeDecodeError as error:
            raise Malformed("a text is not UTF-8") from error

    def float(self, bits):
        (value,) = struct.unpack(self.FLOATS[bits], self.take(bits // 8))
        return value if math.isfinite(value) else None

    def integer(self, bits, signed):
        value = int.from_bytes(self.take(bits // 8), "little", signed=signed)
        fits = -(2**63) <= value < 2**63 if signed else value < 2**64
        return value if fits else str(value)

    def value(self, layout, depth):
        if depth > self.DEEPEST:
            raise Malformed("parts lie too deep in each other")
        self.parts -= 1
        if self.parts < 0:
            raise Malformed("there are too many parts")
        kind = layout["kind"]
        if kind == "unit":
            return None
        if kind == "bool":
            return self.flag()
        if kind == "character":
            return self.character()
        if kind == "float":
            return self.float(layout["bits"])
        if kind in ("signed", "unsigned"):
            return self.integer(layout["bits"], kind == "signed")
        if kind == "text":
            return self.text()
        if kind == "option":
            return self.value(layout["content"], depth + 1) if self.flag() else None
        if kind == "list":
            return self.items(layout["item"], self.count(), depth)
        if kind == "array":
            return self.items(layout["item"], layout["length"], depth)
        if kind == "tuple":
            return [self.value(item, depth + 1) for item in layout["items"]]
        if kind == "map":
            return self.entries(lambda: self.value(layout["value"], depth + 1))
        if kind == "struct":
            return self.struct(layout["fields"], depth)
        if kind == "enum":
            return self.variant(layout["variants"], depth)
        if kind == "any":
            return self.any(depth)
        if kind == "reference":
            return self.value(self.definitions[layout["name"]], depth + 1)
        raise Malformed(f"a layout of an unknown kind: {kind}")

    def character(self):
        number = self.count()
        if number > 0x10FFFF or 0xD800 <= number < 0xE000:
            raise Malformed("a number is no character")
        return chr(number)

    def items(self, item, length, depth):
        # Images: at once, and only if the bytes are there.
        if item == {"kind": "unsigned", "bits": 8}:
            return list(self.take(length))
        return [self.value(item, depth + 1) for _ in range(length)]

    def entries(self, value):
        entries = {}
        for _ in range(self.count()):
            key = self.text()
            entries[key] = value()
        return entries

    def struct(self, fields, depth):
        return {
            field["name"]: self.value(field["layout"], depth + 1)
            for field in fields
            if not field.get("optional") or self.flag()
        }

    def variant(self, variants, depth):
        number = self.count()
        if number >= len(variants):
            raise Malformed("a variant that the layout does not list")
        variant = variants[number]
        if "content" not in variant:
            return variant["name"]
        return {variant["name"]: self.value(variant["content"], depth + 1)}

    def any(self, depth):
        kind = self.take(1)[0]
        following = lambda: self.value({"kind": "any"}, depth + 1)
        if kind <= 2:
            return [None, False, True][kind]
        if kind <= 4:
            return self.integer(64, signed=kind == 3)
        if kind == 5:
            return self.float(64)
        if kind == 6:
            return self.text()
        if kind == 7:
            return [following() for _ in range(self.count())]
        if kind == 8:
            return self.entries(following)
        raise Malformed("a kind that is not listed")


def decode(layout, data):
    """The value that the bytes are, as its JSON form is read by `json`."""
    return Reader(layout, data).whole()


class Robot:
    """A connection to a running robot."""

    def __init__(self, host="127.0.0.1", token=None):
        address = host if ":" in host else f"{host}:{PORT}"
        self.connecting = connect(f"ws://{address}/socket", max_size=LARGEST_MESSAGE, proxy=None)
        self.token = token
        self.next_id = 1
        # What came while an answer was awaited.
        self.waiting = deque()

    def __enter__(self):
        self.socket = self.connecting.__enter__()
        self.welcome = self.hear()["welcome"]
        if self.welcome["version"] != VERSION:
            raise Refused(f"the robot speaks version {self.welcome['version']}, this program {VERSION}")
        if self.token:
            self.ask("authenticate", token=self.token)
        return self

    def __exit__(self, *_):
        self.socket.close()

    def hear(self):
        """The robot's next message; a binary frame is an `update` like any other."""
        data = self.socket.recv(timeout=None)
        if isinstance(data, str):
            return json.loads(data)
        magic, number, cycle, time = struct.unpack_from("<4sIQQ", data)
        if magic != b"HKG1":
            raise Malformed("this is no frame of a robot")
        return {"update": {"subscription": number, "cycle": cycle, "time": time, "bytes": data[24:]}}

    def ask(self, what, **arguments):
        """Asks and waits for the answer."""
        number = self.next_id
        self.next_id += 1
        self.socket.send(json.dumps({"id": number, "ask": {what: arguments}}))
        while True:
            message = self.hear()
            answer = message.get("answer")
            if answer is None:
                self.waiting.append(message)
            elif "error" in answer and answer["id"] in (number, None):
                failure = answer["error"]
                # The message says in one line what is wrong with each.
                lines = [": ".join(filter(None, (one["path"], one["message"]))) for one in failure.get("refusals", [])]
                raise Refused("\n".join(lines) or failure["message"])
            elif answer["id"] == number:
                (good,) = answer["ok"].values()
                return good

    def paths(self, below="", depth=1):
        return self.ask("paths", below=below, depth=depth)

    def read(self, path):
        return Sample(**self.ask("read", path=path))

    def subscribe(self, path, rate=None, binary=False):
        """Values of a path, again and again."""
        encoding = "binary" if binary else "json"
        good = self.ask("subscribe", path=path, encoding=encoding, **({"rate": rate} if rate else {}))
        number, layout = good["subscription"], good.get("layout")
        while True:
            message = self.waiting.popleft() if self.waiting else self.hear()
            update = message.get("update", {})
            if update.get("subscription") != number:
                continue
            value = decode(layout, update["bytes"]) if "bytes" in update else update["value"]
            yield Sample(update["cycle"], update["time"], value)

    def parameters(self, path=""):
        return self.ask("parameters", path=path)["value"]

    def write(self, changes):
        """Changes parameters, all of them or none; the version that has them."""
        changes = [{"path": path, "value": value} for path, value in changes.items()]
        return self.ask("write", changes=changes)["version"]


def sparkline(values):
    """Numbers as a line of blocks, from the lowest to the highest."""
    numbers = [value for value in values if value is not None]
    if not numbers:
        return "(no numbers)"
    low, high = min(numbers), max(numbers)
    step = (high - low) / 7 or 1
    blocks = "".join(" " if value is None else "▁▂▃▄▅▆▇█"[int((value - low) / step)] for value in values)
    return f"{low:.6g} {blocks} {high:.6g}"


def number_of(value):
    return float(value) if isinstance(value, (bool, int, float)) else None


def plot(robot, arguments):
    samples = []
    for sample in robot.subscribe(arguments.path, binary=arguments.binary):
        samples.append((sample.time / 1e9, number_of(sample.value)))
        if samples[-1][0] - samples[0][0] >= arguments.seconds:
            break
    if arguments.csv:
        print("time,value")
        for time, value in samples:
            print(f"{time:.9f},{'' if value is None else repr(value)}")
        return
    if arguments.window:
        from matplotlib import pyplot

        pyplot.plot(*zip(*samples))
        pyplot.xlabel("s")
        pyplot.title(arguments.path)
        pyplot.show()
        return
    # As many as a terminal is wide.
    every = max(1, len(samples) // 72)
    print(sparkline([value for _, value in samples[::every]]))


def parse_change(text):
    path, equals, value = text.partition("=")
    if not equals:
        raise SystemExit(f"`{text}` is not PATH=VALUE")
    try:
        return path, json.loads(value)
    except ValueError:
        return path, value


def parse_arguments():
    parser = argparse.ArgumentParser(description="Asks a running robot.")
    parser.add_argument("--host", default="127.0.0.1", help="ADDRESS or ADDRESS:PORT")
    parser.add_argument("--token", default=os.environ.get("HULKGEN_TOKEN"))
    commands = parser.add_subparsers(dest="command", required=True)
    listing = commands.add_parser("list", help="paths with their types")
    listing.add_argument("path", nargs="?", default="")
    listing.add_argument("--depth", type=int, default=3)
    echoing = commands.add_parser("echo", help="a value again and again, one JSON object a line")
    echoing.add_argument("path")
    echoing.add_argument("--rate", type=float)
    echoing.add_argument("--count", type=int)
    echoing.add_argument("--binary", action="store_true", help="let the robot send bytes")
    plotting = commands.add_parser("plot", help="a number over time")
    plotting.add_argument("path")
    plotting.add_argument("--seconds", type=float, default=5.0)
    plotting.add_argument("--csv", action="store_true")
    plotting.add_argument("--window", action="store_true", help="with matplotlib")
    plotting.add_argument("--binary", action="store_true", help="let the robot send bytes")
    getting = commands.add_parser("get", help="parameters")
    getting.add_argument("path", nargs="?", default="")
    setting = commands.add_parser("set", help="parameters, all of them or none")
    setting.add_argument("changes", nargs="+", metavar="PATH=VALUE")
    return parser.parse_args()


def run(robot, arguments):
    if arguments.command == "list":
        for entry in robot.paths(arguments.path, arguments.depth):
            print(entry["path"], entry.get("type", ""), sep="\t")
    elif arguments.command == "echo":
        samples = robot.subscribe(arguments.path, arguments.rate, arguments.binary)
        for number, sample in enumerate(samples, 1):
            print(json.dumps(sample._asdict()), flush=True)
            if number == arguments.count:
                break
    elif arguments.command == "plot":
        plot(robot, arguments)
    elif arguments.command == "get":
        print(json.dumps(robot.parameters(arguments.path), indent=2))
    elif arguments.command == "set":
        version = robot.write(dict(parse_change(change) for change in arguments.changes))
        print(f"version {version}")


def main():
    arguments = parse_arguments()
    try:
        with Robot(arguments.host, arguments.token) as robot:
            run(robot, arguments)
    except (Refused, Malformed) as error:
        raise SystemExit(f"error: {error}") from error
    except BrokenPipeError:
        # Whoever reads our output (`| head`) has what it wanted.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, WebSocketException) as error:
        raise SystemExit(f"error: no robot answers at {arguments.host}: {error}") from error
    except KeyboardInterrupt:
        raise SystemExit(130) from None


if __name__ == "__main__":
    main()
