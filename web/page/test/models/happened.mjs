// Marks on the time of a recording, without a recording.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { load } from "../load.mjs";

const { lanesOf, kindsOf } = await load("panels/happened.ts");

const EVENTS = [
  { instance: "VisionTop", from: 12, to: 12, what: "unfinished" },
  { instance: "Control", from: 10, to: 15, what: "missing" },
  { instance: "VisionTop", from: 20, to: 20, what: "restarted" },
];

test("an unfinished cycle has a mark of its own at its time", () => {
  const [vision, control] = lanesOf(EVENTS, 10, 20);
  assert.equal(vision.instance, "VisionTop");
  assert.deepEqual(vision.marks[0], { what: "unfinished", about: "VisionTop: the cycle failed or was abandoned, 12.000 s", time: 12, left: 20, width: 0 });
  assert.deepEqual(vision.marks.map(({ what, left }) => [what, left]), [["unfinished", 20], ["restarted", 100]]);
  assert.deepEqual(control.marks, [{ what: "missing", about: "Control: cycles are missing, 10.000 s to 15.000 s", time: 10, left: 0, width: 50 }]);
});

test("the key explains what there is, and every kind has a look", () => {
  assert.deepEqual(kindsOf(EVENTS), ["missing", "unfinished", "restarted"]);
  assert.deepEqual(kindsOf([]), []);
  const style = readFileSync(new URL("../../src/style/time.css", import.meta.url), "utf8");
  for (const kind of ["unfinished", "restarted", "parameters"]) assert.match(style, new RegExp(`\\.event\\.${kind} \\{[^}]*background: var`), kind);
});

test("a recording of one instant has its marks", () => {
  const [{ marks }] = lanesOf([{ instance: "Control", from: 3, to: 3, what: "unfinished" }], 3, 3);
  assert.deepEqual([marks[0].left, marks[0].width], [0, 0]);
});
