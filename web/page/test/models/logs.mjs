// What the robot says, with a robot that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { all, labelled, ofClass, opened, settled, signal, tick } from "../dom.mjs";
import { load } from "../load.mjs";

const { Logs } = await load("store/logs.ts");
const { logs } = await load("panels/logs.ts");

const log = (number, message = `message ${number}`, more = {}) => ({ number, time: number * 1e9, level: "info", message, ...more });
const said = ({ lines }) => lines.value.map((line) => line.remark ?? line.message);

/** Numbers 1 to 3 of the first run, whose clock is at 4 s. */
function talked() {
  const all = new Logs();
  all.begin({ time: 0 });
  for (const number of [1, 2, 3]) all.add(log(number));
  return all;
}

test("last words stay when the robot begins anew", () => {
  const all = talked();
  all.begin({ time: 0.5e9 });
  for (const number of [1, 2]) all.add({ ...log(number, `new ${number}`), time: 0.1e9 * number });
  assert.deepEqual(said(all), ["message 1", "message 2", "message 3", "the robot began anew", "new 1", "new 2"]);
});

test("what the same run says again after a loss is there once", () => {
  const all = talked();
  all.begin({ time: 9e9 });
  for (const number of [2, 3, 4]) all.add(log(number));
  assert.deepEqual(said(all), ["message 1", "message 2", "message 3", "message 4"]);
});

test("a later run is known by what it says, also if its clock is ahead", () => {
  const all = talked();
  all.begin({ time: 60e9 });
  all.add({ ...log(1, "new"), time: 0.2e9 });
  assert.deepEqual(said(all), ["message 1", "message 2", "message 3", "the robot began anew", "new"]);
});

test("of what was said in time nobody was there for, the clock tells the run", () => {
  const [same, other] = [talked(), talked()];
  same.begin({ time: 60e9 });
  other.begin({ time: 1e9 });
  for (const all of [same, other]) all.add(log(50, "later"));
  assert.deepEqual(said(same).slice(3), ["later"]);
  assert.deepEqual(said(other).slice(3), ["the robot began anew", "later"]);
});

/** More messages of one run than are kept, all within 3 s: of its first thousand the page has none. */
function talkedMuch() {
  const all = new Logs();
  all.begin({ time: 0 });
  for (let number = 1; number <= 3000; number++) all.add({ ...log(number), time: number * 1e6 });
  all.begin({ time: 60e9 });
  return all;
}

const saidAnew = (all) => said(all).slice(said(all).indexOf("the robot began anew") + 1);

test("a run that is ahead and has said less than is kept is told from the one before, and nothing of it is lost", () => {
  const all = talkedMuch();
  for (let number = 1; number <= 500; number++) all.add({ ...log(number, `new ${number}`), time: number * 1e6 });
  tick();
  all.add({ ...log(501, "new 501"), time: 61e9 });
  assert.equal(saidAnew(all).length, 501);
  assert.deepEqual([saidAnew(all)[0], saidAnew(all).at(-1)], ["new 1", "new 501"]);
  tick();
  assert.equal(said(all).filter((text) => text === "the robot began anew").length, 1);
});

test("a run that comes to numbers of the one before is known by what it says there", () => {
  const all = talkedMuch();
  for (let number = 900; number <= 1100; number++) {
    if (number === 950) all.lost(3);
    all.add({ ...log(number, `new ${number}`), time: number * 1e6 });
  }
  assert.equal(saidAnew(all).length, 202, "without waiting");
  assert.equal(saidAnew(all)[50], "… 3 messages left out");
});

test("what the same run says again from before what the page keeps is left alone", () => {
  const all = talkedMuch();
  const before = said(all);
  for (let number = 900; number <= 3001; number++) all.add({ ...log(number), time: number * 1e6 });
  tick();
  assert.deepEqual(said(all), [...before.slice(1), "message 3001"]);
});

test("what a connection said that was lost before anybody knew it is not shown twice", () => {
  const all = talkedMuch();
  for (let time = 0; time < 2; time++) {
    for (const number of [1, 2]) all.add({ ...log(number, `new ${number}`), time: number * 1e6 });
    if (time === 0) all.begin({ time: 62e9 });
  }
  tick();
  assert.deepEqual(saidAnew(all), ["new 1", "new 2"]);
});

/** Numbers 1 to 3 of run `a`, whose clock is at 4 s. */
function talkedOf() {
  const all = new Logs();
  all.begin({ time: 0, run: "a" });
  for (const number of [1, 2, 3]) all.add(log(number));
  return all;
}

