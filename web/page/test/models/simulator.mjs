// The hand in a simulated world, with a world that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { all, labelled, ofClass, opened, settled, tick } from "../dom.mjs";
import { load } from "../load.mjs";

const { simulator } = await load("robotics/simulator.ts");

const TRUTH = { x: 0, y: 0, heading: 0, ball: { x: 1, y: 0 }, robots: [], walked: 0, tilt: 0 };

/** `refusal`: why the world does nothing. */
function played(refusal = null) {
  const deeds = [];
  const answer = ({ call }) => {
    if (call.path === "framework.procedures.truth") return { called: TRUTH };
    if (call.path === "framework.procedures.speed") return { called: 1 };
    deeds.push(call.argument);
    if (refusal !== null) throw new Error(refusal);
    return { called: null };
  };
  const paths = { find: async (path) => (path.endsWith(".speed") ? { path } : undefined) };
  const { context } = opened(answer, { paths });
  return { panel: simulator.open(context), deeds };
}

test("why the world did not do something stays until the next deed", async () => {
  const { panel } = played("no game is played");
  labelled(panel.content, "somebody whistles").click();
  for (let turn = 0; turn < 25; turn++) {
    await settled();
    tick();
  }
  assert.equal(ofClass(panel.content, "failure")[0].textContent, "no game is played");
  panel.close();
});
