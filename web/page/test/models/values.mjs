// What panels of robotics read of their robot, with subscriptions that are only played.
import assert from "node:assert/strict";
import test from "node:test";
import { signal } from "../dom.mjs";
import { load } from "../load.mjs";

const { Values } = await load("robotics/values.ts");

/** Values of a robot, and what is subscribed. */
function watched() {
  const [begun, watchers] = [[], new Map()];
  const subscriptions = {
    watch: ({ path, rate }, watcher) => {
      begun.push([path, rate]);
      watchers.set(path, watcher);
      return () => watchers.delete(path);
    },
  };
  const welcome = signal({ run: "a" });
  let changes = 0;
  const values = new Values({ subscriptions, welcome }, () => changes++);
  const tell = (path, cycle, time, value) => watchers.get(path)?.sample({ cycle, time: time * 1e9, value });
  return { values, begun, watchers, welcome, tell };
}

test("a value is subscribed once, and stays when the connection to the same run is back", () => {
  const { values, begun, watchers, welcome, tell } = watched();
  values.set("ball", "Control.ball", 15);
  tell("Control.ball", 1, 1, "here");
  welcome.set({ run: "a" });
  values.set("ball", "Control.ball", 15);
  assert.deepEqual([begun.length, values.get("ball")], [1, "here"]);
  welcome.set({ run: "b" });
  assert.equal(values.get("ball"), undefined, "of another run");
  values.set("ball", "Control.ball", 15);
  assert.equal(begun.length, 1);
  tell("Control.ball", 1, 1, "there");
  values.set("ball", "Control.ball", 30);
  assert.deepEqual([begun.length, values.get("ball"), watchers.size], [2, undefined, 1]);
  values.set("ball", null, 30);
  assert.equal(watchers.size, 0);
  values.close();
  values.set("ball", "Control.ball", 30);
  assert.equal(watchers.size, 0);
});

test("values of robots that do not name their run are those of one connection", () => {
  const { values, welcome, tell } = watched();
  welcome.set({});
  values.set("ball", "Control.ball", 15);
  tell("Control.ball", 1, 1, "here");
  welcome.set({});
  assert.equal(values.get("ball"), undefined);
});

test("over an image lies what was found in its cycle, or shortly before or after, and nothing of long ago", () => {
  const { values, tell } = watched();
  values.set("lines", "Vision.lines", 10);
  tell("Vision.lines", 30, 1.0, "thirty");
  tell("Vision.lines", 33, 1.1, "thirty-three");
  assert.equal(values.of("lines", { cycle: 33, time: 1.1e9 }), "thirty-three");
  assert.equal(values.of("lines", { cycle: 32, time: 1.066e9 }), "thirty");
  assert.equal(values.of("lines", { cycle: 29, time: 0.966e9 }), "thirty", "nothing before it came");
  assert.equal(values.of("lines", { cycle: 300, time: 10e9 }), undefined);
  assert.equal(values.of("lines", { cycle: 3, time: 0.1e9 }), undefined);
  assert.equal(values.of("corners", { cycle: 33, time: 1.1e9 }), undefined);
  values.set("balls", "Vision.balls", 1);
  tell("Vision.balls", 33, 1.1, "ball");
  assert.equal(values.of("balls", { cycle: 60, time: 2.0e9 }), "ball", "it comes once a second");
});