test("a run that says which it is goes on, whatever it says and its clock", () => {
  const all = talkedOf();
  // A recording that went back to its begin, where it says once more what it said first.
  all.begin({ time: 0, run: "a" });
  for (const number of [3, 4]) all.add(log(number, "again", { time: 1e6 }));
  assert.deepEqual(said(all), ["message 1", "message 2", "message 3", "again"]);
});

test("another run is told at once, also one that would pass for the run before, and once", () => {
  const all = talkedOf();
  all.begin({ time: 60e9, run: "b" });
  assert.deepEqual(said(all).slice(3), ["the robot began anew"]);
  all.begin({ time: 61e9, run: "c" });
  all.add(log(50, "later"));
  assert.deepEqual(said(all).slice(3), ["the robot began anew", "later"]);
  // A robot of an earlier version is another one, and of its next run nobody knows.
  all.begin({ time: 62e9 });
  all.begin({ time: 63e9 });
  all.add(log(51, "earlier version"));
  assert.deepEqual(said(all).slice(5), ["the robot began anew", "earlier version"]);
});

function shown(lines) {
  const { context, robot, asked } = opened(async () => ({ done: {} }), { logs: signal(lines), wantLogs: () => undefined });
  const panel = logs.open(context);
  return { panel, robot, asked };
}

test("a remark is shown whatever is filtered", async () => {
  const { panel } = shown([log(1, "one"), { remark: "the robot began anew" }, log(2, "two")]);
  const filter = labelled(panel.content, "filter");
  filter.value = "two";
  filter.tell("input");
  await settled();
  assert.deepEqual(ofClass(panel.content, "entry").map((one) => one.textContent.includes("two") || one.textContent), ["the robot began anew", true]);
  panel.close();
});

test("fields have all digits, and are found by them", async () => {
  const fields = { seed: 11400714819323198485n, all: [1, 11400714819323198485n], side: "Left" };
  const { panel } = shown([log(1, "begun", { fields })]);
  labelled(panel.content, "filter").value = "23198485";
  labelled(panel.content, "filter").tell("input");
  await settled();
  const [entry] = ofClass(panel.content, "entry");
  assert(entry?.textContent.endsWith("begun seed=11400714819323198485 all=[1,11400714819323198485] side=Left"), entry?.textContent);
  panel.close();
});

test("the level that a robot makes is a wish: any can be chosen at any time", async () => {
  const { panel, robot, asked } = shown([]);
  const list = labelled(panel.content, "what the robot keeps");
  assert.deepEqual(list.options.map((option) => option.getAttribute("value")), ["unchanged", "trace", "debug", "info", "warn", "error"]);
  for (const level of ["info", "debug"]) {
    list.value = level;
    list.tell("change");
    await settled();
    assert.equal(list.value, "unchanged");
  }
  assert.deepEqual(asked, ["info", "debug"].map((level) => ({ set_log_level: { level } })));
  const hints = () => all(panel.content, ({ textContent }) => /as was chosen here$/.test(textContent)).length > 0;
  assert(hints());
  robot.welcome.set({ time: 0, run: "a" });
  assert(!hints(), "a robot that comes back may make another one");
  list.value = "debug";
  list.tell("change");
  await settled();
  robot.welcome.set({ time: 0, run: "a" });
  assert(hints(), "the same run makes what was chosen");
  robot.welcome.set({ time: 0, run: "b" });
  assert(!hints(), "a robot that comes back may make another one");
  panel.close();
});

test("messages that did not come through are missed where they are missing", () => {
  const all = talked();
  all.lost(12);
  all.lost(-1);
  all.add(log(16));
  assert.deepEqual(said(all).slice(2), ["message 3", "… 12 messages left out", "message 16"]);
});

test("rows stay the same elements while others come: a click that has begun ends there", async () => {
  const lines = [1, 2].map((number) => log(number, `message ${number}`, { instance: "Control", cycle: number }));
  const { panel, robot } = shown(lines);
  await settled();
  const before = ofClass(panel.content, "entry");
  robot.logs.set([...lines.slice(1), log(3)]);
  await settled();
  const after = ofClass(panel.content, "entry");
  assert.deepEqual(after.length, 2);
  assert.equal(after[0], before[1]);
  labelled(after[0], "plots and replay").click();
  assert.deepEqual(robot.moment.value, { time: 2, instance: "Control", cycle: 2 });
  panel.close();
});
