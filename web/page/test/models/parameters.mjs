// What is typed for parameters and sent, with a robot that is only played: it answers when the test says so.
import assert from "node:assert/strict";
import test from "node:test";
import { ofClass } from "../dom.mjs";
import { load } from "../load.mjs";
import { Refused, settled, tuned } from "../tuning.mjs";

const { ParameterRow } = await load("panels/parameter_row.ts");
const { keyOf, shapeOf, stepped } = await load("panels/parameter_text.ts");

test("of what cannot be read nothing is sent, also not its beginning", async () => {
  const { robot, tuning, type } = await tuned({ a: 2, b: 5 });
  for (const text of ["3", "3.", "3.5", "3.5e"]) type("a", text);
  type("b", "6");
  await assert.rejects(tuning.write(), /a: `3.5e` is no number/);
  assert.equal(robot.writes.length, 0);
  type("a", "3.5e1");
  const written = tuning.write();
  await settled();
  assert.deepEqual(robot.writes[0].changes, [{ path: "a", value: 35 }, { path: "b", value: 6 }]);
  robot.writes[0].take();
  await written;
});

test("what is typed while the robot answers stays, and what was sent is shown at once", async () => {
  const { robot, tuning, type, value, pending } = await tuned({ a: 2, b: 5, c: 1 });
  type("a", "3");
  type("c", "2");
  const written = tuning.write();
  await settled();
  type("b", "0.123");
  type("c", "4");
  robot.writes[0].take();
  await written;
  assert.deepEqual(pending(), [["c", "4"], ["b", "0.123"]]);
  assert.deepEqual(["a", "b", "c"].map(value), [3, 5, 2], "before everything is asked for again");
});

test("writes that follow each other quickly are undone one by one", async () => {
  const { robot, tuning, type, value } = await tuned({ a: 1 });
  const all = ["2", "2", "3"].map((text) => {
    type("a", text);
    return tuning.write();
  });
  await settled();
  assert.equal(robot.writes.length, 1, "the next one waits for the answer");
  robot.writes[0].take();
  await settled();
  robot.writes[1].take();
  await Promise.all(all);
  assert.deepEqual(robot.writes.map(({ changes }) => changes[0].value), [2, 3], "and what was sent is not sent again");
  for (const expected of [2, 1]) {
    const undone = tuning.undo();
    await settled();
    robot.writes.at(-1).take();
    await undone;
    assert.equal(value("a"), expected);
  }
  assert(!tuning.canUndo);
});

test("an answer of before a write does not bring the old value back", async () => {
  const { robot, tuning, type, value } = await tuned({ a: 1 });
  let go;
  robot.slow = new Promise((resolve) => (go = resolve));
  const loaded = tuning.load();
  type("a", "2");
  const written = tuning.write();
  await settled();
  robot.writes[0].take();
  await written;
  go();
  await loaded;
  assert.equal(value("a"), 2);
  // Another run counts its versions from the beginning.
  Object.assign(robot, { welcome: { value: {} }, version: 1, values: { a: 7 } });
  await tuning.load();
  assert.equal(value("a"), 7);
  // A replay goes back to earlier ones.
  Object.assign(robot, { version: 0, values: { a: 6 } });
  await tuning.load();
  assert.equal(value("a"), 6);
});

test("an undo that the robot refuses is not in the way of the one before", async () => {
  const { robot, tuning, type } = await tuned({ a: 1, b: 1 });
  for (const path of ["a", "b"]) {
    type(path, "2");
    const written = tuning.write();
    await settled();
    robot.writes.at(-1).take();
    await written;
  }
  const attempt = async (error) => {
    const undone = tuning.undo();
    await settled();
    robot.writes.at(-1).refuse(error);
    await assert.rejects(undone);
    return robot.writes.at(-1).changes[0].path;
  };
  assert.equal(await attempt(new Error("the connection to the robot was lost")), "b");
  assert.equal(await attempt(new Refused({ message: "authenticate first" })), "b", "it may be taken back once somebody has the token");
  assert.equal(await attempt(new Refused({ message: "no", refusals: [{ path: "b", message: "there is no such parameter" }] })), "b");
  const undone = tuning.undo();
  await settled();
  assert.deepEqual(robot.writes.at(-1).changes, [{ path: "a", value: 1 }]);
  robot.writes.at(-1).take();
  await undone;
});

