// Panels about football: driving, the simulated world, the map.
import assert from "node:assert/strict";
import { ask, begin, changes, hasPicture, panel, reads, until } from "../page.mjs";
import { PATIENCE, step } from "../robot.mjs";

const HOME = { kidnap: [-2.0, -1.0, 0.5] };
const BEFORE_THE_BALL = { kidnap: [2.0, 0.0, 0.0], ball: [3.0, 0.3] };

async function call(page, path, argument) {
  return (await ask(page, { call: { path, argument } })).called;
}

/** A robot that fell on a busy machine gets up by itself in about ten seconds; a hand that comes sooner only lets it fall again. */
const UNTIL_THE_HAND = 25_000;

const putOnItsFeet = (page, disturbance) => call(page, "framework.procedures.disturb", disturbance);

/** Looks for what a robot shows only on its feet: while it does not, somebody puts it there, again and again. */
async function onItsFeet(page, disturbance, look) {
  const again = setInterval(() => putOnItsFeet(page, disturbance).catch(() => undefined), UNTIL_THE_HAND);
  await look(4 * UNTIL_THE_HAND).finally(() => clearInterval(again));
}

const drives = (page, state, pattern) => onItsFeet(page, HOME, (patience) => reads(state, pattern, "what the robot says of its steps", patience));

/** Whether it stands once the key is let go: one that falls just then refuses that, too. */
async function isDrivenAhead(page, state) {
  await page.keyboard.down("w");
  await drives(page, state, /^driving: [1-9]/);
  await page.keyboard.up("w");
  await state.filter({ hasText: /^(standing|Stand)/ }).waitFor();
  return state.filter({ hasText: /^Stand/ }).waitFor({ timeout: PATIENCE / 4 }).then(() => true, () => false);
}

export async function theRobotIsDriven(page) {
  await putOnItsFeet(page, HOME);
  await begin(page, "Motion");
  await until(page, panel(page, "pose").locator("canvas"), hasStrokes, "a body");
  const drive = panel(page, "drive");
  const state = drive.locator("output");
  await drive.locator(".drive").focus();
  let attempts = 1;
  while (!(await isDrivenAhead(page, state))) assert(++attempts <= 4, "the robot does not stand after the key was let go");
  // A person who looks elsewhere drives no more.
  await page.keyboard.down("a");
  await drives(page, state, /^driving/);
  await page.evaluate(() => window.dispatchEvent(new Event("blur")));
  await reads(state, /^(standing|Stand)/, "the motion after the window was left");
  await page.keyboard.up("a");
  await drive.getByRole("button", { name: /^give the body back/ }).click();
  step("the robot is driven by keys, and stands when nobody holds one");
}

export async function theWorldIsChanged(page) {
  await begin(page, "Game");
  const simulator = panel(page, "simulator");
  const canvas = simulator.locator("canvas");
  await reads(simulator.locator("output").first(), /walked/, "what is told of the world");
  await until(page, panel(page, "map").locator("canvas"), hasStrokes, "a map");
  const truth = () => call(page, "framework.procedures.truth", null);
  const box = await canvas.boundingBox();
  const scale = Math.min(box.width / 10.4, box.height / 7.4);
  const toPixel = (x, y) => [box.x + box.width / 2 + x * scale, box.y + box.height / 2 - y * scale];
  const before = await truth();
  await page.mouse.move(...toPixel(before.ball.x, before.ball.y));
  await page.mouse.down();
  await page.mouse.move(...toPixel(-2, 2), { steps: 5 });
  await page.mouse.up();
  const since = Date.now();
  for (;;) {
    const { ball } = await truth();
    if (Math.hypot(ball.x + 2, ball.y - 2) < 0.3) break;
    assert(Date.now() - since < PATIENCE, `the ball lies at ${JSON.stringify(ball)}`);
    await page.waitForTimeout(200);
  }
  // On its feet, where there is something to be seen.
  await putOnItsFeet(page, BEFORE_THE_BALL);
  await changes(page, panel(page, "camera").locator("output").first(), "the number of the camera's image");
  const sees = (canvas, judge, what) => onItsFeet(page, BEFORE_THE_BALL, (patience) => until(page, canvas, judge, what, patience));
  await sees(panel(page, "camera").locator(".stage canvas").first(), hasPicture, "the camera's image");
  await sees(panel(page, "camera").locator("canvas.over"), hasStrokes, "what lies over the image");
  // Not in every image is something seen that goes on beside it.
  for (let look = 0; look < 10; look++, await page.waitForTimeout(100)) {
    const spilt = await panel(page, "camera").locator("canvas.over").evaluate(beyondImage);
    assert.equal(spilt, 0, "pixels that are drawn beside the image");
  }
  step("the ball lies where a hand has put it, and the map and the camera are drawn");
}

/** Whether anything is drawn. */
function hasStrokes(canvas) {
  if (canvas.width < 16 || canvas.height < 16) return false;
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const colors = new Set();
  for (let at = 0; at < data.length && colors.size < 4; at += 4) colors.add(`${data[at]} ${data[at + 1]} ${data[at + 2]} ${data[at + 3]}`);
  return colors.size >= 4;
}

/** How many pixels are drawn where the image is not. */
function beyondImage(over) {
  const image = over.parentElement.querySelector("canvas");
  const { data } = over.getContext("2d").getImageData(0, 0, over.width, over.height);
  const scale = Math.min(over.width / image.width, over.height / image.height);
  const isOutside = (at, whole, part) => Math.abs(at + 0.5 - whole / 2) > (scale * part) / 2 + 1;
  let drawn = 0;
  for (let row = 0; row < over.height; row++) {
    for (let column = 0; column < over.width; column++) {
      if (data[4 * (row * over.width + column) + 3] > 0 && (isOutside(column, over.width, image.width) || isOutside(row, over.height, image.height))) drawn++;
    }
  }
  return drawn;
}
