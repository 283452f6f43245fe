"""The machine that runs the lookouts of an outpost: it knows Zenoh, and nothing of hulkgen.

`lookouts.py ENDPOINT`. Says on stdout how far it is, and ends with 0 if all is as it should be.
"""

import json
import sys
import time

import zenoh

from elsewhere import TOO_LONG, connected, until

ROUNDS = 12


class Outpost:
    def __init__(self, session):
        self.session = session
        self.entries = None
        self.subscriber = session.declare_subscriber("outpost/entries", self.hear)

    def hear(self, sample):
        self.entries = json.loads(sample.payload.to_bytes())

    def say(self, lookout, **said):
        self.put(lookout, json.dumps(said))

    def put(self, lookout, payload):
        # Who waits for a busy network loses nothing at this end of it.
        block = zenoh.CongestionControl.BLOCK
        self.session.put(f"outpost/{lookout}", payload, congestion_control=block)

    def complete(self, lookout, seen, number):
        outputs = {"ship": {"number": number, "distance": 120.5}}
        self.say(lookout, complete={"time": seen, "outputs": outputs})


def nonsense(outpost):
    """Nothing of this is written down, and all that comes later is."""
    now = time.time_ns()
    wrong = {"ship": {"number": "one", "distance": 1}}
    for payload in [
        "", "{", '"ship"', b"\xff\xfe", "[" * 5000, TOO_LONG, "null", "{}",
        json.dumps({"announce": {"time": -1}}),
        json.dumps({"announce": {"time": 5}}),
        json.dumps({"announce": {"time": now + 3600 * 10**9}}),
        json.dumps({"complete": {"time": now, "outputs": wrong}}),
        json.dumps({"complete": {"time": now, "outputs": []}}),
        json.dumps({"abandon": {"time": now}}),
    ]:
        outpost.put("north", payload)


def ships(outpost):
    """Each round the north sees a ship first and is done last; sometimes what it says gets lost, or it sees none."""
    written = lambda: [entry["number"] for entry in outpost.entries]
    first = time.time_ns()
    outpost.complete("south", first, 999)
    # What was put before takes its time on a narrow cable.
    until("first ship in the book", lambda: 999 in written())
    expected = [(first, 999)]
    for turn in range(ROUNDS):
        first = time.time_ns()
        outpost.say("north", announce={"time": first})
        time.sleep(0.02)
        second = time.time_ns()
        outpost.say("south", announce={"time": second})
        time.sleep(0.02)
        outpost.complete("south", second, 2 * turn + 1)
        time.sleep(0.05)
        if turn % 4 == 1:
            outpost.say("north", abandon={"time": first})
        elif turn % 4 != 3:
            outpost.complete("north", first, 2 * turn)
            expected.append((first, 2 * turn))
        expected.append((second, 2 * turn + 1))
        time.sleep(0.05)
    # Nobody waits any more for the one that got lost; nobody waited for this one.
    last = time.time_ns()
    outpost.complete("north", last, 1000)
    expected.append((last, 1000))
    numbers = [number for _, number in expected]
    until("last ship in the book", lambda: 1000 in written())
    assert written() == numbers, f"{written()} is not {numbers}"
    shifts = {seen - entry["time"] for (seen, _), entry in zip(expected, outpost.entries)}
    assert len(shifts) == 1, f"times were changed: {shifts}"
    print(f"{len(numbers)} ships in order of the times at which they were seen")


def main():
    with connected(sys.argv[1]) as session:
        outpost = Outpost(session)
        until("book", lambda: outpost.entries is not None)
        nonsense(outpost)
        ships(outpost)


main()
