// Points of one curve, without a robot.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

const { incomparable, readCurves, Series } = await load("panels/series.ts");

function drawn(...times) {
  const series = new Series();
  for (const time of times) series.add(time, 10 * time);
  return series;
}

test("a step back in a recording leaves what lies before it", () => {
  const series = drawn(1, 2, 3, 4, 3);
  assert.deepEqual([series.times, series.values], [[1, 2, 3], [10, 20, 30]]);
  series.add(2.5, 7);
  assert.deepEqual([series.times, series.values], [[1, 2, 2.5], [10, 20, 7]]);
  series.add(4, 40);
  assert.deepEqual(series.times, [1, 2, 2.5, 4]);
});

test("a recording that is played backwards still has what lies before", () => {
  const series = drawn(1, 2, 3, 4, 5, 6);
  for (const time of [5, 4, 3]) series.add(time, 10 * time);
  assert.deepEqual(series.times, [1, 2, 3]);
  series.add(0.5, 5);
  assert.deepEqual(series.times, [0.5]);
});

test("the same moment twice is one point", () => {
  assert.deepEqual(drawn(1, 2, 2).times, [1, 2]);
});

test("what is newer than the robot's clock belongs to another run", () => {
  const series = drawn(1, 2, 3);
  series.begin(null, 3.5);
  assert.deepEqual(series.times, [1, 2, 3]);
  series.begin(null, 1.5);
  assert.deepEqual(series.times, []);
});

test("a file of curves may have come through a program that ends lines with two characters", () => {
  const curves = readCurves("time,a,b\r\n1,10,20\r\n2,,30\r\n");
  assert.deepEqual([...curves].map(([name, { times, values }]) => [name, times, values]), [["a", [1], [10]], ["b", [1, 2], [20, 30]]]);
});

test("a file of which nothing can be compared says what it has", () => {
  const curves = readCurves("time,a,b\n1,10,20");
  assert.equal(incomparable(curves, ["b", "c"]), null);
  assert.equal(incomparable(curves, ["c"]), "nothing of this file is in this plot: add one of a, b");
  assert.match(incomparable(readCurves("no,curves"), ["a"]), /^this file has no curves/);
});
