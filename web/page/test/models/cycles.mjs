// The cycles on a time axis, with a robot that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { opened, settled, tick } from "../dom.mjs";
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
