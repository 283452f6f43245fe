// What is injected and released, with a robot that is only played: it answers when the test says so.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

const { Injection, Paths, Refused, Signal, Subscriptions, watchInjected } = await load("store/injection.ts", "connection/socket.ts", "store/injected.ts", "store/paths.ts", "store/signal.ts", "store/subscriptions.ts");

function played() {
  const asked = [];
  const robot = { ask: (ask) => new Promise((resolve, reject) => asked.push({ ask, answer: () => resolve({ done: {} }), refuse: reject })) };
  const names = () => asked.map(({ ask }) => Object.entries(ask).map(([name, { path }]) => `${name} ${path}`)[0]);
  return { injection: new Injection(robot), asked, names };
}

const settled = () => new Promise((resolve) => setTimeout(resolve, 0));

test("an injection whose answer comes after its panel was closed is released", async () => {
  const { injection, asked, names } = played();
  const injected = injection.inject("A.main_outputs.x", 1);
  await settled();
  injection.close();
  asked[0].answer();
  await injected;
  await settled();
  assert.deepEqual(names(), ["inject A.main_outputs.x", "release A.main_outputs.x"]);
  asked[1].answer();
  await settled();
  assert.equal(injection.path.value, null);
});

test("one that was refused, or that was never made, is not released", async () => {
  const { injection, asked, names } = played();
  injection.close();
  const injected = injection.inject("A.main_outputs.x", 1);
  await settled();
  injection.close();
  asked[0].refuse(new Error("no"));
  await assert.rejects(injected, /no/);
  await settled();
  assert.deepEqual(names(), ["inject A.main_outputs.x"]);
});

test("another output takes the place of the one before", async () => {
  const { injection, asked, names } = played();
  const first = injection.inject("A.main_outputs.x", 1);
  const second = injection.inject("A.main_outputs.y", 2);
  for (let at = 0; at < 3; at++) {
    await settled();
    asked[at].answer();
  }
  await Promise.all([first, second]);
  assert.deepEqual(names(), ["inject A.main_outputs.x", "release A.main_outputs.x", "inject A.main_outputs.y"]);
  assert.equal(injection.path.value, "A.main_outputs.y");
});

test("what somebody else has released can be left, and another output injected", async () => {
  for (const next of ["release", "inject"]) {
    const { injection, asked, names } = played();
    const first = injection.inject("A.main_outputs.x", 1);
    await settled();
    asked[0].answer();
    await first;
    const second = next === "release" ? injection.release() : injection.inject("A.main_outputs.y", 2);
    await settled();
    asked[1].refuse(new Refused({ message: "nobody has replaced `A.main_outputs.x`" }));
    await settled();
    asked[2]?.answer();
    await second;
    assert.deepEqual(names().slice(2), next === "release" ? [] : ["inject A.main_outputs.y"]);
    assert.equal(injection.path.value, next === "release" ? null : "A.main_outputs.y");
  }
});

test("what others have injected can be released, and that nobody has is told; a panel that closes leaves it alone", async () => {
  const { injection, asked, names } = played();
  const released = injection.release("A.main_outputs.x");
  await settled();
  asked[0].answer();
  await released;
  const nothing = injection.release("A.main_outputs.x");
  await settled();
  asked[1].refuse(new Refused({ message: "nobody has replaced `A.main_outputs.x`" }));
  await assert.rejects(nothing, /nobody has replaced/);
  injection.close();
  await settled();
  assert.deepEqual(names(), ["release A.main_outputs.x", "release A.main_outputs.x"]);
  // One's own comes first, whatever is shown by now.
  const injected = injection.inject("A.main_outputs.y", 1);
  await settled();
  asked[2].answer();
  await injected;
  void injection.release("A.main_outputs.x");
  await settled();
  assert.equal(names().at(-1), "release A.main_outputs.y");
});

test("an injection that somebody else has ended is told once, and one that the robot does not show yet is none of these", async () => {
  const { injection, asked } = played();
  const inject = async () => {
    const injected = injection.inject("A.main_outputs.x", 1);
    await settled();
    asked.at(-1).answer();
    await injected;
  };
  const marks = (...all) => all.map((isInjected) => injection.mark("A.main_outputs.x", isInjected));
  await inject();
  assert.deepEqual(marks(false, true, true), [false, false, false]);
  assert.equal(injection.mark("A.main_outputs.y", false), false, "another output");
  assert.equal(injection.path.value, "A.main_outputs.x");
  await inject();
  assert.deepEqual(marks(false, true, false, false), [false, false, true, false]);
  assert.equal(injection.path.value, null);
  injection.close();
  await settled();
  assert.equal(asked.length, 2, "there is nothing to give back");
  await inject();
  assert.deepEqual(marks(true), [false]);
  const released = injection.release();
  await settled();
  assert.deepEqual(marks(true, false), [false, false], "it was released here");
  asked.at(-1).answer();
  await released;
  assert.equal(injection.path.value, null);
});

test("a release that did not reach the robot can be wished again", async () => {
  const { injection, asked } = played();
  const injected = injection.inject("A.main_outputs.x", 1);
  await settled();
  asked[0].answer();
  await injected;
  const released = injection.release();
  await settled();
  asked[1].refuse(new Error("there is no connection to the robot"));
  await assert.rejects(released, /no connection/);
  assert.equal(injection.path.value, "A.main_outputs.x");
});

test("whoever injects an output, all who look at a part of it are told", async () => {
  const entries = {
    "A.main_outputs": [{ path: "A.main_outputs.image", has_children: true }, { path: "A.main_outputs.lines", has_children: true }],
    "A.main_outputs.image": [{ path: "A.main_outputs.image.data", has_children: true }, { path: "A.main_outputs.image.width", has_children: false }],
  };
  const asked = [];
  const subscriptions = new Subscriptions(() => ({
    ask: async (ask) => (asked.push(ask), "subscribe" in ask ? { subscribed: { subscription: asked.length } } : { done: {} }),
  }));
  const robot = { paths: new Paths(async ({ paths: { below } }) => ({ paths: entries[below] ?? [] })), subscriptions, welcome: new Signal({}) };
  const told = [];
  const stop = watchInjected(robot, "A.main_outputs.image.data.0", (isInjected) => told.push(isInjected));
  await settled();
  assert.deepEqual(asked, [{ subscribe: { path: "A.main_outputs.image.width", rate: 1, encoding: "json" } }], "not the image as JSON");
  for (const injected of [undefined, true, undefined]) subscriptions.update({ subscription: 1, cycle: 1, time: 1, value: null, injected });
  assert.deepEqual(told, [false, true, false]);
  stop();
  assert.deepEqual(asked.slice(1), [{ unsubscribe: { subscription: 1 } }]);
  const stopLines = watchInjected(robot, "A.main_outputs.lines", () => undefined);
  watchInjected(robot, "A.additional_outputs.x", () => undefined);
  watchInjected(robot, "parameters.x", () => undefined)();
  await settled();
  assert.deepEqual(asked.slice(2).map(({ subscribe }) => subscribe.path), ["A.main_outputs.lines.0"]);
  stopLines();
});
