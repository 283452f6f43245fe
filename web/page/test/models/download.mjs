// How a text is handed to the user as a file.
import assert from "node:assert/strict";
import test from "node:test";
import { tick } from "../dom.mjs";
import { load } from "../load.mjs";

const { download } = await load("view/dom.ts");

test("a file is there for a while after it was handed over, for browsers that read it late", async () => {
  const files = new Map();
  URL.createObjectURL = (file) => (files.set("blob:1", file), "blob:1");
  URL.revokeObjectURL = (address) => files.delete(address);
  download("plot.csv", "time\n", "text/csv");
  assert.equal(await files.get("blob:1").text(), "time\n");
  tick();
  assert.equal(files.size, 0, "and not for ever");
});
