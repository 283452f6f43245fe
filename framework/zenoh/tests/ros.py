"""A machine of ROS 2 beside the zoo, as far as that is Zenoh: it sees the graph as rmw_zenoh does, reads and writes messages
by their .msg files, and calls services.

`ros.py ENDPOINT PACKAGES`. Says on stdout how far it is and `waits` until what was announced is gone; ends with 0 if all is as
it should be.
"""

import struct
import sys
import threading
import time
from pathlib import Path

import xxhash
import zenoh
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from elsewhere import PATIENCE, TOO_LONG, connected, until

NOTHING = "uint8 structure_needs_at_least_one_member\n"
KINDS = {"NN": 9, "MP": 13, "MS": 13, "SS": 13, "SC": 13}
FLOAT = "std_msgs/msg/Float32"


class Graph:
    """What rmw_zenoh's graph cache holds of tokens."""

    def __init__(self, session):
        self.tokens = {}
        self.lock = threading.Lock()
        self.subscriber = session.liveliness().declare_subscriber("@ros2_lv/0/**", self.hear, history=True)

    def hear(self, sample):
        token = str(sample.key_expr)
        with self.lock:
            if sample.kind == zenoh.SampleKind.DELETE:
                self.tokens.pop(token, None)
            else:
                self.tokens[token] = parse(token)

    def find(self, kind, name=None):
        with self.lock:
            entities = list(self.tokens.values())
        return [one for one in entities if one["kind"] == kind and name in (None, one.get("name"))]


def parse(token):
    """By the rules of rmw_zenoh's liveliness_utils; what it would refuse is refused."""
    parts = token.split("/")
    assert all(parts), token
    admin, domain, session, node_id, entity_id, kind, enclave, namespace, node = parts[:9]
    assert (admin, enclave, namespace) == ("@ros2_lv", "%", "%"), token
    assert len(parts) == KINDS[kind], token
    entity = dict(token=token, kind=kind, domain=int(domain), session=session, node_id=int(node_id), id=int(entity_id), node=node)
    if kind == "NN":
        assert node_id == entity_id, token
        return entity
    name, type_name, type_hash, qos = parts[9:]
    reliability, durability, history, deadline, lifespan, liveliness = qos.split(":")
    assert reliability in ("", "1") and durability in ("", "2"), qos
    assert [len(one.split(",")) for one in (history, deadline, lifespan, liveliness)] == [2, 2, 2, 3], qos
    assert history.split(",")[0] in ("", "1") and int(history.split(",")[1]) > 0, qos
    return entity | dict(name=name.replace("%", "/"), type=type_name, hash=type_hash)


def gid(token):
    """XXH3 of 128 bits, the lower half first."""
    return xxhash.xxh3_128(token.encode()).digest()[::-1]


def key_of(entity):
    return f"{entity['domain']}/{entity['name'][1:]}/{entity['type']}/{entity['hash']}"


def type_of(entity):
    return entity["type"].replace("::dds_::", "/").replace("::", "/").removesuffix("_")


def types(packages):
    store = get_typestore(Stores.ROS2_JAZZY)
    known = {}
    for file in sorted(packages.glob("*/msg/*.msg")):
        known.update(get_types_from_msg(file.read_text() or NOTHING, f"{file.parent.parent.name}/msg/{file.stem}"))
    for file in sorted(packages.glob("*/srv/*.srv")):
        request, response = file.read_text().split("---\n")
        for text, part in [(request, "Request"), (response, "Response")]:
            name = f"{file.parent.parent.name}/msg/{file.stem}_{part}"
            known.update(get_types_from_msg(text or NOTHING, name))
    store.register(known)
    return store


def announced(graph):
    until("node", lambda: graph.find("NN"))
    until("five entities", lambda: len(graph.tokens) >= 6)
    time.sleep(0.5)
    [node] = graph.find("NN")
    assert node["node"] == "zoo", node
    found = sorted((one["kind"], one["name"], type_of(one)) for one in graph.tokens.values() if one["kind"] != "NN")
    assert found == [
        ("MP", "/pose", "zoo_interfaces/msg/Pose"),
        ("MP", "/walking_speed", FLOAT),
        ("MS", "/walking_speed", FLOAT),
        ("SS", "/stop", "zoo_interfaces/srv/Stop"),
        ("SS", "/walk", "zoo_interfaces/srv/Walk"),
    ], found
    ids = [one["id"] for one in graph.tokens.values()]
    assert len(set(ids)) == len(ids), ids
    assert {one["session"] for one in graph.tokens.values()} == {node["session"]}
    assert {one["node_id"] for one in graph.tokens.values()} == {node["id"]}
    print(f"sees the node {node['node']} with {len(found)} entities")


