"""A client of Foxglove's protocol: does the handshake, lists channels, decodes messages, changes a parameter.
With `stay` it looks at one channel, and again when it is told to by a line.

usage: python3 client.py ws://127.0.0.1:8765 [stay]     (needs: websockets, jsonschema)
"""

import json
import struct
import sys
import time

import jsonschema
from websockets.sync.client import connect

SUBPROTOCOL = "foxglove.sdk.v1"
PATIENCE = 60


class Client:
    def __init__(self, url):
        self.socket = connect(url, subprotocols=[SUBPROTOCOL], max_size=None, open_timeout=PATIENCE)
        assert self.socket.subprotocol == SUBPROTOCOL, self.socket.subprotocol
        self.channels = {}
        self.end = time.monotonic() + PATIENCE

    def hear(self, is_wanted):
        """The next message that is wanted; channels are noted meanwhile."""
        while True:
            left = self.end - time.monotonic()
            assert left > 0, "it does not come"
            message = self.socket.recv(timeout=left)
            if isinstance(message, str):
                message = json.loads(message)
                if message["op"] == "advertise":
                    for channel in message["channels"]:
                        self.channels[channel["topic"]] = channel
            if is_wanted(message):
                return message

    def op(self, name):
        return self.hear(lambda message: isinstance(message, dict) and message["op"] == name)

    def send(self, op, **content):
        self.socket.send(json.dumps({"op": op, **content}))

    def watch(self, number, topic):
        self.send("subscribe", subscriptions=[{"id": number, "channelId": self.channels[topic]["id"]}])

    def next(self, number, count):
        """The next messages of a subscription, with their times in nanoseconds."""
        head = struct.Struct("<BIQ")
        found = []
        while len(found) < count:
            message = self.hear(lambda message: isinstance(message, bytes) and message[0] == 1)
            _, subscription, when = head.unpack_from(message)
            if subscription == number:
                found.append((when, message[head.size:]))
        return found

    def values(self, number, topic, count):
        """So many messages of a channel."""
        channel = self.channels[topic]
        self.watch(number, topic)
        found = self.next(number, count)
        self.send("unsubscribe", subscriptionIds=[number])
        times = [when for when, _ in found]
        assert times == sorted(set(times)), times
        assert abs(times[0] / 1e9 - time.time()) < 3600, times
        return channel, [value for _, value in found]

    def parameters(self, op, **content):
        self.send(op, id=op, **content)
        answer = self.hear(lambda m: isinstance(m, dict) and m["op"] == "parameterValues" and m.get("id") == op)
        return {parameter["name"]: parameter.get("value") for parameter in answer["parameters"]}


def fields(data):
    """The fields of a protobuf message whose values are numbers or have a length."""

    def number(at):
        value = shift = 0
        while True:
            value |= (data[at] & 0x7F) << shift
            at, shift = at + 1, shift + 7
            if data[at - 1] < 0x80:
                return value, at

    found, at = {}, 0
    while at < len(data):
        key, at = number(at)
        assert key & 7 in (0, 2), key
        value, at = number(at)
        if key & 7 == 2:
            value, at = data[at : at + value], at + value
        found[key >> 3] = value
    return found


IMAGE, NUMBERS = "/VisionTop/main_outputs/image", "/Control/main_outputs/sensor_data"


def connected():
    client = Client(sys.argv[1])
    info = client.op("serverInfo")
    assert "parameters" in info["capabilities"], info
    if NUMBERS not in client.channels:
        client.op("advertise")
    return client


def stay():
    client = connected()
    client.watch(1, NUMBERS)
    client.next(1, 3)
    print("watching", flush=True)
    sys.stdin.readline()
    client.end = time.monotonic() + PATIENCE
    # What was on its way when the robot went, and then what the next one says.
    client.next(1, 100)
    print("watched on")


def main():
    client = connected()
    client.end = time.monotonic() + PATIENCE
    for channel in client.channels.values():
        if channel["encoding"] == "json":
            schema = json.loads(channel["schema"])
            assert schema["type"] == "object", channel["topic"]
            jsonschema.Draft7Validator.check_schema(schema)
    json_topics = [topic for topic, channel in client.channels.items() if channel["encoding"] == "json"]
    assert len(json_topics) > 20, json_topics

    channel, values = client.values(1, NUMBERS, 5)
    for value in values:
        jsonschema.validate(json.loads(value), json.loads(channel["schema"]))
    others = [topic for topic in json_topics if list(json.loads(client.channels[topic]["schema"])["properties"]) == ["value"]]
    assert others, "no output that is no object"

    channel, values = client.values(2, IMAGE, 2)
    assert (channel["encoding"], channel["schemaName"]) == ("protobuf", "foxglove.CompressedImage"), channel
    picture = fields(values[0])
    assert picture[3] == b"jpeg" and picture[2][:3] == b"\xff\xd8\xff" and picture[2][-2:] == b"\xff\xd9"

    name = "ball_filter.gate"
    before = client.parameters("getParameters", parameterNames=[])
    assert len(before) > 20 and name in before, before
    wanted = before[name] + 0.5
    assert client.parameters("setParameters", parameters=[{"name": name, "value": wanted}]) == {name: wanted}
    assert client.parameters("getParameters", parameterNames=[name]) == {name: wanted}
    # What the robot refuses stays as it was.
    assert client.parameters("setParameters", parameters=[{"name": name, "value": "much"}]) == {name: wanted}
    print(f"{len(client.channels)} channels, {len(before)} parameters, an image of {len(picture[2])} bytes")


stay() if "stay" in sys.argv else main()
