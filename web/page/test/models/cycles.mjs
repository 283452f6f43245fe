// The cycles on a time axis, with a robot that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { labelled, opened, settled, tick } from "../dom.mjs";
import { load } from "../load.mjs";

const { cycles } = await load("panels/cycles.ts");

const graph = (...instances) => ({
  graph: {
    cyclers: [{ name: "Control", instances: ["Control"] }],
    edges: instances.map((instance) => ({ kind: "perception", from: { instance }, to: { cycler: "Control", node: "control::filter", field: instance.toLowerCase() } })),
  },
});
const TRACE = { trace: { traceEvents: [] } };

test("the next question waits for the answer to the one before", async () => {
  let tell;
  const { context, asked } = opened(() => new Promise((resolve) => (tell = resolve)));
  const panel = cycles.open(context);
  for (let turn = 0; turn < 3; turn++) tick();
  assert.equal(asked.length, 1);
  tell(graph("Vision"));
  await settled();
  tell(TRACE);
  await settled();
  tick();
  assert.equal(asked.length, 3);
  panel.close();
});

test("a robot that comes back is asked for its graph, which may be that of another program", async () => {
  const world = { graph: graph("VisionTop") };
  const { context, robot } = opened((ask) => ("graph" in ask ? world.graph : TRACE));
  const panel = cycles.open(context);
  await settled();
  const input = labelled(panel.content, "whose perception input");
  const offered = () => input.options.map((option) => option.getAttribute("value"));
  assert.deepEqual(offered(), ["filter.visiontop"]);
  world.graph = graph("Audio", "VisionBottom");
  tick();
  await settled();
  assert.deepEqual(offered(), ["filter.visiontop"], "the graph of a program does not change");
  robot.welcome.set({ time: 0 });
  tick();
  await settled();
  assert.deepEqual(offered(), ["filter.audio", "filter.visionbottom"]);
  panel.close();
});

test("a picture that is held while the robot answers stays as it is", async () => {
  const lanes = (...names) => ({ trace: { traceEvents: names.map((name, tid) => ({ ph: "M", name: "thread_name", tid, args: { name } })) } });
  let tell = null;
  const { context } = opened((ask) => {
    if ("graph" in ask) return graph("VisionTop");
    return tell === null ? lanes("Control", "VisionTop") : new Promise((resolve) => (tell = resolve));
  });
  const panel = cycles.open(context);
  const canvas = labelled(panel.content, "cycles on a time axis");
  const becomes = async (holds) => {
    while (!holds(canvas.style.height)) await settled();
  };
  await becomes((height) => height !== undefined);
  const two = canvas.style.height;
  tell = () => undefined;
  tick();
  await settled();
  panel.tools[1].click();
  tell(lanes("Control", "VisionTop", "VisionBottom"));
  for (let turn = 0; turn < 5; turn++) await settled();
  assert.equal(canvas.style.height, two);
  panel.tools[1].click();
  tick();
  await settled();
  tell(lanes("Control", "VisionTop", "VisionBottom"));
  await becomes((height) => height !== two);
  panel.close();
});