def heard(session, key):
    samples = []
    subscriber = session.declare_subscriber(key, samples.append)
    return samples, subscriber


def topics(session, graph, store):
    [pose] = graph.find("MP", "/pose")
    assert store.hash_rihs01("zoo_interfaces/msg/Pose") == pose["hash"]
    samples, _subscriber = heard(session, key_of(pose))
    until("poses", lambda: len(samples) > 20)
    for sample in list(samples):
        cdr, beside = sample.payload.to_bytes(), sample.attachment.to_bytes()
        message = store.deserialize_cdr(cdr, "zoo_interfaces/msg/Pose")
        assert bytes(store.serialize_cdr(message, "zoo_interfaces/msg/Pose")) == cdr
        assert len(message.position) <= 1
        assert beside[16:] == b"\x10" + gid(pose["token"]), "rmw_zenoh would take it for somebody else's"
    print(f"hears {len(samples)} poses of their publisher")


def parameters(session, graph, store):
    [speed] = graph.find("MS", "/walking_speed")
    [publisher] = graph.find("MP", "/walking_speed")
    assert store.hash_rihs01(FLOAT) == speed["hash"]
    key = key_of(speed)
    float32 = store.types[FLOAT]
    cdr = lambda value: bytes(store.serialize_cdr(float32(data=value), FLOAT))
    value_of = lambda one: round(store.deserialize_cdr(one.payload.to_bytes(), FLOAT).data, 4)
    samples, _subscriber = heard(session, key)
    # What is put here comes back here as well, but not from the bridge.
    told = lambda: [value_of(one) for one in list(samples) if one.attachment and one.attachment.to_bytes()[17:] == gid(publisher["token"])]
    for value in (0.375, 0.25):
        session.put(key, cdr(value))
        until(f"walking speed of {value}", lambda: told()[-1:] == [value])
    for nonsense in [b"", b"\x00", b"\x00\x01\x00\x00", b"\x00\x01\x00\x00\x00\x00", b"0.5", cdr(float("nan")), 20 * cdr(0.5), TOO_LONG]:
        session.put(key, nonsense)
    ask = lambda payload: next(iter(session.get(key, payload=payload, timeout=PATIENCE)))
    until("answer", lambda: ask(None).ok)
    assert value_of(ask(None).ok) == 0.25
    assert value_of(ask(cdr(0.5)).ok) == 0.5
    for nonsense, word in [(b"0.5", "too short"), (b"\x00\x07\x00\x00\x00\x00\x00\x00", "XCDR1"), (cdr(float("inf")), "inf")]:
        words = ask(nonsense).err.payload.to_string()
        assert word in words, words
    until("walking speed of 0.5", lambda: told()[-1:] == [0.5])
    assert all(one != other for one, other in zip(told(), told()[1:])), f"said twice: {told()}"
    ask(cdr(0.2))
    print(f"writes parameters and hears them: {told()}")


def services(session, graph, store):
    client = bytes(range(16))

    def call(name, payload, number):
        [service] = graph.find("SS", name)
        beside = struct.pack("<qq", number, time.time_ns()) + b"\x10" + client
        target = zenoh.QueryTarget.ALL_COMPLETE
        replies = session.get(
            key_of(service), payload=payload, attachment=beside, target=target,
            consolidation=zenoh.ConsolidationMode.NONE, timeout=PATIENCE,
        )
        [reply] = list(replies)
        return reply

    walk = "zoo_interfaces/msg/Walk_Request", "zoo_interfaces/msg/Walk_Response"
    request = store.serialize_cdr(store.types[walk[0]](speed=0.5), walk[0])
    for number in (1, 2):
        reply = call("/walk", bytes(request), number).ok
        response = store.deserialize_cdr(reply.payload.to_bytes(), walk[1])
        assert response.data == 0.5, response
        echoed, made, length = struct.unpack("<qqB", reply.attachment.to_bytes()[:17])
        assert (echoed, length, reply.attachment.to_bytes()[17:]) == (number, 16, client)
        assert abs(made / 1e9 - time.time()) < PATIENCE
    for name, payload, word in [
        ("/walk", b"\x00\x01\x00\x00\x00", "speed"),
        ("/walk", None, "payload"),
        ("/stop", b"\x00\x01\x00\x00\x00", "never stops"),
    ]:
        words = call(name, payload, 3).err.payload.to_string()
        assert word in words, words
    print("calls services")


def main():
    endpoint, packages = sys.argv[1:]
    store = types(Path(packages))
    with connected(endpoint) as session:
        graph = Graph(session)
        announced(graph)
        topics(session, graph, store)
        parameters(session, graph, store)
        services(session, graph, store)
        print("waits", flush=True)
        until("end of what was announced", lambda: not graph.tokens)


main()
