// What lists do when a connection comes back, to the same run of a robot or to another one, with a robot that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { all, labelled, ofClass, opened, settled, signal } from "../dom.mjs";
import { load } from "../load.mjs";

globalThis.localStorage = { getItem: () => null, setItem: () => undefined };
globalThis.window.dispatchEvent = () => undefined;
globalThis.Event = class {};
const { Sidebar, header, procedures, Paths, Refused } = await load("view/sidebar.ts", "view/header.ts", "panels/procedures.ts", "store/paths.ts", "connection/socket.ts");

const folder = (path) => ({ path, kind: "folder", has_children: true });
const number = (path, type = "f32") => ({ path, kind: "main_output", type, has_children: false });
const procedure = (path, type = "Step") => ({ path, kind: "procedure", type, request: type, has_children: false });

/** A robot with these entries, and what is asked of it; `failure`: why it does not answer. */
function played(...entries) {
  const world = { entries, failure: null, schema: { type: "number" } };
  const { context, robot, asked } = opened((ask) => {
    if (world.failure !== null) throw world.failure;
    if ("schema" in ask) return { schema: world.schema };
    const { below, depth } = ask.paths;
    const found = world.entries.filter(({ path }) => (below === "" ? depth > 1 || !path.includes(".") : path.startsWith(`${below}.`)));
    return { paths: found };
  });
  robot.state.set("connecting");
  robot.welcome.set(null);
  robot.paths = new Paths((ask) => robot.ask(ask));
  const connect = async (run, isForgetting = true) => {
    robot.state.set("waiting");
    if (isForgetting) robot.paths.forget();
    robot.welcome.set({ time: 0, run, robot: "robot", target: "simulated" });
    robot.state.set("open");
    for (let turn = 0; turn < 3; turn++) await settled();
  };
  return { world, context, robot, asked, connect };
}

const LOST = new Error("the connection to the robot was lost");

test("paths that are open and chosen stay the same lines on another connection, and with another run as far as it has them", async () => {
  const { world, robot, asked, connect } = played(folder("Control"), number("Control.one"), number("Control.two"));
  const sidebar = new Sidebar(robot, {});
  const lines = () => ofClass(sidebar.element, "line");
  const paths = () => lines().map((line) => line.getAttribute("data-path"));
  const selected = () => ofClass(sidebar.element, "selected").map((line) => line.getAttribute("data-path"));
  await connect("a");
  labelled(sidebar.element, "open Control").click();
  await settled();
  const before = lines();
  ofClass(before[2], "name")[0].click();
  const count = asked.length;
  await connect("a");
  assert.deepEqual([lines(), selected(), asked.length], [before, ["Control.two"], count]);

  world.entries = [folder("Control"), number("Control.one", "f64"), number("Control.three"), number("Control.two")];
  await connect("b");
  assert.deepEqual(paths(), ["Control", "Control.one", "Control.three", "Control.two"]);
  assert.deepEqual([lines()[0], lines()[3], selected()], [before[0], before[2], ["Control.two"]]);
  assert.notEqual(lines()[1], before[1], "it is of another type");
  assert.equal(labelled(sidebar.element, "open Control").getAttribute("aria-expanded"), "true");
  ofClass(lines()[1], "name")[0].click();
  assert.deepEqual(selected(), ["Control.one"]);
  world.entries = [folder("Control"), number("Control.one")];
  await connect("c");
  assert.deepEqual([paths(), selected()], [["Control", "Control.one"], ["Control.one"]]);
});

test("paths that did not come are asked for on the next connection to the same run", async () => {
  const { world, robot, connect } = played(folder("Control"), number("Control.one"));
  const sidebar = new Sidebar(robot, {});
  const paths = () => ofClass(sidebar.element, "line").map((line) => line.getAttribute("data-path"));
  world.failure = LOST;
  await connect("a");
  world.failure = null;
  await connect("a");
  assert.deepEqual(paths(), ["Control"]);
  world.failure = LOST;
  labelled(sidebar.element, "open Control").click();
  await settled();
  assert.equal(ofClass(sidebar.element, "failure")[0].textContent, LOST.message);
  world.failure = null;
  await connect("a");
  assert.deepEqual([paths(), ofClass(sidebar.element, "failure")[0].hidden], [["Control", "Control.one"], true]);
});

