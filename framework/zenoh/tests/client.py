"""A machine beside the zoo: it knows Zenoh and CDR, and nothing of hulkgen.

`client.py ENDPOINT WHAT`, where WHAT is `exchanges` or `misses`. Says on stdout how far it is, and ends with 0 if all is as
it should be.
"""

import json
import struct
import sys
import time
from dataclasses import dataclass

from pycdr2 import IdlStruct
from pycdr2.types import float32, sequence

from elsewhere import PATIENCE, TOO_LONG, connected, until

CDR_POSE = "0/pose/zoo_interfaces::msg::dds_::Pose_/RIHS01_108fca19f7ddc277ebcdac53b06adc40f9f3b79d3ec561a55dbb5a5626bda426"


@dataclass
class Point(IdlStruct, typename="Point"):
    x: float32
    y: float32


@dataclass
class Pose(IdlStruct, typename="Pose"):
    position: sequence[Point, 1]
    heading: float32


class Listener:
    """Samples of a key as they come: payload, attachment, encoding."""

    def __init__(self, session, key):
        self.heard = []
        self.subscriber = session.declare_subscriber(key, self.hear)

    def hear(self, sample):
        # What this client puts itself comes back to it as well, but without what the bridge puts beside it.
        if sample.attachment:
            attachment = sample.attachment.to_bytes()
            self.heard.append((sample.payload.to_bytes(), attachment, str(sample.encoding)))

    def values(self):
        """By cycle, of JSON."""
        return {json.loads(beside)["cycle"]: json.loads(value) for value, beside, _ in list(self.heard)}


def ask(session, key, payload=None):
    """The reply to a query: true and its JSON, or false and the words of the error."""

    def reply():
        for one in session.get(key, payload=payload, timeout=PATIENCE):
            if one.ok:
                return True, json.loads(one.ok.payload.to_bytes())
            return False, one.err.payload.to_bytes().decode()
        return None

    return until(f"answer from {key}", reply)


def outputs(session):
    speeds = Listener(session, "zoo/speed")
    until("50 values of zoo/speed", lambda: len(speeds.heard) >= 50)
    beside = [json.loads(attachment) for _, attachment, _ in speeds.heard]
    cycles = [one["cycle"] for one in beside]
    times = [one["time"] for one in beside]
    assert cycles == sorted(set(cycles)), f"not in order: {cycles}"
    assert times == sorted(set(times)), f"not in order: {times}"
    assert all(encoding == "application/json" for _, _, encoding in speeds.heard)
    spots = Listener(session, "zoo/spots")
    until("value of zoo/spots", lambda: spots.heard)
    print(f"{len(cycles)} speeds in order of {cycles[-1] - cycles[0] + 1} cycles")


def cdr(session):
    """The same poses as text and as CDR, which a reader from PyPI understands."""
    as_text, as_cdr = Listener(session, "zoo/pose"), Listener(session, CDR_POSE)
    until("poses", lambda: len(as_cdr.heard) >= 50 and len(as_text.heard) >= 50)
    texts, compared, present = as_text.values(), 0, 0
    for value, beside, encoding in list(as_cdr.heard):
        assert encoding == "application/cdr", encoding
        assert len(beside) == 33 and beside[16] == 16, beside
        cycle, made = struct.unpack("<qq", beside[:16])
        assert abs(made / 1e9 - time.time()) < PATIENCE, "made at another time"
        pose = Pose.deserialize(value)
        # The reader and the bridge agree about every byte, padding included.
        assert pose.serialize() == value, (pose, value)
        if cycle not in texts:
            continue
        text = texts[cycle]
        position = [] if text["position"] is None else [text["position"]]
        assert [(p.x, p.y) for p in pose.position] == [
            struct.unpack("<ff", struct.pack("<ff", p["x"], p["y"])) for p in position
        ], (pose, text)
        assert pose.heading == struct.unpack("<f", struct.pack("<f", text["heading"]))[0]
        compared += 1
        present += len(position)
    assert compared > 10, "nothing compared"
    print(f"{compared} poses are the same in both forms, {present} with a position")


def parameters(session):
    speeds = Listener(session, "zoo/walking_speed")
    first = ask(session, "zoo/walking_speed")
    assert first[0] and abs(first[1] - 0.2) < 1e-6, first
    heard = lambda value: lambda: any(abs(json.loads(one[0]) - value) < 1e-6 for one in list(speeds.heard))
    session.put("zoo/walking_speed", "0.35")
    until("walking speed of 0.35", heard(0.35))
    # Values that are none change nothing, and the bridge goes on.
    for nonsense in ["", "{", '"fast"', "[" * 5000, b"\xff\xfe", TOO_LONG]:
        session.put("zoo/walking_speed", nonsense)
    # More than the bridge awaits answers, and deeper than the robot reads.
    for _ in range(70):
        session.put("zoo/walking_speed", 100 * "[" + 100 * "]")
    assert ask(session, "zoo/walking_speed", "0.45") == (True, 0.45), "written by a query"
    until("walking speed of 0.45", heard(0.45))
    for nonsense, word in [("{", "no JSON"), ('"fast"', "walking_speed"), (TOO_LONG, "at most")]:
        is_good, words = ask(session, "zoo/walking_speed", nonsense)
        assert not is_good and (word in words or "number" in words or "f32" in words), (nonsense[:20], words)
    assert ask(session, "zoo/walking_speed") == (True, 0.45)
    assert ask(session, "zoo/spot_finder")[1]["brightest"] == 3
    is_good, words = ask(session, "zoo/spot_finder", "{}")
    assert not is_good and "goes out alone" in words, words
    for _ in range(5):
        assert ask(session, "zoo/walking_speed", "0.45") == (True, 0.45)
    values = [value for value, _, _ in list(speeds.heard)]
    assert all(one != next_one for one, next_one in zip(values, values[1:])), f"said twice: {values}"
    ask(session, "zoo/walking_speed", "0.2")
    print("parameters go out and come in")


def procedures(session):
    assert ask(session, "zoo/walk", '{"speed": 0.5}') == (True, 0.5), "walk"
    is_good, words = ask(session, "zoo/stop", "null")
    assert not is_good and "never stops" in words, words
    is_good, words = ask(session, "zoo/walk", '{"sped": 1}')
    assert not is_good, words
    print("procedures answer and refuse")


def exchanges(session):
    outputs(session)
    cdr(session)
    parameters(session)
    procedures(session)


def misses(session):
    """The robot goes and comes back, then the bridge."""
    walk = '{"speed": 0.5}'
    for _ in range(2):
        until("walk", lambda: ask(session, "zoo/walk", walk)[0])
        speeds = Listener(session, "zoo/speed")
        until("values of zoo/speed", lambda: len(speeds.heard) >= 5)
        print("hears", flush=True)
        # Whoever starts this takes the robot, or the bridge, away now and says so.
        sys.stdin.readline()
        speeds.subscriber.undeclare()
        reply = next((one for one in session.get("zoo/walk", payload=walk, timeout=5)), None)
        assert reply is None or not reply.ok, "a robot that is gone walks"
        words = reply.err.payload.to_bytes().decode() if reply else "nobody answers"
        print(f"misses: {words}", flush=True)
    until("walk", lambda: ask(session, "zoo/walk", walk)[0])
    print("hears again")


def main():
    endpoint, what = sys.argv[1:]
    with connected(endpoint) as session:
        {"exchanges": exchanges, "misses": misses}[what](session)


main()
