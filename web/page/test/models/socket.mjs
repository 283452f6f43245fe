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

/** Attempts that fail: the network says so, or says nothing, also behind a handshake. */
const FAILURES = {
  refused: () => made.at(-1).onclose(),
  silent: (states) => {
    made.at(-1).readyState = 0;
    looksUntilLost(states);
  },
  mute: (states) => looksUntilLost(states),
};

test("a robot that is silent and answers at once is borne longer, and never longer than it bears the page", async () => {
  const { socket, states } = connected();
  const all = [];
  for (let time = 0; time < 5; time++) {
    all.push(looksUntilLost(states));
    again(states);
  }
  assert.deepEqual(all, [4, 7, 10, 10, 10], "looks of 2 s");
  socket.close();
});

for (const [name, fail] of Object.entries(FAILURES)) {
  test(`a robot that was gone is missed as soon each time, where an attempt is ${name}`, async () => {
    const { socket, states } = connected();
    const all = [];
    for (let time = 0; time < 5; time++) {
      all.push(looksUntilLost(states));
      retry();
      fail(states);
      again(states);
    }
    assert.deepEqual(all, [4, 4, 4, 4, 4]);
    socket.close();
  });
}

test("a link that was slow is none any more once an attempt fails", async () => {
  const { socket, states } = connected();
  for (let time = 0; time < 2; time++) {
    looksUntilLost(states);
    again(states);
  }
  assert.equal(looksUntilLost(states), 10);
  retry();
  FAILURES.refused();
  again(states);
  assert.equal(looksUntilLost(states), 4);
  socket.close();
});

test("a connection that the robot ends says nothing of the link", async () => {
  const { socket, states } = connected();
  made.at(-1).onclose();
  again(states);
  assert.equal(looksUntilLost(states), 4);
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

test("who waits for an answer gets it, also beside one that is nested too deeply for all digits", async () => {
  const { socket } = connected();
  const asked = socket.ask({ parameters: { path: "" } });
  const { id } = made[0].sent.at(-1);
  const deep = `${"[".repeat(50_000)}11400714819323198485${"]".repeat(50_000)}`;
  made[0].onmessage({ data: `[{"log":${deep}},{"answer":{"id":${id},"ok":{"done":{}}}}]` });
  assert.deepEqual(await Promise.race([asked, settled()]), { done: {} });
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

/** A message with frames of these subscriptions. */
function frames(...subscriptions) {
  const all = subscriptions.map((subscription) => {
    const [length, head] = [new Uint8Array([24, 0, 0, 0]), new Uint8Array(24)];
    head.set(new TextEncoder().encode("HKG1"));
    new DataView(head.buffer).setUint32(4, subscription, true);
    return [...length, ...head];
  });
  return new Uint8Array([...new TextEncoder().encode("HKGS"), ...all.flat()]).buffer;
}

for (const [kind, data] of [["messages", JSON.stringify([1, 2, 3].map((subscription) => ({ update: { subscription } })))], ["frames", frames(1, 2, 3)]]) {
  test(`the rest of the ${kind} of a connection that was lost is not heard beside its successor`, async () => {
    made.splice(0);
    const heard = [];
    const hear = (subscription) => {
      heard.push(subscription);
      if (subscription !== 1) return;
      made[0].onclose();
      retry();
      made[1].say({ welcome: {} });
    };
    const socket = new Socket("ws://robot/socket", {
      state: () => undefined,
      welcome: () => heard.push("welcome"),
      message: ({ update }) => hear(update.subscription),
      frame: ({ subscription }) => hear(subscription),
    });
    made[0].onmessage({ data });
    await settled();
    assert.deepEqual(heard, [1, "welcome"]);
    socket.close();
  });
}
