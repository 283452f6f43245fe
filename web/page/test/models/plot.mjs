// A plot with a robot that is only played, and a chart that draws nothing.
import assert from "node:assert/strict";
import test from "node:test";
import { all, ofClass, opened, settled } from "../dom.mjs";
import { load } from "../load.mjs";

const { plot } = await load("panels/plot.ts");

/** A plot of two curves, and what its chart shows of the first one. */
function drawn(settings = {}) {
  const watchers = new Map();
  const subscriptions = {
    watch: ({ path }, watcher) => {
      watchers.set(path, watcher);
      return () => watchers.delete(path);
    },
  };
  const { context, robot } = opened(() => ({ done: {} }), { subscriptions });
  context.settings = { paths: ["a", "b"], ...settings };
  robot.welcome.set({ time: 0, run: "one" });
  const panel = plot.open(context);
  const tell = (...times) => times.forEach((time) => ["a", "b"].forEach((path) => watchers.get(path)?.sample({ time: time * 1e9, value: 10 * time })));
  const chart = () => globalThis.charts.at(-1);
  const pause = panel.tools.find((one) => (one.getAttribute("aria-label") ?? "").startsWith("hold the picture"));
  const [earlier] = ofClass(panel.content, "earlier");
  return { panel, robot, watchers, tell, chart, pause, shown: () => [...chart().data[0]], isEarlier: () => !earlier.hidden };
}

test("a paused plot keeps what it shows when another run begins, says so, and shows the new one once somebody goes on", async () => {
  const { panel, robot, tell, chart, pause, shown, isEarlier } = drawn();
  tell(100, 101, 102, 103);
  await settled();
  assert.deepEqual(shown(), [100, 101, 102, 103]);
  pause.click();
  robot.welcome.set({ time: 0.5e9, run: "two" });
  tell(1, 2);
  await settled();
  assert.deepEqual([shown(), isEarlier()], [[100, 101, 102, 103], true]);
  chart().drag(101, 110);
  assert.deepEqual([shown(), chart().scales.x], [[101, 102, 103], { min: 101, max: 110 }], "a part of it can be looked at");
  robot.moment.set({ time: 1.5, instance: "Control", cycle: 7 });
  assert.deepEqual([shown(), isEarlier()], [[101, 102, 103], true], "what belongs to the new run is not sought in it");
  // Whatever draws everything anew.
  panel.accept("c");
  assert.deepEqual([shown(), isEarlier()], [[101, 102, 103], true]);
  pause.click();
  assert.deepEqual([shown(), isEarlier(), pause.textContent], [[1, 2], false, "Pause"]);
  panel.close();
});

test("a plot that goes on shows the new run at once, and a pause is no earlier run's where the same one goes on", async () => {
  const { panel, robot, tell, pause, shown, isEarlier } = drawn();
  tell(100, 101);
  robot.welcome.set({ time: 0.5e9, run: "two" });
  tell(1, 2);
  await settled();
  assert.deepEqual([shown(), isEarlier()], [[1, 2], false]);
  pause.click();
  robot.welcome.set({ time: 3e9, run: "two" });
  assert.deepEqual([shown(), isEarlier()], [[1, 2], false]);
  robot.welcome.set({ time: 0.5e9, run: null });
  assert.deepEqual([shown(), isEarlier()], [[1, 2], true], "a robot that does not tell is known by its clock");
  panel.close();
});

test("a paused plot keeps what a recording takes back, and what is older than a curve keeps", async () => {
  const { panel, tell, chart, pause, shown } = drawn({ window: 5 });
  tell(1, 2, 3, 4);
  await settled();
  pause.click();
  tell(1.5);
  chart().drag(0, 20);
  assert.deepEqual(shown(), [1, 2, 3, 4], "the replay went back");
  tell(...Array.from({ length: 40_000 }, (_, at) => 10 + at / 100));
  chart().drag(-10, 20);
  assert.deepEqual(shown(), [1, 2, 3, 4]);
  pause.click();
  assert.equal(shown().at(-1), 10 + 39_999 / 100);
  panel.close();
});

