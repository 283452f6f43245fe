// Curves of several robots in one plot, with robots that are only played.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

const { Alignment } = await load("store/clock.ts");
const { Curve, kept, lookOfOtherRun, looksOf, nameIn, wantedIn } = await load("panels/curve.ts");

/** What a curve asks of a robot. `clock`: how far it is ahead of the browser's, in seconds. */
class Played {
  listeners = { state: [], welcome: [] };
  watchers = [];

  constructor(clock) {
    this.clock = clock;
    this.state = this.signal("state", "open");
    this.welcome = this.signal("welcome", {});
    this.subscriptions = { watch: (_, watcher) => (this.watchers.push(watcher), () => (this.watchers = this.watchers.filter((one) => one !== watcher))) };
  }

  signal(name, value) {
    const stop = (listener) => (this.listeners[name] = this.listeners[name].filter((one) => one !== listener));
    const signal = { value, watch: (listener) => (this.listeners[name].push(listener), listener(signal.value), () => stop(listener)) };
    return signal;
  }

  set(name, value) {
    this[name].value = value;
    for (const listener of this.listeners[name]) listener(value);
  }

  shiftFrom(other) {
    return (this.alignment ??= new Alignment(this, other));
  }

  async ask() {
    if (this.state.value !== "open") throw new Error("there is no connection to the robot");
    return { value: { time: (performance.now() / 1e3 + this.clock) * 1e9 } };
  }

  /** `time` in seconds of its clock. */
  tell(time, value) {
    for (const watcher of this.watchers) watcher.sample({ time: time * 1e9, value });
  }
}

const answered = () => new Promise((resolve) => setTimeout(resolve, 20));
const known = (at, robot) => ({ at, address: `10.1.24.${at + 1}:4857`, robot });
const near = (one, other) => assert(Math.abs(one - other) < 0.2, `${one} is not near ${other}`);

test("layouts keep whose curves they are, and older ones have those of the panel's robot", () => {
  const paths = ["Control.a", { path: "Control.a", robot: "10.1.24.2:4857" }];
  const wanted = wantedIn({ paths });
  assert.deepEqual(wanted, [{ path: "Control.a" }, { path: "Control.a", robot: "10.1.24.2:4857" }]);
  assert.deepEqual(wanted.map(kept), paths);
  assert.deepEqual(wanted.map(nameIn), ["Control.a", "10.1.24.2:4857 Control.a"]);
  assert.deepEqual(wantedIn({ paths: [7, null, [], {}, { path: 1, robot: "x:1" }, { path: "a" }] }), []);
  for (const broken of [{}, { paths: "Control.a" }, { paths: null }]) assert.deepEqual(wantedIn(broken), []);
});

test("curves of several robots have their robots' colours, and those of one robot strokes of their own", () => {
  const [one, other] = [known(0), known(1)];
  const own = { wanted: { path: "a" }, known: one };
  const theirs = ["a", "b", "c"].map((path) => ({ wanted: { path, robot: other.address }, known: other }));
  const looks = looksOf([own, ...theirs]);
  assert.equal(new Set(looks.slice(1).map(({ color }) => color)).size, 1);
  assert.notEqual(looks[0].color, looks[1].color);
  assert.equal(new Set(looks.slice(1).map(({ dash }) => String(dash))).size, 3);
  assert.deepEqual([looks[0].dash, looks[1].dash], [[], []]);
  const all = [...looks, ...looks.map(lookOfOtherRun)];
  assert.equal(new Set(all.map((look) => JSON.stringify(look))).size, all.length, "another run looks otherwise");
  // Of one robot alone they have colours.
  const alone = looksOf(["a", "b"].map((path) => ({ wanted: { path }, known: one })));
  assert.notEqual(alone[0].color, alone[1].color);
  assert.deepEqual(alone.map(({ dash }) => dash), [[], []]);
});

test("points of another robot lie at their times on the clock of the panel's", async () => {
  const [own, other] = [new Played(100), new Played(40)];
  const curve = new Curve({ path: "a", robot: "x:1" }, known(1, other), own, () => undefined, () => undefined);
  other.tell(1, 5);
  assert.deepEqual(curve.series.times, [], "nobody knows yet where it belongs");
  assert(!curve.isThere);
  await answered();
  assert(curve.isThere);
  other.tell(2, 6);
  near(curve.series.times[0], 62);
  assert.deepEqual(curve.series.values, [6]);
});

test("answers that take long say little: the clocks are not taken for two where they may be one", async () => {
  const [own, other] = [new Played(10), new Played(10)];
  const late = (robot, milliseconds) => {
    const ask = robot.ask.bind(robot);
    robot.ask = async () => {
      const answer = await ask();
      await new Promise((resolve) => setTimeout(resolve, milliseconds));
      return answer;
    };
  };
  late(other, 300);
  const curve = new Curve({ path: "a", robot: "x:1" }, known(1, other), own, () => undefined, () => undefined);
  while (!curve.isThere) await answered();
  other.tell(2, 6);
  assert.deepEqual(curve.series.times, [2]);
});

test("robots of one process have one clock", async () => {
  const [own, other] = [new Played(10), new Played(10.05)];
  const curve = new Curve({ path: "a", robot: "x:1" }, known(1, other), own, () => undefined, () => undefined);
  await answered();
  other.tell(2, 6);
  assert.deepEqual(curve.series.times, [2]);
});

