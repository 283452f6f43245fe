// Writes that are taken back while others write, too, with a robot that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";
import { Refused, settled, tuned } from "../tuning.mjs";

const { overtakenText } = await load("panels/parameter_text.ts");

/** A panel that has written these texts, each by itself. `sent`: what it has sent since then. */
async function written(values, ...texts) {
  const all = await tuned(values);
  const { robot, tuning, type } = all;
  const answered = async (deed) => {
    const before = robot.writes.length;
    const done = deed();
    await settled();
    if (robot.writes.length > before) robot.writes.at(-1).take();
    await done;
    await tuning.load();
  };
  for (const one of texts) {
    for (const [path, text] of Object.entries(one)) type(path, text);
    await answered(() => tuning.write());
  }
  const count = robot.writes.length;
  const told = () => tuning.overtaken.value.map(({ path, now }) => [path, now]);
  return { ...all, told, undo: (choice) => answered(() => tuning.undo(choice)), sent: () => robot.writes.slice(count).map(({ changes }) => changes) };
}

/** What another page does. */
const other = (robot, path, value) => robot.take([{ path, value }]);

test("what another page has written since is told and not overwritten, until somebody wants it", async () => {
  const { robot, tuning, undo, told, sent } = await written({ a: 1, b: 1 }, { a: "2" }, { a: "3", b: "2" });
  other(robot, "a", 7);
  await undo();
  assert.deepEqual(sent(), [], "nobody has heard of the other page's write before");
  assert.deepEqual(told(), [["a", 7]]);
  assert.equal(overtakenText(tuning.overtaken.value), "not taken back: what was written here is not there any more\na is 7 now (live, version 4), not 3 as it was written here; before that it was 2");
  await undo();
  assert.deepEqual(sent(), [], "pressed twice, it is no consent");
  await undo("overwrite");
  assert.deepEqual(sent(), [[{ path: "a", value: 2 }, { path: "b", value: 1 }]]);
  assert.deepEqual(told(), []);
  await undo();
  assert.deepEqual([robot.values, tuning.canUndo], [{ a: 1, b: 1 }, false], "and the write before is undone");
});

test("what somebody else has written may be kept: the rest of the write is taken back", async () => {
  const { robot, tuning, undo, told, sent } = await written({ a: 1, b: 1, c: 1 }, { a: "2" }, { b: "2", c: "2" });
  other(robot, "b", 7);
  await undo();
  await undo("keep");
  assert.deepEqual(sent(), [[{ path: "c", value: 1 }]]);
  other(robot, "a", 8);
  await undo();
  assert.deepEqual(told(), [["a", 8]]);
  await undo("keep");
  assert.deepEqual([robot.values, sent().length, told(), tuning.canUndo], [{ a: 8, b: 7, c: 1 }, 1, [], false], "nothing is left of it");
});

test("to overwrite is wanted of the value that was told, and not of one that came since", async () => {
  const { robot, tuning, undo, told, sent } = await written({ a: 1 }, { a: "2" });
  other(robot, "a", 7);
  await undo();
  other(robot, "a", 8);
  await undo("overwrite");
  assert.deepEqual([sent(), told()], [[], [["a", 8]]]);
  other(robot, "a", 9);
  await tuning.load();
  assert.deepEqual(told(), [["a", 9]], "it is told what is there now");
  other(robot, "a", 2);
  await tuning.load();
  assert.deepEqual(told(), [], "nothing is in the way any more");
  await undo();
  assert.deepEqual(sent(), [[{ path: "a", value: 1 }]]);
});

test("what was taken back of a write after it does not make another page's value one from here", async () => {
  const { robot, undo, told, sent } = await written({ a: 1, b: 1 }, { a: "2", b: "2" }, { a: "3" });
  other(robot, "b", 7);
  await undo();
  assert.deepEqual([sent(), robot.values], [[[{ path: "a", value: 2 }]], { a: 2, b: 7 }]);
  await undo();
  assert.deepEqual([sent().length, told()], [1, [["b", 7]]], "nothing is sent");
  await undo("keep");
  assert.deepEqual(robot.values, { a: 1, b: 7 });
});

test("another write from here is the one that is taken back next", async () => {
  const { robot, tuning, type, undo, told } = await written({ a: 1, b: 1 }, { a: "2" });
  other(robot, "a", 7);
  await undo();
  type("b", "2");
  const done = tuning.write();
  await settled();
  robot.writes.at(-1).take();
  await done;
  assert.deepEqual(told(), []);
  await undo();
  assert.deepEqual([robot.values, told()], [{ a: 7, b: 1 }, []]);
});

