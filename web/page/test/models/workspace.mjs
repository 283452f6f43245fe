// Where panels stand while the layout and the list of robots change, with robots that are only played.
import assert from "node:assert/strict";
import test from "node:test";
import { all, labelled, ofClass, opened, signal } from "../dom.mjs";
import { load } from "../load.mjs";

const kept = new Map();
globalThis.localStorage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, text) => kept.set(key, text) };
globalThis.ResizeObserver = class {
  observe() {}
  disconnect() {}
};
const { Workspace, Arrangement, layoutOf, place } = await load("view/workspace.ts", "store/layout.ts");

/** What has been taken out of its place, until now. */
const touched = [];
const { remove } = Node.prototype;
Node.prototype.remove = function () {
  if (this.parentElement !== null && this.getAttribute?.("class") != null) touched.push(this);
  remove.call(this);
};

function played() {
  return opened(() => ({ done: {} }), { subscriptions: { watch: () => () => undefined }, shiftFrom: () => signal(0) }).robot;
}

/** Robots at these addresses, the first of which has served the page, and panels of them. */
function shown(layout, ...addresses) {
  const robots = new Map();
  const named = (...all) => all.map((address, at) => {
    if (!robots.has(address)) robots.set(address, played());
    return { address, at, isOwn: address === addresses[0], robot: robots.get(address) };
  });
  const known = signal(named(...addresses));
  const arrangement = new Arrangement();
  arrangement.use(layout);
  const find = (address = addresses[0]) => known.value.find((one) => one.address === address) ?? null;
  const workspace = new Workspace({ known, find }, arrangement);
  const frames = () => all(workspace.element, (one) => one.classList.contains("panel"));
  touched.length = 0;
  return { workspace, arrangement, robots, frames, kinds: () => ofClass(workspace.element, "column").map((column) => ofClass(column, "panel").map((one) => one.getAttribute("data-kind"))), meet: (...all) => known.set(named(...all)) };
}

const value = (robot) => place("value", {}, 1, robot);

test("panels and lines that stay are not touched when others come, go, and get more place", () => {
  const { workspace, arrangement, frames, kinds } = shown(layoutOf([1, value(), place("plot"), value()], [1, place("image")]), "a:1");
  const [first, second, third] = frames();
  arrangement.add("plot");
  arrangement.resize({ column: 0, row: 0 }, [1.5, 0.5]);
  arrangement.resize({ column: 0, row: null }, [1.2, 0.8]);
  assert.deepEqual(touched, []);
  assert.equal(first.style.flexGrow, "1.5");
  labelled(second, "close this panel").click();
  assert.deepEqual(frames().slice(0, 2), [first, third]);
  assert.deepEqual(touched.filter((one) => one.classList.contains("panel")), [second]);
  touched.length = 0;
  const { id } = arrangement.layout.value.columns[0].panels[1];
  arrangement.move(id, { column: 2, row: null });
  assert.deepEqual(kinds(), [["value"], ["image", "plot"], ["value"]]);
  assert.deepEqual(touched.filter((one) => one.classList.contains("panel")), [third]);
  assert.equal(ofClass(workspace.element, "upright").length, 2, "a line between two columns each");
});

test("an empty page says so until a panel is added", () => {
  const { workspace, arrangement } = shown(layoutOf(), "a:1");
  assert.equal(ofClass(workspace.element, "empty").length, 1);
  arrangement.add("value");
  assert.equal(ofClass(workspace.element, "empty").length, 0);
});

test("of other robots than before only those panels begin anew that show them, or whose robot is another one or there at last", () => {
  const { frames, meet, robots } = shown(layoutOf([1, value(), value("b:1"), value("c:1"), place("plot")]), "a:1", "b:1");
  const before = frames();
  const stays = () => frames().map((frame, at) => frame === before[at]);
  assert.deepEqual(before.map((one) => one.dataset.robot), ["A", "B", undefined, "A"]);
  meet("a:1", "aa:1", "b:1", "c:1");
  assert.deepEqual(stays(), [true, true, false, false]);
  assert.deepEqual(frames().map((one) => one.dataset.robot), ["A", "C", "D", "A"]);
  const names = () => frames().map((one) => labelled(one, "which robot")?.options.map((option) => option.textContent.slice(-4)));
  assert.deepEqual(names()[1], ["\u00a0a:1", "aa:1", "\u00a0b:1", "\u00a0c:1"]);
  robots.set("b:1", played());
  meet("a:1", "b:1");
  assert.deepEqual(stays(), [true, false, false, false]);
  meet("a:1");
  assert.deepEqual([stays()[0], frames()[0].dataset.robot, names()[0]], [true, undefined, undefined], "there is nothing to choose");
  assert.match(frames()[1].textContent, /^Valueno robot.*b:1 is not among the robots/);
});
