// A panel with a value, of a robot that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { all, labelled, ofClass, opened, settled } from "../dom.mjs";
import { load } from "../load.mjs";

const { value } = await load("panels/value.ts");

test("another rate leaves open what is open in a value, and another path begins anew", async () => {
  const [wishes, watchers] = [[], new Set()];
  const subscriptions = {
    watch: ({ path, rate }, watcher) => {
      wishes.push([path, rate]);
      watchers.add(watcher);
      return () => watchers.delete(watcher);
    },
  };
  const { context } = opened(() => ({ done: {} }), { subscriptions });
  context.settings = { path: "Control.additional_outputs.body" };
  const panel = value.open(context);
  const tell = async (said) => {
    for (const watcher of watchers) watcher.sample({ cycle: 1, time: 1e9, value: said });
    await settled();
  };
  const names = () => ofClass(ofClass(panel.content, "tree")[0], "name").map((one) => one.textContent);
  await tell({ head: { pitch: 1 } });
  labelled(panel.content, "open head").click();
  assert.deepEqual(names(), ["body", "head", "pitch"]);
  const [rate] = panel.tools;
  rate.value = "30 Hz";
  rate.tell("change");
  assert.deepEqual([names(), wishes.at(-1), watchers.size], [["body", "head", "pitch"], ["Control.additional_outputs.body", 30], 1]);
  await tell({ head: { pitch: 2 } });
  assert.deepEqual(ofClass(panel.content, "reading").at(-1).textContent, "2");
  panel.accept("Control.additional_outputs.body");
  assert.deepEqual([names(), watchers.size], [["body", "head", "pitch"], 1]);
  panel.accept("Control.additional_outputs.other");
  assert.deepEqual([names(), watchers.size], [["other"], 1]);
  assert.equal(all(panel.content, (one) => one.nodeName === "OUTPUT")[0].textContent, "");
  panel.close();
  assert.equal(watchers.size, 0);
});
