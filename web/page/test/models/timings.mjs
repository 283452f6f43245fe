// The table of durations, with a robot that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { labelled, ofClass, opened, settled, tick } from "../dom.mjs";
import { load } from "../load.mjs";

const { timings } = await load("panels/timings.ts");

const node = (name) => ({ node: name, calls: 3, skipped: 0, failures: 0, durations: { p50: 5, p99: 9, max: 12 } });
const instance = (name, cycles) => ({ name, cycles, overruns: 0, failures: 0, deadline: 12000, cycle: { p50: 10, p99: 20, max: 30 }, lateness: null, framework: null, nodes: [node("control::one"), node("control::two")], queues: [] });
const answer = (time) => ({ timings: { time: time * 1e9, instances: [instance("Control", 83 * time), instance("Vision", 30 * time)] } });

test("the next question waits for the answer to the one before", async () => {
  let tell;
  const { context, asked } = opened(() => new Promise((resolve) => (tell = resolve)));
  const panel = timings.open(context);
  for (let turn = 0; turn < 3; turn++) tick();
  assert.equal(asked.length, 1);
  tell(answer(1));
  await settled();
  tick();
  assert.equal(asked.length, 2);
  panel.close();
});

test("why there is no trace stays, whatever the table hears", async () => {
  const { context } = opened((ask) => {
    if ("trace" in ask) throw new Error("no trace");
    return answer(1);
  });
  const panel = timings.open(context);
  await settled();
  panel.tools[1].click();
  await settled();
  tick();
  await settled();
  assert.equal(ofClass(panel.content, "failure")[0].textContent, "no trace");
  panel.close();
});

test("rows stay the same elements while their numbers change, and nodes come and go", async () => {
  let time = 1;
  const { context, asked } = opened(() => answer(time++));
  const panel = timings.open(context);
  await settled();
  const caret = labelled(panel.content, "nodes of Vision");
  const rows = () => ofClass(panel.content, "instance").concat(ofClass(panel.content, "node"));
  const before = rows();
  tick();
  await settled();
  assert.equal(labelled(panel.content, "nodes of Vision"), caret);
  assert.deepEqual(rows(), before);
  assert.match(ofClass(panel.content, "instance")[0].textContent, /83\.0 Hz.*166/, "and say what is new");
  caret.click();
  assert.equal(labelled(panel.content, "nodes of Vision"), caret);
  assert.deepEqual([rows().length, caret.classList.contains("open"), asked.length], [before.length - 2, false, 2]);
  caret.click();
  assert.deepEqual([rows().length, caret.classList.contains("open")], [before.length, true]);
  panel.close();
});

test("a rate is of one run: what was counted before a restart is not held against it", async () => {
  let [time, welcome] = [1, { time: 0, run: "a" }];
  const { context, robot } = opened(() => answer(time++));
  const panel = timings.open(context);
  const rate = async (next) => {
    if (next !== undefined) robot.welcome.set((welcome = next));
    tick();
    await settled();
    return /^Control(.*? Hz)?/.exec(ofClass(panel.content, "instance")[0].textContent)[1] ?? null;
  };
  await rate(welcome);
  assert.equal(await rate(), "83.0 Hz");
  assert.equal(await rate({ time: 9, run: "a" }), "83.0 Hz", "another connection to it");
  // Its clock is ahead of where the one before was seen last.
  time = 60;
  assert.equal(await rate({ time: 9, run: "b" }), null);
  assert.equal(await rate(), "83.0 Hz");
  panel.close();
});
