// Which outputs panels of robotics take for what they show, without a robot.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

const { ofType, output } = await load("robotics/values.ts");
const { watchBelief } = await load("robotics/others.ts");

const PLACE = "Isometry<f32, Unit<Complex<f32>>, 2>";
const entry = (path, type) => ({ path, type, kind: path.includes(".main_outputs.") ? "main_output" : "additional_output" });

test("the place on the field is the one that is called so, whatever stands before it", () => {
  const entries = [entry("Control.main_outputs.last_ground_to_ground", PLACE), entry("Control.main_outputs.ground_to_field", `Option<${PLACE}>`)];
  const taken = {};
  watchBelief({ set: (name, path) => (taken[name] = path) }, entries, 10);
  assert.equal(taken.believed, "Control.main_outputs.ground_to_field");
});

test("a name counts also with a type of its own, a type where nothing has the name", () => {
  const renamed = [entry("Control.main_outputs.start", PLACE), entry("Control.main_outputs.ground_to_field", "Place")];
  assert.equal(output(renamed, "ground_to_field", PLACE).path, "Control.main_outputs.ground_to_field");
  assert.equal(output([entry("Control.main_outputs.place", PLACE)], "ground_to_field", PLACE).path, "Control.main_outputs.place");
  assert.equal(output([entry("Control.main_outputs.other", "f32")], "ground_to_field", PLACE), undefined);
});

test("of several with the name the one with the type is meant", () => {
  const entries = [
    entry("VisionTop.main_outputs.obstacles", "Vec<ObstacleCandidate>"),
    entry("Control.main_outputs.heard", "Vec<Obstacle>"),
    entry("Control.main_outputs.obstacles", "Vec<Obstacle>"),
  ];
  assert.equal(output(entries, "obstacles", "Vec<Obstacle>").path, "Control.main_outputs.obstacles");
  assert.equal(ofType(entries, "Vec<Obstacle>", "obstacles").path, "Control.main_outputs.obstacles");
  assert.equal(ofType(entries, "Vec<Obstacle>").path, "Control.main_outputs.heard");
});