test("what was typed for a parameter that went away is told and not sent", async () => {
  const { robot, tuning, type, pending } = await tuned({ a: 1, "mode.Blink": 3 });
  type("a", "77");
  type("mode.Blink", "4");
  robot.values = { a: 1, mode: "Off" };
  assert.match(await tuning.load(), /mode\.Blink/);
  assert.deepEqual(pending(), [["a", "77"]]);
});

test("types stay where the question for them fails once, and are not those of another run", async () => {
  const { robot, tuning } = await tuned({ a: "x" });
  const entry = { path: "parameters.a", type: "Option<String>" };
  const shown = async () => {
    await tuning.load();
    const [parameter] = tuning.tuned.value.parameters;
    return [parameter.entry, shapeOf(parameter).read("").value];
  };
  robot.paths.everything = async () => [entry];
  assert.deepEqual(await shown(), [entry, null]);
  robot.paths.everything = async () => {
    throw new Refused({ message: "not now" });
  };
  assert.deepEqual(await shown(), [entry, null], "an empty field is `None` as before");
  robot.welcome = { value: {} };
  assert.deepEqual(await shown(), [undefined, ""]);
  const everything = async () => [entry];
  const nothing = robot.paths.everything;
  for (const [run, ask, expected] of [["a", everything, entry], ["a", nothing, entry], ["b", nothing, undefined]]) {
    robot.welcome = { value: { run } };
    robot.paths.everything = ask;
    assert.equal((await shown())[0], expected, `types of run ${run}, on another connection`);
  }
});

test("integers have all their digits when they are written and taken back", async () => {
  const seed = 11400714819323198485n;
  const { robot, tuning, type, value } = await tuned({ seed });
  type("seed", "11400714819323198486");
  const written = tuning.write();
  await settled();
  assert.equal(robot.writes[0].changes[0].value, seed + 1n);
  robot.writes[0].take();
  await written;
  const undone = tuning.undo();
  await settled();
  robot.writes[1].take();
  await undone;
  assert.equal(value("seed"), seed);
  assert.equal(stepped("11400714819323198485", 1, seed), "11400714819323198486");
});

const parameter = (value, entry) => ({ path: "a", value, entry: { type: "f32", ...entry } });
const read = (one, text) => {
  const draft = shapeOf(one).read(text);
  return "value" in draft ? draft.value : draft.wrong;
};

test("a number says why it is none, and what its range is", () => {
  const one = parameter(1, { range: { minimum: 0, maximum: 100, is_half_open: true } });
  assert.equal(read(one, " 12 "), 12);
  assert.equal(read(one, "120"), "120 is not within 0 … < 100");
  assert.match(read(one, "100"), /not within/);
  for (const text of ["", "x", "1e999", "NaN", "Infinity"]) assert.match(read(parameter(1), text), /no number/, text);
  assert.match(read(parameter([1], { type: "Vec<f32>" }), "[1,"), /^this is no JSON: /);
});

