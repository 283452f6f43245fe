// Compares what the page reads with what the reference read: `node decode.mjs CORPUS`. Used by a test of the framework.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { load } from "./load.mjs";

const { decode, Malformed } = await load("connection/binary.ts");
const { readJson, writeJson } = await load("connection/exact.ts");

/** As JSON, which has no infinities; numbers of 32 bits are written with fewer digits than they have as 64. */
function same(one, other) {
  if (typeof one === "number" && !Number.isFinite(one)) return other === null;
  if (typeof one === "number" && typeof other === "number") return one === other || Math.fround(one) === Math.fround(other);
  if (one === null || other === null || typeof one !== "object" || typeof other !== "object") return one === other;
  if (Array.isArray(one) !== Array.isArray(other)) return false;
  const keys = Object.keys(one);
  return keys.length === Object.keys(other).length && keys.every((key) => key in other && same(one[key], other[key]));
}

let count = 0;
for (const line of readFileSync(process.argv[2], "utf8").split("\n").filter((text) => text !== "")) {
  const { layout, bytes } = JSON.parse(line);
  const { value } = readJson(line);
  let read;
  try {
    read = decode(layout, Uint8Array.from(Buffer.from(bytes, "hex")), Infinity);
  } catch (error) {
    assert(error instanceof Malformed, error);
    assert(value === undefined, `it refuses what the reference reads: ${error}: ${line}`);
    count += 1;
    continue;
  }
  assert(value !== undefined, `it reads what the reference refuses: ${line}`);
  assert(same(read, value), `${writeJson(read)}\n${writeJson(value)}`);
  count += 1;
}
console.log(`${count} read`);
