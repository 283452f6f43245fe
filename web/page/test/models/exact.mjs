// Integers that JavaScript's numbers cannot hold, without a robot.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

const { readJson, readMessages, writeJson } = await load("connection/exact.ts");
const { decode } = await load("connection/binary.ts");
const { brief } = await load("panels/tree.ts");

const SEED = "11400714819323198485";

test("every digit of an integer comes back as it was", () => {
  for (const text of [SEED, "-9223372036854775808", "9007199254740993", `{"a":[1,${SEED},0.5],"b":{"c":-${SEED}}}`, '"x"', "[]", "{}", "null"]) {
    assert.equal(writeJson(readJson(text)), text);
  }
  assert.deepEqual(readJson("[9007199254740991, 1e20, 123456789012345678.0, 0.12345678901234567]"), [9007199254740991, 1e20, 123456789012345678, 0.12345678901234567]);
});

test("texts are not taken for numbers", () => {
  for (const text of [`"${SEED}"`, `["integer ${SEED}",${SEED}]`, `{"\\"${SEED}":"a\\\\"}`, `"integer 1"`]) assert.equal(writeJson(readJson(text)), text);
  for (const broken of [`{${SEED}}`, `${SEED} 1`, `0${SEED}`, `[${SEED}`]) assert.throws(() => readJson(broken), SyntaxError, broken);
});

test("a text beside a long integer may have megabytes, and escapes", () => {
  for (const part of ["x".repeat(20 << 20), '\\"'.repeat(8 << 20), "\\\\".repeat(8 << 20)]) {
    const [integer, read] = readJson(`[${SEED},"${part}"]`);
    assert.equal(integer, BigInt(SEED));
    assert(JSON.stringify(read) === `"${part}"`);
  }
});

test("no text is taken for an integer, however it is escaped", () => {
  assert.deepEqual(readJson(`["\\u0069nteger 12", "\\u0069nteger abc", ${SEED}]`), ["integer 12", "integer abc", BigInt(SEED)]);
  assert.deepEqual(readJson(`["\\\\", ${SEED}, "\\"", "\\\\\\" ${SEED}", -${SEED}]`), ["\\", BigInt(SEED), '"', `\\" ${SEED}`, -BigInt(SEED)]);
});

test("what is written for people is as the browser writes it", () => {
  for (const value of [{ a: [1, { b: "ü\n" }], c: [], d: {}, e: null, f: true }, [], "x", 1.5]) {
    assert.equal(writeJson(value, 2), JSON.stringify(value, null, 2));
    assert.equal(writeJson(value), JSON.stringify(value));
  }
  assert.equal(writeJson({ a: undefined, b: Uint8Array.of(1, 2), c: Number.NaN }), '{"b":[1,2],"c":null}');
});

test("values have all digits, and what is counted stays a number", () => {
  const [update, answer] = readMessages(`[{"update":{"subscription":1,"cycle":2,"time":${SEED},"value":{"time":${SEED}}}},{"answer":{"id":1,"ok":{"value":{"time":${SEED},"value":${SEED}}}}}]`);
  assert.equal(typeof update.update.time, "number");
  assert.equal(update.update.value.time, BigInt(SEED));
  assert.equal(typeof answer.answer.ok.value.time, "number");
  assert.equal(answer.answer.ok.value.value, BigInt(SEED));
  const parameters = `{"answer":{"id":1,"ok":{"parameters":{"value":{"seed":${SEED}},"version":7,"leaves":[]}}}}`;
  assert.equal(readMessages(parameters)[0].answer.ok.parameters.value.seed, BigInt(SEED));
  const [{ log }] = readMessages(`{"log":{"number":1,"time":${SEED},"fields":{"seed":${SEED},"all":[${SEED}]}}}`);
  assert.deepEqual([typeof log.time, log.fields], ["number", { seed: BigInt(SEED), all: [BigInt(SEED)] }]);
});

test("values as bytes have all digits, too, and are shown with them", () => {
  const bytes = new Uint8Array(16);
  const view = new DataView(bytes.buffer);
  view.setBigUint64(0, BigInt(SEED), true);
  view.setBigInt64(8, -7n, true);
  const items = [{ kind: "unsigned", bits: 64 }, { kind: "signed", bits: 64 }];
  const value = decode({ root: { kind: "tuple", items } }, bytes);
  assert.deepEqual(value, [BigInt(SEED), -7]);
  assert.equal(brief(value), `[${SEED}, -7]`);
});
