"""Reads a recording with the package `mcap`, all check sums, and decodes what is JSON by its schema: counts by topic."""

import json
import sys

import jsonschema
from mcap.reader import make_reader

with open(sys.argv[1], "rb") as file:
    reader = make_reader(file, validate_crcs=True)
    counts = {channel.topic: 0 for channel in reader.get_summary().channels.values()}
    for schema, channel, message in reader.iter_messages():
        counts[channel.topic] += 1
        if channel.message_encoding == "json":
            assert schema.encoding == "jsonschema"
            jsonschema.validate(
                json.loads(message.data), json.loads(schema.data), jsonschema.Draft7Validator
            )
    print(json.dumps(counts))
