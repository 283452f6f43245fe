// The hand in a simulated world, with a world that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { labelled, ofClass, opened, settled, tick } from "../dom.mjs";
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

/** With the canvas 100 px for a metre. */
async function held() {
  const { panel, deeds } = played();
  tick();
  await settled();
  const canvas = labelled(panel.content, "the simulated world");
  Object.assign(canvas, { clientWidth: 1040, clientHeight: 740 });
  const tell = (type, x, y, more = {}) => canvas.tell(type, { type, pointerId: 1, button: 0, offsetX: 520 + 100 * x, offsetY: 370 - 100 * y, ...more });
  return { panel, deeds, tell };
}

test("a drag puts the ball down once", async () => {
  const { panel, deeds, tell } = await held();
  tell("pointerdown", 1, 0);
  tell("pointermove", 2, 1);
  tell("pointerup", 2, 1);
  tell("pointermove", 3, 1);
  tell("pointerup", 3, 1);
  assert.equal(deeds.length, 1);
  const [x, y] = deeds[0].ball;
  assert(Math.hypot(x - 2, y - 1) < 0.1, `${x} ${y}`);
  panel.close();
});

test("a drag that the browser takes away puts nothing down, and is over", async () => {
  const { panel, deeds, tell } = await held();
  tell("pointerdown", 1, 0);
  tell("pointermove", 2, 1);
  tell("pointercancel", 2, 1);
  tell("pointermove", 3, 1);
  tell("pointerup", 3, 1);
  tell("pointerdown", 1, 0, { button: 2 });
  tell("pointermove", 3, 1);
  tell("pointerup", 3, 1);
  assert.deepEqual(deeds, []);
  panel.close();
});

test("other buttons move the world, also where something is under them", async () => {
  const { panel, deeds, tell } = await held();
  tell("pointerdown", 1, 0, { button: 1 });
  tell("pointermove", 2, 0);
  tell("pointerup", 2, 0);
  tell("pointerdown", 2, 0);
  tell("pointermove", 2, 1);
  tell("pointerup", 2, 1);
  assert.equal(deeds.length, 1);
  const [x, y] = deeds[0].ball;
  assert(Math.hypot(x - 1, y - 1) < 0.1, `the ball was shown at 2 m: ${x} ${y}`);
  panel.close();
});

test("the same penalty is given twice", async () => {
  const { panel, deeds } = played();
  const penalties = labelled(panel.content, "the referee takes");
  for (let time = 0; time < 2; time++) {
    penalties.value = "PlayerPushing";
    penalties.tell("change");
    assert.equal(penalties.value, "penalise …");
  }
  await settled();
  assert.deepEqual(deeds, [{ penalise: "PlayerPushing" }, { penalise: "PlayerPushing" }]);
  panel.close();
});