test("a value that the robot holds with fewer digits is the one that was written", async () => {
  const { robot, tuning, undo, told, sent } = await written({ a: 1, b: 1 });
  robot.held = Math.fround;
  for (const text of ["0.1", "0.2"]) {
    tuning.note(tuning.tuned.value.parameters[0], { text, value: Number(text) });
    const done = tuning.write();
    await settled();
    robot.writes.at(-1).take();
    await done;
  }
  // It is heard of together with what somebody else has written elsewhere.
  other(robot, "b", 5);
  await undo();
  await undo();
  assert.deepEqual([told(), sent().slice(2).map(([{ value }]) => value)], [[], [0.1, 1]]);
});

test("of another run what its files say is told", async () => {
  const { robot, undo, told, sent } = await written({ a: 1 }, { a: "2" });
  // Its versions are counted anew, and one of them has the same number.
  Object.assign(robot, { welcome: { value: { run: "b" } }, version: 2, values: { a: 1.5 }, versions: {} });
  await undo();
  assert.deepEqual([sent(), told()], [[], [["a", 1.5]]]);
});

test("what another page has written below a value that was written whole is told", async () => {
  const { robot, find, tuning, undo, told, sent } = await written({ x: null }, { x: '{"y":1}' });
  assert.deepEqual([tuning.tuned.value.parameters.map(({ path }) => path), find("x.y").leaf.provenance], [["x.y"], { from: "live", version: 2 }]);
  other(robot, "x.y", 2);
  await undo();
  assert.deepEqual([sent(), told()], [[], [["x", { y: 2 }]]]);
  assert.equal(tuning.overtaken.value[0].provenance.version, 3);
  await undo("overwrite");
  assert.deepEqual([robot.values, told()], [{ x: null }, []]);
});

test("what another page has written in place of what a value was in is told", async () => {
  const { robot, undo, told, sent } = await written({ "x.y": 1 }, { "x.y": "2" });
  other(robot, "x", null);
  await undo();
  assert.deepEqual([sent(), told()], [[], [["x.y", null]]]);
});

test("nothing is asked of what is as it was before already, and the write before is taken back", async () => {
  const { robot, tuning, undo, told, sent } = await written({ a: 1, b: 1, c: 1 }, { c: "2" }, { a: "2", b: "2" });
  other(robot, "a", 1);
  await undo();
  assert.deepEqual([sent(), told()], [[[{ path: "b", value: 1 }]], []], "a is 1 again");
  await undo();
  assert.deepEqual([robot.values, tuning.canUndo], [{ a: 1, b: 1, c: 1 }, false]);
});

test("after a restart there is nothing to take back where everything is as it was before", async () => {
  const { robot, tuning, undo, told, sent } = await written({ a: 1, b: 1 }, { b: "2" }, { a: "2" });
  Object.assign(robot, { welcome: { value: { run: "b" } }, version: 1, values: { a: 1, b: 2 }, versions: {} });
  await undo();
  assert.deepEqual([sent(), told()], [[[{ path: "b", value: 1 }]], []], "the files have b from here: that is what is left");
  assert.equal(tuning.canUndo, false);
  const again = await written({ a: 1 }, { a: "2" });
  Object.assign(again.robot, { version: 3, values: { a: 1 }, versions: {} });
  assert.match(await again.tuning.undo(), /^nothing was sent/);
  assert.deepEqual([again.sent(), again.told(), again.tuning.canUndo], [[], [], false]);
});

test("what was chosen for a write that is back by itself is not so for the one before", async () => {
  for (const choice of ["overwrite", "keep"]) {
    const { robot, tuning, undo, told, sent } = await written({ a: 1, b: 1 }, { b: "2" }, { a: "2" });
    other(robot, "a", 7);
    await undo();
    assert.deepEqual(told(), [["a", 7]]);
    other(robot, "a", 1);
    await undo(choice);
    assert.deepEqual([sent(), told(), tuning.canUndo], [[], [], true], choice);
  }
});

test("a value that cannot go back does not take the others of its write out of Undo", async () => {
  const { robot, tuning, undo } = await written({ a: null, b: 1, c: 1 }, { c: "2" }, { a: "2", b: "2" });
  const attempt = async (...refusals) => {
    const undone = tuning.undo();
    await settled();
    robot.writes.at(-1).refuse(new Refused({ message: "no", refusals }));
    return undone.then(() => "done", ({ message }) => message);
  };
  assert.equal(await attempt({ path: "a", message: "null is no number" }), "this cannot be taken back, and the next Undo gives back the rest of that write: a: null is no number");
  await undo();
  assert.deepEqual([robot.values, robot.writes.at(-1).changes], [{ a: 2, b: 1, c: 2 }, [{ path: "b", value: 1 }]]);
  for (const path of ["", "elsewhere"]) {
    const { robot, tuning, sent } = await written({ a: 1, b: 1 }, { a: "2", b: "2" });
    const undone = tuning.undo();
    await settled();
    robot.writes.at(-1).refuse(new Refused({ message: "no", refusals: [{ path, message: "no" }] }));
    await assert.rejects(undone, /^Error: the last write cannot be taken back/);
    assert.deepEqual([sent().length, tuning.canUndo], [1, false], "it is not known which one it is");
  }
});
