"""What every machine beside a robot needs that knows Zenoh, and nothing of hulkgen."""

import json
import time

import zenoh

# A busy machine may take so long for anything.
PATIENCE = 90

# Longer than the bridge takes.
TOO_LONG = b"0" * 1_100_000


def until(what, condition):
    """What the condition gives once that is something."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.05)
    raise SystemExit(f"no {what} within {PATIENCE} s")


def connected(endpoint):
    """A session with the bridge there, and nobody else."""
    config = zenoh.Config()
    config.insert_json5("mode", '"client"')
    config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    config.insert_json5("connect/timeout_ms", str(PATIENCE * 1000))
    config.insert_json5("scouting/multicast/enabled", "false")
    return zenoh.open(config)
