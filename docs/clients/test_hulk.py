"""Compares what hulk.py reads with what the reference read: `test_hulk.py CORPUS`. Used by a test of the framework."""

import json
import struct
import sys

sys.dont_write_bytecode = True
import hulk


def difference(one, other, path=""):
    """Where they are not the same."""
    for below, (left, right) in parts(one, other):
        if not same(left, right):
            return difference(left, right, f"{path}.{below}")
    return f"{path}: {one!r} is not {other!r}"


def parts(one, other):
    if isinstance(one, dict) and isinstance(other, dict) and one.keys() == other.keys():
        return [(key, (one[key], other[key])) for key in one]
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        return list(enumerate(zip(one, other)))
    return []


def same(one, other):
    """As JSON; numbers of 32 bits are written with fewer digits than they have as 64."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, float) or isinstance(other, float):
        numbers = all(isinstance(number, (int, float)) and not isinstance(number, bool) for number in (one, other))
        return numbers and (one == other or single(one) == single(other))
    return type(one) is type(other) and one == other


def single(number):
    try:
        return struct.pack("<f", number)
    except OverflowError:
        return number


count = 0
with open(sys.argv[1], encoding="utf-8") as corpus:
    for line in corpus:
        case = json.loads(line)
        try:
            read = hulk.decode(case["layout"], bytes.fromhex(case["bytes"]))
            assert "value" in case, f"it reads what the reference refuses: {line}"
            assert same(read, case["value"]), difference(read, case["value"])
        except hulk.Malformed as error:
            assert "value" not in case, f"it refuses what the reference reads: {error}: {line}"
        count += 1
print(f"{count} read")
