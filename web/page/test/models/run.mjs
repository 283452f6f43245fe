// What a page keeps of a robot whose connection comes again, with robots that are only played.
import assert from "node:assert/strict";
import test from "node:test";
import { settled } from "../dom.mjs";
import { load } from "../load.mjs";

let made = null;

/** A robot that has the path `a`, and counts how often it is asked for it. */
class PlayedSocket {
  static OPEN = 1;
  readyState = 1;
  questions = 0;

  constructor() {
    made = this;
  }

  send(text) {
    const { id, ask } = JSON.parse(text);
    if ("paths" in ask) this.questions++;
    this.say({ answer: { id, ok: "paths" in ask ? { paths: [{ path: "a" }] } : { done: {} } } });
  }

  close() {}

  say(message) {
    this.onmessage({ data: JSON.stringify(message) });
  }
}

globalThis.WebSocket = PlayedSocket;
globalThis.sessionStorage = { getItem: () => null };
let retry = null;
window.setTimeout = (deed) => (retry = deed);
const { Robot, isSameRun } = await load("store/robot.ts", "store/run.ts");

const WELCOME = { version: 1, robot: "lamp", can_write: true, needs_token: false, time: 60e9 };

test("what two connections say first tells whether they are to one run, unless neither says", () => {
  const [a, b, earlier] = [{ run: "a" }, { run: "b" }, {}];
  const cases = [
    [a, { run: "a" }, true],
    [a, b, false],
    [a, earlier, false],
    [earlier, b, false],
    [earlier, {}, null],
    [earlier, { run: null }, null],
    [earlier, earlier, true],
    [null, a, null],
    [null, null, null],
  ];
  for (const [one, other, expected] of cases) assert.equal(isSameRun(one, other), expected, JSON.stringify([one, other]));
});

test("paths are asked for once of a run, and of a robot that does not tell on each connection; logs tell other runs", async () => {
  const robot = new Robot("ws://robot/socket", "token");
  robot.wantLogs();
  let number = 0;
  const connect = async (run, says = true) => {
    if (number++ > 0) {
      made.onclose();
      retry();
    }
    made.say({ welcome: { ...WELCOME, ...(run === null ? {} : { run }) } });
    if (says) made.say({ log: { number, time: number, level: "info", message: `${run} ${number}` } });
    await robot.paths.below("");
    await settled();
    return made.questions;
  };
  assert.deepEqual([await connect("a"), await connect("a"), await connect("b"), await connect("b", false), await connect(null, false), await connect(null, false)], [1, 0, 1, 0, 1, 1]);
  assert.deepEqual(robot.logs.value.map((line) => line.remark ?? line.message), ["a 1", "a 2", "the robot began anew", "b 3", "the robot began anew"]);
  robot.close();
});
