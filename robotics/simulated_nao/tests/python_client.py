"""A client of LoLA that shares no code with ours: reads states, sends commands, sees joints move.

Usage: python_client.py SOCKET. Exit status 77: the package msgpack is not installed.
"""

import socket
import sys

try:
    import msgpack
except ImportError:
    sys.exit(77)

STATE_BYTES = 896
LENGTHS = {
    "RobotConfig": 4,
    "Accelerometer": 3,
    "Angles": 2,
    "Battery": 4,
    "Current": 25,
    "FSR": 8,
    "Gyroscope": 3,
    "Position": 25,
    "Sonar": 2,
    "Stiffness": 25,
    "Temperature": 25,
    "Touch": 14,
    "Status": 25,
}
CYCLE = 0.012
HEAD_YAW_VELOCITY = 8.26797


def read_state(connection):
    received = b""
    while len(received) < STATE_BYTES:
        part = connection.recv(STATE_BYTES - len(received))
        assert part, "LoLA closed the connection"
        received += part
    state = msgpack.unpackb(received)
    lengths = {key: len(values) for key, values in state.items()}
    assert lengths == LENGTHS, lengths
    return state


def main():
    connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    connection.settimeout(5)
    connection.connect(sys.argv[1])

    state = read_state(connection)
    assert len(state["RobotConfig"][0]) == 20, state["RobotConfig"]
    assert -10.0 < state["Accelerometer"][2] < -9.0, state["Accelerometer"]
    assert 5.2 < sum(state["FSR"]) < 5.5, state["FSR"]
    assert not any(state["Stiffness"]), state["Stiffness"]

    command = {"Position": list(state["Position"]), "Stiffness": [1] * 25, "Chest": [0.0, 1.0, 0.5]}
    command["Position"][0] = 0.5
    connection.sendall(b"\xc1 this is no command")
    connection.sendall(msgpack.packb(command))
    yaw = state["Position"][0]
    for _ in range(100):
        state = read_state(connection)
        moved = state["Position"][0] - yaw
        assert 0 <= moved <= HEAD_YAW_VELOCITY * CYCLE + 1e-4, moved
        yaw = state["Position"][0]
    assert abs(yaw - 0.5) < 1e-4, yaw
    assert state["Stiffness"] == [1.0] * 25, state["Stiffness"]

    # What a command leaves out stays as it was.
    connection.sendall(msgpack.packb({"Stiffness": [0.25] * 25}, use_single_float=True))
    for _ in range(5):
        state = read_state(connection)
    assert state["Stiffness"] == [0.25] * 25, state["Stiffness"]
    assert abs(state["Position"][0] - 0.5) < 1e-4


main()
