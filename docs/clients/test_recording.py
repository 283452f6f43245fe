"""Compares what recording.py reads with what the reference read: `test_recording.py CORPUS`. Used by a test of the framework."""

import json
import sys

sys.dont_write_bytecode = True
import recording

read, refused = 0, 0
with open(sys.argv[1], encoding="utf-8") as corpus:
    for line in corpus:
        case = json.loads(line)
        try:
            value = recording.to_json(recording.decode(case["layout"], bytes.fromhex(case["bytes"])))
            assert "value" in case, f"it reads what the reference refuses: {line}"
            # As texts: 1 is neither 1.0 nor true, and the order of fields is that of their bytes.
            assert json.dumps(value) == json.dumps(case["value"]), f"{value!r} is not what is in {line}"
            read += 1
        except recording.Malformed as error:
            assert "value" not in case, f"it refuses what the reference reads: {error}: {line}"
            refused += 1
print(f"{read + refused} read, {refused} refused")
