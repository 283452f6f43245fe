// Binary messages, without a robot.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

const { readFrames } = await load("connection/binary.ts");

function frame(subscription, value) {
  const bytes = Buffer.alloc(24 + value.length);
  bytes.write("HKG1");
  bytes.writeUInt32LE(subscription, 4);
  bytes.writeBigUInt64LE(7n, 8);
  bytes.writeBigUInt64LE(9_000_000_000n, 16);
  bytes.set(value, 24);
  return bytes;
}

function bundle(...frames) {
  const lengths = frames.map((one) => Buffer.from(Uint32Array.of(one.length).buffer));
  return Buffer.concat([Buffer.from("HKGS"), ...frames.flatMap((one, at) => [lengths[at], one])]);
}

const read = (bytes) => readFrames(Uint8Array.from(bytes).buffer).map(({ subscription, cycle, time, bytes: value }) => [subscription, cycle, time, ...value]);

test("a frame alone is one", () => {
  assert.deepEqual(read(frame(3, [1, 2])), [[3, 7, 9e9, 1, 2]]);
  assert.deepEqual(read(frame(3, [])), [[3, 7, 9e9]]);
});

test("several in one message are all there, in their order", () => {
  assert.deepEqual(read(bundle(frame(1, [1]), frame(2, []), frame(1, [5, 6]))), [[1, 7, 9e9, 1], [2, 7, 9e9], [1, 7, 9e9, 5, 6]]);
  assert.deepEqual(read(bundle()), []);
});

test("what is no frame is left out", () => {
  for (const bytes of [[], [72, 75], frame(1, []).subarray(0, 23), Buffer.from("HKG2".padEnd(30))]) assert.deepEqual(read(bytes), []);
  const cut = bundle(frame(1, [1]), frame(2, [2, 3])).subarray(0, -1);
  assert.deepEqual(read(cut), [[1, 7, 9e9, 1]]);
  assert.deepEqual(read(bundle(Buffer.from("short"), frame(4, [4]))), [[4, 7, 9e9, 4]]);
});