test("what may be none can be made none, and something again", () => {
  for (const value of [5, null]) {
    const number = parameter(value, { type: "Option<f32>" });
    assert.deepEqual([read(number, ""), read(number, "null"), read(number, "2.5")], [null, null, 2.5]);
    assert.equal(shapeOf(number).write(null), "");
  }
  for (const value of ["x", null]) {
    const words = shapeOf(parameter(value, { type: "Option<String>" }));
    assert.deepEqual(words.read(""), { text: "", value: null });
    for (const text of ["", '"quoted"', "plain", "null"]) assert.equal(words.read(words.write(text)).value, text, "every text can be typed");
  }
  for (const value of [true, null]) {
    const flag = shapeOf(parameter(value, { type: "Option<bool>" }));
    for (const one of [null, true, false]) assert.equal(flag.read(flag.write(one)).value, one);
  }
  const choice = shapeOf(parameter("Left", { type: "Option<Side>", choices: ["Left", "Right"] }));
  assert.deepEqual(choice.choices, ["", "Left", "Right"]);
  assert.equal(choice.read("").value, null);
  assert.deepEqual(shapeOf(parameter("Left", { type: "Side", choices: ["Left", "Right"] })).choices, ["Left", "Right"]);
  // Whatever robots call a number of their own.
  assert.equal(read(parameter(5, { type: "Option<Angle>" }), ""), null);
  assert.equal(read(parameter(null, { type: "Option<Angle>" }), "5"), 5);
  assert.match(read(parameter(5, { type: "f32" }), ""), /no number/);
});

test("a field is made anew where the type, the range or the unit is another, and stays where only the value is", () => {
  const one = parameter(1, { range: { minimum: 0, maximum: 1 }, unit: "m" });
  assert.equal(keyOf(one), keyOf({ ...one, value: 0.5 }));
  assert.equal(keyOf(parameter(null, { type: "Option<f32>" })), keyOf(parameter(1, { type: "Option<f32>" })));
  for (const other of [{ range: { minimum: 0, maximum: 2 } }, { unit: "cm" }, { type: "f64" }, { documentation: "new" }]) {
    assert.notEqual(keyOf(one), keyOf({ ...one, entry: { ...one.entry, ...other } }), JSON.stringify(other));
  }
  assert.notEqual(keyOf(one), keyOf({ ...one, value: "text" }));
});

test("a step changes the last digit that stands there, and none before it", () => {
  const steps = (text, ...directions) => directions.map((direction) => (text = stepped(text, direction, Number(text))));
  assert.deepEqual(steps("0.98", 1, 1, 1), ["0.99", "1.00", "1.01"]);
  assert.deepEqual(steps("1.5e-7", 1, -1), ["1.6e-7", "1.5e-7"], "and not 1");
  assert.deepEqual(steps("2E3", 1), ["3E3"]);
  assert.deepEqual(steps(" 1.5 ", 1), ["1.6"]);
  assert.deepEqual(steps("-0.1", 1, 1), ["0.0", "0.1"]);
  assert.deepEqual(steps("7", -1, 1), ["6", "7"]);
  assert.equal(stepped("9007199254740991", 1, 9007199254740991), "9007199254740992");
  for (const text of ["0x10", `0.${"0".repeat(101)}1`]) assert.equal(stepped(text, 1, Number(text)), null, text);
});

test("a text of several lines has its lines when it is written", () => {
  for (const type of ["String", "Option<String>"]) {
    for (const text of ["one\ntwo", "one\r\ntwo\n"]) {
      const shape = shapeOf(parameter(text, { type }));
      assert.doesNotMatch(shape.write(text), /[\r\n]/, "what a field of one line would drop");
      assert.equal(shape.read(shape.write(text)).value, text);
    }
  }
  assert.equal(shapeOf(parameter("one", { type: "String" })).kind, "words");
});

test("a number that JSON cannot say is told, and no text that looks like one", () => {
  const one = parameter(null, { range: { minimum: 0 } });
  const shape = shapeOf(one);
  assert.deepEqual([shape.kind, shape.empty, shape.write(null)], ["number", "inf or NaN", ""]);
  assert.deepEqual([read(one, "2"), read(one, "")], [2, "there is no number"]);
  assert.match(read(one, "-1"), /not within/);
  assert.equal(shapeOf(parameter(1)).empty, undefined);
  assert.notEqual(keyOf(one), keyOf({ ...one, value: 1 }), "the field of a number says nothing of it");
  assert.deepEqual(["Option<f32>", "Option<String>"].map((type) => shapeOf(parameter(null, { type })).empty), ["none", "none"]);
});

