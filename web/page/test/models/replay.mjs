// The panel of a recording, with a recording that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { labelled, opened, settled, tick } from "../dom.mjs";
import { load } from "../load.mjs";

const { replay } = await load("panels/replay.ts");

const PLACE = { time: 5, begins: 0, ends: 20, is_playing: true, speed: 1, instances: [{ instance: "Control", cycle: 7, frames: 9, missing: 0 }] };
const MOMENT = { time: 6, instance: "Control", cycle: 500 };
const moves = (asked) => asked.map(({ call }) => call.argument);

test("a jump to a cycle is made once, not by each panel that is opened later", async () => {
  const { context, robot, asked } = opened(() => ({ called: PLACE }));
  const first = replay.open(context);
  robot.moment.set(MOMENT);
  await settled();
  assert.deepEqual(moves(asked), [{ events: true }, { instance: "Control", cycle: 500, play: false }]);
  asked.splice(0);
  const second = replay.open(context);
  await settled();
  assert.deepEqual(moves(asked), [{ events: true }]);
  first.close();
  second.close();
});

test("another recording has other instances", async () => {
  const world = { instances: PLACE.instances };
  const { context } = opened(() => ({ called: { ...PLACE, ...world } }));
  const panel = replay.open(context);
  await settled();
  const whose = labelled(panel.content, "whose cycles");
  const offered = () => whose.options.map((option) => option.getAttribute("value"));
  assert.deepEqual([offered(), whose.value], [["all instances", "Control"], "all instances"]);
  whose.value = "Control";
  whose.tell("change");
  world.instances = [{ ...PLACE.instances[0], instance: "Other" }];
  tick();
  await settled();
  assert.deepEqual([offered(), whose.value], [["all instances", "Other"], "all instances"]);
  world.instances = PLACE.instances;
  tick();
  await settled();
  assert.deepEqual([offered(), whose.value], [["all instances", "Control"], "Control"]);
  panel.close();
});
