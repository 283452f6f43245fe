// Uses the page in a real browser, with a real robot: `node test/browser.mjs [--screenshots FOLDER] PROGRAM [OPTIONS]`.
// PROGRAM is that of a robot with the paths below. Ends with 0 if everything was seen, else it says what was not.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const CHROMIUM = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
const OPTIONS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
/** A busy machine may take so long for anything. */
const PATIENCE = 40_000;
const VALUE = "Control.main_outputs.sensor_data";
const NUMBER = "Control.main_outputs.sensor_data.positions.head_pitch";
const IMAGE = "VisionTop.main_outputs.image";
const PARAMETER = "ball_filter.gate";

const words = process.argv.slice(2);
const screenshots = words[0] === "--screenshots" ? words.splice(0, 2)[1] : null;
const [program, ...options] = words;
const folder = mkdtempSync(join(tmpdir(), "hulkgen-page-"));
const port = await freePort();
const address = `http://127.0.0.1:${port}/`;

function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** Starts the robot; what it says is shown only if something is wrong. */
async function start() {
  const robot = spawn(program, ["--headless", "--listen", `127.0.0.1:${port}`, "--run-folder", folder, ...options]);
  robot.said = "";
  for (const stream of [robot.stdout, robot.stderr]) stream.on("data", (text) => (robot.said += text));
  robot.ended = new Promise((resolve) => robot.once("close", resolve));
  for (const begin = Date.now(); ; await new Promise((resolve) => setTimeout(resolve, 200))) {
    if (await fetch(address).then((answer) => answer.ok, () => false)) return robot;
    assert(robot.exitCode === null, `the robot ended:\n${robot.said}`);
    assert(Date.now() - begin < PATIENCE, `the robot serves no page:\n${robot.said}`);
  }
}

async function stop(robot) {
  robot.kill("SIGINT");
  await robot.ended;
}

function step(text) {
  console.log(text);
}

const panel = (page, kind) => page.locator(`.panel[data-kind="${kind}"]`);

/** Opens a panel for a path as a person does: search, choose, press. */
async function open(page, path, name) {
  await page.getByLabel("search all paths").fill(path);
  const line = page.locator(`.paths .line[data-path="${path}"]`);
  await line.locator(".name").first().click();
  await line.getByRole("button", { name: `open a panel: ${name}` }).click();
}

async function clearLayout(page) {
  for (let rest = await page.locator(".panel").count(); rest > 0; rest--) {
    await page.getByLabel("close this panel").first().click();
  }
}

/** Whether a curve is drawn: its colour is in the canvas. */
function hasCurve(canvas) {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  for (let at = 0; at < data.length; at += 4) {
    if (data[at] < 40 && Math.abs(data[at + 1] - 114) < 30 && Math.abs(data[at + 2] - 178) < 30 && data[at + 3] > 128) return true;
  }
  return false;
}

/** Whether a picture is more than one colour. */
function hasPicture(canvas) {
  if (canvas.width < 16 || canvas.height < 16) return false;
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const colors = new Set();
  for (let at = 0; at < data.length && colors.size < 20; at += 4 * 997) colors.add(`${data[at]} ${data[at + 1]} ${data[at + 2]}`);
  return colors.size >= 20;
}

async function until(page, locator, judge, what) {
  const handle = await locator.elementHandle();
  await page.waitForFunction(judge, handle, { timeout: PATIENCE, polling: 250 }).catch(() => assert.fail(`not seen: ${what}`));
}

async function changes(page, locator, what) {
  const before = await locator.textContent();
  const handle = await locator.elementHandle();
  await page
    .waitForFunction(([element, text]) => element.textContent !== text && element.textContent !== "", [handle, before], { timeout: PATIENCE })
    .catch(() => assert.fail(`${what} stays "${before}"`));
}

const isConnected = (page) => page.locator('.state[data-state="open"]').waitFor({ timeout: PATIENCE });

async function valuesChange(page) {
  await clearLayout(page);
  await open(page, VALUE, "Value");
  await changes(page, panel(page, "value").locator("output"), "the cycle number");
  await panel(page, "value").getByLabel("open positions").click();
  await panel(page, "value").getByText("head_pitch", { exact: true }).waitFor();
  step("values change");
}

