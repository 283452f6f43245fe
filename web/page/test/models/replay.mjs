// The panel of a recording, with a recording that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { all, labelled, ofClass, opened, settled, tick } from "../dom.mjs";
import { load } from "../load.mjs";

const { replay } = await load("panels/replay.ts");

const PLACE = { time: 5, begins: 0, ends: 20, is_playing: true, speed: 1, instances: [{ instance: "Control", cycle: 7, frames: 9, missing: 0 }], events: [] };
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

test("what is no number of a cycle moves nothing and is told, and an empty field wishes nothing", async () => {
  const { context, asked } = opened(() => ({ called: PLACE }));
  const panel = replay.open(context);
  await settled();
  asked.splice(0);
  const cycle = labelled(panel.content, "go to this cycle");
  const [failure] = ofClass(panel.content, "failure");
  const said = async (text) => {
    cycle.value = text;
    cycle.tell("change");
    await settled();
    return failure.textContent;
  };
  for (const text of ["abc", "-1", "1.5", "1e3"]) assert.equal(await said(text), `\`${text}\` is no number of a cycle`);
  assert.equal(await said(" "), "");
  assert.deepEqual(asked, []);
  assert.equal(await said(" 7 "), "");
  assert.deepEqual(moves(asked), [{ cycle: 7, instance: "Control" }]);
  panel.close();
});

test("what happened in a recording is asked once of a run that says which it is", async () => {
  const { context, robot, asked } = opened(() => ({ called: PLACE }));
  const panel = replay.open(context);
  const asksAgain = async (welcome) => {
    await settled();
    asked.splice(0);
    robot.state.set("waiting");
    robot.welcome.set(welcome);
    robot.state.set("open");
    await settled();
    return moves(asked).some(({ events }) => events === true);
  };
  assert(await asksAgain({ time: 0, run: "a" }));
  assert(!(await asksAgain({ time: 9, run: "a" })));
  assert(await asksAgain({ time: 9, run: "b" }));
  for (let time = 0; time < 2; time++) assert(await asksAgain({ time: 9 }), "an earlier version does not tell");
  panel.close();
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

test("why somebody's wish was not done stays until the next one", async () => {
  const { context } = opened(({ call }) => {
    if (call.argument.cycle === 99) throw new Error("cycle 99 of `Control` was not recorded");
    return { called: PLACE };
  });
  const panel = replay.open(context);
  await settled();
  const [failure] = ofClass(panel.content, "failure");
  const cycle = labelled(panel.content, "go to this cycle");
  const wish = async (number) => {
    cycle.value = String(number);
    cycle.tell("change");
    await settled();
  };
  await wish(99);
  tick();
  await settled();
  assert.deepEqual([failure.hidden, failure.textContent], [false, "cycle 99 of `Control` was not recorded"]);
  await wish(7);
  assert(failure.hidden);
  panel.close();
});

test("rows stay the same elements while their numbers change", async () => {
  const world = { cycle: 7 };
  const { context } = opened(() => ({ called: { ...PLACE, instances: [{ ...PLACE.instances[0], ...world }] } }));
  const panel = replay.open(context);
  await settled();
  const row = () => all(panel.content, (one) => one.getAttribute("data-key") === "Control")[0];
  const before = row();
  world.cycle = 8;
  tick();
  await settled();
  assert.equal(row(), before);
  assert.match(row().textContent, /^Control8/);
  panel.close();
});
