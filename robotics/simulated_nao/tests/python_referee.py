"""A robot that shares no code with ours: reads control data with the published layout, answers.

Usage: python_referee.py RETURN_DATA TEAM_MESSAGE CONTROL_DATA, all in hex: what the robot's own nodes
sent, and control data with a value of its own in every field. Prints its control port first, then
waits for packets.
"""

import math
import socket
import struct
import sys

# As GameController publishes the layout of RoboCupGameControlData, version 18: little endian, no
# padding. Offset, format, name.
CONTROL_DATA = [
    (0, "4s", "header"),
    (4, "B", "version"),
    (5, "B", "packetNumber"),
    (6, "B", "playersPerTeam"),
    (7, "B", "competitionPhase"),
    (8, "B", "competitionType"),
    (9, "B", "gamePhase"),
    (10, "B", "state"),
    (11, "B", "setPlay"),
    (12, "B", "firstHalf"),
    (13, "B", "kickingTeam"),
    (14, "h", "secsRemaining"),
    (16, "h", "secondaryTime"),
]
TEAM_OFFSETS = [18, 68]
TEAM = [
    (0, "B", "teamNumber"),
    (1, "B", "fieldPlayerColour"),
    (2, "B", "goalkeeperColour"),
    (3, "B", "goalkeeper"),
    (4, "B", "score"),
    (5, "B", "penaltyShot"),
    (6, "H", "singleShots"),
    (8, "H", "messageBudget"),
]
PLAYERS_OFFSET, PLAYERS, PLAYER_BYTES = 10, 20, 2
CONTROL_BYTES = 118
RETURN_FORMAT = "<4sBBBB3ff2f"  # header, version, playerNum, teamNum, fallen, pose, ballAge, ball
RETURN_BYTES = 32
TEAM_MESSAGE_FORMAT = "<4sBBB7f"  # header, version, player, flags, pose with cosine and sine, ball, age
INITIAL, READY, SET = 0, 1, 2


def fields(table, data, start=0):
    return {name: struct.unpack_from("<" + kind, data, start + offset)[0] for offset, kind, name in table}


def control_data(data):
    assert len(data) == CONTROL_BYTES, len(data)
    message = fields(CONTROL_DATA, data)
    message["teams"] = []
    for start in TEAM_OFFSETS:
        team = fields(TEAM, data, start)
        places = [start + PLAYERS_OFFSET + PLAYER_BYTES * index for index in range(PLAYERS)]
        team["players"] = [tuple(data[place : place + PLAYER_BYTES]) for place in places]
        message["teams"].append(team)
    return message


def check_every_field(data):
    message = control_data(data)
    teams = message.pop("teams")
    assert message == {
        "header": b"RGme",
        "version": 18,
        "packetNumber": 77,
        "playersPerTeam": 7,
        "competitionPhase": 1,
        "competitionType": 1,
        "gamePhase": 2,
        "state": 4,
        "setPlay": 4,
        "firstHalf": 1,
        "kickingTeam": 99,
        "secsRemaining": -258,
        "secondaryTime": 513,
    }, message
    players = [team.pop("players") for team in teams]
    expected = [
        (24, 2, 7, 11, 12, 13, 0x1234, 1111),
        (200, 8, 9, 14, 15, 16, 0x5678, 2222),
    ]
    for team, values in zip(teams, expected):
        assert tuple(team[name] for _, _, name in TEAM) == values, team
    for team, first in zip(players, [1, 101]):
        assert team == [(10, first + index) for index in range(PLAYERS)], team


def check(message):
    assert message["header"] == b"RGme" and message["version"] == 18, message
    assert message["playersPerTeam"] == 7, message
    assert message["competitionPhase"] == 0 and message["competitionType"] == 0, message
    assert message["gamePhase"] == 0 and message["firstHalf"] == 1, message
    assert message["secsRemaining"] == 600, message
    own, other = message["teams"]
    assert (own["teamNumber"], other["teamNumber"]) == (24, 200), message
    assert own["messageBudget"] == 1200 and own["goalkeeper"] == 1, own
    assert own["fieldPlayerColour"] != other["fieldPlayerColour"], message
    if message["state"] == INITIAL:
        assert message["setPlay"] == 0 and message["kickingTeam"] == 24, message
        assert message["secondaryTime"] == 0, message
        penalized = [(0, 0)] * 7 + [(14, 0)] * 13
    elif message["state"] == READY:
        assert message["setPlay"] == 5 and message["kickingTeam"] == 200, message
        assert 0 < message["secondaryTime"] <= 30, message
        penalized = [(0, 0)] * 7 + [(14, 0)] * 13
    else:
        assert message["state"] == SET and message["kickingTeam"] == 255, message
        penalty, seconds = own["players"][3]
        assert penalty == 9 and 0 < seconds <= 45, own
        penalized = [(0, 0)] * 3 + [(9, seconds)] + [(0, 0)] * 3 + [(14, 0)] * 13
    assert own["players"] == penalized, own


def check_return_data(data):
    assert len(data) == RETURN_BYTES == struct.calcsize(RETURN_FORMAT), len(data)
    values = struct.unpack(RETURN_FORMAT, data)
    assert values[:5] == (b"RGrt", 4, 4, 24, 1), values
    expected = (-1500.0, 250.0, 0.5, 1.5, 2000.0, -125.0)
    assert all(abs(one - other) < 1e-3 for one, other in zip(values[5:], expected)), values


def check_team_message(data):
    assert len(data) == struct.calcsize(TEAM_MESSAGE_FORMAT) <= 128, len(data)
    values = struct.unpack(TEAM_MESSAGE_FORMAT, data)
    assert values[:4] == (b"HGtm", 1, 4, 7), values
    expected = (-1.5, 0.25, math.cos(0.5), math.sin(0.5), 2.0, -0.125, 1.5)
    assert all(abs(one - other) < 1e-6 for one, other in zip(values[4:], expected)), values


def main():
    return_data, team_message, every_field = (bytes.fromhex(argument) for argument in sys.argv[1:])
    check_return_data(return_data)
    check_team_message(team_message)
    check_every_field(every_field)
    robot = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    robot.bind(("127.0.0.1", 0))
    robot.settimeout(60)
    print(robot.getsockname()[1], flush=True)
    states = []
    last = None
    while states[-1:] != [SET]:
        data, sender = robot.recvfrom(2000)
        message = control_data(data)
        # A stall may leave some out.
        assert last is None or message["packetNumber"] > last, (message, last)
        last = message["packetNumber"]
        check(message)
        states.append(message["state"])
        answer = struct.pack(RETURN_FORMAT, b"RGrt", 4, 4, 24, 0, -3000.0, 1.0, -0.25, -1.0, 0.0, 0.0)
        robot.sendto(answer, sender)
        robot.sendto(answer[:-1], sender)
    assert INITIAL in states and READY in states and states == sorted(states), states
    print(len(states), flush=True)


main()
