// The connection, with a robot and a clock that are only played.
import assert from "node:assert/strict";
import test from "node:test";
import { settled, tick } from "../dom.mjs";
import { load } from "../load.mjs";

/** Those that were made, oldest first. */
const made = [];

class PlayedSocket {
  static OPEN = 1;
  readyState = 1;
  sent = [];

  constructor() {
    made.push(this);
  }

  send(text) {
    this.sent.push(JSON.parse(text));
  }

  close() {
    this.readyState = 3;
  }

  say(message) {
    this.onmessage({ data: JSON.stringify(message) });
  }
}

globalThis.WebSocket = PlayedSocket;
let retry = null;
window.setTimeout = (deed) => (retry = deed);
const { Socket } = await load("connection/socket.ts");

function connected() {
  made.splice(0);
  retry = null;
  const states = [];
  const nothing = () => undefined;
  const socket = new Socket("ws://robot/socket", { state: (state) => states.push(state), welcome: nothing, message: nothing, frame: nothing });
  made[0].say({ welcome: {} });
  return { socket, states };
}

/** Looks until the connection is given up. */
function looksUntilLost(states) {
  states.splice(0);
  for (let looks = 1; ; looks++) {
    tick();
    if (states.includes("waiting")) return looks;
    assert(looks < 200, "it is never given up");
  }
}

function again(states) {
  retry();
  made.at(-1).say({ welcome: {} });
  states.splice(0);
}

test("a robot that says nothing is gone, and more slowly each time that it comes back", async () => {
  const { socket, states } = connected();
  const all = [];
  for (let time = 0; time < 6; time++) {
    all.push(looksUntilLost(states));
    again(states);
  }
  assert.deepEqual(all, [4, 7, 13, 25, 33, 33]);
  socket.close();
});

test("a link that takes long for one message is borne once that is known", async () => {
  const { socket, states } = connected();
  looksUntilLost(states);
  again(states);
  for (let message = 0; message < 20; message++) {
    for (let look = 0; look < 5; look++) tick();
    made.at(-1).say({ log: {} });
  }
  assert.deepEqual(states, []);
  socket.close();
});

test("a link that is quick again is missed as quickly as before", async () => {
  const { socket, states } = connected();
  looksUntilLost(states);
  again(states);
  for (let look = 0; look < 60; look++) {
    tick();
    made.at(-1).say({ log: {} });
  }
  assert.equal(looksUntilLost(states), 4);
  socket.close();
});

test("the next question waits for the answer to the one before", async () => {
  const { socket } = connected();
  const questions = () => made[0].sent.filter(({ ask }) => "paths" in ask);
  for (let look = 0; look < 3; look++) {
    tick();
    made[0].say({ log: {} });
  }
  assert.equal(questions().length, 1);
  made[0].say({ answer: { id: questions()[0].id, ok: { paths: [] } } });
  await settled();
  tick();
  assert.equal(questions().length, 2);
  socket.close();
});
