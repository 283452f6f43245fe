"""Reads outputs that have a form of Foxglove's out of a recording, with the package `mcap`, and what the form asks for.

Each message is validated against the schema beside it, which must refuse what the form refuses. Prints, by topic, the schema's
name and how many messages there are.
"""

import base64
import json
import sys

import jsonschema
from mcap.reader import make_reader

# Fields of https://github.com/foxglove/foxglove-sdk/tree/main/schemas/jsonschema, as far as they must be there.
FIELDS = {
    "foxglove.RawImage": ["timestamp", "frame_id", "width", "height", "encoding", "step", "data"],
    "foxglove.FrameTransforms": ["transforms"],
    "foxglove.JointStates": ["timestamp", "joints"],
    "foxglove.Log": ["timestamp", "level", "message", "name", "file", "line"],
}


def is_time(time):
    return time["sec"] >= 0 and 0 <= time["nsec"] < 1_000_000_000


def look_at_image(image):
    assert is_time(image["timestamp"])
    assert image["encoding"] == "yuyv" and image["step"] == 2 * image["width"], image["encoding"]
    data = base64.b64decode(image["data"], validate=True)
    assert len(data) == image["step"] * image["height"] > 0
    assert len(set(data)) > 10, "nothing is seen"


def look_at_transforms(message):
    assert message["transforms"]
    for one in message["transforms"]:
        assert is_time(one["timestamp"]) and one["parent_frame_id"] and one["child_frame_id"]
        assert set(one["translation"]) == set("xyz")
        assert abs(sum(one["rotation"][axis] ** 2 for axis in "xyzw") - 1) < 1e-3, one


def look_at_joints(message):
    assert is_time(message["timestamp"])
    names = [joint["name"] for joint in message["joints"]]
    assert names and len(set(names)) == len(names), names
    assert all(isinstance(joint["position"], float) for joint in message["joints"])


def look_at_log(message):
    assert is_time(message["timestamp"]) and message["message"] and message["level"] in range(1, 6)


LOOK = {
    "foxglove.RawImage": look_at_image,
    "foxglove.FrameTransforms": look_at_transforms,
    "foxglove.JointStates": look_at_joints,
    "foxglove.Log": look_at_log,
}


def validator(schema):
    """Of the schema beside the messages, which knows the fields of the form."""
    text = json.loads(schema.data)
    assert text["$schema"] == "http://json-schema.org/draft-07/schema#", schema.name
    jsonschema.Draft7Validator.check_schema(text)
    assert set(FIELDS[schema.name]) <= set(text["properties"]), schema.name
    return jsonschema.Draft7Validator(text)


with open(sys.argv[1], "rb") as file:
    reader = make_reader(file, validate_crcs=True)
    validators, told = {}, {}
    for schema, channel, message in reader.iter_messages():
        if channel.message_encoding != "json":
            continue
        assert schema.encoding == "jsonschema"
        value = json.loads(message.data)
        if channel.topic not in told:
            told[channel.topic] = {"schema": schema.name, "messages": 0}
            validators[channel.topic] = validator(schema)
            # No field of any form is a truth, and a schema that says nothing would take one.
            for field in FIELDS[schema.name]:
                assert not validators[channel.topic].is_valid({**value, field: True}), field
        validators[channel.topic].validate(value)
        LOOK[schema.name](value)
        told[channel.topic]["messages"] += 1
    print(json.dumps(told))