test("a robot that goes away leaves its curve as it was, and comes back behind a gap", async () => {
  const [own, other] = [new Played(100), new Played(100)];
  const curve = new Curve({ path: "a", robot: "x:1" }, known(1, other), own, () => undefined, () => undefined);
  await answered();
  for (const time of [50, 51]) other.tell(time, time);
  other.set("state", "waiting");
  other.set("state", "connecting");
  assert(!curve.isThere);
  assert.deepEqual(curve.series.values, [50, 51, null]);
  // It begins its time anew, at 60 of the panel's robot.
  other.clock = 40;
  other.set("state", "open");
  other.set("welcome", {});
  other.tell(0.5, 1);
  await answered();
  other.tell(1, 2);
  assert.deepEqual(curve.series.values, [50, 51, null, 2]);
  near(curve.series.times[3], 61);
});

test("clocks are held together as long as somebody draws a curve that needs it", async () => {
  const [own, other] = [new Played(100), new Played(40)];
  const draw = () => new Curve({ path: "a", robot: "x:1" }, known(1, other), own, () => undefined, () => undefined);
  const held = () => [own, other].map(({ listeners }) => listeners.welcome.length);
  const curves = [draw(), draw()];
  await answered();
  curves[0].close();
  curves[0].close();
  assert.deepEqual(held(), [1, 1], "the other curve still needs it");
  other.clock = 30;
  other.set("welcome", {});
  await answered();
  other.tell(2, 6);
  near(curves[1].series.times[0], 72);
  curves[1].close();
  assert.deepEqual(held(), [0, 0], "a robot that is no peer any more can be forgotten");
  other.clock = 20;
  const next = draw();
  assert(!next.isThere, "what was known is of another time");
  await answered();
  other.tell(2, 6);
  near(next.series.times[0], 82);
});

test("as long as both runs go on their clocks do, also while they are measured once more", async () => {
  const [own, other] = [new Played(100), new Played(40)];
  for (const [robot, run] of [[own, "a"], [other, "b"]]) robot.set("welcome", { run });
  const curve = new Curve({ path: "a", robot: "x:1" }, known(1, other), own, () => undefined, () => undefined);
  await answered();
  other.set("welcome", { run: "b" });
  other.tell(2, 6);
  near(curve.series.times[0], 62);
  other.clock = 20;
  other.set("welcome", { run: "c" });
  assert(!curve.isThere, "another run has another clock");
  other.tell(3, 6);
  assert.equal(curve.series.times.length, 1);
  await answered();
  other.tell(4, 6);
  near(curve.series.times[1], 84);
  curve.close();
});

test("a restart of the panel's robot ends what belongs to the run before", async () => {
  const [own, other] = [new Played(100), new Played(100)];
  const curve = new Curve({ path: "a", robot: "x:1" }, known(1, other), own, () => undefined, () => undefined);
  await answered();
  other.tell(50, 1);
  // Who says which run it is need not be guessed: clocks of recordings go back within one, and those of later ones may be ahead.
  curve.series.begin(true, 1);
  curve.series.begin(null, 51);
  assert.deepEqual(curve.series.times, [50]);
  curve.series.begin(null, 1);
  assert.deepEqual(curve.series.times, []);
  other.tell(50, 1);
  curve.series.begin(false, 51);
  assert.deepEqual(curve.series.times, []);
  own.clock = 0;
  own.set("welcome", {});
  await answered();
  other.tell(101, 1);
  near(curve.series.times[0], 1);
});

test("what is no number is told as long as it is none, and what is not there is no mistake", () => {
  const own = new Played(0);
  let told = 0;
  const curve = new Curve({ path: "a" }, known(0, own), own, () => undefined, () => told++);
  const failures = [{ Lying: "Up" }, "Upright", [1, 2], 5, null, true, 7n, {}].map((value, at) => {
    own.tell(at, value);
    return curve.failure !== null;
  });
  assert.deepEqual(failures, [true, true, true, false, false, false, false, true]);
  assert.match(curve.failure, /^this is no number/);
  const before = told;
  own.tell(9, {});
  assert.equal(told, before, "once");
  curve.close();
});

test("values that did not come through leave a gap, and are counted", () => {
  const own = new Played(0);
  let told = 0;
  const curve = new Curve({ path: "a" }, known(0, own), own, () => undefined, () => told++);
  for (const time of [1, 2]) own.tell(time, time);
  const before = told;
  own.watchers[0].lost(812);
  own.tell(3, 3);
  assert.deepEqual(curve.series.values, [1, 2, null, 3]);
  assert.equal(curve.missing, 812);
  assert.equal(told, before + 1);
  curve.begin(true, 4);
  assert.equal(curve.missing, 812);
  curve.begin(false, 4);
  assert.deepEqual([curve.missing, told], [0, before + 2], "another run has gaps of its own");
});

test("a robot that the page may not show is told, and nobody is asked", () => {
  const curve = new Curve({ path: "a", robot: "x:1" }, null, new Played(0), () => undefined, () => undefined);
  assert.match(curve.failure, /^x:1 is not among the robots/);
  assert(!curve.isThere);
  curve.close();
});

test("what a closed curve asked for is not told to it", async () => {
  const [own, other] = [new Played(0), new Played(0)];
  const curve = new Curve({ path: "a", robot: "x:1" }, known(1, other), own, () => undefined, () => undefined);
  curve.close();
  await answered();
  assert.equal(other.watchers.length, 0);
});