test("what is typed for a procedure stays, and one that another program takes otherwise has another field", async () => {
  const { world, context, asked, connect } = played(procedure("Control.walk"), procedure("Control.kick"));
  const panel = procedures.open(context);
  const field = (name) => labelled(panel.content, `argument of Control.${name}`);
  await connect("a");
  const [walk, kick] = [field("walk"), field("kick")];
  const count = asked.length;
  await connect("a");
  assert.deepEqual([field("walk"), field("kick"), asked.length], [walk, kick, count]);
  world.entries = [procedure("Control.kick", "Kick"), procedure("Control.walk")];
  world.schema = { type: "string" };
  await connect("b");
  assert.equal(field("walk"), walk);
  assert.notEqual(field("kick"), kick);
  assert.match(walk.placeholder, /for example ""/, "of what the type has become");
  world.entries = [];
  await connect("c");
  assert.match(panel.content.textContent, /this robot has no procedures/);
  panel.close();
});

test("an example of an argument that did not come is asked for again, one that there is none of is not", async () => {
  const { world, context, asked, connect } = played(procedure("Control.walk"));
  const { ask } = context.robot;
  let failure = LOST;
  context.robot.ask = async (one) => {
    const answer = await ask(one);
    if ("schema" in one && failure !== null) throw failure;
    return answer;
  };
  const panel = procedures.open(context);
  const schemas = () => asked.filter((one) => "schema" in one).length;
  await connect("a");
  await connect("a");
  assert.equal(schemas(), 2);
  failure = new Refused({ message: "it has no schema" });
  await connect("a");
  await connect("a");
  assert.equal(schemas(), 3);
  failure = null;
  await connect("b");
  assert.match(labelled(panel.content, "argument of").placeholder, /for example 0/);
  world.failure = null;
  panel.close();
});

/** The line above everything, of a robot that may be offered the field. */
function headed() {
  const theirs = played(number("Control.main_outputs.ball", "Ball"));
  const known = signal([{ address: "a:1", at: 0, isOwn: true, robot: theirs.robot }]);
  const added = [];
  const arrangement = { before: signal(null), add: (kind) => added.push(kind), replace: (layout) => added.push(layout) };
  const element = header({ own: theirs.robot, known }, arrangement);
  const item = (name) => labelled(element, name);
  const names = () => all(element, (one) => (one.getAttribute("aria-label") ?? "").startsWith("add a panel: ")).map((one) => one.textContent);
  return { ...theirs, element, known, added, item, names };
}

test("panels that are offered stay the same items, and those about football where the question for them failed", async () => {
  const { world, connect, asked, item, names, added } = headed();
  await connect("a");
  assert(names().includes("Field"));
  const [plot, count] = [item("add a panel: Plot"), asked.length];
  await connect("a");
  assert.equal(asked.length, count);
  world.failure = LOST;
  await connect("b");
  assert(names().includes("Field"), "the robot did not say that it has none");
  world.failure = null;
  world.entries = [];
  await connect("b");
  assert.deepEqual([names().includes("Field"), item("add a panel: Plot")], [false, plot]);
  plot.click();
  assert.deepEqual(added, ["plot"]);
});

test("panels that every robot has are offered where the first question for paths fails", async () => {
  const { world, connect, names } = headed();
  world.failure = LOST;
  await connect("a");
  assert.deepEqual([names().includes("Plot"), names().includes("Field")], [true, false]);
  world.failure = null;
  await connect("a");
  assert(names().includes("Field"));
});

test("of robots that were gone and are there again, the menu shows the connections that there are now", async () => {
  const { element, known, robot } = headed();
  const menu = all(element, (one) => one.nodeName === "DETAILS" && one.textContent.startsWith("Robots"))[0];
  const other = (state) => ({ address: "b:1", at: 1, isOwn: false, robot: { ...played().robot, state: signal(state) } });
  const own = { address: "a:1", at: 0, isOwn: true, robot };
  const open = (isOpen) => {
    menu.open = isOpen;
    menu.tell("toggle");
  };
  const states = () => ofClass(menu, "of-one").map((one) => one.textContent);
  known.set([own, other("waiting")]);
  open(true);
  assert.equal(states()[1], "not there, trying again …");
  open(false);
  known.set([own]);
  known.set([own, other("open")]);
  open(true);
  assert.equal(states()[1], "connected");
});