test("a moment that somebody wants to look at is shown with the points that there are by then", async () => {
  const { panel, robot, tell, chart, pause, shown } = drawn({ window: 5 });
  tell(1, 2);
  await settled();
  pause.click();
  tell(3, 4);
  robot.moment.set({ time: 4, instance: "Control", cycle: 7 });
  assert.deepEqual([shown(), chart().scales.x], [[2, 3, 4], { min: 1.5, max: 6.5 }]);
  panel.close();
});

test("what is in the way of a file stays told until another one is chosen, or what it has is added", async () => {
  const { panel, robot } = drawn();
  const [file] = panel.tools.flatMap((tool) => all(tool, (one) => one.getAttribute("type") === "file"));
  const [failure] = ofClass(panel.content, "failure");
  const choose = async (text) => {
    file.files = [{ name: "plot.csv", text }];
    file.tell("change");
    await settled();
    // Whatever else is told.
    robot.state.set("open");
    return failure.textContent;
  };
  assert.match(await choose(async () => "nothing"), /^this file has no curves/);
  assert.match(await choose(() => Promise.reject(new Error("it is gone"))), /plot\.csv cannot be read: it is gone/);
  assert.match(await choose(async () => "time,c\n1,2"), /^nothing of this file is in this plot: add one of c$/);
  panel.accept("c");
  assert.equal(failure.textContent, "");
  assert.equal(await choose(async () => "time,a\n1,2"), "");
  panel.close();
});

/** What CSV saves, in lines. */
function saved(panel) {
  const { URL } = globalThis;
  let text = "";
  const before = globalThis.Blob;
  globalThis.Blob = class {
    constructor(parts) {
      text = parts.join("");
    }
  };
  Object.assign(globalThis, { URL: { createObjectURL: () => "", revokeObjectURL: () => undefined } });
  panel.tools.find((one) => one.textContent === "CSV").click();
  Object.assign(globalThis, { URL, Blob: before });
  return text.trim().split("\n");
}

test("the file of a held plot has nothing of another run, also of a curve that was added while it was held", async () => {
  const { panel, robot, watchers, tell, pause } = drawn();
  tell(100, 101, 102);
  await settled();
  pause.click();
  panel.accept("c");
  watchers.get("c").sample({ time: 101e9, value: 7 });
  panel.resized();
  assert.deepEqual(saved(panel), ["time,a,b,c", "100,1000,1000,", "101,1010,1010,7", "102,1020,1020,"]);
  robot.welcome.set({ time: 90e9, run: "two" });
  watchers.get("c").sample({ time: 101.5e9, value: 8 });
  assert.deepEqual(saved(panel), ["time,a,b,c", "100,1000,1000,", "101,1010,1010,", "102,1020,1020,"]);
  panel.close();
});

test("a held plot tells the gaps of what it shows, until somebody goes on", async () => {
  const { panel, robot, watchers, tell, pause } = drawn();
  const gaps = () => all(panel.content, (one) => one.nodeName === "OUTPUT" && /^(gaps|$)/.test(one.textContent))[0].textContent;
  tell(100, 101);
  watchers.get("a").lost(3);
  assert.equal(gaps(), "gaps: 3 values did not come through");
  pause.click();
  watchers.get("b").lost(4);
  assert.equal(gaps(), "gaps: 3 values did not come through", "what is missing behind it");
  robot.welcome.set({ time: 0.5e9, run: "two" });
  assert.equal(gaps(), "gaps: 3 values did not come through", "of another run nothing is missing");
  watchers.get("a").lost(1);
  pause.click();
  assert.equal(gaps(), "gaps: 1 value did not come through");
  panel.close();
});

test("the field for the next path, and the list of robots beside it, are not touched when a curve comes or goes", () => {
  const { panel } = drawn();
  const [chips] = ofClass(panel.content, "chips");
  const input = all(chips, (one) => one.getAttribute("aria-label") === "add a path")[0];
  const touched = [];
  for (const one of all(chips, () => true)) one.remove = () => touched.push(one);
  for (const one of ofClass(chips, "chip")) delete one.remove;
  input.value = "c";
  input.tell("change");
  assert.equal(ofClass(chips, "chip").length, 3);
  all(ofClass(chips, "chip")[0], (one) => one.nodeName === "BUTTON")[0].click();
  assert.deepEqual([ofClass(chips, "chip").map((one) => one.getAttribute("title")), touched], [["b", "c"], []]);
  panel.close();
});
