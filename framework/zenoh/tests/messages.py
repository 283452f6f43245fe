"""A reader of ROS 2's messages: do .msg files say what the bytes are, and have they the hashes that were told?

`messages.py FOLDER`, where FOLDER holds packages; cases come as JSON on stdin.
"""

import json
import sys
from pathlib import Path

import numpy
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

NOTHING = "uint8 structure_needs_at_least_one_member\n"


def types(folder):
    known = {}
    for file in sorted(folder.glob("*/msg/*.msg")):
        name = f"{file.parent.parent.name}/msg/{file.stem}"
        # rosidl adds this itself.
        text = file.read_text()
        known.update(get_types_from_msg(text if text.strip() else NOTHING, name))
    return known


def leaves(value):
    if isinstance(value, numpy.ndarray):
        return value.tolist()
    if isinstance(value, list):
        return [leaf for item in value for leaf in leaves(item)]
    if hasattr(value, "__msgtype__"):
        fields = [name for name in value.__dataclass_fields__ if name not in ("__msgtype__",)]
        fields = [name for name in fields if not name.isupper() and name != NOTHING.split()[1]]
        return [leaf for name in fields for leaf in leaves(getattr(value, name))]
    return [value]


def main():
    folder = Path(sys.argv[1])
    store = get_typestore(Stores.EMPTY)
    store.register(types(folder))
    cases = json.load(sys.stdin)
    for case in cases:
        name, cdr = case["type"], bytes.fromhex(case["cdr"])
        hashed = store.hash_rihs01(name)
        assert hashed == case["hash"], f"{name}: {hashed} is not {case['hash']}"
        message = store.deserialize_cdr(cdr, name)
        again = bytes(store.serialize_cdr(message, name))
        assert again == cdr, f"{name}: {again.hex()} is not {cdr.hex()}: {case['value']}"
        assert leaves(message) == case["leaves"], f"{name}: {leaves(message)} is not {case['leaves']}"
    for file in folder.glob("*/CMakeLists.txt"):
        listed = [line.strip(' "') for line in file.read_text().splitlines() if ".msg" in line]
        files = sorted(f"msg/{one.name}" for one in file.parent.glob("msg/*.msg"))
        assert listed == files, f"{file} lists {listed}"
    print(f"{len(cases)} messages")


main()
