// What is subscribed, with a robot that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

const { Subscriptions } = await load("store/subscriptions.ts");

const PLACE = { root: { kind: "array", item: { kind: "float", bits: 32 }, length: 2 } };
const answered = () => new Promise((resolve) => setTimeout(resolve));

/** Subscriptions of a robot that gives everything it is asked for, as number 1, 2, …; `heard` is what one watcher hears. */
async function watched(encoding, layout) {
  let number = 0;
  const socket = { ask: async ({ subscribe }) => ({ subscribed: { subscription: ++number, encoding: subscribe?.encoding, layout } }) };
  const subscriptions = new Subscriptions(() => socket);
  const heard = [];
  const watcher = { sample: ({ value }) => heard.push(value), refused: (reason) => heard.push(`refused: ${reason}`) };
  subscriptions.watch({ path: "Control.main_outputs.ball.position", encoding }, watcher);
  await answered();
  heard.splice(0);
  const frame = (bytes, subscription = 1) => subscriptions.frame({ subscription, cycle: 7, time: 9e9, bytes });
  return { subscriptions, heard, frame };
}

test("what the run before said last is not told to those who watch later", async () => {
  const { subscriptions, frame } = await watched("binary", PLACE);
  frame(place(1, 2));
  const later = () => {
    const heard = [];
    subscriptions.watch({ path: "Control.main_outputs.ball.position", encoding: "binary" }, { sample: ({ value }) => heard.push(value) });
    return heard;
  };
  assert.deepEqual(later(), [[1, 2]]);
  subscriptions.renew();
  assert.deepEqual(later(), []);
});

test("an answer of a connection that is over names nothing on the next one", async () => {
  const answers = [];
  const subscriptions = new Subscriptions(() => ({ ask: ({ subscribe }) => new Promise((resolve) => answers.push((subscription) => resolve({ subscribed: { subscription, encoding: subscribe.encoding } }))) }));
  const heard = [];
  subscriptions.watch({ path: "a" }, { sample: ({ value }) => heard.push(value) });
  answers[0](7);
  subscriptions.renew();
  answers[1](1);
  await answered();
  for (const subscription of [7, 1]) subscriptions.update({ subscription, cycle: 1, time: 1, value: `of ${subscription}` });
  assert.deepEqual(heard, ["of 1"]);
});

const place = (x, y) => new Uint8Array(Float32Array.of(x, y).buffer);

test("a part that is not there in a cycle is none, and no mistake", async () => {
  const { heard, frame } = await watched("binary", PLACE);
  frame(place(1, 2));
  frame(new Uint8Array());
  frame(place(3, 4));
  assert.deepEqual(heard, [[1, 2], null, [3, 4]]);
});

test("an image that is not there is none", async () => {
  const { heard, frame } = await watched({ jpeg: { quality: 70 } });
  frame(new Uint8Array());
  assert.deepEqual(heard, [null]);
});

test("the first good value behind a broken one takes the complaint away", async () => {
  const { heard, frame } = await watched("binary", PLACE);
  frame(place(1, 2).subarray(1));
  frame(place(1, 2));
  frame(place(3, 4));
  assert.deepEqual(heard, ["refused: Error: the bytes end early", "refused: null", [1, 2], [3, 4]]);
});
