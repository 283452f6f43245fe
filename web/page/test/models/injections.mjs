// What is injected and released, with a robot that is only played: it answers when the test says so.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

const { Injection } = await load("store/injection.ts");

function played() {
  const asked = [];
  const robot = { ask: (ask) => new Promise((resolve, reject) => asked.push({ ask, answer: () => resolve({ done: {} }), refuse: reject })) };
  const names = () => asked.map(({ ask }) => Object.entries(ask).map(([name, { path }]) => `${name} ${path}`)[0]);
  return { injection: new Injection(robot), asked, names };
}

const settled = () => new Promise((resolve) => setTimeout(resolve, 0));

test("an injection whose answer comes after its panel was closed is released", async () => {
  const { injection, asked, names } = played();
  const injected = injection.inject("A.main_outputs.x", 1);
  await settled();
  injection.close();
  asked[0].answer();
  await injected;
  await settled();
  assert.deepEqual(names(), ["inject A.main_outputs.x", "release A.main_outputs.x"]);
  asked[1].answer();
  await settled();
  assert.equal(injection.path.value, null);
});

test("one that was refused, or that was never made, is not released", async () => {
  const { injection, asked, names } = played();
  injection.close();
  const injected = injection.inject("A.main_outputs.x", 1);
  await settled();
  injection.close();
  asked[0].refuse(new Error("no"));
  await assert.rejects(injected, /no/);
  await settled();
  assert.deepEqual(names(), ["inject A.main_outputs.x"]);
});

test("another output takes the place of the one before", async () => {
  const { injection, asked, names } = played();
  const first = injection.inject("A.main_outputs.x", 1);
  const second = injection.inject("A.main_outputs.y", 2);
  for (let at = 0; at < 3; at++) {
    await settled();
    asked[at].answer();
  }
  await Promise.all([first, second]);
  assert.deepEqual(names(), ["inject A.main_outputs.x", "release A.main_outputs.x", "inject A.main_outputs.y"]);
  assert.equal(injection.path.value, "A.main_outputs.y");
});
