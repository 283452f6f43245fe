// What the timings say of a recording, without a robot.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

const { recordedElsewhere, recordedOf } = await load("panels/recorded.ts");

const counts = (of, recorded, dropped = 0, more = {}) => ({ of, recorded, dropped, failed: 0, lost: 0, overwritten: 0, ...more });
const timings = (recording) => ({ time: 1, instances: [{ name: "Control" }, { name: "Vision" }, { name: "Hearing" }], recording });

const SOME = timings([
  counts("Control", 183, 0, { overwritten: 20 }),
  counts("Vision", 7, 12),
  counts("Hearing", 0),
  counts("Control.outputs", 5, 0, { failed: 1, lost: 2 }),
  counts("logs", 3),
]);

test("an instance has its frames and its values", () => {
  assert.deepEqual(recordedOf(SOME, "Control"), [
    { text: "recording: 183 recorded, 0 dropped, 20 overwritten", isMissing: false },
    { text: "recording of outputs: 5 recorded, 0 dropped, 1 failed, 2 lost", isMissing: true },
  ]);
  assert.deepEqual(recordedOf(SOME, "Vision"), [{ text: "recording: 7 recorded, 12 dropped", isMissing: true }]);
});

test("log messages belong to no instance", () => {
  assert.deepEqual(recordedElsewhere(SOME), [{ text: "recording of logs: 3 recorded, 0 dropped", isMissing: false }]);
});

test("what is not recorded is not told of", () => {
  assert.deepEqual(recordedOf(SOME, "Hearing"), []);
  for (const none of [timings(undefined), timings([])]) {
    assert.deepEqual(recordedOf(none, "Control"), []);
    assert.deepEqual(recordedElsewhere(none), []);
  }
});
