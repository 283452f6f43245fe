// Values, curves, images, parameters, injections: what every robot has.
import assert from "node:assert/strict";
import { add, changes, clearLayout, hasCurve, hasPicture, isConnected, open, panel, reads, until } from "../page.mjs";
import { PATIENCE, step } from "../robot.mjs";

const VALUE = "Control.main_outputs.sensor_data";
const NUMBER = "Control.main_outputs.sensor_data.positions.head_pitch";
const IMAGE = "VisionTop.main_outputs.image";
const PARAMETER = "ball_filter.gate";

export async function valuesChange(page) {
  await clearLayout(page);
  await open(page, VALUE, "Value");
  await changes(page, panel(page, "value").locator("output"), "the cycle number");
  await panel(page, "value").getByLabel("open positions").click();
  await panel(page, "value").getByText("head_pitch", { exact: true }).waitFor();
  step("values change");
}

export async function curvesAndImagesMove(page) {
  await open(page, NUMBER, "Plot");
  await until(page, panel(page, "plot").locator("canvas"), hasCurve, "a curve");
  await open(page, IMAGE, "Image");
  await until(page, panel(page, "image").locator("canvas"), hasPicture, "an image");
  await changes(page, panel(page, "image").locator("output"), "the number of the image");
  step("curves and images move");
}

export async function parametersComeBack(page, other, address) {
  await add(page, "Parameters");
  const input = (on) => on.locator(`input[data-path="${PARAMETER}"]`);
  await page.getByLabel("search a parameter").fill(PARAMETER);
  const before = await input(page).inputValue();
  const after = String(Number(before) + 0.25);
  await input(page).fill(after);
  await panel(page, "parameters").getByText("1 change not sent").waitFor();
  await panel(page, "parameters").getByRole("button", { name: /^all of them at once/ }).click();
  await page.locator(".parameter.unstored").waitFor({ timeout: PATIENCE });
  assert.equal(await input(page).inputValue(), after);
  // Another browser asks the robot, not this page.
  await other.goto(address);
  await isConnected(other);
  await other.getByLabel("search a parameter").fill(PARAMETER);
  await input(other).waitFor({ timeout: PATIENCE });
  assert.equal(await input(other).inputValue(), after);
  await input(page).fill("1e999");
  await page.locator(".parameter.wrong").waitFor();
  await input(page).press("Enter");
  const refused = panel(page, "parameters").locator("p.failure", { hasText: `${PARAMETER}: \`1e999\` is no number` });
  await refused.waitFor();
  const origin = page.locator(".parameter", { has: input(page) }).locator(".origin");
  const changed = changes(page, origin, "where the value comes from");
  await input(other).fill(String(Number(after) + 0.25));
  await input(other).press("Enter");
  await changed;
  assert(await refused.isVisible(), "what others do does not take the reason away");
  assert.equal(await input(page).inputValue(), "1e999");
  await page.locator(".parameter .news", { hasText: `now ${Number(after) + 0.25}` }).waitFor();
  await input(page).press("Escape");
  assert.equal(await input(page).inputValue(), String(Number(after) + 0.25));
  await page.getByRole("button", { name: /^take the last write/ }).click();
  const overtaken = panel(page, "parameters").locator(".overtaken", { hasText: `${PARAMETER} is ${Number(after) + 0.25} now` });
  await overtaken.waitFor({ timeout: PATIENCE });
  assert.equal(await input(other).inputValue(), String(Number(after) + 0.25), "what another page wrote is not overwritten unless somebody wants it");
  await overtaken.getByRole("button", { name: /^take the write back in spite/ }).click();
  await overtaken.waitFor({ state: "hidden", timeout: PATIENCE });
  await other.waitForFunction(([path, value]) => document.querySelector(`input[data-path="${path}"]`)?.value === value, [PARAMETER, before], { timeout: PATIENCE });
  step("a parameter comes back from the robot, also to others, and is undone");
}

/** The robot tells its team which number it wears: that follows its parameter in the next cycle. */
export async function aParameterChangesAnOutput(page) {
  await page.getByLabel("search a parameter").fill("player.number");
  const input = page.locator('input[data-path="player.number"]');
  const report = panel(page, "value");
  await report.getByLabel("path", { exact: true }).fill("Control.main_outputs.self_report");
  await report.getByLabel("path", { exact: true }).press("Enter");
  const reading = report.locator('.line:has(> .name[title$=".player_number"]) > .reading');
  await reads(reading, /^1$/, "the number that the robot tells");
  await input.fill("4");
  await input.press("Enter");
  await reads(reading, /^4$/, "the number that the robot tells after the change");
  await page.getByRole("button", { name: /^take the last write/ }).click();
  await reads(reading, /^1$/, "the number that the robot tells after the undo");
  await report.getByLabel("path", { exact: true }).fill(VALUE);
  await report.getByLabel("path", { exact: true }).press("Enter");
  await report.getByLabel("open positions").click();
  step("a changed parameter is seen in an output");
}

export async function injectionsReplaceOutputs(page) {
  const value = panel(page, "value");
  await value.locator("summary", { hasText: "Inject" }).click();
  await value.getByRole("button", { name: "begin with the newest value" }).click();
  const text = value.getByLabel("value to inject");
  const injected = JSON.parse(await text.inputValue());
  injected.positions.head_pitch = 0.123;
  await text.fill(JSON.stringify(injected));
  await value.getByRole("button", { name: /^every reader gets/ }).click();
  const reading = value.locator('.line:has(> .name[title$=".positions.head_pitch"]) > .reading');
  await reads(reading, /^0\.123/, "the injected value");
  const mark = value.locator(".injected-mark");
  await mark.waitFor({ timeout: PATIENCE });
  await value.getByRole("button", { name: /^give the output back/ }).click();
  await reading.filter({ hasNotText: /^0\.123/ }).waitFor({ timeout: PATIENCE });
  await mark.waitFor({ state: "hidden", timeout: PATIENCE });
  step("an injected value takes the place of an output, until it is released");
}
