// What a driven robot is asked for, with a robot that is only played: it answers when the test says so.
import assert from "node:assert/strict";
import test from "node:test";
import { all, labelled, opened, settled as later } from "../dom.mjs";
import { load } from "../load.mjs";

const { Driver, drive } = await load("robotics/driver.ts", "robotics/drive.ts");

function driven(test) {
  const [asked, said] = [[], []];
  const robot = { ask: ({ call }) => new Promise((resolve, reject) => asked.push({ ...call, answer: (called) => resolve({ called }), refuse: reject })) };
  const driver = new Driver(robot, { share: () => 1, held: () => undefined, state: (text) => said.push(text), failed: () => undefined });
  Object.assign(driver, { walk: "walk", motion: "motion" });
  test.after(() => driver.forget(""));
  return { driver, asked, said, paths: () => asked.map(({ path }) => path) };
}

const settled = () => new Promise((resolve) => setTimeout(resolve, 0));

test("a robot that does not answer is asked for one step, however long and whatever is held", async (test) => {
  const { driver, asked, paths } = driven(test);
  driver.hold("w");
  driver.hold("a");
  driver.hold("d");
  driver.release("d");
  await new Promise((resolve) => setTimeout(resolve, 600));
  assert.deepEqual(paths(), ["walk"]);
  asked[0].answer({});
  await settled();
  assert.deepEqual(asked.slice(1).map(({ path, argument }) => [path, argument]), [["walk", { forward: 0.06, left: 0.04, turn: 0 }]], "what is held by now");
});

test("a robot that does not answer for longer than it remembers is said to stop, until it answers", async (test) => {
  const { driver, asked, said, paths } = driven(test);
  driver.hold("w");
  asked[0].answer({ forward: 0.06 });
  await new Promise((resolve) => setTimeout(resolve, 1500));
  assert.deepEqual(said, ["driving: 6.0 cm ahead, 0.0 cm left, 0° a step"]);
  await new Promise((resolve) => setTimeout(resolve, 1300));
  assert.equal(said.at(-1), "the robot does not answer: it stops by itself");
  assert.deepEqual(paths(), ["walk", "walk"], "and nothing is behind the question");
  asked[1].answer({ forward: 0.05 });
  await settled();
  assert.equal(said.at(-1), "driving: 5.0 cm ahead, 0.0 cm left, 0° a step");
  assert.deepEqual(paths(), ["walk", "walk", "walk"]);
});

test("nothing is behind the wish to stand, also where a step is answered after it", async (test) => {
  const { driver, asked, said, paths } = driven(test);
  driver.hold("w");
  driver.hold("a");
  driver.release("a");
  driver.release("w");
  asked[0].answer({});
  await settled();
  asked[1].answer(1);
  await new Promise((resolve) => setTimeout(resolve, 300));
  assert.deepEqual(paths(), ["walk", "motion"]);
  assert.deepEqual(said, ["standing", "Stand"]);
});

test("steps go on after one that was refused, and with each period while something is held", async (test) => {
  const { driver, asked, paths } = driven(test);
  driver.hold("w");
  asked[0].refuse(new Error("it has fallen"));
  await new Promise((resolve) => setTimeout(resolve, 300));
  assert.deepEqual(paths(), ["walk", "walk"]);
  driver.letGo();
  driver.letGo();
  assert.deepEqual(paths(), ["walk", "walk", "motion"]);
});

test("a connection is said to be lost from when it goes until it is back, and not before there was one", async () => {
  const paths = { everything: async () => [{ path: "Control.procedures.walk", kind: "procedure", request: "Step" }] };
  const { context, robot } = opened(({ call }) => ({ called: call.argument }), { paths });
  robot.state.set("connecting");
  robot.welcome.set(null);
  const panel = drive.open(context);
  const said = () => all(panel.content, (one) => one.nodeName === "OUTPUT")[0].textContent;
  robot.state.set("waiting");
  assert.equal(said(), "not driving");
  const connect = async () => {
    robot.welcome.set({ time: 0 });
    robot.state.set("open");
    await later();
  };
  await connect();
  labelled(panel.content, "ahead").tell("pointerdown", { pointerId: 1 });
  await later();
  assert.match(said(), /^driving: 4\.2 cm ahead/);
  for (const state of ["waiting", "connecting"]) {
    robot.state.set(state);
    assert.equal(said(), "the connection is lost: the robot stops by itself");
  }
  await connect();
  assert.equal(said(), "not driving");
  labelled(panel.content, "ahead").tell("pointerdown", { pointerId: 2 });
  await later();
  robot.state.set("open");
  assert.match(said(), /^driving: /, "what it does is not taken back");
  panel.close();
});