async function curvesAndImagesMove(page) {
  await open(page, NUMBER, "Plot");
  await until(page, panel(page, "plot").locator("canvas"), hasCurve, "a curve");
  await open(page, IMAGE, "Image");
  await until(page, panel(page, "image").locator("canvas"), hasPicture, "an image");
  await changes(page, panel(page, "image").locator("output"), "the number of the image");
  step("curves and images move");
}

async function parametersComeBack(page, other) {
  await page.locator("summary", { hasText: "Add" }).click();
  await page.getByRole("button", { name: "add a panel: Parameters" }).click();
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
  await input(page).press("Escape");
  await page.getByRole("button", { name: /^take the last write/ }).click();
  await other.waitForFunction(([path, value]) => document.querySelector(`input[data-path="${path}"]`)?.value === value, [PARAMETER, before], { timeout: PATIENCE });
  step("a parameter comes back from the robot, also to others, and is undone");
}

async function injectionsReplaceOutputs(page) {
  const value = panel(page, "value");
  await value.locator("summary", { hasText: "Inject" }).click();
  await value.getByRole("button", { name: "begin with the newest value" }).click();
  const text = value.getByLabel("value to inject");
  const injected = JSON.parse(await text.inputValue());
  injected.positions.head_pitch = 0.123;
  await text.fill(JSON.stringify(injected));
  await value.getByRole("button", { name: /^every reader gets/ }).click();
  const reading = value.locator('.line:has(> .name[title$=".positions.head_pitch"]) > .reading');
  await reading.filter({ hasText: /^0\.123/ }).waitFor({ timeout: PATIENCE });
  await value.getByRole("button", { name: /^give the output back/ }).click();
  await reading.filter({ hasNotText: /^0\.123/ }).waitFor({ timeout: PATIENCE });
  step("an injected value takes the place of an output, until it is released");
}

async function restartsAreSurvived(page, robot) {
  await stop(robot);
  await page.locator('.state[data-state="lost"]').waitFor({ timeout: PATIENCE });
  assert.match((await panel(page, "value").locator("output").textContent()) ?? "", /cycle/, "what was there stays");
  const next = await start();
  await isConnected(page);
  await changes(page, panel(page, "value").locator("output"), "the cycle number after the restart");
  await until(page, panel(page, "plot").locator("canvas"), hasCurve, "a curve after the restart");
  step("a restart of the robot is survived");
  return next;
}

async function layoutsStay(page) {
  const count = await page.locator(".panel").count();
  await page.reload();
  await isConnected(page);
  assert.equal(await page.locator(".panel").count(), count, "the layout is kept");
  step("the layout is kept");
}

async function everyPresetIsShown(page) {
  for (const preset of ["Overview", "Tuning", "Graph"]) {
    await page.locator("summary", { hasText: "Layout" }).click();
    await page.getByRole("button", { name: `begin with ${preset}` }).click();
    await page.waitForTimeout(2500);
    assert.equal(await page.locator(".failure:not([hidden])").count(), 0, `${preset}: ${await page.locator(".failure:not([hidden])").allTextContents()}`);
    if (screenshots !== null) await page.screenshot({ path: join(screenshots, `page-${preset.toLowerCase()}.png`) });
  }
  step("every preset is shown");
}

let robot = await start();
const browser = await chromium.launch({ executablePath: CHROMIUM, args: OPTIONS });
try {
  const page = await browser.newPage({ viewport: { width: 1600, height: 900 } });
  page.setDefaultTimeout(PATIENCE);
  const wrong = [];
  page.on("pageerror", (error) => wrong.push(error.message));
  page.on("request", (request) => {
    const { host } = new URL(request.url());
    if (host !== "" && host !== `127.0.0.1:${port}`) wrong.push(`asked ${request.url()}`);
  });
  await page.goto(address);
  await isConnected(page);
  step("connected");
  await valuesChange(page);
  await curvesAndImagesMove(page);
  const others = await browser.newContext();
  await parametersComeBack(page, await others.newPage());
  await injectionsReplaceOutputs(page);
  robot = await restartsAreSurvived(page, robot);
  await layoutsStay(page);
  await everyPresetIsShown(page);
  assert.deepEqual(wrong, []);
} finally {
  await browser.close();
  await stop(robot);
  rmSync(folder, { recursive: true, force: true });
}
