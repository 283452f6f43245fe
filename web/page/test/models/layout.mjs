// Where panels stand, without panels and without a browser.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

const kept = new Map();
globalThis.localStorage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, text) => kept.set(key, text) };
const { Arrangement, PRESETS, layoutOf, place, read, withOnly } = await load("store/layout.ts");

/** Two columns: a and b, and c. */
function arranged() {
  const arrangement = new Arrangement();
  arrangement.use(layoutOf([3, place("a"), place("b", {}, 2)], [1, place("c")]));
  return arrangement;
}

const kinds = ({ layout }) => layout.value.columns.map(({ panels }) => panels.map(({ kind }) => kind).join(""));
const idOf = ({ layout }, wanted) => layout.value.columns.flatMap(({ panels }) => panels).find(({ kind }) => kind === wanted).id;
const move = (wanted, column, row) => {
  const arrangement = arranged();
  arrangement.move(idOf(arrangement, wanted), { column, row });
  return kinds(arrangement);
};

test("a panel is moved before another one, behind the last, and into a column of its own", () => {
  assert.deepEqual(move("c", 0, 0), ["cab"]);
  assert.deepEqual(move("c", 0, 1), ["acb"]);
  assert.deepEqual(move("c", 0, 2), ["abc"]);
  assert.deepEqual(move("a", 0, 2), ["ba", "c"]);
  assert.deepEqual(move("a", 1, 1), ["b", "ca"]);
  assert.deepEqual(move("a", 2, null), ["b", "c", "a"]);
  assert.deepEqual(move("a", 0, 1), ["ab", "c"], "before its neighbour it stands already");
  const one = new Arrangement();
  one.use(layoutOf([1, place("a"), place("b"), place("c")]));
  one.move(idOf(one, "a"), { column: 0, row: 0 });
  assert.deepEqual(kinds(one), ["abc"], "a panel that is dropped on itself stays");
});

test("a panel that is added stands where there is most place", () => {
  const arrangement = arranged();
  arrangement.add("d");
  assert.deepEqual(kinds(arrangement), ["ab", "cd"]);
  for (const kind of ["a", "b", "c", "d"]) arrangement.remove(idOf(arrangement, kind));
  assert.deepEqual(kinds(arrangement), []);
  for (const kind of ["e", "f"]) arrangement.add(kind);
  assert.deepEqual(kinds(arrangement), ["e", "f"]);
});

test("neighbours share their place, and what they got is kept with everything else", () => {
  const arrangement = arranged();
  arrangement.resize({ column: 0, row: 0 }, [1, 4]);
  arrangement.resize({ column: 0, row: null }, [2, 2]);
  arrangement.configure(idOf(arrangement, "b"), { path: "Control.a" });
  arrangement.assign(idOf(arrangement, "c"), "10.1.24.2:4857");
  const again = new Arrangement().layout.value;
  assert.deepEqual(again.columns.map(({ size }) => size), [2, 2]);
  const panels = again.columns.flatMap(({ panels }) => panels);
  assert.deepEqual(panels.map(({ size }) => size), [1, 4, 1]);
  assert.deepEqual(panels[1].settings, { path: "Control.a" });
  assert.deepEqual(panels.map(({ robot }) => robot), [undefined, undefined, "10.1.24.2:4857"]);
});

test("a layout that a preset has replaced comes back as it was left, and so does the preset", () => {
  const arrangement = arranged();
  assert.equal(arrangement.before.value, null);
  arrangement.back();
  arrangement.configure(idOf(arrangement, "b"), { path: "Control.a" });
  arrangement.replace(layoutOf([1, place("p"), place("q")]));
  arrangement.remove(idOf(arrangement, "q"));
  arrangement.back();
  assert.deepEqual(kinds(arrangement), ["ab", "c"]);
  assert.deepEqual(new Arrangement().layout.value.columns[0].panels[1].settings, { path: "Control.a" }, "the browser keeps it");
  arrangement.back();
  assert.deepEqual(kinds(arrangement), ["p"]);
});

test("a file is a layout or none, and sizes that make no sense are those of others", () => {
  const text = arranged().text();
  assert.deepEqual(read(text).columns.map(({ panels }) => panels.length), [2, 1]);
  for (const broken of [null, "", "7", "[]", "{}", '{"version":2,"columns":[]}', '{"version":1,"columns":[{}]}', '{"version":1,"columns":[{"panels":[{"kind":"a"}]}]}', text.slice(1)]) {
    assert.equal(read(broken), null, broken);
  }
  const sizes = [-1, 0, "2", null, 1e9].map((size) => ({ size, panels: [{ kind: "a", settings: {}, size }] }));
  const { columns } = read(JSON.stringify({ version: 1, columns: sizes }));
  for (const { size, panels } of columns) assert.deepEqual([size, panels[0].size], [1, 1]);
});

test("presets have what they need, and lose what this robot does not have", () => {
  assert.deepEqual(PRESETS.map(({ name }) => name), ["Overview", "Tuning", "Graph", "Replay"]);
  const layout = withOnly(PRESETS[0].layout(), (kind) => kind === "logs");
  assert.deepEqual(layout.columns.map(({ panels }) => panels.map(({ kind }) => kind)), [["logs"]]);
});
