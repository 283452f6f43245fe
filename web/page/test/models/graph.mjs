// The graph and what it tells of a node, with a robot that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { labelled, ofClass, opened, settled, tick } from "../dom.mjs";
import { load } from "../load.mjs";

const { graph } = await load("panels/graph.ts");

const node = (path, order) => ({ path, order, setup: false, file: `${path}.rs`, fields: [] });
const graphOf = (...nodes) => ({ graph: { cyclers: [{ name: "Control", kind: "real_time", instances: ["Control"], nodes: nodes.map(node) }], edges: [] } });
const timingsOf = (calls) => ({ timings: { time: 0, instances: [{ name: "Control", nodes: ["control::one", "control::two"].map((path) => ({ node: path, calls, skipped: 0, failures: 0 })) }] } });

/** A graph of two nodes, and what is read of the one that is chosen. */
function drawn(timings = (calls) => timingsOf(calls), failure = null) {
  const world = { graph: graphOf("control::one", "control::two"), calls: 0, failure };
  const { context, robot, asked } = opened((ask) => {
    if (world.failure !== null) throw new Error(world.failure);
    return "graph" in ask ? world.graph : timings(++world.calls);
  });
  robot.welcome.set({ time: 0, run: "a" });
  const panel = graph.open(context);
  const connect = async (run) => {
    robot.state.set("waiting");
    robot.welcome.set({ time: 0, run });
    robot.state.set("open");
    await settled();
  };
  const cards = () => ofClass(panel.content, "node");
  return { panel, robot, asked, world, connect, cards, card: (name) => labelled(panel.content, `Control ${name}`), read: () => ofClass(panel.content, "muted").map((one) => one.textContent).filter((text) => /runs|timings|busy/.test(text)).at(-1) };
}

test("what a chosen node takes is asked for again, also after it was refused, as long as it is chosen, seen and there", async () => {
  const { panel, robot, asked, card, read } = drawn((calls) => {
    if (calls === 2) throw new Error("too busy");
    return timingsOf(calls);
  });
  await settled();
  const turn = async () => {
    tick();
    await settled();
    return [read(), asked.length];
  };
  assert.equal((await turn())[1], 1, "nothing is chosen");
  card("control::one").click();
  await settled();
  assert.equal(read(), "Control: 1 runs, 0 skipped, 0 failed");
  assert.deepEqual(await turn(), ["too busy", 3]);
  assert.deepEqual(await turn(), ["Control: 3 runs, 0 skipped, 0 failed", 4]);
  document.hidden = true;
  assert.equal((await turn())[1], 4);
  document.hidden = false;
  robot.state.set("waiting");
  assert.equal((await turn())[1], 4);
  robot.state.set("open");
  await settled();
  card("control::one").click();
  const count = asked.length;
  assert.equal((await turn())[1], count, "nothing is chosen any more");
  card("control::one").click();
  await settled();
  panel.close();
  assert.equal((await turn())[1], count + 1);
});

test("another connection to the same run draws nothing anew, and a question that failed is asked again", async () => {
  const { panel, world, asked, connect, cards } = drawn(undefined, "lost");
  await settled();
  assert.equal(ofClass(panel.content, "failure")[0].textContent, "lost");
  world.failure = null;
  await connect("a");
  const before = cards();
  assert.equal(before.length, 2);
  await connect("a");
  assert.deepEqual([cards(), asked.length], [before, 2]);
  panel.close();
});

test("what another run has, too, is the same card, and stays chosen", async () => {
  const { panel, world, connect, cards, card, read } = drawn();
  await settled();
  const [one, two] = cards();
  two.click();
  await settled();
  world.graph = graphOf("control::zero", "control::two");
  await connect("b");
  assert.deepEqual(cards().map((card) => card.getAttribute("title")), ["control::zero", "control::two"]);
  assert.equal(cards()[1], two);
  assert.equal(one.parentElement.parentElement, null);
  assert.equal(two.getAttribute("aria-pressed"), "true");
  assert.equal(read(), "Control: 2 runs, 0 skipped, 0 failed");
  world.graph = graphOf("control::zero");
  await connect("c");
  assert.equal(card("control::zero").getAttribute("aria-pressed"), "false");
  panel.close();
});
