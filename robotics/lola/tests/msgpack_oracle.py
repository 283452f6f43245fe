"""Decodes a state and a command of ours with PyPI's `msgpack` and compares them with `nao.toml`.

Usage: msgpack_oracle.py NAO_TOML STATE COMMAND
Exit status: 0 they agree, 1 they do not, 77 Python or `msgpack` is too old or missing.
"""

import sys

try:
    import msgpack
    import tomllib
except ImportError as error:
    print(error, file=sys.stderr)
    sys.exit(77)


def check(name, bytes_, size, entries):
    if len(bytes_) != size:
        sys.exit(f"{name}: {len(bytes_)} bytes instead of {size}")
    message = msgpack.unpackb(bytes_, strict_map_key=True)
    keys = list(message)
    expected = [entry["key"] for entry in entries]
    if keys != expected:
        sys.exit(f"{name}: keys {keys} instead of {expected}")
    for entry in entries:
        values = message[entry["key"]]
        if len(values) != entry["values"]:
            sys.exit(f"{name}: {entry['key']} has {len(values)} values instead of {entry['values']}")
    # Python's own encoder must come to the same bytes, with floats in single precision.
    if msgpack.packb(message, use_single_float=True) != bytes_:
        sys.exit(f"{name}: Python writes other bytes")
    return message


def main():
    nao, state, command = sys.argv[1:]
    with open(nao, "rb") as file:
        lola = tomllib.load(file)["lola"]
    with open(state, "rb") as file:
        message = check("state", file.read(), lola["state_packet_bytes"], lola["state"])
    if message["Accelerometer"][2] >= 0:
        sys.exit("state: the acceleration of an upright robot must be negative on the wire")
    with open(command, "rb") as file:
        message = check("command", file.read(), lola["command_packet_bytes"], lola["command"])
    if not all(isinstance(value, bool) for value in message["Sonar"]):
        sys.exit("command: sonars are switched by booleans")
    print("state and command agree with nao.toml")


main()
