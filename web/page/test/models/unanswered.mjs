// Writes whose answers are lost with the connection, with a robot that is only played: it may have taken them.
import assert from "node:assert/strict";
import test from "node:test";
import { settled, tuned, Unheard } from "../tuning.mjs";

const RUN = (run) => ({ value: { run } });

/** A panel that has written `b`, and then `texts`, which the robot has taken or not when the connection is lost. */
async function lost(texts, isTaken, { held = (value) => value, c = 1, reason = new Unheard("the connection to the robot was lost") } = {}) {
  const all = await tuned({ a: 1, b: 1, c });
  const { robot, tuning, type } = all;
  Object.assign(robot, { welcome: RUN("one"), held });
  const write = async (deed) => {
    const done = deed();
    await settled();
    robot.writes.at(-1).take();
    await done;
    await tuning.load();
  };
  type("b", "2");
  await write(() => tuning.write());
  for (const [path, text] of Object.entries(texts)) type(path, text);
  const written = tuning.write();
  await settled();
  const { changes, refuse } = robot.writes.at(-1);
  if (isTaken) robot.take(changes);
  refuse(reason);
  await assert.rejects(written, reason);
  robot.welcome = RUN("one");
  const undo = async () => {
    await write(() => tuning.undo());
    return robot.writes.at(-1).changes;
  };
  return { ...all, undo };
}

test("a write that was taken before the connection was lost waits no more, and is the one that Undo takes back", async () => {
  const { tuning, pending, undo } = await lost({ a: "2", c: "3" }, true);
  assert.match(await tuning.load(), /has taken the write/);
  assert.deepEqual([pending(), tuning.canUndo], [[], true]);
  assert.equal(await tuning.load(), undefined, "and that is told once");
  assert.deepEqual(await undo(), [{ path: "a", value: 1 }, { path: "c", value: 1 }]);
  assert.deepEqual(await undo(), [{ path: "b", value: 1 }]);
});

test("a write that was not taken waits to be sent, and Undo takes back the one before", async () => {
  const { robot, tuning, pending, undo } = await lost({ a: "2" }, false);
  await tuning.load();
  assert.deepEqual(pending(), [["a", "2"]]);
  // It comes late: the network had it.
  robot.take([{ path: "a", value: 2 }]);
  await tuning.load();
  assert.deepEqual(pending(), []);
  assert.deepEqual(await undo(), [{ path: "a", value: 1 }]);
});

test("what was typed while the connection was lost is no change by somebody else", async () => {
  const { tuning, type, pending, undo } = await lost({ a: "2", c: "2" }, true);
  type("a", "3");
  await tuning.load();
  assert.deepEqual([pending(), tuning.isChangedMeanwhile("a")], [[["a", "3"]], false]);
  assert.deepEqual(await undo(), [{ path: "a", value: 1 }, { path: "c", value: 1 }]);
});

test("a value that the robot holds with fewer digits is the one whose answer was lost", async () => {
  const { tuning, pending, undo } = await lost({ a: "0.1", c: "[0.2]" }, true, { c: [1], held: (value) => (Array.isArray(value) ? value.map(Math.fround) : Math.fround(value)) });
  await tuning.load();
  assert.deepEqual(pending(), []);
  assert.deepEqual(await undo(), [{ path: "a", value: 1 }, { path: "c", value: [1] }]);
});

test("a write over which somebody has written, and one of another run, is none that Undo takes back", async () => {
  const over = await lost({ a: "2", c: "2" }, true);
  over.robot.take([{ path: "c", value: 7 }]);
  await over.tuning.load();
  assert.deepEqual([over.pending(), over.tuning.isChangedMeanwhile("c")], [[["c", "2"]], true], "the robot has a, and somebody else wrote c");
  assert.deepEqual(await over.undo(), [{ path: "b", value: 1 }]);

  const other = await lost({ a: "2" }, true);
  other.robot.welcome = RUN("two");
  await other.tuning.load();
  assert.deepEqual(other.pending(), []);
  assert.deepEqual(await other.undo(), [{ path: "b", value: 1 }]);
});

test("a write that could not be sent, and one that another was answered after, is none that somebody else's value is taken for", async () => {
  const unsent = await lost({ a: "2" }, false, { reason: new Error("there is no connection to the robot") });
  unsent.robot.take([{ path: "a", value: 2 }]);
  await unsent.tuning.load();
  assert.deepEqual(await unsent.undo(), [{ path: "b", value: 1 }]);

  const { robot, tuning, type, undo } = await lost({ a: "2" }, false);
  type("a", "3");
  const written = tuning.write();
  await settled();
  robot.writes.at(-1).take();
  await written;
  robot.take([{ path: "a", value: 2 }]);
  await tuning.load();
  await tuning.undo();
  assert.deepEqual(tuning.overtaken.value.map(({ path, now }) => [path, now]), [["a", 2]], "somebody else wrote it");
  await tuning.undo("keep");
  assert.deepEqual(await undo(), [{ path: "b", value: 1 }]);
});

test("what somebody else writes as it is typed here waits no more to be sent", async () => {
  const { robot, tuning, type, pending } = await tuned({ a: 1 });
  type("a", "2");
  robot.take([{ path: "a", value: 2 }]);
  await tuning.load();
  assert.deepEqual([pending(), tuning.canUndo], [[], false]);
});
