// A value as a tree, without a browser.
import assert from "node:assert/strict";
import test from "node:test";
import { ofClass } from "../dom.mjs";
import { load } from "../load.mjs";

const { Branch } = await load("panels/tree.ts");

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