test("an integer is sent with the digits that were typed, or not at all", () => {
  const one = parameter(1, { type: "u64" });
  for (const text of ["9007199254740993.0", "1e19", "9.007199254740993e15"]) assert.match(read(one, text), /not all digits/, text);
  assert.deepEqual(["9007199254740993", "1e3", "9007199254740991"].map((text) => read(one, text)), [9007199254740993n, 1000, 9007199254740991]);
  assert.equal(read(parameter(1, { type: "f64" }), "1e19"), 1e19);
});

test("what somebody else writes while one types is told beside what was typed, and what is written from here is not", async () => {
  const { robot, tuning, type, find } = await tuned({ a: 1, b: 1 });
  const row = new ParameterRow(find("a"), {});
  const news = async () => {
    await tuning.load();
    row.show(find("a"), tuning.pending.value.get("a"), tuning.isChangedMeanwhile("a"));
    return ofClass(row.element, "news")[0].textContent;
  };
  const other = (value) => robot.take([{ path: "a", value }]);
  other(2);
  assert.equal(await news(), "", "nothing was typed");
  type("a", "3");
  robot.take([{ path: "b", value: 7 }]);
  assert.equal(await news(), "");
  other(5);
  assert.equal(await news(), "now 5 ");
  type("a", "3.5");
  assert.equal(await news(), "now 5 ", "also while one goes on");
  const written = tuning.write();
  await settled();
  type("a", "4");
  robot.held = Math.fround;
  robot.writes[0].take();
  await written;
  assert.equal(await news(), "", "3.5 is from here");
  other(6);
  assert.equal(await news(), "now 6 ");
  tuning.discard("a");
  assert.equal(await news(), "");
  type("a", "8");
  assert.equal(await news(), "", "whoever types now has seen it");
});

/** A parameter of the files' value 1, with this one written from here; what is typed meanwhile stays. */
async function writtenHere(text, meanwhile) {
  const all = await tuned({ a: 1 });
  const answered = async (done) => {
    await settled();
    if (meanwhile !== undefined) all.type("a", meanwhile);
    all.robot.writes.at(-1).take();
    await done;
  };
  const isNews = async () => {
    await all.tuning.load();
    return all.tuning.isChangedMeanwhile("a");
  };
  if (text === "1") all.robot.take([{ path: "a", value: 4 }]);
  await all.tuning.load();
  all.type("a", text);
  await answered(all.tuning.write());
  return { ...all, answered, isNews, origin: () => all.find("a").leaf.provenance.from, other: (value) => all.robot.take([{ path: "a", value }]) };
}

test("what is taken back or reloaded from here while something is typed is no news, though the robot says the files have it", async () => {
  for (const deed of ["undo", "reload"]) {
    const { tuning, type, value, answered, isNews, origin, other } = await writtenHere("2");
    type("a", "3");
    await (deed === "undo" ? answered(tuning.undo()) : tuning.reload());
    assert.deepEqual([await isNews(), value("a"), origin()], [false, 1, "file"], deed);
    other(5);
    assert.equal(await isNews(), true, deed);
  }
});

test("what was typed behind an own write has no news when that is stored, or is what the files say", async () => {
  for (const text of ["2", "1"]) {
    const { tuning, pending, isNews, origin } = await writtenHere(text, "9");
    if (text === "2") await tuning.store("default");
    assert.deepEqual([await isNews(), origin(), pending()], [false, "file", [["a", "9"]]], text);
  }
});

test("what other pages reload, write as the files say or write behind a reload from here is news", async () => {
  const deeds = [({ robot }) => robot.ask({ reload: {} }), ({ other }) => other(1)];
  for (const deed of deeds) {
    const all = await writtenHere("2", "3");
    await deed(all);
    assert.equal(await all.isNews(), true);
  }
  const { robot, tuning, isNews, other } = await writtenHere("2", "3");
  const answer = robot.ask.bind(robot);
  robot.ask = async (ask) => {
    const answered = await answer(ask);
    if ("reload" in ask) other(6);
    return answered;
  };
  await tuning.reload();
  assert.equal(await isNews(), true);
});
