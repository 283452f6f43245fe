// A panel of parameters with a robot that is only played.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { all, labelled, ofClass, opened, settled, signal } from "../dom.mjs";
import { load } from "../load.mjs";
import { Played } from "../tuning.mjs";

const { parameters } = await load("panels/parameters.ts");

/** A panel of one text `a`, and what a person sees and does there. */
async function shown(text) {
  const robot = new Played({ a: text });
  const changed = signal(null);
  const paths = { everything: async () => [{ path: "parameters.a", type: "String" }] };
  const { context } = opened((ask) => robot.ask(ask), { parameters: changed, paths });
  const panel = parameters.open(context);
  const load = async () => {
    changed.set(null);
    await settled();
  };
  await load();
  const row = () => ofClass(panel.content, "parameter")[0];
  const field = () => all(row(), (one) => one.getAttribute("aria-label") === "a")[0];
  const type = (typed) => {
    field().value = typed;
    field().tell("input");
  };
  const write = async () => {
    labelled(panel.content, "all of them at once").click();
    await settled();
    robot.writes.at(-1)?.take();
    await settled();
  };
  const other = (value) => {
    robot.take([{ path: "a", value }]);
    return load();
  };
  const [writing] = ofClass(panel.content, "writing");
  return { robot, panel, load, field, type, write, other, seen: () => [field().nodeName, field().value, !writing.hidden, row().classList.contains("wrong")] };
}

test("a text that loses its ends of lines, or gets some, is written as it was meant", async () => {
  const { robot, type, write, load, seen } = await shown("x\ny");
  assert.deepEqual(seen(), ["TEXTAREA", '"x\\ny"', false, false]);
  type('"plain"');
  await write();
  assert.deepEqual([robot.values, seen()], [{ a: "plain" }, ["INPUT", "plain", false, false]]);
  await load();
  assert.deepEqual([robot.writes.length, seen()], [1, ["INPUT", "plain", false, false]], "nothing waits to be sent");
});

test("what is typed for a text means the same when somebody else takes or brings its ends of lines", async () => {
  const lines = await shown("x\ny");
  lines.type('"p\\nq"');
  await lines.other("one");
  assert.deepEqual(lines.seen(), ["TEXTAREA", '"p\\nq"', true, false], "a field of one line would drop its ends of lines");
  await lines.write();
  assert.deepEqual(lines.robot.values, { a: "p\nq" });

  const words = await shown("one");
  words.type("hello");
  await words.other("x\ny");
  assert.deepEqual(words.seen(), ["INPUT", "hello", true, false]);
  labelled(words.panel.content, "forget them").click();
  assert.deepEqual(words.seen(), ["TEXTAREA", '"x\\ny"', false, false]);
});

test("what is to be decided and what is answered stands in one box that stays in sight", async () => {
  const { panel } = await shown("one");
  const [box] = ofClass(panel.content, "answers");
  const names = ["writing", "overtaken", "storing", "failure", "said"];
  for (const name of names) assert(ofClass(box, name).length > 0, name);
  assert.equal(all(panel.content, (one) => names.some((name) => one.classList.contains(name)) && one.parentElement !== box && !box.contains(one)).length, 0);
  const rules = readFileSync(new URL("../../src/style/panels.css", import.meta.url), "utf8").split("\n");
  const sticky = rules.filter((rule) => rule.includes("sticky")).map((rule) => rule.slice(0, rule.indexOf(" {")));
  assert.deepEqual(sticky.filter((one) => one.includes("answers")), [".answers"]);
  assert(!sticky.some((one) => names.some((name) => one.includes(`.${name}`))), "two that stick at one place cover each other");
});

test("bars and the list of layers stay the same elements, with what is chosen, while the robot says something", async () => {
  const { robot, panel, load, type, other } = await shown("one");
  const { ask } = robot;
  let layers = ["default", "head"];
  robot.ask = async (one) => ("unstored" in one ? { unstored: { version: robot.version, changes: [{ path: "a", stored: "one" }], layers, creation_only: [] } } : ask.call(robot, one));
  await load();
  const [list, store] = ["layer", "write them into"].map((label) => labelled(panel.content, label));
  const bars = () => ["writing", "overtaken", "storing"].flatMap((name) => all(ofClass(panel.content, name)[0], () => true)).filter((one) => one.nodeName === "BUTTON" || one.nodeName === "SELECT");
  const before = bars();
  assert.deepEqual([before.length, list.options.map((one) => one.value), list.value], [6, layers, "head"], "the last layer unless another one is chosen");
  list.value = "default";
  list.tell("change");
  const { options } = list;
  type("hello");
  await other("two");
  assert.deepEqual([bars(), list.options, list.value, ofClass(panel.content, "storing")[0].textContent.slice(0, 21)], [before, options, "default", "1 parameter in no fil"]);
  layers = ["default", "head", "body"];
  await load();
  assert.deepEqual([bars(), list.options.map((one) => one.value), list.value], [before, layers, "default"]);
  layers = ["head", "body"];
  await load();
  assert.deepEqual([labelled(panel.content, "write them into"), list.value], [store, "body"]);
  panel.close();
});
