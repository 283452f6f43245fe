// A value as a tree, without a browser.
import assert from "node:assert/strict";
import test from "node:test";
import { ofClass } from "../dom.mjs";
import { load } from "../load.mjs";

const { Branch, decode, json, number } = await load("panels/tree.ts", "connection/binary.ts", "view/format.ts", "robotics/geometry.ts");

const names = (branch) => ofClass(branch.element, "name").map(({ textContent }) => textContent);
const rest = (branch) => ofClass(branch.element, "muted").filter(({ hidden }) => !hidden).map(({ textContent }) => textContent);

test("what is not shown of a long list is said", () => {
  const branch = new Branch("list", "list", true);
  branch.show(Array.from({ length: 5000 }, (_, at) => at));
  assert.equal(names(branch).length, 201);
  assert.deepEqual(rest(branch), ["and 4800 more"]);
  branch.show([1, 2]);
  assert.deepEqual([names(branch), rest(branch)], [["list", "0", "1"], []]);
  branch.show(Object.fromEntries(Array.from({ length: 201 }, (_, at) => [`key ${at}`, at])));
  assert.deepEqual([names(branch).length, rest(branch)], [201, ["and 1 more"]]);
});

test("what is said of the rest stands behind the parts", () => {
  const branch = new Branch("list", "list", true);
  branch.show([]);
  branch.show(Array.from({ length: 201 }, (_, at) => at));
  const list = branch.element.children[1];
  assert.equal(list.children.at(-1).textContent, "and 1 more");
});

test("numbers that JSON does not have are shown as what they are, and are no places", () => {
  const bytes = Buffer.alloc(29);
  bytes.writeFloatLE(NaN, 0);
  bytes.writeFloatLE(Infinity, 4);
  bytes.writeDoubleLE(-Infinity, 8);
  bytes.writeUInt8(5, 16);
  bytes.writeDoubleLE(NaN, 17);
  bytes.writeFloatLE(1.5, 25);
  const layouts = [{ kind: "float", bits: 32 }, { kind: "float", bits: 32 }, { kind: "float", bits: 64 }, { kind: "any" }, { kind: "float", bits: 32 }];
  const value = decode({ root: { kind: "tuple", items: layouts } }, Uint8Array.from(bytes));
  const branch = new Branch("value", "value", true);
  branch.show(value);
  const readings = ofClass(branch.element, "reading").slice(1);
  assert.deepEqual(readings.map(({ textContent }) => textContent), ["NaN", "inf", "-inf", "NaN", "1.50000"]);
  assert(readings.every((one) => !one.classList.contains("none")));
  assert.deepEqual(JSON.parse(json(value)), [null, null, null, null, 1.5], "as text it is JSON");
  assert.deepEqual(value.map(number), [null, null, null, null, 1.5]);
});
